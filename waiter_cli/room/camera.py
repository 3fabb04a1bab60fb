"""Chooses a viewpoint from which the whole room is in the picture and no node is hidden. Pure.

Entry point `frame_room`.  `Camera.project` takes metres to pixels.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, radians, sin, sqrt, tan
from typing import TypeAlias

from sparc.lazy_dataclass import dataclass
from waiter_cli.room.room import Room
from waiter_cli.room.shapes import Box

__all__ = ["Camera", "Vec", "frame_room", "hidden_nodes"]

Vec: TypeAlias = tuple[float, float, float]
FIELD = 30.0
"""Vertical field of view, degrees: narrow, so that far tables are not much smaller."""
ELEVATIONS = (50, 54, 58, 62, 66, 70, 75, 80)
MARGIN = 0.95


@dataclass(frozen=True)
class Camera:
    """A pinhole at ``eye`` that looks along ``forward``; ``width`` and ``height`` in pixels."""

    eye: Vec
    forward: Vec
    right: Vec
    up: Vec
    width: int
    height: int
    near: float
    far: float

    @property
    def half(self) -> tuple[float, float]:
        """Returns half the width and height of the picture plane at distance 1."""
        top = tan(radians(FIELD / 2))
        return top * self.width / self.height, top

    def project(self, x: float, y: float, z: float = 0.0) -> tuple[float, float]:
        """Returns pixels from the left and from the top."""
        dx, dy, dz = x - self.eye[0], y - self.eye[1], z - self.eye[2]
        depth = dx * self.forward[0] + dy * self.forward[1] + dz * self.forward[2]
        across = (dx * self.right[0] + dy * self.right[1] + dz * self.right[2]) / depth
        upward = (dx * self.up[0] + dy * self.up[1] + dz * self.up[2]) / depth
        half_x, half_y = self.half
        return (across / half_x + 1) * self.width / 2, (1 - upward / half_y) * self.height / 2

    def scale_at(self, x: float, y: float, z: float = 0.0) -> float:
        """Returns pixels a metre at a place."""
        depth = sum((p - e) * f for p, e, f in zip((x, y, z), self.eye, self.forward))
        return self.height / 2 / (depth * self.half[1])


def frame_room(room: Room, width: int, height: int) -> Camera:
    """Returns a camera that sees all of the room, as flat as it can be without hiding a node.

    It looks along the shorter side of the room, so that the longer one lies across the picture; a
    long room is seen from higher up, which fills the picture better.
    """
    x0, x1, y0, y1 = room.bounds
    wide = (x1 - x0) >= 0.85 * (y1 - y0) or width < height
    azimuth = -pi / 2 if wide else 0.0
    sides = sorted((x1 - x0, y1 - y0))
    least = 50 + 8 * min(max(sides[1] / sides[0] - 1.5, 0.0), 2.0)
    best: tuple[int, Camera] | None = None
    for elevation in (e for e in ELEVATIONS if e >= least):
        camera = _fitted(room, width, height, azimuth, radians(elevation))
        hidden = len(hidden_nodes(room, camera))
        if best is None or hidden < best[0]:
            best = (hidden, camera)
        if hidden == 0:
            break
    assert best is not None
    return best[1]


def hidden_nodes(room: Room, camera: Camera) -> list[str]:
    """Returns nodes that furniture stands before, as seen by the camera."""
    blocks: list[tuple[Box, float, float]] = [(b, 0.68, 0.78) for b in room.tables.values()]
    blocks += [(wall, 0.0, wall.height) for wall in room.walls]
    if room.bar is not None:
        blocks.append((room.bar, 0.0, 1.1))
    return [
        name
        for name, (x, y) in room.nodes.items()
        if any(_between(camera.eye, (x, y, 0.01), box, low, high) for box, low, high in blocks)
    ]


def _between(eye: Vec, point: Vec, box: Box, low: float, high: float) -> bool:
    """Returns whether a box from height ``low`` to ``high`` cuts the ray from the eye to a point."""
    c, s = cos(box.yaw), sin(box.yaw)
    ax, ay = eye[0] - box.x, eye[1] - box.y
    bx, by = point[0] - box.x, point[1] - box.y
    enter, leave = 0.0, 0.9999
    rays = (
        (c * ax + s * ay, c * bx + s * by, -box.half_x, box.half_x),
        (c * ay - s * ax, c * by - s * bx, -box.half_y, box.half_y),
        (eye[2], point[2], low, high),
    )
    for start, end, least, most in rays:
        step = end - start
        if abs(step) < 1e-12:
            if not least < start < most:
                return False
            continue
        first, last = sorted(((least - start) / step, (most - start) / step))
        enter, leave = max(enter, first), min(leave, last)
    return enter < leave


def _fitted(room: Room, width: int, height: int, azimuth: float, elevation: float) -> Camera:
    x0, x1, y0, y1 = room.bounds
    corners: list[Vec] = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (0.0, 1.15)]
    target = [(x0 + x1) / 2, (y0 + y1) / 2, 0.3]
    low, high = 1.0, 400.0
    camera = _camera(target, high, azimuth, elevation, width, height, room)
    for _ in range(28):
        middle = sqrt(low * high)
        camera = _camera(target, middle, azimuth, elevation, width, height, room)
        for _ in range(3):  # put what is seen into the middle of the picture
            box = _extent(camera, corners)
            scale = camera.scale_at(target[0], target[1], target[2])
            shift_x = ((box[0] + box[1]) / 2 - width / 2) / scale
            shift_y = ((box[2] + box[3]) / 2 - height / 2) / scale
            target = [
                t + shift_x * r - shift_y * u for t, r, u in zip(target, camera.right, camera.up)
            ]
            camera = _camera(target, middle, azimuth, elevation, width, height, room)
        box = _extent(camera, corners)
        fits = (
            box[1] - box[0] <= MARGIN * width
            and box[3] - box[2] <= MARGIN * height
            and box[0] >= 0
            and box[2] >= 0
            and box[1] <= width
            and box[3] <= height
        )
        low, high = (low, middle) if fits else (middle, high)
    return _camera(target, high * 1.005, azimuth, elevation, width, height, room)


def _extent(camera: Camera, points: Sequence[Vec]) -> tuple[float, float, float, float]:
    seen = []
    for point in points:
        depth = sum((p - e) * f for p, e, f in zip(point, camera.eye, camera.forward))
        if depth <= 0.2:
            return (-1e6, 1e6, -1e6, 1e6)
        seen.append(camera.project(*point))
    xs, ys = [p[0] for p in seen], [p[1] for p in seen]
    return min(xs), max(xs), min(ys), max(ys)


def _camera(
    target: Sequence[float],
    away: float,
    azimuth: float,
    elevation: float,
    width: int,
    height: int,
    room: Room,
) -> Camera:
    ce, se, ca, sa = cos(elevation), sin(elevation), cos(azimuth), sin(azimuth)
    eye = (target[0] + away * ce * ca, target[1] + away * ce * sa, target[2] + away * se)
    forward = (-ce * ca, -ce * sa, -se)
    right = (-sa, ca, 0.0)
    up = (-se * ca, -se * sa, ce)
    x0, x1, y0, y1 = room.bounds
    size = sqrt((x1 - x0) ** 2 + (y1 - y0) ** 2)
    return Camera(eye, forward, right, up, width, height, max(0.2, away - size), away + size)
