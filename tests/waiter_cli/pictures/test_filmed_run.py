"""A run is played, listened to and recorded."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.playing import Builder, scene
from waiter_cli.errors import LayoutError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.pictures.filmed_run import Showing, build_checked_room, play_run
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.outcome import Rules
from waiter_cli.simulation.run_request import RunRequest


def test_an_edge_through_furniture_is_refused_before_anything_moves() -> None:
    layout = read_layout(
        "nodes: {a: [0, 0], b: [4, 0]}\nedges: [[a, b]]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 2, nodes: [b], at: [2, 0.3]}}\n",
        "narrow.yaml",
    )
    with pytest.raises(LayoutError, match="the edge a-b runs through t"):
        build_checked_room(pose_problem(layout, None, enter=[1]))


def test_events_go_to_the_listener_and_to_the_file(tmp_path: Path) -> None:
    problem, lines = scene("b3"), []
    showing = Showing(events=str(tmp_path / "events"), listener=lines.append)
    outcome, shown = play_run(
        RunRequest(problem),
        build_checked_room(problem),
        Builder(),
        "geometric",
        Rules(),
        (),
        showing,
    )
    assert outcome.status == "done" and shown == ()
    assert (tmp_path / "events").read_text() == "".join(lines)
    assert json.loads(lines[-1])["type"] == "end"


def test_measuring_without_bullet_is_remarked(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pybullet", None)
    problem, said = scene("b3"), []
    play_run(
        RunRequest(problem), build_checked_room(problem), Builder(), "auto", Rules(), (), Showing(),
        said.append,
    )  # fmt: skip
    assert said == ["PyBullet is not there; clearances are measured geometrically"]
