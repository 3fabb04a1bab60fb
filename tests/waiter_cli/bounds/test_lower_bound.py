"""Both bounds of one problem: they meet where nothing is open, and the time for it may be over."""

from __future__ import annotations

import time

from tests.support.hall import posed
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.lower_bound import Estimate
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

PAIR, ONE = ("c1", "c2"), ("c3",)


def estimate(problem: Problem, deadline: float | None = None) -> Estimate:
    staff = standing(problem)
    floor = WalkDistances(problem, staff.fixed.values())
    return Estimate(problem, find_needs(problem), floor, staff, deadline)


def test_a_walk_and_its_deeds_are_counted() -> None:
    bounds = estimate(posed(State("a", waiting=(PAIR,)), Goal("seated", party=PAIR)))
    lower, plan = bounds.find()  # a to e, pick, back to d, seat
    assert (lower, plan and plan.horizon) == (6, 6)


def test_two_parties_cannot_have_the_same_table() -> None:
    """Each by itself would take the near one."""
    goals = (Goal("seated", party=PAIR), Goal("seated", party=ONE))
    lower, plan = estimate(posed(State("a", waiting=(PAIR, ONE)), *goals)).find()
    alone, _ = estimate(posed(State("a", waiting=(PAIR,)), goals[0])).find()
    assert plan is not None and plan.horizon == lower > alone + 4
    seats = {action.arguments[2] for action in plan.actions if action.name == "seat"}
    assert seats == {"big", "small"}


def test_without_time_the_bounds_still_hold() -> None:
    goals = (Goal("seated", party=PAIR), Goal("seated", party=ONE))
    problem = posed(State("a", waiting=(PAIR, ONE)), *goals)
    patient, plan = estimate(problem).find()
    hasty, _ = estimate(problem, deadline=time.monotonic() - 1).find()
    assert plan is not None and 0 < hasty <= patient <= plan.horizon


def test_insertion_alone_makes_a_legal_plan() -> None:
    problem = posed(State("a", waiting=(PAIR,)), Goal("seated", party=PAIR))
    plan = estimate(problem).insertion()
    assert plan is not None and plan.horizon == 6
