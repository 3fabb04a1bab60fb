"""Weighs what makes a name hard to read: furniture, ways, walls. Entry point `obstacles_of`.

Measured in pixels of a picture: how much of it lies under a box, weighted by how much it disturbs.
"""

from __future__ import annotations

from itertools import product

from waiter_cli.labels.node_labels import Spot
from waiter_cli.model.layout import Point
from waiter_cli.room.label_boxes import Box, Line, WeightedBoxes
from waiter_cli.room.room import Room

__all__ = ["obstacles_of"]

SEAT, SITTER, TOP, WALL, WAY = 1.0, 0.7, 0.8, 1.0, 3.0
"""How much a pixel disturbs: of a chair, of whoever may sit there, of a table, of a wall, of a way."""
SITTING = 1.25
"""Metres from the floor to the top of the head of somebody who sits."""


def obstacles_of(room: Room, project: Spot, *, upright: bool) -> WeightedBoxes:
    """Returns what names should not cover in a room, as ``project`` takes it to pixels.

    ``upright`` where things are seen from the side and not from above: whoever sits on a chair
    will be seen above it.
    """
    obstacles = WeightedBoxes()
    for chairs in room.chairs.values():
        for chair in chairs:
            corners = chair.box.corners()
            obstacles.box(_around(project, corners, (0.0, 0.5 if upright else 0.0)), SEAT)
            if upright:
                obstacles.box(_around(project, corners, (0.5, SITTING)), SITTER)
    for box in room.tables.values():
        obstacles.box(_around(project, box.corners(), (0.76 if upright else 0.0,)), TOP)
    if room.bar is not None:
        obstacles.box(_around(project, room.bar.corners(), (0.0, 1.1 if upright else 0.0)), TOP)
    for wall in room.walls:
        a, b, c, d = wall.corners()
        start, end = _middle(a, d), _middle(b, c)
        obstacles.line(_line(project, start, end), WALL * _thick(project, start, 0.15))
    x0, x1, y0, y1 = room.bounds
    corners = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
    for a, b in zip(corners, (*corners[1:], corners[0])):
        obstacles.line(_line(project, a, b), WALL * _thick(project, a, 0.15))
    for edge in room.layout.edges:
        ends = room.nodes[edge[0]], room.nodes[edge[1]]
        obstacles.line(_line(project, *ends), WAY * _thick(project, ends[0], 0.08))
    return obstacles


def _around(project: Spot, corners: tuple[Point, ...], heights: tuple[float, ...]) -> Box:
    spots = [project(x, y, z) for (x, y), z in product(corners, heights)]
    xs, ys = [x for x, _ in spots], [y for _, y in spots]
    return min(xs), min(ys), max(xs), max(ys)


def _middle(a: Point, b: Point) -> Point:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def _line(project: Spot, a: Point, b: Point) -> Line:
    return (*project(*a, 0.0), *project(*b, 0.0))


def _thick(project: Spot, at: Point, metres: float) -> float:
    """Returns pixels that a line of that many metres is wide."""
    (x, y), ends = (
        project(*at, 0.0),
        [project(at[0] + dx, at[1] + dy, 0.0) for dx, dy in ((1, 0), (0, 1))],
    )
    return metres * max(abs(px - x) + abs(py - y) for px, py in ends)
