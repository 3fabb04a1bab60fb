"""Draws over and beside the picture of the room: bubbles, banner, the plan. Entry point `Panel`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from PIL import Image, ImageDraw

from waiter_cli.labels.lettering import put, width_of
from waiter_cli.labels.node_labels import Spot
from waiter_cli.pictures.snapshot import Row, Snapshot
from waiter_cli.room.label_boxes import Box, overlap

__all__ = ["Panel", "panel_width"]

INK = (28, 32, 40)
BACK = (27, 31, 39)
SOFT = (150, 160, 176)
TEAL = (32, 170, 176)
COLOURS = {
    "done": (122, 205, 152),
    "failed": (236, 120, 104),
    "now": (255, 255, 255),
    "next": (176, 184, 198),
}

SIDES = tuple((tail, lift) for lift in (0.0, 1.0) for tail in (0.5, 0.3, 0.7, 0.14, 0.86))
"""Where a bubble may be: its tip, as parts of its width, and how much higher it is, in heights."""

Said = tuple[Any, Box]
"""A bubble's picture and where it is, without a tip that is longer than usual."""
Side = tuple[float, float]
Heads = Callable[[Snapshot], Sequence[Box]]
"""Where heads are on the picture, which bubbles leave free where they can."""


def panel_width(width: int) -> int:
    """Returns pixels of the side panel in a picture of that width: even, and none in
    a very small one.
    """
    return 0 if width < 360 else 2 * round(width * 0.24 / 2)


