"""Text of a layout → what the room Layout shows of it: the drawing, and what is to be said about it.

Entry point `view_of`.
"""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import Any

from waiter_cli.editing.sketch import Sketch, sketch
from waiter_cli.errors import InputError, LayoutError
from waiter_cli.files.documents import fault_document
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.advice import advise
from waiter_cli.model.layout import Layout
from waiter_cli.pictures.html_page import room_document
from waiter_cli.room.room import PERSON, ROBOT, build_room, without_places

__all__ = ["view_of"]

EMPTY = (-0.5, 9.5, -0.5, 6.5)
"""The floor of a restaurant in which nothing stands yet, metres."""


def view_of(text: str, file: str) -> dict[str, Any]:
    """Returns ``room`` for ``page/floor.js``, ``things`` (`Sketch.document`), ``findings`` and ``valid``.

    A text that is no layout is drawn as far as it is understood; where it is no YAML, ``room`` and
    ``things`` are None.  ``origin`` is to be added to places in ``room`` for those of the text.
    """
    layout, findings = None, []
    try:
        layout = read_layout(text, file)
    except LayoutError as error:
        findings = [
            {**fault_document(fault), "kind": "fault", "about": None, "grave": True}
            for fault in error.faults
        ]
    try:
        drawn = sketch(text)
    except InputError:
        return {"valid": False, "room": None, "things": None, "findings": findings}
    room, origin = None, (0.0, 0.0)
    if layout is not None and without_places(layout) is None:
        built = build_room(layout)
        room, origin = room_document(built), built.origin
        remarks = advise(layout, built)
    elif layout is not None:
        remarks = advise(layout)
    else:
        remarks = ()
    for remark in remarks:
        about = _thing(drawn, remark.about)
        told = fault_document(remark.fault)
        findings.append({**told, "kind": remark.kind, "about": about, "grave": False})
    return {
        "valid": layout is not None,
        "room": room or _outline(drawn, layout),
        "origin": origin,
        "things": drawn.document(text),
        "findings": findings,
    }


def _thing(drawn: Sketch, about: str) -> str | None:
    """Returns the accessible name of what a remark is about."""
    if about in drawn.nodes:
        return f"node {about}"
    if about in drawn.tables:
        return f"table {about}"
    if about in drawn.staff:
        return f"waiter {about}"
    a, _, b = about.partition("-")
    return f"path {a} {b}" if f"path {a} {b}" in drawn.start else None


def _outline(drawn: Sketch, layout: Layout | None) -> dict[str, Any]:
    """Returns the drawing of what is no layout yet, in the shape of `room_document`."""
    bare = [name for name, at in drawn.nodes.items() if at is None]
    round_ = {name: _on_circle(k, len(bare)) for k, name in enumerate(bare)}
    nodes = {name: at or round_[name] for name, at in drawn.nodes.items()}
    tables = {
        name: [*table.at, table.size[0] / 2, table.size[1] / 2, 0]
        for name, table in drawn.tables.items()
        if table.at is not None
    }
    walls = [
        [(ax + bx) / 2, (ay + by) / 2, hypot(bx - ax, by - ay) / 2, 0.05, atan2(by - ay, bx - ax)]
        for (ax, ay), (bx, by) in drawn.walls
    ]
    bar = None
    if drawn.corners is not None:
        (ax, ay), (bx, by) = drawn.corners
        bar = [(ax + bx) / 2, (ay + by) / 2, abs(bx - ax) / 2, abs(by - ay) / 2, 0]
    points = [*nodes.values(), *(box[:2] for box in tables.values())]
    points += [end for wall in drawn.walls for end in wall] + list(drawn.corners or ())
    bounds = list(EMPTY)
    if points:
        xs, ys = [point[0] for point in points], [point[1] for point in points]
        bounds = [min(xs) - 1.2, max(xs) + 1.2, min(ys) - 1.2, max(ys) + 1.2]
    return {
        "layout": layout.name if layout else "",
        "bounds": bounds,
        "nodes": nodes,
        "edges": [[a, b] for a, b, _ in drawn.paths],
        "arrows": [],
        "entrance": drawn.entrance,
        "door": nodes.get(drawn.entrance, [bounds[0], bounds[2]]),
        "tables": tables,
        "chairs": {name: [] for name in tables},
        "bar": bar,
        "walls": walls,
        "robot": ROBOT,
        "person": PERSON,
    }


def _on_circle(number: int, count: int) -> tuple[float, float]:
    radius = max(1.5, 0.25 * count)
    turn = 2 * pi * number / max(count, 1)
    return round(radius * cos(turn), 2), round(radius * sin(turn), 2)
