"""The room from above: `Snapshot` → picture. Entry point `Scene2D`; it needs Pillow only.

The room is drawn once, four times finer than shown; people and the robot are small pictures that
are made once for each direction and pasted.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, degrees, pi, sin
from typing import Any

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
from waiter_cli.pictures.snapshot import Snapshot
from waiter_cli.room.figures import HAIR, LOOKS, rings_of, shirt_of
from waiter_cli.room.label_boxes import Box, overlap
from waiter_cli.room.room import ROBOT, Room

__all__ = ["Scene2D"]

SKY = (236, 239, 243)
FLOOR = (222, 196, 160)
WOOD, LINEN, OAK, PATH = (140, 94, 56), (244, 240, 228), (178, 128, 80), (92, 138, 172)
STEP = 18  # half as many directions as people are drawn in


class Scene2D:
    """Pictures of ``width`` x ``height`` pixels, north up; a room that is deep is turned by a quarter."""

    def __init__(self, room: Room, width: int, height: int, fineness: int = 3) -> None:
        self.room, self.width, self.height, self.fine = room, width, height, fineness
        x0, x1, y0, y1 = room.bounds
        edge = 0.035 * min(width, height)
        turned = (y1 - y0) > 1.15 * (x1 - x0) and width > height
        self._turned = turned
        wide, high = ((y1 - y0), (x1 - x0)) if turned else ((x1 - x0), (y1 - y0))
        self.scale = min((width - 2 * edge) / wide, (height - 2 * edge) / high)
        self._left = (width - self.scale * wide) / 2
        self._top = (height - self.scale * high) / 2
        self._stickers: dict[tuple[Any, ...], Any] = {}
        self._places: dict[Label, Box] | None = None
        self._tags: dict[str, Tag] = {}
        self._spots: dict[str, tuple[float, float, float]] = {}
        self._room = self._background()

    def project(self, x: float, y: float, z: float) -> tuple[float, float]:
        """Returns pixels of a place; its height does not matter, but bubbles keep off heads."""
        x0, x1, _, y1 = self.room.bounds
        lift = 0.22 * self.scale * z / 1.8 if z > 0.9 else 0.0
        if self._turned:  # east is up
            return self._left + (y1 - y) * self.scale, self._top + (x1 - x) * self.scale - lift
        return self._left + (x - x0) * self.scale, self._top + (y1 - y) * self.scale - lift

    def heads(self, snapshot: Snapshot) -> list[Box]:
        """Returns the boxes of heads in the picture."""
        return [stature.head for stature in self._statures(snapshot)]

    def _statures(self, snapshot: Snapshot) -> list[Stature]:
        """Returns everybody, and at last the robots."""
        statures = [
            Stature(p.name, self._square(p.x, p.y, 0.14), self._square(p.x, p.y, 0.20))
            for p in snapshot.people
        ]
        for each in snapshot.robots:
            robot = self._square(*each.pose[:2], 0.25)
            statures.append(Stature(each.name, robot, robot))
        return statures

    def _angle(self, yaw: float) -> float:
        """Returns the direction on the picture, counter-clockwise from the right."""
        return yaw + pi / 2 if self._turned else yaw

    def _background(self) -> Any:
        """Returns the picture of the empty room with its signs, and places the labels of its nodes."""
        k = self.fine
        image = Image.new("RGB", (self.width * k, self.height * k), SKY)
        draw = ImageDraw.Draw(image)

        def polygon(points: Any, fill: Any, rim: Any = None) -> None:
            flat = [(k * a, k * b) for a, b in (self.project(x, y, 0.0) for x, y in points)]
            draw.polygon(flat, fill)
            if rim is not None:
                width = max(1, round(k * self.scale * 0.02))
                draw.line([*flat, flat[0], flat[1]], rim, width, joint="curve")

        self._draw_floor(polygon)
        self._draw_paths(draw, polygon)
        self._draw_furniture(polygon)
        self._draw_nodes(draw)
        layer = self._signs_and_labels(image.size)
        image.paste(layer, (0, 0), layer)
        return image.resize((self.width, self.height), Image.Resampling.LANCZOS)

    def _draw_floor(self, polygon: Any) -> None:
        """Draws the floor with its boards, and the mat at the door."""
        x0, x1, y0, y1 = self.room.bounds
        polygon(_rectangle(x0 - 0.08, y0 - 0.08, x1 + 0.08, y1 + 0.08), (168, 162, 152))
        polygon(_rectangle(x0, y0, x1, y1), FLOOR)
        y = y0
        while y < y1:
            polygon(_rectangle(x0, y, x1, y + 0.012), (211, 184, 147))
            y += 0.3
        dx, dy = self.room.door
        mat = _rectangle(
            max(x0, dx - 0.55), max(y0, dy - 0.38), min(x1, dx + 0.55), min(y1, dy + 0.38)
        )
        polygon(mat, (164, 74, 64))

    def _draw_paths(self, draw: Any, polygon: Any) -> None:
        """Draws the paths between nodes, those of one way with an arrow."""
        room, k = self.room, self.fine
        for a, b in room.layout.edges:
            line = [tuple(k * v for v in self.project(*room.nodes[n], 0.0)) for n in (a, b)]
            draw.line(line, PATH, max(2, round(k * self.scale * 0.07)))
        for edge in room.layout.one_way:
            polygon(room.arrow(*edge), PATH)

    def _draw_furniture(self, polygon: Any) -> None:
        """Draws walls, counter, chairs and tables."""
        room = self.room
        for wall in room.walls:
            polygon(wall.corners(), (150, 144, 136))
        if room.bar is not None:
            polygon(room.bar.corners(), (86, 58, 40), (52, 36, 26))
        for table in room.layout.tables:
            for chair in room.chairs[table.name][: table.chairs]:
                self._chair(polygon, chair)
        for box in room.tables.values():
            polygon(box.corners(), WOOD, (98, 64, 36))
            polygon(box.corners(-0.08), LINEN)

    def _draw_nodes(self, draw: Any) -> None:
        """Draws a dot for each node."""
        k = self.fine
        for place in self.room.nodes.values():
            px, py = (k * v for v in self.project(*place, 0.0))
            for radius, fill in ((0.15, (255, 255, 255)), (0.11, (46, 104, 150))):
                r = max(radius * self.scale, 3.2 if radius > 0.12 else 2.2) * k
                draw.ellipse([px - r, py - r, px + r, py + r], fill)

    def _signs_and_labels(self, size: tuple[int, int]) -> Any:
        """Returns a layer with the signs, and finds places for the labels of nodes."""
        room = self.room
        self._letters = letters = label_size(room, self.width, self.height)
        layer = Image.new("RGBA", size, (0, 0, 0, 0))
        dots = dots_of(room, self.project, letters)
        self._signs = draw_signs(ImageDraw.Draw(layer), room, self.project, letters, self.fine)
        self._rather_not = rather_not_over(room, self.project, dots)
        taken = [*dots, *self._signs]
        obstacles = obstacles_of(room, self.project, upright=False)
        extent = (self.width, self.height)
        self._labels = lay_out(room, self.project, letters, extent, taken, obstacles.cost)
        return layer

    def _chair(self, polygon: Any, chair: Any) -> None:
        polygon(chair.box.corners(-0.01), OAK, (122, 82, 48))
        c, s = cos(chair.yaw), sin(chair.yaw)
        back = [(-0.20, -0.19), (-0.13, -0.19), (-0.13, 0.19), (-0.20, 0.19)]
        polygon(
            [(chair.x + c * a - s * b, chair.y + s * a + c * b) for a, b in back], (122, 82, 48)
        )

    def draw(self, snapshot: Snapshot, hidden: Sequence[Box] = ()) -> Any:
        """Returns the picture of a moment, without panel and bubbles; those will hide ``hidden``."""
        image = self._room.copy()
        chairs = dict(snapshot.chairs)
        for table in self.room.layout.tables:
            for chair in self.room.chairs[table.name][table.chairs : chairs[table.name]]:
                self._paste(image, ("chair",), chair.x, chair.y, chair.yaw)
        for name in snapshot.served:
            for chair in self.room.chairs[name]:
                if any(abs(p.x - chair.x) + abs(p.y - chair.y) < 0.02 for p in snapshot.people):
                    box = self.room.tables[name]
                    x = min(
                        max(chair.x + 0.5 * cos(chair.yaw), box.x - box.half_x + 0.14),
                        box.x + box.half_x - 0.14,
                    )
                    y = min(
                        max(chair.y + 0.5 * sin(chair.yaw), box.y - box.half_y + 0.14),
                        box.y + box.half_y - 0.14,
                    )
                    self._paste(image, ("plate",), x, y, 0.0)
        for p in snapshot.people:
            self._paste(image, ("person", p.role, p.number % LOOKS, p.hand), p.x, p.y, p.yaw)
        for each in snapshot.robots:
            self._paste(image, ("robot", each.load, each.number), *each.pose)
        self._name_nodes(image, snapshot, hidden)
        self._name_people(image, snapshot, hidden)
        return image

    def _name_nodes(self, image: Any, snapshot: Snapshot, hidden: Sequence[Box]) -> None:
        """Writes the names of nodes where nobody stands."""
        spots = {p.name: (p.x, p.y, 0.22) for p in snapshot.people}
        spots |= {each.name: (*each.pose[:2], 0.36) for each in snapshot.robots}
        squares = {name: self._square(*spot) for name, spot in spots.items()}
        moved = [squares[name] for name in spots if self._spots.get(name) != spots[name]]
        self._spots = spots
        around = [*squares.values(), *hidden]
        self._places = give_way(
            self._labels, lambda box: sum(overlap(box, other) for other in around), self._places,
            lambda box: sum(overlap(box, other) for other in moved),
        )  # fmt: skip
        for label, box in self._places.items():
            sign, rim = self._sign(label)
            image.paste(sign, (round(box[0] - rim), round(box[1] - rim)), sign)

    def _name_people(self, image: Any, snapshot: Snapshot, hidden: Sequence[Box]) -> None:
        """Writes the names of people beside them."""
        names = [name for name, _, _ in snapshot.named]
        self._tags = place_tags(
            self._statures(snapshot), names, tag_size(self._letters),
            (self.width, self.height), [*self._signs, *(self._places or {}).values(), *hidden],
            self._rather_not, self._tags,
        )  # fmt: skip
        for name, role, number in snapshot.named:
            if name in self._tags:
                left, top, _, _ = self._tags[name].box
                picture = self._tag(name, role, number % LOOKS)
                image.paste(picture, (round(left), round(top)), picture)

    def _tag(self, name: str, role: str, number: int) -> Any:
        """Returns the tag of somebody in the size of the picture."""
        key = ("tag", name, role, number)
        if key not in self._stickers:
            fine = tag(name, shirt_of(number, role), tag_size(self._letters), self.fine)
            small = (round(fine.width / self.fine), round(fine.height / self.fine))
            self._stickers[key] = fine.resize(small, Image.Resampling.LANCZOS)
        return self._stickers[key]

    def _square(self, x: float, y: float, half: float) -> Box:
        """Returns pixels around a place on the floor."""
        px, py = self.project(x, y, 0.0)
        return (
            px - half * self.scale, py - half * self.scale,
            px + half * self.scale, py + half * self.scale,
        )  # fmt: skip

    def _sign(self, label: Label) -> tuple[Any, float]:
        """Returns the name of a node in the size of the picture, and the pixels round its text."""
        fine, rim = lettered(label.text, self._letters, self.fine)
        picture = self._stickers.get(("name", label.text))
        if picture is None:
            small = (round(fine.width / self.fine), round(fine.height / self.fine))
            picture = fine.resize(small, Image.Resampling.LANCZOS)
            self._stickers["name", label.text] = picture
        return picture, rim / self.fine

    def _paste(self, image: Any, what: tuple[Any, ...], x: float, y: float, yaw: float) -> None:
        turn = round(self._angle(yaw) / (2 * pi) * STEP * 2) % (STEP * 2)
        sticker = self._stickers.get((what, turn))
        if sticker is None:
            sticker = self._stickers[what, turn] = self._sticker(what, turn)
        px, py = self.project(x, y, 0.0)
        w, h = sticker.size
        image.paste(sticker, (round(px - w / 2), round(py - h / 2)), sticker)

    def _sticker(self, what: tuple[Any, ...], turn: int) -> Any:
        """Returns a small picture of somebody who looks in one of the directions."""
        k, m = 2, self.scale * 2
        side = round(1.3 * m)
        image = Image.new("RGBA", (side, side), (0, 0, 0, 0))
        draw = ImageDraw.Draw(image)
        middle = side / 2

        def oval(x: float, y: float, rx: float, ry: float, fill: Any, rim: Any = None) -> None:
            box = [
                middle + (x - rx) * m,
                middle - (y + ry) * m,
                middle + (x + rx) * m,
                middle - (y - ry) * m,
            ]
            draw.ellipse(box, fill, rim, max(1, round(0.018 * m)) if rim else 0)

        kind = what[0]
        if kind == "robot":
            ring, rim = rings_of(what[2])
            oval(0.0, 0.0, 0.40, 0.40, None, (*ring, 255))
            oval(0.0, 0.0, ROBOT, ROBOT, (30, 34, 42, 255))
            oval(0.0, 0.0, ROBOT * 0.82, ROBOT * 0.82, (246, 247, 250, 255), (*rim, 255))
            oval(0.33, 0.0, 0.15, 0.15, (190, 195, 203, 255), (120, 126, 136, 255))
            oval(0.09, 0.0, 0.06, 0.10, (20, 26, 34, 255))
            load = {
                "plate": (226, 120, 60, 255),
                "jug": (120, 176, 214, 255),
                "basket": (196, 150, 84, 255),
            }.get(what[1])
            if load is not None:
                oval(0.33, 0.0, 0.09, 0.09, load, (255, 255, 255, 255))
        elif kind == "plate":
            oval(0.0, 0.0, 0.10, 0.10, (255, 255, 255, 255), (190, 186, 176, 255))
            oval(0.0, 0.0, 0.05, 0.05, (206, 116, 58, 255))
        elif kind == "chair":
            oval(0.0, 0.0, 0.19, 0.19, (*OAK, 255), (122, 82, 48, 255))
        else:
            _, role, number, hand = what
            shirt = tuple(round(255 * v) for v in shirt_of(number, role))
            hair = tuple(round(255 * v) for v in HAIR[(number * 7 + 1) % len(HAIR)])
            oval(-0.01, 0.0, 0.13, 0.225, (*shirt, 255), (30, 30, 36, 255))
            if hand:
                oval(0.16, 0.20, 0.07, 0.07, (238, 196, 160, 255), (30, 30, 36, 255))
            if role == "waiter":
                oval(0.07, 0.0, 0.05, 0.05, (255, 255, 255, 255))
            oval(0.03, 0.0, 0.105, 0.10, (236, 194, 160, 255), (30, 30, 36, 255))
            oval(-0.015, 0.0, 0.10, 0.10, (*hair, 255))
        image = image.rotate(degrees(turn / (STEP * 2) * 2 * pi), Image.Resampling.BICUBIC)
        small = max(3, round(side / k))
        return image.resize((small, small), Image.Resampling.LANCZOS)

    def close(self) -> None:
        """Does nothing: there is nothing to release."""


def _rectangle(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, float]]:
    """Returns the corners of a rectangle, counter-clockwise."""
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
