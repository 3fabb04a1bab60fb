"""`Subject` → a picture on a `Canvas`. Entry points `draw_svg`, `draw_png`.

From the floor up: lanes the robot drives along, furniture, walls, then the walk with its numbers,
staff and guests, and all labels where they cover least.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from waiter_cli.drawing import furniture as furnishing
from waiter_cli.drawing import walk_arrows as walking
from waiter_cli.drawing.canvas import PALETTE as C
from waiter_cli.drawing.canvas import ROBOTS, Canvas, text_width
from waiter_cli.drawing.frame import HEADER, LINE, MARGIN, Desk, Frame
from waiter_cli.drawing.label_placement import Area, around

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject

__all__ = ["draw_png", "draw_svg"]

AnyCanvas = TypeVar("AnyCanvas", bound=Canvas)


def draw_svg(subject: Subject) -> str:
    """Returns the picture as an SVG document."""
    from waiter_cli.drawing.svg import SvgCanvas

    return _drawn(subject, SvgCanvas).document()


def draw_png(subject: Subject) -> bytes:
    """Returns the picture as a PNG file; raises `MissingError` where Pillow is not installed."""
    from waiter_cli.drawing.png import PngCanvas

    return _drawn(subject, PngCanvas).document()


def _drawn(
    subject: Subject, make_canvas: Callable[[float, float, str, str], AnyCanvas]
) -> AnyCanvas:
    frame = Frame(subject, _legend_width(subject) + 110)
    title = f"Floor plan of {subject.layout.name}: {subject.headline}"
    canvas = make_canvas(frame.width, frame.height, C.paper, title)
    _paint(Desk(subject, frame, canvas))
    return canvas


def _paint(desk: Desk) -> None:
    """Everything, from the floor up."""
    furnishing.draw_ground(desk)
    furnishing.draw_furniture(desk)
    furnishing.draw_way_in(desk)
    tracks = walking.draw_tracks(desk)
    furnishing.draw_dots(desk)
    names = _place_names(desk)
    walking.draw_numbers(desk, tracks)
    furnishing.draw_people(desk)
    _draw_names(desk, names)
    _draw_header(desk)
    _draw_footer(desk)
    _draw_listing(desk)


# -- names of nodes -------------------------------------------------------------------------------


def _place_names(desk: Desk) -> dict[str, tuple[str, Area]]:
    """Returns the label of every node and its place; the entrance says that it is one."""
    out = {}
    for name in sorted(desk.nodes, key=lambda name: name != desk.layout.entrance):
        entrance = name == desk.layout.entrance
        text = name if not entrance or name == "entrance" else f"{name} (entrance)"
        size = (text_width(text, desk.small, bold=entrance) + 4, desk.small + 1)
        first = desk.reach(name) + 2
        gaps = [first + more for more in (0, 4, 8, 13, 19, 26)]
        out[name] = text, desk.placer.place(around(desk.nodes[name], size, gaps), 1.0)
    return out


def _draw_names(desk: Desk, names: dict[str, tuple[str, Area]]) -> None:
    for name, (text, area) in names.items():
        entrance = name == desk.layout.entrance
        bold = entrance or name in desk.subject.marked
        colour = C.door if entrance else C.ink
        halo = C.lane if _in_lane(desk, name, area) else C.floor
        desk.canvas.text(area.middle, text, desk.small, colour, bold=bold, halo=halo)


def _in_lane(desk: Desk, node: str, area: Area) -> bool:
    """Returns whether the middle of an area lies in the lane of an edge of a node."""
    (x, y), (ax, ay) = area.middle, desk.nodes[node]
    for other in desk.layout.joined()[node]:
        bx, by = desk.nodes[other]
        square = (bx - ax) ** 2 + (by - ay) ** 2 or 1.0
        part = min(1.0, max(0.0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square))
        dx, dy = x - ax - part * (bx - ax), y - ay - part * (by - ay)
        if dx * dx + dy * dy < (furnishing.LANE / 2 * desk.scale) ** 2:
            return True
    return False


# -- round about the room -------------------------------------------------------------------------


def _draw_header(desk: Desk) -> None:
    x, y = MARGIN, MARGIN + 12
    desk.canvas.text((x, y), desk.layout.name, 22, C.ink, anchor="start", bold=True)
    desk.canvas.text((x, y + 25), desk.subject.headline, 13, C.faint, anchor="start")


def _legend(subject: Subject) -> list[tuple[str, str, str]]:
    """Returns the legend of the discs: colour, rim and word of each."""
    robots = [robot.name for robot in subject.state.robots]
    entries = [(ROBOTS[k % len(ROBOTS)], C.paper, name) for k, name in enumerate(robots)]
    entries = entries or [(C.robot, C.paper, "robot")]
    entries += [(C.waiter, C.paper, "waiter")] if subject.state.waiters else []
    entries += [(C.guest, C.paper, "guest")] if subject.state.parties() else []
    entries += [(C.paper, C.walk, "step of the walk")] if subject.legs else []
    entries += [(C.walk, C.paper, "something done there")] if subject.deeds else []
    return [*entries, (C.node, C.door, "entrance")]


def _legend_width(subject: Subject) -> float:
    return sum(40 + text_width(word, 12) for _, _, word in _legend(subject))


def _draw_footer(desk: Desk) -> None:
    """Draws the legend of the signs, and the scale in metres."""
    canvas = desk.canvas
    x, y = MARGIN + 8, desk.frame.height - MARGIN - 6
    for fill, rim, word in _legend(desk.subject):
        thick = {C.door: 3.0, C.walk: 1.6}.get(rim, 1.0)
        canvas.circle((x, y), 5.5 if rim == C.door else 7.5, fill, rim, thick)
        canvas.text((x + 14, y), word, 12, C.faint, anchor="start")
        x += 40 + text_width(word, 12)
    right = desk.frame.width - MARGIN
    left = right - desk.scale
    canvas.line(((left, y), (right, y)), C.faint, 2.0)
    for end in (left, right):
        canvas.line(((end, y - 4), (end, y + 4)), C.faint, 2.0)
    canvas.text((right - desk.scale / 2, y - 13), "1 m", 11, C.faint)


def _draw_listing(desk: Desk) -> None:
    """The plan in words beside the room."""
    lines = desk.frame.listing
    x, y = desk.frame.panel_left, MARGIN + HEADER + 8
    if not lines:
        return
    desk.canvas.text((x, y), "The plan", 14, C.ink, anchor="start", bold=True)
    y += LINE + 6
    for steps, text in lines:
        if steps:
            desk.canvas.text((x + 36, y), steps, 11.5, C.walk, anchor="end", bold=True)
        desk.canvas.text((x + 46, y), text, 12.5, C.ink, anchor="start")
        y += LINE
