"""`Layout` → what is legal and yet looks wrong. Entry point `advise`.

Two looks at a restaurant.  The floor as a graph: what no path leads to, nodes that all paths to a
table, the bar or the robot lead through, nodes that nothing uses and dead ends among them.  The
floor in metres, where it has coordinates: edges on which the robot would run into furniture,
tables and seats that do not fit.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, Where
from waiter_cli.model.graph import (
    Cut,
    cut_nodes,
    layout_warnings,
    no_way_back,
    reachable,
    reached_by_robots,
    starting_places,
)
from waiter_cli.model.layout import Layout, Table
from waiter_cli.model.wording import in_words

if TYPE_CHECKING:
    from waiter_cli.room.room import Room
    from waiter_cli.room.shapes import Box

__all__ = ["Advice", "advise", "islands", "overlap", "physical"]

SEAT = 0.4
"""Metres of a table's rim that a guest takes."""

_BAR = "the bar"


@dataclass(frozen=True)
class Advice:
    """A remark: ``kind`` is a word for programs, ``fault`` says what, where, and the mend.

    ``about`` names what it is about, and ``several`` is the remark in the plural, ``{}`` standing
    for the names: remarks with the same plural can be made in one.  Kinds: ``unreachable blocked
    dead_end bottleneck unused_node idle_objects no_coordinates edge_through_furniture
    tables_overlap seats_do_not_fit timetable degrees no_way_back``.
    """

    kind: str
    fault: Fault
    about: str = ""
    several: str = ""


def advise(layout: Layout, room: Room | None = None) -> tuple[Advice, ...]:
    """Returns every remark about a layout, in the order of the file.

    ``room`` is the layout's room where that was built already.
    """
    remarks = [
        *_unreachable(layout),
        *_traps(layout),
        *_paths(layout),
        *_timetable(layout),
        *_degrees(layout),
    ]
    if not any(advice.kind == "degrees" for advice in remarks):
        remarks += physical(layout, room)
    top = Where(layout.file, 0)
    return tuple(sorted(remarks, key=lambda a: (a.fault.where or top, a.fault.message)))


def _degrees(layout: Layout) -> Iterator[Advice]:
    """Coordinates that look like longitude and latitude: a whole restaurant within centimetres.

    A degree is 111 km: 100 m are less than 0.002 of it, wherever on Earth.
    """
    at = [node.at for node in layout.nodes if node.at is not None]
    xs, ys = sorted({x for x, _ in at}), sorted({y for _, y in at})
    if len(at) < 2 or not max(xs[-1] - xs[0], ys[-1] - ys[0]) < 0.02 or len({*at}) < 2:
        return
    if max(map(abs, xs)) <= 180 and max(map(abs, ys)) <= 180:
        where = dict(layout.key_where).get("nodes")
        message = "all nodes lie within 2 cm: these coordinates look like degrees"
        hint = "write metres, from any origin: a degree of latitude is 111,320 m"
        yield Advice("degrees", Fault(where, message, hint))


# -- the floor as a graph -------------------------------------------------------------------


def _unreachable(layout: Layout) -> Iterator[Advice]:
    yield from islands(layout)
    posts = {node: waiter for waiter, node in layout.waiters}
    near = layout.neighbours()
    everywhere, open_ = reached_by_robots(layout), reached_by_robots(layout, posts)
    ends: list[tuple[str, tuple[str, ...], Where | None]]
    ends = [("the entrance", (layout.entrance,), dict(layout.key_where).get("entrance"))]
    ends += [(f"table {t.name}", t.nodes, t.where) for t in layout.tables]
    if layout.bar is not None:
        ends.append((_BAR, layout.bar.nodes, layout.bar.where))
    shut = sorted(_rim(near, open_) & posts.keys())
    message = f"cannot be reached while {in_words([f'{posts[n]} stands on {n}' for n in shut])}"
    who = in_words([posts[node] for node in shut])
    mend = f"let {who} start elsewhere, or add a node or an edge that leads past"
    for what, nodes, where in ends:
        if everywhere.intersection(nodes) and not open_.intersection(nodes):
            fault = Fault(where, f"{what} {message}", mend)
            yield Advice("blocked", fault, what.removeprefix("table "), f"{{}} {message}")


