"""Upright solids, and their distance from a point or a straight walk; plain two-dimensional numbers.

Everything in the room stands upright on the floor, and the robot is an upright cylinder lower than
nothing it could pass under: so clearances are distances in the plane.  Metres, radians, x to the
right, y away from the viewer.  Entry points `distance`, `walk_distance`.
"""

from __future__ import annotations

from math import cos, hypot, sin, sqrt
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.geometry import distance_to_segment

__all__ = ["Box", "Disc", "Solid", "distance", "walk_distance"]

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Box:
    """An upright box: centre, half extents before the turn ``yaw`` about z, and height."""

    name: str
    x: float
    y: float
    half_x: float
    half_y: float
    yaw: float = 0.0
    height: float = 0.8

    @property
    def reach(self) -> float:
        """Radius of the circle about the centre that holds the box."""
        return hypot(self.half_x, self.half_y)

    def corners(self, margin: float = 0.0) -> tuple[Point, Point, Point, Point]:
        """Returns the four corners of the footprint grown by ``margin``, counter-clockwise."""
        c, s = cos(self.yaw), sin(self.yaw)
        a, b = self.half_x + margin, self.half_y + margin
        signs = ((-a, -b), (a, -b), (a, b), (-a, b))
        p, q, r, t = ((self.x + c * u - s * v, self.y + s * u + c * v) for u, v in signs)
        return p, q, r, t


@dataclass(frozen=True)
class Disc:
    """An upright cylinder: a person, standing."""

    name: str
    x: float
    y: float
    radius: float
    height: float = 1.7

    @property
    def reach(self) -> float:
        """Radius of the circle about the centre that holds the disc."""
        return self.radius


Solid: TypeAlias = Box | Disc


def distance(x: float, y: float, solid: Solid) -> float:
    """Returns metres from a point to the rim of a solid, negative inside.

    >>> distance(2.0, 0.0, Box("t", 0.0, 0.0, 0.5, 1.0)), distance(3.0, 4.0, Disc("c", 0, 0, 1.0))
    (1.5, 4.0)
    """
    dx, dy = x - solid.x, y - solid.y
    if isinstance(solid, Disc):
        return hypot(dx, dy) - solid.radius
    if solid.yaw:
        c, s = cos(solid.yaw), sin(solid.yaw)
        dx, dy = c * dx + s * dy, c * dy - s * dx
    out_x, out_y = abs(dx) - solid.half_x, abs(dy) - solid.half_y
    if out_x <= 0.0 and out_y <= 0.0:
        return max(out_x, out_y)
    return hypot(max(out_x, 0.0), max(out_y, 0.0))


def walk_distance(start: Point, end: Point, solid: Solid) -> float:
    """Returns the least `distance` of all points of a straight walk.

    From outside it is least at an end of the walk or beside a corner of the box, within it where two
    of the four sides are equally far; to a disc it is least where the walk passes its centre.

    >>> round(walk_distance((-2.0, 0.8), (2.0, 0.8), Box("t", 0.0, 0.0, 0.5, 0.5)), 6)
    0.3
    """
    (ax, ay), (bx, by) = start, end
    length = hypot(bx - ax, by - ay)
    reach = hypot((ax + bx) / 2 - solid.x, (ay + by) / 2 - solid.y) - length / 2 - solid.reach
    if reach > 2.0:  # far away: the bound will do
        return reach
    if isinstance(solid, Disc):
        return distance_to_segment((solid.x, solid.y), (start, end)) - solid.radius
    if solid.yaw:
        c, s = cos(solid.yaw), sin(solid.yaw)
        ax, ay, bx, by = (
            c * (ax - solid.x) + s * (ay - solid.y), c * (ay - solid.y) - s * (ax - solid.x),
            c * (bx - solid.x) + s * (by - solid.y), c * (by - solid.y) - s * (bx - solid.x),
        )  # fmt: skip
    else:
        ax, ay, bx, by = ax - solid.x, ay - solid.y, bx - solid.x, by - solid.y
    depth = _depth(ax, ay, bx, by, solid.half_x, solid.half_y)
    if depth <= 0.0:
        return depth
    return _gap(ax, ay, bx, by, solid.half_x, solid.half_y)


def _depth(ax: float, ay: float, bx: float, by: float, half_x: float, half_y: float) -> float:
    """Returns how far a walk keeps from the four sides' lines of a box about the origin, negative inside.

    At each point the farthest of the four counts; each is linear along the walk, so the least such
    number is at an end or where two of them are equal.
    """
    dx, dy = bx - ax, by - ay
    least = min(max(abs(ax) - half_x, abs(ay) - half_y), max(abs(bx) - half_x, abs(by) - half_y))
    for slope, at in (
        (dx, -ax),
        (dy, -ay),
        (dx - dy, half_x - half_y - ax + ay),
        (dx + dy, half_x - half_y - ax - ay),
        (dx + dy, half_y - half_x - ax - ay),
        (dx - dy, half_y - half_x - ax + ay),
    ):
        if slope and 0.0 < (part := at / slope) < 1.0:
            out_x = abs(ax + part * dx) - half_x
            out_y = abs(ay + part * dy) - half_y
            least = min(least, max(out_x, out_y))
    return least


def _gap(ax: float, ay: float, bx: float, by: float, half_x: float, half_y: float) -> float:
    """Returns how far a walk that does not touch a box about the origin keeps from it."""
    dx, dy = bx - ax, by - ay
    length2 = dx * dx + dy * dy
    least = min(
        hypot(max(abs(ax) - half_x, 0.0), max(abs(ay) - half_y, 0.0)),
        hypot(max(abs(bx) - half_x, 0.0), max(abs(by) - half_y, 0.0)),
    )
    if not length2:
        return least
    for x, y in ((half_x, half_y), (-half_x, half_y), (-half_x, -half_y), (half_x, -half_y)):
        if 0.0 < (x - ax) * dx + (y - ay) * dy < length2:
            least = min(least, abs((x - ax) * dy - (y - ay) * dx) / sqrt(length2))
    return least
