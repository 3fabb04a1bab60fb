"""`Layout` → what is legal and yet looks wrong. Entry point `advise`.

Two looks at a restaurant.  The floor as a graph: what no path leads to, dead ends, nodes that all
paths to something lead through, nodes that nothing uses.  The floor in metres, where it has
coordinates: edges on which the robot would run into furniture, tables and seats that do not fit.

Bottlenecks and dead weight come from one depth-first search with low points (Hopcroft and Tarjan,
1973, "Algorithm 447"): a node cuts off the part below a child that has no way around it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sparc.values import dataclass
from waiter_cli.exits import Fault
from waiter_cli.layout import Layout, Table, layout_warnings
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from waiter_cli.replay.shapes import Box

__all__ = ["Advice", "Cut", "advise", "cuts", "overlap", "physical"]

SEAT = 0.4
"""Metres of a table's rim that a guest takes."""


@dataclass(frozen=True, slots=True)
class Advice:
    """A remark: ``kind`` is a word for programs, ``fault`` says what, where, and the mend.

    Kinds: ``unreachable blocked dead_end bottleneck unused_node idle_objects no_coordinates
    edge_through_furniture tables_overlap seats_do_not_fit``.
    """

    kind: str
    fault: Fault


class Cut(NamedTuple):
    """A node whose loss splits the floor, and the nodes that are then cut off from the start."""

    node: str
    lost: tuple[tuple[str, ...], ...]


def advise(layout: Layout) -> tuple[Advice, ...]:
    """Every remark about a layout, in the order of the file."""
    found = [*_unreachable(layout), *_paths(layout), *physical(layout)]
    top = Where(layout.file, 0)
    return tuple(sorted(found, key=lambda a: (a.fault.where or top, a.fault.message)))


# -- the floor as a graph -------------------------------------------------------------------


def _unreachable(layout: Layout) -> Iterator[Advice]:
    objects = dict(layout.key_where).get("objects")
    lost = layout_warnings(layout)
    for fault in lost:
        idle = layout.bar is None and objects is not None and fault.where == objects
        yield Advice("idle_objects" if idle else "unreachable", fault)
    posts = {node: waiter for waiter, node in layout.waiters}
    near = layout.neighbours()
    everywhere, open_ = _walk(near, layout.agent, ()), _walk(near, layout.agent, posts)
    ends: list[tuple[str, tuple[str, ...], Where | None]]
    ends = [("the entrance", (layout.entrance,), dict(layout.key_where).get("entrance"))]
    ends += [(f"table {t.name}", t.nodes, t.where) for t in layout.tables]
    if layout.bar is not None:
        ends.append(("the bar", layout.bar.nodes, layout.bar.where))
    for what, nodes, where in ends:
        if everywhere.intersection(nodes) and not open_.intersection(nodes):
            who = " and ".join(
                f"{posts[node]} on {node}" for node in sorted(_rim(near, open_) & posts.keys())
            )
            yield Advice(
                "blocked",
                Fault(
                    where,
                    f"{what} cannot be reached while the waiters stand where they start: {who}",
                    "move a waiter, or add an edge that leads past",
                ),
            )


def _walk(near: dict[str, tuple[str, ...]], start: str, shut: Iterable[str]) -> set[str]:
    closed, found, rest = set(shut), {start}, [start]
    while rest:
        for node in near[rest.pop()]:
            if node not in found and node not in closed:
                found.add(node)
                rest.append(node)
    return found


def _rim(near: dict[str, tuple[str, ...]], inside: set[str]) -> set[str]:
    return {node for name in inside for node in near[name]} - inside


def _roles(layout: Layout) -> dict[str, list[str]]:
    """For every node that is used, what it is used for."""
    roles: dict[str, list[str]] = {}
    for table in layout.tables:
        for node in table.nodes:
            roles.setdefault(node, []).append(table.name)
    for node in layout.bar.nodes if layout.bar else ():
        roles.setdefault(node, []).append("the bar")
    roles.setdefault(layout.entrance, []).append("the entrance")
    roles.setdefault(layout.agent, []).append("the robot's place")
    for waiter, node in layout.waiters:
        roles.setdefault(node, []).append(f"the place of {waiter}")
    for waiter, _, node in layout.timetable:
        roles.setdefault(node, []).append(f"a place of {waiter}")
    return roles


