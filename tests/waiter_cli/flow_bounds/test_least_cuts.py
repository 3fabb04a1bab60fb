"""Least cuts, against all sets there are."""

from __future__ import annotations

from itertools import combinations
from random import Random

import pytest

from waiter_cli.flow_bounds.least_cuts import Net

Arcs = dict[tuple[int, int], int]


def smallest_short(
    arcs: Arcs, nodes: int, amounts: dict[int, int], wanted: int
) -> tuple[int, set[int]]:
    """How much gets through at most, and the smallest set that lets no more in, by looking at all.

    What may end outside of a set need not get into it.
    """
    best: tuple[int, int, set[int]] = (wanted, 0, set())
    for size in range(nodes):
        for some in combinations(range(1, nodes), size):
            inside = set(some)
            flow = sum(a for (t, h), a in arcs.items() if h in inside and t not in inside)
            flow += sum(amount for node, amount in amounts.items() if node not in inside)
            best = min(best, (flow, size, inside))
    return best[0], best[2]


@pytest.mark.parametrize("seed", range(150))
def test_the_smallest_least_cut_is_found(seed: int) -> None:
    rng = Random(seed)
    nodes, scale = rng.randint(2, 6), rng.choice([1, 1000, 1 << 18])
    arcs: Arcs = {}
    net = Net()
    for _ in range(rng.randint(1, 14)):
        tail, head = rng.randrange(nodes), rng.randrange(nodes)
        amount = scale * rng.randint(1, 4) + rng.randint(0, 3)
        net.join(tail, head, amount)
        if tail != head:
            arcs[tail, head] = arcs.get((tail, head), 0) + amount
    some = rng.sample(range(nodes), rng.randint(1, min(3, nodes)))
    amounts = {node: scale * rng.randint(1, 5) for node in some}
    wanted = scale * rng.randint(1, 8)
    flow, inside = smallest_short(arcs, nodes, amounts, wanted)
    found = net.short(0, amounts, wanted)
    assert (found is None) == (flow >= wanted)
    if found is not None:
        assert found == inside
    assert net.short(0, amounts, wanted) == found  # asking changes nothing
