"""A hall of five nodes with a bar and two tables, in which parts of the bounds can be counted by hand."""

from __future__ import annotations

from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

__all__ = ["HALL", "posed"]

HALL = Layout(
    name="hall",
    nodes=tuple(map(Node, "abcde")),
    edges=(("a", "b"), ("b", "c"), ("c", "d"), ("b", "d"), ("d", "e")),
    entrance="e",
    tables=(
        Table("big", 4, ("c", "a"), None, (0.8, 0.8), 4),
        Table("small", 2, ("d",), None, (0.8, 0.8), 2),
    ),
    agent="a",
    bar=Bar(("b",)),
    objects=("plate", "jug"),
)


def posed(state: State, *goals: Goal, instant: bool = False) -> Problem:
    """A problem in the hall."""
    return Problem(HALL, state, (), state, goals, instant_kitchen=instant)
