"""The room in perspective, drawn in layers: `Snapshot` → picture. Entry point `Scene3D`.

The room is drawn once, with its depths.  Afterwards only whoever moved is drawn, alone, in a small
window of the same picture, and put together with the room by depth; shadows are soft blobs on
the floor.  Everything is drawn finer than it is shown, so edges are smooth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import ceil, cos, floor, hypot, sin
from typing import Any, TypeAlias

import numpy as np
from PIL import Image, ImageDraw

from waiter_cli.labels.label_cost import obstacles_of
from waiter_cli.labels.name_tags import Stature, Tag, place_tags, rather_not_over, tag, tag_size
from waiter_cli.labels.node_labels import (
    Label,
    dots_of,
    draw_signs,
    give_way,
    label_size,
    lay_out,
    lettered,
)
from waiter_cli.pictures.floor_texture import FloorTexture
from waiter_cli.pictures.pixel_boxes import Window, common, cut, meet, merged
from waiter_cli.pictures.snapshot import Snapshot
from waiter_cli.room import figures
from waiter_cli.room.camera import frame_room
from waiter_cli.room.figures import Figure
from waiter_cli.room.label_boxes import Box, overlap
from waiter_cli.room.room import Room
from waiter_cli.simulation.bullet import Studio

__all__ = ["Scene3D"]

SKY = (236, 239, 243)
ALIVE = ("robot", "person")


_Ring: TypeAlias = tuple[int, int, int]
"""The colour of the ring around a robot, of 255."""


@dataclass
class _Sprite:
    """Somebody or something as drawn last, in a window of the picture.

    ``shade`` darkens the floor, ``glow`` is how strongly a robot's ``ring`` shows; None: not at all.
    """

    key: tuple[Any, ...]
    window: Window
    colours: Any
    depths: Any
    shade: Any
    glow: Any
    ring: _Ring | None


class Scene3D:
    """Pictures of ``width`` x ``height`` pixels, drawn ``fineness`` times finer."""

    def __init__(self, room: Room, width: int, height: int, fineness: int = 2) -> None:
        self.room, self.width, self.height, self.fine = room, width, height, fineness
        self.camera = frame_room(room, width, height)
        self.floor = FloorTexture(room, self.camera, width * fineness, height * fineness, fineness)
        self.studio = Studio()
        self._sprites: dict[str, _Sprite] = {}
        self._labels: tuple[Label, ...] = ()
        self._places: dict[Label, Box] | None = None
        self._tags: dict[str, Tag] = {}
        self._named: dict[Any, tuple[Window, Any]] = {}
        self._hidden: tuple[Box, ...] = ()
        self._shots = 0
        self._background()
        self._picture = self._coarse(self._colours)

    def project(self, x: float, y: float, z: float) -> tuple[float, float]:
        """Returns pixels of a place."""
        return self.camera.project(x, y, z)

    def heads(self, snapshot: Snapshot) -> list[Box]:
        """Returns the boxes of heads in the picture."""
        return [stature.head for stature in self._statures(snapshot)]

    # ------------------------------------------------------------ the room

    def furnish(self) -> int:
        """Puts floor, furniture and walls before the camera; the body of the floor."""
        room, studio = self.room, self.studio
        x0, x1, y0, y1 = room.bounds
        middle = ((x0 + x1) / 2, (y0 + y1) / 2)
        ground = studio.add(figures.slab((x1 - x0) / 2, (y1 - y0) / 2), *middle, 0.0)
        for box in room.tables.values():
            studio.add(figures.table(box.half_x, box.half_y), box.x, box.y, 0.0)
        for table in room.layout.tables:
            for chair in room.chairs[table.name][: table.chairs]:
                studio.add(figures.chair(), chair.x, chair.y, chair.yaw)
        if room.bar is not None:
            b = room.bar
            studio.add(figures.bar(b.half_x, b.half_y), b.x, b.y, 0.0)
        for w in room.walls:
            # Those before the room are drawn low: one looks over them.
            before = (w.x - middle[0]) * self.camera.forward[0] + (
                w.y - middle[1]
            ) * self.camera.forward[1]
            studio.add(
                figures.wall(w.half_x, w.half_y, w.height if before > 0 else 0.35), w.x, w.y, w.yaw
            )
        if not room.walls:
            self._back_walls()
        return ground[0]

    def _background(self) -> None:
        studio = self.studio
        ground = self.furnish()
        h, w_ = self.height * self.fine, self.width * self.fine
        self._colours = np.empty((h, w_, 3), np.uint8)
        self._depths = np.empty((h, w_), np.float32)
        on_floor = np.empty((h, w_), bool)
        band = max(60, 240 // self.fine)
        for top in range(0, self.height, band):  # in bands, for the memory's sake
            bottom = min(top + band, self.height)
            rows = np.s_[top * self.fine : bottom * self.fine]
            colours, depths, bodies = studio.shoot(
                self.camera, (0, top, self.width, bottom), self.fine
            )
            on_floor[rows] = bodies == ground
            colours = colours.copy()
            colours[bodies < 0] = SKY
            self._colours[rows], self._depths[rows] = colours, depths
            self.floor.pave(self._colours[rows], rows, on_floor[rows])
        self._on_floor = on_floor
        studio.clear()
        self._write_signs()

    def _back_walls(self) -> None:
        """The two or three rims of the room that stand behind it, as seen from the camera."""
        x0, x1, y0, y1 = self.room.bounds
        eye = self.camera.eye
        t, high = 0.05, 1.0
        rims = (
            (eye[1] < y1, (x0 + x1) / 2, y1 + t, (x1 - x0) / 2 + 2 * t, t),
            (eye[1] > y0, (x0 + x1) / 2, y0 - t, (x1 - x0) / 2 + 2 * t, t),
            (eye[0] < x0 or abs(eye[0] - x0) > abs(eye[0] - x1) or (eye[0] > x0 and eye[1] < y0), x0 - t, (y0 + y1) / 2, t, (y1 - y0) / 2 + 2 * t),
            (eye[0] < x1 and not eye[1] < y0, x1 + t, (y0 + y1) / 2, t, (y1 - y0) / 2 + 2 * t),
        )  # fmt: skip
        for behind, x, y, half_x, half_y in rims:
            if behind:
                self.studio.add(figures.wall(half_x, half_y, high), x, y, 0.0)

    def _write_signs(self) -> None:
        """Names of tables, in the room; where those of nodes may stand."""
        layer = Image.new("RGBA", (self.width * self.fine, self.height * self.fine), (0, 0, 0, 0))
        self._letters = size = label_size(self.room, self.width, self.height)
        dots = dots_of(self.room, self.project, size)
        self._signs = draw_signs(ImageDraw.Draw(layer), self.room, self.project, size, self.fine)
        self._rather_not = rather_not_over(self.room, self.project, dots)
        taken = [*dots, *self._signs]
        extent = (self.width, self.height)
        obstacles = obstacles_of(self.room, self.project, upright=True)
        self._labels = lay_out(self.room, self.project, size, extent, taken, obstacles.cost)
        box = layer.getbbox()
        if box is not None:
            left, top, right, bottom = box
            _blend(self._colours[top:bottom, left:right], np.asarray(layer.crop(box), np.float32))

    # ------------------------------------------------------------ who moves

    def draw(self, snapshot: Snapshot, hidden: Sequence[Box] = ()) -> Any:
        """Returns the picture of a moment, a Pillow image.

        Panel and bubbles, which hide ``hidden``, come later.
        """
        actors = self._actors(snapshot)
        dirty: list[Window] = []
        moved: list[_Sprite] = []
        for name in [n for n in self._sprites if n not in actors]:
            dirty.append(self._sprites.pop(name).window)
        for name, (figure, x, y, yaw, shadow, ring) in actors.items():
            key = (id(figure), round(x, 3), round(y, 3), round(yaw, 2))
            old = self._sprites.get(name)
            if old is not None and old.key == key:
                continue
            if old is not None:
                dirty.append(old.window)
            sprite = self._shoot(figure, x, y, yaw, key, shadow, ring)
            if sprite is None:
                self._sprites.pop(name, None)
                continue
            self._sprites[name] = sprite
            dirty.append(sprite.window)
            if name.startswith(ALIVE):
                moved.append(sprite)
        if dirty or not self._named or self._hidden != tuple(hidden):
            self._hidden = tuple(hidden)
            dirty += self._write_names(snapshot, moved)
        for window in merged(dirty):
            self._compose(window)
        return Image.fromarray(self._picture)

    def _write_names(self, snapshot: Snapshot, moved: list[_Sprite]) -> list[Window]:
        """Puts names where nobody stands; the windows in which that changes something."""
        alive = [sprite for name, sprite in self._sprites.items() if name.startswith(ALIVE)]

        def covered(box: Box) -> float:
            bubbles = sum(overlap(box, bubble) for bubble in self._hidden)
            return bubbles + _covered(box, alive, self.fine)

        self._places = give_way(
            self._labels, covered, self._places, lambda box: _covered(box, moved, self.fine)
        )
        named: dict[Any, tuple[Window, Any]] = {}
        for label, box in self._places.items():
            image, rim = lettered(label.text, self._letters, self.fine)
            named[label] = self._name_at(image, box, rim)
        self._tags = self._place_tags(snapshot)
        for name, role, number in snapshot.named:
            if name in self._tags:
                size, shirt = tag_size(self._letters), figures.shirt_of(number, role)
                image = tag(name, shirt, size, self.fine)
                named[name] = self._name_at(image, self._tags[name].box, 0)
        old, self._named = self._named, named
        changed = [old[n][0] for n in old if named.get(n, (None,))[0] != old[n][0]]
        changed += [named[n][0] for n in named if old.get(n, (None,))[0] != named[n][0]]
        inside = (0, 0, self.width, self.height)
        return [cut(window, inside) for window in changed if meet(window, inside)]

    def _name_at(self, image: Any, box: Box, rim: int) -> tuple[Window, Any]:
        """Returns a name with its place in the fine picture, and the window of the
        picture that it is in.
        """
        left, top = round(box[0] * self.fine) - rim, round(box[1] * self.fine) - rim
        window = (
            left // self.fine, top // self.fine,
            -(-(left + image.width) // self.fine), -(-(top + image.height) // self.fine),
        )  # fmt: skip
        return window, (image, left, top)

    def _place_tags(self, snapshot: Snapshot) -> dict[str, Tag]:
        """Returns the names of people beside them."""
        taken = [*self._signs, *(self._places or {}).values(), *self._hidden]
        names = [name for name, _, _ in snapshot.named]
        return place_tags(
            self._statures(snapshot), names, tag_size(self._letters),
            (self.width, self.height), taken, self._rather_not, self._tags,
        )  # fmt: skip

    def _statures(self, snapshot: Snapshot) -> list[Stature]:
        """Returns everybody, and at last the robots."""
        statures = []
        for p in snapshot.people:
            drop, foot = (0.33, 0.40) if p.posture == "sit" else (0.0, 0.0)
            head = self._upright(p.x, p.y, 0.13, 1.57 - drop, 1.60 - drop)
            left, _, right, bottom = self._upright(p.x, p.y, 0.20, foot, 1.5 - drop)
            statures.append(Stature(p.name, head, (left, head[1], right, bottom)))
        for each in snapshot.robots:
            x, y, _ = each.pose
            head = self._upright(x, y, 0.155, 1.09, 1.12)
            statures.append(Stature(each.name, head, self._upright(x, y, 0.25, 0.0, 1.24)))
        return statures

    def _upright(self, x: float, y: float, radius: float, low: float, high: float) -> Box:
        """Returns pixels around an upright cylinder."""
        (left, bottom), (right, top) = self.project(x, y, low), self.project(x, y, high)
        wide = radius * self.camera.scale_at(x, y, high)
        deep = -wide * self.camera.forward[2]
        return min(left, right) - wide, top - deep, max(left, right) + wide, bottom + deep

    def _actors(
        self, snapshot: Snapshot
    ) -> dict[str, tuple[Figure, float, float, float, float, _Ring | None]]:
        actors: dict[str, tuple[Figure, float, float, float, float, _Ring | None]] = {
            each.key: (
                figures.robot(each.load, each.number),
                *each.pose,
                0.42,
                figures.rings_of(each.number)[0],
            )
            for each in snapshot.robots
        }
        for p in snapshot.people:
            figure = figures.person(p.number, p.role, p.posture, p.hand, p.stride)
            actors[f"person {p.name}"] = (
                figure,
                p.x,
                p.y,
                p.yaw,
                0.36 if p.posture == "stand" else 0.0,
                None,
            )
        for table in self.room.layout.tables:
            chairs = self.room.chairs[table.name]
            for chair in chairs[table.chairs : dict(snapshot.chairs)[table.name]]:
                actors[chair.name] = (figures.chair(), chair.x, chair.y, chair.yaw, 0.15, None)
        for name in snapshot.served:
            box = self.room.tables[name]
            seats = [
                p
                for p in snapshot.people
                if p.posture == "sit" and hypot(p.x - box.x, p.y - box.y) < 3
            ]
            own = {(round(c.x, 3), round(c.y, 3)) for c in self.room.chairs[name]}
            spots = []
            for p in seats:
                if (round(p.x, 3), round(p.y, 3)) in own:
                    sx = min(
                        max(p.x + 0.5 * cos(p.yaw), box.x - box.half_x + 0.14),
                        box.x + box.half_x - 0.14,
                    )
                    sy = min(
                        max(p.y + 0.5 * sin(p.yaw), box.y - box.half_y + 0.14),
                        box.y + box.half_y - 0.14,
                    )
                    spots.append((round(sx - box.x, 3), round(sy - box.y, 3)))
            if spots:
                actors[f"plates {name}"] = (
                    figures.plates(tuple(sorted(spots))),
                    box.x,
                    box.y,
                    0.0,
                    0.0,
                    None,
                )
        return actors

    def _shoot(
        self,
        figure: Figure,
        x: float,
        y: float,
        yaw: float,
        key: tuple[Any, ...],
        shadow: float,
        ring: _Ring | None,
    ) -> _Sprite | None:
        c, sn = cos(yaw), sin(yaw)
        points = [
            self.camera.project(x + c * a - sn * b, y + sn * a + c * b, z)
            for a, b, z in _corners(figure)
        ]  # fmt: skip
        if shadow or ring:
            around = 0.46 if ring else 0.42
            points += [
                self.camera.project(x + a, y + b)
                for a in (-around, around)
                for b in (-around, around)
            ]
        left = max(floor(min(p[0] for p in points)), 0)
        top = max(floor(min(p[1] for p in points)), 0)
        right = min(ceil(max(p[0] for p in points)), self.width)
        bottom = min(ceil(max(p[1] for p in points)), self.height)
        if right - left < 2 or bottom - top < 2:
            return None
        window = (left, top, right, bottom)
        self._shots += 1
        if self._shots % 400 == 0:  # PyBullet keeps a little of every body that ever was
            self.studio.clear()
        bodies = self.studio.add(figure, x, y, yaw)
        colours, depths, seen = self.studio.shoot(self.camera, window, self.fine)
        self.studio.remove(bodies)
        shade = glow = None
        if shadow:
            k = self.fine
            area = np.s_[top * k : bottom * k, left * k : right * k]
            gx, gy = self.floor.places(area[0], area[1])
            dx, dy = gx - x, gy - y
            on_floor = self._on_floor[area]
            away = (dx - 0.05) ** 2 + (dy - 0.06) ** 2
            shade = (1 - shadow * np.exp(-away / 0.055) * on_floor)[..., None]
            if ring:
                rim = np.abs(np.hypot(dx, dy) - 0.40)
                glow = (np.clip((0.035 - rim) / 0.012, 0, 1) * on_floor * 0.8)[..., None]
        depths = np.where(seen >= 0, depths, np.float32(9.0))
        return _Sprite(key, window, colours.copy(), depths, shade, glow, ring)

    def _compose(self, window: Window) -> None:
        """Draws a window of the picture anew from the room and all sprites in it."""
        k = self.fine
        left, top, right, bottom = window
        area = np.s_[top * k : bottom * k, left * k : right * k]
        colours = self._colours[area].astype(np.float32)
        depths = self._depths[area].copy()
        present = [s for s in self._sprites.values() if meet(s.window, window)]
        for sprite in present:
            if sprite.shade is not None:
                here, theirs = common(sprite.window, window, k)
                part = colours[here]
                part *= sprite.shade[theirs]
                if sprite.glow is not None:
                    part += (np.array(sprite.ring, np.float32) - part) * sprite.glow[theirs]
        for sprite in present:
            here, theirs = common(sprite.window, window, k)
            front = sprite.depths[theirs] < depths[here]
            colours[here][front] = sprite.colours[theirs][front]
            depths[here][front] = sprite.depths[theirs][front]
        for of, (image, x, y) in self._named.values():
            if meet(of, window):
                edge = (max(x, left * k), max(y, top * k),
                        min(x + image.width, right * k), min(y + image.height, bottom * k))  # fmt: skip
                cut = image.crop((edge[0] - x, edge[1] - y, edge[2] - x, edge[3] - y))
                under = colours[
                    edge[1] - top * k : edge[3] - top * k, edge[0] - left * k : edge[2] - left * k
                ]
                _blend(under, np.asarray(cut, np.float32))
        self._picture[top:bottom, left:right] = self._coarse(colours)

    def _coarse(self, fine: Any) -> Any:
        k = self.fine
        if k == 1:
            return np.clip(fine, 0, 255).astype(np.uint8)
        h, w = fine.shape[0] // k, fine.shape[1] // k
        total = np.zeros((h, w, 3), np.float32)
        for i in range(k):
            for j in range(k):
                total += fine[i::k, j::k]
        return np.clip(total / (k * k), 0, 255).astype(np.uint8)

    def close(self) -> None:
        """Ends PyBullet's client."""
        self.studio.close()


