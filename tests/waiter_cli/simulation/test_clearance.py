"""Both backends say the same; the physics drive arrives; clearances are what they are."""

from __future__ import annotations

import random
from dataclasses import replace
from importlib.util import find_spec

import pytest

from tests.support.playing import layout_of, play
from waiter_cli.errors import InputError, MissingError
from waiter_cli.problems.from_options import read_problem
from waiter_cli.room.room import build_room
from waiter_cli.room.shapes import Box, Disc
from waiter_cli.simulation.clearance import REACH, Geometric
from waiter_cli.simulation.injections import read_injection
from waiter_cli.simulation.open_backend import open_backend
from waiter_cli.simulation.outcome import Rules

LAYOUT = layout_of("report")


def test_clearance_is_measured_from_the_hull() -> None:
    backend = Geometric()
    backend.put([Box("table", 0, 0, 0.5, 0.5), Disc("c1", 3, 0, 0.2)])
    assert backend.clearance(0.9, 0.0) == (pytest.approx(0.15), "table")
    assert backend.clearance(2.4, 0.0) == (pytest.approx(0.15), "c1")
    assert backend.clearance(0.6, 0.0)[0] == pytest.approx(-0.15)
    assert backend.clearance(0.0, 9.0) == (REACH, None)
    backend.put([Disc("c1", 3, 0, 0.2)])
    assert backend.clearance(0.9, 0.0) == (REACH, None)


@pytest.mark.sim
@pytest.mark.parametrize("name", ["bistro", "generated4"])
def test_clearances_agree_within_a_millimetre(name: str) -> None:
    pytest.importorskip("pybullet")
    layout = layout_of(name)
    room = build_room(layout)
    solids = [
        *room.furniture({t.name: t.capacity for t in layout.tables}),
        Disc("c1", *room.queue[0], 0.2),
        Box("askew", *room.queue[1], 0.5, 0.1, 0.7),
    ]
    exact, measured = Geometric(), open_backend("pybullet")
    exact.put(solids)
    measured.put(solids)
    rng = random.Random(3)
    x0, x1, y0, y1 = room.bounds
    near = 0
    for _ in range(1500):
        x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
        gap, _name = exact.clearance(x, y)
        if gap > -0.1:
            near += gap < REACH
            assert measured.clearance(x, y)[0] == pytest.approx(gap, abs=1e-3)
    measured.close()
    assert near > 100


@pytest.mark.sim
@pytest.mark.parametrize(
    ("scenario", "inject"), [("b1", ["block:n5-n6@12+5"]), ("b2", ["slip:0.3"])]
)
def test_both_backends_write_the_same_events(scenario: str, inject: list[str]) -> None:
    pytest.importorskip("pybullet")
    problem = read_problem(None, scenario)[0]
    first = play(problem, inject=inject)
    second = play(problem, inject=inject, backend="pybullet")
    assert first.lines[0].replace("geometric", "pybullet") == second.lines[0]
    assert first.lines[1:] == second.lines[1:]


@pytest.mark.sim
@pytest.mark.parametrize("scene", ["b1", "b2", "b3", "lunch"])
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


@pytest.mark.sim
def test_nothing_of_pybullet_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    if find_spec("pybullet") is None:  # importing it here would print
        pytest.skip("PyBullet is missing")
    backend = open_backend("pybullet")
    backend.put([Box("table", 0, 0, 0.5, 0.5)])
    backend.clearance(0.9, 0.0)
    backend.close()
    assert capfd.readouterr() == ("", "")


def test_pybullet_that_is_missing_is_said_with_the_mend(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(MissingError, match=r"pip install .*(pybullet|\[sim\])|geometric"):
        open_backend("pybullet")


@pytest.mark.parametrize(
    ("text", "kind", "time", "subject", "amount"),
    [
        ("block:n5-n6@12+8", "block", 12.0, ("n5", "n6"), 8.0),
        ("block:n6-n5@0", "block", 0.0, ("n6", "n5"), None),
        ("leave:c1@3.5", "leave", 3.5, ("c1",), None),
        ("enter:4@1", "enter", 1.0, ("4",), None),
        ("bill:table1@2", "bill", 2.0, ("table1",), None),
        ("slip:0.25", "slip", 0.0, (), 0.25),
        ("stall:5@4", "stall", 4.0, (), 5.0),
    ],
)
def test_injections_are_read(text, kind, time, subject, amount) -> None:  # type: ignore[no-untyped-def]
    found = read_injection(text, LAYOUT)
    assert (found.kind, found.time, found.subject, found.amount) == (kind, time, subject, amount)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("flood:n1@2", "no such injection: flood"),
        ("slip", "no such injection: slip|slip"),
        ("slip:1.5", "between 0 and 1"),
        ("slip:nan", "no number"),
        ("block:n1-n6@2", "no edge n1-n6"),
        ("block:n5-n6", "what or when"),
        ("bill:table9@2", "unknown table table9; did you mean table2"),
        ("enter:0@2", "from 1 to 1000"),
        ("leave:c1@soon", "no number"),
        ("stall:-1@2", "no number"),
    ],
)
def test_injections_that_make_no_sense(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_injection(text, LAYOUT)
