"""The floor of a picture and what stands on it: lanes, furniture, walls, the way in, people.

Each function draws one layer on a `Drawing`, and tells its placer where labels should not be.
"""

from __future__ import annotations

from math import atan2, cos, degrees, dist, pi, sin
from typing import TYPE_CHECKING

from waiter_cli.drawing.canvas import PALETTE as C
from waiter_cli.drawing.canvas import text_width
from waiter_cli.drawing.frame import edge_name
from waiter_cli.drawing.label_placement import centred
from waiter_cli.model.wording import counted

if TYPE_CHECKING:
    from waiter_cli.drawing.frame import Drawing, Spot
    from waiter_cli.model.layout import Table
    from waiter_cli.room.room import Chair

__all__ = ["draw_dots", "draw_furniture", "draw_ground", "draw_people", "draw_way_in"]

LANE = 0.5
"""Metres that a lane is wide: the robot."""


# -- the ground -----------------------------------------------------------------------------------


def draw_ground(drawing: Drawing) -> None:
    """The floor, the lanes along which the robot drives, and a glow under what is pointed out."""
    area = drawing.frame.area
    size = (area.right - area.left, area.bottom - area.top)
    drawing.canvas.box(area.middle, size, C.floor, C.rim, 1.5, radius=10)
    edges = [(drawing.nodes[a], drawing.nodes[b]) for a, b in drawing.layout.edges]
    for ends in edges:
        drawing.canvas.line(ends, C.lane, LANE * drawing.scale)
    for (a, b), ends in zip(drawing.layout.edges, edges):
        if f"{a}-{b}" in drawing.subject.marked:
            drawing.canvas.line(ends, C.mark, 0.22 * drawing.scale)
        drawing.canvas.line(ends, C.path, 1.6, (1.0, 5.0))
        drawing.placer.block_line(*ends, 5.0, 0.7, edge_name(a, b))
        if (a, b) in drawing.layout.one_way:
            _draw_head(drawing, *ends)
    _draw_marks(drawing)


def _draw_head(drawing: Drawing, start: Spot, end: Spot) -> None:
    """An arrow on a one-way path, past its middle, where no number of a walk stands."""
    turn = atan2(end[1] - start[1], end[0] - start[0])
    size = min(0.3 * drawing.scale, 14.0)
    tip = (start[0] + 0.62 * (end[0] - start[0]), start[1] + 0.62 * (end[1] - start[1]))
    drawing.arrow(tip, turn, size, C.path)
    middle = (tip[0] - size / 2 * cos(turn), tip[1] - size / 2 * sin(turn))
    drawing.block_box(middle, (size, size), 4.0)


def _draw_marks(drawing: Drawing) -> None:
    marked = drawing.subject.marked
    for name, spot in drawing.nodes.items():
        who = drawing.staff.get(name)
        agent = drawing.robots.get(name) in marked
        if name in marked or (who is not None and who in marked) or agent:
            drawing.canvas.circle(spot, 0.32 * drawing.scale, C.glow, C.mark, 3.0)
    solids = [(name, box, 20, 14.0) for name, box in drawing.room.tables.items()]
    solids += [("bar", drawing.room.bar, 16, 12.0)] if drawing.room.bar is not None else []
    for name, box, more, radius in solids:
        if name in marked:
            size = (2 * box.half_x * drawing.scale + more, 2 * box.half_y * drawing.scale + more)
            drawing.canvas.box(drawing.at(box.x, box.y), size, C.glow, C.mark, 3.0, radius=radius)


# -- furniture and walls --------------------------------------------------------------------------


def draw_furniture(drawing: Drawing) -> None:
    """Chairs with those who sit on them, tables, the bar, walls."""
    present = dict(drawing.subject.state.chairs)
    seated = dict(drawing.subject.state.seated)
    for table in drawing.layout.tables:
        guests = seated.get(table.name, ())
        for number, chair in enumerate(drawing.room.chairs[table.name]):
            guest = guests[number] if number < len(guests) else None
            _draw_chair(drawing, chair, number < present.get(table.name, table.chairs), guest)
    for table in drawing.layout.tables:
        _draw_table(drawing, table)
    bar = drawing.room.bar
    if bar is not None:
        size = (2 * bar.half_x * drawing.scale, 2 * bar.half_y * drawing.scale)
        spot = drawing.at(bar.x, bar.y)
        drawing.canvas.box(spot, size, C.bar, C.bar_rim, 1.5, radius=4)
        drawing.canvas.text(spot, "bar", drawing.small + 1, C.on_dark, bold=True)
        drawing.block_box(spot, size, 5.0)
    for a, b in drawing.layout.walls:
        ends = (drawing.at(*a), drawing.at(*b))
        drawing.canvas.line(ends, C.wall, max(4.0, 0.12 * drawing.scale))
        drawing.placer.block_line(*ends, 8.0, 5.0)


