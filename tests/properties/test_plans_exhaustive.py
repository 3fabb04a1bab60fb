"""Plans of small restaurants are as short as trying everything allows, and so are refusals right.

Each case is a restaurant by chance (`tests/support/small_worlds.py`).  Its least number of steps is
found twice: by breadth-first search over all its states, and by the SPARC program.  Half of the
cases leave out the module of bounds and hints.  The default run takes some tens of worlds, ``-m wide``
`FULL` ones of the whole service, `ONE_WAY` ones with paths of one way and `SIMPLE` ones of four
actions; ``-m slow`` takes thousands more.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import pytest

from tests.support.exhaustive import shortest
from tests.support.sampling import mostly_wide
from tests.support.small_worlds import one_way_problem, small_case
from waiter_cli import find_translator
from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchOptions, SearchStatus
from waiter_cli.planning.strategies import find_minimal_plan
from waiter_cli.rules.validator import run

FULL, SIMPLE, ONE_WAY = 40, 20, 20
BLOCK = 10
SLOW = (*range(0, 340, BLOCK), *range(1000, 4300, BLOCK))
SLOW_SIMPLE = range(0, 200, BLOCK)
SLOW_ONE_WAY = (0, *range(1000, 3000, 100))
SLOW_REPORT = (*range(0, 40, BLOCK), *range(1000, 1400, BLOCK))


def check(
    seed: int,
    *,
    full: bool,
    domain: str = "restaurant",
    bounds: bool,
    problem: Problem | None = None,
) -> None:
    """The planner and exhaustive search agree on one world."""
    problem = problem or small_case(seed, full=full).problem
    expected = shortest(problem).length
    result = find_minimal_plan(
        problem,
        find_translator(),
        find_domain(domain),
        SearchOptions(use_bounds=bounds),
    )
    case = f"small_case({seed}, full={full}), {domain}, bounds {bounds}"
    if expected is None:
        assert result.status is SearchStatus.NO_PLAN, case
        assert result.reasons, case
        return
    assert result.status is SearchStatus.PLAN and result.plan is not None, case
    assert result.plan.horizon == expected, case
    assert result.minimal and result.bounds == (expected, expected), case
    verdict = run(problem, result.plan)
    assert verdict.valid and verdict.makespan == expected, (case, verdict.reasons)


@pytest.mark.parametrize("first", mostly_wide(range(0, FULL, BLOCK), 0, 10))
def test_the_whole_service(first: int) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=True, bounds=seed % 2 == 0)


@pytest.mark.wide
@pytest.mark.parametrize("first", mostly_wide(range(0, ONE_WAY, BLOCK), 0))
def test_one_way_paths(first: int) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=True, bounds=seed % 3 > 0, problem=one_way_problem(seed))


@pytest.mark.slow
@pytest.mark.parametrize("first", SLOW_ONE_WAY)
def test_one_way_paths_by_the_thousand(first: int) -> None:
    for seed in range(first, first + 100):
        check(seed, full=True, bounds=seed % 3 > 0, problem=one_way_problem(seed))


def test_a_fair_part_of_the_worlds_with_one_way_paths_has_no_plan_for_their_sake() -> None:
    lost = 0
    for seed in range(150):
        problem = one_way_problem(seed)
        two_way = replace(problem, layout=replace(problem.layout, one_way=frozenset()))
        lost += shortest(problem).length is None and shortest(two_way).length is not None
    assert lost >= 15


@pytest.mark.parametrize("first", mostly_wide(range(0, SIMPLE, BLOCK), 0))
def test_the_simple_restaurant(first: int) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=False, bounds=seed % 2 == 0)


@pytest.mark.parametrize("first", [0])
def test_the_domain_of_the_report(first: int) -> None:
    for seed in range(first, first + 8):
        check(seed, full=False, domain="report", bounds=seed % 2 == 0)


@pytest.mark.slow
@pytest.mark.parametrize("first", SLOW)
@pytest.mark.parametrize("bounds", [True, False], ids=["bounds", "no_bounds"])
def test_thousands_of_worlds(first: int, bounds: bool) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=True, bounds=bounds)


@pytest.mark.slow
@pytest.mark.parametrize("first", SLOW_SIMPLE)
def test_hundreds_of_simple_restaurants(first: int) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=False, bounds=seed % 2 == 0)


@pytest.mark.slow
@pytest.mark.parametrize("first", SLOW_REPORT)
def test_hundreds_of_worlds_in_the_domain_of_the_report(first: int) -> None:
    for seed in range(first, first + BLOCK):
        check(seed, full=False, domain="report", bounds=seed % 2 == 0)


def test_the_worlds_of_a_run_are_varied_enough() -> None:
    lengths: list[int | None] = []
    used: Counter[str] = Counter()
    spoiled = set()
    for full, count in ((True, 80), (False, 60)):
        for seed in range(count):
            case = small_case(seed, full=full)
            found = shortest(case.problem)
            lengths.append(found.length)
            used.update(text.partition("(")[0] for text in found.plan if text)
            if found.length is None:
                spoiled.add(case.spoiled)
    total = len(lengths)
    assert total >= 140
    assert sum(length is not None and length >= 6 for length in lengths) >= total / 3
    assert sum(length is None for length in lengths) >= total / 5
    assert len(spoiled - {None}) >= 4
    assert len(used) == 10 and min(used.values()) >= 4, used
