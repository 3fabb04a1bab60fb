"""The least that any plan takes, and a plan near it: `Needs`, `Floor` → both.

Entry point `Estimate.find`.  A route of the relaxation (`routes`) bounds every plan from below; put
in terms of parties and tables it makes a tour, which bounds the least plan from above.  Where they
differ because a table is used twice or dearer than its price, the choice of tables is split (used
or not used), best bound first, until they meet or the time for it is over.
"""

from __future__ import annotations

import heapq
from dataclasses import replace

from waiter_cli.bounds.construct import Builder, Clock, nodes_of
from waiter_cli.bounds.courses import HAND_LINKS, Link
from waiter_cli.bounds.floor import Floor, Staff
from waiter_cli.bounds.needs import Chain, Needs
from waiter_cli.bounds.routes import Course, Machine, Route, Tolls, find_route
from waiter_cli.bounds.seating import Choice, Seating
from waiter_cli.bounds.tour import Stop, Tour
from waiter_cli.bounds.walk import write_plan
from waiter_cli.plan import Plan
from waiter_cli.problem import Problem

__all__ = ["Estimate"]

_SIZE = 1500
"""The most states of all chains together that a relaxation looks at; the rest is dropped."""
_STATES = 60_000
"""The most states of a route search."""
_SPLITS = 100
"""The most choices of tables that are looked at."""
_TURNS, _STEP = 6, 2
"""How often the tolls of one choice are changed, and by how many steps at first."""
_SECONDS = 0.2
"""How long all of this takes, in seconds of the processor; the first route is always finished."""


