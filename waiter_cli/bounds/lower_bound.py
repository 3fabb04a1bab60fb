"""Computes a lower bound on the length of plans, and a plan near it: `Needs`, `WalkDistances` → both.

Entry point `Estimate.find`.  A route of the relaxation (`relaxed_route`) bounds every plan from below; put
in terms of parties and tables it makes a tour, which bounds the least plan from above.  Where they
differ because a table is used twice or dearer than its price, the choice of tables is split (used
or not used), best bound first, until they meet or the time for it is over.
"""

from __future__ import annotations

import heapq
from dataclasses import replace

from waiter_cli.bounds.chain_automaton import build_machine
from waiter_cli.bounds.distances import Staff, WalkDistances
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.relaxed_route import Route, Tolls, find_route
from waiter_cli.bounds.required_tasks import Needs
from waiter_cli.bounds.route_to_tour import Unfolder
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.bounds.tour import Tour
from waiter_cli.bounds.tour_to_plan import write_plan
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = ["Estimate"]

_SIZE = 1500
"""The most states of all chains together that a relaxation looks at; the rest is dropped."""
_COUNTED = 2500
"""So many states of chains, times loops, may be told apart by the number of loops made."""
_STATES = 60_000
"""The most states of a route search."""
_SPLITS = 100
"""The most choices of tables that are looked at."""
_TURNS, _STEP = 6, 2
"""How often the tolls of one choice are changed, and by how many steps at first."""
_WORK, _ROUTE, _STATE = 120_000, 1000, 4
"""How much is spent on each bound, in about microseconds; what a route and each state of it takes."""


class Estimate:
    """Both bounds of one problem, of which nothing is known to be impossible."""

    def __init__(
        self,
        problem: Problem,
        needs: Needs,
        floor: WalkDistances,
        staff: Staff,
        deadline: float | None,
        effort: int = 1,
    ) -> None:
        self.effort = effort
        self.problem, self.needs, self.floor, self.staff = problem, needs, floor, staff
        self.seating = Seating(problem, needs, floor)
        self.clock = Clock(effort * _WORK, deadline)
        self.builder = Builder(self.seating, Clock(effort * _WORK, deadline))
        self.unfolder = Unfolder(self.builder)
        self.deeds = sum(link.is_deed for chain in needs.chains for link in chain.sure)
        self.deeds += self.seating.picks_and_seats()
        self.tour: Tour | None = None
        self.cost = 0

    def find(self) -> tuple[int, Plan | None]:
        """Returns a lower bound, and a legal plan when one was found."""
        lower = self.split()
        tour = self.tour
        if tour is None:
            return lower, None
        if self.cost > lower:
            self.builder.improve(tour, lower)
            self.builder.shake(tour, lower)
            self.cost = self.builder.cost(tour)
        plan = write_plan(self.problem, self.floor, self.staff, tour.stops, self.builder.end)
        return lower, plan

    def insertion(self) -> Plan | None:
        """Returns a legal plan by insertion alone, on a floor of which nothing is proved."""
        tour = self.unfolder.plain(TableChoice())
        if tour is None:
            return None
        self.builder.improve(tour, 0)
        return write_plan(self.problem, self.floor, self.staff, tour.stops, self.builder.end)

    def split(self) -> int:
        """Returns the lower bound; keeps the best tour that was met on the way."""
        seating = self.seating
        led = seating.led is not None
        optional = min(len(seating.parties) - seating.required, len(self.needs.forced))
        trips = seating.required - led + optional
        machine = build_machine(self.builder, self.effort * _SIZE)
        queue: list[tuple[int, int, TableChoice, Route | None, Tolls]] = []
        count, counting = 0, False

        def look(choice: TableChoice, least: int, tolls: Tolls) -> None:
            """Enters the part of all plans that keep to ``choice``, with its bound."""
            nonlocal count, counting, machine
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
                    limit=self.effort * _STATES,
                    once=choice.once,
                    tolls=tolls,
                    counting=counting,
                )
                count += 1
                states = self.effort * _STATES if route is None else route.states
                self.clock.spend(_ROUTE + _STATE * states)
                if route is None:  # too many states: forget some chains
                    machine = build_machine(self.builder, max(1, machine.count // 4))
                    continue
                if (
                    route.loops > trips
                    and not counting
                    and trips * machine.count <= self.effort * _COUNTED
                ):
                    counting, tolls = True, replace(tolls, loop=0)
                    continue
                bound = self.deeds + route.cost
                if kept is None or bound > best:
                    kept, chosen = route, tolls
                best = max(best, bound)
                self.keep(self.unfolder.realise(choice, route), best)
                if self.tour is not None and self.cost <= best:
                    break
                following = tolls.raised(route, trips, step)
                if following == tolls or self.late(count):
                    break
                if bound < best:
                    step = max(1, step // 2)
                tolls = following
            heapq.heappush(queue, (best, count, choice, kept, chosen))

        look(TableChoice(), self.deeds, Tolls())
        while queue:
            bound, _, choice, route, tolls = heapq.heappop(queue)
            if self.tour is not None and self.cost <= bound:
                return self.cost
            parts = _parts(choice, route) if route is not None else []
            if not parts or self.late(count):
                if self.tour is None:
                    self.keep(self.unfolder.plain(choice))
                return bound
            for part in parts:
                look(part, bound, tolls)
        return self.cost if self.tour is not None else self.deeds

    def late(self, count: int) -> bool:
        """Returns whether enough routes were looked at, or the time for it is over."""
        return count >= _SPLITS or self.clock.over()

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


def _parts(choice: TableChoice, route: Route) -> list[TableChoice]:
    """Returns the choice split in two by something that the route leaves open.

    Empty when nothing is.
    """
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
