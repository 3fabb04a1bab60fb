"""Edits that do away with a remark of `layout check`. Entry point `find_mends`.

A mend is tried before it is offered: the text after it is a layout, the remark is gone, and there are
fewer remarks than before, or none that was not there but mild ones in place of a grave one.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from math import cos, hypot, pi, sin
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.editing.edits import edited_text
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.advice import Advice, advise
from waiter_cli.model.graph import reached_by_robots
from waiter_cli.model.layout import Layout

__all__ = ["EasyMend", "find_mends"]

Edits = list[dict[str, Any]]
Offer = tuple[str, Edits]
MOST_TRIED = 60
MILD = frozenset({"bottleneck", "dead_end", "unused_node"})
"""Kinds of remarks about floors on which everything can be done."""


@dataclass(frozen=True)
class EasyMend:
    """The words of a button, and the edits behind it."""

    label: str
    edits: Edits


def find_mends(
    text: str, file: str, seconds: float = 1.0, wanted: Callable[[], bool] = lambda: True
) -> list[EasyMend | None]:
    """Returns for each remark about a layout, in the order of `advise`, a mend where there is one.

    Raises `LayoutError` where the text is no layout.  Looks no longer than ``seconds``,
    and while ``wanted`` says so.
    """
    layout = read_layout(text, file)
    found = advise(layout)
    known = {(each.kind, each.about) for each in found}
    until = time.monotonic() + seconds
    mends: list[EasyMend | None] = []
    for advice in found:
        mend = None
        for number, (label, edits) in enumerate(_offers(layout, advice)):
            if number == MOST_TRIED or time.monotonic() > until or not wanted():
                break
            if _helps(text, file, edits, (advice.kind, advice.about), known):
                mend = EasyMend(label, edits)
                break
        mends.append(mend)
    return mends


def _helps(
    text: str, file: str, edits: Edits, gone: tuple[str, str], known: set[tuple[str, str]]
) -> bool:
    try:
        new, _ = edited_text(text, edits)
        after = {(each.kind, each.about) for each in advise(read_layout(new, file))}
    except InputError:
        return False
    if gone in after:
        return False
    mild = gone[0] not in MILD and all(kind in MILD for kind, _ in after - known)
    return mild or len(after) < len(known)


def _offers(layout: Layout, advice: Advice) -> Iterator[Offer]:
    """Yields what may help against a remark, the least change first."""
    about = advice.about
    match advice.kind:
        case "dead_end" | "unused_node":
            yield f"Delete {about}", [{"do": "delete", "what": [f"node {about}"]}]
        case "idle_objects":
            yield "Leave objects out", [{"do": "delete", "what": ["objects"]}]
        case "unreachable":
            yield from _joined(layout, about)
        case "blocked":
            yield from _aside(layout)
        case "bottleneck":
            yield from _second_way(layout, about)
        case "no_way_back":
            for a, b in layout.edges:
                if (a, b) in layout.one_way and about in (a, b):
                    edit = {"do": "one_way", "what": f"path {a} {b}", "from": None}
                    yield f"Both ways between {a} and {b}", [edit]
        case "edge_through_furniture":
            a, _, b = about.partition("-")
            for table in _tables_near(layout, (a, b)):
                yield from _moved(layout, table)
            yield "Leave the path out", [{"do": "delete", "what": [f"path {a} {b}"]}]
        case "tables_overlap":
            yield from _moved(layout, about)
        case "seats_do_not_fit":
            yield from _fitting(layout, about)
        case "timetable":
            yield from _timely(layout, advice)


def _places(layout: Layout) -> dict[str, tuple[float, float]]:
    return {node.name: node.at for node in layout.nodes if node.at is not None}


def _pairs(layout: Layout, ones: set[str], others: set[str]) -> list[tuple[float, str, str]]:
    """Returns pairs of nodes from two sets that no path joins, the nearest first, with their metres."""
    at, near = _places(layout), layout.joined()
    found = [
        (hypot(at[a][0] - at[b][0], at[a][1] - at[b][1]), a, b)
        for a in sorted(ones & at.keys())
        for b in sorted(others & at.keys())
        if a != b and b not in near[a]
    ]
    return sorted(found)


def _joined(layout: Layout, about: str) -> Iterator[Offer]:
    reached = reached_by_robots(layout)
    lost = {about} & {node.name for node in layout.nodes}
    for table in layout.tables:
        if table.name == about:
            lost = set(table.nodes)
    lost = lost or {layout.entrance}
    for _, a, b in _pairs(layout, lost - reached, reached):
        yield f"Join {a} to {b}", [{"do": "add_path", "ends": [b, a]}]


def _aside(layout: Layout) -> Iterator[Offer]:
    at = _places(layout)
    taken = {
        layout.entrance,
        *(node for _, node in layout.starts),
        *(node for _, node in layout.waiters),
    }
    for waiter, stands in layout.waiters:
        x, y = at.get(stands, (0.0, 0.0))
        free = [name for name in at if name not in taken]
        for node in sorted(free, key=lambda n: hypot(at[n][0] - x, at[n][1] - y)):
            edit = {"do": "stand", "what": f"waiter {waiter}", "node": node}
            yield f"Let {waiter} stand on {node}", [edit]


def _second_way(layout: Layout, cut: str) -> Iterator[Offer]:
    from waiter_cli.model.graph import cut_nodes

    for each in cut_nodes(layout.neighbours(), layout.entrance):
        if each.node != cut:
            continue
        lost = {node for part in each.lost for node in part}
        rest = {node.name for node in layout.nodes} - lost - {cut}
        for _, a, b in _pairs(layout, lost, rest):
            yield f"Add a path {b}–{a}", [{"do": "add_path", "ends": [b, a]}]


def _tables_near(layout: Layout, ends: tuple[str, str]) -> list[str]:
    at = _places(layout)
    (ax, ay), (bx, by) = at[ends[0]], at[ends[1]]
    middle = ((ax + bx) / 2, (ay + by) / 2)
    placed = {table.name: table.at for table in layout.tables if table.at is not None}
    order = sorted(placed, key=lambda n: hypot(placed[n][0] - middle[0], placed[n][1] - middle[1]))
    return order[:2]


def _moved(layout: Layout, name: str) -> Iterator[Offer]:
    """Yields moves of a table by a few decimetres, the shortest first."""
    table = layout.table(name)
    if table.at is None:
        return
    for tenths in (1, 2, 3, 5, 8, 12):
        for eighth in range(8):
            turn = eighth * pi / 4
            by = [
                round(tenths / 10 * round(cos(turn)), 3),
                round(tenths / 10 * round(sin(turn)), 3),
            ]
            drawn = {f"table {name}": list(table.at)}
            edit = {"do": "move", "what": [f"table {name}"], "by": by, "drawn": drawn}
            yield f"Move {name} by {hypot(*by):.1f} m", [edit]


def _fitting(layout: Layout, name: str) -> Iterator[Offer]:
    table, what = layout.table(name), f"table {name}"
    x, y = table.size
    for grown in range(1, 6):
        size = [x, round(y + 0.2 * grown, 2)] if y >= x else [round(x + 0.2 * grown, 2), y]
        label = f"Make {name} {size[0]:g} m by {size[1]:g} m"
        yield label, [{"do": "set", "what": what, "key": "size", "value": size}]
    for number, offer in enumerate(_moved(layout, name)):
        if number == 32:
            break
        yield offer
    for capacity in range(table.capacity - 1, 0, -1):
        edit = {"do": "set", "what": what, "key": "capacity", "value": capacity}
        yield f"{capacity} seats at {name}", [edit]


def _timely(layout: Layout, advice: Advice) -> Iterator[Offer]:
    """Yields a timetable with a step on each node of the way, or without the entry."""
    waiter, what = advice.about, f"waiter {advice.about}"
    places = dict(layout.key_where)
    own = [(step, node) for who, step, node in layout.timetable if who == waiter]
    stands = dict(layout.waiters)[waiter]
    for step, node in own:
        if places.get(f"timetable.{waiter}.{step}") == advice.fault.where:
            way = _way(layout, stands, node)
            edits = [
                {"do": "timetable", "what": what, "step": step + number, "node": place}
                for number, place in enumerate(way)
            ]
            if len(way) > 1:
                yield f"Send {waiter} node by node", edits
            yield (
                f"Let {waiter} stay at step {step}",
                [{"do": "timetable", "what": what, "step": step, "node": None}],
            )
        stands = node


def _way(layout: Layout, start: str, end: str) -> list[str]:
    """Returns the nodes of a shortest way, without its start; empty where there is none."""
    near, came = layout.joined(), {start: start}
    todo = [start]
    for node in todo:
        for other in near[node]:
            if other not in came:
                came[other] = node
                todo.append(other)
    way: list[str] = []
    while end in came and end != start:
        way.append(end)
        end = came[end]
    return way[::-1]