class Estimate:
    """Both bounds of one problem, of which nothing is known to be impossible."""

    def __init__(
        self, problem: Problem, needs: Needs, floor: Floor, staff: Staff, deadline: float | None
    ) -> None:
        self.problem, self.needs, self.floor, self.staff = problem, needs, floor, staff
        self.seating = Seating(problem, needs, floor)
        self.clock = Clock(_SECONDS, deadline)
        self.builder = Builder(self.seating, self.clock)
        self.deeds = sum(link.is_deed for chain in needs.chains for link in chain.sure)
        self.deeds += self.seating.deeds_at_door()
        self.tour: Tour | None = None
        self.cost = 0

    def find(self) -> tuple[int, Plan | None]:
        """A lower bound, and a legal plan when one was found."""
        lower = self.split()
        tour = self.tour
        if tour is None:
            return lower, None
        if self.cost > lower:
            self.builder.improve(tour, lower)
            self.cost = self.builder.cost(tour)
        plan = write_plan(self.problem, self.floor, self.staff, tour.stops, self.builder.end)
        return lower, plan

    def split(self) -> int:
        """The lower bound; keeps the best tour that was met on the way."""
        seating = self.seating
        led = seating.led is not None
        optional = min(len(seating.parties) - seating.required, len(self.needs.forced))
        trips = seating.required - led + optional
        machine, whole = self.machine(True)
        queue: list[tuple[int, int, Choice, Route | None, Tolls]] = []
        count = 0

        def look(choice: Choice, least: int, tolls: Tolls) -> None:
            """Enters the part of all plans that keep to ``choice``, with its bound."""
            nonlocal count
            solved = seating.solve(choice)
            if solved is None:
                return
            best, kept, chosen = least, None, tolls
            step = _STEP
            for _ in range(_TURNS):
                route = find_route(
                    seating,
                    solved,
                    machine,
                    self.builder.end,
                    trips,
                    limit=_STATES,
                    once=choice.once,
                    tolls=tolls,
                )
                count += 1
                if route is None:
                    break
                bound = self.deeds + route.cost
                if kept is None or bound > best:
                    kept, chosen = route, tolls
                best = max(best, bound)
                self.keep(self.realise(choice, route), best)
                if self.tour is not None and self.cost <= best:
                    break
                following = tolls.raised(route, trips, step)
                if following == tolls or self.late(count):
                    break
                if bound < best:
                    step = max(1, step // 2)
                tolls = following
            heapq.heappush(queue, (best, count, choice, kept, chosen))

        look(Choice(), self.deeds, Tolls())
        while queue:
            bound, _, choice, route, tolls = heapq.heappop(queue)
            if self.tour is not None and self.cost <= bound:
                return self.cost
            parts = _parts(choice, route) if route is not None else []
            if not parts or self.late(count):
                if self.tour is None:
                    self.keep(self.plain(choice))
                return bound
            for part in parts:
                look(part, bound, tolls)
        return self.cost if self.tour is not None else self.deeds

    def late(self, count: int) -> bool:
        """Whether enough routes were looked at, or the time for it is over."""
        return count >= _SPLITS or self.clock.over()

    def machine(self, hands_first: bool) -> tuple[Machine, bool]:
        """The certain links of all chains, or of so many that they can be looked at together.

        Also whether that is all of them.  Which come first: those that fill the hands or the
        others, and of each kind those that are farthest from the entrance.
        """
        courses = [self.course(number, chain) for number, chain in self.builder.chains({}).items()]
        courses = [course for course in courses if course.links]
        home = self.floor.row(self.floor.door)

        def rank(course: Course) -> tuple[bool, int]:
            hands = course.held or any(link.name in HAND_LINKS for link in course.links)
            away = max(min(home[node] for node in nodes) for nodes in course.nodes)
            return hands != hands_first, -away

        courses.sort(key=rank)
        machine = Machine(_merged(courses))
        number = len(courses)
        while machine.count > _SIZE:
            number -= 1
            machine = Machine(_merged(courses[:number]))
        return machine, number == len(courses)

    def course(self, number: int, chain: Chain) -> Course:
        """A chain as the relaxation sees it; what follows a seat at once costs no walk."""
        skipped = ("give_bill", "take_order") if chain.seat_first else ()
        skipped += ("bring_chairs",) if chain.table in self.seating.index else ()
        kept: list[tuple[int, Link]] = []
        position = 0
        for index, link in enumerate(chain.links):
            if position < len(chain.sure) and link == chain.sure[position]:
                position += 1
                if link.name not in skipped:
                    kept.append((index, link))
        names = [link.name for _, link in kept]
        held = "bring" in names and not {"take_up", "refill"} & set(names[: names.index("bring")])
        return Course(
            number,
            tuple(link for _, link in kept),
            tuple(index for index, _ in kept),
            tuple(nodes_of(self.floor, link) for _, link in kept),
            held,
        )

    # ------------------------------------------------------------ tours

    def keep(self, tour: Tour | None, least: int = 0) -> None:
        """Remembers the better tour; the first one is improved at once, ``least`` is enough."""
        if tour is not None:
            tour.settle()
            cost = self.builder.cost(tour)
            if self.tour is None or cost < self.cost:
                first = self.tour is None
                self.tour, self.cost = tour, cost
                if first and cost > least:
                    self.builder.improve(tour, least)
                    self.cost = self.builder.cost(tour)

    def seats(self, choice: Choice) -> dict[int, str] | None:
        """Who sits where when tables are chosen so."""
        solved = self.seating.solve(choice)
        if solved is None:
            return None
        return {
            row: self.seating.tables[column].name
            for row, column in enumerate(solved.column)
            if column < len(self.seating.tables)
        }

    def plain(self, choice: Choice) -> Tour | None:
        """A tour by insertion alone."""
        chosen = self.seats(choice)
        return self.builder.build(chosen) if chosen is not None else None

    def realise(self, choice: Choice, route: Route) -> Tour | None:
        """The route as a tour: parties put to its tables, what it left out put in.

        Where it uses a table again, another party is led to its own table instead.
        """
        names = dict.fromkeys(name for name, _ in route.seats)
        led_at = next((name for name, led in route.seats if led), choice.led_at)
        chosen = self.seats(replace(choice, must=choice.must | set(names), led_at=led_at))
        if chosen is None:
            return self.plain(choice)
        tour = Tour(self.floor, self.seating.start, self.builder.end)
        tasks = {row: self.builder.guest(row, {name}) for row, name in chosen.items()}
        for number, chain in self.builder.chains(chosen).items():
            tasks[number] = self.builder.chain(number, chain)
        who, others = self._loops(route, chosen)
        last = max((k for k, event in enumerate(route.events) if event.name == "pick"), default=-1)
        for k, event in enumerate(route.events):
            if k == last:
                for row in others:
                    self._lead(tour, row, chosen[row])
            if event.name == "pick":
                if k in who:
                    self._pick(tour, who[k])
            elif event.name == "seat":
                if k in who and chosen[who[k]] == event.table:
                    self._seat(tour, who[k], event.table, event.node)
                elif k in who:
                    self._seat(tour, who[k], chosen[who[k]], None)
            elif event.task in tasks and event.index < len(tasks[event.task].links):
                task = tasks[event.task]
                nodes = tuple(task.places[event.index])
                tour.stops.append(Stop(task.links[event.index], event.node, nodes, event.task))
        tour.tasks = {stop.task: tasks[stop.task] for stop in tour.stops}
        if not chosen.keys() <= tour.tasks.keys():
            return self.plain(choice)
        for number, task in list(tour.tasks.items()):
            if sum(stop.task == number for stop in tour.stops) < len(task.links):
                tour.remove(number)
        return self.builder.add_chains(tour, chosen)

    def _loops(self, route: Route, chosen: dict[int, str]) -> tuple[dict[int, int], list[int]]:
        """Which party each seat and its pick (by their place in the route) are about; the others."""
        owner = {name: row for row, name in chosen.items()}
        named = {name for name, _ in route.seats}
        others = [row for row, name in chosen.items() if name not in named]
        who: dict[int, int] = {}
        pick = -1
        for k, event in enumerate(route.events):
            if event.name == "pick":
                pick = k
            elif event.name == "seat":
                row = owner.pop(event.table, None)
                if row is None and others:
                    row = others.pop()
                if row is not None:
                    who[k] = row
                    if row != self.seating.led and pick >= 0:
                        who[pick] = row
        return who, others

    def _pick(self, tour: Tour, row: int) -> None:
        party, door = self.seating.parties[row], self.floor.door
        tour.stops.append(Stop(Link("pick", "", party[0]), door, (door,), row, party))

    def _seat(self, tour: Tour, row: int, table: str, node: int | None) -> None:
        party, nodes = self.seating.parties[row], self.floor.nodes_of[table]
        if node is None:
            node = min(nodes, key=lambda n: self.seating.loop(row, n))
        tour.stops.append(Stop(Link("seat", table, party[0]), node, nodes, row, party))

    def _lead(self, tour: Tour, row: int, table: str) -> None:
        """Adds a loop in which nothing else happens."""
        if row != self.seating.led:
            self._pick(tour, row)
        self._seat(tour, row, table, None)


def _merged(courses: list[Course]) -> list[Course]:
    """The same with all orders sent at once: a visit of the bar after the last was taken will do."""
    found: list[Course] = []
    also: list[tuple[int, int]] = []
    after: list[int] = []
    bar: tuple[int, ...] = ()
    link = None
    for course in courses:
        names = [link.name for link in course.links]
        if names[-1] != "send_order" or len(names) > 2:
            found.append(course)
            continue
        also.append((course.task, course.indices[-1]))
        bar, link = course.nodes[-1], course.links[-1]
        if len(names) == 2:
            after.append(len(found))
            found.append(Course(course.task, course.links[:1], course.indices[:1], course.nodes[:1]))
    if link is not None:
        together = Course(-1, (link,), (0,), (bar,), after=tuple(after), also=tuple(also))
        found.append(together)
    return found


def _parts(choice: Choice, route: Route) -> list[Choice]:
    """The choice split in two by something that the route leaves open; empty when nothing is."""
    for name, led in route.seats:
        if led and choice.led_at is None:
            return [
                replace(choice, led_at=name),
                replace(choice, led_never=choice.led_never | {name}),
            ]
    names = [name for name, _ in route.seats]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None and twice not in choice.once:
        return [replace(choice, once=(*choice.once, twice))]
    for name in names:
        if name not in choice.must:
            return [
                replace(choice, must=choice.must | {name}),
                replace(choice, never=choice.never | {name}),
            ]
    return []
