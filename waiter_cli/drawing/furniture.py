"""The floor of a picture and what stands on it: lanes, furniture, walls, the way in, people.

Each function draws one layer on a `Desk`, and tells its placer where labels should not be.
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
    from waiter_cli.drawing.frame import Desk, Spot
    from waiter_cli.model.layout import Table
    from waiter_cli.room.room import Chair

__all__ = ["draw_dots", "draw_furniture", "draw_ground", "draw_people", "draw_way_in"]

LANE = 0.5
"""Metres that a lane is wide: the robot."""


# -- the ground -----------------------------------------------------------------------------------


def draw_ground(desk: Desk) -> None:
    """The floor, the lanes along which the robot drives, and a glow under what is pointed out."""
    area = desk.frame.area
    size = (area.right - area.left, area.bottom - area.top)
    desk.canvas.box(area.middle, size, C.floor, C.rim, 1.5, radius=10)
    edges = [(desk.nodes[a], desk.nodes[b]) for a, b in desk.layout.edges]
    for ends in edges:
        desk.canvas.line(ends, C.lane, LANE * desk.scale)
    for (a, b), ends in zip(desk.layout.edges, edges):
        if f"{a}-{b}" in desk.subject.marked:
            desk.canvas.line(ends, C.mark, 0.22 * desk.scale)
        desk.canvas.line(ends, C.path, 1.6, (1.0, 5.0))
        desk.placer.block_line(*ends, 5.0, 0.7, edge_name(a, b))
        if (a, b) in desk.layout.one_way:
            _draw_head(desk, *ends)
    _draw_marks(desk)


def _draw_head(desk: Desk, start: Spot, end: Spot) -> None:
    """An arrow on a one-way path, past its middle, where no number of a walk stands."""
    turn = atan2(end[1] - start[1], end[0] - start[0])
    size = min(0.3 * desk.scale, 14.0)
    tip = (start[0] + 0.62 * (end[0] - start[0]), start[1] + 0.62 * (end[1] - start[1]))
    desk.arrow(tip, turn, size, C.path)
    middle = (tip[0] - size / 2 * cos(turn), tip[1] - size / 2 * sin(turn))
    desk.block_box(middle, (size, size), 4.0)


def _draw_marks(desk: Desk) -> None:
    marked = desk.subject.marked
    for name, spot in desk.nodes.items():
        who = desk.staff.get(name)
        agent = desk.robots.get(name) in marked
        if name in marked or (who is not None and who in marked) or agent:
            desk.canvas.circle(spot, 0.32 * desk.scale, C.glow, C.mark, 3.0)
    solids = [(name, box, 20, 14.0) for name, box in desk.room.tables.items()]
    solids += [("bar", desk.room.bar, 16, 12.0)] if desk.room.bar is not None else []
    for name, box, more, radius in solids:
        if name in marked:
            size = (2 * box.half_x * desk.scale + more, 2 * box.half_y * desk.scale + more)
            desk.canvas.box(desk.at(box.x, box.y), size, C.glow, C.mark, 3.0, radius=radius)


# -- furniture and walls --------------------------------------------------------------------------


def draw_furniture(desk: Desk) -> None:
    """Chairs with those who sit on them, tables, the bar, walls."""
    present = dict(desk.subject.state.chairs)
    seated = dict(desk.subject.state.seated)
    for table in desk.layout.tables:
        guests = seated.get(table.name, ())
        for number, chair in enumerate(desk.room.chairs[table.name]):
            guest = guests[number] if number < len(guests) else None
            _draw_chair(desk, chair, number < present.get(table.name, table.chairs), guest)
    for table in desk.layout.tables:
        _draw_table(desk, table)
    bar = desk.room.bar
    if bar is not None:
        size = (2 * bar.half_x * desk.scale, 2 * bar.half_y * desk.scale)
        spot = desk.at(bar.x, bar.y)
        desk.canvas.box(spot, size, C.bar, C.bar_rim, 1.5, radius=4)
        desk.canvas.text(spot, "bar", desk.small + 1, C.on_dark, bold=True)
        desk.block_box(spot, size, 5.0)
    for a, b in desk.layout.walls:
        ends = (desk.at(*a), desk.at(*b))
        desk.canvas.line(ends, C.wall, max(4.0, 0.12 * desk.scale))
        desk.placer.block_line(*ends, 8.0, 5.0)


def _draw_chair(desk: Desk, chair: Chair, present: bool, guest: str | None) -> None:
    side = 0.36 * desk.scale
    spot = desk.at(chair.x, chair.y)
    turn = -degrees(chair.yaw)
    canvas = desk.canvas
    desk.block_box(spot, (side, side), 5.0)
    if not present:
        canvas.box(spot, (side, side), "", C.chair_rim, 1.0, radius=4, angle=turn, dashed=True)
        return
    fill, rim = (C.chair, C.chair_rim) if guest is None else (C.guest, C.guest_rim)
    canvas.box(spot, (side, side), fill, rim, 1.2, radius=side / 4, angle=turn)
    if guest is None:  # the back of the chair
        back = (spot[0] - 0.38 * side * cos(chair.yaw), spot[1] + 0.38 * side * sin(chair.yaw))
        canvas.box(back, (0.2 * side, side), rim, radius=2, angle=turn)
    elif side >= 11:
        size = min(desk.small - 0.5, 1.6 * side / max(2, len(guest)))
        canvas.text(spot, guest, size, C.on_dark, bold=True)


def _draw_table(desk: Desk, table: Table) -> None:
    box = desk.room.tables[table.name]
    size = (2 * box.half_x * desk.scale, 2 * box.half_y * desk.scale)
    spot = desk.at(box.x, box.y)
    desk.canvas.box(spot, size, C.table, C.table_rim, 1.5, radius=min(8.0, size[0] / 6))
    desk.block_box(spot, size, 5.0)
    fit = desk.small + 1
    while fit > 7.5 and text_width(table.name, fit, bold=True) > size[0] - 6:
        fit -= 0.5
    lines = [(table.name, fit, True, C.on_table)]
    if size[1] > 3.4 * fit:
        lines.append((_seats(table.capacity, size[0]), fit - 1.5, False, C.on_table))
    flags = _flags(desk, table.name)
    if flags:
        lines.append((flags, fit - 1.5, True, C.walk))
    y = spot[1] - sum(1.25 * height for _, height, _, _ in lines) / 2
    for text, height, bold, colour in lines:
        y += 1.25 * height / 2
        desk.canvas.text((spot[0], y), text, height, colour, bold=bold)
        y += 1.25 * height / 2


def _seats(number: int, room: float) -> str:
    text = counted(number, "seat")
    return text if text_width(text, 9) < room - 4 else str(number)


def _flags(desk: Desk, table: str) -> str:
    """Returns signs for what the guests of a table wait for."""
    state = desk.subject.state
    asked = (("bill", state.wants_bill), ("order", state.ready_to_order))
    return ", ".join(word for word, tables in asked if table in tables)


# -- nodes and people -----------------------------------------------------------------------------


def block_dots(desk: Desk) -> None:
    """Keeps labels off nodes and whoever stands on them."""
    for name, spot in desk.nodes.items():
        side = 2 * desk.reach(name)
        desk.block_box(spot, (side, side), 8.0)


def block_guests(desk: Desk) -> None:
    """Keeps labels off the guests who wait."""
    side = 0.4 * desk.scale
    for spot, _ in desk.guests():
        desk.block_box(spot, (side, side), 8.0)


def draw_dots(desk: Desk) -> None:
    """A small ring at every node, a green one at the entrance."""
    for name, spot in desk.nodes.items():
        entrance = name == desk.layout.entrance
        rim, width = (C.door, 3.0) if entrance else (C.node_rim, 1.4)
        desk.canvas.circle(spot, desk.dot, C.node, rim, width)


def draw_people(desk: Desk) -> None:
    """Waiters, guests who wait, and the robot."""
    for waiter, node in desk.subject.state.waiters:
        _draw_person(desk, desk.nodes[node], C.waiter, waiter)
    for spot, name in desk.guests():
        _draw_person(desk, spot, C.guest, name)
    for node, name in desk.robots.items():
        _draw_robot(desk, desk.nodes[node], desk.colours[name], name)


def _draw_robot(desk: Desk, spot: Spot, colour: str, name: str) -> None:
    """A robot with its face, and where there are several its name below that."""
    x, y = spot
    r = 0.23 * desk.scale
    several = bool(desk.subject.state.robots)
    up = 0.3 * r if several else 0.1 * r
    desk.canvas.circle((x, y), r, colour, C.paper, 2.0)
    desk.canvas.box((x, y - up), (1.25 * r, 0.72 * r), C.paper, radius=0.3 * r)
    for side in (-1, 1):
        desk.canvas.circle((x + side * 0.3 * r, y - up), 0.15 * r, colour)
    size = min(desk.small, 2.2 * r / max(2, len(name)))
    if several and size >= 5:
        desk.canvas.text((x, y + 0.52 * r), name, size, C.on_dark, bold=True)


def _draw_person(desk: Desk, spot: Spot, colour: str, name: str) -> None:
    r = 0.19 * desk.scale
    desk.canvas.circle(spot, r, colour, C.paper, 1.5)
    size = min(desk.small, 2.6 * r / max(2, len(name)))
    if size >= 6:
        desk.canvas.text(spot, name, size, C.on_dark, bold=True)


# -- the way in -----------------------------------------------------------------------------------


def draw_way_in(desk: Desk) -> None:
    """An arrow from the door to the entrance node, which it points at from close by.

    It comes from the rim of the room where nothing but guests is in between; elsewhere a short one
    comes from where there is most room, with the door at its tail.
    """
    node = desk.layout.entrance
    spot, rim = desk.nodes[node], _rim(desk)
    close = desk.reach(node) + 4
    away = dist(spot, rim)
    turn = atan2(rim[1] - spot[1], rim[0] - spot[0]) if away > 1 else pi / 2
    block_dots(desk)
    clear = max(close + 6, LANE / 2 * desk.scale)
    straight = away > clear + 8 and not desk.placer.line_cost(
        _from(spot, turn, clear), _from(spot, turn, away - 6), 8.0
    )
    block_guests(desk)
    if not straight:
        turn, away = _roomiest(desk, spot, turn, close)
    tip, tail = _from(spot, turn, close), _from(spot, turn, away)
    half = min(0.38, 0.3 + away / desk.scale / 10) * desk.scale if straight else 0.2 * desk.scale
    across = (_from(tail, turn + pi / 2, half), _from(tail, turn - pi / 2, half))
    desk.canvas.line(across, C.door, 5.0)
    desk.canvas.line((tail, _from(spot, turn, close + 7)), C.door, 3.0)
    desk.arrow(tip, turn + pi, 11.0, C.door)
    desk.placer.block_line(tail, tip, 8.0, 3.0)
    desk.placer.block_line(*across, 6.0, 3.0)


def _rim(desk: Desk) -> Spot:
    """Returns the door, on the rim of what is drawn: that is farther out where many guests wait."""
    x0, x1, y0, y1 = desk.room.bounds
    (x, y), area = desk.room.door, desk.frame.area
    across, down = desk.at(x, y)
    if y in (y0, y1):
        return (across, area.bottom if y == y0 else area.top)
    return (area.left if x == x0 else area.right if x == x1 else across, down)


def _roomiest(desk: Desk, spot: Spot, turn: float, close: float) -> tuple[float, float]:
    """Returns the direction and the length of a short arrow that covers least,
    ``turn`` if all are alike.
    """
    best, least = (turn, close + 0.5 * desk.scale), float("inf")
    for k in range(48):
        here = turn + (k + 1) // 2 * (pi / 24) * (1 if k % 2 else -1)
        for part, price in ((0.55, 0.0), (0.42, 6.0), (0.32, 15.0)):
            away = close + part * desk.scale
            cost = price + 0.2 * k
            cost += desk.placer.line_cost(_from(spot, here, close), _from(spot, here, away), 12.0)
            door = centred(_from(spot, here, away), (0.44 * desk.scale, 0.44 * desk.scale))
            cost += desk.placer.cost(door)
            if cost < least - 1e-6:
                best, least = (here, away), cost
    return best


def _from(spot: Spot, turn: float, away: float) -> Spot:
    return (spot[0] + away * cos(turn), spot[1] + away * sin(turn))
