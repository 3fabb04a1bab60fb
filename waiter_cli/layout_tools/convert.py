"""A SPARC program about a restaurant → the YAML text of its layout. Entry point `convert`.

The vocabulary is the one of the 2020 report and of the project's own domains: sorts ``#node`` (or
``#vertex``), ``#table``, ``#customer``; facts ``edge/2``, ``areassociated/2`` (node, table or
``bar``), ``hascapacity/2``, ``entrance/1``, ``bar/1``, ``willbe/3`` and, at step 0,
``holds(currentlocation(Who, Node), 0)`` and ``holds(has_chairs(Table, Number), 0)``.  Where a program
has no fact for the entrance, it is looked for in the rule that says where nobody can be picked up:
``-occurs(pick(agent, C), I) :- holds(currentlocation(agent, N), I), N != n5.``

``oneway/2`` beside an edge says that it leads one way only; so does a program that writes both ways
of the others.  Only facts are read; rules are not followed, but for one that turns all edges.  Whatever is missing gets a stand-in where a layout
needs one, and a remark in any case.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import replace

from sparc.escaping import on_one_line
from sparc.lazy_dataclass import dataclass
from sparc.source import Source, Span
from sparc.syntax.tree import (
    Atom,
    BodyItem,
    Comparison,
    Identifier,
    Number,
    Program,
    Record,
    Rule,
    Term,
)
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.model.layout import OBJECTS, Bar, Layout, Node, Table
from waiter_cli.yaml_reading.node_reader import RESERVED, is_identifier

__all__ = ["Converted", "convert", "place_nodes"]

MOST_NAMES = 5000
CAPACITY = 2
NODE_SORTS, TABLE_SORTS, CUSTOMER_SORTS = ("node", "vertex"), ("table",), ("customer",)
BARS = ("bar", "counter")


@dataclass(frozen=True)
class Converted:
    """The YAML text, the layout it is read as, and remarks on what was not there."""

    text: str
    layout: Layout
    remarks: tuple[Fault, ...]


def place_nodes(text: str, layout: Layout, name: str | None = None) -> Converted:
    """Returns a layout without coordinates and its text, with places for its nodes
    that fit its edges.

    The text stays as it is otherwise, where it can.  Raises `InputError` where there is nothing to
    place.
    """
    from waiter_cli.files.layout_editor import edited
    from waiter_cli.room.coordinates import place

    if all(node.at is not None for node in layout.nodes):
        where = dict(layout.key_where).get("nodes") or Where(layout.file or layout.name)
        raise InputError([Fault(where, "every node has its place already", "leave it as it is")])
    placed = replace(place(layout), name=name or layout.name)
    found = _Found(layout.file or layout.name)
    hint = "the paths fit, the furniture may not: look at it with layout check and layout draw"
    found.remark("the nodes are placed by their edges", hint)
    kept = edited(text, layout, placed)
    return Converted(kept or _text(placed, found), placed, tuple(found.remarks))


@dataclasses.dataclass
class _Found:
    """The content of the facts; names are those of the layout."""

    file: str
    nodes: dict[str, None] = dataclasses.field(default_factory=dict)
    edges: dict[frozenset[str], tuple[str, str]] = dataclasses.field(default_factory=dict)
    directed: set[tuple[str, str]] = dataclasses.field(default_factory=set)
    one_way: set[tuple[str, str]] = dataclasses.field(default_factory=set)
    turned: bool = False
    """Whether a rule says that paths lead both ways."""
    tables: dict[str, list[str]] = dataclasses.field(default_factory=dict)
    capacities: dict[str, int] = dataclasses.field(default_factory=dict)
    chairs: dict[str, int] = dataclasses.field(default_factory=dict)
    places: dict[str, str] = dataclasses.field(default_factory=dict)
    robots: dict[str, None] = dataclasses.field(default_factory=dict)
    entrances: dict[str, Where] = dataclasses.field(default_factory=dict)
    bar: dict[str, None] = dataclasses.field(default_factory=dict)
    timetable: list[tuple[str, int, str]] = dataclasses.field(default_factory=list)
    objects: tuple[str, ...] = OBJECTS
    customers: int = 0
    left_out: int = 0
    remarks: list[Fault] = dataclasses.field(default_factory=list)

    def remark(self, message: str, mend: str | None = None, span: Span | None = None) -> None:
        place = Where(self.file)
        if span is not None:
            at = span.location
            place = Where(at.name, at.line, at.column)
        self.remarks.append(Fault(place, message, mend))


def convert(source: Source, name: str, place: bool = False) -> Converted:
    """Returns the layout that a program describes, called ``name``.

    With ``place`` its nodes get coordinates that fit the edges (`waiter_cli.room.coordinates`).

    Raises `sparc.errors.SourceError` for a program with a fault of syntax, and `InputError` where
    there are no nodes in it or a name that no layout can have.
    """
    from sparc.syntax.parser import parse

    program = parse(source)
    found = _Found(source.name)
    _read_sorts(program, found)
    for rule in program.statements:
        if isinstance(rule, Rule) and isinstance(rule.head, tuple) and len(rule.head) == 1:
            head = rule.head[0]
            if isinstance(head, Atom) and not rule.body:
                _read_fact(head, found)
            elif isinstance(head, Atom):
                _read_pick_rule(head, rule.body, found)
                _read_edge_rule(head, rule.body, found)
    layout = _layout(found, name, place)
    text = _text(layout, found)
    from waiter_cli.files.layout_reader import read_layout

    return Converted(text, read_layout(text, name), tuple(found.remarks))


# -- sorts and facts --------------------------------------------------------------------------


def _read_sorts(program: Program, found: _Found) -> None:
    """Reads nodes, tables and the number of customers from the sorts of a program without faults."""
    from sparc.checking.checker import check
    from sparc.errors import SourceError, SourceErrors

    try:
        typed = check(program)
    except (SourceError, SourceErrors) as error:
        first = error.errors[0] if isinstance(error, SourceErrors) else error
        found.remark(
            f"the program has faults, so its sorts are not read: {first.message}",
            "waiter sparc check lists them all",
            first.span,
        )
        return

    def elements(sorts: tuple[str, ...]) -> Iterator[int | str]:
        for sort in sorts:
            extent = typed.sorts[sort].extent if sort in typed.sorts else None
            if extent is None:
                continue
            if extent.bound() > MOST_NAMES:
                raise InputError(
                    [Fault(Where(found.file), f"#{sort} has more than {MOST_NAMES} elements")]
                )
            yield from (value for value in extent if isinstance(value, (int, str)))

    for value in elements(NODE_SORTS):
        found.nodes.setdefault(_named(value, "n"))
    for value in elements(TABLE_SORTS):
        found.tables.setdefault(_named(value, "table"), [])
    found.customers = sum(1 for _ in elements(CUSTOMER_SORTS))
    objects = [name for name in elements(("object",)) if name in OBJECTS]
    if objects:
        found.objects = tuple(name for name in OBJECTS if name in objects)


def _read_fact(atom: Atom, found: _Found) -> None:
    values = [_value(term) for term in atom.arguments]
    if atom.negated:
        return
    match atom.name, values:
        case "edge" | "connected", [int() | str() as a, int() | str() as b] if a != b:
            first, second = _named(a, "n"), _named(b, "n")
            found.nodes.setdefault(first)
            found.nodes.setdefault(second)
            found.edges.setdefault(frozenset((first, second)), (first, second))
            found.directed.add((first, second))
        case "oneway", [int() | str() as a, int() | str() as b]:
            found.one_way.add((_named(a, "n"), _named(b, "n")))
        case "node" | "vertex", [int() | str() as node]:
            found.nodes.setdefault(_named(node, "n"))
        case "areassociated", [int() | str() as node, str() as thing] if (
            thing in BARS and thing not in found.tables
        ):
            found.bar.setdefault(_named(node, "n"))
        case "areassociated", [int() | str() as node, int() | str() as table]:
            beside = found.tables.setdefault(_named(table, "table"), [])
            if _named(node, "n") not in beside:
                beside.append(_named(node, "n"))
                found.nodes.setdefault(beside[-1])
        case "hascapacity", [int() | str() as table, int() as seats]:
            found.tables.setdefault(_named(table, "table"), [])
            found.capacities[_named(table, "table")] = seats
        case "entrance", [int() | str() as node]:
            found.entrances.setdefault(_named(node, "n"), _where(atom.span))
        case "bar", [int() | str() as node]:
            found.bar.setdefault(_named(node, "n"))
        case "robot", [int() | str() as robot]:
            found.robots.setdefault(_named(robot, "r"))
        case "willbe", [int() | str() as waiter, int() | str() as node, int() as step]:
            found.timetable.append((_named(waiter, "w"), step, _named(node, "n")))
        case "holds", [_, 0]:
            _read_initial(atom.arguments[0], found)
        case "holds" | "obs", _:
            found.left_out += 1


def _read_initial(fluent: Term, found: _Found) -> None:
    """A fluent that holds at step 0: where somebody stands, how many chairs a table has."""
    values = [_value(t) for t in fluent.arguments] if isinstance(fluent, Record) else []
    match getattr(fluent, "name", ""), values:
        case "currentlocation", [int() | str() as who, int() | str() as node]:
            found.places[_named(who, "w")] = _named(node, "n")
        case "has_chairs", [int() | str() as table, int() as number]:
            found.chairs[_named(table, "table")] = number
        case "has_chairs", [int() as number, int() | str() as table]:
            found.chairs[_named(table, "table")] = number
        case _:
            found.left_out += 1


def _read_pick_rule(head: Atom, body: tuple[BodyItem, ...], found: _Found) -> None:
    """The entrance, from a rule by which nobody can be picked up anywhere else."""
    if not (head.negated and head.name == "occurs" and head.arguments):
        return
    action = head.arguments[0]
    if not (isinstance(action, Record) and action.name == "pick"):
        return
    for item in body:
        if isinstance(item, Comparison) and item.operator == "!=":
            for side in (item.left, item.right):
                value = _value(side)
                node = None if value is None else _named(value, "n")
                if node in found.nodes and node is not None:
                    found.entrances.setdefault(node, _where(item.span))


def _read_edge_rule(head: Atom, body: tuple[BodyItem, ...], found: _Found) -> None:
    """Reads whether paths lead both ways, from a rule such as ``edge(M, N) :- edge(N, M)``."""
    names = ("edge", "connected")
    if head.negated or head.name not in names:
        return
    for item in body:
        atom = getattr(item, "atom", item)
        if isinstance(atom, Atom) and atom.name in names and not atom.negated:
            found.turned |= atom.arguments == head.arguments[::-1]


def _one_way(found: _Found) -> frozenset[tuple[str, str]]:
    """Returns the edges that lead one way only: those said to, or all that no other
    fact and no rule turns.

    Where no edge at all is written both ways, and no rule turns them, they are taken as two-way.
    """
    lonely = {edge for edge in found.directed if edge[::-1] not in found.directed}
    if found.turned or lonely == found.directed:
        if lonely and not found.turned and not found.one_way:
            message = "each edge is written one way, and no rule turns it: taken as two-way"
            found.remark(message, "write {from: n1, to: n2} for a path that leads one way only")
        lonely &= found.one_way
    return frozenset(edge for edge in found.edges.values() if edge in lonely)


def _value(term: Term) -> int | str | None:
    """Returns a ground simple term; None for variables, records and arithmetic."""
    if isinstance(term, Number):
        return term.value
    return term.name if isinstance(term, Identifier) else None


def _named(value: int | str, prefix: str) -> str:
    """Returns a name for the layout: numbers get a prefix."""
    return f"{prefix}{value}" if isinstance(value, int) else value


def _where(span: Span | None) -> Where:
    at = span.location if span is not None else None
    return Where(at.name, at.line, at.column) if at is not None else Where("")


# -- the layout -------------------------------------------------------------------------------


def _layout(found: _Found, name: str, place: bool) -> Layout:
    if not found.nodes:
        hint = "a restaurant has a sort #node or facts such as edge(n1, n2)."
        raise InputError([Fault(Where(found.file), "no nodes and no edges found", hint)])
    _check_names(found)
    if not found.edges:
        found.remark("no edges found", "expected facts such as edge(n1, n2).")
    tables = _tables(found)
    agents, agent = _robots(found)
    entrance = next(iter(found.entrances), None)
    if entrance is None:
        entrance = agent
        message = f"no entrance found, so {entrance} stands in for it"
        found.remark(message, "expected entrance(n5). — set entrance in the layout")
    elif len(found.entrances) > 1:
        others = ", ".join(list(found.entrances)[1:])
        found.remark(f"more than one entrance found: {entrance} is used, {others} are not")
    if found.left_out:
        many = "fact" if found.left_out == 1 else "facts"
        message = f"{found.left_out} {many} about a situation left out"
        found.remark(message, "who sits where and what was seen belongs in a scenario")
    if place:
        found.remark("no coordinates found: SPARC has none", "the nodes are placed by their edges")
    else:
        hint = "write n1: [x, y] to simulate, or give --place"
        found.remark("no coordinates found: SPARC has none", hint)
    taken = {agent, *(node for _, node in agents)}
    waiters = {who: at for who, at in found.places.items() if at in found.nodes and at not in taken}
    edges = tuple(found.edges.values())
    return Layout(
        name=name,
        nodes=_nodes(tuple(found.nodes), edges, place),
        edges=edges,
        entrance=entrance,
        tables=tables,
        agent=agent,
        agents=agents,
        waiters=tuple(sorted(waiters.items())),
        bar=Bar(tuple(found.bar)) if found.bar else None,
        objects=found.objects if found.bar else (),
        timetable=tuple(entry for entry in found.timetable if entry[0] in waiters),
        customers=found.customers,
        one_way=_one_way(found),
    )


def _robots(found: _Found) -> tuple[tuple[tuple[str, str], ...], str]:
    """Returns where each of several robots starts, and where the first or the only one does.

    Their places are taken out of those that were found.
    """
    names = list(found.robots) if len(found.robots) > 1 else ["agent"]
    places = {name: found.places.pop(name, None) for name in names}
    free = (node for node in found.nodes if node not in places.values())
    starts: list[tuple[str, str]] = []
    for name, node in places.items():
        if node not in found.nodes:
            node = next(free, None)
            if node is None:
                hint = f"expected holds(currentlocation({name}, n1), 0)."
                raise InputError([Fault(Where(found.file), f"no node is left for {name}", hint)])
            whose = f"{name}" if len(names) > 1 else "the robot"
            message = f"no place of {whose} found, so it starts on {node}"
            found.remark(message, f"expected holds(currentlocation({name}, n1), 0).")
        assert node is not None
        starts.append((name, node))
    return tuple(starts) if len(names) > 1 else (), starts[0][1]


def _nodes(
    names: tuple[str, ...], edges: tuple[tuple[str, str], ...], place: bool
) -> tuple[Node, ...]:
    if not place:
        return tuple(Node(name) for name in names)
    from waiter_cli.room.coordinates import spread

    near: dict[str, list[str]] = {name: [] for name in names}
    for a, b in edges:
        near[a].append(b)
        near[b].append(a)
    at = spread(near)
    return tuple(Node(name, at[name]) for name in names)


def _tables(found: _Found) -> tuple[Table, ...]:
    """Returns the tables that can be served; each of the others is a remark."""
    tables: list[Table] = []
    for name, nodes in found.tables.items():
        if not nodes:
            message = f"table {name} is beside no node, and is left out"
            found.remark(message, f"expected areassociated(n1, {name}).")
            continue
        seats = found.capacities.get(name)
        if seats is None or seats < 1:
            message = f"no capacity of {name} found, so it seats {CAPACITY}"
            found.remark(message, f"expected hascapacity({name}, 4).")
            seats = CAPACITY
        chairs = min(found.chairs.get(name, seats), seats)
        tables.append(Table(name, seats, tuple(nodes), None, (0.8, 0.8), chairs))
    if not found.tables:
        found.remark("no tables found", "expected a sort #table, or areassociated(n1, table1).")
    return tuple(tables)


def _check_names(found: _Found) -> None:
    """Raises `InputError` for names that cannot stand in a layout."""
    seen: dict[str, str] = {}
    faults = []
    for kind, names in (("node", found.nodes), ("table", found.tables)):
        for name in names:
            first = seen.setdefault(name, kind)
            if first != kind:
                faults.append(Fault(Where(found.file), f"{name} is a node and a table"))
            elif not is_identifier(name) or name in RESERVED:
                faults.append(Fault(Where(found.file), f"{name} is no name for a {kind}"))
    if faults:
        raise InputError(faults)


def _text(layout: Layout, found: _Found) -> str:
    """Returns the YAML text, remarks first; tables get the size that everybody expects of them."""
    lines = [f"# Converted from {' '.join(found.file.rsplit('/', 1)[-1].split())}."]
    for remark in found.remarks:
        place = f"line {remark.where.line}: " if remark.where and remark.where.line else ""
        lines.append(f"# {place}{on_one_line(remark.message)}")
    body = write_layout(layout).replace(", size: [0.8, 0.8]", "")
    if not layout.tables:
        body = body.replace("tables:\n", "tables: {}\n")
    if not layout.edges:
        body = body.replace("edges:\n", "edges: []\n")
    if layout.customers:
        body += f"customers: {layout.customers}\n"
    return "\n".join(lines) + "\n" + body
