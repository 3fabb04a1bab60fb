"""Fills the slots of a template, and tells which optional parts a problem has.

Entry points `SLOTS`, functions of the problem and the horizon by name, `PARTS` and `parts_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from waiter_cli.encoding.facts import (
    ProgramLine,
    all_goals,
    goal_facts,
    guest_goals,
    guest_state,
    has_chairs,
    objects_of,
    observation_facts,
    refillables_of,
    state_facts,
)
from waiter_cli.errors import Where
from waiter_cli.model.problem import Problem

__all__ = ["PARTS", "SITUATION", "SLOTS", "parts_of"]

SITUATION = frozenset({"state", "observations", "goals", "guest_state", "guest_goals"})
"""The slots that say what one problem gives; the others make the restaurant."""

PARTS: dict[str, Callable[[Problem], bool]] = {
    "bar": lambda problem: problem.layout.bar is not None,
    "objects": lambda problem: bool(objects_of(problem)),
    "plates": lambda problem: "plate" in objects_of(problem),
    "refillables": lambda problem: bool(refillables_of(problem)),
    "instant_kitchen": lambda problem: problem.instant_kitchen and "plate" in objects_of(problem),
    "chairs": lambda problem: has_chairs(problem),
    "timetable": lambda problem: bool(problem.layout.timetable),
    "order": lambda problem: bool(problem.before),
    "one_way": lambda problem: bool(problem.layout.one_way),
    # One of these two is there: any possible action may be chosen, or those of a suggested plan.
    "choice": lambda problem: False,
    "offer": lambda problem: False,
}


def parts_of(problem: Problem) -> frozenset[str]:
    """Returns the names of the optional parts that a problem has."""
    return frozenset(name for name, has in PARTS.items() if has(problem))


# ---------------------------------------------------------------- sorts


def _braces(sort: str, names: Iterable[str]) -> list[ProgramLine]:
    return [ProgramLine(f"#{sort} = {{{', '.join(names)}}}.")]


def _customers(problem: Problem) -> list[str]:
    named = dict.fromkeys(name for party in problem.state.parties() for name in party)
    for party in problem.before_observations.parties():
        named.update(dict.fromkeys(party))
    for goal in all_goals(problem):
        named.update(dict.fromkeys(goal.party))
    taken = {node.name for node in problem.layout.nodes} | {t.name for t in problem.layout.tables}
    number = 1
    while len(named) < max(1, problem.layout.customers):
        if (name := f"c{number}") not in taken:
            named[name] = None
        number += 1
    return list(named)


def _tables(problem: Problem) -> list[str]:
    """Returns the tables; where there are none a name stands in, for no sort may be empty."""
    names = [table.name for table in problem.layout.tables]
    stand_in = "notable"
    while any(node.name == stand_in for node in problem.layout.nodes):
        stand_in += "x"
    return names or [stand_in]


def _numbers(problem: Problem) -> int:
    seats = [table.capacity for table in problem.layout.tables]
    sizes = [len(party) for party in problem.state.parties()]
    wanted = [goal.number for goal in all_goals(problem) if goal.number is not None]
    return max([1, *seats, *sizes, *wanted, *(count for _, count in problem.state.chairs)])


def _inertial(problem: Problem, pieces: str) -> list[str]:
    parts = parts_of(problem)
    chosen = ["#basic_" + pieces]
    for part, name in (("bar", "order"), ("objects", "object"), ("refillables", "refill"),
                       ("chairs", "chair")):  # fmt: skip
        if part in parts:
            chosen.append(f"#{name}_{pieces}")
    return chosen


def _directives(problem: Problem, horizon: int) -> list[ProgramLine]:
    """Returns the directive for numbers above 2000, which SPARC refuses without it."""
    largest = max(horizon, _numbers(problem))
    return [ProgramLine(f"#maxint = {largest}.")] if largest > 2000 else []


# ---------------------------------------------------------------- the layout


def _table_facts(problem: Problem) -> list[ProgramLine]:
    lines = []
    for table in problem.layout.tables:
        for node in dict.fromkeys(table.nodes):
            lines.append(ProgramLine(f"areassociated({node}, {table.name}).", table.where))
        lines.append(ProgramLine(f"hascapacity({table.name}, {table.capacity}).", table.where))
    return lines


def _edges(problem: Problem) -> list[ProgramLine]:
    wheres: tuple[Where | None, ...] = problem.layout.edge_where
    if len(wheres) != len(problem.layout.edges):
        wheres = (None,) * len(problem.layout.edges)
    return [
        ProgramLine(f"edge({a}, {b}).", where)
        for (a, b), where in zip(problem.layout.edges, wheres, strict=True)
    ]


def _one_way(problem: Problem) -> list[ProgramLine]:
    return [
        ProgramLine(line.text.replace("edge", "oneway", 1), line.where)
        for edge, line in zip(problem.layout.edges, _edges(problem), strict=True)
        if edge in problem.layout.one_way
    ]


def _timetable(problem: Problem, horizon: int) -> list[ProgramLine]:
    due = problem.layout.timetable
    return [
        ProgramLine(f"willbe({who}, {at}, {step}).") for who, step, at in due if 0 < step <= horizon
    ]


def _entrance(problem: Problem) -> list[ProgramLine]:
    where = next((w for key, w in problem.layout.key_where if key == "entrance"), None)
    return [ProgramLine(f"entrance({problem.layout.entrance}).", where)]


def _bar(problem: Problem) -> list[ProgramLine]:
    bar = problem.layout.bar
    return [] if bar is None else [ProgramLine(f"bar({node}).", bar.where) for node in bar.nodes]


Slot = Callable[[Problem, int], list[ProgramLine]]

SLOTS: dict[str, Slot] = {
    "directives": _directives,
    "offer": lambda problem, horizon: [],
    "steps": lambda problem, horizon: [ProgramLine(f"#step = 0..{horizon}.")],
    "numbers": lambda problem, _: [ProgramLine(f"#num = 0..{_numbers(problem)}.")],
    "goal_sort": lambda problem, _: [ProgramLine(f"#goal = 0..{len(all_goals(problem))}.")],
    "nodes": lambda problem, _: _braces("node", (node.name for node in problem.layout.nodes)),
    "tables": lambda problem, _: _braces("table", _tables(problem)),
    "customers": lambda problem, _: _braces("customer", _customers(problem)),
    "employees": lambda problem, _: _braces(
        "employee", [*problem.state.stations(), *(waiter for waiter, _ in problem.state.waiters)]
    ),
    "agents": lambda problem, _: _braces("agent", problem.state.stations()),
    "robots": lambda problem, _: [
        ProgramLine(f"robot({name}).") for name in problem.state.stations()
    ],
    "objects": lambda problem, _: _braces("object", objects_of(problem)),
    "refillables": lambda problem, _: _braces("refillable", refillables_of(problem)),
    "inertial_fluent": lambda problem, _: [
        ProgramLine(f"#inertial_fluent = {' + '.join(_inertial(problem, 'fluent'))}.")
    ],
    "action": lambda problem, _: [
        ProgramLine(f"#action = {' + '.join(_inertial(problem, 'action'))}.")
    ],
    "edges": lambda problem, _: _edges(problem),
    "one_way": lambda problem, _: _one_way(problem),
    "table_facts": lambda problem, _: _table_facts(problem),
    "entrance": lambda problem, _: _entrance(problem),
    "bar": lambda problem, _: _bar(problem),
    "timetable": _timetable,
    "state": lambda problem, _: state_facts(problem),
    "observations": lambda problem, _: observation_facts(problem),
    "goals": lambda problem, _: goal_facts(problem, parts_of(problem)),
    "guest_state": lambda problem, _: guest_state(problem),
    "guest_goals": lambda problem, _: guest_goals(problem),
}
