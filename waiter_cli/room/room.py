"""Furnishes a room: `Layout` → `Room`, the places of everything in metres. Entry points `build_room`, `sweep`.

Chairs, the places where guests wait and the door are not in a layout; they are put where the
robot's ways stay clear.  `sweep` drives a disc of the robot's size along every edge before anything
moves; an edge that runs through furniture is an input error that names the edge.
"""

from __future__ import annotations

import heapq
from bisect import bisect_left, bisect_right
from collections.abc import Collection, Iterable, Iterator
from math import ceil, cos, hypot, pi, sin

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.model.layout import Layout, Point, Table
from waiter_cli.room.local_frame import near_origin, to_local
from waiter_cli.room.shapes import Box, Disc, Solid, distance, walk_distance

__all__ = [
    "Chair",
    "PERSON",
    "ROBOT",
    "Room",
    "build_room",
    "nearest_on_walk",
    "sweep",
    "without_places",
]

ROBOT = 0.25
"""Radius of the robot, metres."""
PERSON = 0.20
"""Radius of a person, metres."""
CHAIR = 0.20
"""Half a chair's width, metres."""
SETBACK = 0.35
"""From a table's rim to the middle of a chair."""
WALL = 0.06
MARGIN = 1.1
"""From the outermost thing to the walls of the room."""


@dataclass(frozen=True)
class Chair:
    """A chair of a table; ``yaw`` is where the guest looks: at the table."""

    name: str
    x: float
    y: float
    yaw: float

    @property
    def box(self) -> Box:
        """Returns the chair as a solid."""
        return Box(self.name, self.x, self.y, CHAIR, CHAIR, self.yaw, 0.9)

    @property
    def behind(self) -> Point:
        """Returns the point where one stands before sitting down."""
        return (self.x - 0.36 * cos(self.yaw), self.y - 0.36 * sin(self.yaw))


@dataclass(frozen=True)
class Room:
    """The restaurant in metres, all of it and ``layout`` too from ``origin`` on, a point nearby.

    ``nodes`` has every node's place; ``chairs`` as many as a table's capacity, in the order in which
    they are brought; ``queue`` are places for guests who wait, nearest first; ``door`` is where
    people come in; ``bounds`` is (x0, x1, y0, y1).  ``origin`` is in the coordinates of the file.
    """

    layout: Layout
    nodes: dict[str, Point]
    near: dict[str, tuple[str, ...]]
    tables: dict[str, Box]
    chairs: dict[str, tuple[Chair, ...]]
    bar: Box | None
    walls: tuple[Box, ...]
    queue: tuple[Point, ...]
    door: Point
    bounds: tuple[float, float, float, float]
    origin: Point = (0.0, 0.0)

    def furniture(self, chairs: dict[str, int]) -> Iterator[Box]:
        """Yields everything that stands still, with so many chairs at each table."""
        yield from self.tables.values()
        for table, places in self.chairs.items():
            yield from (chair.box for chair in places[: chairs[table]])
        if self.bar is not None:
            yield self.bar
        yield from self.walls

    def length(self, a: str, b: str) -> float:
        """Returns metres between two nodes, as the crow flies."""
        (ax, ay), (bx, by) = self.nodes[a], self.nodes[b]
        return hypot(bx - ax, by - ay)

    def arrow(self, a: str, b: str) -> tuple[Point, Point, Point]:
        """The corners in metres of an arrow head on the path from ``a`` to ``b``, its tip first."""
        (ax, ay), (bx, by) = self.nodes[a], self.nodes[b]
        far = hypot(bx - ax, by - ay) or 1.0
        ux, uy = (bx - ax) / far, (by - ay) / far
        x, y = ax + 0.62 * (bx - ax), ay + 0.62 * (by - ay)
        back, half = min(0.3, far / 3), min(0.13, far / 7)
        base = (x - back * ux, y - back * uy)
        sides = ((base[0] - s * half * uy, base[1] + s * half * ux) for s in (1, -1))
        left, right = sides
        return (x, y), left, right

    def route(
        self,
        start: str,
        end: str,
        shut: Collection[frozenset[str]] = (),
        taken: Collection[str] = (),
    ) -> tuple[str, ...] | None:
        """Returns the shortest way in metres that avoids some edges and nodes, None
        where there is none.
        """
        best = {start: 0.0}
        rest: list[tuple[float, tuple[str, ...]]] = [(0.0, (start,))]
        while rest:
            walked, path = heapq.heappop(rest)
            here = path[-1]
            if here == end:
                return path
            for node in self.near[here]:
                if node in taken or frozenset((here, node)) in shut:
                    continue
                far = walked + self.length(here, node)
                if far < best.get(node, float("inf")) - 1e-9:
                    best[node] = far
                    heapq.heappush(rest, (far, (*path, node)))
        return None


