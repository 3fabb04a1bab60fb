"""The robot on wheels: it arrives, and stops where something stands."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.playing import play
from waiter_cli.problems.from_options import read_problem
from waiter_cli.room.shapes import Box
from waiter_cli.simulation.open_backend import open_backend
from waiter_cli.simulation.outcome import Rules


@pytest.mark.sim
@pytest.mark.parametrize("scene", ["b1", "b2", "b3", pytest.param("lunch", marks=pytest.mark.slow)])
def test_the_physics_drive_arrives(scene: str) -> None:
    pytest.importorskip("pybullet")
    problem = replace(read_problem(None, scene)[0], prefer=())
    run = play(problem, rules=Rules(drive="physics"), backend="pybullet")
    assert run.outcome.status == "done", run.outcome.failures
    assert all(event["error_m"] <= 0.1 for event in run.of("arrived"))
    errors = [event["error_m"] for event in run.of("arrived")]
    assert not errors or max(errors) > 0.0, "wheels never stop exactly"


@pytest.mark.sim
def test_a_wheeled_robot_stops_at_a_wall() -> None:
    pytest.importorskip("pybullet")
    backend = open_backend("pybullet", "physics")
    backend.put([Box("wall", 1.0, 0.0, 0.1, 2.0)])
    pose = (0.0, 0.0, 0.0)
    for tick in range(1, 180):
        pose = backend.steer(pose, (tick / 100, 0.0, 0.0), 1 / 60)
    backend.close()
    assert pose[0] == pytest.approx(0.9 - 0.25, abs=0.02)
