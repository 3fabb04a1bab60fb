"""A whole flow → the walk that it describes → a plan, written out by what writes all plans.

Entry point `read_plan`.  Where every arc is walked a whole number of times and the walks hang
together, one walk goes over all of them (Hierholzer).  Its deeds, in their order, make a route, and
the rest is as for the routes of `waiter_cli.bounds`: parties put to tables, stops put in a row,
moved while that helps, written out and judged by the validator.
"""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.bounds.distances import Staff
from waiter_cli.bounds.insertion import Builder, nodes_of
from waiter_cli.bounds.relaxed_route import Route, RouteEvent
from waiter_cli.bounds.route_to_tour import Unfolder
from waiter_cli.bounds.seating import TableChoice
from waiter_cli.bounds.service_chains import BAR_LINKS
from waiter_cli.bounds.tour import Tour
from waiter_cli.bounds.tour_to_plan import write_plan
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.modes import Key
from waiter_cli.model.plan import Plan

__all__ = ["read_plan", "write_tour"]


def _walk(layers: Layers, values: Sequence[float]) -> list[int]:
    """Returns the columns of one walk over the arcs with flow, from the start, in order."""
    out: dict[int, list[int]] = {}
    for column, tail in enumerate(layers.tails):
        out.setdefault(tail, []).extend([column] * round(values[column]))
    stack: list[tuple[int, int]] = [(layers.start, -1)]
    walk: list[int] = []
    while stack:
        here, came = stack[-1]
        if out.get(here):
            column = out[here].pop()
            stack.append((layers.heads[column], column))
        else:
            stack.pop()
            if came >= 0:
                walk.append(came)
    return walk[::-1]


def _stops(layers: Layers, walk: Sequence[int]) -> list[tuple[Key, int]]:
    """Returns the deeds and the nodes passed, in order: (key, node), ("at",) for a node passed."""
    stops: list[tuple[Key, int]] = [(("at",), layers.places[layers.start][1])]
    for column in walk:
        key, head = layers.keys[column], layers.heads[column]
        if key[0] == "walk":
            stops.append((("at",), layers.places[head][1]))
        elif key[0] != "end":
            stops.append((key, layers.places[head][1]))
    return stops


class _Reader:
    """Says at which stop each link of each chain is done."""

    def __init__(self, builder: Builder, stops: list[tuple[Key, int]]) -> None:
        self.builder, self.stops = builder, stops
        self.used: set[int] = set()
        self.events: list[tuple[int, int, RouteEvent]] = []

    def route(self) -> Route:
        """Returns the route; a chain whose links cannot all be placed in order is left out."""
        seats: list[tuple[str, bool]] = []
        for at, (key, node) in enumerate(self.stops):
            if key[0] == "pick":
                self.events.append((at, 0, RouteEvent("pick", node)))
            elif key[0] in ("seat", "led"):
                name = str(key[1])
                self.events.append((at, 0, RouteEvent("seat", node, name)))
                seats.append((name, key[0] == "led"))
        sent = max((k for k, (key, _) in enumerate(self.stops) if key == ("send",)), default=-1)
        for number, chain in self.builder.chains({}).items():
            at, placed = -1, []
            for index, link in enumerate(chain.links):
                place = self.place(link.name, set(nodes_of(self.builder.floor, link)), at, sent)
                if place is None:
                    break
                at = place
                node = self.stops[at][1]
                placed.append((at, index + 1, RouteEvent(link.name, node, "", number, index)))
            else:
                self.events += placed
                self.used |= {at for at, _, event in placed if event.name in _HANDLING}
        events = tuple(event for _, _, event in sorted(self.events, key=lambda e: e[:2]))
        return Route(0, events, tuple(seats), 0, sum(e.name == "pick" for e in events), 0)

    def place(self, name: str, nodes: set[int], after: int, sent: int) -> int | None:
        """Returns the first stop from ``after`` on where a link can be done."""
        if name == "send_order" and sent > after and self.stops[sent][1] in nodes:
            return sent
        for at in range(max(after, 0), len(self.stops)):
            key, node = self.stops[at]
            if node not in nodes or at in self.used:
                continue
            if name in _HANDLING:
                if key[0] == name:
                    return at
            elif name == "fill" or name not in BAR_LINKS or key[0] in ("send", "at", "take_up"):
                return at
        return None


_HANDLING = ("take_up", "refill", "bring")


def read_plan(
    builder: Builder, staff: Staff, layers: Layers, values: Sequence[float], least: int
) -> Plan | None:
    """Returns the plan of a whole flow, None when it cannot be put in terms of a plan."""
    walk = _walk(layers, values)
    route = _Reader(builder, _stops(layers, walk)).route()
    tour = Unfolder(builder).realise(TableChoice(), route)
    return write_tour(builder, staff, tour, least) if tour is not None else None


def write_tour(builder: Builder, staff: Staff, tour: Tour, least: int) -> Plan | None:
    """Returns the plan of a tour, improved while it is longer than ``least`` and that helps."""
    builder.improve(tour, least)
    if builder.cost(tour) > least:
        builder.shake(tour, least)
    seating = builder.seating
    return write_plan(seating.problem, seating.floor, staff, tour.stops, builder.end)
