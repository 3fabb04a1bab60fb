"""`deals`: which robot does which jobs, against all ways to deal them out."""

from __future__ import annotations

from itertools import product

import pytest

from tests.support.fleet_floors import aisle
from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.jobs import find_jobs
from waiter_cli.fleets.tour_table import NEVER, TourTable

EVENING = """\
state: {seated: {t2: [c1], t5: [c2]}, wants_bill: [t2, t5], ready_to_order: [t2]}
goals: [{paid: t2}, {paid: t5}, {sent: t2}]
"""


def deals_of(agents: str, scenario: str = EVENING) -> Deals:
    problem = aisle(agents, scenario)
    jobs = find_jobs(problem)
    assert jobs is not None
    return Deals(problem, TourTable(problem, jobs), jobs.ends)


@pytest.mark.parametrize("most", [10, 2])
def test_all_deals_within_a_length_the_shortest_first(most: int) -> None:
    deals = deals_of("r1: n2, r2: n4")
    offsets, table = deals.offsets, deals.table
    expected = {}
    for owners in product(range(2), repeat=3):
        sets = tuple(sum(1 << k for k in range(3) if owners[k] == r) for r in range(2))
        expected[sets] = max(
            int(costs[table.full - offsets[own], table.floor.number[robot.at]])
            for costs, own, robot in zip(deals.tables, sets, deals.robots)
        )
    length = sorted(expected.values())[3]
    found, whole = deals.within(length, most)
    rows = [tuple(row) for row in found.tolist()]
    kept = [sets for sets in expected if expected[sets] <= length]
    assert (len(rows), whole) == (min(most, len(kept)), most >= len(kept))
    assert set(rows) <= set(kept) and expected[rows[0]] == min(expected.values())
    assert deals.least() == min(expected.values())


def test_on_a_path_the_one_behind_never_gets_to_the_bar() -> None:
    assert deals_of("r1: n2, r2: n4").least() == 8  # r2 fetches the order of t2
    only_order = "state: {seated: {t2: [c1]}, ordered: {t2: r1}}\ngoals: [{sent: t2}]\n"
    assert deals_of("r1: n2, r2: n4", only_order).least() >= NEVER