def _paths(layout: Layout) -> Iterator[Advice]:
    """Dead ends, bottlenecks, and nodes that lie on no way between two that are used."""
    near, roles = layout.neighbours(), _roles(layout)
    where = {node.name: node.where for node in layout.nodes}
    reached = _walk(near, layout.entrance, ())
    idle: set[str] = set()
    for cut in cuts(near, layout.entrance):
        used = [part for part in cut.lost if any(node in roles for node in part)]
        idle.update(n for part in cut.lost if part not in used for n in part)
        if used:
            lost = [node for part in used for node in part]
            rest = "the rest" if cut.node == layout.entrance else "the entrance"
            yield Advice(
                "bottleneck",
                Fault(
                    where[cut.node],
                    f"{cut.node} is a bottleneck: without it {_cut_off(layout, lost)} cut off "
                    f"from {rest}",
                    "a second way round it would keep the floor in one piece",
                ),
            )
    for node in layout.nodes:
        name = node.name
        if name in reached and len(near[name]) == 1:
            yield Advice(
                "dead_end",
                Fault(
                    node.where,
                    f"{name} is a dead end: the only way on is back to {near[name][0]}",
                    "an edge to another node would open it"
                    if name in roles
                    else "leave it out, or join it to another node",
                ),
            )
        if name not in roles and (name in idle or name not in reached):
            yield Advice(
                "unused_node",
                Fault(
                    node.where,
                    f"node {name} is used by nothing: no table, no bar and nobody is there, and "
                    "no way leads through it",
                    "leave it out, or give it to a table",
                ),
            )


def _cut_off(layout: Layout, lost: Sequence[str]) -> str:
    """Nodes and tables that are lost, in words, with their verb."""
    gone = set(lost)
    tables = [table.name for table in layout.tables if gone.issuperset(table.nodes)]
    words = list(lost) if len(lost) <= 4 else [f"{len(lost)} nodes"]
    if len(tables) > 4:
        tables = [*tables[:3], f"{len(tables) - 3} more tables"]
    words += tables
    head = ", ".join(words[:-1])
    one = len(words) == 1 and len(lost) == 1
    return f"{head} and {words[-1]} are" if head else f"{words[-1]} {'is' if one else 'are'}"


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


# -- the floor in metres --------------------------------------------------------------------


def physical(layout: Layout) -> Iterator[Advice]:
    """What is wrong in metres: edges through furniture, tables and seats that do not fit."""
    from math import hypot

    from waiter_cli.replay.room import build_room, sweep

    without = [node for node in layout.nodes if node.at is None]
    if without:
        place = dict(layout.key_where).get("nodes", without[0].where)
        yield Advice(
            "no_coordinates",
            Fault(
                place,
                f"{len(without)} nodes have no coordinates: enough to plan, not to simulate",
                f"write {without[0].name}: [x, y] in metres",
            ),
        )
        return
    room = build_room(layout)
    for fault in sweep(room):
        yield Advice("edge_through_furniture", fault)
    solids: list[Box] = [*room.tables.values(), *([room.bar] if room.bar else []), *room.walls]
    for index, table in enumerate(layout.tables):
        box = room.tables[table.name]
        for other in solids[:index] + solids[len(layout.tables) :]:
            if overlap(box, other):
                yield Advice(
                    "tables_overlap",
                    Fault(
                        table.where,
                        f"table {table.name} and {other.name} stand in the same place",
                        "move one of them (at: [x, y]) or make it smaller (size: [x, y])",
                    ),
                )
        chairs = [chair.box for chair in room.chairs[table.name]]
        about = box.reach + 1.5  # metres: chairs stand within
        near = [o for o in solids if hypot(o.x - box.x, o.y - box.y) < about + o.reach]
        yield from _seats(table, box, chairs, near)


def _seats(table: Table, box: Box, chairs: list[Box], solids: list[Box]) -> Iterator[Advice]:
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
            hit = next((other for other in solids if overlap(chair, other)), None)
            if hit is None and any(overlap(chair, other) for other in chairs[: number - 1]):
                hit = chairs[0]
            if hit is not None:
                against = "another of its chairs" if hit is chairs[0] else hit.name
                message = f"chair {number} of table {table.name} stands in {against}"
                hint = "move the table (at: [x, y]), make it larger, or its capacity smaller"
                break
    if message is not None:
        yield Advice("seats_do_not_fit", Fault(table.where, message, hint))


def overlap(one: Box, other: Box, slack: float = 0.01) -> bool:
    """Whether two upright boxes share more than ``slack`` metres of floor in every direction.

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