def _draw_chair(drawing: Drawing, chair: Chair, present: bool, guest: str | None) -> None:
    side = 0.36 * drawing.scale
    spot = drawing.at(chair.x, chair.y)
    turn = -degrees(chair.yaw)
    canvas = drawing.canvas
    drawing.block_box(spot, (side, side), 5.0)
    if not present:
        canvas.box(spot, (side, side), "", C.chair_rim, 1.0, radius=4, angle=turn, dashed=True)
        return
    fill, rim = (C.chair, C.chair_rim) if guest is None else (C.guest, C.guest_rim)
    canvas.box(spot, (side, side), fill, rim, 1.2, radius=side / 4, angle=turn)
    if guest is None:  # the back of the chair
        back = (spot[0] - 0.38 * side * cos(chair.yaw), spot[1] + 0.38 * side * sin(chair.yaw))
        canvas.box(back, (0.2 * side, side), rim, radius=2, angle=turn)
    elif side >= 11:
        size = min(drawing.small - 0.5, 1.6 * side / max(2, len(guest)))
        canvas.text(spot, guest, size, C.on_dark, bold=True)


def _draw_table(drawing: Drawing, table: Table) -> None:
    box = drawing.room.tables[table.name]
    size = (2 * box.half_x * drawing.scale, 2 * box.half_y * drawing.scale)
    spot = drawing.at(box.x, box.y)
    drawing.canvas.box(spot, size, C.table, C.table_rim, 1.5, radius=min(8.0, size[0] / 6))
    drawing.block_box(spot, size, 5.0)
    fit = drawing.small + 1
    while fit > 7.5 and text_width(table.name, fit, bold=True) > size[0] - 6:
        fit -= 0.5
    lines = [(table.name, fit, True, C.on_table)]
    if size[1] > 3.4 * fit:
        lines.append((_seats(table.capacity, size[0]), fit - 1.5, False, C.on_table))
    flags = _flags(drawing, table.name)
    if flags:
        lines.append((flags, fit - 1.5, True, C.walk))
    y = spot[1] - sum(1.25 * height for _, height, _, _ in lines) / 2
    for text, height, bold, colour in lines:
        y += 1.25 * height / 2
        drawing.canvas.text((spot[0], y), text, height, colour, bold=bold)
        y += 1.25 * height / 2


def _seats(number: int, room: float) -> str:
    text = counted(number, "seat")
    return text if text_width(text, 9) < room - 4 else str(number)


def _flags(drawing: Drawing, table: str) -> str:
    """Returns signs for what the guests of a table wait for."""
    state = drawing.subject.state
    asked = (("bill", state.wants_bill), ("order", state.ready_to_order))
    return ", ".join(word for word, tables in asked if table in tables)


# -- nodes and people -----------------------------------------------------------------------------


def block_dots(drawing: Drawing) -> None:
    """Keeps labels off nodes and whoever stands on them."""
    for name, spot in drawing.nodes.items():
        side = 2 * drawing.reach(name)
        drawing.block_box(spot, (side, side), 8.0)


def block_guests(drawing: Drawing) -> None:
    """Keeps labels off the guests who wait."""
    side = 0.4 * drawing.scale
    for spot, _ in drawing.guests():
        drawing.block_box(spot, (side, side), 8.0)


def draw_dots(drawing: Drawing) -> None:
    """A small ring at every node, a green one at the entrance."""
    for name, spot in drawing.nodes.items():
        entrance = name == drawing.layout.entrance
        rim, width = (C.door, 3.0) if entrance else (C.node_rim, 1.4)
        drawing.canvas.circle(spot, drawing.dot, C.node, rim, width)


def draw_people(drawing: Drawing) -> None:
    """Draws waiters, guests who wait, and the robot."""
    for waiter, node in drawing.subject.state.waiters:
        _draw_person(drawing, drawing.nodes[node], C.waiter, waiter)
    for spot, name in drawing.guests():
        _draw_person(drawing, spot, C.guest, name)
    for node, name in drawing.robots.items():
        _draw_robot(drawing, drawing.nodes[node], drawing.colours[name], name)


