"""Reduces the goals of a problem to the tasks they require: `Problem` → `Needs`.

Entry point `find_needs`.  A *chain* is a run of links in their order (`courses`), about one table's
bill, order, object or chairs; a *guest* is a party that must be led to a table.  What is listed as
certain occurs in every plan; what a table asks of those who come to sit there is kept with it.
"""

from __future__ import annotations

from dataclasses import replace

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.service_chains import CARRIED, Link, course, marks_of, wish
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party, State

__all__ = ["Chain", "Guest", "Hopeless", "Needs", "find_needs"]


@dataclass(frozen=True)
class Chain:
    """Links in their order; ``sure`` are those that no plan can do without.

    ``seat_first`` says that somebody must be seated at the (free) table first.  ``ends`` are the
    goals that hold once it is done.
    """

    links: tuple[Link, ...]
    sure: tuple[Link, ...]
    table: str = ""
    seat_first: bool = False
    ends: tuple[Goal, ...] = ()


@dataclass(frozen=True)
class Guest:
    """A party that must be seated, at one of ``tables``: free, large enough, as wanted.

    ``asks`` are the chains to be done at a table for a guest who sits there, by table.
    """

    party: Party
    led: bool
    tables: tuple[str, ...]
    asks: tuple[tuple[str, tuple[Chain, ...]], ...] = ()
    ends: tuple[Goal, ...] = ()


@dataclass(frozen=True)
class Hopeless:
    """A goal that cannot come about, whatever the floor looks like; ``why`` in the user's terms."""

    goal: Goal
    why: str
    late: bool = False


@dataclass(frozen=True)
class Needs:
    """Everything to be done; ``now`` is the state at step 0, with what follows from it at once.

    ``spare`` parties wait or are led and need no table; ``forced`` free tables must be sat at by
    somebody.  ``end`` is the node to end at.
    """

    now: State
    guests: tuple[Guest, ...]
    spare: tuple[Party, ...]
    forced: tuple[str, ...]
    chains: tuple[Chain, ...]
    end: str | None
    hopeless: tuple[Hopeless, ...]


def settled(problem: Problem) -> State:
    """Returns the state at step 0: something carried at the bar is full."""
    state, bar = problem.state, problem.layout.bar
    load = state.carrying
    if load in state.empty and load is not None and bar is not None and state.agent in bar.nodes:
        if load[1] in REFILLABLES:
            return replace(state, empty=state.empty - {load})
    return state


