"""Bounds on the length of a plan, without search: `Problem` → `Bounds`.

Entry points `find_bounds` and `find_impossible`.

`impossible` looks for what can never be (`Bounds.impossible`), `lower_bound` relaxes the problem to
one of walks (`Bounds.lower`), `insertion` puts a plan together (`Bounds.plan`), `length_cap` says how
long a plan need be at most.  Where the lower bound is the length of the plan, the plan is
minimal.  Nothing here decides what a plan is: `waiter_cli.rules.validator` judges every plan it returns.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.impossible import find_reasons
from waiter_cli.bounds.length_cap import find_cap
from waiter_cli.bounds.lower_bound import Estimate
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem, Reason

__all__ = ["Bounds", "find_bounds", "find_impossible"]


@dataclass(frozen=True)
class Bounds:
    """The facts about a problem that are known before any search.

    ``lower``: no plan is shorter.  ``plan``: a legal plan that reaches the goals, None when none
    was found.  ``cap``: if there is a plan at all, one is at most this long.  ``impossible``: why
    no plan exists, at any length; empty when nothing of the sort was found.
    """

    lower: int
    plan: Plan | None
    cap: int | None
    impossible: tuple[Reason, ...] = ()


def find_impossible(problem: Problem) -> tuple[Reason, ...]:
    """`Bounds.impossible` alone, which is quick."""
    staff = standing(problem)
    floor = WalkDistances(problem, staff.fixed.values())
    return find_reasons(problem, find_needs(problem), floor, staff)


def find_bounds(problem: Problem, *, deadline: float | None = None, effort: int = 1) -> Bounds:
    """Returns the bounds of ``problem``.

    ``deadline`` (of `time.monotonic`) ends improving, roughly.

    ``effort`` multiplies what is spent where the bounds do not meet at once: 1 is about a quarter
    of a second at most, 10 about two.
    """
    needs = find_needs(problem)
    staff = standing(problem)
    floor = WalkDistances(problem, staff.fixed.values())
    cap = find_cap(problem, needs, staff)
    reasons = find_reasons(problem, needs, floor, staff)
    if reasons:
        return Bounds(0, None, cap, reasons)
    estimate = Estimate(problem, needs, floor, staff, deadline, effort)
    lower, plan = estimate.find()
    if plan is None and staff.last:  # go around where those who move will stand in the end
        later = WalkDistances(problem, staff.after.values())
        plan = Estimate(problem, needs, later, staff, deadline).insertion()
    return Bounds(lower, plan, cap)
