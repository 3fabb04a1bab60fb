"""What people would change about a plan, found by trying: written without a look at `waiter_cli.planning.tidy_plan`.

`postponed` lists deeds that could be done at an earlier visit, `out_of_turn` pairs of parties of
which the later one is fetched first for nothing, `too_large` tables larger than need be.  All try
every plan that differs so little, and let the validator judge.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.actions import holds
from waiter_cli.rules.validator import run

__all__ = ["out_of_turn", "postponed", "too_large", "total_waiting"]

_Row = list[tuple[str, tuple[str, ...]] | None]


def _row(plan: Plan) -> _Row:
    found: _Row = [None] * plan.horizon
    for action in plan.actions:
        found[action.step] = (action.name, action.arguments)
    return found


def _works(problem: Problem, row: _Row) -> bool:
    actions = [Action(step, *entry) for step, entry in enumerate(row) if entry is not None]
    return run(problem, Plan(tuple(actions), len(row))).valid


def postponed(problem: Problem, plan: Plan) -> list[str]:
    """The deeds that could be done before the robot last walked or waited, all else the same."""
    row = _row(plan)
    late = []
    for j, entry in enumerate(row):
        if entry is None or entry[0] == "go_to":
            continue
        for i in range(j):
            if all(each is not None and each[0] != "go_to" for each in row[i:j]):
                continue  # it is the same visit
            if any(_works(problem, trial) for trial in _sooner(row, j, i)):
                late.append(f"{entry[0]}{entry[1]} at {j} could be done at {i}")
                break
    return late


def _sooner(row: _Row, j: int, i: int) -> Iterator[_Row]:
    """Entry ``j`` at ``i``: what was there waits a step, up to ``j`` or to an idle step."""
    idle = [k for k in range(i, j) if row[k] is None]
    for k in (*idle, j):
        yield [
            *row[:i], row[j], *row[i:k], *row[k + 1 : j],
            *([None] if k != j else []), *row[j + 1 :],
        ]  # fmt: skip


def out_of_turn(problem: Problem, plan: Plan) -> list[str]:
    """Pairs of parties fetched against the order of arrival, though they could change places."""
    arrival = [party[0] for party in problem.state.waiting]
    row = _row(plan)
    picks = [entry[1][1] for entry in row if entry is not None and entry[0] == "pick"]
    seats = {e[1][1]: e[1][2] for e in row if e is not None and e[0] == "seat"}
    wrong = []
    for early, late in combinations(picks, 2):
        if arrival.index(early) < arrival.index(late):
            continue
        other = {early: late, late: early}
        swapped = _with_parties(row, other, {})
        tables = {seats.get(early): seats.get(late), seats.get(late): seats.get(early)}
        both = _with_parties(row, other, tables)
        if _works(problem, swapped) or _works(problem, both):
            wrong.append(f"{early} before {late}")
    return wrong


def _with_parties(row: _Row, other: dict[str, str], tables: dict[str | None, str | None]) -> _Row:
    found: _Row = []
    for entry in row:
        if entry is not None and entry[0] in ("pick", "seat") and entry[1][1] in other:
            agent, who, *table = entry[1]
            entry = (entry[0], (agent, other[who], *(tables.get(t) or t for t in table)))
        found.append(entry)
    return found


def too_large(problem: Problem, plan: Plan) -> list[str]:
    """Parties that could sit at a smaller table at the same step, all else the same."""
    size = {table.name: table.capacity for table in problem.layout.tables}
    row = _row(plan)
    found = []
    for step, entry in enumerate(row):
        if entry is None or entry[0] != "seat":
            continue
        agent, who, mine = entry[1]
        for table in size:
            trial = [*row[:step], ("seat", (agent, who, table)), *row[step + 1 :]]
            if size[table] < size[mine] and _works(problem, trial):
                found.append(f"{who} at {mine} could sit at {table}")
    return found


def total_waiting(problem: Problem, plan: Plan) -> int:
    """The sum over the steps of a plan of the goals that do not hold then."""
    states = run(problem, plan).states
    return sum(not holds(goal, state, problem) for state in states for goal in problem.goals)
