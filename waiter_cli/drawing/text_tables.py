"""Tables, chairs and the bar of a drawing in characters. Entry point `draw_tables`.

A table is a frame with its name and its seats: as wide as its name where there is room for that.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from waiter_cli.model.wording import counted

if TYPE_CHECKING:
    from waiter_cli.drawing.text_cells import Cell, Sheet
    from waiter_cli.model.layout import Table
    from waiter_cli.room.room import Chair
    from waiter_cli.room.shapes import Box

    Corners = tuple[Cell, Cell]
    """Upper left and lower right cell."""

__all__ = ["draw_tables"]


def draw_tables(sheet: Sheet) -> None:
    """Puts chairs and those who sit on them, the bar, and tables with their words on a sheet."""
    room, state = sheet.subject.room, sheet.subject.state
    present, seated = dict(state.chairs), dict(state.seated)
    frames = _frames(sheet)
    for table in sheet.subject.layout.tables:
        guests = len(seated.get(table.name, ()))
        for number, chair in enumerate(room.chairs[table.name]):
            sign, style = sheet.signs.chair, "dim"
            if number < guests:
                sign, style = sheet.signs.guest, "cyan"
            elif number >= present.get(table.name, table.chairs):
                sign = sheet.signs.place
            spot = _seat(sheet, chair, room.tables[table.name], frames.get(table.name))
            sheet.cells.setdefault(spot, (sign, style))
    if room.bar is not None:
        _block(sheet, room.bar, sheet.signs.bar)
        _name_bar(sheet, room.bar)
    for table in sheet.subject.layout.tables:
        if table.name in frames:
            _table(sheet, table, frames[table.name])
        else:
            _small_table(sheet, table, room.tables[table.name])


def _seat(sheet: Sheet, chair: Chair, box: Box, frame: Corners | None) -> Cell:
    """Returns the cell of a chair, beside the frame of its table."""
    x, y = sheet.cell(chair.x, chair.y)
    if frame is None:
        return (x, y)
    (left, top), (right, bottom) = frame
    aside = abs(chair.x - box.x) / box.half_x > abs(chair.y - box.y) / box.half_y
    if aside and left <= x <= right:
        x = left - 1 if chair.x < box.x else right + 1
    elif not aside and top <= y <= bottom:
        y = top - 1 if chair.y > box.y else bottom + 1
    return (x, y)


def _frames(sheet: Sheet) -> dict[str, Corners]:
    """Returns the frame of every table, wide enough for its name where there is room.

    None if all is small.
    """
    if sheet.across < 1.8:  # tables would run into each other
        return {}
    room = sheet.subject.room
    wide = 2 * max(2, int(0.62 * sheet.across))
    frames = {}
    for table in sheet.subject.layout.tables:
        most = min(wide, 2 * (-(-len(table.name) // 2) + 1))
        frames[table.name] = _corners(sheet, room.tables[table.name], (most, 2))
    used = Counter([*sheet.paths, *sheet.cells, *sheet.nodes.values()])
    if room.bar is not None:
        used.update(_cells_of(_corners(sheet, room.bar, (4, 0))))

    def own(name: str) -> set[Cell]:
        seats = {_seat(sheet, c, room.tables[name], frames[name]) for c in room.chairs[name]}
        return seats.union(_cells_of(frames[name]))

    for name in frames:
        used.update(own(name))
    for name, ((left, top), (right, bottom)) in frames.items():
        half = (len(sheet.shown(name)) + 2) // 2
        middle = (left + right) // 2
        if middle - half >= left or middle - half < 1 or middle + half + 1 >= sheet.width:
            continue
        # As wide as that with a chair and a blank on either side.
        whole = _cells_of(((middle - half - 2, top), (middle + half + 2, bottom)))
        before = own(name)
        if all(used[cell] == (cell in before) for cell in whole):
            used.subtract(before)
            frames[name] = ((middle - half, top), (middle + half, bottom))
            used.update(own(name))
    return frames


def _corners(sheet: Sheet, box: Box, least: Cell) -> Corners:
    """Returns the corners of a box, so many cells apart at least."""
    (x, y), (w, h) = sheet.cell(box.x, box.y), least
    half_w = max(w // 2, round(box.half_x * sheet.across))
    half_h = max(h // 2, round(box.half_y * sheet.down))
    return (x - half_w, y - half_h), (x + half_w, y + half_h)


def _block(sheet: Sheet, box: Box, sign: str) -> None:
    (left, top), (right, bottom) = _corners(sheet, box, (4, 0))
    for row in range(top, bottom + 1):
        for column in range(left, right + 1):
            sheet.cells[column, row] = (sign, "dim")


def _name_bar(sheet: Sheet, box: Box) -> None:
    """The word on the bar, in a row where no node is in its way."""
    (_, top), (_, bottom) = _corners(sheet, box, (4, 0))
    column, row = sheet.cell(box.x, box.y)
    nodes = set(sheet.nodes.values())
    for y in sorted(range(top, bottom + 1), key=lambda y: abs(y - row)):
        if not nodes & {(column + k, y) for k in range(-2, 3)}:
            sheet.write((column - 2, y), "*bar*" if sheet.marks("bar") else " bar ", "bold")
            return


def _table(sheet: Sheet, table: Table, frame: Corners) -> None:
    """A table as a frame with words in it; of a low one, what has no row stands in its rim.

    Stars, and what guests wait for, may stand in the sides of a narrow one.
    """
    (left, top), (right, bottom) = frame
    corners, style = sheet.signs.frame, "yellow"
    for spot in _cells_of(frame):
        sheet.cells[spot] = (" ", "")
    for column in range(left + 1, right):
        sheet.cells[column, top] = sheet.cells[column, bottom] = (corners[4], style)
    for row in range(top + 1, bottom):
        sheet.cells[left, row] = sheet.cells[right, row] = (corners[5], style)
    for spot, sign in zip(((left, top), (right, top), (left, bottom), (right, bottom)), corners):
        sheet.cells[spot] = (sign, style)
    inner, rows = right - left - 1, bottom - top - 1
    marked = sheet.marks(table.name)
    name = sheet.fitted(table.name, inner + 2 if marked else inner)
    words = _words(sheet, table, inner)
    lines: list[tuple[str, str, int]] = []
    if len(words) >= rows:
        lines.append((*words.pop(0), bottom))
    if len(words) >= rows:
        lines += [(*words.pop(), top)] if words else []
    row = top + 1 + max(0, rows - 1 - len(words)) // 2
    lines += [(*said, row + 1 + k) for k, said in enumerate(words[: rows - 1])]
    free = [y for y in range(row + 1, bottom) if y not in {at for _, _, at in lines}]
    for text, shown, at in lines:
        spots = [(left + (inner + 2 - len(text)) // 2, y) for y in (at, *free)]
        apart = [spot for spot in spots if sheet.apart(spot, len(text))]
        if apart:
            sheet.write(apart[0], text, shown)
        else:
            sheet.name((left + 1, at), text[:inner], text, shown)
    spot = (left + (inner + 2 - len(name)) // 2, row)
    sheet.name(spot, name, table.name, "bold yellow" if marked else "bold")


def _words(sheet: Sheet, table: Table, room: int) -> list[tuple[str, str]]:
    """Returns the lines below a table's name, with their style: its seats, and its guests' wishes."""
    seats = counted(table.capacity, "seat")
    state = sheet.subject.state
    asked = (("bill", state.wants_bill), ("order", state.ready_to_order))
    return [
        (seats if len(seats) <= room else str(table.capacity), "dim"),
        *((word[: room + 2], "red") for word, tables in asked if table.name in tables),
    ]


def _small_table(sheet: Sheet, table: Table, box: Box) -> None:
    """A table as nothing but its name and its seats, as far as they touch no other word."""
    column, row = sheet.cell(box.x, box.y)
    if sheet.apart((column, row + 1), len(str(table.capacity))):
        sheet.write((column, row + 1), str(table.capacity), "dim")
    for room, shift in ((3, 0), (3, 1), (3, -1), (2, 0), (2, 1), (2, -1)):
        shown = sheet.fitted(table.name, room)
        spot = (column - len(shown) // 2 + shift, row)
        if sheet.apart(spot, len(shown)):
            sheet.name(spot, shown, table.name, "bold yellow")
            return


def _cells_of(corners: Corners) -> Iterator[Cell]:
    """Yields the cells of a rectangle, its rim included."""
    (left, top), (right, bottom) = corners
    for row in range(top, bottom + 1):
        for column in range(left, right + 1):
            yield column, row
