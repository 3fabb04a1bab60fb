"""A problem with several robots as numbers: `Problem` → `JointWorld`, whose states can be searched whole.

A state is a tuple (see `FIELDS`): the clock, stopped at the last entry of the timetable; for each
robot its node, its load (a thing, -1: free hands) and a mask of the tables whose order it holds; for
each party its table, `WAITING` or the robot that it follows; masks over tables and over things
(table * 3 + object); for each table its chairs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal

__all__ = ["FIELDS", "JointCode", "JointWorld"]

JointCode: TypeAlias = tuple[Any, ...]
FIELDS = ("clock", "nodes", "loads", "held", "places", "wants", "paid", "eager", "sent", "served",
          "ready", "empty", "chairs")  # fmt: skip
CLOCK, NODES, LOADS, HELD, PLACES, WANTS, PAID, EAGER, SENT, SERVED, READY, EMPTY, CHAIRS = range(
    13
)
WAITING = -1
OBJECTS = ("plate", "jug", "basket")


class Option(NamedTuple):
    """Something that one robot may do: its words, the node it then is on, and what changes.

    ``one`` are changes (field, index, value) of fields with several entries, ``bits`` changes
    (field, clear, set) of masks.  Two options with an equal ``mark`` do not go together, nor one whose
    mark the other ``forbids``.
    """

    name: str
    arguments: tuple[str, ...]
    node: int
    one: tuple[tuple[int, int, int], ...] = ()
    bits: tuple[tuple[int, int, int], ...] = ()
    mark: object = None
    forbids: tuple[object, ...] = ()


class JointWorld:
    """The restaurant of a problem, numbered through once."""

    def __init__(self, problem: Problem) -> None:
        layout, start = problem.layout, problem.state
        self.problem = problem
        self.robots = [robot.name for robot in start.robots]
        self.nodes = [node.name for node in layout.nodes]
        self.tables = [table.name for table in layout.tables]
        self.number = {name: index for index, name in enumerate(self.nodes)}
        self.parties = (
            [party for _, party in start.seated] + list(start.waiting) + list(start.led())
        )
        near = layout.neighbours()
        self.next = [[self.number[name] for name in near[here]] for here in self.nodes]
        self.near = [
            [k for k, table in enumerate(layout.tables) if name in table.nodes]
            for name in self.nodes
        ]
        self.door = self.number[layout.entrance]
        self.room = [table.capacity for table in layout.tables]
        self.bar = {self.number[name] for name in layout.bar.nodes} if layout.bar else set()
        self.plates = problem.instant_kitchen and "plate" in layout.objects
        chairs = dict(start.chairs)
        self.chairs = tuple(chairs.get(table.name, table.chairs) for table in layout.tables)
        self.lends = any(count < room for count, room in zip(self.chairs, self.room))
        self.last = max((step for _, step, _ in layout.timetable), default=0)
        posts = {who: self.number[node] for who, node in start.waiters}
        self.staff: list[frozenset[int]] = []
        for clock in range(self.last + 1):
            posts |= {who: self.number[to] for who, at, to in layout.timetable if at == clock}
            self.staff.append(frozenset(posts.values()))

    # ------------------------------------------------------------ states

    def start(self) -> JointCode | None:
        """Returns the state at step 0, None where a robot would share its node."""
        state, index = self.problem.state, self.tables.index
        following = {robot.leads: k for k, robot in enumerate(state.robots) if robot.leads}
        sitting = {party: index(table) for table, party in state.seated}

        def tables(names: frozenset[str]) -> int:
            return sum(1 << index(name) for name in names)

        def things(pairs: frozenset[tuple[str, str]]) -> int:
            return sum(1 << self.thing(*pair) for pair in pairs)

        places = []
        for party in self.parties:
            led = following.get(party)
            places.append(sitting.get(party, WAITING) if led is None else -2 - led)
        nodes = tuple(self.number[robot.at] for robot in state.robots)
        loads = tuple(self.thing(*robot.carries) if robot.carries else -1 for robot in state.robots)
        code = (
            0,
            nodes,
            loads,
            tuple(tables(robot.orders) for robot in state.robots),
            tuple(places),
            tables(state.wants_bill),
            tables(state.paid),
            tables(state.ready_to_order),
            tables(state.sent),
            tables(state.served),
            things(state.ready),
            self._filled(nodes, loads, things(state.empty)),
            self.chairs,
        )
        shared = len(set(nodes)) < len(nodes) or self.staff[0].intersection(nodes)
        return None if shared else code

    def thing(self, table: str, item: str) -> int:
        """Returns the number of a table's object."""
        return self.tables.index(table) * 3 + OBJECTS.index(item)

    def _filled(self, nodes: Sequence[int], loads: Sequence[int], empty: int) -> int:
        """Returns what is empty once jugs and baskets that are carried at the bar are full."""
        for node, load in zip(nodes, loads):
            if load >= 0 and load % 3 and node in self.bar:
                empty &= ~(1 << load)
        return empty

    # ------------------------------------------------------------ steps

    def successors(self, code: JointCode) -> Iterator[tuple[tuple[Option | None, ...], JointCode]]:
        """Yields what the robots may do together, one entry a robot, and the state after it."""
        clock = min(code[CLOCK] + 1, self.last)
        after = self.staff[clock]
        each = [self._options(code, k) for k in range(len(self.robots))]
        here = code[NODES]

        def choose(
            k: int, chosen: list[Option | None], taken: dict[int, int]
        ) -> Iterator[list[Option | None]]:
            if k == len(each):
                yield chosen
                return
            for option in (None, *each[k]):
                node = here[k] if option is None else option.node
                if node in after or node in taken:
                    continue
                if option is not None:
                    if node != here[k]:  # nobody comes from there to here
                        other = next((j for j in range(k) if here[j] == node), None)
                        if (
                            other is not None
                            and chosen[other] is not None
                            and taken.get(here[k]) == other
                        ):
                            continue
                    if any(o is not None and _clash(o, option) for o in chosen):
                        continue
                yield from choose(k + 1, [*chosen, option], {**taken, node: k})

        for chosen in choose(0, [], {}):
            yield tuple(chosen), self._after(code, chosen, clock)

    def _after(self, code: JointCode, chosen: Sequence[Option | None], clock: int) -> JointCode:
        fields: list[Any] = list(code)
        fields[CLOCK] = clock
        lists: dict[int, list[int]] = {NODES: list(code[NODES])}
        for k, option in enumerate(chosen):
            if option is None:
                continue
            lists[NODES][k] = option.node
            for field, index, value in option.one:
                if field not in lists:
                    lists[field] = list(code[field])
                lists[field][index] = value
            for field, clear, add in option.bits:
                fields[field] = (fields[field] & ~clear) | add
        for k, option in enumerate(chosen):
            if (
                option is not None and option.name == "take_order"
            ):  # what was ordered before is history
                table = self.tables.index(option.arguments[0])
                held = lists[HELD]
                lists[HELD] = [
                    m | 1 << table if j == k else m & ~(1 << table) for j, m in enumerate(held)
                ]
        for field, values in lists.items():
            fields[field] = tuple(values)
        fields[EMPTY] = self._filled(fields[NODES], fields[LOADS], fields[EMPTY])
        return tuple(fields)

    def _options(self, code: JointCode, k: int) -> list[Option]:
        """Returns what robot ``k`` can do in a state, but for standing still."""
        here, load, places = code[NODES][k], code[LOADS][k], code[PLACES]
        staff = self.staff[code[CLOCK]]
        options = [
            Option("go_to", (self.nodes[node],), node)
            for node in self.next[here]
            if node not in staff
        ]
        led = places.index(-2 - k) if -2 - k in places else None
        taken = {place for place in places if place >= 0}
        if here == self.door and led is None and len(taken) < len(self.room):
            for who, place in enumerate(places):
                if place == WAITING:
                    one = ((PLACES, who, -2 - k),)
                    options.append(
                        Option("pick", (self.parties[who][0],), here, one, (), ("pick", who))
                    )
        for t in self.near[here]:
            options += self._at_table(code, k, t, led, taken)
        if here in self.bar:
            options += self._at_bar(code, k, load)
        return options

    def _at_table(
        self, code: JointCode, k: int, t: int, led: int | None, taken: set[int]
    ) -> Iterator[Option]:
        here, load, name, bit = code[NODES][k], code[LOADS][k], self.tables[t], 1 << t
        if led is not None and t not in taken:
            party = self.parties[led]
            if len(party) <= min(self.room[t], code[CHAIRS][t]):
                one = ((PLACES, led, t),)
                yield Option("seat", (party[0], name), here, one, (), ("seat", t))
        if t in taken and code[WANTS] & bit:
            bits: tuple[tuple[int, int, int], ...] = ((WANTS, bit, 0), (PAID, 0, bit))
            yield Option("give_bill", (name,), here, (), bits, ("bill", t))
        if self.bar and t in taken and code[EAGER] & bit:
            one = ((HELD, k, code[HELD][k] | bit),)
            bits = ((EAGER, bit, 0), (SENT, bit, 0), (SERVED, bit, 0))
            forbids = (("send", t), ("bring", t * 3))
            yield Option("take_order", (name,), here, one, bits, ("take", t), forbids)
        if load >= 0 and load // 3 == t and not code[EMPTY] >> load & 1:
            bits = ((SERVED, 0, bit),) if load % 3 == 0 else ()
            yield Option(
                "bring", (OBJECTS[load % 3], name), here, ((LOADS, k, -1),), bits, ("bring", load)
            )
        if self.bar and load == -1:
            for kind in (1, 2):
                thing = t * 3 + kind
                if code[EMPTY] >> thing & 1 and thing not in code[LOADS]:
                    one = ((LOADS, k, thing),)
                    yield Option("refill", (OBJECTS[kind], name), here, one, (), ("refill", thing))
        if self.lends:
            for count in range(code[CHAIRS][t] + 1, self.room[t] + 1):
                one = ((CHAIRS, t, count),)
                yield Option("bring_chairs", (name, str(count)), here, one, (), ("chairs", t))

    def _at_bar(self, code: JointCode, k: int, load: int) -> Iterator[Option]:
        here = code[NODES][k]
        for t, name in enumerate(self.tables):
            bit = 1 << t
            if code[HELD][k] & bit:
                one, bits = ((HELD, k, code[HELD][k] & ~bit),), [(SENT, 0, bit)]
                if self.plates:
                    bits.append((READY, 0, 1 << t * 3))
                forbids = (("take up", t * 3),) if self.plates else ()
                yield Option("send_order", (name,), here, one, tuple(bits), ("send", t), forbids)
        if load == -1:
            for thing in range(3 * len(self.tables)):
                if code[READY] >> thing & 1:
                    arguments = (OBJECTS[thing % 3], self.tables[thing // 3])
                    one, ready = ((LOADS, k, thing),), ((READY, 1 << thing, 0),)
                    yield Option("take_up", arguments, here, one, ready, ("take up", thing))

    def actions(self, chosen: Sequence[Option | None], step: int) -> Iterator[Action]:
        """Yields what is done at ``step``, as actions."""
        for name, option in zip(self.robots, chosen):
            if option is not None:
                yield Action(step, option.name, (name, *option.arguments))

    # ------------------------------------------------------------ goals

    def test(self, goal: Goal) -> Callable[[JointCode], bool]:
        """Returns the goal as a question to a state."""
        t = self.tables.index(goal.table) if goal.table is not None else -1
        bit = 1 << t if t >= 0 else 0
        who = next((k for k, p in enumerate(self.parties) if goal.party and goal.party[0] in p), -1)
        thing = t * 3 + (OBJECTS.index(goal.item) if goal.item is not None else 0)

        def paid(code: JointCode) -> bool:
            table = t if t >= 0 else code[PLACES][who]
            mask = 1 << table if table >= 0 else 0
            return table >= 0 and table in code[PLACES] and bool(code[PAID] & mask & ~code[WANTS])

        def any_held(code: JointCode) -> int:
            held = 0
            for mask in code[HELD]:
                held |= mask
            return held

        def served(code: JointCode) -> bool:
            if code[READY] >> thing & 1 or thing in code[LOADS]:
                return False
            if thing % 3:
                return not code[EMPTY] >> thing & 1
            return bool(code[SERVED] & bit) and (goal.item is not None or not any_held(code) & bit)

        def content(code: JointCode) -> bool:
            place = code[PLACES][who]
            if place < 0 or (code[WANTS] | code[EAGER] | any_held(code)) >> place & 1:
                return False
            loads = any(load >= 0 and load // 3 == place for load in code[LOADS])
            return not (code[READY] | code[EMPTY]) >> place * 3 & 7 and not loads

        if goal.kind == "at":
            node = self.number[goal.node or ""]
            if goal.robot is not None:
                k = self.robots.index(goal.robot)
                return lambda code: code[NODES][k] == node
            return lambda code: node in code[NODES]
        tests: dict[str, Callable[[JointCode], bool]] = {
            "seated": lambda code: code[PLACES][who] == t if t >= 0 else code[PLACES][who] >= 0,
            "paid": paid,
            "ordered": lambda code: bool((any_held(code) | code[SENT]) & bit),
            "sent": lambda code: bool(code[SENT] & bit),
            "served": served,
            "filled": lambda code: not code[EMPTY] >> thing & 1 and thing not in code[LOADS],
            "chairs": lambda code: code[CHAIRS][t] >= (goal.number or 0),
            "serve": content,
        }
        return tests[goal.kind]


def _clash(one: Option, other: Option) -> bool:
    """Returns whether two options do not go together."""
    if one.mark is None or other.mark is None:
        return False
    return one.mark == other.mark or one.mark in other.forbids or other.mark in one.forbids
