"""Boxes and lines that labels should not cover, by weight. Entry points `WeightedBoxes`, `overlap`.

Drawings and pictures place their labels by it: whatever is there already is put in, and each place
that a label might take has a cost.  Everything is in pixels, y down.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import product
from math import hypot
from typing import TypeAlias

__all__ = ["Box", "Line", "WeightedBoxes", "enclosing", "length_inside", "overlap", "touching"]

Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, right, bottom in pixels of the final picture."""
Line: TypeAlias = tuple[float, float, float, float]
"""The first end (x, y) and the last one."""

CELL = 64.0
"""Pixels of a cell of the grid in which things are looked up."""


class WeightedBoxes:
    """Boxes and lines on a picture; ``cost`` says how much of them is under a box."""

    def __init__(self) -> None:
        self._things: list[tuple[Box | Line, float, str, bool]] = []
        self._cells: dict[tuple[int, int], list[int]] = {}

    def box(self, box: Box, weight: float, name: str = "") -> None:
        """Adds something that fills a box; by its name it can be left out of a cost."""
        self._put(box, weight, name, False, box)

    def line(self, line: Line, wide: float) -> None:
        """A straight line, ``wide`` pixels times its weight."""
        x0, y0, x1, y1 = line
        around = min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)
        self._put(line, wide, "", True, around)

    def cost(self, box: Box, but: Collection[str] = ()) -> float:
        """Returns weighted pixels under a box, ``but`` for what has one of these names."""
        numbers = {number for cell in _cells(box) for number in self._cells.get(cell, ())}
        total = 0.0
        for number in sorted(numbers):
            thing, weight, name, is_line = self._things[number]
            if not name or name not in but:
                total += weight * (length_inside(thing, box) if is_line else overlap(thing, box))
        return total

    def _put(self, thing: Box | Line, weight: float, name: str, is_line: bool, around: Box) -> None:
        for cell in _cells(around):
            self._cells.setdefault(cell, []).append(len(self._things))
        self._things.append((thing, weight, name, is_line))


def overlap(a: Box, b: Box) -> float:
    """Returns square pixels that two boxes share.

    >>> overlap((0, 0, 10, 10), (8, 5, 20, 20)), overlap((0, 0, 10, 10), (10, 0, 20, 10))
    (10, 0.0)
    """
    if a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]:
        return 0.0
    return (min(a[2], b[2]) - max(a[0], b[0])) * (min(a[3], b[3]) - max(a[1], b[1]))


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


def enclosing(boxes: Sequence[Box]) -> Box:
    """Returns the smallest box around all of some boxes.

    >>> enclosing([(0, 5, 10, 10), (3, 0, 20, 8)])
    (0, 0, 20, 10)
    """
    lefts, tops, rights, bottoms = zip(*boxes)
    return min(lefts), min(tops), max(rights), max(bottoms)


def touching(boxes: Sequence[Box], held: Iterable[Box]) -> list[Box]:
    """Returns those held that may meet any of the boxes."""
    around = enclosing(boxes)
    return [box for box in held if overlap(box, around)]


def _cells(box: Box) -> Iterator[tuple[int, int]]:
    left, top, right, bottom = (int(edge // CELL) for edge in box)
    return product(range(left, right + 1), range(top, bottom + 1))