def islands(layout: Layout) -> Iterator[Advice]:
    """Yields advice on what no path leads to, and on objects without a bar:
    `layout_warnings`, with their kinds.
    """
    objects = dict(layout.key_where).get("objects")
    nodes = {node.where: node.name for node in layout.nodes if node.name != layout.entrance}
    tables = {table.where: table.name for table in layout.tables}
    start, starts = starting_places(layout)
    for fault in layout_warnings(layout):
        if layout.bar is None and objects is not None and fault.where == objects:
            yield Advice("idle_objects", fault)
        elif fault.where in nodes:
            several = f"nodes {{}} cannot be reached from {starts}"
            yield Advice("unreachable", fault, nodes[fault.where], several)
        elif fault.where in tables:
            several = f"tables {{}} cannot be reached: no path leads to them from {start}"
            yield Advice("unreachable", fault, tables[fault.where], several)
        else:
            yield Advice("unreachable", fault)


def _traps(layout: Layout) -> Iterator[Advice]:
    """Yields nodes that one-way paths lead to, and none away from again."""
    if not layout.one_way:
        return
    near, where = layout.neighbours(), {node.name: node.where for node in layout.nodes}
    for name in no_way_back(layout):
        back = f"the entrance {layout.entrance}"
        said = f"no path leads from {name} back to {back}: the robot that goes there stays there"
        several = f"no path leads from {{}} back to {back}"
        mend = f"add an edge that leads away from {name}, or let the one-way path lead both ways"
        if not near[name]:
            said = f"node {name} cannot be left: every path to it is one way"
        yield Advice("no_way_back", Fault(where[name], said, mend), name, several)


def _rim(near: dict[str, tuple[str, ...]], inside: set[str]) -> set[str]:
    return {node for name in inside for node in near[name]} - inside


def _roles(layout: Layout) -> dict[str, list[str]]:
    """Returns for each node that is used what it is used for."""
    roles: dict[str, list[str]] = {}
    for table in layout.tables:
        for node in table.nodes:
            roles.setdefault(node, []).append(table.name)
    for node in layout.bar.nodes if layout.bar else ():
        roles.setdefault(node, []).append(_BAR)
    roles.setdefault(layout.entrance, []).append("the entrance")
    for robot, node in layout.starts:
        whose = f"the place of {robot}" if layout.agents else "the robot's place"
        roles.setdefault(node, []).append(whose)
    for waiter, node in layout.waiters:
        roles.setdefault(node, []).append(f"the place of {waiter}")
    for waiter, _, node in layout.timetable:
        roles.setdefault(node, []).append(f"a place of {waiter}")
    return roles


def _paths(layout: Layout) -> Iterator[Advice]:
    """Yields bottlenecks, and nodes on no way between two that are used, dead ends among them."""
    near, joined, roles = layout.neighbours(), layout.joined(), _roles(layout)
    where = {node.name: node.where for node in layout.nodes}
    reached = reachable(near, layout.entrance)
    idle: set[str] = set()
    for cut in cut_nodes(near, layout.entrance):
        used = [part for part in cut.lost if any(node in roles for node in part)]
        idle.update(n for part in cut.lost if part not in used for n in part)
        lost = [node for part in used for node in part]
        served = _unserved(layout, cut.node, lost)
        if served or any(node in lost for _, node in layout.starts):
            rest = "the rest" if cut.node == layout.entrance else "the entrance"
            yield Advice(
                "bottleneck",
                Fault(
                    where[cut.node],
                    f"{cut.node} is a bottleneck: without it {_cut_off(lost, served)} cut off "
                    f"from {rest}",
                    "a second way round it would keep the floor in one piece",
                ),
                cut.node,
            )
    nothing = "no table, no bar and nobody is there"
    mend = "leave out what nothing uses, or give it to a table"
    for node in layout.nodes:
        name = node.name
        if name in roles:
            continue
        if layout.agents and name in reached:
            continue  # a place where one robot can wait until another one has passed
        if name in reached and len(joined[name]) == 1:
            yield Advice(
                "dead_end",
                Fault(
                    node.where,
                    f"{name} is a dead end that nothing uses: {nothing}",
                    mend,
                ),
                name,
                f"{{}} are dead ends that nothing uses: {nothing}",
            )
        if name in idle or name not in reached:
            yield Advice(
                "unused_node",
                Fault(
                    node.where,
                    f"node {name} is used by nothing: {nothing}, and no way leads through it",
                    mend,
                ),
                name,
                f"nodes {{}} are used by nothing: {nothing}, and no way leads through them",
            )


