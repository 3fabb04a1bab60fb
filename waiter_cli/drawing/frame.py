"""Maps metres to pixels (`Frame`) and keeps canvas and places (`Drawing`) for every
layer of a picture.

Metres become pixels by one scale; y is turned round, since metres count upwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin
from typing import TYPE_CHECKING

from waiter_cli.drawing.canvas import ROBOTS, Canvas, text_width
from waiter_cli.drawing.label_placement import Area, Placer

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject

__all__ = [
    "FOOTER",
    "HEADER",
    "LINE",
    "MARGIN",
    "Drawing",
    "Frame",
    "Spot",
    "edge_name",
    "pill_size",
]

MARGIN, HEADER, FOOTER, LISTING = 26.0, 58.0, 46.0, 270.0
LINE = 21.0
LARGEST = 9000.0
"""Pixels of the room at most, either way: a hall of kilometres is drawn small."""

Spot = tuple[float, float]


class Frame:
    """The position of the room in the picture, and the number of pixels in a metre."""

    def __init__(self, subject: Subject, least: float) -> None:
        """The frame of a picture that is ``least`` pixels wide at least."""
        x0, x1, y0, y1 = _bounds(subject)
        wide, high = max(x1 - x0, 1.0), max(y1 - y0, 1.0)
        self.scale = min(
            96.0, max(44.0, min(1050.0 / wide, 800.0 / high)), LARGEST / max(wide, high)
        )
        self.left, self.top = MARGIN, MARGIN + HEADER
        self.room_width, self.room_height = wide * self.scale, high * self.scale
        self.origin = (x0, y1)
        self.listing = wrapped_listing(subject)
        panel = LISTING + MARGIN if self.listing else 0.0
        title = text_width(subject.layout.name, 22, bold=True)
        body = max(self.room_height, LINE * (len(self.listing) + 2))
        self.width = round(
            max(self.room_width + 2 * MARGIN + panel, 2 * MARGIN + max(title, least), 560.0)
        )
        self.height = round(body + HEADER + FOOTER + 2 * MARGIN)
        # A small room stands in the middle of what a long list leaves.
        self.top += (body - self.room_height) / 2
        self.left += (self.width - 2 * MARGIN - panel - self.room_width) / 2
        self.panel_left = self.width - panel

    def at(self, x: float, y: float) -> Spot:
        """Returns the pixel of a place in metres."""
        return (
            self.left + (x - self.origin[0]) * self.scale,
            self.top + (self.origin[1] - y) * self.scale,
        )

    @property
    def area(self) -> Area:
        """Returns the room in pixels."""
        right, bottom = self.left + self.room_width, self.top + self.room_height
        return Area(self.left, self.top, right, bottom)


def _bounds(subject: Subject) -> tuple[float, float, float, float]:
    """Returns the room, and more where many guests wait."""
    x0, x1, y0, y1 = subject.room.bounds
    waiting = subject.room.queue[: sum(map(len, subject.state.waiting))]
    xs, ys = [x for x, _ in waiting], [y for _, y in waiting]
    return (
        min([x0, *(x - 0.3 for x in xs)]),
        max([x1, *(x + 0.3 for x in xs)]),
        min([y0, *(y - 0.3 for y in ys)]),
        max([y1, *(y + 0.3 for y in ys)]),
    )


def wrapped_listing(subject: Subject) -> list[tuple[str, str]]:
    """Returns the plan in words, in lines that fit beside the room.

    Later lines of one entry have no step.
    """
    out: list[tuple[str, str]] = []
    for steps, text in subject.listing:
        line = ""
        label = steps
        for word in text.replace(" → ", " →\0").split():  # an arrow stays beside where it leads
            longer = f"{line} {word}".strip()
            if line and text_width(longer, 12.5) > LISTING - 60:
                out.append((label, line.replace("\0", " ")))
                label, longer = "", word
            line = longer
        out.append((label, line.replace("\0", " ")))
    return out


class Drawing:
    """A picture in the making."""

    def __init__(self, subject: Subject, frame: Frame, canvas: Canvas) -> None:
        self.subject, self.room, self.layout = subject, subject.room, subject.layout
        self.frame, self.canvas, self.at = frame, canvas, frame.at
        self.scale = frame.scale
        self.nodes = {name: frame.at(*place) for name, place in subject.room.nodes.items()}
        self.placer = Placer(frame.area)
        self.staff = {node: name for name, node in subject.state.waiters}
        robots = subject.state.stations()
        self.robots = {node: name for name, node in robots.items()}
        self.colours = {name: ROBOTS[k % len(ROBOTS)] for k, name in enumerate(robots)}
        self.small = max(9.0, min(12.0, self.scale / 6))
        self.dot = max(4.0, min(7.0, self.scale * 0.075))

    def guests(self) -> list[tuple[Spot, str]]:
        """Returns places for waiting guests, as many as there is room for."""
        names = [guest for party in self.subject.state.waiting for guest in party]
        return [(self.at(*place), name) for place, name in zip(self.room.queue, names)]

    def reach(self, node: str) -> float:
        """Returns the reach of what stands on a node, in pixels."""
        if node in self.robots:
            return 0.23 * self.scale + 4
        return 0.19 * self.scale + 4 if node in self.staff else self.dot + 1

    def block_box(self, spot: Spot, size: tuple[float, float], weight: float) -> None:
        """Keeps labels off a box."""
        (x, y), (w, h) = spot, size
        self.placer.block(Area(x - w / 2, y - h / 2, x + w / 2, y + h / 2), weight)

    def arrow(self, tip: Spot, turn: float, size: float, colour: str) -> None:
        """A triangle that points where ``turn`` says."""
        points = [tip]
        for side in (pi - 0.45, pi + 0.45):
            points.append((tip[0] + size * cos(turn + side), tip[1] + size * sin(turn + side)))
        self.canvas.polygon(points, colour)

    def pill(
        self, middle: Spot, rows: Sequence[str], size: float, colours: tuple[str, str, str]
    ) -> None:
        """Rows of text on a round box; ``colours`` of the box, its rim and the text."""
        fill, rim, ink = colours
        w, h = pill_size(rows, size)
        self.canvas.box(middle, (w, h), fill, rim, 1.5, radius=min(w, h, size + 7) / 2)
        top = middle[1] - (len(rows) - 1) * 0.6 * size
        for number, row in enumerate(rows):
            self.canvas.text((middle[0], top + 1.2 * size * number), row, size, ink, bold=True)


def edge_name(a: str, b: str) -> str:
    """Returns the placer's name of an edge, the same in both directions."""
    return f"edge {' '.join(sorted((a, b)))}"


def pill_size(rows: Sequence[str], size: float) -> tuple[float, float]:
    """Returns width and height of a round box for some rows; a single short one is in a disc."""
    high = 1.2 * size * (len(rows) - 1) + size + 6
    return max(max(text_width(row, size, bold=True) for row in rows) + 9, high), high
