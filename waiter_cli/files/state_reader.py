"""A scenario's `state` (or a plan's `initial_state`) → `State`. Entry point `read_state`.

What a state leaves out falls back on the layout.  A state that is impossible in itself (a customer
twice, a party that does not fit, two employees on one node) is a fault with its place.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from waiter_cli.errors import Where
from waiter_cli.files.fleet_reader import FleetReader
from waiter_cli.files.names import Names, read_table_objects, stocked
from waiter_cli.files.own_terms import read_terms
from waiter_cli.model.layout import REFILLABLES, Layout
from waiter_cli.model.state import Party, Robot, State
from waiter_cli.model.timetable import clashes, places_at
from waiter_cli.yaml_reading.node_reader import NodeReader, is_empty
from waiter_cli.yaml_reading.yaml_tree import Node, Scalar

__all__ = ["STATE_KEYS", "read_state", "state_of_layout"]

STATE_KEYS = (
    "agent",
    "agents",
    "waiters",
    "seated",
    "waiting",
    "with_agent",
    "wants_bill",
    "paid",
    "ready_to_order",
    "ordered",
    "sent",
    "served",
    "ready",
    "carrying",
    "empty",
    "chairs",
    "fluents",
)
TABLE_SETS = ("wants_bill", "paid", "ready_to_order", "ordered", "sent", "served")
BAR_KEYS = ("ready_to_order", "ordered", "sent", "served", "ready", "carrying", "empty")


def state_of_layout(layout: Layout) -> tuple[State, dict[str, Where]]:
    """Returns the state of an empty restaurant, and where the layout says so."""
    state = State(
        agent="" if layout.agents else layout.agent,
        robots=tuple(Robot(name, at) for name, at in layout.agents),
        waiters=tuple(sorted(places_at(dict(layout.waiters), layout.timetable, 0).items())),
        chairs=tuple(sorted((table.name, table.chairs) for table in layout.tables)),
    )
    places = {
        key: where
        for key, where in layout.key_where
        if key in ("agent", "agents", "waiters") or key.startswith(("agents.", "waiters."))
    }
    for table in layout.tables:
        if table.where is not None:
            places[f"chairs.{table.name}"] = table.where
    return state, places


def read_state(
    reader: NodeReader, node: Node | None, names: Names, moved: Collection[str] = ()
) -> tuple[State, dict[str, Where]]:
    """Returns the state, completed from the layout, and the places of what it says.

    Places are kept under the keys that the file has, and under ``waiters.w1``, ``party.c1`` (the
    first-listed member), ``wants_bill.table1`` (and likewise for every set of tables),
    ``ready.table1.plate`` (and ``empty``, ``carrying``), ``chairs.table1`` and
    ``fluents.isdirty(table1)``.  Employees in
    ``moved`` are seen elsewhere, so the place that the layout gives them may be taken.
    """
    base, places = state_of_layout(names.layout)
    if node is None:
        return base, places
    keys = reader.mapping(node, "state", STATE_KEYS)
    if keys is None:
        return base, places
    return _StateReader(reader, names, keys, places).read(base, moved)


class _StateReader:
    def __init__(
        self, reader: NodeReader, names: Names, keys: dict[str, Node], places: dict[str, Where]
    ) -> None:
        self.reader = reader
        self.names = names
        self.keys = keys
        self.places = places
        self.inside: dict[str, Where] = {}
        self.told: set[str] = set()

    def read(self, base: State, moved: Collection[str]) -> tuple[State, dict[str, Where]]:
        for key in BAR_KEYS:
            node = self.keys.get(key)
            if node is not None and not is_empty(node):
                stocked(self.reader, self.names.layout, node.where, key)
        self.places.update((key, node.where) for key, node in self.keys.items())
        fleet = FleetReader(self.reader, self.names, self.keys, self.places, self.told)
        fleet.require_forms()
        agent = self._agent() or base.agent
        robots = fleet.stations(base)
        waiters = self._waiters(base)
        self._check_places(agent, robots, waiters, moved)
        chairs = self._chairs(base)
        seated = self._seated(dict(chairs))
        several = bool(robots)
        sets = {k: self._tables(k) for k in TABLE_SETS if not (several and k == "ordered")}
        sets.setdefault("ordered", frozenset())
        pairs = {
            "ready": self._pairs("ready", self.names.layout.objects),
            "empty": self._pairs("empty", REFILLABLES),
            "carrying": self._pairs("carrying", self.names.layout.objects) if not several else (),
        }
        loads = fleet.carrying() if several else {}
        plates = tuple(load for load in loads.values() if load[1] == "plate")
        kitchen = _kitchen(sets, pairs | {"carrying": pairs["carrying"] + plates})
        led = fleet.parties(self._party) if several else {}
        held = fleet.orders(kitchen["sent"]) if several else {}
        state = State(
            agent=agent,
            robots=tuple(
                Robot(name, at, led.get(name, ()), loads.get(name), held.get(name, frozenset()))
                for name, at in robots
            ),
            waiters=waiters,
            seated=seated,
            with_agent=() if several else self._with_agent(),
            waiting=self._waiting(),
            chairs=chairs,
            ready=frozenset(pairs["ready"]),
            empty=frozenset(pairs["empty"]),
            carrying=self._carried(pairs["carrying"]),
            fluents=self._fluents(),
            **kitchen,
        )
        self._check_tables(state)
        return state, self.places

    # -- staff ------------------------------------------------------------------------------

    def _agent(self) -> str | None:
        node = self.keys.get("agent")
        if node is None:
            return None
        self.told.add("agent")
        return self.reader.known(node, "agent", "node", self.names.nodes)

    def _waiters(self, base: State) -> tuple[tuple[str, str], ...]:
        waiters = dict(base.waiters)
        node = self.keys.get("waiters")
        for key, value in self.reader.entries(node, "waiters") or () if node else ():
            name = self.names.declare(self.reader, key, "waiter")
            at = self.reader.known(value, f"the place of {key.text}", "node", self.names.nodes)
            if name is not None and at is not None:
                waiters[name] = at
                self.places[f"waiters.{name}"] = key.where
                self.told.add(name)
        return tuple(sorted(waiters.items()))

    def _check_places(
        self,
        agent: str,
        robots: tuple[tuple[str, str], ...],
        waiters: tuple[tuple[str, str], ...],
        moved: Collection[str],
    ) -> None:
        on_node: dict[str, str] = {}
        for name, at in (*(robots or (("agent", agent),)), *waiters):
            other = on_node.setdefault(at, name)
            pair = {name, other}
            if other == name or not pair & self.told:
                continue
            if pair & set(moved) - self.told:
                continue
            blamed = name if name in self.told else other
            key = "agent" if blamed == "agent" else f"waiters.{blamed}"
            key = f"agents.{blamed}" if blamed in self.names.robots else key
            message = f"{name} and {'the agent' if other == 'agent' else other} both stand on {at}"
            hint = "give each a node of its own; whom the state leaves out stands where the layout says"
            self.reader.fault(self.places[key], message, hint)
        start = dict(waiters)
        for clash in clashes(start, self.names.layout.timetable):
            pair = {clash.first, clash.second} & self.told
            if clash.entry is not None and pair and not {clash.first, clash.second} & set(moved):
                message = f"{clash.first} and {clash.second} would both stand on {clash.node}"
                hint = f"the timetable has it so from step {clash.step} on"
                self.reader.fault(self.places[f"waiters.{min(pair)}"], message, hint)
        for name, at in places_at(start, self.names.layout.timetable, 0).items():
            if name in self.told and at != start[name]:
                message = f"{name} stands on {start[name]}, the timetable has him on {at} at step 0"
                self.reader.fault(self.places[f"waiters.{name}"], message, "change one of the two")

    # -- customers --------------------------------------------------------------------------

    def _party(self, node: Node, what: str) -> Party:
        members = self.names.party(self.reader, node, what)
        for name, where in members:
            first = self.inside.setdefault(name, where)
            if first is not where:
                message = f"{name} is in two places: {what}, and at line {first.line} already"
                self.reader.fault(where, message, "a customer is in one place only")
        party = tuple(name for name, _ in members)
        if party:
            self.places[f"party.{party[0]}"] = node.where
        return party

    def _seated(self, chairs: dict[str, int]) -> tuple[tuple[str, Party], ...]:
        parties: dict[str, Party] = {}
        capacities = {table.name: table.capacity for table in self.names.layout.tables}
        node = self.keys.get("seated")
        for key, value in self.reader.entries(node, "seated") or () if node else ():
            table = self.reader.known(key, "seated", "table", self.names.tables)
            party = self._party(value, f"the party at {key.text}")
            if not party or table is None:
                continue
            parties[table] = party
            size = len(party)
            if size > capacities[table]:
                message = f"{size} sit at {table}, which has room for {capacities[table]}"
                self.reader.fault(key.where, message, "seat fewer there")
            elif size > chairs[table]:
                message = f"{size} sit at {table}, which has {_count(chairs[table], 'chair')}"
                self.reader.fault(key.where, message, f"add chairs: {{{table}: {size}}}")
        return tuple(sorted(parties.items()))

    def _waiting(self) -> tuple[Party, ...]:
        node = self.keys.get("waiting")
        hint = "a list of parties, each a list of customers: [[c1, c2], [c3]]"
        parties: list[Party] = []
        for item in self.reader.items(node, "waiting", hint) or () if node else ():
            if isinstance(item, Scalar):
                self.reader.wrong(item, "a party that waits", "a list of customers", hint)
                continue
            party = self._party(item, "waiting at the entrance")
            if party:
                parties.append(party)
            elif is_empty(item):
                self.reader.fault(item.where, "a party of nobody waits", "leave it out")
        return tuple(parties)

    def _with_agent(self) -> Party:
        node = self.keys.get("with_agent")
        return () if node is None else self._party(node, "the party with the agent")

    # -- tables -----------------------------------------------------------------------------

    def _tables(self, key: str) -> frozenset[str]:
        node = self.keys.get(key)
        if node is None:
            return frozenset()
        tables = self.reader.known_names(node, key, "table", self.names.tables)
        for table, where in tables:
            self.places[f"{key}.{table}"] = where
        return frozenset(table for table, _ in tables)

    def _pairs(self, key: str, kinds: Collection[str]) -> tuple[tuple[str, str], ...]:
        node = self.keys.get(key)
        if node is None or self.names.layout.bar is None:
            return ()
        pairs = read_table_objects(self.reader, self.names, node, key, kinds)
        for table, item, where in pairs:
            self.places[f"{key}.{table}.{item}"] = where
        return tuple((table, item) for table, item, _ in pairs)

    def _carried(self, pairs: tuple[tuple[str, str], ...]) -> tuple[str, str] | None:
        if len(pairs) > 1:
            where = self.places[".".join(("carrying", *pairs[1]))]
            self.reader.fault(where, "the robot carries two things", "its hands hold one")
        return pairs[0] if pairs else None

    def _fluents(self) -> tuple[str, ...]:
        node = self.keys.get("fluents")
        if node is None:
            return ()
        fluents = read_terms(self.reader, node, "a fluent", "isdirty(table1)")
        self.places.update((f"fluents.{term}", where) for term, where in fluents)
        return tuple(sorted(term for term, _ in fluents))

    def _chairs(self, base: State) -> tuple[tuple[str, int], ...]:
        chairs = dict(base.chairs)
        capacities = {table.name: table.capacity for table in self.names.layout.tables}
        node = self.keys.get("chairs")
        for key, value in self.reader.entries(node, "chairs") or () if node else ():
            table = self.reader.known(key, "chairs", "table", self.names.tables)
            if table is None:
                continue
            number = self.reader.integer(value, f"chairs of {table}", 0, capacities[table])
            if number is not None:
                chairs[table] = number
                self.places[f"chairs.{table}"] = key.where
        return tuple(sorted(chairs.items()))

    def _check_tables(self, state: State) -> None:
        occupied = {table for table, _ in state.seated}
        for key in ("paid", "ready_to_order"):
            for table in sorted(getattr(state, key) - occupied):
                verb = "has paid" if key == "paid" else "is ready to order"
                message = f"nobody sits at {table}, so nobody there {verb}"
                self.reader.fault(self.places[f"{key}.{table}"], message, "seat a party there")
        for table in sorted(state.paid & state.wants_bill):
            message = f"{table} has paid and wants its bill"
            self.reader.fault(self.places[f"paid.{table}"], message, "leave it in one of the two")


def _kitchen(
    sets: dict[str, frozenset[str]], pairs: dict[str, tuple[tuple[str, str], ...]]
) -> dict[str, Any]:
    """Returns the sets of tables with what follows from them: a plate that exists
    was ordered and sent.
    """
    plates = {
        table for key in ("ready", "carrying") for table, item in pairs[key] if item == "plate"
    }
    sent = sets["sent"] | sets["served"] | plates
    return {**sets, "sent": sent, "ordered": sets["ordered"] - sent}


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
