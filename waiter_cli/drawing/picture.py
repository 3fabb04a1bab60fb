"""`Subject` → a picture on a `Canvas`. Entry points `draw_svg`, `draw_png`.

From the floor up: lanes the robot drives along, furniture, walls, then the walk with its numbers,
staff and guests, and all labels where they cover least.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar

from waiter_cli.drawing import furniture as furnishing
from waiter_cli.drawing import walk_arrows as walking
from waiter_cli.drawing.canvas import PALETTE as C
from waiter_cli.drawing.canvas import ROBOTS, Canvas, text_width
from waiter_cli.drawing.frame import HEADER, LINE, MARGIN, Drawing, Frame
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
    _paint(Drawing(subject, frame, canvas))
    return canvas


def _paint(drawing: Drawing) -> None:
    """Draws everything, from the floor up."""
    furnishing.draw_ground(drawing)
    furnishing.draw_furniture(drawing)
    furnishing.draw_way_in(drawing)
    tracks = walking.draw_tracks(drawing)
    furnishing.draw_dots(drawing)
    names = _place_names(drawing)
    walking.draw_numbers(drawing, tracks)
    furnishing.draw_people(drawing)
    _draw_names(drawing, names)
    _draw_header(drawing)
    _draw_footer(drawing)
    _draw_listing(drawing)


# -- names of nodes -------------------------------------------------------------------------------


def _place_names(drawing: Drawing) -> dict[str, tuple[str, Area]]:
    """Returns the label of every node and its place; the entrance says that it is one."""
    out = {}
    for name in sorted(drawing.nodes, key=lambda name: name != drawing.layout.entrance):
        entrance = name == drawing.layout.entrance
        text = name if not entrance or name == "entrance" else f"{name} (entrance)"
        size = (text_width(text, drawing.small, bold=entrance) + 4, drawing.small + 1)
        first = drawing.reach(name) + 2
        gaps = [first + more for more in (0, 4, 8, 13, 19, 26)]
        out[name] = text, drawing.placer.place(around(drawing.nodes[name], size, gaps), 1.0)
    return out


def _draw_names(drawing: Drawing, names: dict[str, tuple[str, Area]]) -> None:
    near = drawing.layout.joined()
    for name, (text, area) in names.items():
        entrance = name == drawing.layout.entrance
        bold = entrance or name in drawing.subject.marked
        colour = C.door if entrance else C.ink
        halo = C.lane if _in_lane(drawing, name, near[name], area) else C.floor
        drawing.canvas.text(area.middle, text, drawing.small, colour, bold=bold, halo=halo)


def _in_lane(drawing: Drawing, node: str, near: Sequence[str], area: Area) -> bool:
    """Returns whether the middle of an area lies in the lane of an edge from a node to one ``near`` it."""
    (x, y), (ax, ay) = area.middle, drawing.nodes[node]
    for other in near:
        bx, by = drawing.nodes[other]
        square = (bx - ax) ** 2 + (by - ay) ** 2 or 1.0
        part = min(1.0, max(0.0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square))
        dx, dy = x - ax - part * (bx - ax), y - ay - part * (by - ay)
        if dx * dx + dy * dy < (furnishing.LANE / 2 * drawing.scale) ** 2:
            return True
    return False


# -- round about the room -------------------------------------------------------------------------


def _draw_header(drawing: Drawing) -> None:
    x, y = MARGIN, MARGIN + 12
    drawing.canvas.text((x, y), drawing.layout.name, 22, C.ink, anchor="start", bold=True)
    drawing.canvas.text((x, y + 25), drawing.subject.headline, 13, C.faint, anchor="start")


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


def _draw_footer(drawing: Drawing) -> None:
    """Draws the legend of the signs, and the scale in metres."""
    canvas = drawing.canvas
    x, y = MARGIN + 8, drawing.frame.height - MARGIN - 6
    for fill, rim, word in _legend(drawing.subject):
        thick = {C.door: 3.0, C.walk: 1.6}.get(rim, 1.0)
        canvas.circle((x, y), 5.5 if rim == C.door else 7.5, fill, rim, thick)
        canvas.text((x + 14, y), word, 12, C.faint, anchor="start")
        x += 40 + text_width(word, 12)
    right = drawing.frame.width - MARGIN
    left = right - drawing.scale
    canvas.line(((left, y), (right, y)), C.faint, 2.0)
    for end in (left, right):
        canvas.line(((end, y - 4), (end, y + 4)), C.faint, 2.0)
    canvas.text((right - drawing.scale / 2, y - 13), "1 m", 11, C.faint)


def _draw_listing(drawing: Drawing) -> None:
    """The plan in words beside the room."""
    lines = drawing.frame.listing
    x, y = drawing.frame.panel_left, MARGIN + HEADER + 8
    if not lines:
        return
    drawing.canvas.text((x, y), "The plan", 14, C.ink, anchor="start", bold=True)
    y += LINE + 6
    for steps, text in lines:
        if steps:
            drawing.canvas.text((x + 36, y), steps, 11.5, C.walk, anchor="end", bold=True)
        drawing.canvas.text((x + 46, y), text, 12.5, C.ink, anchor="start")
        y += LINE
