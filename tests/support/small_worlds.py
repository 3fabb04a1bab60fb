"""Small restaurants by chance, small enough to be searched whole, and strange enough to matter.

`small_case` gives a problem and, where it was spoiled on purpose, the reason why it cannot be
solved; `small_problem` gives the problem alone.  The same seed gives the same problem.  Values are
made directly, without YAML, and are consistent: what they say could have been read from a file.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random

from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party, Robot, State

REFILLABLE = ("jug", "basket")
NAMES = ("a", "i", "x", "n0_1", "door", "no", "on", "t", "s", "node", "step", "aB", "nil", "n_")


@dataclass(frozen=True)
class SmallCase:
    """A problem; ``spoiled`` names the reason why it cannot be solved, None: nothing was done."""

    problem: Problem
    spoiled: str | None = None


@dataclass
class _World:
    """A problem in the making: mutable, in the shape that is convenient to change."""

    rng: Random
    nodes: list[str]
    edges: list[tuple[str, str]]
    entrance: str
    agent: str
    tables: dict[str, Table]
    waiters: dict[str, str]
    bar: tuple[str, ...] = ()
    objects: tuple[str, ...] = ()
    timetable: list[tuple[str, int, str]] = field(default_factory=list)
    seated: dict[str, Party] = field(default_factory=dict)
    waiting: list[Party] = field(default_factory=list)
    led: Party = ()
    tables_that: dict[str, set[str]] = field(default_factory=dict)
    ready: set[tuple[str, str]] = field(default_factory=set)
    empty: set[tuple[str, str]] = field(default_factory=set)
    carrying: tuple[str, str] | None = None
    goals: list[Goal] = field(default_factory=list)
    before: list[tuple[Goal, Goal]] = field(default_factory=list)
    instant: bool = False
    guests: int = 0

    def party(self, size: int) -> Party:
        """A new party of that size."""
        self.guests += size
        return tuple(f"c{k}" for k in range(self.guests - size + 1, self.guests + 1))

    def marked(self, what: str) -> set[str]:
        """The tables of which ``what`` (the name of a set in `State`) holds."""
        return self.tables_that.setdefault(what, set())

    def chance(self, likelihood: float) -> bool:
        """True as often as that."""
        return self.rng.random() < likelihood

    def reached(self, avoiding: set[str]) -> set[str]:
        """The nodes that the agent can get to when some are closed."""
        found, rest = {self.agent}, [self.agent]
        while rest:
            here = rest.pop()
            for edge in self.edges:
                for a, b in (edge, edge[::-1]):
                    if a == here and b not in found and b not in avoiding:
                        found.add(b)
                        rest.append(b)
        return found

    def keeps_open(self, node: str) -> bool:
        """Whether entrance and tables can still be reached when a waiter stands on ``node`` too."""
        found = self.reached({node, *self.waiters.values()})
        near = (table.nodes for table in self.tables.values())
        return self.entrance in found and all(found.intersection(nodes) for nodes in near)

    @property
    def free(self) -> list[str]:
        """Tables at which nobody sits."""
        return [name for name in self.tables if name not in self.seated]


def small_problem(seed: int, *, full: bool = True) -> Problem:
    """A small problem; with ``full`` false only the four actions of the simple restaurant occur."""
    return small_case(seed, full=full).problem


def one_way_problem(seed: int) -> Problem:
    """A small problem in a restaurant some of whose paths lead one way only."""
    rng, problem = Random(f"one way {seed}"), small_problem(seed)
    layout = problem.layout
    turned = tuple(edge if rng.random() < 0.5 else edge[::-1] for edge in layout.edges)
    few = rng.random() * 0.7
    one_way = frozenset(edge for edge in turned if rng.random() < few)
    if rng.random() < 0.5 and len(layout.nodes) > 2:  # often a way round, so that not all is lost
        ends = (layout.nodes[-1].name, layout.nodes[0].name)
        if ends not in turned and ends[::-1] not in turned:
            turned, one_way = (*turned, ends), one_way | {ends}
    return replace(problem, layout=replace(layout, edges=turned, one_way=one_way))


def small_case(seed: int, *, full: bool = True) -> SmallCase:
    """A small problem and how it was spoiled, if it was."""
    rng = Random(f"small {seed} {full}")
    world = _rooms(rng)
    _people(world)
    if full and world.chance(0.5):
        _service(world)
    if full and world.chance(0.2):
        _few_chairs(world)
    if full and world.waiters and world.chance(0.4):
        _walks(world)
    everybody = world.chance(0.5)
    world.goals = _everybody(world)
    if not everybody:
        _wishes(world, full)
    spoiled = None
    if world.chance(0.22):
        kinds = [kind for kind in SPOILERS if full or kind not in FULL_ONLY]
        kind = rng.choice(kinds)
        if SPOILERS[kind](world):
            spoiled, everybody = kind, False
    return SmallCase(_freeze(world, seed, everybody), spoiled)


def _rooms(rng: Random) -> _World:
    """Nodes along a path with side branches and an odd short cut; tables beside them."""
    count = rng.choice((3, 4, 5, 5, 6, 6, 7, 8))
    strange = rng.random() < 0.2
    nodes = rng.sample(NAMES, count) if strange else [f"n{k}" for k in range(count)]
    edges = [(nodes[max(0, k - rng.choice((1, 1, 1, 2)))], nodes[k]) for k in range(1, count)]
    for _ in range(rng.choice((0, 0, 1, 2))):
        pair = tuple(rng.sample(nodes, 2))
        if pair not in edges and pair[::-1] not in edges:
            edges.append((pair[0], pair[1]))
    half = nodes[: (count + 1) // 2]
    tables = {}
    for k in range(rng.choice((1, 2, 2, 3, 3, 4))):
        near = tuple(rng.sample(nodes if rng.random() < 0.4 else half, rng.choice((1, 1, 2))))
        capacity = rng.choice((1, 2, 2, 3, 4))
        tables[f"table{k + 1}"] = Table(f"table{k + 1}", capacity, near, None, (0.8, 0.8), capacity)
    entrance = nodes[-1] if rng.random() < 0.5 else rng.choice(nodes)
    agent = nodes[0] if rng.random() < 0.5 else rng.choice(nodes)
    world = _World(rng, nodes, edges, entrance, agent, tables, {})
    for k in range(rng.choice((0, 0, 0, 1, 1, 2))):
        open_ = [n for n in nodes if n != agent and n not in world.waiters.values()]
        if world.chance(0.85):  # out of the way
            open_ = [n for n in open_ if world.keeps_open(n)]
        if open_:
            world.waiters[f"w{k + 1}"] = rng.choice(open_)
    return world


def _people(world: _World) -> None:
    """Parties that wait, follow or sit, with bills wanted here and there, and paid."""
    rng = world.rng
    for name, table in world.tables.items():
        if world.chance(0.25):
            world.seated[name] = world.party(rng.randint(1, table.capacity))
    free = rng.sample(world.free, len(world.free))
    careless = world.chance(0.1)  # then sizes and number need not fit
    for name in free[: rng.choice((0, 1, 1, 2, 2, 2, 3))]:
        most = 4 if careless else world.tables[name].capacity
        world.waiting.append(world.party(rng.randint(1, most)))
    if careless and world.chance(0.3):
        world.waiting.append(world.party(1))
    if world.waiting and world.chance(0.15):
        world.led = world.waiting.pop(0)
    for name in world.tables:
        if world.chance(0.5 if name in world.seated else 0.06):
            world.marked("wants_bill").add(name)
        elif name in world.seated and world.chance(0.15):
            world.marked("paid").add(name)


def _service(world: _World) -> None:
    """A bar with its objects, and orders, plates and jugs on their way."""
    rng = world.rng
    world.bar = tuple(rng.sample(world.nodes, rng.choice((1, 1, 2))))
    world.objects = rng.choice(
        (("plate", "jug", "basket"), ("plate", "jug", "basket"), ("plate",), ("jug",), ("basket",))
    )
    world.instant = "plate" in world.objects and world.chance(0.4)
    world.waiting = world.waiting[:2]  # keeps the number of states small
    for name in rng.sample(sorted(world.tables), min(2, len(world.tables))):
        if name not in world.seated:
            if world.waiting or world.led:
                continue
            world.seated[name] = world.party(1)
        stage = rng.choice(("ready_to_order", "ready_to_order", "ordered", "sent", "served", ""))
        if stage:
            world.marked(stage).add(name)
        if stage == "served":
            world.marked("sent").add(name)
        if stage == "sent" and "plate" in world.objects and world.chance(0.7):
            world.ready.add((name, "plate"))
    things = [(name, item) for name in world.tables for item in world.objects if item != "plate"]
    for thing in rng.sample(things, min(rng.choice((0, 1, 1, 2)), len(things))):
        rng.choice((world.empty, world.empty, world.ready)).add(thing)
    if world.chance(0.2) and (world.ready or world.empty):
        world.carrying = rng.choice(sorted(world.ready | world.empty))
        world.ready.discard(world.carrying)


def _few_chairs(world: _World) -> None:
    """Chairs are missing at some tables, never below those who sit there."""
    for name, table in world.tables.items():
        least = len(world.seated.get(name, ()))
        world.tables[name] = replace(table, chairs=world.rng.randint(least, table.capacity))


def _walks(world: _World) -> None:
    """A waiter who will stand elsewhere from some step on, never on a node of another waiter."""
    waiter = world.rng.choice(sorted(world.waiters))
    others = {node for who, node in world.waiters.items() if who != waiter}
    step, place = 0, world.waiters[waiter]
    for _ in range(world.rng.choice((1, 1, 2))):
        step += world.rng.randint(1, 4)
        places = [n for n in world.nodes if n not in others]
        harmless = [n for n in places if n != world.agent and world.keeps_open(n)]
        place = world.rng.choice(harmless if harmless and world.chance(0.8) else places)
        world.timetable.append((waiter, step, place))


def _everybody(world: _World) -> list[Goal]:
    """The goals of serving everybody, in their order."""
    parties = ([world.led] if world.led else []) + world.waiting
    goals = [Goal("seated", party=party) for party in parties]
    goals += [Goal("paid", table=name) for name in sorted(world.marked("wants_bill"))]
    asked = sorted(world.marked("ready_to_order") | world.marked("ordered"))
    goals += [Goal("served" if world.instant else "sent", table=name) for name in asked]
    goals += [Goal("served", table=name, item=item) for name, item in sorted(world.ready)]
    if world.carrying is not None:
        kind = "served" if world.carrying[1] == "plate" else "filled"
        goals.append(Goal(kind, table=world.carrying[0], item=world.carrying[1]))
    left = sorted(world.empty - {world.carrying})
    return goals + [Goal("filled", table=name, item=item) for name, item in left]


def _wishes(world: _World, full: bool) -> None:
    """Some of the goals of everybody, others beside them, now and then in an order."""
    rng = world.rng
    world.goals = [goal for goal in world.goals if world.chance(0.7)]
    parties = ([world.led] if world.led else []) + world.waiting
    wishes: list[Goal] = [Goal("at", node=rng.choice(world.nodes))]
    for party in parties if world.free else ():
        fitting = [t for t in world.free if world.tables[t].capacity >= len(party)]
        wishes.append(Goal("seated", party=party, table=rng.choice(fitting or world.free)))
    for name in sorted(world.marked("wants_bill")):
        party = world.seated.get(name, (*parties, ())[0])
        wishes += [Goal("paid", table=name), *([Goal("paid", party=party)] if party else [])]
    for party in (*parties, *world.seated.values()):
        wishes += [Goal("serve", party=party)] * (2 if full else 0)
    if world.bar:
        for name in sorted(world.marked("ready_to_order") | world.marked("ordered")):
            wishes.append(Goal("ordered", table=name))
            wishes += [Goal("served", table=name)] * world.instant
        wishes += [Goal("served", table=name, item=item) for name, item in sorted(world.empty)]
    if any(table.chairs < table.capacity for table in world.tables.values()):
        for name, table in world.tables.items():
            wishes.append(Goal("chairs", table=name, number=rng.randint(1, table.capacity)))
    chosen = rng.sample(wishes, min(len(wishes), rng.choice((1, 1, 2))))
    world.goals = list(dict.fromkeys(world.goals + chosen))
    rng.shuffle(world.goals)
    if len(world.goals) >= 2 and world.chance(0.3):
        first, second = rng.sample(world.goals, 2)
        world.before.append((first, second))
        if first.kind == "at":  # what is passed on the way need not hold at the end
            world.goals.remove(first)


def _too_big(world: _World) -> bool:
    party = world.party(max(table.capacity for table in world.tables.values()) + 1)
    world.waiting.append(party)
    world.goals.append(Goal("seated", party=party))
    return True


def _unreachable_table(world: _World) -> bool:
    lost = world.rng.choice(sorted(world.tables))
    if lost in world.seated or not world.waiting:
        return False
    world.nodes.append("island")
    world.tables[lost] = replace(world.tables[lost], nodes=("island",))
    party = world.waiting[0]
    world.goals = [g for g in world.goals if g.kind != "seated" or g.party != party]
    world.goals.append(Goal("seated", party=party, table=lost))
    return True


def _blocked_aisle(world: _World) -> bool:
    if world.timetable or not world.waiting or Goal("seated", world.waiting[0]) not in world.goals:
        return False
    for node in world.rng.sample(world.nodes, len(world.nodes)):
        apart = node == world.entrance or world.entrance not in world.reached({node})
        if apart and node not in (world.agent, *world.waiters.values()):
            world.waiters["w9"] = node
            return True
    return False


def _bill_at_a_free_table(world: _World) -> bool:
    able = {table for table in world.free if world.tables[table].capacity}
    if not able:
        return False
    parties = ([world.led] if world.led else []) + world.waiting
    table = world.rng.choice(sorted(able))
    if any(len(party) <= world.tables[table].capacity for party in parties):
        return False
    world.marked("wants_bill").add(table)
    world.goals.append(Goal("paid", table=table))
    return True


def _bill_not_wanted(world: _World) -> bool:
    content = sorted(set(world.seated) - world.marked("wants_bill") - world.marked("paid"))
    if not content:
        return False
    world.goals.append(Goal("paid", table=world.rng.choice(content)))
    return True


def _too_many_parties(world: _World) -> bool:
    for _ in range(1 + len(world.free) - len(world.waiting) - bool(world.led)):
        world.waiting.append(world.party(1))
    parties = ([world.led] if world.led else []) + world.waiting
    world.goals = [g for g in world.goals if g.kind != "seated"]
    world.goals += [Goal("seated", party=party) for party in parties]
    return len(world.waiting) <= 3


def _taken_table(world: _World) -> bool:
    if not world.seated or not world.waiting:
        return False
    table = world.rng.choice(sorted(world.seated))
    world.goals.append(Goal("seated", party=world.waiting[0], table=table))
    return True


def _waiter_on_the_goal(world: _World) -> bool:
    posts = sorted(set(world.waiters.values()))
    if world.timetable or not posts:
        return False
    world.goals.append(Goal("at", node=world.rng.choice(posts)))
    return True


def _order_of_what_holds(world: _World) -> bool:
    if not world.goals:
        return False
    world.before.append((world.goals[0], Goal("at", node=world.agent)))
    return True


def _nothing_ordered(world: _World) -> bool:
    if not world.bar:
        return False
    asked = ("ready_to_order", "ordered", "sent", "served")
    silent = sorted(set(world.tables).difference(*(world.marked(what) for what in asked)))
    if not silent:
        return False
    world.goals.append(Goal("ordered", table=world.rng.choice(silent)))
    return True


def _too_many_chairs(world: _World) -> bool:
    table = world.tables[world.rng.choice(sorted(world.tables))]
    world.goals.append(Goal("chairs", table=table.name, number=table.capacity + 1))
    return True


SPOILERS: dict[str, Callable[[_World], bool]] = {
    "too big": _too_big,
    "unreachable table": _unreachable_table,
    "blocked aisle": _blocked_aisle,
    "bill at a free table": _bill_at_a_free_table,
    "bill not wanted": _bill_not_wanted,
    "too many parties": _too_many_parties,
    "taken table": _taken_table,
    "waiter on the goal": _waiter_on_the_goal,
    "order of what holds": _order_of_what_holds,
    "nothing ordered": _nothing_ordered,
    "too many chairs": _too_many_chairs,
}
FULL_ONLY = ("nothing ordered", "too many chairs")


def _freeze(world: _World, seed: int, everybody: bool) -> Problem:
    layout = Layout(
        name=f"small{seed}",
        nodes=tuple(map(Node, world.nodes)),
        edges=tuple(world.edges),
        entrance=world.entrance,
        tables=tuple(world.tables.values()),
        agent=world.agent,
        waiters=tuple(sorted(world.waiters.items())),
        bar=Bar(world.bar) if world.bar else None,
        objects=world.objects,
        timetable=tuple(sorted(world.timetable, key=lambda entry: (entry[1], entry))),
        customers=world.guests,
    )
    state = State(
        agent=world.agent,
        waiters=layout.waiters,
        seated=tuple(sorted(world.seated.items())),
        waiting=tuple(world.waiting),
        with_agent=world.led,
        ready=frozenset(world.ready),
        empty=frozenset(world.empty),
        carrying=world.carrying,
        chairs=tuple(sorted((t.name, t.chairs) for t in layout.tables)),
        **{what: frozenset(tables) for what, tables in world.tables_that.items()},
    )
    return Problem(
        layout=layout,
        before_observations=state,
        observations=(),
        state=state,
        goals=tuple(world.goals),
        before=tuple(world.before),
        instant_kitchen=world.instant,
        everybody=everybody,
    )


def fleet_problem(seed: int) -> Problem:
    """A small problem for two or three robots, few enough to be searched whole."""
    rng = Random(f"fleet {seed}")
    while True:
        make = one_way_problem if rng.random() < 0.25 else small_problem
        number = rng.randrange(10**6)
        if rng.random() < 0.8 and small_case(number).spoiled:
            continue
        problem = make(number)
        layout, state = problem.layout, problem.state
        count = 3 if rng.random() < 0.15 else 2
        posts = {node for _, node in state.waiters} | {state.agent}
        posts |= {node for _, _, node in layout.timetable if rng.random() < 0.8}
        free = [node.name for node in layout.nodes if node.name not in posts]
        layout = _with_ways_round(layout, rng)
        few = len(layout.nodes) <= (4 if count == 3 else 6) and len(layout.tables) <= 3
        if few and len(free) >= count - 1 and len(state.parties()) <= 3:
            break
    starts = [state.agent, *rng.sample(free, count - 1)]
    names = [f"r{k + 1}" for k in range(count)]
    order = rng.sample(range(count), count)  # the first need not have all that the one robot had
    agents = tuple((names[k], starts[order[k]]) for k in range(count))
    robots = []
    for name, at in agents:
        own = at == state.agent
        robots.append(
            Robot(
                name, at, state.with_agent if own else (), state.carrying if own else None,
                state.ordered if own else frozenset(),
            )
        )  # fmt: skip
    if rng.random() < 0.4 and state.ordered:  # another one has taken an order
        table = min(state.ordered)
        robots = [replace(r, orders=r.orders - {table}) for r in robots]
        k = rng.randrange(count)
        robots[k] = replace(robots[k], orders=robots[k].orders | {table})
    goals, nodes = list(problem.goals), [node.name for node in layout.nodes]
    if rng.random() < 0.45:
        ends = rng.sample(nodes, count)
        if rng.random() < 0.5:  # the robots change places
            ends = [at for _, at in agents[1:]] + [agents[0][1]]
        wanted = [Goal("at", node=end, robot=name) for name, end in zip(names, ends)]
        goals = [g for g in goals if g.kind != "at" or rng.random() < 0.3] + wanted[
            : rng.choice((1, count, count))
        ]
        goals = rng.sample(goals, len(goals))[-3:] if rng.random() < 0.5 else goals
    together = replace(
        state, agent="", with_agent=(), carrying=None, ordered=frozenset(), robots=tuple(robots)
    )
    return replace(
        problem,
        layout=replace(layout, agent=agents[0][1], agents=agents),
        state=together,
        before_observations=together,
        goals=tuple(dict.fromkeys(goals)),
    )


def burdened_problem(seed: int) -> Problem:
    """As `fleet_problem`: several robots lead a party or carry something, wanted or not."""
    rng, problem = Random(f"burdened {seed}"), fleet_problem(seed)
    state, robots = problem.state, list(problem.state.robots)
    waiting, ready, empty = list(state.waiting), set(state.ready), set(state.empty)
    strangers = ("s1", "s2", "s3")[: rng.choice((1, 2, 3))]
    for k, robot in enumerate(robots):
        if robot.leads or robot.carries or rng.random() < 0.2:
            continue
        things = sorted(ready | empty)
        if waiting and rng.random() < 0.6:
            robots[k] = replace(robot, leads=waiting.pop(rng.randrange(len(waiting))))
        elif things and rng.random() < 0.7:
            thing = rng.choice(things)
            ready.discard(thing)
            robots[k] = replace(robot, carries=thing)
            if thing[1] != "plate" and rng.random() < 0.5:
                empty.discard(thing)
        elif strangers not in [other.leads for other in robots]:
            robots[k] = replace(robot, leads=strangers)
    goals = [goal for goal in problem.goals if rng.random() < 0.8] or list(problem.goals)
    burdened = replace(
        state, robots=tuple(robots), waiting=tuple(waiting), ready=frozenset(ready),
        empty=frozenset(empty),
    )  # fmt: skip
    return replace(problem, state=burdened, before_observations=burdened, goals=tuple(goals))


def _with_ways_round(layout: Layout, rng: Random) -> Layout:
    """The layout with some edges more, so that robots can get past each other more often."""
    edges = list(layout.edges)
    for _ in range(rng.choice((0, 1, 2, 3))):
        pair = tuple(rng.sample([node.name for node in layout.nodes], 2))
        if pair not in edges and pair[::-1] not in edges:
            edges.append((pair[0], pair[1]))
    return replace(layout, edges=tuple(edges))
