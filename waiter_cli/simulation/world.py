"""The simulated restaurant: its true state, and the true effects of actions and guests.

Entry point `World`.  It keeps its own records and its own rules, one small function an action,
so that comparing it with what a planner believes means something: nothing here is shared with the
planner's or the validator's rules.  A thing that must not be is a `Violation` with the name of the check
that it breaks.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from copy import copy

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Observation, Party, State

__all__ = ["RULES", "Violation", "Place", "WorldRule", "World"]

REFILLABLES = ("jug", "basket")


@dataclass(frozen=True)
class Violation:
    """A breach of the rules: the name of the check, and a sentence."""

    check: str
    reason: str


@dataclasses.dataclass
class Place:
    """A table: who sits on which of its chairs, and what they are waiting for.

    ``order`` is ``None``, ``taken`` (the robot has it) or ``sent`` (the kitchen, or beyond).
    """

    capacity: int
    chairs: int
    nodes: tuple[str, ...]
    party: Party = ()
    seats: dict[str, int] = dataclasses.field(default_factory=dict)
    wants_bill: bool = False
    paid: bool = False
    hungry: bool = False
    order: str | None = None
    served: bool = False

    def cleared(self) -> None:
        """Clears the table: everybody has left."""
        self.party, self.seats = (), {}
        self.wants_bill = self.paid = self.hungry = self.served = False
        self.order = None


class World:
    """The restaurant as it is; changed by `perform`, `suffer` and `tick_over`."""

    def __init__(self, layout: Layout, state: State, instant_kitchen: bool = False) -> None:
        self.layout = layout
        self.instant_kitchen = instant_kitchen
        self.near = {name: set(nodes) for name, nodes in layout.neighbours().items()}
        self.bar = set(layout.bar.nodes) if layout.bar else set()
        self.changes = 0
        """How often anything was done or has happened; grows with every change."""
        self.robot = state.agent
        self.staff = dict(state.waiters)
        self.late: dict[str, str] = {}
        """Who waits until the robot has left which node."""
        self.queue = list(state.waiting)
        self.led: Party = state.with_agent
        self.load = state.carrying
        self.counter = set(state.ready)
        self.hollow = set(state.empty)
        """(table, object) that is empty, on the table or in the robot's hands."""
        chairs = dict(state.chairs)
        self.tables: dict[str, Place] = {}
        self.chairs_count = any(
            chairs.get(table.name, table.chairs) < table.capacity for table in layout.tables
        )
        for table in layout.tables:
            place = Place(table.capacity, chairs.get(table.name, table.chairs), table.nodes)
            place.wants_bill = table.name in state.wants_bill
            place.paid = table.name in state.paid
            place.hungry = table.name in state.ready_to_order
            if table.name in state.sent:
                place.order = "sent"
            elif table.name in state.ordered:
                place.order = "taken"
            place.served = table.name in state.served
            self.tables[table.name] = place
        for name, party in state.seated:
            self._sit(party, name)
        self._fill_at_bar()

    def fork(self) -> World:
        """Returns one that goes its own way from here."""
        other = copy(self)
        other.staff, other.late = dict(self.staff), dict(self.late)
        other.queue = list(self.queue)
        other.counter, other.hollow = set(self.counter), set(self.hollow)
        other.tables = {
            name: dataclasses.replace(place, seats=dict(place.seats))
            for name, place in self.tables.items()
        }
        return other

    def become(self, state: State) -> None:
        """Makes the world what a state says of it."""
        self.__dict__.update(World(self.layout, state, self.instant_kitchen).__dict__)

    # ------------------------------------------------------------ what is asked

    def party_of(self, customer: str) -> Party | None:
        """Returns the whole party of somebody inside."""
        parties = [place.party for place in self.tables.values()] + [self.led, *self.queue]
        return next((party for party in parties if customer in party), None)

    def table_of(self, customer: str) -> str | None:
        """Returns the table at which somebody sits."""
        return next((n for n, place in self.tables.items() if customer in place.party), None)

    def breach(self, action: Action) -> Violation | None:
        """Returns why an action cannot be done now, None when it can."""
        rule = RULES.get(action.name)
        if rule is None or len(action.arguments) != 1 + rule.arity:
            return Violation("preconditions", f"{action.text} is no action of the robot's")
        for kind, name in zip(rule.kinds, action.arguments[1:]):
            unknown = (
                (kind == "node" and name not in self.near)
                or (kind == "table" and name not in self.tables)
                or (kind == "customer" and self.party_of(name) is None)
                or (kind == "object" and name not in self.layout.objects)
                or (kind == "number" and not name.isdigit())
            )
            if unknown:
                return Violation("preconditions", f"there is no {kind} {name} here")
        return rule.forbids(self, *action.arguments[1:])

    def disorder(self) -> Violation | None:
        """Returns the first fault of the room itself: shared nodes, chairs taken
        twice or not there.
        """
        standing = [self.robot, *self.staff.values()]
        for node in standing:
            if standing.count(node) > 1:
                return Violation("shared_node", f"two of the staff stand on {node}")
        seen: set[str] = set()
        for name, place in self.tables.items():
            if set(place.seats) != set(place.party):
                return Violation("chairs", f"not everybody of {name} has a chair there")
            taken = list(place.seats.values())
            if len(set(taken)) < len(taken):
                return Violation("chairs", f"two guests sit on one chair of {name}")
            if len(taken) > place.capacity or any(c >= place.chairs for c in taken):
                return Violation(
                    "chairs", f"{len(taken)} sit at {name}, which has {place.chairs} chairs"
                )
            seen.update(place.party)
        for party in (self.led, *self.queue):
            if seen & set(party):
                return Violation("chairs", f"the party of {party[0]} is in two places")
            seen.update(party)
        return None

    def met(self, goal: Goal) -> bool:
        """Returns whether a goal holds now."""
        place = self.tables.get(goal.table or "")
        match goal.kind:
            case "at":
                return self.robot == goal.node
            case "seated":
                at = self.table_of(goal.party[0])
                return at is not None and (goal.table is None or goal.table == at)
            case "paid":
                if place is None:
                    place = self.tables.get(self.table_of(goal.party[0]) or "")
                return (
                    place is not None and place.paid and bool(place.party) and not place.wants_bill
                )
            case "ordered":
                return place is not None and place.order is not None
            case "sent":
                return place is not None and place.order == "sent"
            case "served":
                thing = (goal.table or "", goal.item or "plate")
                if place is None or thing in self.counter or thing == self.load:
                    return False
                if thing[1] != "plate":
                    return thing not in self.hollow
                return place.served and (goal.item is not None or place.order != "taken")
            case "filled":
                thing = (goal.table or "", goal.item or "")
                return thing not in self.hollow and thing != self.load
            case "chairs":
                return place is not None and place.chairs >= (goal.number or 0)
            case "serve":
                at = self.table_of(goal.party[0])
                if at is None:
                    return False
                place = self.tables[at]
                loose = {t for t, _ in (*self.counter, *self.hollow, self.load or ("", ""))}
                waits = place.wants_bill or place.hungry or place.order == "taken"
                return not waits and at not in loose
        return False

    def state(self) -> State:
        """Returns the world in the words of a state."""

        def named(test: Callable[[Place], bool]) -> frozenset[str]:
            return frozenset(name for name, place in self.tables.items() if test(place))

        return State(
            agent=self.robot,
            waiters=tuple(sorted(self.staff.items())),
            seated=tuple(sorted((n, p.party) for n, p in self.tables.items() if p.party)),
            waiting=tuple(self.queue),
            with_agent=self.led,
            wants_bill=named(lambda p: p.wants_bill),
            paid=named(lambda p: p.paid),
            ready_to_order=named(lambda p: p.hungry),
            ordered=named(lambda p: p.order == "taken"),
            sent=named(lambda p: p.order == "sent"),
            served=named(lambda p: p.served),
            ready=frozenset(self.counter),
            empty=frozenset(self.hollow),
            carrying=self.load,
            chairs=tuple(sorted((name, place.chairs) for name, place in self.tables.items())),
        )

    # ------------------------------------------------------------ what happens

    def perform(self, action: Action) -> None:
        """The effects of an action that `breach` allows."""
        self.changes += 1
        RULES[action.name].effect(self, *action.arguments[1:])
        self._fill_at_bar()

    def tick_over(self, step: int, failed: bool = False) -> None:
        """A step has passed: whoever is due elsewhere at ``step`` is there.

        Where the robot ``failed`` to do what it was about to, nobody comes to where it still is, nor
        to where somebody waits for that: he waits for a step, unless he is due elsewhere then.
        """
        due = self._due(step)
        self.late = {}
        full = [self.robot] if failed else []
        for place in full:  # grows
            for who in [who for who, node in due.items() if node == place]:
                full.append(self.staff[who])
                self.late[who] = due.pop(who)
        self.staff.update(due)

    def expected(self, step: int) -> dict[str, str]:
        """Returns who is to set out for where, to be there at ``step``."""
        return {who: to for who, to in self._due(step).items() if self.staff.get(who) != to}

    def _due(self, step: int) -> dict[str, str]:
        return self.late | {who: node for who, at, node in self.layout.timetable if at == step}

    def suffer(self, seen: Observation) -> str | None:
        """Applies what guests, kitchen and colleagues do; returns why it cannot be, None when done."""
        self.changes += 1
        first, *rest = seen.arguments
        place = self.tables.get(first)
        match seen.kind:
            case "enter":
                inside = [name for name in seen.arguments if self.party_of(name) is not None]
                if inside:
                    return f"{inside[0]} is inside already"
                self.queue.append(seen.arguments)
            case "leave":
                return self._leave(first)
            case "bill" if place is not None:
                place.wants_bill, place.paid = True, False
            case "order" if place is not None:
                if not place.party:
                    return f"nobody sits at {first}"
                place.hungry = True
            case "ready" if place is not None:
                self.counter.add((first, rest[0]))
                if rest[0] == "plate":
                    place.order, place.served = "sent", False
            case "empty":
                if self.load == (first, rest[0]):
                    return f"the robot carries the {rest[0]} of {first}"
                self.hollow.add((first, rest[0]))
            case "free" if place is not None:
                if place.party:
                    return f"the party of {place.party[0]} sits at {first}"
            case "at" if first == "agent":
                if rest[0] in self.staff.values():
                    return f"somebody stands on {rest[0]}"
                self.robot = rest[0]
                self._fill_at_bar()
            case "at":
                others = {n for who, n in self.staff.items() if who != first}
                if rest[0] in others | {self.robot}:
                    return f"somebody stands on {rest[0]}"
                self.staff[first] = rest[0]
        return None

    def _leave(self, customer: str) -> str | None:
        party = self.party_of(customer)
        if party is None:
            return f"{customer} is not inside"
        table = self.table_of(customer)
        if table is None:
            self.queue = [other for other in self.queue if other != party]
            self.led = () if self.led == party else self.led
            return None
        self.tables[table].cleared()
        self.counter = {thing for thing in self.counter if thing[0] != table}
        if self.load == (table, "plate"):
            self.load = None
        return None

    def _sit(self, party: Party, table: str) -> None:
        place = self.tables[table]
        place.party = party
        place.seats = {name: number for number, name in enumerate(party)}

    def _fill_at_bar(self) -> None:
        if self.load is not None and self.load[1] in REFILLABLES and self.robot in self.bar:
            self.hollow.discard(self.load)

    def _away(self, table: str) -> Violation | None:
        nodes = self.tables[table].nodes
        if self.robot not in nodes:
            return Violation(
                "preconditions",
                f"the robot is at {self.robot}, {table} is reached from {' or '.join(nodes)}",
            )
        return None

    def _not_at_bar(self) -> Violation | None:
        if self.robot not in self.bar:
            return Violation("preconditions", f"the robot is at {self.robot}, not at the bar")
        return None


