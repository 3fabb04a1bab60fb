"""Lists changes to a `Problem` that might let a plan exist.

A `Cause` is one thing in the user's files that may stand in the way (a waiter, an occupied table,
a table's size, a goal); without it the problem is a relaxed one: whatever was a plan still is one, so
causes can be taken away one after another.  A `Relaxation` is one thing a person
could do about it.  Entry points `causes_of` and `changes_for`; `explain` tries them by planning.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from math import dist

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Where
from waiter_cli.explanation.forbidding_rules import DomainRule
from waiter_cli.model.graph import distances, reachable
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party, Robot, State
from waiter_cli.model.wording import goal_text

__all__ = ["Cause", "Relaxation", "causes_of", "changes_for", "without"]


@dataclass(frozen=True)
class Cause:
    """Something that may stand in the way: what it is, where it is said, how to take it away.

    ``drop`` takes it away; `without` takes away several.  ``kind`` is one of `KINDS`.  A ``rule`` is
    taken away from its domain, and the problem stays as it is.
    """

    kind: str
    message: str
    where: Where | None
    drop: Callable[[Problem], Problem]
    rule: DomainRule | None = None


@dataclass(frozen=True)
class Relaxation:
    """Something that could be done: in words, and the problem after it.

    ``kind`` says what is changed: of several changes to one waiter, one that helps is enough.
    """

    kind: str
    message: str
    where: Where | None
    problem: Problem


def place(problem: Problem, *keys: str) -> Where | None:
    """Returns the place of the first of these keys in the state, or in the layout."""
    for key in keys:
        for name, where in (*problem.state_where, *problem.layout.key_where):
            if name == key:
                return where
    return None


# ---------------------------------------------------------------- causes


def causes_of(problem: Problem) -> Iterator[Cause]:
    """Yields everything whose absence might let a plan exist, in the order of the files."""
    layout, state = problem.layout, problem.state
    for waiter, node in state.waiters:
        later = [f"at {to} from step {at} on" for who, at, to in layout.timetable if who == waiter]
        yield Cause(
            "waiter",
            f"{waiter} stands at {node}{', then ' if later else ''}{', '.join(later)}",
            place(problem, f"waiters.{waiter}", "waiters"),
            partial(without_waiter, waiter=waiter),
        )
    for robot in _spare_robots(problem):
        yield Cause(
            "robot",
            f"{robot.name} stands at {robot.at} and may be in the way",
            place(problem, f"agents.{robot.name}", "agents"),
            partial(_without_robot, name=robot.name),
        )
    for seat, party in state.seated:
        yield Cause(
            "party",
            f"{_party(party)} sits at {seat}",
            place(problem, f"seated.{seat}", "seated"),
            partial(_twinned, table=seat),
        )
    for a, b in sorted(layout.one_way):
        yield Cause(
            "one_way",
            f"the path from {a} to {b} is one way",
            _place_of_edge(problem, (a, b)),
            partial(_turned, edge=(a, b)),
        )
    largest = max([len(party) for party in state.parties()], default=0)
    for table in layout.tables:
        if table.capacity < largest:
            yield Cause(
                "size",
                f"{table.name} seats {table.capacity}",
                table.where,
                partial(_resized, table=table.name, capacity=largest),
            )
    for pair in dict.fromkeys(problem.before):
        first, second = pair
        yield Cause(
            "order",
            f"{goal_text(first, in_sentence=True)} is wanted before {goal_text(second, in_sentence=True)}",
            second.where,
            partial(_without_order, pair=pair),
        )
    for goal in dict.fromkeys(problem.goals):
        yield Cause(
            "goal",
            f"{goal_text(goal, in_sentence=True)} is wanted",
            goal.where or _goal_place(problem, goal),
            partial(_without_goal, goal=goal),
        )


KINDS = ("goal", "order", "size", "one_way", "waiter", "robot", "party", "rule", "permit")
"""The kinds of causes, in the order in which several are taken away: wishes by their own words."""


def without(problem: Problem, causes: Iterable[Cause]) -> Problem:
    """Returns the problem without these of its causes."""
    for cause in sorted(causes, key=lambda cause: KINDS.index(cause.kind)):
        problem = cause.drop(problem)
    return problem


def _spare_robots(problem: Problem) -> Iterator[Robot]:
    """Yields all but one of the robots that have nothing, and of which nothing is wanted by name."""
    goals = [*problem.goals, *(goal for pair in problem.before for goal in pair)]
    named = {goal.robot for goal in goals}
    idle = [
        robot
        for robot in problem.state.robots
        if robot.name not in named and not (robot.leads or robot.carries or robot.orders)
    ]
    yield from idle if len(idle) < len(problem.state.robots) else idle[1:]


def _without_robot(problem: Problem, name: str) -> Problem:
    layout, state = problem.layout, problem.state
    if len(state.robots) < 2:
        return problem
    agents = tuple(pair for pair in layout.agents if pair[0] != name)
    robots = tuple(robot for robot in state.robots if robot.name != name)
    layout = replace(layout, agents=agents, agent=agents[0][1])
    return replace(problem, layout=layout, state=replace(state, robots=robots))


def _goal_place(problem: Problem, goal: Goal) -> Where | None:
    """Returns where the wish of a goal that serving everybody made was observed or stated."""
    for observation in problem.observations:
        if (
            goal.kind == "seated"
            and observation.kind == "enter"
            and goal.party[0] in observation.arguments
        ) or (goal.table is not None and goal.table in observation.arguments):
            return observation.where
    if goal.party:
        return place(problem, f"party.{goal.party[0]}", "waiting")
    return place(problem, f"wants_bill.{goal.table}", "wants_bill")


def _party(party: Party) -> str:
    return party[0] if len(party) == 1 else f"the party of {party[0]}"


# ---------------------------------------------------------------- changes


def changes_for(problem: Problem) -> Iterator[Relaxation]:
    """Yields single changes that might help, the least intrusive first."""
    yield from _moved_waiters(problem)
    yield from _wished_bills(problem)
    yield from _larger_tables(problem)
    yield from _freed_tables(problem)
    yield from _two_way_edges(problem)
    yield from _without_own_words(problem)
    yield from _new_edges(problem)
    yield from _fewer_goals(problem)


def _moved_waiters(problem: Problem) -> Iterator[Relaxation]:
    """Yields each waiter at the nearest node where he would stand in nobody's way."""
    layout, state = problem.layout, problem.state
    taken = {node for _, node in state.waiters} | set(state.stations().values())
    for waiter, node in state.waiters:
        where = place(problem, f"waiters.{waiter}", "waiters")
        for other in distances(layout.joined(), node):
            if other not in taken:
                waiters = tuple(sorted((w, other if w == waiter else n) for w, n in state.waiters))
                yield Relaxation(
                    f"waiter {waiter}",
                    f"if {waiter} stood at {other} instead of {node}",
                    where,
                    _with_state(problem, replace(state, waiters=waiters)),
                )


