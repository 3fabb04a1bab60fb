"""Finds the guests that later events can concern: `Problem`, events → names.

Entry points `guests_to_come`, `names_in_use` and `require_guests`.
"""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.errors import Fault, InputError
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.spelling import did_you_mean

__all__ = ["guests_to_come", "names_in_use", "require_guests", "unknown_guest"]


def guests_to_come(problem: Problem, timed: Sequence[TimedEvent]) -> tuple[str, ...]:
    """Returns everybody who is inside or comes in by an event, each once."""
    inside = [name for party in problem.state.parties() for name in party]
    coming = [seen for event in timed for seen in event.observations if seen.kind == "enter"]
    return tuple(dict.fromkeys([*inside, *(name for seen in coming for name in seen.arguments)]))


def names_in_use(problem: Problem, timed: Sequence[TimedEvent]) -> set[str]:
    """Returns every name that a guest who is made up on the way cannot have."""
    layout = problem.layout
    names = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    names |= {name for name, _ in (*layout.waiters, *problem.state.waiters)} | {"agent"}
    names |= {name for party in problem.state.parties() for name in party}
    return names | {
        n for event in timed for observation in event.observations for n in observation.arguments
    }


def require_guests(problem: Problem, timed: Sequence[TimedEvent]) -> None:
    """Raises `InputError` for every event in which somebody leaves who never comes in."""
    known = guests_to_come(problem, timed)
    faults = [
        Fault(observation.where, f"unknown customer {name}", unknown_guest(name, known, problem))
        for event in timed
        for observation in event.observations
        if observation.kind == "leave"
        for name in observation.arguments
        if name not in known
    ]
    if faults:
        raise InputError(faults)


def unknown_guest(name: str, known: Sequence[str], problem: Problem) -> str:
    """Returns the mend for a name that is no guest's."""
    if name in {table.name for table in problem.layout.tables}:
        seated = [party for table, party in problem.state.seated if table == name]
        whom = f"who sits there: {seated[0][0]}" if seated else "a guest, such as c1"
        return f"{name} is a table; name {whom}"
    return did_you_mean(name, known) or "nobody is inside, and nobody comes in"
