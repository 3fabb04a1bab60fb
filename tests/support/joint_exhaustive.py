"""Several robots, every joint state: the oracle of their planner and validator.

Written from the table of actions and the rules of what may happen at one step, apart from
`waiter_cli.rules`, `waiter_cli.fleets` and the SPARC program, and in another style: a state is the
clock, a tuple of the robots' nodes and a set of facts; an action is what it needs, adds and deletes.
Actions of one step go together when no two do the same thing to the same thing, and none adds what
another one deletes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import NamedTuple

from tests.support.exhaustive import Outcome, TooLarge
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

Facts = frozenset[tuple[object, ...]]


class Joint(NamedTuple):
    """A joint state."""

    clock: int
    at: tuple[str, ...]
    facts: Facts


class Deed(NamedTuple):
    """What one robot does: its text, where it is afterwards, what it adds, deletes and is done to."""

    text: str
    to: str
    add: Facts
    delete: Facts
    done: tuple[object, ...] | None


class Fleet:
    """The rules for one problem."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.layout = problem, problem.layout
        self.robots = [name for name, _ in problem.layout.agents]
        self.tables = {table.name: table for table in self.layout.tables}
        self.bar = set(self.layout.bar.nodes) if self.layout.bar else set()
        self.last = max((step for _, step, _ in self.layout.timetable), default=0)
        self.size = {party[0]: len(party) for party in problem.state.parties()}
        self.leader = {name: party[0] for party in problem.state.parties() for name in party}

    def posts(self, clock: int) -> set[str]:
        """Where colleagues stand."""
        found = dict(self.problem.state.waiters)
        for who, step, node in sorted(self.layout.timetable, key=lambda entry: entry[1]):
            if step <= clock:
                found[who] = node
        return set(found.values())

    def encode(self, state: State, step: int) -> Joint:
        """A state of the product."""
        facts: set[tuple[object, ...]] = set()
        for party in state.waiting:
            facts.add(("wait", party[0]))
        for table, party in state.seated:
            facts.add(("sits", party[0], table))
        for robot in state.robots:
            if robot.leads:
                facts.add(("led", robot.name, robot.leads[0]))
            if robot.carries:
                facts.add(("carry", robot.name, robot.carries[1], robot.carries[0]))
            facts |= {("order", robot.name, table) for table in robot.orders}
        for word, tables in (
            ("bill", state.wants_bill), ("paid", state.paid), ("eager", state.ready_to_order),
            ("sent", state.sent), ("served", state.served),
        ):  # fmt: skip
            facts |= {(word, table) for table in tables}
        facts |= {("ready", item, table) for table, item in state.ready}
        facts |= {("empty", item, table) for table, item in state.empty}
        chairs = dict(state.chairs)
        facts |= {("chairs", t.name, chairs.get(t.name, t.chairs)) for t in self.layout.tables}
        at = tuple(robot.at for robot in state.robots)
        return Joint(min(step, self.last), at, frozenset(facts))

    def arrive(self, state: Joint) -> Joint | None:
        """The state with jugs at the bar full; None where two are on one node."""
        if len(set(state.at)) < len(state.at) or self.posts(state.clock) & set(state.at):
            return None
        full = {
            ("empty", item, table)
            for name, item, table in (fact[1:] for fact in state.facts if fact[0] == "carry")
            if item != "plate" and state.at[self.robots.index(str(name))] in self.bar
        }
        return state._replace(facts=state.facts - full)

    def deeds(self, state: Joint, k: int) -> Iterator[Deed]:
        """What robot number ``k`` may do, standing still first."""
        me, here, facts = self.robots[k], state.at[k], state.facts
        none: Facts = frozenset()
        yield Deed("", here, none, none, None)
        for a, b in self.layout.edges:
            for start, end in ((a, b), (b, a)) if (a, b) not in self.layout.one_way else ((a, b),):
                if start == here and end not in self.posts(state.clock):
                    yield Deed(f"go_to({me},{end})", end, none, none, None)

        def deed(words: str, add: set[object], delete: set[object], *done: object) -> Deed:
            return Deed(words, here, frozenset(add), frozenset(delete), done)  # type: ignore[arg-type]

        taken = {fact[2]: fact[1] for fact in facts if fact[0] == "sits"}
        mine = [str(fact[2]) for fact in facts if fact[:2] == ("led", me)]
        loads = {fact[2:] for fact in facts if fact[:2] == ("carry", me)}
        others = {fact[2:] for fact in facts if fact[0] == "carry"}
        if here == self.layout.entrance and not mine and len(taken) < len(self.tables):
            for fact in facts:
                if fact[0] == "wait":
                    who = fact[1]
                    yield deed(f"pick({me},{who})", {("led", me, who)}, {fact}, "pick", who)
        for t, table in self.tables.items():
            if here not in table.nodes:
                continue
            chairs = next(int(str(fact[2])) for fact in facts if fact[:2] == ("chairs", t))
            for who in mine:
                if t not in taken and self.size[who] <= min(table.capacity, chairs):
                    yield deed(
                        f"seat({me},{who},{t})", {("sits", who, t)}, {("led", me, who)}, "seat", t
                    )
            if ("bill", t) in facts and t in taken:
                yield deed(f"give_bill({me},{t})", {("paid", t)}, {("bill", t)}, "bill", t)
            if self.bar and ("eager", t) in facts and t in taken:
                gone: set[object] = {("order", other, t) for other in self.robots if other != me}
                gone |= {("eager", t), ("sent", t), ("served", t)}
                yield deed(f"take_order({me},{t})", {("order", me, t)}, gone, "order", t)
            for item in ("plate", "jug", "basket"):
                thing = ("empty", item, t)
                if (item, t) in loads and thing not in facts:
                    add: set[object] = {("served", t)} if item == "plate" else set()
                    carried = {("carry", me, item, t)}
                    yield deed(f"bring({me},{item},{t})", add, set(carried), "bring", item, t)
                if (
                    self.bar
                    and item != "plate"
                    and thing in facts
                    and not loads
                    and (item, t) not in others
                ):
                    yield deed(
                        f"refill({me},{item},{t})",
                        {("carry", me, item, t)},
                        set(),
                        "refill",
                        item,
                        t,
                    )
            if any(
                t.capacity > dict(self.problem.state.chairs).get(t.name, t.chairs)
                for t in self.tables.values()
            ):
                for number in range(chairs + 1, table.capacity + 1):
                    yield deed(
                        f"bring_chairs({me},{t},{number})",
                        {("chairs", t, number)}, {("chairs", t, chairs)}, "chairs", t,
                    )  # fmt: skip
        if here in self.bar:
            for fact in facts:
                if fact[:2] == ("order", me):
                    add = {("sent", fact[2])}
                    if self.problem.instant_kitchen and "plate" in self.layout.objects:
                        add.add(("ready", "plate", fact[2]))
                    yield deed(f"send_order({me},{fact[2]})", add, {fact}, "send", fact[2])
                if fact[0] == "ready" and not loads:
                    _, item, t = fact  # type: ignore[misc]
                    yield deed(
                        f"take_up({me},{item},{t})", {("carry", me, item, t)}, {fact}, "up", item, t
                    )

    def successors(self, state: Joint) -> Iterator[tuple[tuple[str, ...], Joint]]:
        """Every joint step from a state with where it leads."""
        clock = min(state.clock + 1, self.last)
        for deeds in product(*(list(self.deeds(state, k)) for k in range(len(self.robots)))):
            to = tuple(deed.to for deed in deeds)
            swapped = any(
                to[j] == state.at[k] and to[k] == state.at[j]
                for j in range(len(to))
                for k in range(j)
            )
            done = [deed.done for deed in deeds if deed.done is not None]
            add = frozenset[tuple[object, ...]]().union(*(deed.add for deed in deeds))
            delete = frozenset[tuple[object, ...]]().union(*(deed.delete for deed in deeds))
            if swapped or len(set(done)) < len(done) or add & delete:
                continue
            after = self.arrive(Joint(clock, to, (state.facts - delete) | add))
            if after is not None:
                yield tuple(deed.text for deed in deeds if deed.text), after

    def test(self, goal: Goal) -> Callable[[Joint], bool]:
        """A goal as a question."""
        t, item = goal.table, goal.item
        who = self.leader[goal.party[0]] if goal.party else None

        def table_of(facts: Facts) -> object:
            return next((fact[2] for fact in facts if fact[:2] == ("sits", who)), None)

        def moved(facts: Facts, what: str) -> bool:
            return ("ready", what, t) in facts or any(
                fact[0] == "carry" and fact[2:] == (what, t) for fact in facts
            )

        def held(facts: Facts, table: object) -> bool:
            return any(fact[0] == "order" and fact[2] == table for fact in facts)

        def paid(facts: Facts) -> bool:
            at = t or table_of(facts)
            sits = any(fact[0] == "sits" and fact[2] == at for fact in facts)
            return sits and ("paid", at) in facts and ("bill", at) not in facts

        def served(facts: Facts) -> bool:
            if moved(facts, item or "plate"):
                return False
            if item in ("jug", "basket"):
                return ("empty", item, t) not in facts
            return ("served", t) in facts and (item is not None or not held(facts, t))

        def content(facts: Facts) -> bool:
            at = table_of(facts)
            if at is None or held(facts, at):
                return False
            words = [
                fact for fact in facts if fact[0] in ("bill", "eager", "ready", "empty", "carry")
            ]
            return not any(fact[-1] == at for fact in words)

        def seated(facts: Facts) -> bool:
            at = table_of(facts)
            return at is not None and t in (None, at)

        match goal.kind:
            case "at" if goal.robot is not None:
                k = self.robots.index(goal.robot)
                return lambda state: state.at[k] == goal.node
            case "at":
                return lambda state: goal.node in state.at
            case "seated":
                return lambda state: seated(state.facts)
            case "paid":
                return lambda state: paid(state.facts)
            case "ordered":
                return lambda state: held(state.facts, t) or ("sent", t) in state.facts
            case "sent":
                return lambda state: ("sent", t) in state.facts
            case "served":
                return lambda state: served(state.facts)
            case "filled":
                thing = ("empty", item, t)
                return lambda state: (
                    thing not in state.facts
                    and not any(
                        fact[0] == "carry" and fact[2:] == (item, t) for fact in state.facts
                    )
                )
            case "chairs":
                return lambda state: any(
                    fact[:2] == ("chairs", t) and int(str(fact[2])) >= (goal.number or 0)
                    for fact in state.facts
                )
        return lambda state: content(state.facts)


