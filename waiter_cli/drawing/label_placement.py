"""Places labels so that they cover as little as possible. Entry point `Placer`."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from math import dist
from typing import NamedTuple

from waiter_cli.room.label_boxes import WeightedBoxes, overlap

__all__ = ["Area", "Placer", "around", "centred", "led", "nearest"]

LABEL = 20.0
"""The weight of a label: others keep off it before they keep off anything else."""


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


class Placer:
    """Remembers what is where; each label that is placed is in the way of later ones."""

    def __init__(self, frame: Area) -> None:
        self.frame = frame
        self._taken = WeightedBoxes()

    def block(self, area: Area, weight: float = 1.0, name: str = "") -> None:
        """Adds something that a label should not cover; the larger ``weight``, the less.

        By its name, labels that belong on it are let onto it.
        """
        self._taken.box(area, weight, name)

    def block_line(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        width: float,
        weight: float,
        name: str = "",
    ) -> None:
        """A line that a label should not cover, as a row of small squares."""
        for area in squares(start, end, width):
            self.block(area, weight, name)

    def cost(self, area: Area, on: Collection[str] = ()) -> float:
        """Returns the cost of an area: what it covers, but for what it is ``on``.

        Sticking out of the frame counts most.
        """
        whole = (area.right - area.left) * (area.bottom - area.top)
        return 20.0 * (whole - overlap(area, self.frame)) + self._taken.cost(area, on)

    def line_cost(
        self, start: tuple[float, float], end: tuple[float, float], width: float
    ) -> float:
        """Returns the cost of what a line covers."""
        return sum(self.cost(area) for area in squares(start, end, width))

    def place(
        self,
        candidates: Iterable[Area],
        later: float = 0.0,
        leader: tuple[tuple[float, float], float] | None = None,
        on: Collection[str] = (),
    ) -> Area:
        """Returns the candidate that covers least, the first of several; it is taken from now on.

        Each candidate costs ``later`` more than the one before it.  With ``leader`` a line leads to
        the label from a spot; what it covers beyond that distance from the spot counts too.  ``on``
        has the names of what may be covered.
        """
        best, least = None, float("inf")
        for number, area in enumerate(candidates):
            cost = later * number
            if cost >= least:
                break
            cost += self.cost(area, on)
            if leader is not None and cost < least:
                ends = led(area, *leader)
                cost += 2.0 * self.line_cost(*ends, 3.0) if ends else 0.0
            if cost < least - 1e-6:
                best, least = area, cost
            if least < 1e-6:
                break
        assert best is not None
        self.block(Area(best[0] - 1, best[1] - 1, best[2] + 1, best[3] + 1), LABEL)
        return best


def squares(start: tuple[float, float], end: tuple[float, float], width: float) -> Iterator[Area]:
    """Yields a line as a row of small squares."""
    (ax, ay), (bx, by) = start, end
    count = max(1, int(max(abs(bx - ax), abs(by - ay)) / max(width, 4.0)))
    for k in range(count + 1):
        x, y = ax + (bx - ax) * k / count, ay + (by - ay) * k / count
        yield Area(x - width / 2, y - width / 2, x + width / 2, y + width / 2)


def led(
    area: Area, spot: tuple[float, float], away: float
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Returns the ends of the line that leads from ``away`` off a spot to an area.

    None where it is short.
    """
    end = nearest(area, spot)
    long = dist(spot, end)
    if long < away + 5:
        return None
    part, last = away / long, (long - 2.5) / long
    (x, y), (u, v) = spot, end
    return (
        (x + part * (u - x), y + part * (v - y)),
        (x + last * (u - x), y + last * (v - y)),
    )


def nearest(area: Area, spot: tuple[float, float]) -> tuple[float, float]:
    """Returns the point of an area that is nearest to a spot."""
    return (
        min(max(spot[0], area.left), area.right),
        min(max(spot[1], area.top), area.bottom),
    )


def centred(at: tuple[float, float], size: tuple[float, float]) -> Area:
    """Returns the area of that size about a point."""
    (x, y), (w, h) = at, size
    return Area(x - w / 2, y - h / 2, x + w / 2, y + h / 2)


def around(at: tuple[float, float], size: tuple[float, float], gaps: Sequence[float]) -> list[Area]:
    """Places for a label of that size round a point, nearest first.

    At each distance of ``gaps``: right, left, above, below, then above right, above left, below
    right, below left, then between those.
    """
    (x, y), (w, h) = at, size
    out = []
    for gap in gaps:
        near = gap * 0.75
        right, up = gap + w / 2, gap + h / 2
        aside, over = near + w / 2, near + h / 2
        for dx, dy in (
            (right, 0.0), (-right, 0.0), (0.0, -up), (0.0, up),
            (aside, -over), (-aside, -over), (aside, over), (-aside, over),
            (w / 3, -up), (-w / 3, -up), (w / 3, up), (-w / 3, up),
            (right, -h / 2), (right, h / 2), (-right, -h / 2), (-right, h / 2),
        ):  # fmt: skip
            out.append(centred((x + dx, y + dy), size))
    return out
