"""Peers for several robots: the program alone, horizon after horizon, and CP-SAT.

Entry points `program_alone` and `cp_sat`; the latter needs ``pip install ortools``.
"""

from __future__ import annotations

import time
from importlib.util import find_spec

from waiter_cli import find_translator
from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchOptions
from waiter_cli.planning.strategies import find_minimal_plan

__all__ = ["cp_sat", "has_cp_sat", "program_alone", "takes"]


def has_cp_sat() -> bool:
    """Returns whether OR-Tools is installed."""
    return find_spec("ortools") is not None


def program_alone(problem: Problem, limit: float) -> int | None:
    """Returns the length that the SPARC program proves without bounds, None where time is up."""
    options = SearchOptions(strategy="linear", use_bounds=False, time_limit=limit)
    found = find_minimal_plan(problem, find_translator(), find_domain("restaurant"), options)
    return found.plan.horizon if found.plan is not None and found.minimal else None


def cp_sat(problem: Problem, limit: float) -> int | None:
    """Returns the least length, one time-expanded model a length from 0 on, on one core.

    None where time is up, OR-Tools is not installed, or the problem `takes` more than it knows.
    """
    if not has_cp_sat() or not takes(problem):
        return None
    from benchmarks.fleet_model import solve_length

    end, length = time.monotonic() + limit, 0
    while time.monotonic() < end:
        if solve_length(problem, length, end):
            return length if time.monotonic() < end else None
        length += 1
    return None


def takes(problem: Problem) -> bool:
    """Returns whether the model of `cp_sat` has all that a problem is about: no plates, no chairs."""
    state, kinds = problem.state, {goal.kind for goal in problem.goals}
    more = state.led() or state.carried() or state.held_orders() or state.ready or state.empty
    fixed = any(goal.kind == "seated" and goal.table for goal in problem.goals)
    lends = "seated" in kinds and any(t.chairs < t.capacity for t in problem.layout.tables)
    plain = not (problem.before or problem.layout.timetable or more or fixed or lends)
    return plain and kinds <= {"at", "seated", "paid", "sent"}