def _wished_bills(problem: Problem) -> Iterator[Relaxation]:
    for goal in problem.goals:
        table = goal.table
        if goal.kind == "paid" and goal.party:
            table = problem.state.table_of(goal.party[0])
        if goal.kind == "paid" and table and table not in problem.state.wants_bill:
            state = replace(
                problem.state,
                wants_bill=problem.state.wants_bill | {table},
                paid=problem.state.paid - {table},
            )
            yield Relaxation(
                f"bill {table}",
                f"if {table} asked for its bill",
                goal.where,
                _with_state(problem, state),
            )


def _larger_tables(problem: Problem) -> Iterator[Relaxation]:
    sizes = sorted({len(party) for party in problem.state.parties()})
    for table in sorted(problem.layout.tables, key=lambda table: -table.capacity):
        for size in sizes:
            if size > table.capacity:
                yield Relaxation(
                    f"size {table.name}",
                    f"if {table.name} seated {size}",
                    table.where,
                    _resized(problem, table.name, size),
                )


def _freed_tables(problem: Problem) -> Iterator[Relaxation]:
    for table, party in problem.state.seated:
        yield Relaxation(
            f"free {table}",
            f"if {_party(party)} left {table}",
            place(problem, f"seated.{table}", "seated"),
            _freed(problem, table),
        )


def _without_own_words(problem: Problem) -> Iterator[Relaxation]:
    """Yields the problem without each fluent and each fact in a domain's own words."""
    state = problem.state
    for fluent in state.fluents:
        fluents = tuple(other for other in state.fluents if other != fluent)
        yield Relaxation(
            f"fluent {fluent}",
            f"if {fluent} did not hold at the start",
            place(problem, f"fluents.{fluent}", "fluents"),
            _with_state(problem, replace(state, fluents=fluents)),
        )
    for fact in problem.facts:
        facts = tuple(other for other in problem.facts if other != fact)
        yield Relaxation(
            f"fact {fact.text}",
            f"without the fact {fact.text}",
            fact.where,
            replace(problem, facts=facts),
        )
    for seen in (each for each in problem.observations if each.kind == "obs"):
        observations = tuple(other for other in problem.observations if other != seen)
        yield Relaxation(
            f"obs {seen.arguments[0]}",
            f"if {seen.arguments[0]} had not been seen",
            seen.where,
            replace(problem, observations=observations),
        )


def _place_of_edge(problem: Problem, edge: tuple[str, str]) -> Where | None:
    places = dict(zip(problem.layout.edges, problem.layout.edge_where))
    return places.get(edge) or place(problem, "edges")


def _turned(problem: Problem, edge: tuple[str, str]) -> Problem:
    """The problem where that one-way path leads both ways."""
    layout = problem.layout
    return replace(problem, layout=replace(layout, one_way=layout.one_way - {edge}))


