"""`narrow_rows`: paths on which robots keep their order."""

from __future__ import annotations

from tests.support.fleet_floors import AISLE, aisle, posed, square
from waiter_cli.fleets.narrow_rows import floor_parts, narrow_rows, out_of_bounds


def test_robots_on_a_path_leave_its_tips_to_those_before_them() -> None:
    problem = aisle("r1: n4, r2: n2, r3: n5", "goals: []\n")
    ((row, robots),) = narrow_rows(problem)
    if row[0] != "n1":
        row, robots = row[::-1], robots[::-1]
    assert row == ["n1", "n2", "n3", "n4", "n5", "n6"]
    assert [robot.name for robot in robots] == ["r2", "r1", "r3"]
    assert out_of_bounds(problem) == {
        "r2": frozenset({"n5", "n6"}),
        "r1": frozenset({"n1", "n6"}),
        "r3": frozenset({"n1", "n2"}),
    }


def test_colleagues_who_never_move_divide_a_path() -> None:
    problem = posed(f"{AISLE}waiters: {{w: n3}}\n", "r1: n2, r2: n5", "goals: []\n")
    assert sorted(len(part) for part, _ in floor_parts(problem)) == [2, 3]
    assert out_of_bounds(problem) == {"r1": frozenset(), "r2": frozenset()}


def test_where_there_is_a_way_round_nobody_is_kept_out() -> None:
    assert out_of_bounds(square("r1: a, r2: c", "goals: []\n")) == {}