def shortest_together(problem: Problem, limit: int = 30_000, required: str = "") -> Outcome:
    """The length of a shortest plan by trying everything; `TooLarge` beyond so many steps looked at.

    Where an action is ``required``, of a shortest plan that has it before the goals hold.
    """
    fleet = Fleet(problem)
    wanted = [fleet.test(goal) for goal in problem.goals]
    pairs = [(fleet.test(early), fleet.test(late)) for early, late in problem.before]
    start = fleet.arrive(fleet.encode(problem.state, 0))
    if start is None:
        return Outcome(None, 0)

    def advance(state: Joint, history: tuple[int, ...]) -> tuple[int, ...] | None:
        """Of each pair 0: none has held yet, 1: the early one, 2: both, in order; None: out of order."""
        out = []
        for (early, late), so_far in zip(pairs, history):
            first, second = early(state), late(state)
            if so_far == 0 and second:
                return None
            out.append(2 if so_far == 1 and second else 1 if so_far == 0 and first else so_far)
        return tuple(out)

    history = advance(start, (0,) * len(pairs))
    if history is None:
        return Outcome(None, 1)
    first = (start, history, not required)
    seen, edge, length, looked = {first}, [first], 0, 0
    while edge:
        over = [
            all(mark == 2 for mark in marks) and all(test(state) for test in wanted)
            for state, marks, _ in edge
        ]
        if any(held and had for held, (_, _, had) in zip(over, edge)):
            return Outcome(length, len(seen))
        fresh = []
        for held, (state, marks, had) in zip(over, edge):
            for texts, after in () if held else fleet.successors(state):
                looked += 1
                later = advance(after, marks)
                if later is None:
                    continue
                node = (after, later, had or required in texts)
                if node not in seen:
                    seen.add(node)
                    fresh.append(node)
            if looked > limit:
                raise TooLarge(f"more than {limit} steps")
        edge, length = fresh, length + 1
    return Outcome(None, len(seen))


def fewest_actions(problem: Problem, length: int, limit: int = 30_000) -> int:
    """The fewest actions of all plans of ``length`` steps, of a problem without ``before``."""
    fleet = Fleet(problem)
    wanted = [fleet.test(goal) for goal in problem.goals]
    start = fleet.arrive(fleet.encode(problem.state, 0))
    assert start is not None and not problem.before
    layer, looked = {start: 0}, 0
    for _ in range(length):
        fresh: dict[Joint, int] = {}
        for state, cost in layer.items():
            for texts, after in fleet.successors(state):
                looked += 1
                total = cost + len(texts)
                if total < fresh.get(after, total + 1):
                    fresh[after] = total
            if looked > limit:
                raise TooLarge(f"more than {limit} steps")
        layer = fresh
    return min(cost for state, cost in layer.items() if all(test(state) for test in wanted))
