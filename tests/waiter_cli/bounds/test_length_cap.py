"""How long a plan need be: from the places where something is done, however large the floor."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from waiter_cli.bounds import find_bounds
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.model.layout import Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem


def corridor(nodes: int, table: int, **more: Any) -> Problem:
    """A party to seat in a straight corridor, whose entrance is at the robot's end."""
    layout = Layout(
        name="corridor",
        nodes=tuple(Node(f"n{i}") for i in range(nodes)),
        edges=tuple((f"n{i}", f"n{i + 1}") for i in range(nodes - 1)),
        entrance="n0",
        tables=(Table("table1", 2, (f"n{table}",), None, (0.8, 0.8), 2),),
        agent="n0",
        **more,
    )
    return pose_problem(layout, enter=[1])


@pytest.fixture
def sources(monkeypatch: pytest.MonkeyPatch) -> set[int]:
    """The nodes from which distances were made."""
    made: set[int] = set()
    row = WalkDistances.row

    def noted(floor: WalkDistances, source: int) -> list[int]:
        made.add(source)
        return row(floor, source)

    monkeypatch.setattr(WalkDistances, "row", noted)
    return made


def test_distances_are_made_from_places_that_matter(sources: set[int]) -> None:
    bounds = find_bounds(corridor(3_000, 40))
    assert bounds.plan is not None
    assert (bounds.lower, bounds.plan.horizon) == (42, 42)
    assert sources == {0, 40}


def test_after_a_timetable_the_robot_may_stand_anywhere(sources: set[int]) -> None:
    timetable = (("w1", 3, "n298"), ("w1", 4, "n299"))
    problem = corridor(300, 40, waiters=(("w1", "n299"),), timetable=timetable)
    bounds = find_bounds(problem)
    assert bounds.cap is not None
    assert bounds.cap >= 4 + 298 + 2 + 40  # from its far end to the entrance, and to the table
    assert len(sources) <= 6


def test_ways_back_count_where_paths_lead_one_way() -> None:
    """On a ring that leads one way the node just beyond the table is farthest from it."""
    ring = corridor(31, 1, waiters=(("w1", "n30"),), timetable=(("w1", 2, "n30"),))
    edges = (*ring.layout.edges[:29], ("n29", "n0"))
    layout = replace(ring.layout, edges=edges, one_way=frozenset(edges))
    cap = find_bounds(replace(ring, layout=layout)).cap
    assert cap is not None and cap >= 2 + 2 + 2 * 29
