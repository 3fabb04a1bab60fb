"""A lunch by chance: events of a restaurant whose truth is a `World` that no planner shares.

`Lunch.next_line` makes up what happens next; `Lunch.state` is what is then true, in the shape of a
scenario's ``state``.
"""

from __future__ import annotations

from collections.abc import Iterable
from random import Random
from typing import Any

from waiter_cli.files.documents import state_document
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Observation, State
from waiter_cli.simulation.world import World


class Lunch:
    """One restaurant, changed by events and by actions."""

    def __init__(self, layout: Layout, seed: int) -> None:
        chairs = tuple((table.name, table.chairs) for table in layout.tables)
        self.layout = layout
        self.random = Random(seed)
        self.world = World(layout, State(layout.agent, layout.waiters, chairs=chairs))
        self.guests = 0
        self.running: Action | None = None
        self.step = 0

    def state(self) -> dict[str, Any]:
        """What is true now."""
        return state_document(self.world.state(), self.layout)

    def next_line(self, plan: list[dict[str, Any]]) -> dict[str, Any]:
        """The next event, a step of ``plan`` as often as not; it is true from now on."""
        if self.running is not None:
            if self.random.random() < 0.6:
                return self._finish(self.running)
        elif plan and self.random.random() < 0.2:
            self.running = self._action(plan[0])
            return {"started": self.step}
        elif plan and self.random.random() < 0.6:
            self.step += 1
            if self.random.random() < 0.05:
                return {"failed": self.step - 1, "reason": "slipped"}
            action = self._action(plan[0])
            assert self.world.breach(action) is None, action
            self.world.perform(action)
            return {"done": self.step - 1}
        makers = [self._enter, self._bill, self._leave, self._move]
        if self.layout.bar is not None:
            makers += [self._order, self._ready, self._empty]
        while True:
            made = self.random.choice(makers)()
            if made is not None:
                seen, told = made
                assert self.world.suffer(seen) is None, seen
                return {"observe": told}

    def _action(self, step: dict[str, Any]) -> Action:
        return Action(self.step, step["name"], tuple(str(arg) for arg in step["args"]))

    def _finish(self, action: Action) -> dict[str, Any]:
        """The end of a running action; it fails when something has come between."""
        self.running = None
        self.step += 1
        if self.world.breach(action) is not None:
            return {"failed": self.step - 1}
        self.world.perform(action)
        return {"done": self.step - 1}

    # -- what may happen: an observation, and how it is told; None where it cannot be now --------

    def _enter(self) -> tuple[Observation, Any] | None:
        if len(self.world.queue) > 2:
            return None
        size = self.random.randint(1, max(table.capacity for table in self.layout.tables))
        names = [f"c{self.guests + index}" for index in range(1, size + 1)]
        self.guests += size
        return Observation("enter", tuple(names)), {"enter": names}

    def _bill(self) -> tuple[Observation, Any] | None:
        tables = self.world.tables.items()
        return self._at_table("bill", (n for n, p in tables if p.party and not p.wants_bill))

    def _leave(self) -> tuple[Observation, Any] | None:
        going = [place.party for place in self.world.tables.values() if place.paid and place.party]
        if going:
            who = self.random.choice(self.random.choice(going))
            return Observation("leave", (who,)), {"leave": [who]}
        if not self.world.queue or self.random.random() < 0.9:
            return None
        party = self.random.choice(self.world.queue)
        return Observation("leave", party), {"leave": list(party)}

    def _move(self) -> tuple[Observation, Any] | None:
        staff = self.world.staff
        who = self._pick(staff)
        if who is None:
            return None
        to = self._pick(self.world.near[staff[who]] - {*staff.values(), self.world.robot})
        return None if to is None else (Observation("at", (who, to)), {"at": {who: to}})

    def _order(self) -> tuple[Observation, Any] | None:
        return self._at_table("order", (n for n, p in self.world.tables.items() if p.party))

    def _ready(self) -> tuple[Observation, Any] | None:
        cooking = {n for n, p in self.world.tables.items() if p.order == "sent" and not p.served}
        table = self._pick(cooking - {table for table, _ in self._plates()})
        if table is None:
            return None
        return Observation("ready", (table, "plate")), {"ready": {table: "plate"}}

    def _plates(self) -> set[tuple[str, str]]:
        load = self.world.load
        return {thing for thing in (*self.world.counter, load) if thing and thing[1] == "plate"}

    def _empty(self) -> tuple[Observation, Any] | None:
        thing = (self.random.choice(list(self.world.tables)), self.random.choice(("jug", "basket")))
        if self.world.load == thing:
            return None
        return Observation("empty", thing), {"empty": dict([thing])}

    def _at_table(self, kind: str, tables: Iterable[str]) -> tuple[Observation, Any] | None:
        table = self._pick(tables)
        return None if table is None else (Observation(kind, (table,)), {kind: table})

    def _pick(self, names: Iterable[str]) -> str | None:
        found = sorted(names)
        return self.random.choice(found) if found else None
