"""Bounds on the plans for several robots, before any search. Entry point `find_fleet_bounds`."""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.joint_search import exhaust
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem, Reason

__all__ = ["FleetBounds", "find_fleet_bounds"]

FEW = 40_000
"""So many steps from state to state are looked at to find that there is no plan."""


@dataclass(frozen=True)
class FleetBounds:
    """``lower``: no plan is shorter.  ``plan``: one that was found, None when none was.

    ``impossible``: why there is no plan of any length; empty when nothing of the sort was found.
    """

    lower: int
    plan: Plan | None
    impossible: tuple[Reason, ...] = ()


def find_fleet_bounds(problem: Problem, deadline: float | None = None) -> FleetBounds:
    """Returns the bounds of ``problem``; ``deadline`` (of `time.monotonic`) ends them, roughly."""
    found = exhaust(problem, FEW, deadline)
    if found is None:
        return FleetBounds(0, None)
    if found.plan is None:
        message = (
            f"no plan: all {found.states} situations that the robots can get into were looked at, "
            "and in none of them everything is as it is wanted"
        )
        return FleetBounds(0, None, (Reason(message),))
    return FleetBounds(found.plan.horizon, found.plan)
