"""Searches graphs that are given as the neighbours of each node.

Entry points `distances`, `reachable` and `cut_nodes`; `layout_warnings` applies them to a layout.
A graph is what `Layout.neighbours` returns: for every node the nodes one edge away.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from waiter_cli.errors import Fault
from waiter_cli.model.layout import Layout
from waiter_cli.model.wording import in_words

__all__ = [
    "Cut", "Graph", "cut_nodes", "distances", "layout_warnings", "no_way_back", "reachable",
    "reached_by_robots", "starting_places",
]  # fmt: skip

Graph: TypeAlias = Mapping[str, Sequence[str]]


class Cut(NamedTuple):
    """A node whose loss splits the graph, and the parts that are then cut off from the start."""

    node: str
    lost: tuple[tuple[str, ...], ...]


def distances(near: Graph, start: str, closed: Collection[str] = ()) -> dict[str, int]:
    """Returns how many edges lead from ``start`` to each node that can be reached, nearest first.

    No way leads over a ``closed`` node; ``start`` may be one.  Breadth first: nodes that are as far
    stand in the order in which their neighbours list them.

    >>> distances({"a": ("b", "c"), "b": ("a",), "c": ("a",)}, "b")
    {'b': 0, 'a': 1, 'c': 2}
    """
    steps = {start: 0}
    queue = [start]
    for here in queue:
        for there in near[here]:
            if there not in steps and there not in closed:
                steps[there] = steps[here] + 1
                queue.append(there)
    return steps


def reachable(near: Graph, start: str, closed: Collection[str] = ()) -> set[str]:
    """Returns the nodes that can be walked to from ``start`` without entering a closed one."""
    return set(distances(near, start, closed))


def cut_nodes(near: Graph, start: str) -> tuple[Cut, ...]:
    """Returns the nodes whose loss splits what can be reached from ``start``, depth first.

    Each comes with the parts that are then cut off from ``start``; ``start`` itself with all but
    the largest part.  Where some edge leads one way only each node is taken out in turn, and what
    is lost is one part, ``start`` itself left out.  Elsewhere one depth-first search with low points (Hopcroft and Tarjan, 1973,
    "Algorithm 447"): a node cuts off the part below a child that has no way around it.

    >>> cut_nodes({"a": ("b",), "b": ("a", "c"), "c": ("b",)}, "a")
    (Cut(node='b', lost=(('c',),)),)
    """
    if any(here not in near[there] for here in near for there in near[here]):
        return _cut_one_by_one(near, start)
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
    cuts = []
    for name in listed:
        parts = sorted(lost.get(name, ()), key=lambda part: order[part[0]])
        if name == start and parts:
            parts.remove(max(parts, key=len))
        if parts:
            cuts.append(Cut(name, tuple(parts)))
    return tuple(cuts)


def _cut_one_by_one(near: Graph, start: str) -> tuple[Cut, ...]:
    everywhere = distances(near, start)
    cuts = []
    for node in everywhere:
        if node != start:
            left = reachable(near, start, (node,))
            lost = tuple(name for name in everywhere if name not in left and name != node)
            if lost:
                cuts.append(Cut(node, (lost,)))
    return tuple(cuts)


def no_way_back(layout: Layout) -> tuple[str, ...]:
    """Returns the nodes that the robot can get to, and from there no more to the entrance.

    Empty where it cannot get to the entrance at all.

    >>> from waiter_cli.model.layout import Node
    >>> nodes, edges = (Node("a"), Node("b"), Node("c")), (("a", "b"), ("b", "c"))
    >>> hall = Layout("hall", nodes, edges, "a", (), "a", one_way=frozenset({("b", "c")}))
    >>> no_way_back(hall)
    ('c',)
    """
    near = layout.neighbours()
    before: dict[str, list[str]] = {name: [] for name in near}
    for here, nodes in near.items():
        for there in nodes:
            before[there].append(here)
    reached, home = reached_by_robots(layout), reachable(before, layout.entrance)
    if layout.entrance not in reached:
        return ()
    return tuple(node.name for node in layout.nodes if node.name in reached - home)


def reached_by_robots(layout: Layout, shut: Collection[str] = ()) -> set[str]:
    """Returns the nodes to which some robot can get from where it starts, none of them ``shut``."""
    near = layout.neighbours()
    return {node for _, start in layout.starts for node in reachable(near, start, shut)}


def starting_places(layout: Layout) -> tuple[str, str]:
    """Returns the nodes where robots start, and those with what they are, for sentences.

    >>> from waiter_cli.model.layout import Node
    >>> starting_places(Layout("hall", (Node("a"), Node("b")), (("a", "b"),), "a", (), "a"))
    ('a', 'a, where the robot starts')
    """
    nodes = in_words(dict.fromkeys(node for _, node in layout.starts), "or")
    several = len(layout.starts) > 1
    return nodes, f"{nodes}, where the robot{'s start' if several else ' starts'}"


def layout_warnings(layout: Layout) -> tuple[Fault, ...]:
    """Returns what is legal but looks wrong: unreachable nodes and tables, objects without a use.

    Paths start where the robot stands; waiters in the way do not count, for they move.
    """
    reached, (start, starts) = reached_by_robots(layout), starting_places(layout)
    faults: list[Fault] = []
    mend = "add an edge that leads there"
    for node_ in layout.nodes:
        if node_.name not in reached:
            what = "the entrance " if node_.name == layout.entrance else "node "
            faults.append(
                Fault(
                    node_.where,
                    f"{what}{node_.name} cannot be reached from {starts}",
                    mend,
                )
            )
    for table in layout.tables:
        if not reached.intersection(table.nodes):
            only = ", ".join(table.nodes)
            faults.append(
                Fault(
                    table.where,
                    f"table {table.name} cannot be reached: no path leads from {start} to {only}",
                    mend,
                )
            )
    places = dict(layout.key_where)
    if layout.bar is None and "objects" in places:
        faults.append(
            Fault(
                places["objects"],
                "objects do nothing without a bar",
                "add bar: [NODE], or leave objects out",
            )
        )
    return tuple(faults)
