"""The keys of a layout file, one function each. Entry points `read_layout`, `read_layout_file`.

Source: contract, "Layout (YAML)".  Whatever is wrong is noted and reading goes on; a `Layout` is
made only when nothing was wrong.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.model.geometry import beside
from waiter_cli.model.layout import OBJECTS, Bar, Layout, Node, Point, Table
from waiter_cli.model.timetable import clashes
from waiter_cli.yaml_reading.node_reader import POINT_FORM, NodeReader, is_empty, is_identifier
from waiter_cli.yaml_reading.yaml_tree import Document, Listing, Mapping, Scalar, compose
from waiter_cli.yaml_reading.yaml_tree import Node as YamlNode

if TYPE_CHECKING:
    from waiter_cli.model.source_file import File

__all__ = [
    "EDGE_KEYS",
    "KEYS",
    "MAX_CUSTOMERS",
    "MAX_SEATS",
    "TABLE_KEYS",
    "layout_in",
    "one_robot",
    "read_document",
    "read_layout",
    "read_layout_file",
]

KEYS = (
    "name",
    "nodes",
    "edges",
    "entrance",
    "tables",
    "agent",
    "agents",
    "waiters",
    "bar",
    "objects",
    "timetable",
    "walls",
    "customers",
)
REQUIRED = ("nodes", "edges", "entrance", "tables", "agent")
EDGE_KEYS = ("from", "to")
TABLE_KEYS = ("capacity", "nodes", "at", "size", "chairs")
MAX_SEATS = 1000
MAX_CUSTOMERS = 10_000
MAX_STEP = 1_000_000
TABLE_SIZE = 0.8


def read_layout(text: str, name: str, origin: File | None = None) -> Layout:
    """Returns the layout that a YAML text describes; ``name`` is the file's name in messages.

    Raises `LayoutError` with every fault that was found, each with its line and column.
    """
    return read_document(compose(text, name), origin)


def read_document(document: Document, origin: File | None = None) -> Layout:
    """Returns the layout of a tree, which may stand inside another file."""
    name = document.name
    reader = NodeReader(document)
    top = Where(name, 1, 1)
    if document.root is None or (
        isinstance(document.root, Scalar) and document.root.is_nothing and not reader.faults
    ):
        reader.fault(top, "the file is empty", "a layout begins with nodes, edges and tables")
        reader.finish()
    assert document.root is not None
    named = {key.text for key, _ in getattr(document.root, "entries", ())}
    if named & _OF_SCENARIOS and not named & {"nodes", "tables", "edges"}:
        hint = "give the layout that it names, or this file to a command's --scenario"
        reader.fault(document.root.where, "this is a scenario, not a layout", hint)
        reader.finish()
    keys = reader.mapping(document.root, "a layout", KEYS)
    if keys is None:
        reader.finish()
        raise AssertionError("a root that is no mapping is a fault")
    for key in REQUIRED:
        if key == "agent" and "agents" in keys:
            continue
        if reader.lacks(document.root, key, KEYS):
            reader.fault(document.root.where, f"the layout has no {key}", _REQUIRED_HINTS[key])
    return _LayoutReader(reader, keys, name, origin).read()


_OF_SCENARIOS = frozenset({"layout", "state", "observe", "goals", "events", "before", "prefer"})
_REQUIRED_HINTS = {
    "nodes": "add nodes: {n1: [0, 0]}, or a list of names",
    "edges": "add edges: [[n1, n2]], or [] when there are none",
    "entrance": "add entrance: NODE, where parties are picked up",
    "tables": "add tables: {table1: {capacity: 2, nodes: [n1]}}",
    "agent": "add agent: NODE, where the robot starts, or agents: {r1: NODE} for several",
}


class _Name(NamedTuple):
    kind: str
    where: Where


class _Edge(NamedTuple):
    start: str
    end: str
    one_way: bool
    where: Where


class _LayoutReader:
    """The names that were declared so far, and the readers of the single keys."""

    def __init__(
        self, reader: NodeReader, keys: dict[str, YamlNode], file: str, origin: File | None
    ) -> None:
        self.reader = reader
        self.keys = keys
        self.file = file
        self.origin = origin
        self.names: dict[str, _Name] = {}

    def read(self) -> Layout:
        name = self._name()
        nodes = self._nodes()
        known = frozenset(node.name for node in nodes)
        edges = self._edges(known)
        lines = _segments(nodes, edges)
        tables = self._tables(nodes, known, lines)
        entrance = self._node("entrance", known)
        agents = self._agents(known)
        agent = agents[0][1] if agents else self._node("agent", known)
        waiters = self._waiters(known)
        self._check_places(agent, agents, waiters)
        timetable = self._timetable(known, waiters)
        bar = self._bar(known)
        objects = self._objects()
        walls = self._walls()
        customers = 0
        if "customers" in self.keys:
            what = "customers, the number of names,"
            number = self.reader.integer(self.keys["customers"], what, 0, MAX_CUSTOMERS)
            customers = number or 0
        self.reader.finish()
        assert entrance is not None and agent is not None
        pairs = tuple((edge.start, edge.end) for edge in edges)
        places = [(key, node.where) for key, node in self.keys.items()]
        places += [(f"agents.{robot}", where) for robot, _, where in agents]
        places += [(f"waiters.{waiter}", where) for waiter, _, where in waiters]
        places += [(f"timetable.{waiter}.{step}", where) for waiter, step, _, where in timetable]
        return Layout(
            name=name,
            nodes=nodes,
            edges=pairs,
            entrance=entrance,
            tables=tables,
            agent=agent,
            waiters=tuple(sorted((waiter, node) for waiter, node, _ in waiters)),
            bar=bar,
            objects=objects if bar else (),
            timetable=tuple(
                sorted(
                    ((waiter, step, node) for waiter, step, node, _ in timetable),
                    key=lambda entry: (entry[1], entry[0]),
                )
            ),
            walls=walls,
            customers=customers,
            agents=tuple((robot, node) for robot, node, _ in agents),
            one_way=frozenset(pair for pair, edge in zip(pairs, edges) if edge.one_way),
            file=self.file,
            origin=self.origin,
            edge_where=tuple(edge.where for edge in edges),
            key_where=tuple(places),
        )

    # -- names ------------------------------------------------------------------------------

    def _name(self) -> str:
        if "name" in self.keys:
            return self.reader.text(self.keys["name"], "the layout's name") or ""
        stem = self.file.replace("\\", "/").rsplit("/", 1)[-1]
        return stem.rsplit(".", 1)[0] if is_identifier(stem.rsplit(".", 1)[0]) else "layout"

    def _declare(self, node: YamlNode, kind: str) -> str | None:
        """Returns a new name: legal, and not used before by anything that is in the same programs."""
        name = self.reader.name(node, f"a {kind}")
        if name is None:
            return None
        first = self.names.setdefault(name, _Name(kind, node.where))
        if first.where is node.where:
            return name
        if first.kind == kind:
            message = f"{kind} {name} is listed twice"
        else:
            message = f"{name} is a {first.kind} already, so no {kind} can be called that"
        mend = f"rename one of the two, the first is at line {first.where.line}"
        self.reader.fault(node.where, message, mend)
        return None

    def _node(self, key: str, known: frozenset[str]) -> str | None:
        if key not in self.keys:
            return None
        return self.reader.known(self.keys[key], key, "node", known)

    # -- the floor --------------------------------------------------------------------------

    def _nodes(self) -> tuple[Node, ...]:
        node = self.keys.get("nodes")
        if node is None:
            return ()
        nodes: list[Node] = []
        if isinstance(node, Listing):
            hint = "give every node a place (n1: [x, y]) or write a plain list of names"
            for item in node.items:
                if isinstance(item, Scalar):
                    name = self._declare(item, "node")
                    if name is not None:
                        nodes.append(Node(name, None, item.where))
                else:
                    self.reader.wrong(item, "a node in a list", "a name", hint)
        else:
            for key, value in self.reader.entries(node, "nodes") or ():
                name = self._declare(key, "node")
                at = self.reader.point(value, f"node {key.text}")
                if name is not None:
                    nodes.append(Node(name, at, key.where))
        if not nodes and not self.reader.faults:
            self.reader.fault(node.where, "there are no nodes", _REQUIRED_HINTS["nodes"])
        return tuple(nodes)

    def _edges(self, known: frozenset[str]) -> list[_Edge]:
        node = self.keys.get("edges")
        edges: list[_Edge] = []
        if node is None:
            return edges
        earlier: dict[frozenset[str], _Edge] = {}
        for item in self.reader.items(node, "edges", "write - [n1, n2] for each") or ():
            one_way = isinstance(item, Mapping) and any(
                key.text in EDGE_KEYS for key, _ in item.entries
            )
            ends: tuple[YamlNode, ...] | None
            ends = item.items if isinstance(item, Listing) else ()
            if one_way:
                ends = self._one_way_ends(item)
                if ends is None:
                    continue
            if len(ends) != 2:
                form = "write [n1, n2], or {from: n1, to: n2} for a path that leads one way only"
                self.reader.wrong(item, "an edge", "a pair of nodes [n1, n2]", form)
                continue
            a = self.reader.known(ends[0], "the end of an edge", "node", known)
            b = self.reader.known(ends[1], "the end of an edge", "node", known)
            if a is None or b is None:
                continue
            if a == b:
                self.reader.fault(item.where, f"edge from {a} to itself", "leave it out")
                continue
            edge = _Edge(a, b, one_way, item.where)
            first = earlier.setdefault(frozenset((a, b)), edge)
            if first is edge:
                edges.append(edge)
                continue
            mend = f"edges are two-way and this one is at line {first.where.line} already"
            if one_way or first.one_way:
                mend = f"line {first.where.line} joins them already; [{a}, {b}] leads both ways"
            self.reader.fault(item.where, f"duplicate edge {a}-{b}", mend)
        return edges

    def _one_way_ends(self, item: YamlNode) -> tuple[YamlNode, ...] | None:
        """Returns the two ends of ``{from: n1, to: n2}``, None where that is not what stands there."""
        keys = self.reader.mapping(item, "a one-way edge", EDGE_KEYS)
        if keys is None:
            return None
        for key in EDGE_KEYS:
            if self.reader.lacks(item, key, EDGE_KEYS):
                message = f"a one-way edge has no {key}"
                self.reader.fault(item.where, message, "write {from: n1, to: n2}")
        ends = tuple(keys[key] for key in EDGE_KEYS if key in keys)
        return ends if len(ends) == 2 else None

    def _walls(self) -> tuple[tuple[Point, Point], ...]:
        node = self.keys.get("walls")
        walls: list[tuple[Point, Point]] = []
        for item in self.reader.items(node, "walls") or () if node else ():
            ends = item.items if isinstance(item, Listing) else ()
            if len(ends) != 2:
                self.reader.wrong(item, "a wall", "a segment [[x, y], [x, y]]", POINT_FORM)
                continue
            start = self.reader.point(ends[0], "the start of a wall")
            end = self.reader.point(ends[1], "the end of a wall")
            if start is not None and end is not None:
                walls.append((start, end))
        return tuple(walls)

    # -- tables and bar ---------------------------------------------------------------------

    def _tables(
        self, nodes: Sequence[Node], known: frozenset[str], lines: list[tuple[Point, Point]]
    ) -> tuple[Table, ...]:
        places = {node.name: node.at for node in nodes}
        tables: list[Table] = []
        taken: list[Point] = []
        node = self.keys.get("tables")
        for key, value in self.reader.entries(node, "tables") or () if node else ():
            name = self._declare(key, "table")
            table = self._table(key, value, known)
            if name is None or table is None:
                continue
            stand = places[table.nodes[0]]
            if table.at is None and stand is not None:
                at = beside(stand, table.size, lines, taken)
                table = Table(
                    name, table.capacity, table.nodes, at, table.size, table.chairs, table.where
                )
            if table.at is not None:
                taken.append(table.at)
            tables.append(table)
        return tuple(tables)

    def _table(self, key: Scalar, value: YamlNode, known: frozenset[str]) -> Table | None:
        name = key.text[:40]
        keys = self.reader.mapping(value, f"table {name}", TABLE_KEYS)
        if keys is None:
            return None
        capacity = chairs = at = None
        size: tuple[float, float] | None = (TABLE_SIZE, TABLE_SIZE)
        if "capacity" in keys:
            what = f"capacity of {name}"
            capacity = self.reader.integer(keys["capacity"], what, 1, MAX_SEATS)
        elif self.reader.lacks(value, "capacity", TABLE_KEYS):
            self.reader.fault(key.where, f"table {name} has no capacity", "add capacity: 2")
        nodes: tuple[tuple[str, Where], ...] = ()
        what = f"nodes of {name}"
        if self.reader.lacks(value, "nodes", TABLE_KEYS):
            self.reader.fault(key.where, f"table {name} has no nodes", "add nodes: [NODE]")
        elif "nodes" in keys:
            nodes = self.reader.known_names(keys["nodes"], what, "node", known)
            empty = keys["nodes"]
            if is_empty(empty):
                self.reader.fault(
                    empty.where,
                    f"table {name} has no nodes, so nobody could serve it",
                    "name the nodes that it is reached from",
                )
        if "chairs" in keys:
            chairs = self.reader.integer(keys["chairs"], f"chairs of {name}", 0, MAX_SEATS)
            if chairs is not None and capacity is not None and chairs > capacity:
                message = f"table {name} has {chairs} chairs and room for {capacity}"
                self.reader.fault(keys["chairs"].where, message, "chairs are at most the capacity")
        if "at" in keys:
            at = self.reader.point(keys["at"], f"the centre of {name}")
        if "size" in keys:
            size = self._size(keys["size"], f"size of {name}")
        if capacity is None or not nodes or size is None:
            return None
        stand = tuple(node for node, _ in nodes)
        seats = capacity if chairs is None else chairs
        return Table(key.text, capacity, stand, at, size, seats, key.where)

    def _size(self, node: YamlNode, what: str) -> tuple[float, float] | None:
        size = self.reader.point(node, what, "two lengths [x, y] in metres")
        if size is not None and min(size) <= 0:
            message = f"{what} must be larger than 0 both ways"
            self.reader.fault(node.where, message, "give its lengths along x and y in metres")
            return None
        return size

    def _bar(self, known: frozenset[str]) -> Bar | None:
        node = self.keys.get("bar")
        if node is None or _is_nothing(node):
            return None
        corners: tuple[Point, Point] | None = None
        listed: YamlNode | None = node
        if isinstance(node, Mapping):
            keys = self.reader.mapping(node, "bar", ("nodes", "from", "to")) or {}
            listed = keys.get("nodes")
            if listed is None:
                self.reader.fault(node.where, "the bar has no nodes", "add nodes: [NODE]")
            ends = [key for key in ("from", "to") if key in keys]
            points = [self.reader.point(keys[key], f"{key} of the bar") for key in ends]
            if len(ends) == 1:
                missing = "to" if ends == ["from"] else "from"
                mend = f"add {missing}: [x, y], the opposite corner"
                self.reader.fault(node.where, f"the bar has {ends[0]} and no {missing}", mend)
            elif len(points) == 2 and points[0] is not None and points[1] is not None:
                corners = (points[0], points[1])
        nodes: tuple[tuple[str, Where], ...] = ()
        if listed is not None:
            nodes = self.reader.known_names(listed, "nodes of the bar", "node", known)
            if is_empty(listed):
                mend = "name its nodes, or leave bar out"
                self.reader.fault(listed.where, "the bar has no nodes", mend)
        return Bar(tuple(name for name, _ in nodes), corners, node.where)

    def _objects(self) -> tuple[str, ...]:
        node = self.keys.get("objects")
        listed: tuple[str, ...] = OBJECTS
        if node is not None:
            objects = self.reader.known_names(node, "objects", "object", OBJECTS)
            listed = tuple(name for name, _ in objects)
        if self.keys.get("bar") is None:
            return ()
        for name in listed:
            other = self.names.get(name)
            if other is not None:
                message = f"{name} is an object, so no {other.kind} can be called that"
                mend = "rename it, or leave the object out of objects"
                self.reader.fault(other.where, message, mend)
        return listed

    # -- staff ------------------------------------------------------------------------------

    def _waiters(self, known: frozenset[str]) -> list[tuple[str, str, Where]]:
        waiters: list[tuple[str, str, Where]] = []
        node = self.keys.get("waiters")
        for key, value in self.reader.entries(node, "waiters") or () if node else ():
            name = self._declare(key, "waiter")
            at = self.reader.known(value, f"the place of {key.text}", "node", known)
            if name is not None and at is not None:
                waiters.append((name, at, key.where))
        return waiters

    def _agents(self, known: frozenset[str]) -> list[tuple[str, str, Where]]:
        """The robots where there are several, in the order of the file."""
        agents: list[tuple[str, str, Where]] = []
        node = self.keys.get("agents")
        if node is None:
            return agents
        if "agent" in self.keys:
            message = "agent and agents are both given"
            mend = "agent: NODE is for one robot, agents: {r1: NODE, r2: NODE} for several"
            self.reader.fault(self.keys["agent"].where, message, mend)
        entries = self.reader.entries(node, "agents")
        if entries == ():
            self.reader.fault(node.where, "there are no robots", "write agents: {r1: NODE}")
        for key, value in entries or ():
            name = self._declare(key, "robot")
            at = self.reader.known(value, f"the place of {key.text}", "node", known)
            if name is not None and at is not None:
                agents.append((name, at, key.where))
        return agents

    def _check_places(
        self,
        agent: str | None,
        agents: list[tuple[str, str, Where]],
        waiters: list[tuple[str, str, Where]],
    ) -> None:
        taken: dict[str, str] = {agent: "the agent"} if agent and not agents else {}
        for name, at, where in (*agents, *waiters):
            other = taken.setdefault(at, name)
            if other is not name:
                message = f"{name} and {other} both stand on {at}"
                self.reader.fault(where, message, "give each a node of its own")

    def _timetable(
        self, known: frozenset[str], waiters: list[tuple[str, str, Where]]
    ) -> list[tuple[str, int, str, Where]]:
        found: list[tuple[str, int, str, Where]] = []
        node = self.keys.get("timetable")
        if node is None:
            return found
        staff = frozenset(name for name, _, _ in waiters)
        for key, value in self.reader.entries(node, "timetable") or ():
            waiter = self.reader.known(key, "timetable", "waiter", staff)
            steps: set[int] = set()
            for step_key, place in self.reader.entries(value, f"timetable of {key.text}") or ():
                what = f"a step in the timetable of {key.text}"
                plain = Scalar(step_key.text, True, step_key.where)
                step = self.reader.integer(plain, what, 0, MAX_STEP)
                at = self.reader.known(place, f"the place of {key.text}", "node", known)
                if step in steps:
                    self.reader.fault(step_key.where, f"step {step} is given twice")
                elif step is not None and waiter is not None and at is not None:
                    steps.add(step)
                    found.append((waiter, step, at, step_key.where))
        entries = tuple((waiter, step, at) for waiter, step, at, _ in found)
        places = {(waiter, step): where for waiter, step, _, where in found}
        start = {name: at for name, at, _ in waiters}
        for clash in clashes(start, entries):
            if clash.entry is not None:
                message = f"{clash.first} and {clash.second} both stand on {clash.node}"
                mend = f"from step {clash.step} on they would share it; send one elsewhere"
                self.reader.fault(places[clash.entry], message, mend)
        return found


def _is_nothing(node: YamlNode) -> bool:
    return isinstance(node, Scalar) and node.is_nothing


def _segments(nodes: Sequence[Node], edges: list[_Edge]) -> list[tuple[Point, Point]]:
    places = {node.name: node.at for node in nodes}
    ends = ((places[edge.start], places[edge.end]) for edge in edges)
    return [(a, b) for a, b in ends if a is not None and b is not None]


def read_layout_file(name: str, argument: str = "--layout", *, several: bool = False) -> Layout:
    """Returns the layout of a file, of a built-in name such as ``report``, or
    (``-``) of standard input.

    Raises `LayoutError` as `read_layout`, at ``argument`` where there is no such file or built-in, and
    unless ``several`` is true for a layout with several robots.
    """
    from waiter_cli.file_access.locate import read_text

    file = read_text(name, "layout", where=Where(argument))
    return layout_in(file, several=several)


def one_robot(layout: Layout, what: str) -> Layout:
    """Returns the layout again; raises `LayoutError` where it has several robots, which ``what`` does not take."""
    if not layout.agents:
        return layout
    where = dict(layout.key_where).get("agents") or Where(layout.file or layout.name)
    message = f"several robots: {what} takes layouts with one robot only, so far"
    first = layout.agents[0][1]
    raise LayoutError([Fault(where, message, f"write agent: {first} in place of agents")])


def layout_in(file: File, named: Where | None = None, *, several: bool = False) -> Layout:
    """Returns the layout in a file that was read; raises `LayoutError` as `read_layout`.

    ``named`` is the place of another file that names it: nothing of a file that is no layout is
    shown then.  Unless ``several`` is true, one with several robots is refused.
    """
    from waiter_cli.file_access.kinds import told_as_it_is

    with told_as_it_is(file.text, file.shown, "a layout", named):
        layout = read_layout(file.text, file.shown, file)
    return layout if several else one_robot(layout, "this command")
