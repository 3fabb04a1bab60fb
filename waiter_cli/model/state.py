"""The words for a situation: parties, states, observations, goals; frozen values, no behaviour of files.

A *party* is a tuple of customer names; its first member names it in output.  A :class:`State`
says what holds at one step; what it leaves empty does not hold.  Everything here is plain data
that `layout`, `scenario`, `problem`, `verify` and the replay share; the shape of ``as_dict`` is
the one of a scenario's ``state``.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import Where

__all__ = ["Fact", "Goal", "Observation", "Party", "Robot", "State"]

Party: TypeAlias = tuple[str, ...]


@dataclass(frozen=True)
class Robot:
    """One of several robots: where it stands, the party it leads, what it carries (table, object).

    ``orders`` are the tables whose order it has taken and not yet sent.
    """

    name: str
    at: str
    leads: Party = ()
    carries: tuple[str, str] | None = None
    orders: frozenset[str] = frozenset()


@dataclass(frozen=True)
class State:
    """The state of the restaurant at one step.

    ``waiters``, ``seated`` and ``chairs`` are sorted tuples of pairs (mappings, frozen);
    ``waiting`` keeps the order of arrival.  ``ready``, ``empty``, ``carrying`` hold pairs
    (table, object).  ``ordered`` holds tables whose order the robot has taken *and not yet sent*;
    ``sent`` those whose order is with the kitchen or beyond; ``served`` those whose plate was
    brought.  A carried refillable that is in ``empty`` too is carried empty.
    ``chairs`` has every table of the layout (filled in from it when a scenario is silent).

    Where the layout has several robots they are ``robots``, in its order, and what one robot has
    is theirs: ``agent``, ``with_agent``, ``ordered`` and ``carrying`` are empty then.

    ``fluents`` are inertial fluents that only a domain of one's own knows, as terms of SPARC without
    white space, sorted.
    """

    agent: str
    waiters: tuple[tuple[str, str], ...] = ()
    seated: tuple[tuple[str, Party], ...] = ()
    waiting: tuple[Party, ...] = ()
    with_agent: Party = ()
    wants_bill: frozenset[str] = frozenset()
    paid: frozenset[str] = frozenset()
    ready_to_order: frozenset[str] = frozenset()
    ordered: frozenset[str] = frozenset()
    sent: frozenset[str] = frozenset()
    served: frozenset[str] = frozenset()
    ready: frozenset[tuple[str, str]] = frozenset()
    empty: frozenset[tuple[str, str]] = frozenset()
    carrying: tuple[str, str] | None = None
    chairs: tuple[tuple[str, int], ...] = ()
    robots: tuple[Robot, ...] = ()
    fluents: tuple[str, ...] = ()

    def parties(self) -> tuple[Party, ...]:
        """Returns every party inside: seated ones by table, then those that are led,
        then waiting ones.
        """
        return tuple(party for _, party in self.seated) + self.led() + self.waiting

    def led(self) -> tuple[Party, ...]:
        """Returns the parties that follow a robot."""
        led = (self.with_agent,) if self.with_agent else ()
        if not self.robots:
            return led
        return led + tuple(robot.leads for robot in self.robots if robot.leads)

    def carried(self) -> frozenset[tuple[str, str]]:
        """Returns everything that a robot carries, each with its table."""
        things = (self.carrying, *(robot.carries for robot in self.robots))
        return frozenset(thing for thing in things if thing is not None)

    def held_orders(self) -> frozenset[str]:
        """Returns the tables whose order a robot has taken and not yet sent."""
        return self.ordered.union(*(robot.orders for robot in self.robots))

    def crew(self) -> tuple[Robot, ...]:
        """Returns the robots; a single one is called ``agent``."""
        if self.robots:
            return self.robots
        return (Robot("agent", self.agent, self.with_agent, self.carrying, self.ordered),)

    def stations(self) -> dict[str, str]:
        """Returns where each robot stands; a single one is called ``agent``."""
        if not self.robots:
            return {"agent": self.agent}
        return {robot.name: robot.at for robot in self.robots}

    def robot(self, name: str) -> Robot | None:
        """Returns the robot of that name, None when there is none."""
        return next((robot for robot in self.robots if robot.name == name), None)

    def party_of(self, customer: str) -> Party | None:
        """Returns the party of a customer, None when the customer is not inside."""
        return next((party for party in self.parties() if customer in party), None)

    def table_of(self, customer: str) -> str | None:
        """Returns the table at which a customer sits, None when at none."""
        return next((table for table, party in self.seated if customer in party), None)


@dataclass(frozen=True)
class Observation:
    """One thing seen, all of it at step 0.

    ``kind`` and ``arguments``: ``enter`` (customers...), ``leave`` (customer, ...), ``bill``
    (table,), ``at`` (employee, node), ``order`` (table,), ``ready`` / ``empty`` (table, object),
    ``free`` (table,), ``obs`` (a term of the domain's own,).  A mapping with several entries in the file becomes several of these.
    """

    kind: str
    arguments: tuple[str, ...]
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Fact:
    """A literal of SPARC that a scenario adds to the program, without white space."""

    text: str
    where: Where | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Goal:
    """One thing wanted; all goals of a problem are a conjunction.

    ``kind`` is ``seated`` (``party``; ``table`` None: anywhere), ``paid`` (``table``, or ``party``
    when a customer was named), ``at`` (``node``; ``robot`` None: any), ``ordered`` (``table``), ``sent`` (``table``;
    only made by serving everybody), ``served`` (``table``; ``item`` None: the plate of its order),
    ``filled`` (``table``, ``item``), ``chairs`` (``table``, ``number``: at least so many) or
    ``serve`` (``party``); ``holds`` and ``holds_not`` are about a ``fluent`` of the domain's, a term
    without white space.  ``party`` is the whole party, first-listed member first, once a
    problem is posed; before, what the user wrote.
    """

    kind: str
    party: Party = ()
    table: str | None = None
    node: str | None = None
    item: str | None = None
    number: int | None = None
    where: Where | None = field(default=None, compare=False)
    robot: str | None = None
    fluent: str | None = None

    def as_dict(self) -> dict[str, Any]:
        """Returns the goal in the shape that scenarios and JSON answers use.

        >>> Goal("seated", party=("c1", "c2"), table="table1").as_dict()
        {'seated': {'party': 'c1', 'table': 'table1'}}
        """
        match self.kind:
            case "seated":
                if self.table is not None:
                    return {"seated": {"party": self.party[0], "table": self.table}}
                return {"seated": list(self.party)}
            case "paid":
                return {"paid": self.party[0] if self.table is None else self.table}
            case "at":
                return {"at": self.node if self.robot is None else {self.robot: self.node}}
            case "served" | "filled":
                return {self.kind: self.table if self.item is None else {self.table: self.item}}
            case "chairs":
                return {"chairs": {self.table: self.number}}
            case "serve":
                return {"serve": self.party[0]}
            case "holds" | "holds_not":
                return {self.kind: self.fluent}
        return {self.kind: self.table}
