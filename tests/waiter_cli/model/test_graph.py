"""Searches in graphs, each held against a plain one."""

from __future__ import annotations

from random import Random

from waiter_cli.model.graph import cut_nodes, distances, reachable


def some_graph(rng: Random) -> dict[str, tuple[str, ...]]:
    names = [f"n{k}" for k in range(rng.randint(2, 9))]
    pairs = {frozenset(rng.sample(names, 2)) for _ in range(rng.randint(1, 12))}
    return {n: tuple(m for m in names if frozenset((n, m)) in pairs) for n in names}


def test_distances_are_what_relaxing_every_edge_settles_on() -> None:
    rng = Random(11)
    for _ in range(60):
        near = some_graph(rng)
        start, *others = near
        closed = set(rng.sample(others, rng.randint(0, len(others) // 2)))
        best = {start: 0}
        for _ in near:
            for here in [node for node in near if node in best]:
                for there in set(near[here]) - closed:
                    best[there] = min(best.get(there, 99), best[here] + 1)
        found = distances(near, start, closed)
        assert found == best
        assert list(found.values()) == sorted(found.values())
        assert reachable(near, start, closed) == set(best)


def test_a_start_may_be_closed_itself() -> None:
    near = {"a": ("b",), "b": ("a", "c"), "c": ("b",)}
    assert distances(near, "b", {"b", "c"}) == {"b": 0, "a": 1}


def test_cuts_are_what_taking_a_node_away_splits() -> None:
    rng = Random(7)
    for _ in range(60):
        near = some_graph(rng)
        start = next(iter(near))
        whole = reachable(near, start, ())
        found = {cut.node: cut.lost for cut in cut_nodes(near, start)}
        for node in whole - {start}:
            lost = whole - reachable(near, start, (node,)) - {node}
            assert {n for part in found.get(node, ()) for n in part} == lost
            for part in found.get(node, ()):
                assert reachable(near, part[0], (node,)) == set(part)
        rest = whole - {start}
        parts = []
        while rest:
            parts.append(reachable(near, min(rest), (start,)))
            rest -= parts[-1]
        kept = sorted(map(len, parts))[:-1]
        assert sorted(map(len, found.get(start, ()))) == kept
