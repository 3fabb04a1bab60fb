"""Scenarios: every key, every fault in its place, how files find their layout."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.marked import Case, differences, read_cases
from waiter_cli.errors import LayoutError, Where
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario, read_scenario_file
from waiter_cli.model.scenario import Scenario, TimedEvent
from waiter_cli.model.state import Goal, Observation, State

HALL_TEXT = """
nodes: [a, b, c]
edges: [[a, b], [b, c]]
entrance: c
agent: a
waiters: {w1: b}
bar: [a]
tables:
  t1: {capacity: 2, nodes: [b]}
  t2: {capacity: 4, nodes: [c]}
"""
HALL = read_layout(HALL_TEXT, "hall.yaml")
SIMPLE = read_layout(HALL_TEXT.replace("bar: [a]", ""), "simple.yaml")


def read(text: str) -> Scenario:
    return read_scenario(text, "s.yaml", HALL)


@pytest.mark.parametrize(
    "case", read_cases("scenario_faults.yaml", {}), ids=lambda case: case.title
)
def test_every_fault_is_reported_in_its_line(case: Case) -> None:
    with pytest.raises(LayoutError) as raised:
        read_scenario(case.text, "s.yaml", HALL)
    assert differences(case, raised.value.faults) == []


def test_every_key_is_read() -> None:
    scenario = read(
        """
name: a-day-in-june
layout: ../hall.yaml
state:
  agent: b
  waiters: {w1: c, w2: a}
  seated: {t2: [c1, c2]}
  waiting: [[c3, c4], [c5]]
  with_agent: [c6]
  wants_bill: [t2]
  ready_to_order: [t2]
  ordered: [t1]
  ready: {t1: [jug, basket]}
  carrying: {t2: jug}
  empty: {t2: jug, t1: basket}
  chairs: {t2: 3}
observe:
  - enter: [c7]
  - {bill: t1}
  - {at: {w1: a, w2: c}}
  - {leave: [c3]}
goals:
  - seated: [c3, c4]
  - seated: {party: c5, table: t1}
  - {chairs: {t1: 1, t2: 4}}
before:
  - [{paid: t2}, {served: {t2: plate}}]
prefer: [longest_waiting, shortest_walk]
events:
  - {time: 30, enter: [c8]}
  - {time: 12.5, bill: t2, free: t1}
