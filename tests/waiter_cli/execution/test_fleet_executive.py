"""Several robots, each at its own pace: nobody meets, nobody waits for ever, nobody is forgotten."""

from __future__ import annotations

from collections import Counter

import pytest

from tests.support.fleet_evenings import Evening, quick_planner
from tests.support.serving import Live
from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.state import Goal, Observation

BAY = """
name: bay
nodes: [west, middle, east, bay]
edges: [[west, middle], [middle, east], [middle, bay]]
entrance: west
tables: {t1: {capacity: 4, nodes: [east]}}
agents: {r1: west, r2: east}
"""
SWAP = (Goal("at", node="east", robot="r1"), Goal("at", node="west", robot="r2"))


def bay(*goals: Goal) -> FleetExecutive:
    layout = read_layout(BAY, "bay.yaml")
    return FleetExecutive(
        layout, quick_planner, state=state_of_layout(layout)[0], goals=goals or SWAP
    )


def coming(decision: Decision) -> dict[str, str]:
    return {robot: action.text for robot, action in decision.next or ()}


def finish(executive: FleetExecutive) -> list[str]:
    """Does whatever can be done, one at a time; what was done."""
    done = []
    while executive.decision.next:
        robot, action = executive.decision.next[0]
        executive.done_by({robot: action.step})
        done.append(action.text)
    return done


def test_two_robots_change_places_through_a_bay() -> None:
    executive = bay()
    assert executive.decision.horizon == 4
    ((robot, action),) = executive.decision.next or ()
    executive.started_by(robot, action.step)
    assert executive.decision.next == ()  # the other one waits for it
    executive.done_by({robot: action.step})
    finish(executive)
    assert executive.state.stations() == {"r1": "east", "r2": "west"}
    assert (executive.decision.plan, executive.decision.horizon) == ((), 0)


def test_a_step_that_has_to_wait_is_refused_with_what_it_waits_for() -> None:
    executive = bay()
    waiting = next(
        a for a in executive.decision.plan if a.arguments[0] != executive.decision.next[0][0]
    )  # type: ignore[index]
    with pytest.raises(Refused) as refused:
        executive.done_by({waiting.arguments[0]: waiting.step})
    assert "has to wait for go_to" in refused.value.message and "first" in (
        refused.value.hint or ""
    )


def test_a_failure_is_planned_round_with_new_numbers() -> None:
    executive = bay()
    ((robot, action),) = executive.decision.next or ()
    executive.started_by(robot, action.step)
    executive.failed_by(robot, action.step, "a chair in the way")
    assert min(each.step for each in executive.decision.plan) > action.step
    finish(executive)
    assert executive.state.stations() == {"r1": "east", "r2": "west"}


def test_a_robot_that_is_out_stands_in_the_way_until_it_is_back() -> None:
    executive = bay()
    decision = executive.take_out("r2")
    assert (decision.status, decision.plan, decision.out) == ("no_plan", (), ("r2",))
    with pytest.raises(Refused):
        executive.take_out("r2")
    executive.bring_back("r2")
    assert executive.decision.status == "plan" and executive.decision.out == ()
    finish(executive)
    assert executive.state.stations() == {"r1": "east", "r2": "west"}


def test_a_robot_that_stops_on_its_way_keeps_both_nodes() -> None:
    executive = bay(Goal("at", node="bay", robot="r1"), Goal("at", node="east", robot="r2"))
    executive.observe([Observation("at", ("r1", "bay")), Observation("at", ("r2", "middle"))])
    executive.started_by("r2", executive.decision.plan[0].step)
    decision = executive.take_out("r2")
    assert executive.halted == (("r2", "east"),) and decision.status == "plan"
    executive.add_goal(Goal("at", node="middle", robot="r1"))
    assert executive.decision.status == "no_plan"


def test_what_only_a_lost_robot_has_must_wait() -> None:
    layout = read_layout(BAY, "bay.yaml")
    executive = FleetExecutive(layout, quick_planner, state=state_of_layout(layout)[0])
    executive.observe([Observation("enter", ("c1", "c2"))])
    while not any(robot.leads for robot in executive.state.robots):
        robot, action = (executive.decision.next or ())[0]
        executive.done_by({robot: action.step})
    leader = next(robot.name for robot in executive.state.robots if robot.leads)
    decision = executive.take_out(leader)
    assert [each.reasons[0].message for each in decision.pending] == [f"{leader} is out"]
    executive.bring_back(leader)
    finish(executive)
    assert executive.state.seated == (("t1", ("c1", "c2")),)
    other = "r1" if leader == "r2" else "r2"
    executive.take_out(other)
    executive.take_out(leader)
    executive.observe([Observation("bill", ("t1",))])
    assert [reason.message for reason in executive.decision.reasons] == ["every robot is out"]
    executive.bring_back(leader)
    assert executive.decision.status in ("plan", "no_plan")


def test_a_robot_that_walks_is_not_seen_elsewhere() -> None:
    executive = bay()
    ((robot, action),) = executive.decision.next or ()
    executive.started_by(robot, action.step)
    with pytest.raises(Refused) as refused:
        executive.observe([Observation("at", (robot, "west"))])
    assert "report it done or failed first" in (refused.value.hint or "")


BROKEN = (414, 2634, 5361)
"""Evenings that earlier versions did not come through: guests left while two robots were busy at their table,
and one of them, who was done before the other, stopped."""


@pytest.mark.parametrize("seed", BROKEN)
def test_evenings_that_once_broke(seed: int) -> None:
    assert Evening(seed).play() in ("served", "pending")


@pytest.mark.parametrize(
    "seeds",
    [range(10), *(pytest.param(range(k, k + 500), marks=pytest.mark.slow) for k in range(0, 10_000, 500))],
    ids=str,
)  # fmt: skip
def test_evenings_by_chance(seeds: range) -> None:
    """Delays, failures, robots that stop and go on, news: nobody meets and nobody is stuck."""
    found = Counter(Evening(seed).play() for seed in seeds)
    assert found["served"] > len(seeds) // 4


RING = """
name: ring
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d], [d, a]]
entrance: a
tables: {t1: {capacity: 2, nodes: [c]}}
agents: {r1: a, r2: b, r3: c, r4: d}
"""


@pytest.mark.parametrize("kind", ["started", "done"])
def test_a_ring_is_begun_one_robot_at_a_time(kind: str) -> None:
    """Each is told in a line of its own, and the plan stays what it is in between."""
    live = Live(read_layout(RING, "ring.yaml"))
    answer = live.tell({"goal": {"at": {"r1": "b"}}})
    assert list(answer["next"]) == ["r1", "r2", "r3", "r4"]
    for robot in ("r1", "r2", "r3", "r4"):
        told = live.tell({kind: {robot: 0}})
        assert "error" not in told and told["revision"] == answer["revision"], told
    for robot in ("r1", "r2", "r3", "r4") if kind == "started" else ():
        assert "error" not in live.tell({"done": {robot: 0}})
    places = live.session.executive.state.stations()
    assert places == {"r1": "b", "r2": "c", "r3": "d", "r4": "a"}