def _unserved(layout: Layout, node: str, lost: Sequence[str]) -> list[str]:
    """Returns the tables, and the bar, that nobody can serve who cannot go to
    ``node`` and beyond it.
    """
    shut = {node, *lost}
    ends = [(table.name, table.nodes) for table in layout.tables]
    if layout.bar is not None:
        ends.append((_BAR, layout.bar.nodes))
    return [
        name for name, nodes in ends if shut.issuperset(nodes) and not set(lost).isdisjoint(nodes)
    ]


def _cut_off(lost: Sequence[str], served: Sequence[str]) -> str:
    """Returns nodes, tables and the bar that are lost, in words, with their verb."""
    words = list(lost) if len(lost) <= 4 else [f"{len(lost)} nodes"]
    tables = [name for name in served if name != _BAR]
    words += tables if len(tables) <= 4 else [*tables[:3], f"{len(tables) - 3} more tables"]
    words += [_BAR] if _BAR in served else []
    one = len(words) == 1 and len(lost) == 1
    return f"{in_words(words)} {'is' if one else 'are'}"


# -- time -------------------------------------------------------------------------------------


def _timetable(layout: Layout) -> Iterator[Advice]:
    """Moves of other waiters that lead through the robot, or through each other, in a corridor."""
    if not layout.timetable:
        return
    near, places = layout.joined(), dict(layout.key_where)
    split = cut_nodes(near, layout.entrance)
    stands = dict(layout.waiters)
    waited = set(stands)  # who has stood where he starts until now
    steps = sorted({step for _, step, _ in layout.timetable})
    for step in steps:
        moves = [(who, stands[who], to) for who, at, to in layout.timetable
                 if at == step and stands[who] != to]  # fmt: skip
        for who, start, end in moves:
            swapped = next((w for w, a, b in moves if (a, b) == (end, start) and w > who), None)
            between = None if end in near[start] else _between(split, start, end)
            if between is not None:
                said = f"{who} goes from {start} to {end} in one step, past whoever is on {between}"
                hint = f"{between} lies on every way there: give {who} a step on each node"
            elif swapped is not None:
                said = f"{who} and {swapped} change places at step {step}, through each other"
                hint = "let one of them step aside first"
            elif who in waited and _locked_in(layout, start, end):
                said = f"{who} goes from {start} to {end}, and no way leads past him for the robot"
                hint = f"let the robot start elsewhere, or {who} stay away"
            else:
                continue
            yield Advice("timetable", Fault(places.get(f"timetable.{who}.{step}"), said, hint), who)
        for who, _, end in moves:
            stands[who] = end
            waited.discard(who)


def _between(split: Sequence[Cut], start: str, end: str) -> str | None:
    """Returns a node other than both that every way from ``start`` to ``end`` leads through."""
    for cut in split:
        if cut.node not in (start, end):
            parts = {node: number for number, part in enumerate(cut.lost) for node in part}
            if parts.get(start) != parts.get(end):
                return cut.node
    return None


def _locked_in(layout: Layout, start: str, end: str) -> bool:
    """Returns whether the robot is behind ``start``, and ``end`` is the only way out."""
    if layout.agent == start:
        return False
    inside = reachable(layout.neighbours(), layout.agent, (start,))
    beside = layout.joined()[start]
    return layout.entrance not in inside and inside.intersection(beside) == {end}


# -- the floor in metres --------------------------------------------------------------------