class Panel:
    """Puts a picture of the room, the plan beside it, bubbles and banner together."""

    def __init__(self, width: int, height: int, project: Spot, heads: Heads | None = None) -> None:
        self.width, self.height, self.project = width, height, project
        self._heads = heads or (lambda moment: [])
        self._sides: dict[str, Side] = {}
        self._said: tuple[Snapshot, list[Said]] | None = None
        self.side = panel_width(width)
        self.stage = width - self.side
        self.text = max(9, round(height / 44))
        if self.side:
            self.text = max(9, min(self.text, round(self.side / 15)))
        self._kept: tuple[Any, Any] | None = None
        self._bubbles: dict[tuple[str, bool, int, int], Any] = {}

    def draw(self, room: Any, moment: Snapshot) -> Any:
        """Returns the whole picture; ``room`` is a picture of the stage's size."""
        whole = Image.new("RGB", (self.width, self.height), BACK)
        whole.paste(room, (0, 0))
        draw = ImageDraw.Draw(whole)
        self._say(whole, moment)
        if moment.banner:
            self._warn(draw, moment.banner)
        if self.side:
            whole.paste(self._plan(moment), (self.stage, 0))
            self._clock(draw, moment)
        return whole

    def covered(self, moment: Snapshot) -> list[Box]:
        """Returns the boxes that bubbles and banner will hide, in pixels."""
        boxes = [box for _, box in self._spoken(moment)]
        if moment.banner:
            _, _, wide, high, at = self._warning(moment.banner)
            boxes.append((at, at, at + wide, at + high))
        return boxes

    def _say(self, whole: Any, moment: Snapshot) -> None:
        for image, (left, top, _, _) in self._spoken(moment):
            whole.paste(image, (round(left), round(top)), image)

    def _spoken(self, moment: Snapshot) -> list[Said]:
        """Bubbles with their tips at their speakers, each where it covers fewest faces.

        They are moved up where they would cover each other; one stays on its side while that is
        about as good as any.
        """
        if self._said is not None and self._said[0] is moment:
            return self._said[1]
        bubbles: list[Said] = []
        sides: dict[str, Side] = {}
        heads = self._heads(moment) if moment.bubbles else []
        spots = [(self.project(b.x, b.y, b.z), b) for b in moment.bubbles]
        for (x, y), bubble in sorted(spots, key=lambda s: -s[0][1]):
            w, h = self._extent(bubble.text)
            others = [box for _, box in bubbles]
            boxes = {
                (tail, lift): self._free(x - tail * w, y - h * (1 + lift), w, h, others)
                for tail, lift in SIDES
            }
            costs = {
                side: 0.03 * rank
                + 0.2 * (side[1] > 0)
                + sum(overlap(box, head) / _area(head) for head in heads)
                for rank, (side, box) in enumerate(boxes.items())
            }
            best = min(costs, key=lambda side: costs[side])
            last = self._sides.get(bubble.speaker, best)
            side = last if costs[last] <= costs[best] + 0.15 else best
            box = boxes[side]
            sides[bubble.speaker] = side
            tip = min(max(x - box[0], 0.1 * w), 0.9 * w)
            down = round(side[1] * h)
            image = self._bubble(bubble.text, bubble.speaker.startswith("robot"), round(tip), down)
            bubbles.append((image, box))
        self._sides, self._said = sides, (moment, bubbles)
        return bubbles

    def _free(self, left: float, top: float, w: float, h: float, others: Sequence[Box]) -> Box:
        """Returns a place for a bubble on the stage, above those that it would cover."""
        left = min(max(left, 3), self.stage - w - 3)
        for _ in range(8):
            box = (left, top, left + w, top + h)
            hit = [other for other in others if overlap(other, box)]
            if not hit:
                break
            top = min(other[1] for other in hit) - h - 1
        top = max(top, 3)
        return left, top, left + w, top + h

    def _extent(self, text: str) -> tuple[int, int]:
        """Returns width and height of a bubble in pixels, its tip included."""
        size = max(9, round(self.text * 0.95))
        return max(1, round(width_of(text, size) + 1.2 * size)), max(1, round(2.25 * size))

    def _bubble(self, text: str, robot: bool, tip: int, down: int) -> Any:
        """Returns a bubble as a picture.

        Its tip is so many pixels from its left, and so much longer.
        """
        key = (text, robot, tip, down)
        if key in self._bubbles:
            return self._bubbles[key]
        size, k = max(9, round(self.text * 0.95)), 2
        (w, whole), tail = self._extent(text), size * 0.5
        h, whole = whole - tail, whole + down
        image = Image.new("RGBA", (w * k, whole * k), (0, 0, 0, 0))
        draw = ImageDraw.Draw(image)
        fill, rim, ink = (
            ((16, 138, 146, 250), (8, 96, 104, 255), (255, 255, 255, 255))
            if robot
            else ((255, 255, 255, 248), (70, 76, 88, 255), (24, 26, 32, 255))
        )
        at = tip * k
        draw.rounded_rectangle([1, 1, w * k - 2, h * k - 1], h * k * 0.42, fill, rim, k)
        draw.polygon(
            [
                (at - tail * k * 0.7, h * k - k - 1),
                (at + tail * k * 0.7, h * k - k - 1),
                (at, whole * k - 1),
            ],
            fill,
        )
        draw.line(
            [
                (at - tail * k * 0.7, h * k - 1),
                (at, whole * k - 2),
                (at + tail * k * 0.7, h * k - 1),
            ],
            rim,
            k,
        )
        put(draw, (w * k / 2, h * k * 0.5), text, size * k, ink, anchor="mm")
        self._bubbles[key] = image.resize((w, whole), Image.Resampling.LANCZOS)
        if len(self._bubbles) > 256:
            self._bubbles.pop(next(iter(self._bubbles)))
        return self._bubbles[key]

    def _warning(self, text: str) -> tuple[str, int, float, float, float]:
        """Returns the banner's text, its letters, width, height, and distance from the rims."""
        size = round(self.text * 1.1)
        while text and width_of(text, size) > self.stage - 5 * size:
            text = (
                text[:-2].rstrip() + "…" if not text.endswith("…") else text[:-2].rstrip("… ") + "…"
            )
        return text, size, width_of(text, size) + 2.6 * size, size * 2.1, size * 0.7

    def _warn(self, draw: Any, banner: str) -> None:
        text, size, w, h, at = self._warning(banner)
        draw.rounded_rectangle([at, at, at + w, at + h], size * 0.5, (196, 56, 40))
        draw.ellipse(
            [at + size * 0.5, at + size * 0.55, at + size * 1.5, at + size * 1.55], (255, 255, 255)
        )
        put(draw, (at + size, at + size * 1.07), "!", size, (196, 56, 40), anchor="mm", bold=True)
        put(draw, (at + size * 1.9, at + h / 2), text, size, (255, 255, 255))

    def _plan(self, moment: Snapshot) -> Any:
        """Returns the side panel without its clock; drawn anew only when the plan moves on."""
        size = self.text
        line = round(size * 1.85)
        first = round(size * 6.2)
        fit = max(3, (self.height - first - size) // line)
        start = max(0, min(moment.current - fit // 3, len(moment.rows) - fit))
        rows = moment.rows[start : start + fit]
        key = (rows, moment.title, start, len(moment.rows))
        if self._kept is not None and self._kept[0] == key:
            return self._kept[1]
        image = Image.new("RGB", (self.side, self.height), BACK)
        draw = ImageDraw.Draw(image)
        pad = round(size * 1.1)
        put(
            draw,
            (pad, size * 1.4),
            _cut(moment.title, round(size * 1.25), self.side - 2 * pad),
            round(size * 1.25),
            (255, 255, 255),
            bold=True,
        )
        letters = self.letters_of(moment.rows)
        for k, row in enumerate(rows):
            self._row(draw, row, first + k * line, line, pad, letters)
        if start > 0:
            put(
                draw,
                (self.side - pad, first - line * 0.55),
                f"+{start} before",
                round(size * 0.8),
                SOFT,
                anchor="rm",
            )
        rest = len(moment.rows) - start - len(rows)
        if rest > 0:
            put(
                draw,
                (self.side - pad, self.height - size * 0.6),
                f"+{rest} more",
                round(size * 0.8),
                SOFT,
                anchor="rm",
            )
        self._kept = (key, image)
        return image

    def _row(self, draw: Any, row: Row, top: float, line: int, pad: int, letters: int) -> None:
        size = self.text
        middle = top + line / 2
        if row.state == "now":
            draw.rounded_rectangle(
                [pad * 0.4, top + 1, self.side - pad * 0.4, top + line - 1],
                size * 0.45,
                (28, 104, 122),
            )
            draw.polygon(
                [
                    (pad * 0.9, middle - size * 0.34),
                    (pad * 0.9, middle + size * 0.34),
                    (pad * 0.9 + size * 0.5, middle),
                ],
                (255, 255, 255),
            )
        elif row.state == "done":
            x, s = pad * 0.85, size * 0.32
            draw.line(
                [(x, middle), (x + s, middle + s), (x + 2.4 * s, middle - s)],
                COLOURS["done"],
                max(2, size // 8),
            )
        elif row.state == "failed":
            x, s = pad * 1.1, size * 0.3
            for sign in (1, -1):
                draw.line(
                    [(x - s, middle - s * sign), (x + s, middle + s * sign)],
                    COLOURS["failed"],
                    max(2, size // 8),
                )
        text = _cut(row.text, letters, self.side - pad * 2 - size)
        put(draw, (pad + size, middle), text, letters, COLOURS[row.state])

    def letters_of(self, rows: Sequence[Row]) -> int:
        """Returns pixels of the letters of the plan: less where its longest line would not fit."""
        room = self.side - 2 * round(self.text * 1.1) - self.text
        texts = {row.text for row in rows}
        sizes = range(self.text, max(8, round(self.text * 0.75)), -1)
        fits = (k for k in sizes if all(width_of(text, k) <= room for text in texts))
        return next(fits, sizes.stop)

    def _clock(self, draw: Any, moment: Snapshot) -> None:
        size, pad = self.text, round(self.text * 1.1)
        x, total = self.stage + pad, max(1, len(moment.rows))
        finished = sum(row.state == "done" for row in moment.rows)
        put(draw, (x, size * 3.1), f"{moment.time:.1f} s", size, SOFT)
        put(
            draw,
            (self.width - pad, size * 3.1),
            f"{finished} of {sum(r.state != 'failed' for r in moment.rows)} steps",
            size,
            SOFT,
            anchor="rm",
        )
        top, wide = size * 4.1, self.side - 2 * pad
        draw.rounded_rectangle([x, top, x + wide, top + size * 0.4], size * 0.2, (58, 65, 78))
        part = finished / total
        if part > 0:
            draw.rounded_rectangle(
                [x, top, x + max(size * 0.4, wide * part), top + size * 0.4], size * 0.2, TEAL
            )


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _cut(text: str, size: int, room: float) -> str:
    while len(text) > 2 and width_of(text, size) > room:
        text = text[:-2] + "…"
    return text
