"""Breadth-first search over every state of a small restaurant: the oracle of planner and verifier.

Written without a look at `waiter_cli.rules.validator`, from the table of actions alone, and in another
style, so that agreement of the two means something.  A restaurant is numbered through once
(`World`); a state is a flat tuple of small integers and bit masks:

    (clock, agent, places, load, wants, paid, eager, held, sent, served, ready, empty, chairs)

``clock`` is the step, stopped at the last entry of the timetable (always 0 without one);
``places`` has for each party the number of its table, or WAITING, or LED; ``load`` is the number of
a carried thing, -1 for free hands; ``wants`` … ``served`` are masks over tables, ``ready`` and
``empty`` masks over things; a thing is table * 3 + object.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

Code: TypeAlias = tuple[
    int, int, tuple[int, ...], int, int, int, int, int, int, int, int, int, tuple[int, ...]
]
Test: TypeAlias = Callable[[Code], bool]

WAITING, LED = -1, -2
OBJECTS = ("plate", "jug", "basket")


@dataclass(frozen=True)
class Outcome:
    """``length`` of a shortest plan, None when there is none; one such plan (idle: empty text)."""

    length: int | None
    states: int
    plan: tuple[str, ...] = ()


class TooLarge(Exception):
    """More states than the limit allows; nothing is known about the problem."""


class World:
    """A problem with its names turned into numbers."""

    def __init__(self, problem: Problem) -> None:
        layout, start = problem.layout, problem.state
        self.nodes = [node.name for node in layout.nodes]
        self.tables = [table.name for table in layout.tables]
        self.parties = [party for _, party in start.seated] + list(start.waiting)
        if start.with_agent:
            self.parties.append(start.with_agent)
        number = {name: index for index, name in enumerate(self.nodes)}
        self.number = number
        self.door = number[layout.entrance]
        self.next: list[list[int]] = [[] for _ in self.nodes]
        for a, b in layout.edges:
            self.next[number[a]].append(number[b])
            if (a, b) not in layout.one_way:
                self.next[number[b]].append(number[a])
        self.next = [list(dict.fromkeys(nodes)) for nodes in self.next]
        self.near = [  # for each node, the tables that can be served from it
            [index for index, table in enumerate(layout.tables) if name in table.nodes]
            for name in self.nodes
        ]
        self.room = [table.capacity for table in layout.tables]
        self.bar = {number[name] for name in layout.bar.nodes} if layout.bar else set()
        self.has_bar = layout.bar is not None
        self.plates = problem.instant_kitchen and "plate" in layout.objects
        spare = dict(start.chairs)
        self.start_chairs = tuple(spare.get(t.name, t.chairs) for t in layout.tables)
        self.lends_chairs = any(c < room for c, room in zip(self.start_chairs, self.room))
        self.last = max((step for _, step, _ in layout.timetable), default=0)
        self.staff: list[set[int]] = []  # nodes taken by waiters at each clock
        posts = {who: number[node] for who, node in start.waiters}
        for clock in range(self.last + 1):
            posts |= {who: number[to] for who, at, to in layout.timetable if at == clock}
            self.staff.append(set(posts.values()))

    def encode(self, state: State, step: int) -> Code:
        """The state at ``step`` as a code; where waiters stand follows from the clock."""

        def tables(names: frozenset[str]) -> int:
            return sum(1 << self.tables.index(name) for name in names)

        def things(pairs: frozenset[tuple[str, str]]) -> int:
            return sum(1 << self._thing(*pair) for pair in pairs)

        places = {party: self.tables.index(table) for table, party in state.seated}
        chairs = dict(state.chairs)
        return (
            min(step, self.last),
            self.number[state.agent],
            tuple(
                places.get(party, LED if party == state.with_agent else WAITING)
                for party in self.parties
            ),
            self._thing(*state.carrying) if state.carrying else -1,
            tables(state.wants_bill),
            tables(state.paid),
            tables(state.ready_to_order),
            tables(state.ordered),
            tables(state.sent),
            tables(state.served),
            things(state.ready),
            things(state.empty),
            tuple(chairs.get(name, c) for name, c in zip(self.tables, self.start_chairs)),
        )

    def _thing(self, table: str, item: str) -> int:
        return self.tables.index(table) * 3 + OBJECTS.index(item)

    def start(self, problem: Problem) -> Code | None:
        """The code of step 0, None when the agent would share its node there."""
        return self._arrive(self.encode(problem.state, 0), 0)

    def _arrive(self, code: Code, clock: int) -> Code | None:
        """``code`` at its new clock: nobody on the agent's node, what it carries full at the bar."""
        if code[1] in self.staff[clock]:
            return None
        empty, load = code[11], code[3]
        if load >= 0 and load % 3 and code[1] in self.bar:
            empty &= ~(1 << load)
        return (clock, *code[1:11], empty, code[12])

    def successors(self, code: Code) -> Iterator[tuple[str, Code]]:
        """Every possible step from ``code`` with where it leads; the idle one has no text."""
        clock = min(code[0] + 1, self.last)
        for text, after in self._steps(code):
            arrived = self._arrive(after, clock)
            if arrived is not None:
                yield text, arrived

    def _steps(self, code: Code) -> Iterator[tuple[str, Code]]:
        clock, agent, places, load, wants, paid, eager, held, sent, served, ready, empty, seats = (
            code
        )
        yield "", code
        for node in self.next[agent]:
            if node not in self.staff[clock]:
                yield f"go_to(agent,{self.nodes[node]})", (clock, node, *code[2:])
        taken = {place for place in places if place >= 0}
        led = places.index(LED) if LED in places else None
        if agent == self.door and led is None and len(taken) < len(self.room):
            for who, place in enumerate(places):
                if place == WAITING:
                    moved = (*places[:who], LED, *places[who + 1 :])
                    yield f"pick(agent,{self.parties[who][0]})", (*code[:2], moved, *code[3:])
        for t in self.near[agent]:
            name, bit = self.tables[t], 1 << t
            if led is not None and t not in taken:
                party = self.parties[led]
                if len(party) <= min(self.room[t], seats[t]):
                    moved = (*places[:led], t, *places[led + 1 :])
                    yield f"seat(agent,{party[0]},{name})", (*code[:2], moved, *code[3:])
            if t in taken and wants & bit:
                after = (*code[:4], wants & ~bit, paid | bit, *code[6:])
                yield f"give_bill(agent,{name})", after
            if self.has_bar and t in taken and eager & bit:
                orders = (eager & ~bit, held | bit, sent & ~bit, served & ~bit)
                yield f"take_order(agent,{name})", (*code[:6], *orders, *code[10:])
            if load // 3 == t and not empty >> load & 1:
                fed = served | bit if load % 3 == 0 else served
                after = (*code[:3], -1, *code[4:9], fed, *code[10:])
                yield f"bring(agent,{OBJECTS[load % 3]},{name})", after
            if self.has_bar and load == -1:
                for kind in (1, 2):
                    if empty >> t * 3 + kind & 1:
                        after = (*code[:3], t * 3 + kind, *code[4:])
                        yield f"refill(agent,{OBJECTS[kind]},{name})", after
            if self.lends_chairs:
                for count in range(seats[t] + 1, self.room[t] + 1):
                    after = (*code[:12], (*seats[:t], count, *seats[t + 1 :]))
                    yield f"bring_chairs(agent,{name},{count})", after
        if agent in self.bar:
            for t, name in enumerate(self.tables):
                bit, plate = 1 << t, 1 << t * 3
                if held & bit:
                    dished = ready | plate if self.plates else ready
                    after = (*code[:7], held & ~bit, sent | bit, served, dished, empty, seats)
                    yield f"send_order(agent,{name})", after
            for thing in range(len(self.tables) * 3):
                if load == -1 and ready >> thing & 1:
                    after = (*code[:3], thing, *code[4:10], ready & ~(1 << thing), empty, seats)
                    yield f"take_up(agent,{OBJECTS[thing % 3]},{self.tables[thing // 3]})", after

    def test(self, goal: Goal) -> Test:
        """The goal as a question to a code."""
        t = self.tables.index(goal.table) if goal.table is not None else -1
        bit = 1 << t if t >= 0 else 0
        who = -1
        if goal.party:
            who = next(i for i, party in enumerate(self.parties) if goal.party[0] in party)
        item = OBJECTS.index(goal.item) if goal.item is not None else 0
        thing = t * 3 + item

        def away(code: Code) -> bool:
            return bool(code[10] >> thing & 1) or code[3] == thing

        def served(code: Code) -> bool:
            if away(code):
                return False
            if goal.item is None:
                return bool(code[9] & bit) and not code[7] & bit
            return bool(code[9] & bit) if item == 0 else not code[11] >> thing & 1

        def paid(code: Code, table: int) -> bool:
            mask = 1 << table
            return table in code[2] and bool(code[5] & mask) and not code[4] & mask

        def content(code: Code) -> bool:
            place = code[2][who]
            if place < 0 or (code[4] | code[6] | code[7]) >> place & 1:
                return False
            return not (code[10] | code[11]) >> place * 3 & 7 and code[3] // 3 != place

        tests: dict[str, Test] = {
            "seated": lambda code: code[2][who] == t if t >= 0 else code[2][who] >= 0,
            "paid": lambda code: paid(code, t) if t >= 0 else paid_party(code),
            "at": lambda code: self.nodes[code[1]] == goal.node,
            "ordered": lambda code: bool((code[7] | code[8]) & bit),
            "sent": lambda code: bool(code[8] & bit),
            "served": served,
            "filled": lambda code: not code[11] >> thing & 1 and code[3] != thing,
            "chairs": lambda code: code[12][t] >= (goal.number or 0),
            "serve": content,
        }

        def paid_party(code: Code) -> bool:
            return code[2][who] >= 0 and paid(code, code[2][who])

        return tests[goal.kind]


