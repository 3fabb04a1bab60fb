"""Pairs of goals of every two kinds, in tiny restaurants where their parties are in every state.

`pair_problem` makes one problem of a seed: small enough to be searched whole in a few milliseconds,
and valid, as if it had been read from files.  The kinds of the pair follow from the seed, so a run
of as many seeds as there are pairs of kinds has each pair once.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party, State

__all__ = ["KINDS", "PAIRS", "goal_of", "pair_problem", "tiny_world"]

Maker = Callable[[Random, Layout, State], Goal]


def _party(rng: Random, state: State) -> Party:
    return rng.choice(state.parties())


def _table(rng: Random, layout: Layout) -> str:
    return rng.choice(layout.tables).name


def _refillable(rng: Random, layout: Layout) -> str:
    return rng.choice([item for item in layout.objects if item != "plate"])


MAKERS: dict[str, Maker] = {
    "seated": lambda r, la, s: Goal("seated", party=_party(r, s)),
    "seated at": lambda r, la, s: Goal("seated", party=_party(r, s), table=_table(r, la)),
    "paid table": lambda r, la, s: Goal("paid", table=_table(r, la)),
    "paid customer": lambda r, la, s: Goal("paid", party=_party(r, s)),
    "serve": lambda r, la, s: Goal("serve", party=_party(r, s)),
    "at": lambda r, la, s: Goal("at", node=r.choice(la.nodes).name),
    "ordered": lambda r, la, s: Goal("ordered", table=_table(r, la)),
    "sent": lambda r, la, s: Goal("sent", table=_table(r, la)),
    "served": lambda r, la, s: Goal("served", table=_table(r, la)),
    "served plate": lambda r, la, s: Goal("served", table=_table(r, la), item="plate"),
    "served object": lambda r, la, s: Goal("served", (), _table(r, la), None, _refillable(r, la)),
    "filled": lambda r, la, s: Goal("filled", (), _table(r, la), None, _refillable(r, la)),
    "chairs": lambda r, la, s: Goal("chairs", table=_table(r, la), number=r.randint(1, 3)),
}
KINDS = tuple(MAKERS)
PAIRS = tuple((first, second) for first in KINDS for second in KINDS)
NEEDS_A_BAR = {"ordered", "sent", "served", "served plate", "served object", "filled"}


def goal_of(kind: str, rng: Random, layout: Layout, state: State) -> Goal:
    """A goal of that kind by chance."""
    return MAKERS[kind](rng, layout, state)


def pair_problem(seed: int) -> Problem:
    """A tiny problem with a pair of goals: wanted in that order, or at once, or both."""
    rng = Random(f"pair {seed}")
    kinds = PAIRS[seed % len(PAIRS)]
    bar = rng.random() < 0.5 or bool(NEEDS_A_BAR & set(kinds))
    layout, state = tiny_world(rng, bar=bar)
    pair = (goal_of(kinds[0], rng, layout, state), goal_of(kinds[1], rng, layout, state))
    for _ in range(12 if rng.random() < 0.85 else 0):  # else most pairs would be hopeless
        if all(_worth_it(goal, layout, state) for goal in pair):
            break
        layout, state = tiny_world(rng, bar=bar)
        pair = (goal_of(kinds[0], rng, layout, state), goal_of(kinds[1], rng, layout, state))
    known = [kind for kind in KINDS if bar or kind not in NEEDS_A_BAR]
    before: list[tuple[Goal, Goal]] = []
    goals: list[Goal] = []
    way = rng.random()
    if way < 0.8:
        before.append(pair)
    if way >= 0.8 or rng.random() < 0.3:
        goals += pair
    elif rng.random() < 0.5:
        goals.append(rng.choice(pair))
    if rng.random() < 0.3:
        goals.append(goal_of(rng.choice(known), rng, layout, state))
    if before and rng.random() < 0.1:
        before.append((pair[1], goal_of(rng.choice(known), rng, layout, state)))
    return Problem(
        layout=layout,
        before_observations=state,
        observations=(),
        state=state,
        goals=tuple(dict.fromkeys(goals)),
        before=tuple(before),
        instant_kitchen="plate" in layout.objects and rng.random() < 0.5,
    )


def _worth_it(goal: Goal, layout: Layout, state: State) -> bool:
    """Whether a goal is none of those that hold already or that one sees to be impossible."""
    table = goal.table or (state.table_of(goal.party[0]) if goal.party else None)
    orders = state.ready_to_order | state.ordered
    things = state.ready | state.empty | ({state.carrying} if state.carrying else set())
    match goal.kind:
        case "seated":
            return state.table_of(goal.party[0]) is None and goal.table not in dict(state.seated)
        case "paid":
            return table in state.wants_bill if table else bool(state.wants_bill)
        case "at":
            return goal.node != state.agent
        case "ordered":
            return table in state.ready_to_order
        case "sent":
            return table in orders
        case "served" if goal.item in (None, "plate"):
            return table in orders | state.sent
        case "served" | "filled":
            return (table, goal.item) in things
        case "chairs":
            return (goal.number or 0) <= layout.table(table or "").capacity
    asked = state.wants_bill | orders | {name for name, _ in things}
    return table is None or table in asked


def tiny_world(rng: Random, *, bar: bool) -> tuple[Layout, State]:
    """Two to four nodes, one or two tables (now and then three), one to three parties."""
    nodes = [f"n{k}" for k in range(rng.choice((2, 2, 3, 3, 4)))]
    edges = [(nodes[rng.randrange(k)], nodes[k]) for k in range(1, len(nodes))]
    if rng.random() < 0.08:
        edges.pop()
    agent = rng.choice(nodes)
    tables = []
    for k in range(1 if bar and rng.random() < 0.3 else rng.choice((1, 2, 2, 2, 3 - bar))):
        near = tuple(rng.sample(nodes, rng.choice((1, 1, 2))))
        capacity = rng.choice((1, 1, 2))
        chairs = rng.randint(0, capacity) if rng.random() < 0.15 else capacity
        tables.append(Table(f"t{k}", capacity, near, None, (0.8, 0.8), chairs))
    others = [node for node in nodes if node != agent]
    waiters = {"w": rng.choice(others)} if rng.random() < 0.12 else {}
    parties, fields = _people(rng, tables, bar)
    objects = rng.choice((("plate", "jug", "basket"), ("plate", "jug"), ("plate", "basket")))
    if bar:
        _service(rng, tables, objects, fields)
    moves = ()
    if waiters and rng.random() < 0.4:
        moves = (("w", rng.randint(1, 3), rng.choice(nodes)),)
    layout = Layout(
        name="tiny",
        nodes=tuple(map(Node, nodes)),
        edges=tuple(edges),
        entrance=rng.choice(nodes),
        tables=tuple(tables),
        agent=agent,
        waiters=tuple(waiters.items()),
        bar=Bar(tuple(rng.sample(nodes, rng.choice((1, 1, 2))))) if bar else None,
        objects=objects if bar else (),
        timetable=moves,
        customers=sum(map(len, parties)),
    )
    chairs = tuple((table.name, table.chairs) for table in tables)
    return layout, State(agent, layout.waiters, chairs=chairs, **fields)


def _people(rng: Random, tables: list[Table], bar: bool) -> tuple[list[Party], dict]:  # type: ignore[type-arg]
    """Parties that sit, wait or follow; bills wanted (at free tables, too) and paid."""
    parties: list[Party] = []

    def party(most: int) -> Party:
        first = sum(map(len, parties)) + 1
        parties.append(tuple(f"c{first + k}" for k in range(rng.randint(1, max(1, most)))))
        return parties[-1]

    seated = {t.name: party(t.chairs) for t in tables if t.chairs and rng.random() < 0.45}
    free = len(tables) - len(seated)
    waiting = [party(2) for _ in range(min(2, rng.choice((0, 1, free, free))))]
    led: Party = ()
    if waiting and rng.random() < 0.25:
        led = waiting.pop()
    if not parties:
        waiting = [party(1)]
    wants = {t.name for t in tables if rng.random() < (0.5 if t.name in seated else 0.25)}
    paid = {name for name in seated if name not in wants and rng.random() < 0.25}
    fields = {
        "seated": tuple(sorted(seated.items())),
        "waiting": tuple(waiting),
        "with_agent": led,
        "wants_bill": frozenset(wants),
        "paid": frozenset(paid),
    }
    return parties, fields


def _service(rng: Random, tables: list[Table], objects: tuple[str, ...], fields: dict) -> None:  # type: ignore[type-arg]
    """Orders, plates and jugs on their way, whoever sits there."""
    marked: dict[str, set[str]] = {}
    ready, empty = set(), set()
    for table in tables:
        stage = rng.choice(("ready_to_order", "ordered", "sent", "served", ""))
        if stage == "ready_to_order" and table.name not in dict(fields["seated"]):
            stage = ""
        if stage:
            marked.setdefault(stage, set()).add(table.name)
        if stage == "served":
            marked.setdefault("sent", set()).add(table.name)
        if stage == "sent" and rng.random() < 0.6:
            ready.add((table.name, "plate"))
    things = [(table.name, item) for table in tables for item in objects if item != "plate"]
    for thing in rng.sample(things, min(rng.choice((0, 1, 1, 2)), len(things))):
        rng.choice((empty, empty, ready)).add(thing)
    carrying = rng.choice(sorted(ready | empty)) if ready | empty and rng.random() < 0.3 else None
    fields.update({stage: frozenset(names) for stage, names in marked.items()})
    fields.update(ready=frozenset(ready - {carrying}), empty=frozenset(empty), carrying=carrying)
