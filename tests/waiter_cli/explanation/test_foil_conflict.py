"""Why no plan has an action: what refuses it wherever the robot stands, or what it makes impossible."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, ONE, act, at, plan, posed
from waiter_cli.explanation.foil_conflict import find_conflict
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

NOTHING = Plan((), 0)
WAITING = (("c1",), ("c5", "c6", "c7"))


def conflict(state: State, foil: str, *goals: Goal, done: Plan = NOTHING, **more: object) -> str:
    problem: Problem = posed(state, *goals, **more)  # type: ignore[arg-type]
    return find_conflict(problem, act(foil), done)


@pytest.mark.parametrize(
    ("state", "foil", "reason"),
    [
        (at("a", waiting=WAITING), "seat(agent,c5,small)", "small is for 2, the party of c5 has 3"),
        (at("a", seated=ONE), "pick(agent,c1)", "the party of c1 sits at big already"),
        (at("a", seated=ONE), "seat(agent,c1,small)", "the party of c1 sits at big already"),
        (at("b"), "bring(agent,jug,big)", "no jug for big is ready"),
    ],
)
def test_the_rule_that_refuses_it_is_told_not_where_the_robot_is(
    state: State, foil: str, reason: str
) -> None:
    assert conflict(state, foil) == reason


def test_where_the_robot_stands_and_whom_it_leads_is_its_own_choice() -> None:
    """It is far away and leads another party; still it is the table that is too small."""
    far = at("a", with_agent=("c1",), waiting=WAITING[1:])
    assert "small is for 2" in conflict(far, "seat(agent,c5,small)")


def test_a_node_that_is_always_taken_is_the_reason() -> None:
    assert "w stands on c" in conflict(at("b"), "go_to(agent,c)")


def test_without_a_bar_there_is_no_bar() -> None:
    assert (
        conflict(at("a", seated=ONE), "send_order(agent,big)", layout=replace(HALL, bar=None))
        == "there is no bar"
    )


def test_what_it_makes_impossible_is_told_as_what_comes_after() -> None:
    """Who sits at the big table cannot be moved, and the others fit nowhere else."""
    goals = (Goal("seated", party=("c1",)), Goal("seated", party=("c5", "c6", "c7")))
    said = conflict(at("e", waiting=WAITING), "seat(agent,c1,big)", *goals)
    assert said.startswith("after it ") and "c5" in said


def test_what_is_possible_by_itself_puts_the_goals_out_of_reach() -> None:
    state = at("b", seated=ONE, wants_bill="big")
    done = plan("give_bill(agent,big)")
    said = conflict(state, "go_to(agent,b)", Goal("paid", table="big"), done=done)
    assert said == "after it the goals are out of reach"


def test_a_plan_is_looked_through_step_by_step() -> None:
    """At first nobody wants the bill; what is refused from the start is the reason."""
    state = at("b", seated=ONE)
    assert "does not want" in conflict(state, "give_bill(agent,big)", done=plan("go_to(agent,d)"))