def shortest(problem: Problem, limit: int = 400_000) -> Outcome:
    """The length of a shortest plan by trying everything; `TooLarge` beyond ``limit`` states."""
    world = World(problem)
    wanted = [world.test(goal) for goal in problem.goals]
    pairs = [(world.test(early), world.test(late)) for early, late in problem.before]
    start = world.start(problem)
    if start is None:
        return Outcome(None, 0)

    def advance(code: Code, history: tuple[int, ...]) -> tuple[int, ...] | None:
        """Of each pair: 0 none has held, 1 the early one has, 2 both in order; None: too late."""
        out = []
        for (early, late), so_far in zip(pairs, history):
            if so_far == 1 and late(code):
                so_far = 2
            elif so_far == 0:
                if late(code):
                    return None
                so_far = int(early(code))
            out.append(so_far)
        return tuple(out)

    history = advance(start, (0,) * len(pairs))
    if history is None:
        return Outcome(None, 1)
    first = (start, history)
    came: dict[tuple[Code, tuple[int, ...]], tuple[object, str]] = {first: (None, "")}
    frontier, length = [first], 0
    while frontier:
        fresh = []
        for node in frontier:
            code, history = node
            if all(mark == 2 for mark in history) and all(test(code) for test in wanted):
                return Outcome(length, len(came), _way(came, node))
            for text, after in world.successors(code):
                marks = advance(after, history) if pairs else ()
                if marks is not None and (after, marks) not in came:
                    came[after, marks] = (node, text)
                    fresh.append((after, marks))
        if len(came) > limit:
            raise TooLarge(f"more than {limit} states")
        frontier, length = fresh, length + 1
    return Outcome(None, len(came))


