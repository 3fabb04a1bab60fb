"""`Subject` → a floor plan in characters, for a terminal. Entry point `draw_text`.

A grid of cells, each a character and a style.  Paths are collected as directions in a cell, so that
corners and crossings come out right; everything else is put on top.  A cell is about twice as high
as wide, so a metre has half as many rows as columns, or more where the rows are needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject
    from waiter_cli.layout import Table
    from waiter_cli.replay.shapes import Box

__all__ = ["ASCII", "BOXES", "Characters", "draw_text", "fits_encoding"]

MOST_ROWS = 46
_EAST, _WEST, _NORTH, _SOUTH = 1, 2, 4, 8
Cell = tuple[int, int]


class Characters(NamedTuple):
    """The characters of a drawing; ``lines`` by directions (1 east, 2 west, 4 north, 8 south)."""

    lines: str
    slope: str
    frame: str
    node: str
    entrance: str
    chair: str
    place: str
    guest: str
    wall: str
    bar: str


BOXES = Characters(" ╶╴─╵└┘┴╷┌┐┬│├┤┼", "·", "╔╗╚╝═║", "●", "◉", "▪", "▫", "☺", "█", "▒")
ASCII = Characters(" ---|+++|+++|+++", ".", "++++=|", "o", "@", "#", "_", "g", "%", "/")
assert len(BOXES.lines) == len(ASCII.lines) == 16


def fits_encoding(encoding: str | None) -> Characters:
    """Box characters where an encoding has them, else plain ASCII."""
    try:
        "".join(BOXES).encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return BOXES


def draw_text(
    subject: Subject,
    width: int = 80,
    characters: Characters = BOXES,
    style: Callable[[str, str], str] = lambda text, style: text,
) -> str:
    """The floor plan in lines of at most ``width`` columns, and below it the plan in words.

    ``style`` makes a piece of text appear in a style (``red``, ``bold``, …) on a terminal.
    """
    sheet = _Sheet(subject, max(width, 24), characters)
    lines = [style(subject.layout.name, "bold") + f": {subject.headline}", ""]
    lines += sheet.lines(style)
    lines += ["", *_folded(sheet.legend(), width)]
    if subject.listing:
        lines.append("")
        wide = max(len(steps) for steps, _ in subject.listing)
        for steps, text in subject.listing:
            first, *rest = _folded([text], width - wide - 4, "")
            lines.append(f"  {style(steps.rjust(wide), 'red')}  {first}")
            lines += [" " * (wide + 4) + line for line in rest]
    return "\n".join(lines)


class _Sheet:
    """The cells of a drawing."""

    def __init__(self, subject: Subject, width: int, characters: Characters) -> None:
        self.subject, self.signs, self.width = subject, characters, width
        x0, x1, y0, y1 = _extent(subject)
        self.left, self.top = x0, y1
        self.across = min(12.0, (width - 9) / max(x1 - x0, 0.5))
        self.down = self.across / 2
        rows = (y1 - y0) * self.down
        if rows < MOST_ROWS - 8:  # tables of 0.8 m want three rows where there is room for them
            self.down = min(max(self.down, 3.2), (MOST_ROWS - 8) / max(y1 - y0, 0.5), 6.0)
            self.down = max(self.down, self.across / 2)
        elif rows > 2 * MOST_ROWS:
            self.across, self.down = self.across * 2 * MOST_ROWS / rows, 2 * MOST_ROWS / (y1 - y0)
        self.paths: dict[Cell, int] = {}
        self.cells: dict[Cell, tuple[str, str]] = {}
        self.nodes = {name: self.cell(*place) for name, place in subject.room.nodes.items()}
        self._draw()

    def cell(self, x: float, y: float) -> Cell:
        """The column and row of a place in metres."""
        return (4 + round((x - self.left) * self.across), 1 + round((self.top - y) * self.down))

    def _draw(self) -> None:
        self._edges()
        for a, b in self.subject.layout.walls:
            for spot in _line(self.cell(*a), self.cell(*b)):
                self.cells[spot] = (self.signs.wall, "dim")
        self._furniture()
        self._people()
        self._walk()
        self._labels()

    # -- what stands where --------------------------------------------------------------------

    def _edges(self) -> None:
        for a, b in self.subject.layout.edges:
            start, end = self.nodes[a], self.nodes[b]
            marked = f"{a}-{b}" in self.subject.marked
            for one, other in _steps(start, end):
                if marked:
                    for spot in (one, other):
                        self.cells.setdefault(spot, ("*", "yellow"))
                way = (other[0] - one[0], other[1] - one[1])
                if 0 in way:
                    self._join(one, way)
                    self._join(other, (-way[0], -way[1]))
                else:
                    for spot in (one, other):
                        if spot not in (start, end):
                            self.cells.setdefault(spot, (self.signs.slope, "dim"))

    def _join(self, spot: Cell, way: Cell) -> None:
        bits = {(1, 0): _EAST, (-1, 0): _WEST, (0, -1): _NORTH, (0, 1): _SOUTH}
        self.paths[spot] = self.paths.get(spot, 0) | bits[way]

    def _furniture(self) -> None:
        room, state = self.subject.room, self.subject.state
        present, seated = dict(state.chairs), dict(state.seated)
        for table in self.subject.layout.tables:
            guests = len(seated.get(table.name, ()))
            for number, chair in enumerate(room.chairs[table.name]):
                sign, style = self.signs.chair, "dim"
                if number < guests:
                    sign, style = self.signs.guest, "cyan"
                elif number >= present.get(table.name, table.chairs):
                    sign = self.signs.place
                self.cells.setdefault(self.cell(chair.x, chair.y), (sign, style))
        if room.bar is not None:
            self._block(room.bar, self.signs.bar)
            column, row = self.cell(room.bar.x, room.bar.y)
            self._write((column - 2, row), " bar " if self._marks("bar") else "bar", "bold")
        for table in self.subject.layout.tables:
            self._table(table, room.tables[table.name])

    def _corners(self, box: Box, least: Cell) -> tuple[Cell, Cell]:
        """Upper left and lower right cell of a box, so many cells apart at least."""
        (x, y), (w, h) = self.cell(box.x, box.y), least
        half_w = max(w // 2, round(box.half_x * self.across))
        half_h = max(h // 2, round(box.half_y * self.down))
        return (x - half_w, y - half_h), (x + half_w, y + half_h)

    def _block(self, box: Box, sign: str) -> None:
        (left, top), (right, bottom) = self._corners(box, (4, 0))
        for row in range(top, bottom + 1):
            for column in range(left, right + 1):
                self.cells[column, row] = (sign, "dim")

    def _table(self, table: Table, box: Box) -> None:
        if self.across < 1.8:  # tables would run into each other
            self._small_table(table, box)
            return
        need = -(-len(table.name) // 2)
        wide = 2 * min(need + 1, max(2, int(0.62 * self.across)))
        (left, top), (right, bottom) = self._corners(box, (wide, 2))
        corners, style = self.signs.frame, "yellow"
        for row in range(top, bottom + 1):
            for column in range(left, right + 1):
                self.cells[column, row] = (" ", "")
        for column in range(left + 1, right):
            self.cells[column, top] = self.cells[column, bottom] = (corners[4], style)
        for row in range(top + 1, bottom):
            self.cells[left, row] = self.cells[right, row] = (corners[5], style)
        for spot, sign in zip(
            ((left, top), (right, top), (left, bottom), (right, bottom)), corners
        ):
            self.cells[spot] = (sign, style)
        inner = right - left - 1
        marked = "bold yellow" if table.name in self.subject.marked else "bold"
        name = f"*{table.name}*" if table.name in self.subject.marked else table.name
        words = [(_short(name, inner), marked)]
        state = self.subject.state
        asks = [
            word
            for word, tables in (("bill", state.wants_bill), ("order", state.ready_to_order))
            if table.name in tables
        ]
        seats = f"{table.capacity} seat{'' if table.capacity == 1 else 's'}"
        words.append((seats if len(seats) <= inner else str(table.capacity), "dim"))
        words += [(_short(word, inner), "red") for word in asks]
        words = words[: bottom - top - 1]
        row = top + 1 + (bottom - top - 1 - len(words)) // 2
        for text, shown in words:
            self._write((left + 1 + (inner - len(text)) // 2, row), text, shown)
            row += 1

    def _small_table(self, table: Table, box: Box) -> None:
        """A table as nothing but its name and its seats."""
        column, row = self.cell(box.x, box.y)
        marked = table.name in self.subject.marked
        for text, y in ((_short(table.name, 3), row), (str(table.capacity), row + 1)):
            style = "dim" if y != row else "bold yellow"
            shown = f"*{text}*" if marked and y == row else text
            self._write((column - len(shown) // 2, y), shown, style)

    def _people(self) -> None:
        state, room = self.subject.state, self.subject.room
        for name, spot in self.nodes.items():
            entrance = name == self.subject.layout.entrance
            sign = self.signs.entrance if entrance else self.signs.node
            self.cells[spot] = (sign, self._styled(name, "green bold" if entrance else ""))
        guests = [guest for party in state.waiting for guest in party]
        for guest, place in zip(guests, room.queue):
            spot = self.cell(*place)
            text = guest if self._free(spot, len(guest)) else self.signs.guest
            if self._free(spot, len(text)):
                self._write(spot, text, "cyan")
        for waiter, node in state.waiters:
            self._write(self.nodes[node], waiter, "blue bold")
        self.cells[self.nodes[state.agent]] = ("R", self._styled("agent", "green bold"))

    # -- the walk and the words -----------------------------------------------------------------

    def _walk(self) -> None:
        for leg in self.subject.legs:
            text = str(leg.step)
            way = list(_line(self.nodes[leg.start], self.nodes[leg.end]))[1:-1]
            order = sorted(way, key=lambda spot: abs(way.index(spot) - 0.4 * len(way)))
            flat = bool(way) and way[0][1] == self.nodes[leg.start][1]
            for spot in [s for s in order if flat or len(text) == 1] + [
                (x + side, y) for x, y in order for side in ((0, 1) if not flat else (0,))
            ]:
                around = (spot[0] - 1, spot[1])
                if self._free(around, len(text) + 2, lines=True, ends=True):
                    self._write(spot, text, "red bold")
                    break
        steps: dict[str, list[str]] = {}
        for deed in self.subject.deeds:
            steps.setdefault(deed.node, []).append(str(deed.step))
        for node, numbers in steps.items():
            self._beside(node, f"[{','.join(numbers)}]", "red bold")

    def _labels(self) -> None:
        names = sorted(self.nodes, key=lambda name: name != self.subject.layout.entrance)
        for name in names:
            text = f"*{name}*" if self._marks(name) else name
            self._beside(name, text, self._styled(name, "dim"))

    def _beside(self, node: str, text: str, style: str) -> None:
        """Puts a word beside a node where there is room for it, or nowhere."""
        (x, y), size = self.nodes[node], len(text)
        who = next((w for w, at in self.subject.state.waiters if at == node), "")
        right = max(1, len(who))
        spots = [
            (x + right + 1, y), (x - size - 1, y), (x - size // 2, y - 1), (x + 1, y - 1),
            (x - size, y - 1), (x - size // 2, y + 1), (x + 1, y + 1), (x - size, y + 1),
        ]  # fmt: skip
        for lines in (False, True):
            for spot in spots:
                if self._free((spot[0] - 1, spot[1]), size + 2, lines=lines, ends=True):
                    self._write(spot, text, style)
                    return

    def _marks(self, name: str) -> bool:
        return name in self.subject.marked

    def _styled(self, name: str, style: str) -> str:
        return "yellow bold" if self._marks(name) else style

    def _free(self, spot: Cell, size: int, *, lines: bool = False, ends: bool = False) -> bool:
        """Whether ``size`` cells from ``spot`` on are blank, or with ``lines`` hold paths only.

        With ``ends`` the first and the last of them may hold anything but a word.
        """
        column, row = spot
        for k in range(size):
            here = (column + k, row)
            rim = ends and k in (0, size - 1)
            if not rim and not (0 <= here[0] < self.width and row >= 0):
                return False
            sign = self.cells.get(here, (" ", ""))[0]
            if rim:
                if sign.isalnum() or sign in "[]*,_":
                    return False
            elif sign != " " and not (lines and sign == self.signs.slope):
                return False
            elif not rim and here in self.paths and not lines:
                return False
            elif here in self.nodes.values():
                return False
        return True

    def _write(self, spot: Cell, text: str, style: str) -> None:
        for k, letter in enumerate(text):
            self.cells[spot[0] + k, spot[1]] = (letter, style)

    # -- the result -----------------------------------------------------------------------------

    def lines(self, style: Callable[[str, str], str]) -> list[str]:
        """The rows, with runs of one style styled together."""
        rows: dict[int, dict[int, tuple[str, str]]] = {}
        for (column, row), bits in self.paths.items():
            rows.setdefault(row, {})[column] = (self.signs.lines[bits], "dim")
        for (column, row), cell in self.cells.items():
            rows.setdefault(row, {})[column] = cell
        out = []
        for row in range(min(rows), max(rows) + 1):
            line = rows.get(row, {})
            runs: list[tuple[str, str]] = []
            last = max((c for c, (sign, _) in line.items() if sign != " "), default=-1)
            for column in range(min(last, self.width - 1) + 1):
                sign, shown = line.get(column, (" ", ""))
                if runs and (runs[-1][1] == shown or sign == " "):
                    runs[-1] = (runs[-1][0] + sign, runs[-1][1])
                else:
                    runs.append((sign, shown))
            out.append("".join(style(text, shown) if shown else text for text, shown in runs))
        return out

    def legend(self) -> list[str]:
        """What the signs mean."""
        state, signs = self.subject.state, self.signs
        words = ["R robot"]
        words += [f"{state.waiters[0][0]} waiter"] if state.waiters else []
        words += [f"{signs.node} node", f"{signs.entrance} entrance", f"{signs.chair} chair"]
        if any(table.chairs < table.capacity for table in self.subject.layout.tables):
            words.append(f"{signs.place} place without a chair")
        words += [f"{signs.guest} guest"] if state.parties() else []
        words += ["1 step of the walk"] if self.subject.legs else []
        words += ["[4] something done there"] if self.subject.deeds else []
        words.append(f"1 m is {self.across:.1f} columns, {self.down:.1f} rows")
        return words


def _extent(subject: Subject) -> tuple[float, float, float, float]:
    """Everything that is drawn, in metres; the waiting guests only where there are some."""
    room = subject.room
    xs = [x for x, _ in room.nodes.values()]
    ys = [y for _, y in room.nodes.values()]
    solids = [*room.tables.values(), *([room.bar] if room.bar else [])]
    solids += [chair.box for chairs in room.chairs.values() for chair in chairs]
    for box in solids:
        xs += [box.x - box.half_x, box.x + box.half_x]
        ys += [box.y - box.half_y, box.y + box.half_y]
    for wall in subject.layout.walls:
        xs += [x for x, _ in wall]
        ys += [y for _, y in wall]
    waiting = sum(map(len, subject.state.waiting))
    xs += [x for x, _ in room.queue[:waiting]]
    ys += [y for _, y in room.queue[:waiting]]
    return min(xs), max(xs), min(ys), max(ys)


def _line(start: Cell, end: Cell) -> Iterator[Cell]:
    """The cells of a straight line, both ends included."""
    (ax, ay), (bx, by) = start, end
    count = max(abs(bx - ax), abs(by - ay))
    for k in range(count + 1):
        part = k / count if count else 0.0
        yield (round(ax + part * (bx - ax)), round(ay + part * (by - ay)))


def _steps(start: Cell, end: Cell) -> Iterator[tuple[Cell, Cell]]:
    spots = list(_line(start, end))
    yield from zip(spots, spots[1:])


def _short(name: str, room: int) -> str:
    """A name cut to so many characters; a number at its end stays: ``table12`` → ``t12``."""
    if len(name) <= room:
        return name
    digits = name[len(name.rstrip("0123456789")) :]
    if digits and len(digits) <= room:
        return (name[0] + digits)[-room:]
    return name[:room]


def _folded(words: Sequence[str], width: int, between: str = "   ") -> list[str]:
    """Words in lines of at most ``width`` columns; a single text is folded at its spaces."""
    if len(words) == 1 and not between:
        import textwrap

        return textwrap.wrap(words[0], max(width, 20)) or [""]
    lines: list[str] = []
    for word in words:
        if lines and len(lines[-1]) + len(between) + len(word) <= width:
            lines[-1] += between + word
        else:
            lines.append(word)
    return lines
