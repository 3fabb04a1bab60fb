"""Text of a layout → what can be drawn and edited of it, be it a layout yet or not. Entry point `sketch`.

Nothing is refused here: what cannot be understood is left out, and `layout check` says what is wrong.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from math import isfinite
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.editing.spans import Piece, pieces_of

__all__ = ["DrawnTable", "Sketch", "sketch"]

Place = tuple[float, float]
SIZE = (0.8, 0.8)


@dataclass(frozen=True)
class DrawnTable:
    """A table as far as it is known; ``at`` and ``size`` in metres."""

    capacity: int
    chairs: int
    nodes: tuple[str, ...]
    at: Place | None
    size: Place


@dataclass(frozen=True)
class Sketch:
    """Things that a text puts on a floor; ``start`` maps the accessible name of a thing to its place in it.

    ``paths`` are (from, to, one way).  ``staff`` maps waiters to nodes, ``robots`` robots; one robot is
    ``agent``.  ``timetable`` is waiter → step → node.
    """

    nodes: dict[str, Place | None]
    paths: tuple[tuple[str, str, bool], ...]
    tables: dict[str, DrawnTable]
    walls: tuple[tuple[Place, Place], ...]
    bar: tuple[str, ...] | None
    corners: tuple[Place, Place] | None
    entrance: str
    robots: dict[str, str]
    staff: dict[str, str]
    timetable: dict[str, dict[str, str]]
    start: dict[str, int]

    def document(self, text: str) -> dict[str, Any]:
        """Returns what the page wants to know about each thing, ``text`` being what this was read from."""
        breaks = [found.start() for found in re.finditer("\n", text)]
        return {
            "nodes": self.nodes,
            "paths": self.paths,
            "tables": {
                name: {
                    "capacity": table.capacity,
                    "chairs": table.chairs,
                    "nodes": table.nodes,
                    "at": table.at,
                    "size": table.size,
                }
                for name, table in self.tables.items()
            },
            "walls": self.walls,
            "bar": self.bar,
            "corners": self.corners,
            "entrance": self.entrance,
            "robots": self.robots,
            "staff": self.staff,
            "timetable": self.timetable,
            "lines": {name: bisect_left(breaks, at) + 1 for name, at in self.start.items()},
        }


def sketch(text: str) -> Sketch:
    """Returns what is understood of a text; raises `InputError` as `pieces_of` does."""
    root = pieces_of(text) or Piece("map", 0, 0)
    start: dict[str, int] = {}
    nodes: dict[str, Place | None] = {}
    listed = root.get("nodes")
    for key, value in listed.entries if listed else ():
        nodes[key.text] = _point(value)
        start[f"node {key.text}"] = key.start
    for item in listed.items if listed else ():
        nodes[item.text] = None
        start[f"node {item.text}"] = item.start
    paths = []
    for item in _items(root.get("edges")):
        ends = _ends(item)
        if ends is not None and ends[0] in nodes and ends[1] in nodes and ends[0] != ends[1]:
            paths.append((*ends, item.kind == "map"))
            start[f"path {ends[0]} {ends[1]}"] = item.start
    tables: dict[str, DrawnTable] = {}
    for key, value in _entries(root.get("tables")):
        tables[key.text] = _table(value)
        start[f"table {key.text}"] = key.start
    walls = []
    for number, item in enumerate(_items(root.get("walls")), 1):
        points = [_point(end) for end in item.items]
        if len(points) != 2 or points[0] is None or points[1] is None:
            break  # numbers count what is listed
        walls.append((points[0], points[1]))
        start[f"wall {number}"] = item.start
    bar, corners = _bar(root.get("bar"))
    if bar is not None:
        start["bar"] = root.key("bar").start
    robots = {}
    for key, value in _entries(root.get("agents")):
        robots[key.text] = value.text
        start[f"robot {key.text}"] = key.start
    agent = root.get("agent")
    if agent is not None and not robots:
        robots["agent"] = agent.text
        start["robot agent"] = root.key("agent").start
    staff = {}
    for key, value in _entries(root.get("waiters")):
        staff[key.text] = value.text
        start[f"waiter {key.text}"] = key.start
    timetable = {
        key.text: {step.text: place.text for step, place in value.entries}
        for key, value in _entries(root.get("timetable"))
    }
    entrance = root.get("entrance")
    return Sketch(
        nodes,
        tuple(paths),
        tables,
        tuple(walls),
        bar,
        corners,
        entrance.text if entrance else "",
        robots,
        staff,
        timetable,
        start,
    )


def _items(piece: Piece | None) -> tuple[Piece, ...]:
    return piece.items if piece is not None else ()


def _entries(piece: Piece | None) -> tuple[tuple[Piece, Piece], ...]:
    return piece.entries if piece is not None else ()


def _number(piece: Piece) -> float | None:
    try:
        value = float(piece.text)
    except ValueError:
        return None
    return value if isfinite(value) and abs(value) <= 1e9 else None


def _point(piece: Piece | None) -> Place | None:
    values = [_number(item) for item in _items(piece)]
    if len(values) != 2 or values[0] is None or values[1] is None:
        return None
    return values[0], values[1]


def _whole(piece: Piece | None, otherwise: int) -> int:
    value = _number(piece) if piece is not None else None
    return otherwise if value is None else max(0, min(1000, int(value)))


def _ends(item: Piece) -> tuple[str, str] | None:
    if item.kind == "map":
        first, second = item.get("from"), item.get("to")
        return (first.text, second.text) if first and second else None
    return (item.items[0].text, item.items[1].text) if len(item.items) == 2 else None


def _names(piece: Piece | None) -> tuple[str, ...]:
    if piece is None:
        return ()
    if piece.kind == "scalar":
        return (piece.text,) if piece.text else ()
    return tuple(item.text for item in piece.items)


def _table(piece: Piece) -> DrawnTable:
    capacity = _whole(piece.get("capacity"), 1)
    stands = _names(piece.get("nodes"))
    at, size = _point(piece.get("at")), _point(piece.get("size"))
    if size is None or min(size) <= 0:
        size = SIZE
    return DrawnTable(capacity, _whole(piece.get("chairs"), capacity), stands, at, size)


def _bar(piece: Piece | None) -> tuple[tuple[str, ...] | None, tuple[Place, Place] | None]:
    if piece is None or piece.is_nothing:
        return None, None
    if piece.kind != "map":
        return _names(piece), None
    first, second = _point(piece.get("from")), _point(piece.get("to"))
    corners = (first, second) if first is not None and second is not None else None
    return _names(piece.get("nodes")), corners
