"""What several robots do in one step: what goes together, and what comes of it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, JUG, ONE
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot, State
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.joint_steps import apply_together, begin_together, legal_instead

BIG = frozenset({"big"})
PAIR = ("c5", "c6")


def hall(
    *robots: Robot, layout: Layout = HALL, instant: bool = False, **changes: object
) -> Problem:
    """Robots in the hall, where w stands on c."""
    agents = tuple((robot.name, robot.at) for robot in robots)
    layout = replace(layout, agents=agents)
    state = State(
        robots[0].at, waiters=(("w", "c"),), robots=robots, chairs=(("big", 4), ("small", 2)),
        **changes,  # type: ignore[arg-type]
    )  # fmt: skip
    return Problem(layout, state, (), state, (), instant_kitchen=instant)


def done(problem: Problem, *texts: str, step: int = 0) -> State:
    actions = []
    for text in texts:
        name, _, rest = text.removesuffix(")").partition("(")
        actions.append(Action(step, name, tuple(rest.split(","))))
    return apply_together(problem, problem.state, actions, step)


def refused(problem: Problem, *texts: str, step: int = 0) -> str:
    with pytest.raises(Illegal) as told:
        done(problem, *texts, step=step)
    return told.value.reason


def test_each_changes_its_own() -> None:
    problem = hall(Robot("r", "d"), Robot("s", "e"), seated=ONE, wants_bill=BIG, waiting=(PAIR,))
    after = done(problem, "give_bill(r,big)", "pick(s,c5)")
    assert after.paid == BIG and not after.wants_bill and not after.waiting
    assert [robot.leads for robot in after.robots] == [(), PAIR]


def test_one_may_follow_where_another_leaves() -> None:
    after = done(hall(Robot("r", "a"), Robot("s", "b")), "go_to(r,b)", "go_to(s,d)")
    assert after.stations() == {"r": "b", "s": "d"}


@pytest.mark.parametrize(
    ("texts", "reason"),
    [
        (("go_to(r,b)", "go_to(s,b)"), "r and s would both stand on b at step 1"),
        (("go_to(t,b)",), "go_to(t,b): there is no robot t"),
        (("go_to(r,b)", "go_to(r,b)"), "go_to(r,b): r does another action at this step"),
        (("give_bill(r,big)", "give_bill(s,big)"), None),
    ],
)
def test_what_does_not_go_together(texts: tuple[str, ...], reason: str | None) -> None:
    problem = hall(Robot("r", "a"), Robot("s", "d"))
    said = refused(problem, *texts)
    assert reason is None or said == reason


def test_two_robots_do_not_change_places() -> None:
    said = refused(hall(Robot("r", "a"), Robot("s", "b")), "go_to(r,b)", "go_to(s,a)")
    assert said == "r and s would exchange a and b at step 0"


def test_nothing_is_done_twice() -> None:
    problem = hall(Robot("r", "b"), Robot("s", "d"), seated=ONE, wants_bill=BIG)
    assert refused(problem, "give_bill(r,big)", "give_bill(s,big)") == (
        "give_bill(s,big): r does the same at this step"
    )


def test_an_order_that_is_taken_anew_is_no_longer_the_first_ones() -> None:
    problem = hall(Robot("r", "a", orders=BIG), Robot("s", "d"), seated=ONE, ready_to_order=BIG)
    after = done(problem, "take_order(s,big)")
    assert [robot.orders for robot in after.robots] == [frozenset(), BIG]
    assert refused(problem, "send_order(r,big)", "take_order(s,big)") == (
        "send_order(r,big): it does not go together with take_order(s,big)"
    )


def test_what_one_carries_is_not_taken_by_another() -> None:
    problem = hall(Robot("r", "b", carries=("big", "jug")), Robot("s", "d"), empty=JUG)
    assert refused(problem, "refill(s,jug,big)") == "refill(s,jug,big): it is carried already"


def test_an_empty_jug_fills_at_the_bar() -> None:
    problem = hall(Robot("r", "b", carries=("big", "jug")), Robot("s", "d"), empty=JUG)
    assert done(problem).empty == JUG
    assert not done(problem, "go_to(r,a)").empty


def test_colleagues_come_first_to_their_nodes() -> None:
    layout = replace(HALL, timetable=(("w", 1, "b"),))
    problem = hall(Robot("r", "a"), Robot("s", "d"), layout=layout)
    assert refused(problem, "go_to(r,b)") == "w and r would both stand on b at step 1"
    assert done(problem).waiters == (("w", "b"),)


def test_the_start_is_judged_as_every_step() -> None:
    problem = hall(Robot("r", "a"), Robot("s", "d"))
    assert begin_together(problem) == problem.state
    with pytest.raises(Illegal, match="r and s would both stand on a at step 0"):
        begin_together(hall(Robot("r", "a"), Robot("s", "a")))


def test_what_each_could_do_instead_goes_with_what_the_others_do() -> None:
    problem = hall(Robot("r", "a"), Robot("s", "d"))
    doing = [Action(0, "go_to", ("r", "b"))]
    found = legal_instead(problem, problem.state, doing, 0)
    instead = [action.text for action in found]
    assert "go_to(s,b)" not in instead and "go_to(r,b)" in instead
    assert {action.arguments[0] for action in found} <= {"r", "s"}
    alone = [action.text for action in legal_instead(problem, problem.state, [], 0)]
    assert {"go_to(r,b)", "go_to(s,b)"} <= set(alone)
    for text in alone:
        done(problem, text)