instant_kitchen: true
"""
    )
    assert scenario.state == State(
        agent="b",
        waiters=(("w1", "c"), ("w2", "a")),
        seated=(("t2", ("c1", "c2")),),
        waiting=(("c3", "c4"), ("c5",)),
        with_agent=("c6",),
        wants_bill=frozenset({"t2"}),
        ready_to_order=frozenset({"t2"}),
        ordered=frozenset({"t1"}),
        ready=frozenset({("t1", "jug"), ("t1", "basket")}),
        carrying=("t2", "jug"),
        empty=frozenset({("t2", "jug"), ("t1", "basket")}),
        chairs=(("t1", 2), ("t2", 3)),
    )
    assert scenario.observe == (
        Observation("enter", ("c7",)),
        Observation("bill", ("t1",)),
        Observation("at", ("w1", "a")),
        Observation("at", ("w2", "c")),
        Observation("leave", ("c3",)),
    )
    assert scenario.goals == (
        Goal("seated", party=("c3", "c4")),
        Goal("seated", party=("c5",), table="t1"),
        Goal("chairs", table="t1", number=1),
        Goal("chairs", table="t2", number=4),
    )
    assert scenario.before == (
        (Goal("paid", table="t2"), Goal("served", table="t2", item="plate")),
    )
    assert scenario.prefer == ("longest_waiting", "shortest_walk")
    assert scenario.events == (
        TimedEvent(12.5, (Observation("bill", ("t2",)), Observation("free", ("t1",)))),
        TimedEvent(30, (Observation("enter", ("c8",)),)),
    )
    assert scenario.instant_kitchen
    assert (scenario.name, scenario.layout) == ("a-day-in-june", "../hall.yaml")
    places = dict(scenario.state_where)
    assert places["party.c3"] == Where("s.yaml", 8, 13)
    assert places["wants_bill.t2"] == Where("s.yaml", 10, 16)
    assert places["waiters.w2"] == Where("s.yaml", 6, 20)


def test_what_a_state_leaves_out_falls_back_on_the_layout() -> None:
    scenario = read("goals: []")
    assert scenario.state == State(agent="a", waiters=(("w1", "b"),), chairs=(("t1", 2), ("t2", 4)))
    assert scenario.goals == ()
    assert read("state: {}").goals is None
    assert read("goals:").goals is None
    assert dict(scenario.state_where)["waiters.w1"].name == "hall.yaml"


def test_a_goal_may_name_a_party_by_a_single_member() -> None:
    scenario = read("goals: [seated: c1, serve: c1, paid: c1, paid: t1]")
    assert scenario.goals == (
        Goal("seated", party=("c1",)),
        Goal("serve", party=("c1",)),
        Goal("paid", party=("c1",)),
        Goal("paid", table="t1"),
    )


def test_one_observation_and_one_goal_need_no_list() -> None:
    scenario = read("observe: {bill: t1}\ngoals: {paid: t1}")
    assert [seen.kind for seen in scenario.observe] == ["bill"]
    assert scenario.goals == (Goal("paid", table="t1"),)


@pytest.mark.parametrize(
    ("state", "ordered", "sent", "served"),
    [
        ("{ordered: [t1]}", {"t1"}, set(), set()),
        ("{ordered: [t1], sent: [t1]}", set(), {"t1"}, set()),
        ("{served: [t1]}", set(), {"t1"}, {"t1"}),
        ("{ordered: [t1], served: [t1]}", set(), {"t1"}, {"t1"}),
        ("{ordered: [t1], ready: {t1: plate}}", set(), {"t1"}, set()),
        ("{carrying: {t1: plate}}", set(), {"t1"}, set()),
        ("{carrying: {t1: jug}}", set(), set(), set()),
    ],
)
def test_an_order_is_as_far_as_anything_says(
    state: str, ordered: set[str], sent: set[str], served: set[str]
) -> None:
    found = read(f"state: {state}").state
    assert (found.ordered, found.sent, found.served) == (ordered, sent, served)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("state: {ordered: [t1]}", "ordered"),
        ("state: {ready: {t1: plate}}", "ready"),
        ("observe: [{order: t1}]", "order"),
        ("observe: [{ready: {t1: plate}}]", "ready"),
        ("goals: [{served: t1}]", "the goal served"),
        ("goals: [{filled: {t1: jug}}]", "the goal filled"),
    ],
)
def test_orders_need_a_bar(text: str, what: str) -> None:
    with pytest.raises(LayoutError, match=f"{what} needs a bar, and the layout has none"):
        read_scenario(text, "s.yaml", SIMPLE)
    assert read(text)


def test_an_object_that_the_layout_does_not_have_is_a_fault() -> None:
    dry = read_layout(HALL_TEXT + "objects: [plate]", "dry.yaml")
    with pytest.raises(LayoutError, match="the layout has no object jug; its objects are: plate"):
        read_scenario("observe: [{empty: {t1: jug}}]", "s.yaml", dry)


def test_whom_an_observation_sees_elsewhere_may_have_his_place_taken() -> None:
    scenario = read("state: {agent: b}\nobserve: [{at: {w1: c}}]")
    assert scenario.state.agent == "b"
    with pytest.raises(LayoutError, match="both stand on b"):
        read("state: {agent: b, waiters: {w1: b}}\nobserve: [{at: {w1: c}}]")


def test_a_state_against_the_timetable_is_a_fault() -> None:
    timed = read_layout(HALL_TEXT + "timetable: {w1: {0: b, 4: c}}", "timed.yaml")
    with pytest.raises(LayoutError, match="the timetable has him on b at step 0"):
        read_scenario("state: {waiters: {w1: c}}", "s.yaml", timed)
    with pytest.raises(LayoutError, match="the timetable has it so from step 4 on"):
        read_scenario("state: {waiters: {w2: c}}", "s.yaml", timed)


def test_a_layout_is_named_from_the_scenario_file(tmp_path: Path) -> None:
    (tmp_path / "rooms").mkdir()
    (tmp_path / "rooms" / "hall.yaml").write_text(HALL_TEXT)
    (tmp_path / "day.yaml").write_text("layout: rooms/hall.yaml\nobserve: [{bill: t1}]")
    layout, scenario = read_scenario_file(str(tmp_path / "day.yaml"))
    assert layout.name == "hall"
    assert scenario.layout == "rooms/hall.yaml"


def test_a_layout_that_is_given_wins(tmp_path: Path) -> None:
    (tmp_path / "day.yaml").write_text("layout: nowhere.yaml\nobserve: [{bill: t1}]")
    layout, _ = read_scenario_file(str(tmp_path / "day.yaml"), HALL)
    assert layout is HALL


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("observe: []", "day.yaml:1:1: the scenario names no layout; add layout: NAME"),
        ("", "day.yaml:1:1: the scenario names no layout"),
        ("layout: [a]", "day.yaml:1:9: layout must be a name or the path of a file"),
        ("layout: reprot", "day.yaml:1:9: there is no layout reprot; did you mean report?"),
        ("layout: day.yaml", "day.yaml is a scenario, not a layout"),
    ],
)
def test_a_layout_that_is_not_found(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "day.yaml").write_text(text)
    with pytest.raises(LayoutError) as raised:
        read_scenario_file(str(tmp_path / "day.yaml"))
    assert message in str(raised.value)
