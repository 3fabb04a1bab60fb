"""Peers for several robots: the program alone, horizon after horizon, and CP-SAT for joint walks.

Entry points `program_alone` and `cp_sat`; the latter needs ``pip install ortools``.
"""

from __future__ import annotations

import time
from collections import defaultdict
from importlib.util import find_spec

from waiter_cli import find_translator
from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.problem import Problem
from waiter_cli.planning.results import SearchOptions
from waiter_cli.planning.strategies import find_minimal_plan

__all__ = ["cp_sat", "program_alone"]


def program_alone(problem: Problem, limit: float) -> int | None:
    """Returns the length that the SPARC program proves without bounds, None where time is up."""
    options = SearchOptions(strategy="linear", use_bounds=False, time_limit=limit)
    found = find_minimal_plan(problem, find_translator(), find_domain("restaurant"), options)
    return found.plan.horizon if found.plan is not None and found.minimal else None


def cp_sat(problem: Problem, limit: float) -> int | None:
    """Returns the length of shortest joint walks, one time-expanded model a length, on one core.

    None where time is up, or OR-Tools is not installed.
    """
    if find_spec("ortools") is None:
        return None
    end, length = time.monotonic() + limit, 0
    while time.monotonic() < end:
        if _walks(problem, length, end):
            return length if time.monotonic() < end else None
        length += 1
    return None


def _walks(problem: Problem, length: int, end: float) -> bool:
    """Returns whether joint walks of so many steps were found before the ``end``."""
    from ortools.sat.python import cp_model

    model = cp_model.CpModel()
    near = {node: (node, *others) for node, others in problem.layout.neighbours().items()}
    into: dict[tuple[int, str], list[object]] = defaultdict(list)
    across: dict[tuple[int, str, str], list[object]] = defaultdict(list)
    ends = {goal.robot: goal.node for goal in problem.goals}
    for robot in problem.state.robots:
        arrivals: dict[str, list[object]] = {robot.at: []}
        for step in range(length):
            after: dict[str, list[object]] = defaultdict(list)
            for node, came in arrivals.items():
                leave = [model.new_bool_var("") for _ in near[node]]
                model.add(sum(leave) == (sum(came) if step else 1))  # type: ignore[arg-type]
                for other, move in zip(near[node], leave):
                    after[other].append(move)
                    into[step, other].append(move)
                    if other != node:
                        across[step, min(node, other), max(node, other)].append(move)
            arrivals = after
        wanted = ends.get(robot.name)
        if wanted is not None and (wanted not in arrivals):
            return False
        if wanted is not None and length:
            model.add(sum(arrivals[wanted]) == 1)  # type: ignore[arg-type]
    for moves in (*into.values(), *across.values()):
        if len(moves) > 1:
            model.add(sum(moves) <= 1)  # type: ignore[arg-type]
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.max_time_in_seconds = max(0.01, end - time.monotonic())
    return bool(solver.solve(model) in (cp_model.OPTIMAL, cp_model.FEASIBLE))