def without_places(layout: Layout) -> Fault | None:
    """Returns the fault that the nodes have no coordinates; a layout gives them to all or to none."""
    bare = [node for node in layout.nodes if node.at is None]
    if not bare:
        return None
    import shlex

    where = dict(layout.key_where).get("nodes", bare[0].where or Where(layout.file or layout.name))
    file = layout.file if layout.file and not layout.file.startswith("<") else "LAYOUT.yaml"
    return Fault(
        where,
        f"{len(bare)} nodes have no coordinates: enough to plan, not to simulate",
        f"write {bare[0].name}: [x, y] in metres, "
        f"or let `waiter layout convert --place {shlex.quote(file)}` find places",
    )


def build_room(layout: Layout) -> Room:
    """Returns the room of a layout; raises `LayoutError` where nodes have no coordinates."""
    fault = without_places(layout)
    if fault is not None:
        raise LayoutError([fault])
    origin = near_origin(layout)
    layout = to_local(layout, origin)
    nodes = {node.name: node.at for node in layout.nodes if node.at is not None}
    ways = [(nodes[a], nodes[b]) for a, b in layout.edges] + [(at, at) for at in nodes.values()]
    tables = {
        table.name: Box(table.name, *table.at, table.size[0] / 2, table.size[1] / 2)
        for table in layout.tables
        if table.at is not None
    }
    bar = _bar(layout, nodes)
    walls = tuple(_walls(layout))
    fixed: list[Box] = [*tables.values(), *walls] + ([bar] if bar else [])
    chairs: dict[str, tuple[Chair, ...]] = {}
    # By x, so that a table looks at what stands near it alone.
    beside = sorted(ways, key=_middle)
    middles = [_middle(way) for way in beside]
    longest = max((hypot(b[0] - a[0], b[1] - a[1]) for a, b in ways), default=0.0) / 2
    standing = sorted(fixed, key=lambda box: box.x)
    across = [box.x for box in standing]
    widest = max([box.reach for box in fixed] + [2 * CHAIR])
    for table in layout.tables:
        box = tables[table.name]
        about = box.reach + SETBACK + 1.0
        low = bisect_left(middles, box.x - about - longest)
        close = beside[low : bisect_right(middles, box.x + about + longest)]
        low = bisect_left(across, box.x - about - widest)
        others = standing[low : bisect_right(across, box.x + about + widest)]
        others = [other for other in others if other.name != table.name]
        chairs[table.name] = _chairs(table, box, close, others)
        for chair in chairs[table.name]:
            place = bisect_right(across, chair.x)
            across.insert(place, chair.x)
            standing.insert(place, chair.box)
    solids = fixed + [chair.box for placed in chairs.values() for chair in placed]
    queue = tuple(_queue(nodes[layout.entrance], ways, solids, 24))
    bounds = _bounds([*nodes.values(), *queue[:8]], solids)
    return Room(
        layout,
        nodes,
        layout.neighbours(),
        tables,
        chairs,
        bar,
        walls,
        queue,
        _door(nodes[layout.entrance], bounds),
        bounds,
        origin,
    )


def sweep(room: Room, chairs: dict[str, int] | None = None) -> tuple[Fault, ...]:
    """Returns a fault for every edge on which the robot would run into furniture."""
    counts = chairs or {table.name: table.chairs for table in room.layout.tables}
    furniture = sorted(room.furniture(counts), key=lambda solid: solid.x)
    across = [solid.x for solid in furniture]
    away = max((solid.reach for solid in furniture), default=0.0) + ROBOT
    places = room.layout.edge_where
    faults: list[Fault] = []
    for index, (a, b) in enumerate(room.layout.edges):
        start, end = room.nodes[a], room.nodes[b]
        low, high = sorted((start[0], end[0]))
        near = furniture[bisect_left(across, low - away) : bisect_right(across, high + away)]
        hit, gap = nearest_on_walk(start, end, near)
        if hit is not None and gap - ROBOT < -1e-9:
            where = places[index] if index < len(places) else Where(room.layout.file or "--layout")
            faults.append(
                Fault(
                    where,
                    f"the edge {a}-{b} runs through {hit.name}: {abs(gap):.2f} m "
                    f"{'inside' if gap < 0 else 'from'} it, the robot needs {ROBOT} m beside it",
                    "move the node or the furniture, or leave the edge out",
                )
            )
    return tuple(faults)


