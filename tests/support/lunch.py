"""A lunch by chance, and what is true in it: a small restaurant that knows nothing of the planner.

`Lunch.next_line` makes up what happens next; `Lunch.play` follows a plan.  The state is kept in
plain dictionaries, by the table of actions alone, so that agreement with what the loop believes
means something.
"""

from __future__ import annotations

import copy
from random import Random
from typing import Any

from waiter_cli.model.layout import Layout


class Lunch:
    """The true state of one restaurant, changed by events and by actions."""

    def __init__(self, layout: Layout, seed: int) -> None:
        self.layout = layout
        self.random = Random(seed)
        self.near = layout.neighbours()
        self.seats = {table.name: table.capacity for table in layout.tables}
        self.chairs = {table.name: table.chairs for table in layout.tables}
        self.places: dict[str, str] = {"agent": layout.agent, **dict(layout.waiters)}
        self.waiting: list[list[str]] = []
        self.led: list[str] = []
        self.seated: dict[str, list[str]] = {}
        self.marks: dict[str, set[str]] = {
            key: set()
            for key in ("wants_bill", "paid", "ready_to_order", "taken", "sent", "served")
        }
        self.ready: set[tuple[str, str]] = set()
        self.empty: set[tuple[str, str]] = set()
        self.load: tuple[str, str] | None = None
        self.guests = 0
        self.running: dict[str, Any] | None = None
        self.step = 0

    # -- what happens -----------------------------------------------------------------------

    def next_line(self, plan: list[dict[str, Any]]) -> dict[str, Any]:
        """The next event, a step of ``plan`` as often as not; it is true from now on."""
        if self.running is not None:
            if self.random.random() < 0.6:
                return self._finish(self.running)
        elif plan and self.random.random() < 0.2:
            self.running = plan[0]
            return {"started": self.step}
        elif plan and self.random.random() < 0.6:
            if self.random.random() < 0.05:
                self.step += 1
                return {"failed": self.step - 1, "reason": "slipped"}
            self.play(plan[0]["name"], [str(arg) for arg in plan[0]["args"]])
            self.step += 1
            return {"done": self.step - 1}
        makers = [self._enter, self._bill, self._leave, self._move]
        if self.layout.bar is not None:
            makers += [self._order, self._ready, self._empty]
        while True:
            seen = self.random.choice(makers)()
            if seen is not None:
                return {"observe": seen}

    def _finish(self, action: dict[str, Any]) -> dict[str, Any]:
        """The end of a running action; it fails when something has come between."""
        self.running = None
        self.step += 1
        arguments = [str(arg) for arg in action["args"]]
        try:
            copy.deepcopy(self).play(action["name"], arguments)
        except (AssertionError, KeyError, StopIteration):
            return {"failed": self.step - 1}
        self.play(action["name"], arguments)
        return {"done": self.step - 1}

    def _enter(self) -> dict[str, Any] | None:
        if len(self.waiting) > 2:
            return None
        size = self.random.randint(1, max(self.seats.values()))
        names = [f"c{self.guests + index}" for index in range(1, size + 1)]
        self.guests += size
        self.waiting.append(names)
        return {"enter": names}

    def _bill(self) -> dict[str, Any] | None:
        table = self._pick(self.seated)
        if table is None or table in self.marks["wants_bill"]:
            return None
        self.marks["wants_bill"].add(table)
        self.marks["paid"].discard(table)
        return {"bill": table}

    def _leave(self) -> dict[str, Any] | None:
        table = self._pick(self.marks["paid"])
        if table is None:
            if not self.waiting or self.random.random() < 0.9:
                return None
            return {"leave": self.waiting.pop(self.random.randrange(len(self.waiting)))}
        party = self.seated.pop(table)
        for marked in self.marks.values():
            marked.discard(table)
        self.ready = {pair for pair in self.ready if pair[0] != table}
        if self.load == (table, "plate"):
            self.load = None
        return {"leave": [self.random.choice(party)]}

    def _move(self) -> dict[str, Any] | None:
        waiter = self._pick(name for name in self.places if name != "agent")
        if waiter is None:
            return None
        free = [n for n in self.near[self.places[waiter]] if n not in self.places.values()]
        if not free:
            return None
        self.places[waiter] = self.random.choice(free)
        return {"at": {waiter: self.places[waiter]}}

    def _order(self) -> dict[str, Any] | None:
        table = self._pick(self.seated)
        if table is None:
            return None
        self.marks["ready_to_order"].add(table)
        return {"order": table}

    def _ready(self) -> dict[str, Any] | None:
        table = self._pick(self.marks["sent"] - self.marks["served"])
        if table is None or (table, "plate") in self.ready or self.load == (table, "plate"):
            return None
        self.ready.add((table, "plate"))
        return {"ready": {table: "plate"}}

    def _empty(self) -> dict[str, Any] | None:
        table = self._pick(self.seats)
        item = self.random.choice(["jug", "basket"])
        if table is None or self.load == (table, item):
            return None
        self.empty.add((table, item))
        return {"empty": {table: item}}

    def _pick(self, names: Any) -> str | None:
        found = sorted(names)
        return self.random.choice(found) if found else None

    # -- what the robot does ----------------------------------------------------------------

    def play(self, name: str, arguments: list[str]) -> None:
        """Does one action; an impossible one is an error of the test."""
        here = self.places["agent"]
        tables = {table.name: table.nodes for table in self.layout.tables}
        last = arguments[1] if name == "bring_chairs" else arguments[-1]
        if last in tables and name not in ("send_order", "take_up"):
            assert here in tables[last], (name, arguments, here)
        at_bar = self.layout.bar is not None and here in self.layout.bar.nodes
        match name:
            case "go_to":
                assert last in self.near[here] and last not in self.places.values()
                self.places["agent"] = last
                if self.layout.bar is not None and last in self.layout.bar.nodes and self.load:
                    self.empty.discard(self.load)
            case "pick":
                assert here == self.layout.entrance and not self.led
                self.led = next(party for party in self.waiting if last in party)
                self.waiting.remove(self.led)
                assert len(self.seated) < len(tables)
            case "seat":
                assert arguments[1] in self.led and len(self.led) <= min(
                    self.seats[last], self.chairs[last]
                )
                assert last not in self.seated
                self.seated[last], self.led = self.led, []
            case "bring_chairs":
                assert self.chairs[last] < int(arguments[2]) <= self.seats[last]
                self.chairs[last] = int(arguments[2])
            case "give_bill":
                assert last in self.seated
                self.marks["wants_bill"].remove(last)
                self.marks["paid"].add(last)
            case "take_order":
                self.marks["ready_to_order"].remove(last)
                self.marks["taken"].add(last)
                self.marks["sent"].discard(last)
                self.marks["served"].discard(last)
            case "send_order":
                assert at_bar
                self.marks["taken"].remove(last)
                self.marks["sent"].add(last)
            case "take_up":
                assert at_bar and self.load is None
                self.load = (last, arguments[1])
                self.ready.remove(self.load)
            case "bring":
                assert self.load == (last, arguments[1]) and self.load not in self.empty
                self.load = None
                if arguments[1] == "plate":
                    self.marks["served"].add(last)
            case "refill":
                assert self.load is None and (last, arguments[1]) in self.empty
                self.load = (last, arguments[1])
                if at_bar:
                    self.empty.discard(self.load)
            case _:
                raise AssertionError(name)

    # -- what is true -----------------------------------------------------------------------

    def state(self) -> dict[str, Any]:
        """The true state in the shape of a scenario's ``state``."""
        tables = [table.name for table in self.layout.tables]

        def listed(found: set[str]) -> list[str]:
            return [table for table in tables if table in found]

        def things(found: Any) -> dict[str, Any]:
            out: dict[str, Any] = {}
            for table in tables:
                items = sorted(item for name, item in found if name == table)
                if items:
                    out[table] = items[0] if len(items) == 1 else items
            return out

        found = {
            "agent": self.places["agent"],
            "waiters": {who: node for who, node in sorted(self.places.items()) if who != "agent"},
            "seated": {table: self.seated[table] for table in tables if table in self.seated},
            "waiting": self.waiting,
            "with_agent": self.led,
            "wants_bill": listed(self.marks["wants_bill"]),
            "paid": listed(self.marks["paid"]),
            "ready_to_order": listed(self.marks["ready_to_order"]),
            "ordered": listed(self.marks["taken"] | self.marks["sent"]),
            "sent": listed(self.marks["sent"]),
            "served": listed(self.marks["served"]),
            "ready": things(self.ready),
            "carrying": things([self.load] if self.load else []),
            "empty": things(self.empty),
            "chairs": self.chairs if self._few_chairs() else {},
        }
        return {key: value for key, value in found.items() if value}

    def _few_chairs(self) -> bool:
        """Whether chairs are worth a word: some table lacks them, or has others than at first."""
        return any(
            self.chairs[table.name] != table.chairs or table.chairs < table.capacity
            for table in self.layout.tables
        )
