"""A smaller floor with the same distances: nodes without a job are taken out of it.

Entry points `floor_of` and `contract`.  A node without a job is a dead end, a stretch of corridor or
a small crossing; its neighbours are joined instead.  An edge no shorter than a way round it is left
out.  Both keep every distance between the nodes that stay, and a walk over the old floor has one
over the new that is no longer and passes every node it kept: what bounds the new bounds the old.
"""

from __future__ import annotations

import heapq
from collections.abc import Collection

from waiter_cli.bounds.distances import FAR, WalkDistances

__all__ = ["Floor", "contract", "floor_of"]

Floor = dict[int, dict[int, int]]
"""For each node those that can be walked to from it, and in how many steps."""

_CROSSING = 3
"""A node with more neighbours stays: taking it out would make more edges than it has."""


def floor_of(walks: WalkDistances, start: int) -> Floor:
    """Returns what can be reached from ``start`` over open nodes, a step for each edge."""
    row = walks.row(start)
    inside = {n for n in range(len(row)) if row[n] < FAR and (n == start or n not in walks.shut)}
    return {here: {there: 1 for there in walks.near[here] if there in inside} for here in inside}


def contract(floor: Floor, kept: Collection[int]) -> Floor:
    """Returns the floor with the nodes ``kept`` and a few others, distances as before."""
    near = {here: dict(line) for here, line in floor.items()}
    back: Floor = {here: {} for here in near}
    for here, line in near.items():
        for there, steps in line.items():
            back[there][here] = steps

    def join(a: int, b: int, steps: int) -> None:
        near[a][b] = back[b][a] = steps

    keep = set(kept)
    queue = [node for node in sorted(near) if node not in keep]
    while queue:
        here = queue.pop()
        if here not in near or len(near[here].keys() | back[here].keys()) > _CROSSING:
            continue
        after, before = near.pop(here), back.pop(here)
        for node in after:
            del back[node][here]
        for node in before:
            del near[node][here]
        for a in before:
            for b in after:
                steps = before[a] + after[b]
                if a != b and steps < near[a].get(b, FAR) and not _way_round(near, a, b, steps):
                    join(a, b, steps)
        queue += [node for node in sorted(after.keys() | before.keys()) if node not in keep]
    for a in sorted(near):
        for b in sorted(near[a], key=lambda b: -near[a][b]):
            if near[a][b] > 1:
                steps = near[a].pop(b)
                del back[b][a]
                if not _way_round(near, a, b, steps):
                    join(a, b, steps)
    return near


def _way_round(near: Floor, source: int, target: int, most: int) -> bool:
    """Returns whether a way of at most ``most`` steps leads from one node to another."""
    seen: dict[int, int] = {source: 0}
    queue = [(0, source)]
    while queue:
        steps, here = heapq.heappop(queue)
        if here == target:
            return True
        for there, way in near[here].items():
            total = steps + way
            if total <= most and total < seen.get(there, FAR):
                seen[there] = total
                heapq.heappush(queue, (total, there))
    return False
