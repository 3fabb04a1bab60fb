"""Draws the floor of a room in perspective: planks, the robot's ways, the doormat, soft shadows.

Entry point `FloorTexture`, which knows where on the floor the pixels of a picture look.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, floor, hypot
from typing import Any

import numpy as np

from waiter_cli.room.camera import Camera
from waiter_cli.room.room import Room

__all__ = ["FloorTexture"]

FLOOR = (208, 178, 140)
PATH = (52, 108, 152)


class FloorTexture:
    """The floor as ``camera`` sees it in a picture of ``width`` x ``height`` fine pixels.

    ``fine`` of them make one pixel that is shown, across and down.
    """

    def __init__(self, room: Room, camera: Camera, width: int, height: int, fine: int) -> None:
        self.room, self.camera, self.width, self.height = room, camera, width, height
        self.fine = fine

    def places(self, rows: slice, columns: slice = slice(None)) -> tuple[Any, Any]:
        """Returns metres on the floor (x, y) under the pixels of a part of the fine picture."""
        h, w = self.height, self.width
        half_x, half_y = self.camera.half
        j = np.arange(*columns.indices(w), dtype=np.float32)
        i = np.arange(*rows.indices(h), dtype=np.float32)
        across = ((j + 0.5) / w * 2 - 1) * half_x
        upward = (1 - (i + 0.5) / h * 2) * half_y
        f, r, u, eye = self.camera.forward, self.camera.right, self.camera.up, self.camera.eye
        dx = f[0] + across[None, :] * r[0] + upward[:, None] * u[0]
        dy = f[1] + across[None, :] * r[1] + upward[:, None] * u[1]
        dz = np.minimum(f[2] + upward * u[2], -1e-4)[:, None]
        k = -eye[2] / dz
        return eye[0] + k * dx, eye[1] + k * dy

    def pave(self, colours: Any, rows: slice, mask: Any) -> None:
        """Paints a band of a picture, ``rows`` of all, where ``mask`` says that the floor shows."""
        if not mask.any():
            return
        x, y = self.places(rows)
        plank = np.floor(y / 0.26)
        tone = np.modf(
            np.abs(
                np.sin(plank * 12.9898 + np.floor((x + plank * 0.83) / 1.9) * 4.1414) * 43758.547
            )
        )[0]
        seam = np.abs(np.mod(y / 0.26, 1.0) - 0.5) > 0.475
        light = (0.95 + 0.07 * tone) * np.where(seam, 0.90, 1.0)
        colour = np.empty((*x.shape, 3), np.float32)
        for channel in range(3):
            colour[..., channel] = FLOOR[channel] * light
        self._decals(colour, x, y)
        shade = np.ones(x.shape, np.float32)
        solids = [(b.x, b.y, b.half_x, b.half_y, 0.30) for b in self.room.tables.values()]
        for table in self.room.layout.tables:
            solids += [
                (c.x, c.y, 0.17, 0.17, 0.16) for c in self.room.chairs[table.name][: table.chairs]
            ]
        if self.room.bar is not None:
            solids.append(
                (self.room.bar.x, self.room.bar.y, self.room.bar.half_x, self.room.bar.half_y, 0.35)
            )
        low_x, high_x, low_y, high_y = x[mask].min(), x[mask].max(), y[mask].min(), y[mask].max()
        for cx, cy, hx, hy, strength in solids:
            if not (low_x - 1 < cx < high_x + 1 and low_y - 1 < cy < high_y + 1):
                continue
            part = self._near(rows, cx, cy, max(hx, hy) + 0.6)
            if part is None:
                continue
            dx = np.maximum(np.abs(x[part] - cx - 0.05) - hx, 0)
            dy = np.maximum(np.abs(y[part] - cy - 0.06) - hy, 0)
            shade[part] *= 1 - strength * np.exp(-(dx * dx + dy * dy) / 0.02)
        for dx in (
            x - self.room.bounds[0],
            self.room.bounds[1] - x,
            y - self.room.bounds[2],
            self.room.bounds[3] - y,
        ):
            shade *= 1 - 0.10 * np.exp(-np.maximum(dx, 0) / 0.25)
        colour *= shade[..., None]
        colours[mask] = np.clip(colour[mask], 0, 255).astype(np.uint8)

    def _near(self, rows: slice, cx: float, cy: float, reach: float) -> tuple[slice, slice] | None:
        """Returns the part of a band of the fine picture around a place on the floor."""
        corners = [
            self.camera.project(cx + a, cy + b) for a in (-reach, reach) for b in (-reach, reach)
        ]
        first = rows.indices(self.height)
        top = max(floor(min(p[1] for p in corners) * self.fine), first[0]) - first[0]
        bottom = min(ceil(max(p[1] for p in corners) * self.fine), first[1]) - first[0]
        left = max(floor(min(p[0] for p in corners) * self.fine), 0)
        right = min(ceil(max(p[0] for p in corners) * self.fine), self.width)
        if bottom <= top or right <= left:
            return None
        return np.s_[top:bottom, left:right]

    def _decals(self, colour: Any, x: Any, y: Any) -> None:
        def lay(mask: Any, tint: tuple[int, int, int], strength: float) -> None:
            alpha = (np.clip(mask, 0, 1) * strength)[..., None]
            colour[...] = colour * (1 - alpha) + np.array(tint, np.float32) * alpha

        door, soft = self.room.door, 0.012
        lay(
            np.minimum(0.55 - np.abs(x - door[0]), 0.38 - np.abs(y - door[1])) / soft,
            (146, 58, 52),
            0.85,
        )
        lay(
            np.minimum(0.49 - np.abs(x - door[0]), 0.32 - np.abs(y - door[1])) / soft,
            (170, 78, 66),
            0.85,
        )
        low, high = float(y.min()) - 0.3, float(y.max()) + 0.3
        for a, b in self.room.layout.edges:
            (ax, ay), (bx, by) = self.room.nodes[a], self.room.nodes[b]
            if max(ay, by) < low or min(ay, by) > high:
                continue
            length = hypot(bx - ax, by - ay) or 1.0
            k = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length**2, 0, 1)
            away = np.hypot(x - ax - k * (bx - ax), y - ay - k * (by - ay))
            lay((0.04 - away) / soft, PATH, 0.5)
            if (a, b) in self.room.layout.one_way:
                lay(_inside(self.room.arrow(a, b), x, y) / soft, PATH, 0.9)
        for nx, ny in self.room.nodes.values():
            if not low < ny < high:
                continue
            away = np.hypot(x - nx, y - ny)
            lay((0.15 - away) / soft, (250, 250, 250), 0.95)
            lay((0.11 - away) / soft, PATH, 1.0)


def _inside(corners: Sequence[tuple[float, float]], x: Any, y: Any) -> Any:
    """Returns how far each place lies within a triangle, in metres; below 0 outside."""
    sides = []
    for k, (ax, ay) in enumerate(corners):
        (bx, by), (cx, cy) = corners[(k + 1) % 3], corners[(k + 2) % 3]
        turn = 1 if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0 else -1
        long = hypot(bx - ax, by - ay) or 1.0
        sides.append(turn * ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / long)
    return np.minimum.reduce(sides)
