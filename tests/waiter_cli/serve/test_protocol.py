"""`waiter serve` with several robots: its lines, its answers, its journal."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.serving import Live
from waiter_cli.files.layout_reader import read_layout

TWO = """
name: two
nodes: {door: [0, 0], aisle: [2, 0], back: [4, 0], hatch: [2, -2], nook: [2, 2]}
edges: [[door, aisle], [aisle, back], [aisle, hatch], [aisle, nook]]
entrance: door
tables:
  window: {capacity: 2, nodes: [nook], at: [2.2, 3.2]}
  corner: {capacity: 4, nodes: [back], at: [4, 1.4]}
agents: {r1: hatch, r2: nook}
bar: [hatch]
"""


@pytest.fixture
def live() -> Live:
    return Live(read_layout(TWO, "two.yaml"))


def test_everybody_goes_on_by_what_next_says(live: Live) -> None:
    answer = live.seen({"enter": ["c1", "c2"]}, {"enter": ["c3", "c4", "c5"]})
    assert (answer["horizon"], answer["minimal"]) == (10, True)
    done = 0
    while answer["next"]:
        steps = {robot: action["step"] for robot, action in answer["next"].items()}
        robot = min(steps)
        live.tell({"started": {robot: steps[robot]}})
        answer = live.tell({"done": {robot: steps[robot]}})
        done += 1
    assert (answer["plan"], answer["horizon"], done) == ([], 0, 12)
    seated = live.tell({"ask": "state"})["state"]["seated"]
    assert seated == {"window": ["c1", "c2"], "corner": ["c3", "c4", "c5"]}


@pytest.mark.parametrize(
    ("line", "message", "hint"),
    [
        ({"done": 0}, "done has to say of which robot", '{"done": {"r1": 0}}'),
        ({"done": {}}, "done takes robots and their steps", '{"done": {"r1": 0}}'),
        ({"done": {"r2": "0"}}, "done takes the number of a step", "for example"),
        ({"done": {"r3": 0}}, "unknown robot r3", "r1"),
        ({"started": {"r1": 0, "r2": 0}}, "one robot a line", "for example"),
        ({"done": {"r2": 7}}, "step 7 of r2 is out of order", "its next step is"),
        ({"done": {"r1": 3}}, "", ""),
        ({"failed": {"r2": 0}, "reason": 1}, "a reason must be a text", ""),
        ({"back": "r2"}, "r2 is not out", ""),
        ({"back": 2}, "back takes the name of a robot", "r1, r2"),
        ({"observe": {"out": "r4"}}, "unknown robot r4", "r1"),
        ({"observe": {"out": ["r1"]}}, "out takes the name of a robot", '{"out": "r1"}'),
    ],
)
def test_lines_that_cannot_be(live: Live, line: Any, message: str, hint: str) -> None:
    before = live.seen({"enter": ["c1", "c2"]})
    error = live.tell(line)["error"]
    assert message in error["message"] and hint in error.get("hint", "")
    after = live.tell({"ask": "plan"})
    assert {k: after[k] for k in ("plan", "next", "revision")} == {
        k: before[k] for k in ("plan", "next", "revision")
    }


def test_one_robot_is_never_out() -> None:
    one = TWO.replace("agents: {r1: hatch, r2: nook}", "agent: hatch")
    live = Live(read_layout(one, "one.yaml"))
    assert "one robot" in live.tell({"back": "r1"})["error"]["message"]
    assert "error" in live.tell({"observe": {"out": "agent"}})
    assert "error" in live.tell({"done": {"agent": 0}})


def test_several_are_done_in_one_line_and_one_stops_and_goes_on(live: Live) -> None:
    answer = live.seen({"enter": ["c1", "c2"]}, {"out": "r1"})
    assert answer["out"] == ["r1"] and {a["args"][0] for a in answer["plan"]} == {"r2"}
    answer = live.tell({"back": "r1"})
    assert "out" not in answer
    first = answer["plan"][0]
    answer = live.tell({"failed": {first["args"][0]: first["step"]}, "reason": "a chair"})
    assert all(action["step"] > first["step"] for action in answer["plan"])
    why = live.tell({"ask": "why"})["why"]
    assert why["goals"][0]["reached_at"] is not None
    live.tell({"goal": {"at": {"r1": "aisle"}}})
    answer = live.tell({"goal": {"at": {"r2": "back"}}})
    while answer["next"]:
        answer = live.tell({"done": {r: a["step"] for r, a in answer["next"].items()}})
    assert live.tell({"ask": "state"})["state"]["agents"] == {"r1": "aisle", "r2": "back"}


def test_a_journal_goes_on_and_can_be_replayed(tmp_path: Path) -> None:
    layout = tmp_path / "two.yaml"
    layout.write_text(TWO)
    journal = tmp_path / "evening.journal"
    given = ["serve", "--layout", str(layout), "--journal", str(journal), "--time-limit", "30"]
    lines = [{"observe": [{"enter": ["c1", "c2"]}, {"enter": ["c3"]}]}, {"ask": "plan"}]
    plan = _told(given, lines)[-1]["plan"]
    first = plan[0]
    robot = first["args"][0]
    more = _told(given, [{"started": {robot: first["step"]}}, {"observe": {"out": robot}}])
    assert more[-1]["out"] == [robot]
    again = _told(given, [{"ask": "plan"}, {"back": robot}, {"ask": "state"}])
    assert again[-3]["out"] == [robot] and again[-3]["plan"] == more[-1]["plan"]
    assert again[-1]["state"]["agents"] == {"r1": "hatch", "r2": "nook"}
    ran = waiter("serve", "--replay", str(journal))
    assert (ran.code, ran.err) == (0, "")
    assert len(ran.out.splitlines()) == 4


def _told(given: list[str], lines: list[Any]) -> list[dict[str, Any]]:
    ran = waiter(*given, stdin="".join(json.dumps(line) + "\n" for line in lines))
    assert ran.code == 0, ran.err
    return [json.loads(line) for line in ran.out.splitlines()]


def test_a_timetable_is_refused_at_its_line(tmp_path: Path) -> None:
    layout = tmp_path / "two.yaml"
    layout.write_text(TWO + "waiters: {w1: back}\ntimetable: {w1: {3: aisle}}\n")
    ran = waiter("serve", "--layout", str(layout), stdin="")
    assert ran.code == 2 and f"{layout}:12:" in ran.err and "timetable" in ran.err
