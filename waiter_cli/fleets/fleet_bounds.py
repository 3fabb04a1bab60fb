"""Bounds on the plans for several robots, before any search. Entry point `find_fleet_bounds`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import FAR
from waiter_cli.bounds.reasons import place_of_goal
from waiter_cli.fleets.barriers import find_barriers
from waiter_cli.fleets.construct import construct
from waiter_cli.fleets.foil_barriers import find_foil_barriers
from waiter_cli.fleets.joint_search import exhaust
from waiter_cli.fleets.joint_walks import only_walks, walk_together
from waiter_cli.fleets.makespan import least_steps
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.wording import goal_text

__all__ = ["FleetBounds", "find_fleet_bounds"]

FEW = 40_000
"""So many steps from state to state are looked at to find that there is no plan."""


@dataclass(frozen=True)
class FleetBounds:
    """``lower``: no plan is shorter.  ``plan``: one that was found, None when none was.

    ``deals`` say which robot does what where that takes least, ``length`` how many steps it takes
    where none is in another one's way.  ``impossible``: why there is no plan of any length; empty when nothing of the sort was found.
    """

    lower: int
    plan: Plan | None
    impossible: tuple[Reason, ...] = ()
    deals: tuple[Action, ...] = ()
    length: int = 0


def find_fleet_bounds(
    problem: Problem, deadline: float | None = None, required: Action | None = None
) -> FleetBounds:
    """Returns the bounds of ``problem``; ``deadline`` (of `time.monotonic`) ends them, roughly.

    They are about plans in which ``required`` occurs, where that is given.
    """
    reasons = find_barriers(problem)
    if required is not None:
        reasons = reasons or find_foil_barriers(problem, required)
    if reasons:
        return FleetBounds(0, None, reasons)
    lower = least_steps(problem, deadline)
    if lower >= FAR:
        return FleetBounds(0, None, tuple(_out_of_reach(problem)))
    made = construct(problem, lower, deadline)
    plan, deals, length = (None, (), 0) if made is None else (made.plan, made.deals, made.length)
    if required is not None:
        plan, deals = _having(plan, required), ()
    if plan is None:
        bounds = exhaust(problem, FEW, deadline, required)
        if bounds is not None and bounds.plan is not None:
            return FleetBounds(bounds.plan.horizon, bounds.plan)
        if bounds is not None:
            return FleetBounds(0, None, (_exhausted(bounds.states, required),))
    if required is None and only_walks(problem) and (plan is None or plan.horizon > lower):
        walks = walk_together(problem, lower, None if plan is None else plan.horizon, deadline)
        lower, plan = walks.lower, walks.plan or plan
    elif plan is None or plan.horizon > lower:
        from waiter_cli.fleets.joint.closing_lengths import close_lengths

        lengths = close_lengths(problem, lower, plan, deadline)
        lower, plan = lengths.lower, lengths.plan
    return FleetBounds(lower, plan, deals=deals, length=length)


def _having(plan: Plan | None, required: Action) -> Plan | None:
    """Returns the plan where the action occurs in it, else None."""
    done = () if plan is None else plan.actions
    return plan if any(action.text == required.text for action in done) else None


def _exhausted(states: int, required: Action | None) -> Reason:
    """Returns the reason for no plan once every situation was looked at."""
    looked = f"all {states} situations that the robots can get into were looked at"
    if required is None:
        looked = f"no plan: {looked}"
    after = "" if required is None else ", with it done,"
    return Reason(f"{looked}, and in none of them{after} everything is as it is wanted")


def _out_of_reach(problem: Problem) -> Iterator[Reason]:
    """Reasons for goals that take something where no robot can get to."""
    single = [g for g in problem.goals if least_steps(replace(problem, goals=(g,))) >= FAR]
    for goal in single or problem.goals:
        message = f"no robot can get to all that the goal {goal_text(goal)} takes"
        yield Reason(message, place_of_goal(problem, goal))
