"""Where labels go so that they cover as little as possible. Entry point `Placer`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

__all__ = ["Area", "Placer", "around"]

CELL = 48.0
"""Pixels of a cell of the grid in which things are looked up."""


class Area(NamedTuple):
    """An upright rectangle in pixels: left, top, right, bottom."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def middle(self) -> tuple[float, float]:
        """Its centre."""
        return ((self.left + self.right) / 2, (self.top + self.bottom) / 2)

    def shared(self, other: Area) -> float:
        """Square pixels that two areas share."""
        wide = min(self.right, other.right) - max(self.left, other.left)
        high = min(self.bottom, other.bottom) - max(self.top, other.top)
        return wide * high if wide > 0 and high > 0 else 0.0


class Placer:
    """Remembers what is where; each label that is placed is in the way of later ones."""

    def __init__(self, frame: Area) -> None:
        self.frame = frame
        self.cells: dict[tuple[int, int], list[tuple[int, Area, float]]] = {}
        self.count = 0

    def block(self, area: Area, weight: float = 1.0) -> None:
        """Something that a label should not cover, the less the larger ``weight`` is."""
        self.count += 1
        for cell in _cells(area):
            self.cells.setdefault(cell, []).append((self.count, area, weight))

    def block_line(
        self, start: tuple[float, float], end: tuple[float, float], width: float, weight: float
    ) -> None:
        """A line that a label should not cover, as a row of small squares."""
        (ax, ay), (bx, by) = start, end
        count = max(1, int(max(abs(bx - ax), abs(by - ay)) / max(width, 4.0)))
        for k in range(count + 1):
            x, y = ax + (bx - ax) * k / count, ay + (by - ay) * k / count
            self.block(Area(x - width / 2, y - width / 2, x + width / 2, y + width / 2), weight)

    def cost(self, area: Area) -> float:
        """How much an area covers; what sticks out of the frame counts most."""
        inside = area.shared(self.frame)
        whole = (area.right - area.left) * (area.bottom - area.top)
        near = {
            number: weight * area.shared(other)
            for cell in _cells(area)
            for number, other, weight in self.cells.get(cell, ())
        }
        return 20.0 * (whole - inside) + sum(near.values())

    def place(self, candidates: Iterable[Area]) -> Area:
        """The candidate that covers least, the first of several; it is taken from now on."""
        best, least = None, float("inf")
        for area in candidates:
            cost = self.cost(area)
            if cost < least - 1e-6:
                best, least = area, cost
            if least < 1e-6:
                break
        assert best is not None
        self.block(best, 4.0)
        return best


def _cells(area: Area) -> Iterator[tuple[int, int]]:
    """The cells of a coarse grid that an area touches."""
    for column in range(int(area.left // CELL), int(area.right // CELL) + 1):
        for row in range(int(area.top // CELL), int(area.bottom // CELL) + 1):
            yield column, row


def around(at: tuple[float, float], size: tuple[float, float], gaps: Sequence[float]) -> list[Area]:
    """Places for a label of that size round a point, nearest first.

    At each distance of ``gaps``: above right, above left, below right, below left, right, left,
    above, below.
    """
    (x, y), (w, h) = at, size
    out = []
    for gap in gaps:
        near = gap * 0.72
        for cx, cy in (
            (x + near + w / 2, y - near - h / 2),
            (x - near - w / 2, y - near - h / 2),
            (x + near + w / 2, y + near + h / 2),
            (x - near - w / 2, y + near + h / 2),
            (x + gap + w / 2, y),
            (x - gap - w / 2, y),
            (x, y - gap - h / 2),
            (x, y + gap + h / 2),
        ):
            out.append(Area(cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2))
    return out
