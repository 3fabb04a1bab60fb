"""How far the robot walks and how long guests wait: figures, their sums, and which scenarios count."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.measure import (
    Measured,
    MeasuringPlanner,
    find_scenarios,
    length,
    measure,
    pose_all,
    total,
)
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

LINE = """\
nodes: {a: [0, 0], b: [3, 0], c: [3, 4]}
edges: [[a, b], [b, c]]
entrance: a
agent: b
tables: {t: {capacity: 2, nodes: [c], at: [5, 4]}}
"""
COME = "observe: [{enter: [g1]}]\n"


@pytest.fixture
def come(tmp_path: Path) -> str:
    path = tmp_path / "come.yaml"
    path.write_text(COME)
    return str(path)


def posed(text: str, scenario: str) -> Problem:
    (problem,) = pose_all(read_layout(text, "line.yaml"), [scenario])
    assert isinstance(problem, Problem)
    return problem


def test_metres_are_those_of_the_walk_and_waits_those_of_the_wishes(come: str) -> None:
    """From b to the door and back to c; the guest sits down in the last of five steps."""
    found = measure(posed(LINE, come))
    assert (found.status, found.scenario, found.steps, found.minimal) == ("plan", "come", 5, True)
    assert found.metres == pytest.approx(3 + 3 + 4)
    assert found.waits == (5,) and found.seconds is not None
    assert found.wait_seconds == (found.seconds,) and found.seconds > 10 / 0.8


def test_without_coordinates_an_edge_counts_one(come: str) -> None:
    bare = LINE.replace("{a: [0, 0], b: [3, 0], c: [3, 4]}", "[a, b, c]").replace(
        ", at: [5, 4]", ""
    )
    found = measure(posed(bare, come))
    assert (found.metres, found.seconds, found.wait_seconds) == (3.0, None, ())
    layout = read_layout(bare, "f")
    assert length(layout, "a", "b") == 1.0 and length(read_layout(LINE, "f"), "b", "c") == 4.0


def test_what_has_no_plan_is_told_why(tmp_path: Path) -> None:
    path = tmp_path / "many.yaml"
    path.write_text("observe: [{enter: [g1, g2, g3]}]\n")
    found = measure(posed(LINE, str(path)))
    assert found.status == "no_plan" and "3" in found.message and found.steps == 0
    assert found.document() == {"status": "no_plan", "message": found.message}


def test_a_limit_is_told(come: str) -> None:
    found = measure(posed(LINE, come), planner=MeasuringPlanner(max_steps=2))
    assert (found.status, found.limit) == ("undecided", "max_steps")
    assert found.document()["limit"] == "max_steps"


def test_the_shortest_walk_is_preferred_unless_something_else_is(come: str, tmp_path: Path) -> None:
    other = tmp_path / "other.yaml"
    other.write_text(f"{COME}prefer: [earliest]\n")
    assert posed(LINE, come).prefer == ("shortest_walk",)
    assert posed(LINE, str(other)).prefer == ("earliest",)


def test_a_scenario_of_another_restaurant_does_not_fit(tmp_path: Path) -> None:
    path = tmp_path / "else.yaml"
    path.write_text("goals: [{at: nowhere}]\n")
    (found,) = pose_all(read_layout(LINE, "f"), [str(path)])
    assert isinstance(found, Measured)
    assert (found.status, found.scenario) == ("no_fit", "else") and "nowhere" in found.message


def test_a_scenario_that_is_not_there_is_raised() -> None:
    with pytest.raises(InputError):
        pose_all(read_layout(LINE, "f"), ["nowhere.yaml"])


def test_scenarios_of_folders_come_by_name_then_those_that_are_named(tmp_path: Path) -> None:
    for name, text in (("b.yaml", COME), ("a.yml", COME), ("room.yaml", LINE), ("notes.txt", "")):
        (tmp_path / name).write_text(text)
    found = find_scenarios([str(tmp_path)], ["b1"])
    assert [Path(path).name for path in found] == ["a.yml", "b.yaml", "b1"], "a layout is none"


@pytest.mark.parametrize(
    ("folders", "names", "said"),
    [
        (["nowhere"], [], "nowhere: no such file"), (["."], [], ". has no scenario in it"),
        ([], [], "which scenarios?"), ([], ["-"], "read more than once"),
    ],
)  # fmt: skip
def test_what_are_no_scenarios(
    folders: list[str], names: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=re.escape(said)):
        find_scenarios(folders, names)


ONE = Measured(
    "one",
    "1",
    "plan",
    plan=Plan((), 4),
    metres=10.0,
    seconds=20.0,
    waits=(2, 4),
    wait_seconds=(5.0, 9.0),
)
OTHER = Measured(
    "other", "2", "plan", plan=Plan((), 6), metres=2.5, seconds=4.0, waits=(6,), wait_seconds=(4.0,)
)


def test_sums_over_scenarios() -> None:
    sums = total([ONE, OTHER], in_seconds=True)
    assert (sums.scenarios, sums.steps, sums.metres, sums.seconds) == (2, 10, 12.5, 24.0)
    assert (sums.waiting, sums.unit) == (6.0, "s")
    steps = total([ONE, OTHER], in_seconds=False)
    assert (steps.seconds, steps.waiting, steps.unit) == (None, 4.0, "steps")
    assert total([], in_seconds=False).waiting == 0.0


def test_the_document_of_figures() -> None:
    document = ONE.document()
    assert document["waiting"] == {
        "mean_steps": 3.0, "longest_steps": 4, "mean_seconds": 7.0, "longest_seconds": 9.0,
    }  # fmt: skip
    assert total([ONE], in_seconds=True).document()["waiting_unit"] == "seconds"
