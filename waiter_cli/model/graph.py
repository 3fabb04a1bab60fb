"""A graph → the nodes whose loss splits it. Entry point `cuts`.

One depth-first search with low points (Hopcroft and Tarjan, 1973, "Algorithm 447"): a node cuts off
the part below a child that has no way around it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable, Iterator
from random import Random
from typing import NamedTuple

from waiter_cli.errors import Fault
from waiter_cli.model.layout import Layout

__all__ = ["Cut", "cuts", "distances", "find_cut", "layout_warnings", "reachable"]


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


def distances(layout: Layout, start: str, shut: Collection[str] = ()) -> dict[str, int]:
    """How many edges lead from ``start`` to each node that can be reached round the shut ones."""
    near = layout.neighbours()
    found = {start: 0}
    queue = deque(found)
    while queue:
        here = queue.popleft()
        for there in near[here]:
            if there not in found and there not in shut:
                found[there] = found[here] + 1
                queue.append(there)
    return found


def reachable(near: dict[str, tuple[str, ...]], start: str, closed: Iterable[str]) -> set[str]:
    """The nodes that can be walked to from ``start`` without entering a closed one."""
    shut, found, rest = set(closed), {start}, [start]
    while rest:
        for node in near[rest.pop()]:
            if node not in found and node not in shut:
                found.add(node)
                rest.append(node)
    return found


def find_cut(
    rng: Random, near: dict[str, tuple[str, ...]], entrance: str
) -> tuple[str, str] | None:
    """A node that one waiter can block, and a node cut off by it from the entrance."""
    names = list(near)
    within = reachable(near, entrance, ())
    for post in rng.sample(names, len(names)):
        if post != entrance and post in within:
            away = within - reachable(near, entrance, (post,)) - {post}
            if away:
                return post, rng.choice(sorted(away))
    return None


def layout_warnings(layout: Layout) -> tuple[Fault, ...]:
    """What is legal but looks wrong: nodes and tables that no path leads to, unused objects.

    Paths start where the robot stands; waiters in the way do not count, for they move.
    """
    neighbours = layout.neighbours()
    reached = {layout.agent}
    frontier = [layout.agent]
    while frontier:
        for node in neighbours[frontier.pop()]:
            if node not in reached:
                reached.add(node)
                frontier.append(node)
    found: list[Fault] = []
    mend = "add an edge that leads there"
    for node_ in layout.nodes:
        if node_.name not in reached:
            what = "the entrance " if node_.name == layout.entrance else "node "
            found.append(
                Fault(
                    node_.where,
                    f"{what}{node_.name} cannot be reached from {layout.agent}, where the robot starts",
                    mend,
                )
            )
    for table in layout.tables:
        if not reached.intersection(table.nodes):
            only = ", ".join(table.nodes)
            found.append(
                Fault(
                    table.where,
                    f"table {table.name} cannot be reached: no path leads from {layout.agent} to {only}",
                    mend,
                )
            )
    places = dict(layout.key_where)
    if layout.bar is None and "objects" in places:
        found.append(
            Fault(
                places["objects"],
                "objects do nothing without a bar",
                "add bar: [NODE], or leave objects out",
            )
        )
    return tuple(found)
