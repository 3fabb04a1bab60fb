"""YAML text → `Layout`: the restaurant. Entry points `read_layout` and `read_layout_file`."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from sparc.values import dataclass, field
from waiter_cli.exits import Fault
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from waiter_cli.resources import File

__all__ = [
    "Bar",
    "Layout",
    "Node",
    "Point",
    "Table",
    "layout_in",
    "layout_warnings",
    "read_layout",
    "read_layout_file",
]

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Node:
    """A place the robot can stand; ``at`` in metres, None where the layout has no coordinates."""

    name: str
    at: Point | None = None
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Table:
    """A table: ``nodes`` it is reachable from, centre ``at`` and ``size`` (x, y) in metres."""

    name: str
    capacity: int
    nodes: tuple[str, ...]
    at: Point | None
    size: tuple[float, float]
    chairs: int
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Bar:
    """Where orders are sent and jugs are filled; drawn from corner to corner when both are given."""

    nodes: tuple[str, ...]
    corners: tuple[Point, Point] | None = None
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Layout:
    """A restaurant, valid by construction: every name refers to something that exists.

    ``edges`` are two-way, each listed once as written.  ``waiters`` are sorted pairs (waiter,
    node); ``timetable`` triples (waiter, step, node), sorted by step.  ``objects`` is empty
    where there is no bar.  ``walls`` are segments in metres.

    ``origin`` is the file it was read from, None where it was read from a mere text.
    ``edge_where`` goes with ``edges``.  ``key_where`` says where in the file the other things
    stand: ``name nodes edges tables entrance agent waiters bar objects customers`` for the keys
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
    file: str = ""
    origin: File | None = field(default=None, compare=False, repr=False)
    edge_where: tuple[Where, ...] = field(default=(), compare=False, repr=False)
    key_where: tuple[tuple[str, Where], ...] = field(default=(), compare=False, repr=False)

    def node(self, name: str) -> Node:
        """The node of that name; KeyError when there is none."""
        for node in self.nodes:
            if node.name == name:
                return node
        raise KeyError(name)

    def table(self, name: str) -> Table:
        """The table of that name; KeyError when there is none."""
        for table in self.tables:
            if table.name == name:
                return table
        raise KeyError(name)

    def neighbours(self) -> dict[str, tuple[str, ...]]:
        """For every node the nodes one edge away, in the order of the file."""
        out: dict[str, list[str]] = {node.name: [] for node in self.nodes}
        for a, b in self.edges:
            if b not in out[a]:
                out[a].append(b)
            if a not in out[b]:
                out[b].append(a)
        return {name: tuple(found) for name, found in out.items()}


def read_layout(text: str, name: str) -> Layout:
    """The layout that a YAML text describes; ``name`` is the file's name in messages.

    Raises `LayoutError` with every fault that was found, each with its line and column.
    """
    from waiter_cli.layout_reader import read

    return read(text, name)


def read_layout_file(name: str, argument: str = "--layout") -> Layout:
    """The layout of a file, of a built-in name such as ``report``, or (``-``) of standard input.

    Raises `LayoutError` as `read_layout`, and at ``argument`` where there is no such file or built-in.
    """
    from waiter_cli.resources import read_text

    file = read_text(name, "layout", where=Where(argument))
    return layout_in(file)


def layout_in(file: File, named: Where | None = None) -> Layout:
    """The layout in a file that was read; raises `LayoutError` as `read_layout`.

    ``named`` is the place of another file that names it: nothing of a file that is no layout is
    shown then.
    """
    from waiter_cli.kinds import told_as_it_is
    from waiter_cli.layout_reader import read

    with told_as_it_is(file.text, file.shown, "a layout", named):
        return read(file.text, file.shown, file)


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
