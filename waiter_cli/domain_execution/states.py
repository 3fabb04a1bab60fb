"""Fluents that hold → `State`: what an answer set says, in the words of a state. Entry point `state_of`.

What a program has no words for stays as it was.  Parties are known by any of their members; those who
wait keep the order in which they came.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from typing import Any

from waiter_cli.encoding.own_words import KEY_OF_FLUENT
from waiter_cli.model.state import Party, Robot, State

__all__ = ["parted", "state_of"]

_TABLE_SETS = {
    "wantsbill": "wants_bill",
    "readytoorder": "ready_to_order",
    "issent": "sent",
    "isserved": "served",
}


def parted(term: str) -> tuple[str, tuple[str, ...]]:
    """Returns name and arguments of a term without white space.

    >>> parted("on(b1,pile(3,4))"), parted("raining")
    (('on', ('b1', 'pile(3,4)')), ('raining', ()))
    """
    name, bracket, rest = term.partition("(")
    if not bracket:
        return term, ()
    found, depth = [""], 0
    for letter in rest[:-1]:
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            found.append("")
        else:
            found[-1] += letter
    return name, tuple(found)


def state_of(
    held: Iterable[str], before: State, known: Collection[str], inertial: Collection[str]
) -> State:
    """Returns the state in which these fluents hold.

    ``before`` is the state before; ``known`` are the names of all fluents of the program, ``inertial``
    of those that are a state's to keep.
    """
    by_name: dict[str, list[tuple[str, ...]]] = {}
    own: list[str] = []
    for term in held:
        name, arguments = parted(term)
        by_name.setdefault(name, []).append(arguments)
        if name in inertial and name not in KEY_OF_FLUENT:
            own.append(term)
    return _Decoder(by_name, before, frozenset(known)).state(tuple(sorted(own)))


class _Decoder:
    def __init__(
        self, held: dict[str, list[tuple[str, ...]]], before: State, known: frozenset[str]
    ) -> None:
        self.held = held
        self.before = before
        self.known = known

    def state(self, own: tuple[str, ...]) -> State:
        before = self.before
        changes: dict[str, Any] = {"fluents": own}
        for fluent, key in _TABLE_SETS.items():
            if fluent in self.known:
                changes[key] = frozenset(table for (table,) in self.of(fluent))
        for fluent, key in (("isready", "ready"), ("isempty", "empty")):
            if fluent in self.known:
                changes[key] = frozenset((table, item) for item, table in self.of(fluent))
        if "isattable" in self.known:
            changes["seated"] = self.seated()
        if "iswaiting" in self.known:
            changes["waiting"] = self.waiting()
        if "haspaid" in self.known:
            tables = dict(changes.get("seated", before.seated))
            paid = {who for (who,) in self.of("haspaid")}
            changes["paid"] = frozenset(t for t, party in tables.items() if paid & {*party})
        if "has_chairs" in self.known:
            chairs = {table: int(number) for table, number in self.of("has_chairs")}
            changes["chairs"] = tuple(sorted((dict(before.chairs) | chairs).items()))
        return self.staff(replace(before, **changes))

    def of(self, fluent: str) -> list[tuple[str, ...]]:
        return self.held.get(fluent, [])

    def party(self, member: str) -> Party:
        return self.before.party_of(member) or (member,)

    def seated(self) -> tuple[tuple[str, Party], ...]:
        parties: dict[str, Party] = {}
        for who, table in sorted(self.of("isattable")):
            parties.setdefault(table, self.party(who))
        return tuple(sorted(parties.items()))

    def waiting(self) -> tuple[Party, ...]:
        parties = {self.party(who) for (who,) in self.of("iswaiting")}
        kept = [party for party in self.before.waiting if party in parties]
        return (*kept, *sorted(parties.difference(kept)))

    def staff(self, state: State) -> State:
        robots = {robot.name: robot for robot in state.crew()}
        places: dict[str, str] = dict(map(_pair, self.of("currentlocation")))
        found = [self.robot(robot, places) for robot in robots.values()]
        waiters = {who: places.get(who, node) for who, node in state.waiters}
        state = replace(state, waiters=tuple(sorted(waiters.items())))
        if state.robots:
            return replace(state, robots=tuple(found))
        (only,) = found
        return replace(
            state,
            agent=only.at,
            with_agent=only.leads,
            carrying=only.carries,
            ordered=only.orders,
        )

    def robot(self, robot: Robot, places: dict[str, str]) -> Robot:
        leads, carries, orders = robot.leads, robot.carries, robot.orders
        if "iswith" in self.known:
            led = sorted(who for name, who in self.of("iswith") if name == robot.name)
            leads = self.party(led[0]) if led else ()
        if "iscarrying" in self.known:
            things = [rest for name, *rest in self.of("iscarrying") if name == robot.name]
            carries = (things[0][1], things[0][0]) if things else None
        if "hasorder" in self.known:
            orders = frozenset(t for name, t in self.of("hasorder") if name == robot.name)
        at = places.get(robot.name, robot.at)
        return Robot(robot.name, at, leads, carries, orders)


def _pair(arguments: tuple[str, ...]) -> tuple[str, str]:
    first, second = arguments
    return first, second