def nearest_on_walk(
    start: Point, end: Point, solids: Iterable[Solid]
) -> tuple[Solid | None, float]:
    """Returns the solid that a straight walk comes closest to, and how close."""
    best: tuple[Solid | None, float] = (None, float("inf"))
    for solid in solids:
        gap = walk_distance(start, end, solid)
        if gap < best[1]:
            best = (solid, gap)
    return best


def _bar(layout: Layout, nodes: dict[str, Point]) -> Box | None:
    """Returns the bar from corner to corner, or a counter beside its first node where it has none."""
    if layout.bar is None:
        return None
    if layout.bar.corners is not None:
        (ax, ay), (bx, by) = layout.bar.corners
        half = (max(abs(bx - ax), 0.2) / 2, max(abs(by - ay), 0.2) / 2)
        return Box("bar", (ax + bx) / 2, (ay + by) / 2, *half, height=1.1)
    x, y = nodes[layout.bar.nodes[0]]
    ways = [(nodes[a], nodes[b]) for a, b in layout.edges] + [(at, at) for at in nodes.values()]
    tables = [
        Box(t.name, *t.at, t.size[0] / 2 + 0.5, t.size[1] / 2 + 0.5) for t in layout.tables if t.at
    ]
    away = 0.55 + 0.25
    spots = [
        Box("bar", x - away, y, 0.25, 0.6, height=1.1),
        Box("bar", x, y + away, 0.6, 0.25, height=1.1),
        Box("bar", x, y - away, 0.6, 0.25, height=1.1),
        Box("bar", x + away, y, 0.25, 0.6, height=1.1),
    ]

    def room_left(box: Box) -> float:
        clear = min(walk_distance(a, b, box) for a, b in ways)
        apart = min((distance(box.x, box.y, table) - 0.5 for table in tables), default=1.0)
        return min(clear, apart, 0.5)

    return max(spots, key=room_left)


def _walls(layout: Layout) -> Iterator[Box]:
    for number, ((ax, ay), (bx, by)) in enumerate(layout.walls, 1):
        from math import atan2

        length = hypot(bx - ax, by - ay)
        yaw = atan2(by - ay, bx - ax)
        yield Box(
            f"wall{number}", (ax + bx) / 2, (ay + by) / 2, length / 2 + WALL, WALL, yaw, height=1.1
        )


