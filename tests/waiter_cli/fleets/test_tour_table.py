"""`tour_table`: least steps of one robot's tours, against all orders tried one by one."""

from __future__ import annotations

from itertools import permutations

import pytest

from tests.support.fleet_floors import aisle, square
from waiter_cli.fleets.jobs import find_jobs
from waiter_cli.fleets.tour_table import NEVER, TourTable

BILLS = (
    "state: {seated: {t2: [c1], t5: [c2]}, wants_bill: [t2, t5]}\ngoals: [{paid: t2}, {paid: t5}]\n"
)


def table_of(problem) -> TourTable:  # type: ignore[no-untyped-def]
    jobs = find_jobs(problem)
    assert jobs is not None
    return TourTable(problem, jobs)


def test_each_set_of_jobs_has_its_least_tour() -> None:
    problem = aisle("r1: n3, r2: n4", BILLS)
    table = table_of(problem)
    costs, offsets = table.costs(), table.offsets()
    at = table.floor.number["n3"]
    places = (1, 4)  # n2 and n5, numbered from 0
    for jobs in range(4):
        chosen = [places[k] for k in range(2) if jobs >> k & 1]
        expected = min(
            sum(abs(a - b) for a, b in zip((2, *order), order)) + len(order)
            for order in permutations(chosen)
        )
        assert costs[table.full - offsets[jobs], at] == expected


def test_a_tour_ends_where_it_has_to_and_keeps_off_what_is_out_of_bounds() -> None:
    problem = aisle("r1: n3, r2: n4", BILLS)
    table = table_of(problem)
    number, both = table.floor.number, table.offsets()[3]
    assert table.costs()[table.full - both, number["n3"]] == 6
    assert table.costs("n3")[table.full - both, number["n3"]] == 8
    shut = table.costs(None, frozenset({"n5"}))
    assert shut[table.full - both, number["n3"]] >= NEVER
    assert shut[table.full - table.offsets()[1], number["n3"]] == 2


@pytest.mark.parametrize(
    ("state", "goals", "steps"),
    [
        ("waiting: [[c1], [c2]]", "[{seated: c1}, {seated: c2}]", 7),  # led one after the other
        ("empty: {tb: jug, td: jug}", "[{filled: {tb: jug}}, {filled: {td: jug}}]", 11),
        ("seated: {tb: [c1], td: [c2]}, ready_to_order: [tb, td]", "[{sent: tb}, {sent: td}]", 8),
        ("carrying: {r1: {tb: jug}}, empty: {tb: jug}", "[{filled: {tb: jug}}]", 4),
    ],
    ids=["parties", "hands", "orders", "in hand"],
)
def test_hands_and_lead_hold_one_thing_at_a_time(state: str, goals: str, steps: int) -> None:
    problem = square("r1: a, r2: c", f"state: {{{state}}}\ngoals: {goals}\n")
    table = table_of(problem)
    robot = problem.state.robots[0]
    own = table.begun(robot)
    others = [k for k in range(len(table.jobs)) if k not in dict(own)]
    row = table.row_of([*own, *((k, 0) for k in others)])
    assert table.costs()[row, table.floor.number[robot.at]] == steps
