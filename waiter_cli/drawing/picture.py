"""`Subject` → a picture on a `Canvas`. Entry points `draw_svg`, `draw_png`.

From the floor up: lanes the robot drives along, furniture, walls, staff and guests, then the walk
with its numbers, then labels where they cover least.  Metres become pixels by one scale; y is turned
round, since metres count upwards.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import atan2, cos, degrees, hypot, pi, sin
from typing import TYPE_CHECKING, TypeVar

from waiter_cli.drawing.canvas import PALETTE, Canvas, text_width
from waiter_cli.drawing.labels import Area, Placer, around

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Leg, Subject
    from waiter_cli.layout import Table
    from waiter_cli.replay.room import Chair

__all__ = ["draw_png", "draw_svg"]

C = PALETTE
MARGIN, HEADER, FOOTER, LISTING = 26.0, 58.0, 46.0, 270.0
LINE = 21.0
LARGEST = 9000.0
"""Pixels of the room at most, either way: a hall of kilometres is drawn small."""
FEW_DEEDS = 6
"""As many deeds are written out beside their nodes; of more, only the steps."""

AnyCanvas = TypeVar("AnyCanvas", bound=Canvas)
Spot = tuple[float, float]


def draw_svg(subject: Subject) -> str:
    """The picture as an SVG document."""
    from waiter_cli.drawing.svg import SvgCanvas

    return _drawn(subject, SvgCanvas).document()


def draw_png(subject: Subject) -> bytes:
    """The picture as a PNG file; raises `MissingError` where Pillow is not installed."""
    from waiter_cli.drawing.png import PngCanvas

    return _drawn(subject, PngCanvas).document()


def _drawn(
    subject: Subject, make_canvas: Callable[[float, float, str, str], AnyCanvas]
) -> AnyCanvas:
    frame = _Frame(subject)
    title = f"Floor plan of {subject.layout.name}: {subject.headline}"
    canvas = make_canvas(frame.width, frame.height, C.paper, title)
    _Painter(subject, frame, canvas).paint()
    return canvas


class _Frame:
    """Where the room lies in the picture, and how many pixels a metre is."""

    def __init__(self, subject: Subject) -> None:
        x0, x1, y0, y1 = subject.room.bounds
        wide, high = max(x1 - x0, 1.0), max(y1 - y0, 1.0)
        self.scale = min(
            96.0, max(44.0, min(1050.0 / wide, 800.0 / high)), LARGEST / max(wide, high)
        )
        self.left, self.top = MARGIN, MARGIN + HEADER
        self.room_width, self.room_height = wide * self.scale, high * self.scale
        self.origin = (x0, y1)
        lines = _wrapped_listing(subject)
        panel = LISTING + MARGIN if lines else 0.0
        text = text_width(subject.layout.name, 22, bold=True) + 2 * MARGIN
        body = max(self.room_height, LINE * (len(lines) + 2))
        self.width = round(max(self.room_width + 2 * MARGIN + panel, text, 560.0))
        self.height = round(body + HEADER + FOOTER + 2 * MARGIN)
        # A small room stands in the middle of what a long list leaves.
        self.top += (body - self.room_height) / 2
        self.left += (self.width - 2 * MARGIN - panel - self.room_width) / 2
        self.panel_left = self.width - panel

    def at(self, x: float, y: float) -> Spot:
        """The pixel of a place in metres."""
        return (
            self.left + (x - self.origin[0]) * self.scale,
            self.top + (self.origin[1] - y) * self.scale,
        )

    @property
    def area(self) -> Area:
        """The room in pixels."""
        right, bottom = self.left + self.room_width, self.top + self.room_height
        return Area(self.left, self.top, right, bottom)


def _wrapped_listing(subject: Subject) -> list[tuple[str, str]]:
    """The plan in words, in lines that fit beside the room; later lines of one entry have no step."""
    out: list[tuple[str, str]] = []
    for steps, text in subject.listing:
        line = ""
        label = steps
        for word in text.split():
            longer = f"{line} {word}".strip()
            if line and text_width(longer, 12.5) > LISTING - 60:
                out.append((label, line))
                label, longer = "", word
            line = longer
        out.append((label, line))
    return out


class _Painter:
    """The picture in the making."""

    def __init__(self, subject: Subject, frame: _Frame, canvas: Canvas) -> None:
        self.subject, self.room, self.layout = subject, subject.room, subject.layout
        self.frame, self.canvas, self.at = frame, canvas, frame.at
        self.scale = frame.scale
        self.nodes = {name: frame.at(*place) for name, place in subject.room.nodes.items()}
        self.placer = Placer(frame.area)
        self.staff = {node: name for name, node in subject.state.waiters}
        self.small = max(9.0, min(12.0, self.scale / 6))
        self.dot = max(4.0, min(7.0, self.scale * 0.075))

    def paint(self) -> None:
        """Everything, from the floor up."""
        self.floor()
        self.lanes()
        self.marks()
        self.furniture()
        self.walls()
        self.door()
        tracks = self.walk_lines()
        self.node_dots()
        self.block_people()
        self.walk_numbers(tracks)
        self.people()
        self.labels()
        self.header()
        self.footer()
        self.listing()

    # -- the floor ----------------------------------------------------------------------------

    def floor(self) -> None:
        area = self.frame.area
        size = (area.right - area.left, area.bottom - area.top)
        self.canvas.box(area.middle, size, C.floor, C.rim, 1.5, radius=10)

    def lanes(self) -> None:
        wide = 0.5 * self.scale
        for a, b in self.layout.edges:
            self.canvas.line((self.nodes[a], self.nodes[b]), C.lane, wide)
        for a, b in self.layout.edges:
            marked = f"{a}-{b}" in self.subject.marked
            ends = (self.nodes[a], self.nodes[b])
            if marked:
                self.canvas.line(ends, C.mark, 0.22 * self.scale)
            self.canvas.line(ends, C.path, 1.6, (1.0, 5.0))
            self.placer.block_line(*ends, 5.0, 0.7)

    def marks(self) -> None:
        """A glow under whatever is to be pointed out."""
        marked = self.subject.marked
        for name, spot in self.nodes.items():
            who = self.staff.get(name)
            agent = name == self.subject.state.agent and "agent" in marked
            if name in marked or (who is not None and who in marked) or agent:
                self.canvas.circle(spot, 0.32 * self.scale, C.glow, C.mark, 3.0)
        for name, box in self.room.tables.items():
            if name in marked:
                size = (2 * box.half_x * self.scale + 20, 2 * box.half_y * self.scale + 20)
                self.canvas.box(self.at(box.x, box.y), size, C.glow, C.mark, 3.0, radius=14)
        if self.room.bar is not None and "bar" in marked:
            bar = self.room.bar
            size = (2 * bar.half_x * self.scale + 16, 2 * bar.half_y * self.scale + 16)
            self.canvas.box(self.at(bar.x, bar.y), size, C.glow, C.mark, 3.0, radius=12)

    # -- furniture ----------------------------------------------------------------------------

    def furniture(self) -> None:
        present = dict(self.subject.state.chairs)
        seated = dict(self.subject.state.seated)
        for table in self.layout.tables:
            guests = seated.get(table.name, ())
            for number, chair in enumerate(self.room.chairs[table.name]):
                guest = guests[number] if number < len(guests) else None
                self.chair(chair, number < present.get(table.name, table.chairs), guest)
        for table in self.layout.tables:
            self.table(table)
        bar = self.room.bar
        if bar is not None:
            size = (2 * bar.half_x * self.scale, 2 * bar.half_y * self.scale)
            spot = self.at(bar.x, bar.y)
            self.canvas.box(spot, size, C.bar, C.bar_rim, 1.5, radius=4)
            self.canvas.text(spot, "bar", self.small + 1, C.on_dark, bold=True)
            self.block_box(spot, size, 3.0)

    def chair(self, chair: Chair, present: bool, guest: str | None) -> None:
        side = 0.36 * self.scale
        spot = self.at(chair.x, chair.y)
        turn = -degrees(chair.yaw)
        self.block_box(spot, (side, side), 1.5)
        if not present:
            self.canvas.box(
                spot, (side, side), "", C.chair_rim, 1.0, radius=4, angle=turn, dashed=True
            )
            return
        fill, rim = (C.chair, C.chair_rim) if guest is None else (C.guest, C.guest_rim)
        self.canvas.box(spot, (side, side), fill, rim, 1.2, radius=side / 4, angle=turn)
        if guest is None:  # the back of the chair
            back = (spot[0] - 0.38 * side * cos(chair.yaw), spot[1] + 0.38 * side * sin(chair.yaw))
            self.canvas.box(back, (0.2 * side, side), rim, radius=2, angle=turn)
        elif side >= 11:
            size = min(self.small - 0.5, 1.6 * side / max(2, len(guest)))
            self.canvas.text(spot, guest, size, C.on_dark, bold=True)

    def table(self, table: Table) -> None:
        box = self.room.tables[table.name]
        size = (2 * box.half_x * self.scale, 2 * box.half_y * self.scale)
        spot = self.at(box.x, box.y)
        self.canvas.box(spot, size, C.table, C.table_rim, 1.5, radius=min(8.0, size[0] / 6))
        self.block_box(spot, size, 3.0)
        text, fit = table.name, self.small + 1
        while fit > 7.5 and text_width(text, fit, bold=True) > size[0] - 6:
            fit -= 0.5
        lines = [(text, fit, True)]
        if size[1] > 3.4 * fit:
            lines.append((_seats(table.capacity, size[0]), fit - 1.5, False))
        flags = self.flags(table.name)
        if flags:
            lines.append((flags, fit - 1.5, True))
        total = sum(1.25 * height for _, height, _ in lines)
        y = spot[1] - total / 2
        for line, height, bold in lines:
            y += 1.25 * height / 2
            colour = C.on_table if line != flags else C.walk
            self.canvas.text((spot[0], y), line, height, colour, bold=bold)
            y += 1.25 * height / 2

    def flags(self, table: str) -> str:
        """What the guests of a table wait for."""
        state = self.subject.state
        said = [
            word
            for word, tables in (
                ("bill", state.wants_bill),
                ("order", state.ready_to_order),
            )
            if table in tables
        ]
        return ", ".join(said)

    def walls(self) -> None:
        for a, b in self.layout.walls:
            ends = (self.at(*a), self.at(*b))
            self.canvas.line(ends, C.wall, max(4.0, 0.12 * self.scale))
            self.placer.block_line(*ends, 7.0, 1.5)

    def door(self) -> None:
        """An arrow from the door to the entrance node."""
        spot, door = self.nodes[self.layout.entrance], self.at(*self.room.door)
        away = hypot(spot[0] - door[0], spot[1] - door[1])
        if away < 1:
            return
        ux, uy = (spot[0] - door[0]) / away, (spot[1] - door[1]) / away
        half = 0.38 * self.scale
        self.canvas.line(
            (
                (door[0] - uy * half, door[1] + ux * half),
                (door[0] + uy * half, door[1] - ux * half),
            ),
            C.door,
            5.0,
        )
        length = min(0.55 * self.scale, away - 0.2 * self.scale)
        tip = (door[0] + ux * length, door[1] + uy * length)
        if length > 12:
            self.canvas.line((door, (tip[0] - 6 * ux, tip[1] - 6 * uy)), C.door, 3.0)
            self.arrow(tip, atan2(uy, ux), 9.0, C.door)
            self.placer.block_line(door, tip, 8.0, 1.5)

    # -- people -------------------------------------------------------------------------------

    def node_dots(self) -> None:
        for name, spot in self.nodes.items():
            entrance = name == self.layout.entrance
            rim, width = (C.door, 3.0) if entrance else (C.node_rim, 1.4)
            self.canvas.circle(spot, self.dot, C.node, rim, width)
            reach = self.dot + 3
            self.placer.block(
                Area(spot[0] - reach, spot[1] - reach, spot[0] + reach, spot[1] + reach), 3.0
            )

    def guests(self) -> list[tuple[Spot, str]]:
        """Where waiting guests stand, as many as there is room for."""
        names = [guest for party in self.subject.state.waiting for guest in party]
        return [(self.at(*place), name) for place, name in zip(self.room.queue, names)]

    def block_people(self) -> None:
        """Keeps labels off people."""
        side = 0.42 * self.scale
        spots = [self.nodes[node] for _, node in self.subject.state.waiters]
        spots += [spot for spot, _ in self.guests()]
        for spot in [*spots, self.nodes[self.subject.state.agent]]:
            self.block_box(spot, (side, side), 3.0)

    def people(self) -> None:
        for waiter, node in self.subject.state.waiters:
            self.person(self.nodes[node], C.waiter, waiter)
        for spot, name in self.guests():
            self.person(spot, C.guest, name)
        x, y = self.nodes[self.subject.state.agent]
        r = 0.23 * self.scale
        self.canvas.circle((x, y), r, C.robot, C.paper, 2.0)
        self.canvas.box((x, y - 0.1 * r), (1.25 * r, 0.72 * r), C.paper, radius=0.3 * r)
        for side in (-1, 1):
            self.canvas.circle((x + side * 0.3 * r, y - 0.1 * r), 0.15 * r, C.robot)

    def person(self, spot: Spot, colour: str, name: str) -> None:
        r = 0.19 * self.scale
        self.canvas.circle(spot, r, colour, C.paper, 1.5)
        size = min(self.small, 2.6 * r / max(2, len(name)))
        if size >= 6:
            self.canvas.text(spot, name, size, C.on_dark, bold=True)

    # -- the walk -----------------------------------------------------------------------------

    def walk_lines(self) -> list[tuple[Leg, Spot, Spot]]:
        """Every leg as a line of its own: there and back, and again, lie side by side."""
        times: dict[tuple[str, str], int] = {}
        gap = min(0.085 * self.scale, 6.5)
        tracks: list[tuple[Leg, Spot, Spot]] = []
        for leg in self.subject.legs:
            count = times.setdefault((leg.start, leg.end), 0)
            times[leg.start, leg.end] += 1
            (ax, ay), (bx, by) = self.nodes[leg.start], self.nodes[leg.end]
            away = hypot(bx - ax, by - ay) or 1.0
            ux, uy = (bx - ax) / away, (by - ay) / away
            shift = gap * (0.75 + count)
            ox, oy = -uy * shift, ux * shift
            back = min(0.1 * self.scale, away / 4)
            start = (ax + ox + ux * back, ay + oy + uy * back)
            end = (bx + ox - ux * back, by + oy - uy * back)
            tracks.append((leg, start, end))
        points = [spot for _, start, end in tracks for spot in (start, end)]
        if points:
            points = [self.nodes[self.subject.legs[0].start], *points]
            self.canvas.line(points, C.paper, 5.0)
            self.canvas.line(points, C.walk, 2.6)
        for _, start, end in tracks:
            self.placer.block_line(start, end, 5.0, 0.8)
            turn = atan2(end[1] - start[1], end[0] - start[0])
            x, y = (start[0] + 2 * end[0]) / 3, (start[1] + 2 * end[1]) / 3
            self.arrow((x + 6 * cos(turn), y + 6 * sin(turn)), turn, 10.0, C.walk)
        return tracks

    def walk_numbers(self, tracks: Sequence[tuple[Leg, Spot, Spot]]) -> None:
        """The step of every leg in a disc on it, and what is done at a node in a tag beside it."""
        size = max(8.5, self.small - 1)
        for leg, start, end in tracks:
            r = 0.62 * size + 1.2 * len(str(leg.step))
            near = [
                (start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1]))
                for part in (0.4, 0.3, 0.5, 0.2, 0.6, 0.1, 0.75, 0.9)
            ]
            area = self.placer.place(Area(x - r, y - r, x + r, y + r) for x, y in near)
            self.canvas.circle(area.middle, r, C.paper, C.walk, 1.6)
            self.canvas.text(area.middle, str(leg.step), size, C.walk, bold=True)
        for node, text in self.tags():
            box = (text_width(text, size, bold=True) + 10, size + 7)
            gaps = [0.26 * self.scale + 5 * k for k in range(12)]
            spot = self.nodes[node]
            area = self.placer.place(around(spot, box, gaps))
            self.canvas.line((spot, _nearest(area, spot)), C.walk, 1.4)
            self.canvas.box(area.middle, box, C.walk, C.paper, 1.5, radius=box[1] / 2)
            self.canvas.text(area.middle, text, size, C.on_dark, bold=True)

    def tags(self) -> list[tuple[str, str]]:
        """What is written beside nodes: deeds in words, or numbers only where there are many."""
        deeds = self.subject.deeds
        if len(deeds) <= FEW_DEEDS:
            return [(deed.node, f"{deed.step} {deed.text}") for deed in deeds]
        steps: dict[str, list[str]] = {}
        for deed in deeds:
            steps.setdefault(deed.node, []).append(str(deed.step))
        return [
            (node, ", ".join(numbers[k : k + 3]))
            for node, numbers in steps.items()
            for k in range(0, len(numbers), 3)
        ]

    def arrow(self, tip: Spot, turn: float, size: float, colour: str) -> None:
        """A triangle that points where ``turn`` says."""
        points = [tip]
        for side in (pi - 0.45, pi + 0.45):
            points.append((tip[0] + size * cos(turn + side), tip[1] + size * sin(turn + side)))
        self.canvas.polygon(points, colour)

    # -- words --------------------------------------------------------------------------------

    def labels(self) -> None:
        """The names of nodes; the entrance says that it is one."""
        crowded = sorted(self.nodes, key=lambda name: name != self.layout.entrance)
        for name in crowded:
            spot = self.nodes[name]
            entrance = name == self.layout.entrance
            text = name if not entrance or name == "entrance" else f"{name} (entrance)"
            size = (text_width(text, self.small, bold=entrance) + 4, self.small + 3)
            occupied = name == self.subject.state.agent or name in self.staff
            first = 0.28 * self.scale if occupied else self.dot + 3
            area = self.placer.place(around(spot, size, (first, first + 5, first + 11, first + 18)))
            colour = C.door if entrance else C.ink
            marked = name in self.subject.marked
            self.canvas.text(
                area.middle, text, self.small, colour, bold=entrance or marked, halo=C.floor
            )

    def header(self) -> None:
        x, y = MARGIN, MARGIN + 12
        self.canvas.text((x, y), self.layout.name, 22, C.ink, anchor="start", bold=True)
        self.canvas.text((x, y + 25), self.subject.headline, 13, C.faint, anchor="start")

    def footer(self) -> None:
        """What the signs mean, and how long a metre is."""
        y = self.frame.height - MARGIN - 6
        x = MARGIN + 8
        r = 8.0
        entries: list[tuple[str, str]] = [(C.robot, "robot")]
        entries += [(C.waiter, "waiter")] if self.subject.state.waiters else []
        guests = self.subject.state.parties()
        entries += [(C.guest, "guest")] if guests else []
        entries += [(C.walk, "step of the plan")] if self.subject.listing else []
        for colour, word in entries:
            self.canvas.circle((x, y), r, colour, C.paper, 1.0)
            self.canvas.text((x + 14, y), word, 12, C.faint, anchor="start")
            x += 14 + text_width(word, 12) + 26
        self.canvas.circle((x, y), 5.5, C.node, C.door, 3.0)
        self.canvas.text((x + 14, y), "entrance", 12, C.faint, anchor="start")
        metre = self.scale
        right = self.frame.width - MARGIN
        self.canvas.line(((right - metre, y), (right, y)), C.faint, 2.0)
        for end in (right - metre, right):
            self.canvas.line(((end, y - 4), (end, y + 4)), C.faint, 2.0)
        self.canvas.text((right - metre / 2, y - 13), "1 m", 11, C.faint)

    def listing(self) -> None:
        """The plan in words beside the room."""
        lines = _wrapped_listing(self.subject)
        x, y = self.frame.panel_left, MARGIN + HEADER + 8
        if not lines:
            return
        self.canvas.text((x, y), "The plan", 14, C.ink, anchor="start", bold=True)
        y += LINE + 6
        for steps, text in lines:
            if steps:
                self.canvas.text((x + 36, y), steps, 11.5, C.walk, anchor="end", bold=True)
            self.canvas.text((x + 46, y), text, 12.5, C.ink, anchor="start")
            y += LINE

    def block_box(self, spot: Spot, size: tuple[float, float], weight: float) -> None:
        (x, y), (w, h) = spot, size
        self.placer.block(Area(x - w / 2, y - h / 2, x + w / 2, y + h / 2), weight)


def _seats(number: int, room: float) -> str:
    text = f"{number} seat{'' if number == 1 else 's'}"
    return text if text_width(text, 9) < room - 4 else str(number)


def _nearest(area: Area, spot: Spot) -> Spot:
    """The point of an area that is nearest to a spot."""
    return (
        min(max(spot[0], area.left), area.right),
        min(max(spot[1], area.top), area.bottom),
    )