def _blend(under: Any, part: Any) -> None:
    """Puts a picture with transparency over a part of another."""
    alpha = part[..., 3:] / 255.0
    under[...] = (under * (1 - alpha) + part[..., :3] * alpha).astype(under.dtype)


def _covered(box: Box, sprites: list[_Sprite], k: int) -> float:
    """Returns pixels of a box in which somebody is seen, of the final picture."""
    total = 0.0
    for sprite in sprites:
        if overlap(box, sprite.window):
            left, top = sprite.window[:2]
            part = sprite.depths[
                max(0, round((box[1] - top) * k)) : max(0, round((box[3] - top) * k)),
                max(0, round((box[0] - left) * k)) : max(0, round((box[2] - left) * k)),
            ]
            total += np.count_nonzero(part < 9.0) / (k * k)
    return total


@cache
def _corners(figure: Figure) -> tuple[tuple[float, float, float], ...]:
    """Returns the corners of a box around each part of a figure."""
    corners = []
    for part in figure:
        spans = [
            (min(v[k] for v in part.vertices) - 0.02, max(v[k] for v in part.vertices) + 0.02)
            for k in range(3)
        ]
        corners += [(a, b, max(z, 0.0)) for a in spans[0] for b in spans[1] for z in spans[2]]
    return tuple(corners)