def least_waiting(problem: Problem, limit: int = 60_000) -> int | None:
    """Among all plans of least length, the least sum over steps of goals that do not hold then.

    None where there is no plan; `TooLarge` beyond ``limit`` states in one step.
    """
    length = shortest(problem, limit).length
    world = World(problem)
    wanted = [world.test(goal) for goal in problem.goals]
    pairs = [(world.test(early), world.test(late)) for early, late in problem.before]
    start = world.start(problem)
    if length is None or start is None:
        return None

    def marked(code: Code, marks: tuple[int, ...]) -> tuple[int, ...]:
        """As ``advance`` in `shortest`, 3 where the order is broken."""
        found = []
        for (early, late), mark in zip(pairs, marks):
            if mark == 0 and late(code):
                mark = 3
            elif mark == 0 and early(code):
                mark = 1
            elif mark == 1 and late(code):
                mark = 2
            found.append(mark)
        return tuple(found)

    def open_goals(code: Code) -> int:
        return sum(not test(code) for test in wanted)

    layer = {(start, marked(start, (0,) * len(pairs))): open_goals(start)}
    for _ in range(length):
        fresh: dict[tuple[Code, tuple[int, ...]], int] = {}
        for (code, marks), cost in layer.items():
            for _text, after in world.successors(code):
                node = after, marked(after, marks)
                total = cost + open_goals(after)
                if 3 not in node[1] and total < fresh.get(node, total + 1):
                    fresh[node] = total
        if len(fresh) > limit:
            raise TooLarge(f"more than {limit} states")
        layer = fresh
    return min(
        cost
        for (code, marks), cost in layer.items()
        if all(mark == 2 for mark in marks) and not open_goals(code)
    )


def _way(came: dict, node: object) -> tuple[str, ...]:  # type: ignore[type-arg]
    """The steps that led to ``node``, first one first."""
    steps: list[str] = []
    while True:
        before, text = came[node]
        if before is None:
            return tuple(reversed(steps))
        steps.append(text)
        node = before