# ---------------------------------------------------------------- the rules, one by one


@dataclass(frozen=True)
class WorldRule:
    """The rule of an action: its arguments, its conditions and its effects."""

    kinds: tuple[str, ...]
    forbids: Callable[..., Violation | None]
    effect: Callable[..., None]

    @property
    def arity(self) -> int:
        """Returns the number of arguments after the agent."""
        return len(self.kinds)


def _no(condition: object, reason: str, check: str = "preconditions") -> Violation | None:
    return Violation(check, reason) if condition else None


def _no_go(w: World, node: str) -> Violation | None:
    return _no(
        node not in w.near[w.robot], f"no edge leads from {w.robot} to {node}", "edge"
    ) or _no(node in w.staff.values(), f"somebody stands on {node}")


def _go(w: World, node: str) -> None:
    w.robot = node


def _no_pick(w: World, who: str) -> Violation | None:
    party = w.party_of(who)
    return (
        _no(w.robot != w.layout.entrance, f"the robot is at {w.robot}, not at the entrance")
        or _no(party not in w.queue, f"the party of {who} is not waiting")
        or _no(w.led, f"the party of {w.led[0] if w.led else ''} follows the robot already")
        or _no(all(place.party for place in w.tables.values()), "no table is free")
    )


def _pick(w: World, who: str) -> None:
    party = w.party_of(who) or ()
    w.queue = [other for other in w.queue if other != party]
    w.led = party


