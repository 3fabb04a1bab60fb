"""`Layout` → the changes of it that are worth a look. Entry point `changes`.

A change is one more edge, a table moved to a free node, or two tables that swap places.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from math import inf
from time import monotonic

from sparc import limits
from sparc.lazy_dataclass import dataclass
from waiter_cli.model.geometry import beside, distance_to_segment
from waiter_cli.model.layout import Layout, Point, Table

__all__ = ["ChangesEnded", "LayoutChange", "changes", "passed"]

CLEAR = 0.3
"""An edge that passes a third node closer than this, in metres, is no way of its own."""


@dataclass(frozen=True)
class LayoutChange:
    """One change: ``kind`` is ``edge``, ``move`` or ``swap``; ``text`` says it in words."""

    kind: str
    text: str
    layout: Layout
    edge: tuple[str, str] | None = None
    tables: tuple[str, ...] = ()


class ChangesEnded(Exception):
    """A limit was reached while changes were made; ``limit`` is ``time`` or ``memory``."""

    def __init__(self, limit: str) -> None:
        super().__init__(limit)
        self.limit = limit


def passed(end: float) -> str:
    """Returns the limit that is passed; empty where none is.  ``end`` is of `time.monotonic`."""
    return "time" if monotonic() > end else limits.reached() or ""


def changes(
    layout: Layout,
    used: set[str] | None,
    edges: bool = True,
    tables: bool = True,
    end: float = inf,
) -> Iterator[LayoutChange]:
    """Yields every change that may be worth a look.

    Tables only where one of those ``used`` is moved.

    Raises `ChangesEnded` at ``end`` (of `time.monotonic`), or where the memory is used up.
    """
    if edges:
        yield from _edges(layout, end)
    if not tables:
        return
    wanted = [t for t in layout.tables if used is None or t.name in used]
    taken = {node for table in layout.tables for node in table.nodes}
    taken |= {layout.entrance, *(layout.bar.nodes if layout.bar else ())}
    for table in wanted:
        for node in layout.nodes:
            if limit := passed(end):
                raise ChangesEnded(limit)
            if node.name not in taken:
                moved = _moved(layout, table, node.name)
                text = f"move {table.name} to {node.name}"
                yield LayoutChange("move", text, moved, tables=(table.name,))
    for one, other in combinations(layout.tables, 2):
        if one in wanted or other in wanted:
            text = f"swap {one.name} and {other.name}"
            yield LayoutChange(
                "swap", text, _swapped(layout, one, other), tables=(one.name, other.name)
            )


def _edges(layout: Layout, end: float) -> Iterator[LayoutChange]:
    """Edges that are not there: straight, past no other node, through no furniture."""
    near = layout.joined()
    places = {node.name: node.at for node in layout.nodes}
    timed = all(at is not None for at in places.values())
    blocks = None
    if timed:
        from waiter_cli.room.room import ROBOT, build_room, nearest_on_walk

        room = build_room(layout)
        places.update(room.nodes)
        solid = [*room.tables.values(), *room.walls, *([room.bar] if room.bar else [])]

        def blocked(start: Point, end: Point) -> bool:
            return nearest_on_walk(start, end, solid)[1] < ROBOT

        blocks = blocked
    for a, b in combinations((node.name for node in layout.nodes), 2):
        if limit := passed(end):
            raise ChangesEnded(limit)
        if b in near[a]:
            continue
        start, goal = places[a], places[b]
        if blocks is None or start is None or goal is None:
            around = {far for one in near[a] for far in near[one]}
            around |= {far for one in around for far in near[one]}
            if near[a] and near[b] and b not in around:
                continue
        else:
            if any(
                at is not None and distance_to_segment(at, (start, goal)) < CLEAR
                for name, at in places.items()
                if name not in (a, b)
            ) or blocks(start, goal):
                continue
        layout_ = replace(layout, edges=(*layout.edges, (a, b)), edge_where=())
        yield LayoutChange("edge", f"add the edge {a}-{b}", layout_, edge=(a, b))


def _moved(layout: Layout, table: Table, node: str) -> Layout:
    """Returns the layout with a table beside another node."""
    stand = layout.node(node).at
    at = None
    if stand is not None:
        places = {n.name: n.at for n in layout.nodes}
        ends = [(places[a], places[b]) for a, b in layout.edges]
        ways = [(a, b) for a, b in ends if a is not None and b is not None]
        others = [t.at for t in layout.tables if t.name != table.name and t.at is not None]
        at = beside(stand, table.size, ways, others)
    return _with_tables(layout, {table.name: replace(table, nodes=(node,), at=at)})


def _swapped(layout: Layout, one: Table, other: Table) -> Layout:
    return _with_tables(
        layout,
        {
            one.name: replace(one, nodes=other.nodes, at=other.at),
            other.name: replace(other, nodes=one.nodes, at=one.at),
        },
    )


def _with_tables(layout: Layout, changed: dict[str, Table]) -> Layout:
    tables = tuple(changed.get(table.name, table) for table in layout.tables)
    return replace(layout, tables=tables)
