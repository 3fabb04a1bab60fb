"""The cells of a drawing in characters: what stands where, and words where there is room for them.

A cell is a character and a style.  Paths are collected as directions in a cell, so that corners and
crossings come out right; everything else is put on top.  A cell is about twice as high as wide, so a
metre has half as many rows as columns, or more where the rows are needed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from waiter_cli.drawing.short_names import shorten

if TYPE_CHECKING:
    from waiter_cli.drawing.characters import Characters
    from waiter_cli.drawing.subject import Subject

__all__ = ["Cell", "Sheet"]

MOST_ROWS = 46
_EAST, _WEST, _NORTH, _SOUTH = 1, 2, 4, 8
Cell = tuple[int, int]


class Sheet:
    """The cells of a drawing; ``short`` has what names that were cut stand for."""

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
        self.short: dict[str, str] = {}
        self.nodes = {name: self.cell(*place) for name, place in subject.room.nodes.items()}

    def cell(self, x: float, y: float) -> Cell:
        """Returns the column and row of a place in metres."""
        return (4 + round((x - self.left) * self.across), 1 + round((self.top - y) * self.down))

    def draw_floor(self) -> None:
        """Puts paths and walls on the sheet."""
        self._edges()
        for a, b in self.subject.layout.walls:
            for spot in _line(self.cell(*a), self.cell(*b)):
                self.cells[spot] = (self.signs.wall, "dim")

    def draw_people(self) -> None:
        """Puts everybody, the walk of the robot and all names on top of what is there."""
        self._people()
        self._walk()
        self._labels()

    # -- what stands where --------------------------------------------------------------------

    def _edges(self) -> None:
        for a, b in self.subject.layout.edges:
            start, end = self.nodes[a], self.nodes[b]
            marked = f"{a}-{b}" in self.subject.marked
            if (a, b) in self.subject.layout.one_way:
                self._head(start, end)
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

    def _head(self, start: Cell, end: Cell) -> None:
        """An arrow head in the middle of a path that leads from ``start`` to ``end`` only."""
        way = list(_line(start, end))[1:-1]
        if way:
            across, down = end[0] - start[0], end[1] - start[1]
            flat = abs(across) >= 2 * abs(down)  # a row is about twice as high as a column is wide
            which = (across < 0) if flat else 2 + (down > 0)
            self.cells.setdefault(way[len(way) // 2], (self.signs.heads[which], ""))

    def _join(self, spot: Cell, way: Cell) -> None:
        bits = {(1, 0): _EAST, (-1, 0): _WEST, (0, -1): _NORTH, (0, 1): _SOUTH}
        self.paths[spot] = self.paths.get(spot, 0) | bits[way]

    def _people(self) -> None:
        state, room = self.subject.state, self.subject.room
        for name, spot in self.nodes.items():
            entrance = name == self.subject.layout.entrance
            sign = self.signs.entrance if entrance else self.signs.node
            self.cells[spot] = (sign, self._styled(name, "green bold" if entrance else ""))
        if not state.robots:
            self.cells[self.nodes[state.agent]] = ("R", self._styled("agent", "green bold"))
        for robot in state.robots:
            self._named(robot.name, self.nodes[robot.at], "green bold")
        for waiter, node in state.waiters:
            self._named(waiter, self.nodes[node], "blue bold")
        guests = [guest for party in state.waiting for guest in party]
        for guest, place in zip(guests, room.queue):
            spot = self.cell(*place)
            for text in (guest, self.signs.guest):
                if self._free(spot, len(text)) and (
                    self.apart(spot, len(text)) or not text.isalnum()
                ):
                    self.write(spot, text, "cyan")
                    break

    def _named(self, name: str, node: Cell, style: str) -> None:
        """The name of somebody on a node, to its right or its left, or only as much of it as there is room for."""
        taken = {spot for spot in self.nodes.values() if spot != node}
        state = self.subject.state
        staffed = {self.nodes[at] for _, at in state.waiters}
        staffed = (staffed | {self.nodes[robot.at] for robot in state.robots}) - {node}
        x, y = node
        for size in range(len(name), 0, -1):
            text = shorten(name, size, self.short) if size < len(name) else name
            for column in (x, x - size + 1):
                spots = {(column + k, y) for k in range(size)}
                ends = {(column - 1, y), (column + size, y)}
                inside = column >= 0 and column + size <= self.width
                apart = not any(map(self._is_word, (spots | ends) - {node}))
                if size == 1 or (inside and apart and not spots & taken and not ends & staffed):
                    self.name((column, y), text, name, style)
                    return

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
                    self.write(spot, text, "red bold")
                    break
        steps: dict[str, list[str]] = {}
        for deed in self.subject.deeds:
            steps.setdefault(deed.node, []).append(str(deed.step))
        for node, numbers in steps.items():
            self._beside(node, f"[{','.join(numbers)}]", "red bold")

    def _labels(self) -> None:
        names = sorted(self.nodes, key=lambda name: name != self.subject.layout.entrance)
        for name in names:
            self._beside(name, self.shown(name), self._styled(name, "dim"))

    def _beside(self, node: str, text: str, style: str) -> None:
        """Puts a word beside a node where there is room for it, or nowhere."""
        (x, y), size = self.nodes[node], len(text)
        left = right = x
        while self._is_word((right + 1, y)):  # the name of a waiter who stands there
            right += 1
        while self._is_word((left - 1, y)):
            left -= 1
        spots = [
            (right + 2, y), (left - size - 1, y), (x - size // 2, y - 1), (x + 1, y - 1),
            (x - size, y - 1), (x - size // 2, y + 1), (x + 1, y + 1), (x - size, y + 1),
        ]  # fmt: skip
        for lines, blank in ((False, True), (False, False), (True, False)):
            for spot in spots:
                ends = (spot[0] - 1, spot[1]), (spot[0] + size, spot[1])
                if blank and any(self._inked(end) for end in ends):
                    continue
                if self._free((spot[0] - 1, spot[1]), size + 2, lines=lines, ends=True):
                    self.write(spot, text, style)
                    return

    def _is_word(self, spot: Cell) -> bool:
        sign = self.cells.get(spot, (" ", ""))[0]
        return sign.isalnum() or sign in "[]*,_"

    def _inked(self, spot: Cell) -> bool:
        """Returns whether anything is in a cell."""
        return spot in self.paths or self.cells.get(spot, (" ", ""))[0] != " "

    def apart(self, spot: Cell, size: int) -> bool:
        """Returns whether a word of that size would touch no other, nor lie on one."""
        return not any(self._is_word((spot[0] + k, spot[1])) for k in range(-1, size + 1))

    def shown(self, name: str) -> str:
        """Returns a name, with stars where it is pointed out."""
        return f"*{name}*" if self.marks(name) else name

    def fitted(self, name: str, room: int) -> str:
        """Returns a name in so many characters, unlike every other."""
        shown = self.shown(name)
        if len(shown) <= room:
            return shown
        stars = len(shown) - len(name)
        names = [*self.nodes, *(table.name for table in self.subject.layout.tables)]
        taken = {each for each in names if each != name}
        taken |= {cut for cut, whole in self.short.items() if whole != name}
        short = shorten(name, max(1, room - stars), taken)
        return f"*{short}*" if stars else short

    def name(self, spot: Cell, text: str, name: str, style: str) -> None:
        """Writes a name; where only a part of it is written, that is told below the drawing."""
        self.write(spot, text, style)
        if text.strip("*") != name:
            self.short[text.strip("*")] = name

    def marks(self, name: str) -> bool:
        return name in self.subject.marked

    def _styled(self, name: str, style: str) -> str:
        return "yellow bold" if self.marks(name) else style

    def _free(self, spot: Cell, size: int, *, lines: bool = False, ends: bool = False) -> bool:
        """Returns whether ``size`` cells from ``spot`` on are blank, or with
        ``lines`` hold paths only.

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
                if self._is_word(here):
                    return False
            elif sign != " " and not (lines and sign == self.signs.slope):
                return False
            elif not rim and here in self.paths and not lines:
                return False
            elif here in self.nodes.values():
                return False
        return True

    def write(self, spot: Cell, text: str, style: str) -> None:
        for k, letter in enumerate(text):
            self.cells[spot[0] + k, spot[1]] = (letter, style)

    # -- the result -----------------------------------------------------------------------------

    def lines(self, style: Callable[[str, str], str]) -> list[str]:
        """Returns the rows, with runs of one style styled together."""
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
        """Returns the legend of the signs."""
        state, signs = self.subject.state, self.signs
        words = [f"{state.robots[0].name} robot"] if state.robots else ["R robot"]
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
    """Returns everything that is drawn, in metres; the waiting guests only where there are some."""
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
    """Yields the cells of a straight line, both ends included."""
    (ax, ay), (bx, by) = start, end
    count = max(abs(bx - ax), abs(by - ay))
    for k in range(count + 1):
        part = k / count if count else 0.0
        yield (round(ax + part * (bx - ax)), round(ay + part * (by - ay)))


def _steps(start: Cell, end: Cell) -> Iterator[tuple[Cell, Cell]]:
    spots = list(_line(start, end))
    yield from zip(spots, spots[1:])
