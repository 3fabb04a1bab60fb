"""The hall in which the rules of one step are tried, and short words for its states and plans.

The colleague w stands on c, the bar is at a:

    a — b — c        big (4) at b and d, small (2) at d
        |
        d — e        e is the entrance
"""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

__all__ = ["HALL", "JUG", "LED", "ONE", "PLATE", "START", "act", "at", "plan", "posed"]

HALL = Layout(
    name="hall",
    nodes=tuple(map(Node, "abcde")),
    edges=(("a", "b"), ("b", "c"), ("b", "d"), ("e", "d")),
    entrance="e",
    tables=(
        Table("big", 4, ("b", "d"), None, (0.8, 1.6), 4),
        Table("small", 2, ("d",), None, (0.8, 0.8), 2),
    ),
    agent="a",
    waiters=(("w", "c"),),
    bar=Bar(("a",)),
    objects=("plate", "jug", "basket"),
)
START = State("a", waiters=(("w", "c"),), chairs=(("big", 4), ("small", 2)))


def posed(state: State, *goals: Goal, layout: Layout = HALL, **more: object) -> Problem:
    """A problem in the hall."""
    return Problem(layout, state, (), state, goals, **more)  # type: ignore[arg-type]


def act(text: str, step: int = 0) -> Action:
    """The action that a text such as ``go_to(agent,b)`` names."""
    name, _, rest = text.partition("(")
    return Action(step, name, tuple(rest.removesuffix(")").split(",")))


def plan(*texts: str) -> Plan:
    """The plan of these actions, one a step; an empty text is an idle step."""
    return Plan(tuple(act(t, step) for step, t in enumerate(texts) if t), len(texts))


def at(node: str, **what: object) -> State:
    """START with the agent at ``node`` and other things changed; lists of tables as words."""
    sets = {key: frozenset(v.split()) if isinstance(v, str) else v for key, v in what.items()}
    return replace(START, agent=node, **sets)  # type: ignore[arg-type]


ONE = (("big", ("c1",)),)
PLATE = frozenset({("big", "plate")})
JUG = frozenset({("big", "jug")})
LED = ("c1", "c2")