def _no_seat(w: World, who: str, table: str) -> Violation | None:
    place, size = w.tables[table], len(w.led)
    return (
        _no(who not in w.led, f"the party of {who} does not follow the robot")
        or w._away(table)
        or _no(place.party, f"somebody sits at {table} already")
        or _no(size > place.capacity, f"{table} is for {place.capacity}, not for {size}", "chairs")
        or _no(size > place.chairs, f"{table} has {place.chairs} chairs, not {size}", "chairs")
    )


def _seat(w: World, who: str, table: str) -> None:
    w._sit(w.led, table)
    w.led = ()


def _no_bill(w: World, table: str) -> Violation | None:
    place = w.tables[table]
    return (
        _no(not place.wants_bill, f"{table} does not want its bill")
        or _no(not place.party, f"nobody sits at {table}")
        or w._away(table)
    )


def _bill(w: World, table: str) -> None:
    w.tables[table].paid, w.tables[table].wants_bill = True, False


def _no_take_order(w: World, table: str) -> Violation | None:
    place = w.tables[table]
    return (
        _no(not w.bar, "there is no bar to order from")
        or _no(not place.party, f"nobody sits at {table}")
        or _no(not place.hungry, f"{table} is not ready to order")
        or w._away(table)
    )


def _take_order(w: World, table: str) -> None:
    place = w.tables[table]
    place.hungry, place.order, place.served = False, "taken", False


