"""Places a table whose layout gives no place beside its first node. Entry point `beside`."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

__all__ = ["beside", "distance_to_segment"]

Point = tuple[float, float]
REACH = 4.0
"""Metres beyond which nothing matters to where a table stands."""
GAP = 0.45
"""Metres between the node and the table's rim: the robot's radius and a hand's breadth."""


def distance_to_segment(point: Point, segment: tuple[Point, Point]) -> float:
    """Returns metres from a point to the nearest point of a segment.

    >>> distance_to_segment((1.0, 2.0), ((0.0, 0.0), (4.0, 0.0)))
    2.0
    """
    (ax, ay), (bx, by) = segment
    dx, dy = bx - ax, by - ay
    length = dx * dx + dy * dy
    along = 0.0 if length == 0 else ((point[0] - ax) * dx + (point[1] - ay) * dy) / length
    along = min(1.0, max(0.0, along))
    return hypot(point[0] - ax - along * dx, point[1] - ay - along * dy)


def beside(
    stand: Point,
    size: tuple[float, float],
    paths: Sequence[tuple[Point, Point]],
    taken: Sequence[Point],
) -> Point:
    """Returns the centre of a table of that size beside a node.

    Of the four sides (below, above, right, left) the one that keeps most distance from every
    path and from the centres of other tables; the first of these when several do.
    """
    down = GAP + size[1] / 2
    right = GAP + size[0] / 2 + 0.35  # chairs stand to the right and left
    x, y = stand
    sides = ((x, y - down), (x, y + down), (x + right, y), (x - right, y))

    near = [path for path in paths if _within_reach(stand, path)]
    others = [other for other in taken if _within_reach(stand, (other, other))]

    def room(centre: Point) -> float:
        distances = [distance_to_segment(centre, path) for path in near]
        distances += [hypot(centre[0] - other[0], centre[1] - other[1]) for other in others]
        return min(distances, default=REACH)

    rooms = [room(side) for side in sides]
    best = max(rooms) - 1e-6
    chosen = next(side for side, found in zip(sides, rooms) if found >= best)
    return (round(chosen[0], 6), round(chosen[1], 6))


def _within_reach(point: Point, segment: tuple[Point, Point]) -> bool:
    """Returns whether a segment may come so near to a point that it matters to a table there."""
    (ax, ay), (bx, by) = segment
    return (
        min(ax, bx) - REACH <= point[0] <= max(ax, bx) + REACH
        and min(ay, by) - REACH <= point[1] <= max(ay, by) + REACH
    )
