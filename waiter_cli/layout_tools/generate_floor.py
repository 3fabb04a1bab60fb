"""Floor plans made by chance, the same for the same seed: numbers of nodes and tables → `Layout`.

Entry points: `build_layout`, and `write_layout` for its YAML.

Aisles run along x, one above the other, `ROW` metres apart; tables stand between them in columns
`COLUMN` metres apart, long side along y, chairs 0.75 m either side in x.  A *front* is the node of
an aisle beside a column of tables; *gaps* are nodes between two columns, where an aisle may also
lead up to the next one; the first gap of every aisle joins them all.  Further nodes make corridors
to the left and right.  A robot of 0.25 m radius that follows the edges keeps clear of furniture.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

from waiter_cli.errors import InputError
from waiter_cli.model.graph import Graph, cut_nodes, reachable
from waiter_cli.model.layout import Bar, Layout, Node, Point, Table

__all__ = ["FLAWS", "build_layout", "find_cut", "least_nodes"]

ROW, COLUMN, GAP = 3.4, 3.0, 1.5
ATTEMPTS = 50
FLAWS = ("unreachable_table", "blocked_aisle")


def build_layout(
    seed: int,
    nodes: int,
    tables: int,
    *,
    name: str = "generated",
    bar: bool = False,
    waiters: int = 0,
    flaw: str | None = None,
    handsome: bool = False,
) -> Layout:
    """Returns a layout in which every table and the bar can be reached past the
    waiters, unless flawed.

    ``handsome`` rooms have as many aisles as make them about as broad as a picture, whatever the
    number of nodes; others get long corridors where there are many nodes to a table.

    ``flaw`` is None, ``unreachable_table`` (a table on an island) or ``blocked_aisle`` (a waiter
    between agent and entrance).  Raises `InputError` where the numbers cannot be met.
    """
    if flaw not in (None, *FLAWS):
        raise InputError(f"no such flaw of a layout: {flaw}", f"there are {', '.join(FLAWS)}")
    if tables < 1 or nodes < least_nodes(tables) + (flaw == "unreachable_table"):
        raise InputError(
            f"{tables} tables cannot be laid out with {nodes} nodes",
            f"{max(tables, 1)} tables take {least_nodes(max(tables, 1)) + bool(flaw)} nodes or more",
        )
    refusal = InputError("")
    for attempt in range(ATTEMPTS):
        rng = Random(f"layout {seed} {nodes} {tables} {attempt}")
        try:
            return _attempt(rng, nodes, tables, name, bar, waiters, flaw, handsome)
        except InputError as fault:
            refusal = fault
    raise refusal


def _attempt(
    rng: Random,
    nodes: int,
    tables: int,
    name: str,
    bar: bool,
    waiters: int,
    flaw: str | None,
    handsome: bool,
) -> Layout:
    """Returns one layout by chance; `InputError` when there is no room for the waiters in it."""
    island = flaw == "unreachable_table"
    floor = _Floor(rng, nodes - island, max(tables - island, 1), handsome)
    places, furniture = floor.points, floor.tables(rng, tables - island)
    if island:
        x = COLUMN * floor.columns + 4.0 + max(place[0] for place in places)
        places = [*places, (x, 0.0)]
        furniture.append(Table(f"table{tables}", 4, (f"n{nodes}",), (x, -1.7), (0.8, 1.6), 4))
    layout = Layout(
        name=name,
        nodes=tuple(Node(f"n{k + 1}", point) for k, point in enumerate(places)),
        edges=tuple(sorted(floor.edges(rng), key=lambda e: (int(e[0][1:]), int(e[1][1:])))),
        entrance=floor.entrance(rng),
        tables=tuple(furniture),
        agent="",
    )
    if bar:
        layout = _with_bar(rng, layout, floor.leftmost(rng))
    return _with_staff(rng, layout, waiters, blocked=flaw == "blocked_aisle")


def least_nodes(tables: int) -> int:
    """Returns the smallest number of nodes with which so many tables can be laid out."""
    return max(2, -(-tables // 2))


class _Floor:
    """Aisles, gaps and corridors: where nodes stand and which of them are joined."""

    def __init__(self, rng: Random, nodes: int, tables: int, handsome: bool) -> None:
        self.columns, self.rows = self._shape(rng, nodes, tables, handsome)
        fronts = [(column, row) for row in range(self.rows) for column in range(self.columns)]
        spots = {(COLUMN * column, row) for column, row in fronts}
        if self.rows > 1:
            spots |= {(-GAP, row) for row in range(self.rows)}
        gaps = [(COLUMN * column + GAP, row) for column, row in fronts]
        extra = nodes - len(spots)
        spots |= set(rng.sample(gaps, min(len(gaps), rng.randint(extra * 3 // 4, extra))))
        ends = [(row, side) for row in range(self.rows) for side in (-1, 1)]
        while len(spots) < nodes:
            row, side = rng.choice(ends)
            if handsome:  # no aisle much longer than the others
                middle = COLUMN * (self.columns - 1) / 2
                row, side = min(
                    ends, key=lambda end: abs(_tip(spots, *end) - middle) + rng.random() * COLUMN
                )
            tip = _tip(spots, row, side)
            spots.add((tip + GAP * side, row))
        self.spots = sorted(spots, key=lambda spot: (spot[1], spot[0]))
        self.name = {spot: f"n{k + 1}" for k, spot in enumerate(self.spots)}
        self.points: list[Point] = [(x, round(ROW * row, 3)) for x, row in self.spots]

    @staticmethod
    def _shape(rng: Random, nodes: int, tables: int, handsome: bool) -> tuple[int, int]:
        """Columns and rows that have room for the tables, are not too many, and nearly square."""
        shapes = []
        for rows in range(1, max(tables, nodes // 6 if handsome else 1) + 1):
            least = -(-tables // (rows + 1))
            for columns in range(least, least + 3):
                if columns * rows + (rows if rows > 1 else 0) <= nodes:
                    unused = columns * (rows + 1) - tables
                    askew = abs(COLUMN * columns - ROW * (rows + 1)) / 2
                    if handsome:
                        width = max(COLUMN * columns, GAP * nodes / rows)
                        askew = abs(width - 1.6 * ROW * (rows + 1))
                    shapes.append((unused + askew + rng.random() * 3, columns, rows))
        _, columns, rows = min(shapes)
        return columns, rows

    def edges(self, rng: Random) -> list[tuple[str, str]]:
        """Returns edges along each aisle, and from aisle to aisle at some of the gaps."""
        pairs = [(a, b) for a, b in zip(self.spots, self.spots[1:]) if a[1] == b[1]]
        for x, row in self.spots:
            is_gap = (x / GAP) % 2 == 1 and -GAP <= x < COLUMN * self.columns
            if is_gap and (x, row + 1) in self.name and (x < 0 or rng.random() < 0.8):
                pairs.append(((x, row), (x, row + 1)))
        return [(self.name[a], self.name[b]) for a, b in pairs]

    def tables(self, rng: Random, count: int) -> list[Table]:
        """Tables for 2, 4 and 6 below, between and above the aisles."""
        slots = [(c, level) for level in range(self.rows + 1) for c in range(self.columns)]
        out = []
        for number, (column, level) in enumerate(sorted(rng.sample(slots, count)), 1):
            x = COLUMN * column
            nodes = [self.name[x, row] for row in (level - 1, level) if (x, row) in self.name]
            if len(nodes) == 2 and rng.random() < 0.25:
                nodes.remove(rng.choice(nodes))
            capacity = rng.choice((2, 4, 4, 6)) if number > 1 else 4
            at = (x, round(ROW * level - ROW / 2, 3))
            size = (0.8, round(0.4 * capacity, 3))
            out.append(Table(f"table{number}", capacity, tuple(nodes), at, size, capacity))
        return out

    def entrance(self, rng: Random) -> str:
        """Returns a node beside which no table stands, where there is one."""
        doors = [self.name[x, row] for x, row in self.spots if (x / GAP) % 2 == 1]
        return rng.choice(doors or list(self.name.values()))

    def leftmost(self, rng: Random) -> str:
        """Returns the left end of an aisle, where a bar finds room."""
        row = rng.randrange(self.rows)
        return self.name[next(spot for spot in self.spots if spot[1] == row)]


def _tip(spots: set[tuple[float, int]], row: int, side: int) -> float:
    """Returns where an aisle ends on the left (-1) or the right (1)."""
    return max(x * side for x, at in spots if at == row) * side


def _with_bar(rng: Random, layout: Layout, end: str) -> Layout:
    x, y = layout.node(end).at or (0.0, 0.0)
    nodes = [end, *rng.sample(layout.neighbours()[end], rng.randint(0, 1))]
    # Only nodes of the same aisle stand before the bar.
    nodes = [n for n in nodes if (layout.node(n).at or (x, y))[1] == y]
    if x > -GAP:  # a table's chairs reach to 0.95 m left of its node
        x = -GAP + 0.6
    corners = ((round(x - 1.2, 3), round(y - 0.8, 3)), (round(x - 0.6, 3), round(y + 0.8, 3)))
    objects = ("plate", "jug", "basket")
    return replace(layout, bar=Bar(tuple(nodes), corners), objects=objects)


def _with_staff(rng: Random, layout: Layout, waiters: int, blocked: bool) -> Layout:
    """Waiters on nodes that cut off no table and no bar, and the agent anywhere else."""
    if blocked and waiters < 1:
        raise InputError("a blocked aisle takes a waiter who blocks it", "ask for one or more")
    near = layout.neighbours()
    taken: set[str] = set()
    if blocked:
        cut = find_cut(rng, near, layout.entrance)
        if cut is None:
            raise InputError(
                "this layout has no aisle that one waiter could block", "try another seed"
            )
        taken.add(cut[0])
        layout = replace(layout, agent=cut[1])
    within = reachable(near, layout.entrance, ())
    for name in rng.sample(sorted(within), len(within)):
        if len(taken) == waiters:
            break
        if name in (layout.entrance, layout.agent) or (layout.bar and name in layout.bar.nodes):
            continue
        posts = taken | {name}
        open_ = reachable(near, layout.entrance, posts)
        places = [table.nodes for table in layout.tables if within.intersection(table.nodes)]
        places += [layout.bar.nodes] if layout.bar else []
        if blocked or (len(open_) > 1 and all(open_.intersection(nodes) for nodes in places)):
            taken = posts
    if len(taken) < waiters:
        raise InputError(
            f"{waiters} waiters would stand in the way of the agent",
            f"there is room for {len(taken)}: ask for fewer, or for more nodes",
        )
    if not blocked:
        free_nodes = sorted(reachable(near, layout.entrance, taken) - {layout.entrance})
        layout = replace(layout, agent=rng.choice(free_nodes or [layout.entrance]))
    posts_in_order = rng.sample(sorted(taken), len(taken))
    staff = tuple((f"w{k + 1}", node) for k, node in enumerate(posts_in_order))
    return replace(layout, waiters=tuple(sorted(staff)))


def find_cut(rng: Random, near: Graph, entrance: str) -> tuple[str, str] | None:
    """Returns a node that one waiter can block, and a node cut off by it from the entrance."""
    names = list(near)
    lost = {cut.node: sorted(sum(cut.lost, ())) for cut in cut_nodes(near, entrance)}
    for post in rng.sample(names, len(names)):
        if post != entrance and post in lost:
            return post, rng.choice(lost[post])
    return None