def _draw_robot(drawing: Drawing, spot: Spot, colour: str, name: str) -> None:
    """A robot with its face, and where there are several its name below that."""
    x, y = spot
    r = 0.23 * drawing.scale
    several = bool(drawing.subject.state.robots)
    up = 0.3 * r if several else 0.1 * r
    drawing.canvas.circle((x, y), r, colour, C.paper, 2.0)
    drawing.canvas.box((x, y - up), (1.25 * r, 0.72 * r), C.paper, radius=0.3 * r)
    for side in (-1, 1):
        drawing.canvas.circle((x + side * 0.3 * r, y - up), 0.15 * r, colour)
    size = min(drawing.small, 2.2 * r / max(2, len(name)))
    if several and size >= 5:
        drawing.canvas.text((x, y + 0.52 * r), name, size, C.on_dark, bold=True)


def _draw_person(drawing: Drawing, spot: Spot, colour: str, name: str) -> None:
    r = 0.19 * drawing.scale
    drawing.canvas.circle(spot, r, colour, C.paper, 1.5)
    size = min(drawing.small, 2.6 * r / max(2, len(name)))
    if size >= 6:
        drawing.canvas.text(spot, name, size, C.on_dark, bold=True)


# -- the way in -----------------------------------------------------------------------------------


def draw_way_in(drawing: Drawing) -> None:
    """An arrow from the door to the entrance node, which it points at from close by.

    It comes from the rim of the room where nothing but guests is in between; elsewhere a short one
    comes from where there is most room, with the door at its tail.
    """
    node = drawing.layout.entrance
    spot, rim = drawing.nodes[node], _rim(drawing)
    close = drawing.reach(node) + 4
    away = dist(spot, rim)
    turn = atan2(rim[1] - spot[1], rim[0] - spot[0]) if away > 1 else pi / 2
    block_dots(drawing)
    clear = max(close + 6, LANE / 2 * drawing.scale)
    straight = away > clear + 8 and not drawing.placer.line_cost(
        _from(spot, turn, clear), _from(spot, turn, away - 6), 8.0
    )
    block_guests(drawing)
    if not straight:
        turn, away = _roomiest(drawing, spot, turn, close)
    tip, tail = _from(spot, turn, close), _from(spot, turn, away)
    half = (
        min(0.38, 0.3 + away / drawing.scale / 10) * drawing.scale
        if straight
        else 0.2 * drawing.scale
    )
    across = (_from(tail, turn + pi / 2, half), _from(tail, turn - pi / 2, half))
    drawing.canvas.line(across, C.door, 5.0)
    drawing.canvas.line((tail, _from(spot, turn, close + 7)), C.door, 3.0)
    drawing.arrow(tip, turn + pi, 11.0, C.door)
    drawing.placer.block_line(tail, tip, 8.0, 3.0)
    drawing.placer.block_line(*across, 6.0, 3.0)


def _rim(drawing: Drawing) -> Spot:
    """Returns the door, on the rim of what is drawn: that is farther out where many guests wait."""
    x0, x1, y0, y1 = drawing.room.bounds
    (x, y), area = drawing.room.door, drawing.frame.area
    across, down = drawing.at(x, y)
    if y in (y0, y1):
        return (across, area.bottom if y == y0 else area.top)
    return (area.left if x == x0 else area.right if x == x1 else across, down)


def _roomiest(drawing: Drawing, spot: Spot, turn: float, close: float) -> tuple[float, float]:
    """Returns the direction and the length of a short arrow that covers least,
    ``turn`` if all are alike.
    """
    best, least = (turn, close + 0.5 * drawing.scale), float("inf")
    for k in range(48):
        here = turn + (k + 1) // 2 * (pi / 24) * (1 if k % 2 else -1)
        for part, price in ((0.55, 0.0), (0.42, 6.0), (0.32, 15.0)):
            away = close + part * drawing.scale
            cost = price + 0.2 * k
            cost += drawing.placer.line_cost(
                _from(spot, here, close), _from(spot, here, away), 12.0
            )
            door = centred(_from(spot, here, away), (0.44 * drawing.scale, 0.44 * drawing.scale))
            cost += drawing.placer.cost(door)
            if cost < least - 1e-6:
                best, least = (here, away), cost
    return best


def _from(spot: Spot, turn: float, away: float) -> Spot:
    return (spot[0] + away * cos(turn), spot[1] + away * sin(turn))
