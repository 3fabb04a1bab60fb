"""Weighs what makes a name hard to read: furniture, ways, walls. Entry point `clutter_of`.

Measured in pixels of a picture: how much of it lies under a box, weighted by how much it disturbs.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from math import hypot

from waiter_cli.model.layout import Point
from waiter_cli.pictures.node_labels import Box, Spot, overlap
from waiter_cli.room.room import Room

__all__ = ["Clutter", "clutter_of", "length_inside"]

SEAT, SITTER, TOP, WALL, WAY = 1.0, 0.7, 0.8, 1.0, 3.0
"""How much a pixel disturbs: of a chair, of whoever may sit there, of a table, of a wall, of a way."""
SITTING = 1.25
"""Metres from the floor to the top of the head of somebody who sits."""
CELL = 64.0

Line = tuple[float, float, float, float]


class Clutter:
    """Boxes and lines on a picture; ``cost`` says how much of them is under a box."""

    def __init__(self) -> None:
        self._things: list[tuple[Box | Line, float, bool]] = []
        self._cells: dict[tuple[int, int], list[int]] = {}

    def box(self, box: Box, weight: float) -> None:
        """Something that fills a box."""
        self._put(box, weight, False, box)

    def line(self, line: Line, wide: float) -> None:
        """A line from the first two numbers to the last two, ``wide`` pixels times its weight."""
        x0, y0, x1, y1 = line
        self._put(line, wide, True, (min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)))

    def cost(self, box: Box) -> float:
        """Weighted pixels under a box."""
        numbers = {number for cell in _cells(box) for number in self._cells.get(cell, ())}
        total = 0.0
        for number in sorted(numbers):
            thing, weight, is_line = self._things[number]
            total += weight * (length_inside(thing, box) if is_line else overlap(thing, box))
        return total

    def _put(self, thing: Box | Line, weight: float, is_line: bool, around: Box) -> None:
        for cell in _cells(around):
            self._cells.setdefault(cell, []).append(len(self._things))
        self._things.append((thing, weight, is_line))


def clutter_of(room: Room, project: Spot, *, upright: bool) -> Clutter:
    """Returns the clutter of a room, as ``project`` takes it to pixels.

    ``upright`` where things are seen from the side and not from above: whoever sits on a chair
    will be seen above it.
    """
    clutter = Clutter()
    for chairs in room.chairs.values():
        for chair in chairs:
            corners = chair.box.corners()
            clutter.box(_around(project, corners, (0.0, 0.5 if upright else 0.0)), SEAT)
            if upright:
                clutter.box(_around(project, corners, (0.5, SITTING)), SITTER)
    for box in room.tables.values():
        clutter.box(_around(project, box.corners(), (0.76 if upright else 0.0,)), TOP)
    if room.bar is not None:
        clutter.box(_around(project, room.bar.corners(), (0.0, 1.1 if upright else 0.0)), TOP)
    for wall in room.walls:
        a, b, c, d = wall.corners()
        start, end = _middle(a, d), _middle(b, c)
        clutter.line(_line(project, start, end), WALL * _thick(project, start, 0.15))
    x0, x1, y0, y1 = room.bounds
    corners = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
    for a, b in zip(corners, (*corners[1:], corners[0])):
        clutter.line(_line(project, a, b), WALL * _thick(project, a, 0.15))
    for edge in room.layout.edges:
        ends = room.nodes[edge[0]], room.nodes[edge[1]]
        clutter.line(_line(project, *ends), WAY * _thick(project, ends[0], 0.08))
    return clutter


def length_inside(line: Line, box: Box) -> float:
    """Returns pixels of a straight line that run inside a box.

    >>> length_inside((0, 5, 100, 5), (20, 0, 50, 10)), length_inside((0, 0, 9, 9), (20, 0, 50, 10))
    (30.0, 0.0)
    """
    x0, y0, x1, y1 = line
    first, last = 0.0, 1.0
    for start, way, low, high in ((x0, x1 - x0, box[0], box[2]), (y0, y1 - y0, box[1], box[3])):
        if way == 0.0:
            if not low < start < high:
                return 0.0
            continue
        near, far = sorted(((low - start) / way, (high - start) / way))
        first, last = max(first, near), min(last, far)
    return max(0.0, last - first) * hypot(x1 - x0, y1 - y0)


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


def _cells(box: Box) -> Iterator[tuple[int, int]]:
    left, top, right, bottom = (int(edge // CELL) for edge in box)
    return product(range(left, right + 1), range(top, bottom + 1))