def _two_way_edges(problem: Problem) -> Iterator[Relaxation]:
    for a, b in sorted(problem.layout.one_way):
        yield Relaxation(
            "one_way",
            f"if the path from {a} to {b} led back as well",
            _place_of_edge(problem, (a, b)),
            _turned(problem, (a, b)),
        )


def _new_edges(problem: Problem) -> Iterator[Relaxation]:
    """Yields the shortest edge that joins what the robot cannot reach to what it can."""
    layout = problem.layout
    graph = layout.neighbours()
    stations = problem.state.stations().values()
    reached = set[str]().union(*(reachable(graph, node) for node in stations))
    beyond = [node for node in layout.nodes if node.name not in reached]
    within = [node for node in layout.nodes if node.name in reached]
    pairs = []
    for a in within:
        for b in beyond:
            far = 0.0
            if a.at is not None and b.at is not None:
                far = round(dist(a.at, b.at), 6)
            pairs.append((far, a.name, b.name))
    for _, near, far_node in sorted(pairs)[:8]:
        joined = replace(layout, edges=(*layout.edges, (near, far_node)), edge_where=())
        yield Relaxation(
            "edge",
            f"if there were an edge [{near}, {far_node}]",
            place(problem, "edges"),
            replace(problem, layout=joined),
        )


def _fewer_goals(problem: Problem) -> Iterator[Relaxation]:
    for number, goal in enumerate(problem.goals):
        yield Relaxation(
            "goal",
            f"without the wish {goal_text(goal, in_sentence=True)}",
            goal.where or _goal_place(problem, goal),
            replace(problem, goals=problem.goals[:number] + problem.goals[number + 1 :]),
        )


# ---------------------------------------------------------------- other problems


def _with_state(problem: Problem, state: State) -> Problem:
    return replace(problem, state=state, before_observations=state)


def without_waiter(problem: Problem, waiter: str) -> Problem:
    """Returns the problem in a restaurant where that waiter has the day off."""
    layout = replace(
        problem.layout,
        waiters=tuple(pair for pair in problem.layout.waiters if pair[0] != waiter),
        timetable=tuple(entry for entry in problem.layout.timetable if entry[0] != waiter),
    )
    waiters = tuple(pair for pair in problem.state.waiters if pair[0] != waiter)
    return _with_state(replace(problem, layout=layout), replace(problem.state, waiters=waiters))


def _freed(problem: Problem, table: str) -> Problem:
    """Returns the problem after the party at ``table`` has left; goals that name it are left out."""
    state = problem.state
    party = next(party for name, party in state.seated if name == table)
    state = replace(
        state,
        seated=tuple(pair for pair in state.seated if pair[0] != table),
        paid=state.paid - {table},
    )
    kept = tuple(goal for goal in problem.goals if not set(goal.party) & set(party))
    return replace(_with_state(problem, state), goals=kept)


def _twinned(problem: Problem, table: str) -> Problem:
    """Returns the problem where whoever sits at ``table`` keeps nobody from it: a
    free twin is beside it.

    All that is wanted of those who sit there stays wanted.
    """
    taken = {one.name for one in problem.layout.tables} | {n.name for n in problem.layout.nodes}
    taken |= {name for party in problem.state.parties() for name in party}
    taken |= {name for name, _ in problem.state.waiters} | {*problem.layout.objects}
    twin = f"{table}_free"
    while twin in taken:
        twin += "_"
    old = problem.layout.table(table)
    sitting = dict(problem.state.seated)[table]

    def moved(goal: Goal) -> Goal:
        other = goal.kind == "seated" and goal.table == table and goal.party[0] not in sitting
        return replace(goal, table=twin) if other else goal

    tables = (*problem.layout.tables, replace(old, name=twin))
    chairs = dict(problem.state.chairs)
    chairs[twin] = old.capacity
    changed = replace(
        problem,
        layout=replace(problem.layout, tables=tables),
        goals=tuple(map(moved, problem.goals)),
        before=tuple((moved(first), moved(second)) for first, second in problem.before),
    )
    state = replace(problem.state, chairs=tuple(sorted(chairs.items())))
    return _with_state(changed, state)


def _without_goal(problem: Problem, goal: Goal) -> Problem:
    return replace(problem, goals=tuple(other for other in problem.goals if other != goal))


def _without_order(problem: Problem, pair: tuple[Goal, Goal]) -> Problem:
    return replace(problem, before=tuple(other for other in problem.before if other != pair))


def _resized(problem: Problem, table: str, capacity: int) -> Problem:
    tables = tuple(
        replace(one, capacity=capacity, chairs=capacity) if one.name == table else one
        for one in problem.layout.tables
    )
    chairs = tuple(
        (name, capacity if name == table else count) for name, count in problem.state.chairs
    )
    changed = replace(problem, layout=replace(problem.layout, tables=tables))
    return _with_state(changed, replace(problem.state, chairs=chairs))