def _no_send_order(w: World, table: str) -> Violation | None:
    return (
        _no(w.tables[table].order != "taken", f"the robot has no order of {table}")
        or w._not_at_bar()
    )


def _send_order(w: World, table: str) -> None:
    w.tables[table].order = "sent"
    if w.instant_kitchen and "plate" in w.layout.objects:
        w.counter.add((table, "plate"))


def _no_take_up(w: World, item: str, table: str) -> Violation | None:
    return (
        w._not_at_bar()
        or _no(w.load, "the robot's hands are full")
        or _no((table, item) not in w.counter, f"no {item} for {table} stands at the bar")
    )


def _take_up(w: World, item: str, table: str) -> None:
    w.counter.discard((table, item))
    w.load = (table, item)


def _no_bring(w: World, item: str, table: str) -> Violation | None:
    return (
        _no(w.load != (table, item), f"the robot does not carry the {item} of {table}")
        or _no((table, item) in w.hollow, f"the {item} of {table} is empty")
        or w._away(table)
    )


def _bring(w: World, item: str, table: str) -> None:
    w.load = None
    if item == "plate":
        w.tables[table].served = True


def _no_refill(w: World, item: str, table: str) -> Violation | None:
    return (
        _no(not w.bar or item not in REFILLABLES, f"{item} cannot be refilled here")
        or _no((table, item) not in w.hollow, f"the {item} of {table} is not empty")
        or _no(w.load, "the robot's hands are full")
        or w._away(table)
    )


def _refill(w: World, item: str, table: str) -> None:
    w.load = (table, item)


def _no_bring_chairs(w: World, table: str, number: str) -> Violation | None:
    place = w.tables[table]
    fits = place.chairs < int(number) <= place.capacity
    return (
        _no(not w.chairs_count, "every table has had all its chairs")
        or _no(not fits, f"{table} has {place.chairs} of at most {place.capacity} chairs", "chairs")
        or w._away(table)
    )


def _bring_chairs(w: World, table: str, number: str) -> None:
    w.tables[table].chairs = int(number)


RULES: dict[str, WorldRule] = {
    "go_to": WorldRule(("node",), _no_go, _go),
    "pick": WorldRule(("customer",), _no_pick, _pick),
    "seat": WorldRule(("customer", "table"), _no_seat, _seat),
    "give_bill": WorldRule(("table",), _no_bill, _bill),
    "take_order": WorldRule(("table",), _no_take_order, _take_order),
    "send_order": WorldRule(("table",), _no_send_order, _send_order),
    "take_up": WorldRule(("object", "table"), _no_take_up, _take_up),
    "bring": WorldRule(("object", "table"), _no_bring, _bring),
    "refill": WorldRule(("object", "table"), _no_refill, _refill),
    "bring_chairs": WorldRule(("table", "number"), _no_bring_chairs, _bring_chairs),
}
