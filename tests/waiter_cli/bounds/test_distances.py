"""Distances around those who stand, and who of them will move."""

from __future__ import annotations

from tests.support.hall import HALL, posed
from waiter_cli.bounds.distances import FAR, WalkDistances, standing
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import State


def test_ways_lead_around_those_who_stand() -> None:
    problem = posed(State("a"))
    free, shut = WalkDistances(problem, ()), WalkDistances(problem, ["b"])
    a, b, e = (free.number[name] for name in "abe")
    assert free.row(a)[e] == 3
    assert [free.names[node] for node in free.path(a, e)] == ["b", "d", "e"]
    assert shut.row(a)[e] == FAR
    assert shut.row(b)[e] == 2  # from where one stands one may leave
    assert shut.bar == () and shut.nodes_of == {"big": (a,), "small": ()}


def test_who_moves_is_told_from_who_stays() -> None:
    layout = Layout(
        **{name: getattr(HALL, name) for name in ("name", "nodes", "edges", "entrance", "tables")},
        agent="a",
        waiters=(("v", "c"), ("w", "d")),
        timetable=(("v", 0, "b"), ("w", 3, "e"), ("w", 5, "c")),
    )
    state = State("a", waiters=layout.waiters)
    staff = standing(Problem(layout, state, (), state, ()))
    assert staff.now == {"v": "b", "w": "d"}
    assert staff.fixed == {"v": "b"}
    assert staff.after == {"v": "b", "w": "c"}
    assert staff.last == 5
