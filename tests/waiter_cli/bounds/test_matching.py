"""Cheapest matchings and largest covers, beside all that there are."""

from __future__ import annotations

from itertools import combinations, permutations
from random import Random

from waiter_cli.bounds.distances import FAR
from waiter_cli.bounds.matching import cheapest, cover


def judge_matching(seed: int) -> None:
    rng = Random(seed)
    rows, columns = rng.randint(1, 4), rng.randint(4, 6)
    costs = [[rng.choice((FAR, *range(9))) for _ in range(columns)] for _ in range(rows)]
    ways = [
        (sum(costs[row][column] for row, column in enumerate(chosen)), chosen)
        for chosen in permutations(range(columns), rows)
    ]
    least = min(ways)[0]
    found = cheapest(costs, FAR)
    if least >= FAR:
        assert found is None
        return
    assert found is not None and found.cost == least
    assert len(set(found.column)) == rows
    for total, chosen in ways:
        if total < FAR:
            slack = sum(found.slack(row, column) for row, column in enumerate(chosen))
            assert total >= found.cost + slack >= found.cost


def test_cheapest_matching_is_the_least_of_all_and_its_prices_prove_it() -> None:
    for seed in range(60):
        judge_matching(seed)


def judge_cover(seed: int) -> None:
    rng = Random(seed)
    rows = [rng.sample(range(4), rng.randint(0, 3)) for _ in range(rng.randint(1, 5))]

    def fits(group: tuple[int, ...]) -> bool:
        return any(
            all(column in rows[row] for row, column in zip(group, chosen))
            for chosen in permutations(range(4), len(group))
        )

    found, stuck = cover(rows)
    everyone = tuple(range(len(rows)))
    assert all(column in rows[row] for row, column in found.items())
    assert len(found) == max(
        size for size in range(len(rows) + 1) if any(map(fits, combinations(everyone, size)))
    )
    assert bool(stuck) != fits(everyone)
    if stuck:
        assert not fits(stuck)
        assert all(fits(tuple(row for row in stuck if row != one)) for one in stuck)


def test_cover_is_largest_and_blames_a_smallest_group() -> None:
    for seed in range(60):
        judge_cover(seed)