class _Gatherer:
    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.now = settled(problem)
        self.sitting = dict(self.now.seated)
        self.chairs = {table.name: table.chairs for table in problem.layout.tables}
        self.chairs |= dict(self.now.chairs)
        self.tables = {table.name: table for table in problem.layout.tables}
        self.hopeless: list[Hopeless] = []
        self.chains: dict[tuple[str, str], Chain] = {}
        self.forced: dict[str, None] = {}
        self.wishes: dict[tuple[str, str], list[Goal]] = {}  # (table, object) → goals about it
        self.wanted: dict[Party, list[Goal]] = {}
        self.end: str | None = None

    def refuse(self, goal: Goal, why: str) -> None:
        if Hopeless(goal, why) not in self.hopeless:
            self.hopeless.append(Hopeless(goal, why))

    def gather(self) -> Needs:
        problem = self.problem
        final = list(problem.goals)
        passing = [goal for pair in problem.before for goal in pair if goal not in final]
        for goal in (*final, *dict.fromkeys(passing)):
            self.take(goal, goal in final)
        for (table, item), goals in self.wishes.items():
            self.course(table, item, goals)
        self.free_hands()
        guests = [self.guest(party, goals) for party, goals in self.wanted.items()]
        inside = ([self.now.with_agent] if self.now.with_agent else []) + list(self.now.waiting)
        spare = tuple(party for party in inside if party not in self.wanted)
        return Needs(
            self.now,
            tuple(guests),
            spare,
            tuple(self.forced),
            tuple(self.chains.values()),
            self.end,
            tuple(self.hopeless),
        )

    def take(self, goal: Goal, final: bool) -> None:
        """Enters one goal; not final: it must hold at some step only."""
        table = goal.table or ""
        match goal.kind:
            case "at":
                self.place(goal, final)
            case "chairs":
                self.seats(goal)
            case "ordered" | "sent":
                self.wishes.setdefault((table, "plate"), []).append(goal)
            case "served" | "filled":
                self.wishes.setdefault((table, goal.item or "plate"), []).append(goal)
            case "paid" if goal.table is not None:
                self.bill(goal, goal.table)
            case _:
                self.seat(goal)

    def place(self, goal: Goal, final: bool) -> None:
        node = goal.node or ""
        if final:
            if self.end is not None and self.end != node:
                self.refuse(goal, f"the agent cannot end both at {self.end} and at {node}")
            self.end = node
        elif node != self.now.agent:
            links = (Link("visit", node=node),)
            self.chains["visit", node] = Chain(links, links, ends=(goal,))

    def seats(self, goal: Goal) -> None:
        name, number = goal.table or "", goal.number or 0
        if number <= self.chairs[name]:
            return
        if number > self.tables[name].capacity:
            room = self.tables[name].capacity
            self.refuse(goal, f"{name} has room for {room} chairs, not for {number}")
            return
        old = self.chains.get(("chairs", name))
        if old is not None:
            number = max(number, old.links[0].number)
        links = (Link("bring_chairs", name, number=number),)
        ends = (*(old.ends if old else ()), goal)
        self.chains["chairs", name] = Chain(links, links, name, ends=ends)

    def bill(self, goal: Goal, table: str) -> None:
        taken = table in self.sitting
        if not taken:
            self.forced[table] = None
        if table in self.now.wants_bill:
            links = (Link("give_bill", table),)
            old = self.chains.get(("bill", table))
            ends = (*(old.ends if old else ()), goal)
            self.chains["bill", table] = Chain(links, links, table, not taken, ends)
        elif table not in self.now.paid:
            self.refuse(goal, f"{table} has not paid and does not want its bill")

    def seat(self, goal: Goal) -> None:
        party = self.now.party_of(goal.party[0])
        if party is None:
            self.refuse(goal, f"{goal.party[0]} is not inside")
            return
        table = self.now.table_of(goal.party[0])
        if table is None:
            self.wanted.setdefault(party, []).append(goal)
        elif goal.kind == "seated":
            if goal.table not in (None, table):
                self.refuse(goal, f"{goal.party[0]} sits at {table} already")
        elif goal.kind == "paid":
            self.bill(goal, table)
        else:
            if table in self.now.wants_bill:
                self.bill(goal, table)
            for item in self.items(table):
                self.wishes.setdefault((table, item), []).append(goal)

    def items(self, table: str) -> list[str]:
        """Returns the objects of a table of which something holds now."""
        return [item for item in ("plate", *REFILLABLES) if marks_of(self.now, table, item)]

    def course(self, table: str, item: str, goals: list[Goal]) -> None:
        """Enters the chain for the goals about one order or object."""
        marks = marks_of(self.now, table, item)

        def found(*some: Goal) -> tuple[tuple[Link, ...], tuple[Link, ...]] | None:
            tests = [wish(goal.kind, item, goal.item is None) for goal in some]
            return course(
                self.problem, marks, table, item, lambda marks: all(test(marks) for test in tests)
            )

        lost = [goal for goal in goals if found(goal) is None]
        final = [goal for goal in goals if goal in self.problem.goals]
        for goal in lost or final[: found(*final) is None]:
            self.refuse(goal, self.why_never(goal, table, item))
        if lost or found(*final) is None:
            return
        ways = [way for way in (found(*final), *map(found, goals)) if way is not None]
        sure = max((way[0] for way in ways), key=len)
        links = max((way[1] for way in (found(*goals), *ways) if way is not None), key=len)
        if not links:
            return
        empty_seat = table not in self.sitting and any(k.name == "take_order" for k in links)
        if empty_seat and any(link.name == "take_order" for link in sure):
            self.forced[table] = None
        self.chains[item, table] = Chain(links, sure, table, empty_seat, tuple(goals))

    def why_never(self, goal: Goal, table: str, item: str) -> str:
        if self.problem.layout.bar is None:
            return "this layout has no bar"
        if item != "plate":
            if item not in self.problem.layout.objects:
                return f"this layout has no {item}"
            return f"the {item} of {table} cannot be had"
        if goal.kind == "served" and not self.problem.instant_kitchen:
            return f"no plate for {table} is ready, and nothing says when one will be"
        return f"{table} is not ready to order"

    def free_hands(self) -> None:
        """Whatever is carried must go before anything else can be taken."""
        load = self.now.carrying
        if load is None or (load[1], load[0]) in self.chains:
            return
        hands = [c for c in self.chains.values() if any(k.name in _TAKES for k in c.sure)]
        if not hands:
            return
        marks = marks_of(self.now, *load)
        found = course(self.problem, marks, load[0], load[1], lambda m: not m & CARRIED)
        if found is None:
            goal = next((goal for chain in hands for goal in chain.ends), None)
            if goal is not None:
                self.refuse(goal, f"the hands hold the {load[1]} for {load[0]}")
        else:
            self.chains[load[1], load[0]] = Chain(found[1], found[0], load[0])

    def guest(self, party: Party, goals: list[Goal]) -> Guest:
        """Returns a party that must be seated, with the tables where that and the rest can be."""
        named = {goal.table for goal in goals if goal.kind == "seated" and goal.table}
        pays = any(goal.kind == "paid" for goal in goals)
        visit = [goal for goal in goals if goal.kind == "serve"]
        tables, asks = [], []
        for name, table in self.tables.items():
            if name in self.sitting or table.capacity < len(party) or not named <= {name}:
                continue
            if pays and name not in self.now.wants_bill | self.now.paid:
                continue
            chains: list[Chain] = []
            if (pays or visit) and name in self.now.wants_bill:
                links = (Link("give_bill", name),)
                ends = tuple(goal for goal in goals if goal.kind in ("paid", "serve"))
                chains.append(Chain(links, links, name, True, ends))
            possible = True
            for item in self.items(name) if visit else ():
                test = wish("serve", item, True)
                found = course(self.problem, marks_of(self.now, name, item), name, item, test)
                if found is None:
                    possible = False
                elif found[1]:
                    sits = any(link.name == "take_order" for link in found[1])
                    chains.append(Chain(found[1], found[0], name, sits, tuple(visit)))
            if possible:
                tables.append(name)
                if chains:
                    asks.append((name, tuple(chains)))
        led = party == self.now.with_agent
        return Guest(party, led, tuple(tables), tuple(asks), tuple(goals))


_TAKES = ("take_up", "refill")


def find_needs(problem: Problem) -> Needs:
    """Returns the tasks that the goals (and the goals that ``before`` names) require."""
    return _Gatherer(problem).gather()
