"""`Route` → `Tour`: a route of the relaxation put in terms of parties and tables.

Entry point `Unfolder.realise`; `Unfolder.plain` is the way without a route, by insertion alone.
"""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.bounds.insertion import Builder
from waiter_cli.bounds.relaxed_route import Route
from waiter_cli.bounds.seating import TableChoice
from waiter_cli.bounds.service_chains import Link
from waiter_cli.bounds.tour import Tour, TourStop

__all__ = ["Unfolder"]


class Unfolder:
    """Makes tours of one problem's routes; none of them knows an order of goals, `plain` does."""

    def __init__(self, builder: Builder) -> None:
        self.builder, self.seating, self.floor = builder, builder.seating, builder.floor

    def seats(self, choice: TableChoice) -> dict[int, str] | None:
        """Returns the table of each party when tables are chosen so."""
        solved = self.seating.solve(choice)
        if solved is None:
            return None
        return {
            row: self.seating.tables[column].name
            for row, column in enumerate(solved.column)
            if column < len(self.seating.tables)
        }

    def plain(self, choice: TableChoice) -> Tour | None:
        """Returns a tour by insertion alone."""
        chosen = self.seats(choice)
        return self.builder.build(chosen) if chosen is not None else None

    def realise(self, choice: TableChoice, route: Route) -> Tour | None:
        """Returns the route as a tour: parties put to its tables, what it left out put in.

        Where it uses a table again, another party is led to its own table instead.
        """
        if self.seating.problem.before:  # which no route looks at
            return self.plain(choice)
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
                tour.stops.append(TourStop(task.links[event.index], event.node, nodes, event.task))
        tour.tasks = {stop.task: tasks[stop.task] for stop in tour.stops}
        if not chosen.keys() <= tour.tasks.keys():
            return self.plain(choice)
        for number, task in list(tour.tasks.items()):
            if sum(stop.task == number for stop in tour.stops) < len(task.links):
                tour.remove(number)
        return self.builder.add_chains(tour, chosen)

    def _loops(self, route: Route, chosen: dict[int, str]) -> tuple[dict[int, int], list[int]]:
        """Returns the party of each seat and its pick (by their place in the route),
        and the others.
        """
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
        tour.stops.append(TourStop(Link("pick", "", party[0]), door, (door,), row, party))

    def _seat(self, tour: Tour, row: int, table: str, node: int | None) -> None:
        party, nodes = self.seating.parties[row], self.floor.nodes_of[table]
        if node is None:
            node = min(nodes, key=lambda n: self.seating.loop(row, n))
        tour.stops.append(TourStop(Link("seat", table, party[0]), node, nodes, row, party))

    def _lead(self, tour: Tour, row: int, table: str) -> None:
        """Adds a loop in which nothing else happens."""
        if row != self.seating.led:
            self._pick(tour, row)
        self._seat(tour, row, table, None)
