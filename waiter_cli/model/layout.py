"""The restaurant, `Layout`: its nodes, edges, tables, bar, staff and walls."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import Where
from waiter_cli.model.source_file import File

__all__ = ["OBJECTS", "REFILLABLES", "Bar", "Layout", "Node", "Point", "Table", "show_layouts_by"]

Point: TypeAlias = tuple[float, float]

OBJECTS = ("plate", "jug", "basket")
"""What a robot carries, and what guests may ask for."""
REFILLABLES = ("jug", "basket")
"""The objects that get empty, and are filled at the bar."""


@dataclass(frozen=True)
class Node:
    """A place the robot can stand; ``at`` in metres, None where the layout has no coordinates."""

    name: str
    at: Point | None = None
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Table:
    """A table: ``nodes`` it is reachable from, centre ``at`` and ``size`` (x, y) in metres."""

    name: str
    capacity: int
    nodes: tuple[str, ...]
    at: Point | None
    size: tuple[float, float]
    chairs: int
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Bar:
    """The nodes where orders are sent and jugs are filled.

    Drawn from corner to corner when both are given.
    """

    nodes: tuple[str, ...]
    corners: tuple[Point, Point] | None = None
    where: Where | None = field(default=None, compare=False)


_drawer: Callable[[Layout], str | None] | None = None


def show_layouts_by(drawer: Callable[[Layout], str | None]) -> None:
    """Names what draws layouts in a notebook: a function from a layout to SVG, or to None."""
    global _drawer
    _drawer = drawer


@dataclass(frozen=True)
class Layout:
    """A restaurant, valid by construction: every name refers to something that exists.

    ``edges`` are paths between two nodes, each listed once as written: two-way, but for those in
    ``one_way``, which the robot walks from the first node to the second only.  ``waiters`` are sorted pairs (waiter,
    node); ``timetable`` triples (waiter, step, node), sorted by step.  ``objects`` is empty
    where there is no bar.  ``walls`` are segments in metres.

    ``agents`` are the robots and where they start, in the order of the file, where the layout has
    several; ``agent`` is then where the first one starts.  One robot is called ``agent``.

    ``origin`` is the file it was read from, None where it was read from a mere text.
    ``edge_where`` goes with ``edges``.  ``key_where`` says where in the file the other things
    stand: ``name nodes edges tables entrance agent agents waiters bar objects customers`` for the keys
    that are there, ``waiters.w1`` and ``timetable.w1.3`` for single entries.
    """

    name: str
    nodes: tuple[Node, ...]
    edges: tuple[tuple[str, str], ...]
    entrance: str
    tables: tuple[Table, ...]
    agent: str
    waiters: tuple[tuple[str, str], ...] = ()
    bar: Bar | None = None
    objects: tuple[str, ...] = ()
    timetable: tuple[tuple[str, int, str], ...] = ()
    walls: tuple[tuple[Point, Point], ...] = ()
    customers: int = 0
    one_way: frozenset[tuple[str, str]] = frozenset()
    agents: tuple[tuple[str, str], ...] = ()
    file: str = ""
    origin: File | None = field(default=None, compare=False, repr=False)
    edge_where: tuple[Where, ...] = field(default=(), compare=False, repr=False)
    key_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)

    def __str__(self) -> str:
        """Returns what a person wants to know first, on one line: the name, and how much there is of what."""
        robots = len(self.agents) or 1
        seats = sum(table.capacity for table in self.tables)
        parts = [
            f"{len(self.nodes)} nodes", f"{len(self.edges)} paths",
            f"{len(self.tables)} tables for {seats} guests",
            f"{robots} robots" if robots > 1 else "1 robot",
        ]  # fmt: skip
        if self.waiters:
            parts.append(f"other staff: {', '.join(name for name, _ in self.waiters)}")
        return f"{self.name}: {', '.join(parts)}{', a bar' if self.bar else ''}"

    def _repr_svg_(self) -> str | None:
        """Returns the drawing that a notebook shows; None before `show_layouts_by` named a drawer."""
        return None if _drawer is None else _drawer(self)

    @property
    def starts(self) -> tuple[tuple[str, str], ...]:
        """Returns the robots and where they start; a single one is called ``agent``."""
        return self.agents or (("agent", self.agent),)

    def node(self, name: str) -> Node:
        """Returns the node of that name; KeyError when there is none."""
        return self._nodes[name]

    @cached_property
    def _nodes(self) -> dict[str, Node]:
        return {node.name: node for node in self.nodes}

    def table(self, name: str) -> Table:
        """Returns the table of that name; KeyError when there is none."""
        for table in self.tables:
            if table.name == name:
                return table
        raise KeyError(name)

    def leads(self, start: str, end: str) -> bool:
        """Returns whether an edge leads from ``start`` to ``end``."""
        back, edges = (end, start), self._edges
        return (start, end) in edges or (back in edges and back not in self.one_way)

    @cached_property
    def _edges(self) -> frozenset[tuple[str, str]]:
        return frozenset(self.edges)

    def neighbours(self) -> dict[str, tuple[str, ...]]:
        """Returns for each node the nodes that an edge leads to from it, in the order of the file."""
        return self._near(self.one_way)

    def joined(self) -> dict[str, tuple[str, ...]]:
        """Returns for each node the nodes that an edge joins it to: people may walk a path either way."""
        return self._near(frozenset())

    def _near(self, one_way: frozenset[tuple[str, str]]) -> dict[str, tuple[str, ...]]:
        out: dict[str, list[str]] = {node.name: [] for node in self.nodes}
        for a, b in self.edges:
            if b not in out[a]:
                out[a].append(b)
            if a not in out[b] and (a, b) not in one_way:
                out[b].append(a)
        return {name: tuple(near) for name, near in out.items()}
