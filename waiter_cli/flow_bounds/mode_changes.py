"""Deeds that change each mode, and visits that count in it.

Entry point `ModeChanges`: `OrderedJobs`, the orders that modes tell apart → the first mode, the
deeds that are possible in each, and where being at a node may be what has to be done.
"""

from __future__ import annotations

from collections.abc import Iterator

from waiter_cli.flow_bounds.modes import (
    ALONE,
    ASKING,
    FETCHED,
    FREE,
    LED,
    SENDING,
    SENT,
    Deed,
    Mode,
    TakeUp,
)
from waiter_cli.flow_bounds.ordered_jobs import Carrying, Nodes, OrderedJobs

__all__ = ["ModeChanges"]


class ModeChanges:
    """The modes of one problem; ``take_ups`` and ``refills`` are alike jobs of the hands together."""

    def __init__(self, jobs: OrderedJobs, tracked: tuple[int, ...]) -> None:
        self.jobs, self.tracked = jobs, tracked
        taken = [order for order in jobs.orders if order.plate and (order.nodes or order.table)]
        self.asks = bool(taken) and all(order.nodes for order in taken)
        self.late_seats = {order.table for order in jobs.orders if order.table}
        self.fetched = [s for s in jobs.sittings if not s.led]
        self.nodes_of = dict(jobs.seats)
        self.take_ups: dict[TakeUp, list[Carrying]] = {}
        for carrying in jobs.carryings:
            if not carrying.empty and not carrying.held:
                self.take_ups.setdefault(self._sort(carrying), []).append(carrying)
        self.refills: dict[Nodes, int] = {}
        for carrying in jobs.carryings:
            if carrying.empty and not carrying.held:
                self.refills[carrying.target] = self.refills.get(carrying.target, 0) + 1

    def _sort(self, carrying: Carrying) -> TakeUp:
        """Returns the key of the deed of taking this up: alike are those that can be exchanged."""
        order = carrying.order
        asked = order >= 0 and bool(self.jobs.orders[order].nodes)
        which = order if order in self.tracked else -1
        return ("take_up", carrying.target, asked and self.asks, which)

    def first(self) -> Mode:
        """Returns the mode of step 0."""
        jobs = self.jobs
        phase = ASKING if self.asks else SENDING if jobs.orders else SENT
        led = any(sitting.led and sitting.least for sitting in jobs.sittings)
        hands = FREE
        for carrying in jobs.carryings:
            if carrying.held:
                hands = ("empty" if carrying.empty else "full", carrying.target)
        return Mode(phase, frozenset(), LED if led else ALONE, hands)

    def possible(self, mode: Mode) -> Iterator[Deed]:
        """Yields what can change this mode."""
        jobs = self.jobs
        kind, target = mode.hands
        if mode.phase == ASKING:
            plain = {n for k in self._untracked() for n in jobs.orders[k].nodes}
            if plain:
                yield Deed(("first",), tuple(sorted(plain)), mode.but(phase=SENDING))
        if mode.phase < SENT:
            for k in self.tracked:
                if k not in mode.taken:
                    after = mode.but(phase=SENDING, taken=mode.taken | {k})
                    yield Deed(("take", k), jobs.orders[k].nodes, after)
        if mode.phase == SENDING and len(mode.taken) == len(self.tracked):
            yield Deed(("send",), jobs.bar, mode.but(phase=SENT))
        if kind == "free":
            for nodes in self.refills:
                yield Deed(("refill", nodes), nodes, mode.but(hands=("empty", nodes)))
            for key in self.take_ups:
                _, nodes, asked, which = key
                if not (asked and mode.phase == ASKING) and (which == -1 or which in mode.taken):
                    yield Deed(key, jobs.bar, mode.but(hands=("full", nodes)))
        elif kind == "empty":
            yield Deed(("fill", target), jobs.bar, mode.but(hands=("full", target)))
        else:
            yield Deed(("bring", target), target, mode.but(hands=FREE))
        if mode.lead == ALONE:
            if self.fetched:
                yield Deed(("pick",), (jobs.door,), mode.but(lead=FETCHED))
            return
        parties = [s for s in jobs.sittings if s.led == (mode.lead == LED)]
        kind = "led" if mode.lead == LED else "seat"
        for name in dict.fromkeys(name for s in parties for name, _ in s.costs):
            if name in self.nodes_of and not (name in self.late_seats and mode.phase == SENT):
                yield Deed((kind, name), self.nodes_of[name], mode.but(lead=ALONE))

    def _untracked(self) -> list[int]:
        """Returns the orders of plates that are still to be taken and not told apart."""
        orders = self.jobs.orders
        return [k for k, o in enumerate(orders) if o.plate and o.nodes and k not in self.tracked]

    def counts(self, order: int, mode: Mode) -> bool:
        """Returns whether being at a node of an (untracked) order in this mode may be taking it."""
        found = self.jobs.orders[order]
        if mode.phase == SENT or (found.plate and self.asks and mode.phase == ASKING):
            return False
        return not (found.plate and mode.hands == ("full", self._only(order)))

    def _only(self, order: int) -> Nodes:
        """Returns where the plate of an order is carried, if nothing else is carried there full."""
        carryings = self.jobs.carryings
        target = next(c.target for c in carryings if c.order == order)
        return target if sum(c.target == target for c in carryings) == 1 else ()

    def seen_in(self, mode: Mode) -> Iterator[int]:
        """Yields the nodes where a visit counts in this mode."""
        for nodes in self.jobs.visits:
            yield from nodes
        for k, order in enumerate(self.jobs.orders):
            if k not in self.tracked and order.nodes and self.counts(k, mode):
                yield from order.nodes
