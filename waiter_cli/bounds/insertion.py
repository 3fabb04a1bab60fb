"""Constructs a good tour without search: tasks inserted one by one, then moved while that helps.

`Builder` takes a `Seating` (and, when there is one, the route that the lower bound came
from) and gives stops in a row, for `tour_to_plan.write_plan`.
"""

from __future__ import annotations

import time

from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.required_tasks import Chain
from waiter_cli.bounds.seating import Seating
from waiter_cli.bounds.service_chains import BAR_LINKS, Link
from waiter_cli.bounds.tour import Task, Tour
from waiter_cli.model.state import Goal

__all__ = ["Builder", "Clock", "nodes_of"]


class Clock:
    """Says when to stop: after so much work, which is the same every time, or at the deadline.

    Work is counted in what takes about a microsecond.
    """

    def __init__(self, work: int, deadline: float | None) -> None:
        self.left = work
        self.deadline = deadline

    def spend(self, work: int) -> None:
        """Takes note of work that was done."""
        self.left -= work

    def over(self) -> bool:
        """Returns whether it is time to stop."""
        late = self.deadline is not None and time.monotonic() > self.deadline
        return late or self.left <= 0


class Builder:
    """Makes tours for one problem."""

    def __init__(self, seating: Seating, clock: Clock) -> None:
        self.seating, self.needs, self.floor = seating, seating.needs, seating.floor
        self.clock = clock
        self.numbers: dict[tuple[str, str, str], int] = {}
        self.rank = {table.name: k for k, table in enumerate(seating.problem.layout.tables)}
        end = self.needs.end
        self.end = self.floor.number[end] if end is not None else None

    def guest(self, row: int, tables: set[str]) -> Task:
        """Returns the task of leading a party to one of ``tables``."""
        party = self.seating.parties[row]
        extra, rank = self.seating.extra, self.rank  # by rank: a set has no order
        places: dict[int, str] = {}
        for name in sorted(tables, key=lambda name: (extra(row, name), rank[name])):
            for node in self.floor.nodes_of[name]:
                places.setdefault(node, name)
        seat = Link("seat", next(iter(tables)) if len(tables) == 1 else "", party[0])
        if row == self.seating.led:
            return Task(row, (seat,), [places], party, lead=[True, False])
        door = {self.floor.door: ""}
        pick = Link("pick", "", party[0])
        return Task(row, (pick, seat), [door, places], party, lead=[False, True, False])

    def chain(self, number: int, chain: Chain) -> Task:
        """Returns the task of a chain."""
        places = [dict.fromkeys(nodes_of(self.floor, link), link.table) for link in chain.links]
        first = next((k for k, link in enumerate(chain.links) if link.name in _NEED_SEATED), 0)
        after = chain.table if chain.seat_first else ""
        return Task(number, chain.links, places, after=after, after_link=first)

    def build(self, chosen: dict[int, str]) -> Tour | None:
        """Returns a tour that leads each row of ``chosen`` to its table and does all
        that is wanted.
        """
        tour = Tour(self.floor, self.seating.start, self.end)
        tour.orders = self.orders(chosen)
        rows = sorted(chosen, key=lambda row: row != self.seating.led)
        for row in rows:
            if tour.insert(self.guest(row, {chosen[row]})) is None:
                return None
        return self.add_chains(tour, chosen)

    def chains(self, chosen: dict[int, str]) -> dict[int, Chain]:
        """Returns the chains to be done when parties sit as chosen, each with the
        number of its task.
        """
        chains: dict[tuple[str, str, str], Chain] = {}
        asked = [c for row, name in chosen.items() for c in self.seating.asks[row].get(name, ())]
        for chain in (*self.needs.chains, *asked):
            first = chain.links[-1]
            if first.name == "bring_chairs" and first.table in chosen.values():
                continue  # brought when the party comes
            key = (first.name, first.table or first.node, first.item)
            if key not in chains or len(chains[key].links) < len(chain.links):
                chains[key] = chain
        return {self.number(key): chain for key, chain in chains.items()}

    def number(self, key: tuple[str, str, str]) -> int:
        """Returns the number of the task that ends with such a link; rows have smaller ones."""
        return self.numbers.setdefault(key, len(self.seating.parties) + len(self.numbers))

    def add_chains(self, tour: Tour, chosen: dict[int, str]) -> Tour | None:
        """Puts in the chains that are not there yet; those that fill the hands already first."""
        tasks = [self.chain(k, c) for k, c in self.chains(chosen).items() if k not in tour.tasks]
        for task in sorted(tasks, key=lambda task: not task.hold[0]):
            if tour.insert(task) is None:
                return None
        return tour

    def orders(self, chosen: dict[int, str]) -> list[tuple[int, int, int]]:
        """Returns the value of `Tour.orders`, from the pairs of goals in ``before``."""
        orders = []
        chains = self.chains(chosen)
        for early, late in self.seating.problem.before:
            first = self._about(early, chosen, chains)
            for number, index in self._about(late, chosen, chains)[-1:]:
                orders += [(task, number, index) for task, _ in first if task != number]
        return orders

    def _about(
        self, goal: Goal, chosen: dict[int, str], chains: dict[int, Chain]
    ) -> list[tuple[int, int]]:
        """Returns the tasks that a goal takes, and the link of each with which it may come to hold."""
        tasks = [
            (row, 0 if row == self.seating.led else 1)
            for row, guest in enumerate(self.needs.guests)
            if row in chosen and goal in guest.ends
        ]
        for number, chain in chains.items():
            if goal in chain.ends:
                index = 0 if goal.kind == "ordered" else len(chain.links) - 1
                tasks.append((number, index))
        return tasks

    def cost(self, tour: Tour) -> int:
        """Returns the steps of a tour: walked, and deeds."""
        deeds = sum(stop.link.is_deed for stop in tour.stops)
        chairs = sum(
            self.seating.chairs[stop.link.table] < len(stop.party)
            for stop in tour.stops
            if stop.link.name == "seat"
        )
        return tour.walk() + deeds + chairs

    def improve(self, tour: Tour, least: int, rounds: int = 6) -> None:
        """Takes each task out and puts it back where it costs less, until nothing helps."""
        tour.settle()
        best = self.cost(tour)
        for _ in range(rounds):
            before = best
            for number in list(tour.tasks):
                if best <= least or self.clock.over():
                    return
                best = self.replaced(tour, [number], best, best - 1)
            if best == before:
                return

    def shake(self, tour: Tour, least: int, tries: int = 400) -> None:
        """Takes some tasks out and puts them back in another order, again and again."""
        from random import Random  # takes a while to import, and is rarely needed

        rng = Random(0)
        best = self.cost(tour)
        for _ in range(tries):
            if best <= least or self.clock.over():
                return
            numbers = list(tour.tasks)
            some = rng.sample(numbers, min(len(numbers), rng.choice((2, 2, 3, 4))))
            best = self.replaced(tour, some, best, best)

    def replaced(self, tour: Tour, numbers: list[int], cost: int, most: int) -> int:
        """Returns the cost once these tasks were taken out and put back; as it was above ``most``."""
        saved, tasks = list(tour.stops), dict(tour.tasks)
        seats = {s.task: s.link.table for s in tour.stops if s.link.name == "seat"}
        for number in numbers:
            tour.remove(number)
        for number in numbers:
            if tour.insert(self.loosened(tour, tasks[number], seats.get(number, ""))) is None:
                break
        else:
            tour.settle()
            least = self.cost(tour)
            self.clock.spend(tour.work)
            tour.work = 0
            if least <= most:
                return least
        tour.stops, tour.tasks = saved, tasks
        return cost

    def loosened(self, tour: Tour, task: Task, mine: str) -> Task:
        """Returns the same task; a party that may sit elsewhere than at ``mine`` may choose again."""
        if not task.party:
            return task
        row = task.number
        fixed = mine in self.needs.forced or self.seating.asks[row]
        taken = {stop.link.table for stop in tour.stops if stop.link.name == "seat"}
        chairs = {c.table for c in self.needs.chains if c.links[0].name == "bring_chairs"}
        if fixed or mine in chairs:
            return self.guest(row, {mine})
        return self.guest(row, (self.seating.allowed[row] | {mine}) - taken - chairs)


_NEED_SEATED = ("give_bill", "take_order")


def nodes_of(floor: WalkDistances, link: Link) -> tuple[int, ...]:
    """Returns the open nodes where a link can be done."""
    if link.node:
        return (floor.number[link.node],)
    if link.name in BAR_LINKS:
        return floor.bar
    return floor.nodes_of[link.table]
