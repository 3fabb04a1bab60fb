"""Lets guests behave as was drawn for them, and as they are served.

Entry point `Evening`.  A party comes in, waits, sits, orders, eats, wants its bill, pays and leaves; where
there is no bar it eats without having ordered.  It leaves before that where its patience ends.
Times are seconds since the beginning.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import dataclass

from waiter_cli.evenings.draws import Visit, refill_times, visits
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Observation, Party, State

__all__ = ["Evening", "Stay"]


@dataclass
class Stay:
    """Notes of a party: the second at which each thing happened, None where it did not.

    ``lost`` is ``unseated`` or ``unserved`` where the party's patience ended.
    """

    visit: Visit
    party: Party
    arrived: float
    picked: float | None = None
    seated: float | None = None
    table: str | None = None
    hungry: float | None = None
    taken: float | None = None
    sent: float | None = None
    served: float | None = None
    calls: float | None = None
    paid: float | None = None
    left: float | None = None
    lost: str | None = None


class Evening:
    """The guests of an evening.  ``stays`` lists the parties that have come, in that order.

    ``look`` is to be called whenever the restaurant has changed, ``due`` when time has passed.
    """

    def __init__(
        self,
        model: GuestModel,
        seed: int,
        layout: Layout,
        names: Iterator[str],
        *,
        instant_kitchen: bool = False,
    ) -> None:
        self.stays: list[Stay] = []
        self._model, self._seed, self._names = model, seed, names
        self._kitchen = layout.bar is not None and "plate" in layout.objects
        self._jugs = layout.bar is not None and "jug" in layout.objects
        self._instant = instant_kitchen
        self._visits = visits(model, seed)
        self._heap: list[tuple[float, int, str, int]] = []
        self._order = 0
        self._emptied: dict[int, Iterator[float]] = {}
        self._inside: dict[int, Stay] = {}
        self._state: State | None = None
        self._next_visit()

    @property
    def next_time(self) -> float | None:
        """The time at which something happens next by itself; None where nothing does."""
        heap = self._heap
        while heap and heap[0][2] != "enter" and self.stays[heap[0][3]].left is not None:
            heapq.heappop(heap)  # of a party that has left
        return heap[0][0] if heap else None

    def due(self, time: float) -> Iterator[Observation]:
        """Yields what guests and kitchen do until ``time``, one at a time.

        Each is to have happened before the next one is asked for.
        """
        while self._heap and self._heap[0][0] <= time + 1e-9:
            at, _, what, number = heapq.heappop(self._heap)
            seen = self._enter(at) if what == "enter" else self._act(what, self.stays[number], at)
            if seen is not None:
                yield seen

    def look(self, state: State, time: float) -> None:
        """Notes what has changed for the parties inside, and what they will do in consequence."""
        self._state = state
        tables = {party: table for table, party in state.seated}
        for stay in list(self._inside.values()):
            table = tables.get(stay.party)
            if table is None:
                self._look_standing(stay, state, time)
            else:
                if stay.seated is None:
                    self._sit(stay, table, time)
                self._look_seated(stay, table, state, time)

    # ------------------------------------------------------------ what is seen of a party

    def _look_standing(self, stay: Stay, state: State, time: float) -> None:
        if stay.party in state.led():
            stay.picked = time if stay.picked is None else stay.picked
        elif stay.party not in state.waiting:
            self._leave(stay, time)

    def _sit(self, stay: Stay, table: str, time: float) -> None:
        stay.seated, stay.table = time, table
        visit = stay.visit
        if self._kitchen:
            self._plan(time + visit.order_after, "order", stay)
        else:
            self._plan(time + visit.eat + visit.bill_after, "bill", stay)
        if self._jugs:
            self._emptied[visit.number] = refill_times(self._model, visit, self._seed)
            self._plan_refill(stay)

    def _look_seated(self, stay: Stay, table: str, state: State, time: float) -> None:
        ordered, sent = table in state.held_orders(), table in state.sent
        if stay.hungry is not None and stay.taken is None and (ordered or sent):
            stay.taken = time
        if stay.taken is not None and stay.sent is None and sent:
            stay.sent = time
            if not self._instant:
                self._plan(time + stay.visit.cook, "ready", stay)
        if stay.sent is not None and stay.served is None and table in state.served:
            stay.served = time
            self._plan(time + stay.visit.eat + stay.visit.bill_after, "bill", stay)
        if stay.calls is not None and stay.paid is None and table in state.paid:
            stay.paid = time
            self._plan(time, "leave", stay)

    # ------------------------------------------------------------ what a party does

    def _enter(self, time: float) -> Observation:
        visit = self._visit
        party = tuple(next(self._names) for _ in range(visit.heads))
        stay = Stay(visit, party, time)
        self.stays.append(stay)
        self._inside[visit.number] = stay
        if self._model.patience is not None:
            self._plan(time + 60.0 * self._model.patience, "unseated", stay)
        self._next_visit()
        return Observation("enter", party)

    def _act(self, what: str, stay: Stay, time: float) -> Observation | None:
        """Returns what a party, or the kitchen for it, does now; None where that is out of date."""
        table = stay.table or ""
        if stay.left is not None:
            return None
        match what:
            case "unseated" if stay.picked is None and stay.seated is None:
                return self._give_up(stay, time, what)
            case "unserved" if stay.served is None:
                return self._give_up(stay, time, what)
            case "order":
                stay.hungry = time
                if self._model.patience_served is not None:
                    self._plan(time + 60.0 * self._model.patience_served, "unserved", stay)
                return Observation("order", (table,))
            case "ready":
                return Observation("ready", (table, "plate"))
            case "bill":
                stay.calls = time
                return Observation("bill", (table,))
            case "empty":
                self._plan_refill(stay)
                return None if self._jug_is_away(table) else Observation("empty", (table, "jug"))
            case "leave":
                self._leave(stay, time)
                return Observation("leave", (stay.party[0],))
        return None

    def _give_up(self, stay: Stay, time: float, why: str) -> Observation:
        stay.lost = why
        self._leave(stay, time)
        return Observation("leave", (stay.party[0],))

    def _leave(self, stay: Stay, time: float) -> None:
        stay.left = time
        self._inside.pop(stay.visit.number, None)

    def _jug_is_away(self, table: str) -> bool:
        """Returns whether the table's jug is empty already, or in the robot's hands, or at the bar."""
        state, jug = self._state, (table, "jug")
        return state is None or jug in state.empty or jug in state.ready or jug in state.carried()

    def _plan_refill(self, stay: Stay) -> None:
        after = next(self._emptied[stay.visit.number], None)
        if after is not None and stay.seated is not None:
            self._plan(stay.seated + after, "empty", stay)

    def _plan(self, time: float, what: str, stay: Stay) -> None:
        self._order += 1
        heapq.heappush(self._heap, (time, self._order, what, stay.visit.number))

    def _next_visit(self) -> None:
        visit = next(self._visits, None)
        if visit is not None:
            self._visit = visit
            self._order += 1
            heapq.heappush(self._heap, (visit.arrives, self._order, "enter", visit.number))