def _chairs(
    table: Table, box: Box, ways: list[tuple[Point, Point]], others: list[Box]
) -> tuple[Chair, ...]:
    """Chairs for the whole capacity: on the long sides first, out of the robot's ways.

    Opposite chairs follow each other, so a party of two sits face to face.
    """
    about = box.reach + SETBACK + 1.0  # what is farther away touches no chair
    ways = [way for way in ways if _farness(way, box) < about]
    others = [o for o in others if hypot(o.x - box.x, o.y - box.y) < about + o.reach]
    upright = box.half_y >= box.half_x
    order = (0, pi, pi / 2, -pi / 2) if upright else (pi / 2, -pi / 2, 0, pi)
    spacing = 0.5
    while True:
        slots: list[tuple[bool, int, int, float, float, float]] = []
        for side, toward in enumerate(order):
            along = box.half_y if toward in (0, pi) else box.half_x
            out = (box.half_x if toward in (0, pi) else box.half_y) + SETBACK
            count = max(1, int(2 * along / spacing + 1e-9))
            if table.capacity <= 2 and side < 2:
                count = 1
            elif side < 2:
                count = min(count, max(1, ceil(table.capacity / 2)))
            for k in range(count):
                shift = (2 * along) * ((k + 0.5) / count - 0.5)
                x = box.x + out * cos(toward) - shift * sin(toward)
                y = box.y + out * sin(toward) + shift * cos(toward)
                seat = Box("", x, y, CHAIR, CHAIR, toward)
                rank = k if side % 2 == 0 else count - 1 - k  # opposite chairs rank alike
                clear = min((walk_distance(a, b, seat) for a, b in ways), default=9.0) - ROBOT
                apart = all(distance(x, y, other) > CHAIR * 0.95 for other in others)
                free = clear > 0.02 and apart
                slots.append((not free, side // 2, rank, float(side), x, y))
        usable = [slot for slot in slots if not slot[0]]
        if len(usable) >= table.capacity or spacing < 0.2:
            break
        spacing *= 0.9
    chosen = sorted(slots)[: table.capacity]
    out_chairs = []
    for number, (_, _, _, side_number, x, y) in enumerate(chosen, 1):
        yaw = order[int(side_number)] + pi
        yaw = (yaw + pi) % (2 * pi) - pi
        out_chairs.append(
            Chair(f"chair{number}_{table.name}", round(x, 6), round(y, 6), round(yaw, 6))
        )
    while len(out_chairs) < table.capacity:  # more guests than rim: the last ones share places
        extra = out_chairs[len(out_chairs) % len(chosen)]
        name = f"chair{len(out_chairs) + 1}_{table.name}"
        out_chairs.append(Chair(name, extra.x, extra.y, extra.yaw))
    return tuple(out_chairs)


def _middle(way: tuple[Point, Point]) -> float:
    """Returns the x of the middle of a way."""
    return (way[0][0] + way[1][0]) / 2


def _farness(way: tuple[Point, Point], box: Box) -> float:
    """Returns a bound from below for the metres from a way to the middle of a box."""
    (ax, ay), (bx, by) = way
    return hypot((ax + bx) / 2 - box.x, (ay + by) / 2 - box.y) - hypot(bx - ax, by - ay) / 2


def _queue(
    entrance: Point, ways: list[tuple[Point, Point]], solids: list[Box], count: int
) -> Iterator[Point]:
    """Places to wait near the entrance: off the robot's ways, clear of furniture and each other."""
    points: list[Point] = []
    ring = 0.6
    while len(points) < count and ring < 9.0:
        around = max(12, int(2 * pi * ring / 0.3))
        for k in range(around):
            angle = -pi / 2 + 2 * pi * ((k + 1) // 2) / around * (1 if k % 2 else -1)
            x = round(entrance[0] + ring * cos(angle), 3)
            y = round(entrance[1] + ring * sin(angle), 3)
            spot = Disc("", x, y, PERSON)
            if any(walk_distance(a, b, spot) < ROBOT + 0.1 for a, b in ways):
                continue
            if any(distance(x, y, solid) < PERSON + 0.08 for solid in solids):
                continue
            if all(hypot(x - px, y - py) >= 0.5 for px, py in points):
                points.append((x, y))
                if len(points) == count:
                    break
        ring += 0.3
    yield from points or [entrance]


def _bounds(points: list[Point], solids: list[Box]) -> tuple[float, float, float, float]:
    corners = [corner for box in solids for corner in box.corners()]
    xs = [p[0] for p in points] + [c[0] for c in corners]
    ys = [p[1] for p in points] + [c[1] for c in corners]
    grown = (min(xs) - 0.3, max(xs) + 0.3, min(ys) - 0.3, max(ys) + 0.3)
    inner = [p[0] for p in points], [p[1] for p in points]
    return (
        round(min(grown[0], min(inner[0]) - MARGIN / 2), 3),
        round(max(grown[1], max(inner[0]) + MARGIN / 2), 3),
        round(min(grown[2], min(inner[1]) - MARGIN / 2), 3),
        round(max(grown[3], max(inner[1]) + MARGIN / 2), 3),
    )


def _door(entrance: Point, bounds: tuple[float, float, float, float]) -> Point:
    """Returns the point of the room's rim nearest to the entrance."""
    x0, x1, y0, y1 = bounds
    x, y = entrance
    rims = ((y - y0, (x, y0)), (x - x0, (x0, y)), (x1 - x, (x1, y)), (y1 - y, (x, y1)))
    return min(rims, key=lambda rim: rim[0])[1]
