"""A graph → the nodes whose loss splits it. Entry point `cuts`.

One depth-first search with low points (Hopcroft and Tarjan, 1973, "Algorithm 447"): a node cuts off
the part below a child that has no way around it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

__all__ = ["Cut", "cuts"]


class Cut(NamedTuple):
    """A node whose loss splits the floor, and the nodes that are then cut off from the start."""

    node: str
    lost: tuple[tuple[str, ...], ...]


def cuts(near: dict[str, tuple[str, ...]], start: str) -> tuple[Cut, ...]:
    """The nodes whose loss splits what can be reached from ``start``, in depth-first order.

    Each with the parts that are cut off from ``start``; for ``start`` itself all but the largest.

    >>> cuts({"a": ("b",), "b": ("a", "c"), "c": ("b",)}, "a")
    (Cut(node='b', lost=(('c',),)),)
    """
    order: dict[str, int] = {start: 0}
    low = {start: 0}
    listed = [start]
    path: list[tuple[str, str | None, Iterator[str]]] = [(start, None, iter(near[start]))]
    lost: dict[str, list[tuple[str, ...]]] = {}
    while path:
        here, parent, rest = path[-1]
        for node in rest:
            if node == parent:
                continue
            if node in order:
                low[here] = min(low[here], order[node])
                continue
            order[node] = low[node] = len(order)
            listed.append(node)
            path.append((node, here, iter(near[node])))
            break
        else:
            path.pop()
            if parent is not None:
                low[parent] = min(low[parent], low[here])
                if low[here] >= order[parent]:  # what was listed since is all below ``here``
                    lost.setdefault(parent, []).append(tuple(listed[order[here] :]))
    found = []
    for name in listed:
        parts = sorted(lost.get(name, ()), key=lambda part: order[part[0]])
        if name == start and parts:
            parts.remove(max(parts, key=len))
        if parts:
            found.append(Cut(name, tuple(parts)))
    return tuple(found)
