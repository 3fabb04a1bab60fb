"""Finds the least walk of a relaxed problem: who is led where, and what is done on the way.

Leading a party is a loop from the entrance to a table and back, priced by the assignment of
`Seating`; everything else is a chain of stops that can be done anywhere in a loop, before the first
one or after the last seat.  `find_route` runs Dijkstra's algorithm over (how far each chain is, where
the agent is, what part of a loop it is in).  Relaxed are: that two loops use different tables and
how dear the assignment gets by it (prices make up for most of that), and any order of goals.

Keys are kept non-negative by potentials: while a party is led, the shortest way so far is taken off;
on the way back, the shortest way home is put on.  A loop in which nothing happens costs nothing.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.chain_automaton import Machine
from waiter_cli.bounds.distances import FAR, WalkDistances
from waiter_cli.bounds.matching import Assignment
from waiter_cli.bounds.seating import Seating
from waiter_cli.bounds.service_chains import HAND_LINKS

__all__ = ["RouteEvent", "Route", "Tolls", "find_route"]

# Parts of a tour: with nobody, more to be picked; leading, and it goes on; leading the last one;
# after the last seat; leading the party of the start, and it goes on; leading it, the last one.
BACK, OUT, LAST_OUT, REST, LED, LAST_LED = range(6)
_LEADING = (OUT, LAST_OUT, LED, LAST_LED)


@dataclass(frozen=True)
class RouteEvent:
    """One thing on a route at ``node``: ``pick``, ``seat`` (at ``table``), or a link of a task."""

    name: str
    node: int
    table: str = ""
    task: int = -1
    index: int = -1


@dataclass(frozen=True)
class Route:
    """A least route: its cost beyond deeds (assignment and prices included), and what happens.

    ``seats`` are the tables it uses where it mattered, with whether the led party sits there;
    ``prices`` what their use was charged; ``states`` is how many the search came to.
    """

    cost: int
    events: tuple[RouteEvent, ...]
    seats: tuple[tuple[str, bool], ...]
    prices: int
    loops: int
    states: int


@dataclass(frozen=True)
class Tolls:
    """The tolls of a route for every loop, and for every use of a table; given back once for all.

    There are only so many loops, and each table can be used once: whatever the tolls (0 or more), a
    least route with them, less what is given back, costs no more than any plan.
    """

    loop: int = 0
    tables: tuple[tuple[str, int], ...] = ()

    def returned(self, trips: int) -> int:
        """Returns the refund where ``trips`` loops are made."""
        return self.loop * trips + sum(toll for _, toll in self.tables)

    def raised(self, route: Route, trips: int, step: int) -> Tolls:
        """Higher where a route makes too much use of something, lower where it makes none."""
        used: dict[str, int] = {}
        for name, _ in route.seats:
            used[name] = used.get(name, 0) + 1
        old = dict(self.tables)
        new = {name: max(0, toll + step * (used.get(name, 0) - 1)) for name, toll in old.items()}
        new |= {name: step * (k - 1) for name, k in used.items() if k > 1 and name not in old}
        over = route.loops - trips
        loop = max(0, self.loop + (step if over > 0 else -step if over < 0 else 0))
        return Tolls(loop, tuple(sorted((name, toll) for name, toll in new.items() if toll)))


# A seat on the way: change of key, node, table, price, and the mark of a table to be used once.
_Seat = tuple[int, int, str, int, int]


class _Search:
    def __init__(
        self,
        seating: Seating,
        solved: Assignment,
        machine: Machine,
        end: int | None,
        trips: int,
        once: tuple[str, ...],
        tolls: Tolls,
        counting: bool,
    ) -> None:
        self.seating, self.solved, self.machine, self.end = seating, solved, machine, end
        self.floor: WalkDistances = seating.floor
        self.trips, self.once, self.tolls = trips, once, tolls
        self.counting = counting
        self.start, self.door = seating.start, self.floor.door
        self.out, self.home = self.floor.row(self.door), self.floor.column(self.door)
        led = seating.led
        others = [row for row in range(len(seating.parties)) if row != led]
        self.spots = self._spots(others, False)
        self.led_spots = self._spots([led], True) if led is not None else []
        self.slope = 0
        if led is not None or trips:
            loops = [loop for _, _, loop, _ in (*self.spots, *self.led_spots)]
            self.slope = max(loops, default=0)
        self._vias: dict[tuple[int, int, int], list[_Seat]] = {}

    def _spots(self, rows: list[int], led: bool) -> list[tuple[int, str, int, int]]:
        """(node, table, walk that the assignment has paid, price) of every seat to be used."""
        seating, found = self.seating, []
        for column, table in enumerate(seating.tables):
            able = [row for row in rows if self.solved.costs[row][column] < FAR >> 1]
            if not able:
                continue
            price = min(self.solved.slack(row, column) for row in able)
            price += dict(self.tolls.tables).get(table.name, 0)
            nodes = self.floor.nodes_of[table.name]
            paid = min(seating.loop(rows[0] if led else able[0], node) for node in nodes)
            found += [(node, table.name, paid, price) for node in nodes]
        return found

    def via(self, part: int, here: int, there: int) -> list[_Seat]:
        """Returns the seats to be had on the way from ``here`` to ``there``, least
        change of key first.

        ``there`` -1 is to end at the seat (or where the tour must end).
        """
        key = (part, here, there)
        seats = self._vias.get(key)
        if seats is not None:
            return seats
        led = part in (LED, LAST_LED)
        line = self.floor.row(here)
        base = self.floor.row(self.start)[here] if led else self.out[here]
        last = part in (LAST_OUT, LAST_LED)
        if there >= 0:
            after = self.floor.column(there)
            base += self.slope if last else self.home[there]
        elif self.end is not None:
            after = self.floor.column(self.end)
            base += self.slope
        else:
            after = [0] * len(line)
            base += self.slope
        best: dict[int, _Seat] = {}
        for node, table, paid, price in self.led_spots if led else self.spots:
            cost = line[node] + after[node] - paid + price
            mark = 1 << self.once.index(table) if table in self.once and not led else 0
            if cost < FAR >> 1 and (mark not in best or cost < best[mark][0]):
                best[mark] = (cost, node, table, price, mark)
        seats = sorted((cost + base, n, t, p, mark) for cost, n, t, p, mark in best.values())
        self._vias[key] = seats
        return seats

    def run(self, limit: int) -> Route | None:
        """Returns the least route, None when it takes more than ``limit`` states or there is none."""
        machine, floor, door, home = self.machine, self.floor, self.door, self.home
        led = self.seating.led is not None
        first: list[tuple[int, int]] = []
        if led:
            if self.trips:
                first.append((LED, 0))
            required = self.seating.required - 1
            if not required:
                first.append((LAST_LED, 0))
        elif self.trips:
            first.append((BACK, home[self.start]))
        else:
            first.append((REST, 0))
        counted = self.trips if self.counting else 0
        marks = 1 << len(self.once)
        rounds = (counted + 1) * marks
        width = len(floor.names)
        buckets: list[list[int]] = [[] for _ in range(256)]
        came: dict[int, tuple[int, int]] = {}
        cost_of: dict[int, int] = {}
        toll = self.tolls.loop
        ends = {BACK: home, REST: [0] * width}
        starts = dict.fromkeys((OUT, LAST_OUT), self.out)
        starts |= {part: floor.row(self.start) for part in (LED, LAST_LED)}
        ahead: dict[int, list[tuple[int, int]]] = {}  # state → (node, code there in part 0)
        unit = width * rounds
        moves: list[tuple[int, int, int]] = []  # (cost, code, which seat)
        for part, cost in first:
            if cost >= FAR >> 1:
                continue
            for state in machine.arrive(0, self.start):
                code = ((state * 6 + part) * width + self.start) * rounds
                cost_of[code] = cost
                came[code] = (-1, -1)
                self._push(buckets, cost, code)
        goal = -2
        finals: dict[int, tuple[int, int]] = {}
        level = 0
        while level < len(buckets):
            bucket = buckets[level]
            while bucket:
                code = bucket.pop()
                if code < 0:
                    return self._read(code, finals, came, rounds, width, level)
                if cost_of[code] != level:
                    continue
                if len(cost_of) > limit:
                    return None
                rest, used = divmod(code, rounds)
                rest, here = divmod(rest, width)
                state, part = divmod(rest, 6)
                line = floor.row(here)
                if state == machine.done:
                    if part == REST:
                        cost = level + (line[self.end] if self.end is not None else 0)
                        if cost < FAR >> 1:
                            goal -= 1
                            finals[goal] = (code, -1)
                            self._push(buckets, cost, goal)
                    elif part in (LAST_OUT, LAST_LED):
                        for choice, (change, *_, mark) in enumerate(self.via(part, here, -1)):
                            if not mark & used:
                                goal -= 1
                                finals[goal] = (code, choice)
                                self._push(buckets, level + change, goal)
                pairs = ahead.get(state)
                if pairs is None:
                    pairs = ahead[state] = [
                        (there, (fresh * 6 * width + there) * rounds)
                        for there in machine.targets(state)
                        for fresh in machine.arrive(state, there)
                        if fresh != state
                    ]
                if floor.one_way:
                    pairs = [(there, key) for there, key in pairs if line[there] < FAR]
                moves.clear()
                if part in _LEADING:
                    shift = starts[part]
                    base = level + shift[here]
                    own = part * unit + used
                    moves += [(base + line[y] - shift[y], key + own, -1) for y, key in pairs]
                    own = (BACK if part in (OUT, LED) else REST) * unit + used
                    for there, key in pairs:
                        for choice, (change, _, _, _, mark) in enumerate(
                            self.via(part, here, there)
                        ):
                            if not mark & used:
                                moves.append((level + change, key + own + mark, choice))
                    if part in (OUT, LED):
                        for choice, (change, _, _, _, mark) in enumerate(
                            self.via(part, here, door)
                        ):
                            if not mark & used:
                                for fresh in machine.arrive(state, door):
                                    key = (fresh * 6 * width + door) * rounds + own + mark
                                    moves.append((level + change, key, choice))
                else:
                    shift = ends[part]
                    base = level - shift[here]
                    own = part * unit + used
                    moves += [(base + line[y] + shift[y], key + own, -1) for y, key in pairs]
                    if part == BACK:  # walking home is paid already
                        for fresh in machine.arrive(state, door):
                            key = (fresh * 6 * width + door) * rounds + used
                            moves.append((level + toll, key + LAST_OUT * unit, -1))
                            if not counted:
                                moves.append((level + toll, key + OUT * unit, -1))
                            elif used // marks < counted - 1:
                                moves.append((level + toll, key + OUT * unit + marks, -1))
                for cost, key, choice in moves:
                    if cost >= FAR >> 1:  # there is no way back
                        continue
                    if key not in cost_of or cost < cost_of[key]:
                        cost_of[key] = cost
                        came[key] = (code, choice)
                        if cost >= len(buckets):
                            self._push(buckets, cost, key)
                        else:
                            buckets[cost].append(key)
            level += 1
        return None

    @staticmethod
    def _push(buckets: list[list[int]], cost: int, code: int) -> None:
        while len(buckets) <= cost:
            buckets.append([])
        buckets[cost].append(code)

    def _read(
        self,
        goal: int,
        finals: dict[int, tuple[int, int]],
        came: dict[int, tuple[int, int]],
        rounds: int,
        width: int,
        level: int,
    ) -> Route:
        """Returns the route that leads to ``goal``."""
        machine = self.machine
        code, last_seat = finals[goal]
        trail: list[tuple[int, int]] = []  # (code, which seat on the way there)
        while code >= 0:
            source, seat = came[code]
            trail.append((code, seat))
            code = source
        trail.reverse()
        events: list[RouteEvent] = []
        seats: list[tuple[str, bool]] = []
        prices = loops = 0
        before = [0] * len(machine.courses)
        previous = -1
        old_part = -1

        def sit(part: int, here: int, there: int, choice: int) -> None:
            nonlocal prices
            _, node, table, price, _ = self.via(part, here, there)[choice]
            if part != OUT or not here == there == self.door:  # else a loop with nothing in it
                events.append(RouteEvent("seat", node, table))
                seats.append((table, part in (LED, LAST_LED)))
                prices += price

        for code, choice in trail:
            rest, here = divmod(code // rounds, width)
            state, part = divmod(rest, 6)
            if old_part in _LEADING and part not in _LEADING:
                sit(old_part, previous, here, choice)
            now = machine.progress(state)
            events += self._done(before, now, here)
            if part in (OUT, LAST_OUT) and old_part == BACK:
                events.append(RouteEvent("pick", here))
                loops += 1
            before, previous, old_part = now, here, part
        if last_seat >= 0:
            sit(old_part, previous, -1, last_seat)
        cost = self.solved.cost + level - self.slope - self.tolls.returned(self.trips)
        return Route(cost, tuple(events), tuple(seats), prices, loops, len(came))

    def _done(self, before: list[int], now: list[int], node: int) -> list[RouteEvent]:
        """Returns the links done at ``node``, in an order in which hands are free
        when they must be.
        """
        machine, at, found = self.machine, list(before), []
        while at != now:
            courses = machine.courses
            behind = [k for k in range(len(at)) if at[k] < now[k]]
            open_ = [k for k in behind if not machine.waits(at, courses[k])]
            free = machine.free(at)
            names = {k: machine.courses[k].links[at[k]].name for k in open_}
            ready = [k for k in open_ if free or names[k] not in HAND_LINKS]
            # what fills the hands comes last, and first of that what frees them here again
            k = min(
                ready or open_,
                key=lambda k: (names[k] in HAND_LINKS, machine.hold[k][now[k]]),
            )
            course = machine.courses[k]
            whose = course.also or ((course.task, course.indices[at[k]]),)
            found += [RouteEvent(names[k], node, "", task, index) for task, index in whose]
            at[k] += 1
        return found


def find_route(
    seating: Seating,
    solved: Assignment,
    machine: Machine,
    end: int | None,
    trips: int,
    *,
    limit: int,
    once: tuple[str, ...] = (),
    tolls: Tolls = Tolls(),
    counting: bool = False,
) -> Route | None:
    """Returns the least route for an assignment's prices.

    ``trips`` parties are picked at the entrance.

    None beyond ``limit`` states.  Tables in ``once`` are used in one loop at most.
    Only with ``counting`` are there no more loops than ``trips``.
    """
    return _Search(seating, solved, machine, end, trips, once, tolls, counting).run(limit)
