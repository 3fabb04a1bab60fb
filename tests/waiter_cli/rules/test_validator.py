"""Whole plans judged: valid, the first fault, goals that stay open, and their order."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, LED, START, act, at, plan, posed
from waiter_cli.model.plan import Plan
from waiter_cli.model.state import Goal
from waiter_cli.rules.validator import run

WALKS = replace(HALL, timetable=(("w", 2, "b"),))


def test_a_node_is_free_again_once_its_waiter_has_left() -> None:
    problem = posed(START, Goal("at", node="c"), layout=replace(WALKS, timetable=(("w", 1, "e"),)))
    verdict = run(problem, plan("go_to(agent,b)", "go_to(agent,c)"))
    assert verdict.valid and verdict.final_state.waiters == (("w", "e"),)


VISIT = posed(at("d", waiting=(LED,)), Goal("seated", party=LED))
SEATED = ("go_to(agent,e)", "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,small)")


def test_a_plan_that_reaches_its_goals_is_valid() -> None:
    verdict = run(VISIT, plan(*SEATED))
    assert verdict.valid and verdict.makespan == 4 and not verdict.notes
    assert len(verdict.states) == 5 and verdict.states[0] == VISIT.state
    assert verdict.final_state == at("d", seated=(("small", LED),))


def test_steps_beyond_the_goals_are_remarked_and_allowed() -> None:
    verdict = run(VISIT, plan(*SEATED, "go_to(agent,b)"))
    assert verdict.valid and verdict.makespan == 4
    assert verdict.notes == ("not minimal: the goals hold already at step 4",)


def test_the_first_fault_ends_the_play() -> None:
    verdict = run(VISIT, plan("go_to(agent,e)", "seat(agent,c1,big)", "fly(agent)"))
    assert not verdict.valid and len(verdict.states) == 2
    assert verdict.misstep is not None and verdict.misstep.step == 1
    assert verdict.misstep.action == act("seat(agent,c1,big)", 1)
    assert verdict.reasons == (
        "step 1: seat(agent,c1,big): the party of c1 does not follow the agent",
    )


def test_goals_that_do_not_hold_at_the_end_are_named() -> None:
    verdict = run(VISIT, plan(*SEATED[:2]))
    assert verdict.reasons == ("the goal seated: [c1, c2] does not hold at the end (step 2)",)
    left = posed(at("b"), Goal("at", node="d"))
    verdict = run(left, plan("go_to(agent,d)", "go_to(agent,e)"))
    assert not verdict.valid and verdict.makespan == 1


def test_idle_steps_count() -> None:
    verdict = run(VISIT, plan("", *SEATED[:1], "", *SEATED[1:]))
    assert verdict.valid and verdict.makespan == 6


@pytest.mark.parametrize(
    ("actions", "horizon", "message"),
    [
        ([(0, "go_to(agent,b)"), (0, "go_to(agent,a)")], 2, "another action at this step"),
        ([(1, "go_to(agent,b)"), (0, "go_to(agent,a)")], 2, "listed after step 1"),
        ([(-1, "go_to(agent,b)")], 1, "steps count from 0"),
        ([(0, "go_to(agent,b)"), (1, "go_to(agent,a)")], 1, "the plan ends at step 1"),
    ],
    ids=["two at once", "out of order", "negative", "past the end"],
)
def test_steps_come_one_by_one(actions: list[tuple[int, str]], horizon: int, message: str) -> None:
    verdict = run(posed(START), Plan(tuple(act(t, step) for step, t in actions), horizon))
    assert not verdict.valid and message in verdict.reasons[0]


def test_a_start_on_the_node_of_a_waiter_is_refused() -> None:
    state = at("c")
    verdict = run(posed(state), plan())
    assert not verdict.valid and "w stands on c at step 0" in verdict.reasons[0]


ON_THE_WAY, THERE = Goal("at", node="d"), Goal("at", node="e")


@pytest.mark.parametrize(
    ("before", "texts", "reason"),
    [
        ((ON_THE_WAY, THERE), ("go_to(agent,d)", "go_to(agent,e)"), None),
        (
            (THERE, ON_THE_WAY),
            ("go_to(agent,d)", "go_to(agent,e)"),
            "at: e (first at step 2) was wanted before at: d (first at step 1)",
        ),
        (
            (ON_THE_WAY, Goal("at", node="b")),
            ("go_to(agent,d)", "go_to(agent,e)"),
            "at: d (first at step 1) was wanted before at: b (first at step 0)",
        ),
        (
            (ON_THE_WAY, Goal("at", node="a")),
            ("go_to(agent,d)", "go_to(agent,e)"),
            "at: a was wanted in a certain order and never held",
        ),
        (
            (ON_THE_WAY, Goal("at", node="d")),
            ("go_to(agent,d)", "go_to(agent,e)"),
            "at: d (first at step 1) was wanted before at: d (first at step 1)",
        ),
    ],
    ids=["in order", "reversed", "holds from the start", "never", "at once"],
)
def test_goals_in_a_wanted_order(
    before: tuple[Goal, Goal], texts: tuple[str, ...], reason: str | None
) -> None:
    verdict = run(posed(at("b"), THERE, before=(before,)), plan(*texts))
    assert verdict.reasons == (() if reason is None else (reason,))


def test_the_order_puts_the_makespan_off_until_it_is_fulfilled() -> None:
    problem = posed(at("d"), Goal("chairs", table="big", number=1), before=((ON_THE_WAY, THERE),))
    assert run(problem, plan("go_to(agent,e)")).makespan == 1


# ------------------------------------------------------------ what a verdict says of a plan gone wrong


def numbered(*steps: int, horizon: int = 4) -> Plan:
    return Plan(tuple(act("go_to(agent,b)", step) for step in steps), horizon)


@pytest.mark.parametrize(
    ("wrong", "step", "says"),
    [
        (numbered(-1), -1, "steps count from 0"),
        (numbered(0, 2, 2), 2, "there is another action at this step"),
        (numbered(2, 1), 1, "it is listed after step 2"),
        (numbered(0, 4), 4, "the plan ends at step 4"),
    ],
)
def test_a_plan_out_of_order_is_not_played(wrong: Plan, step: int, says: str) -> None:
    verdict = run(posed(START), wrong)
    assert verdict.states == (START,), "nothing of it is played"
    assert verdict.misstep is not None and verdict.misstep.message.endswith(says)
    assert verdict.misstep.step == step
    assert verdict.misstep.action is not None and verdict.misstep.action.step == step


def test_a_start_that_is_impossible_is_a_misstep_at_step_0() -> None:
    verdict = run(posed(at("c")), plan("go_to(agent,b)"))
    assert verdict.states == (at("c"),) and verdict.makespan is None
    assert verdict.misstep is not None
    assert (verdict.misstep.step, verdict.misstep.action) == (0, None)
    assert verdict.reasons == (
        "step 0: at the start: w stands on c at step 0, and so would the agent",
    )