def physical(layout: Layout, room: Room | None = None) -> Iterator[Advice]:
    """Yields advice in metres: edges through furniture, tables and seats that do not fit."""
    from math import hypot

    from waiter_cli.room.room import build_room, sweep, without_places

    bare = without_places(layout)
    if bare is not None:
        yield Advice("no_coordinates", bare)
        return
    room = room or build_room(layout)
    edges: dict[Where | None, str] = {}
    for place, (one, two) in zip(layout.edge_where, layout.edges):
        edges[place] = f"{one}-{two}"
    for fault in sweep(room):
        yield Advice("edge_through_furniture", fault, edges.get(fault.where, ""))
    solids: list[Box] = [*room.tables.values(), *([room.bar] if room.bar else []), *room.walls]
    close = _neighbourhood(solids)
    for index, table in enumerate(layout.tables):
        box = room.tables[table.name]
        beside = close(box, 2 * box.reach)
        for other in (solids[k] for k in beside if k < index or k >= len(layout.tables)):
            if overlap(box, other):
                yield Advice(
                    "tables_overlap",
                    Fault(
                        table.where,
                        f"table {table.name} and {other.name} stand in the same place",
                        "move one of them (at: [x, y]) or make it smaller (size: [x, y])",
                    ),
                    table.name,
                )
        chairs = [chair.box for chair in room.chairs[table.name]]
        about = box.reach + 1.5  # metres: chairs stand within
        near = [solids[k] for k in close(box, about)]
        near = [o for o in near if hypot(o.x - box.x, o.y - box.y) < about + o.reach]
        yield from _seats(table, chairs, near)


def _neighbourhood(solids: Sequence[Box]) -> Callable[[Box, float], list[int]]:
    """Returns a function from a box to the numbers of ``solids`` that may lie within some metres.

    Every box stands in the cells that twice its reach touches; large ones are in every answer.
    """
    cell = 4.0
    cells: dict[tuple[int, int], list[int]] = {}
    large = [k for k, box in enumerate(solids) if box.reach > cell]

    def span(middle: float, reach: float) -> range:
        return range(int((middle - reach) // cell), int((middle + reach) // cell) + 1)

    for k, box in enumerate(solids):
        if box.reach <= cell:
            for i in span(box.x, 2 * box.reach):
                for j in span(box.y, 2 * box.reach):
                    cells.setdefault((i, j), []).append(k)

    def close(box: Box, metres: float) -> list[int]:
        if metres > 8 * cell:
            return list(range(len(solids)))
        found = set(large)
        for i in span(box.x, metres):
            for j in span(box.y, metres):
                found.update(cells.get((i, j), ()))
        return sorted(found)

    return close


def _seats(table: Table, chairs: list[Box], solids: list[Box]) -> Iterator[Advice]:
    """Seats for which the table has no rim, or whose chairs stand in something."""
    sides = [2 * int(length / SEAT + 1e-9) for length in table.size]
    message = hint = None
    if table.capacity > max(1, sum(sides)):
        message = (
            f"table {table.name} has {table.capacity} seats and a rim for {sum(sides)} "
            f"({table.size[0]:g} m by {table.size[1]:g} m, {SEAT} m each)"
        )
        hint = "make it larger (size: [x, y]), or its capacity smaller"
    else:
        for number, chair in enumerate(chairs, 1):
            against = next((other.name for other in solids if overlap(chair, other)), None)
            if against is None and any(overlap(chair, other) for other in chairs[: number - 1]):
                against = "another of its chairs"
            if against is not None:
                message = f"chair {number} of table {table.name} stands in {against}"
                hint = "move the table (at: [x, y]), make it larger, or its capacity smaller"
                break
    if message is not None:
        yield Advice("seats_do_not_fit", Fault(table.where, message, hint), table.name)


def overlap(one: Box, other: Box, slack: float = 0.01) -> bool:
    """Returns whether two upright boxes share more than ``slack`` metres of floor in
    every direction.

    Two convex shapes are apart exactly where a line along a side of one of them parts them.
    """
    from math import cos, sin

    if abs(one.x - other.x) + abs(one.y - other.y) > 2 * (one.reach + other.reach):
        return False
    for turn in (one.yaw, other.yaw):
        for x, y in ((cos(turn), sin(turn)), (-sin(turn), cos(turn))):
            mine = [x * px + y * py for px, py in one.corners()]
            theirs = [x * px + y * py for px, py in other.corners()]
            if min(max(mine), max(theirs)) - max(min(mine), min(theirs)) <= slack:
                return False
    return True
