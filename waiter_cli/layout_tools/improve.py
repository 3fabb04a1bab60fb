"""`Layout`, scenarios → the changes that save most walking. Entry point `improve`.

A change is one more edge, a table moved to a free node, or two tables that swap places.  There may be
thousands; each is first judged by walking the plans of today again on the changed floor, stop by
stop, which takes no planning.  Then those that promise most are planned, with proof, as long as
the budget lasts; only planned figures are reported.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from math import inf
from time import monotonic

from sparc import limits
from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import InputError
from waiter_cli.layout_tools.advice import physical
from waiter_cli.layout_tools.measure import Measured, Totals, length, measure, pose_all, total
from waiter_cli.model.geometry import beside, distance_to_segment
from waiter_cli.model.layout import Layout, Point, Table
from waiter_cli.model.problem import Problem

__all__ = ["Budget", "LayoutChange", "Improvement", "Report", "changes", "improve"]

CLEAR = 0.3
"""An edge that passes a third node closer than this, in metres, is no way of its own."""
PER_PLAN, PER_TIE = 10.0, 1.0
"""Seconds for a plan, and for the shortest walk among the plans of its length."""

Cost = tuple[int, float]
Extra = tuple[str, str] | None


@dataclass(frozen=True)
class LayoutChange:
    """One change: ``kind`` is ``edge``, ``move`` or ``swap``; ``text`` says it in words."""

    kind: str
    text: str
    layout: Layout
    edge: tuple[str, str] | None = None
    tables: tuple[str, ...] = ()


@dataclass(frozen=True)
class Improvement:
    """A change and the figures of its plans, over the scenarios that had one before.

    ``solved`` counts the scenarios that have a plan now, the others included.
    """

    change: LayoutChange
    after: Totals
    solved: int
    rows: tuple[Measured, ...] = ()


@dataclass(frozen=True)
class Budget:
    """``seconds`` for everything, ``tries`` changes that are planned at most."""

    seconds: float = 30.0
    tries: int = 24


@dataclass(frozen=True)
class Report:
    """The improvements: best first, and only changes that save walking or solve more scenarios.

    ``rows`` are the scenarios as the layout is today, ``before`` their sums; ``tried`` of
    ``candidates`` changes were planned; ``stopped`` is what ended it: ``time``, ``memory``, ``tries`` or empty.
    """

    rows: tuple[Measured, ...]
    before: Totals
    found: tuple[Improvement, ...]
    tried: int
    candidates: int
    stopped: str = ""
    unfit: tuple[Measured, ...] = field(default=())


def improve(
    layout: Layout,
    scenarios: Sequence[str],
    *,
    edges: bool = True,
    tables: bool = True,
    budget: Budget | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> Report:
    """Returns the changes that save most metres over the scenarios, judged by plans.

    Raises `InputError` where no scenario fits the layout.
    """
    budget = budget or Budget()
    end = monotonic() + budget.seconds
    posed = pose_all(layout, scenarios)
    problems = [each for each in posed if isinstance(each, Problem)]
    unfit = tuple(each for each in posed if isinstance(each, Measured))
    if not problems:
        raise InputError(f"no scenario fits this layout; {unfit[0].message}", "name others")
    timed = all(node.at is not None for node in layout.nodes)
    rows = tuple(measure(problem, _seconds(end), PER_TIE) for problem in problems)
    before = total([row for row in rows if row.plan is not None], timed)
    used = {word for row in rows if row.plan for a in row.plan.actions for word in a.arguments}
    judge = _Judge(layout, problems, rows)
    stopped = ""
    everything: list[LayoutChange] = []
    promise: dict[int, tuple[int, float, int, float]] = {}
    try:
        for change in changes(layout, used if before.scenarios else None, edges, tables, end):
            promise[id(change)] = judge.promise(change)
            everything.append(change)
    except _Ended as ended:
        stopped = ended.limit
    everything.sort(key=lambda change: (promise[id(change)], change.text))
    flaws = sum(1 for _ in physical(layout))
    improvements: list[Improvement] = []
    tried = 0
    for change in everything:
        if stopped:
            break
        if tried == budget.tries:
            stopped = "tries"
            break
        stopped = _passed(end)
        if stopped:
            break
        if timed and sum(1 for _ in physical(change.layout)) > flaws:
            continue
        tried += 1
        progress(f"{tried}: {change.text}")
        planned = _planned(change, problems, rows, timed, end)
        if planned is not None and _saves(planned, before, rows):
            improvements.append(planned)
    improvements.sort(key=lambda one: (-one.solved, round(one.after.metres, 6), one.after.steps))
    return Report(rows, before, tuple(improvements), tried, len(everything), stopped, unfit)


class _Ended(Exception):
    """A limit was reached while changes were made; ``limit`` is ``time`` or ``memory``."""

    def __init__(self, limit: str) -> None:
        super().__init__(limit)
        self.limit = limit


def _passed(end: float) -> str:
    """Returns the limit that is passed; empty where none is.  ``end`` is of `time.monotonic`."""
    return "time" if monotonic() > end else limits.reached() or ""


def _seconds(end: float) -> float:
    """Returns the seconds that one plan may take."""
    return max(0.5, min(PER_PLAN, end - monotonic()))


def _planned(
    change: LayoutChange,
    problems: Sequence[Problem],
    rows: Sequence[Measured],
    timed: bool,
    end: float,
) -> Improvement | None:
    """Returns the figures after a change; None where a scenario that had a plan gets none in time."""
    after: list[Measured] = []
    for problem, row in zip(problems, rows, strict=True):
        made = measure(replace(problem, layout=change.layout), _seconds(end), PER_TIE)
        if row.plan is not None and (made.plan is None or not made.minimal):
            return None
        after.append(made)
    both = [made for made, row in zip(after, rows) if row.plan is not None]
    solved = sum(1 for made in after if made.plan is not None)
    return Improvement(change, total(both, timed), solved, tuple(after))


def _saves(one: Improvement, before: Totals, rows: Sequence[Measured]) -> bool:
    solved = sum(1 for row in rows if row.plan is not None)
    metres = before.metres - one.after.metres
    return (
        one.solved > solved or metres > 1e-6 or (metres > -1e-6 and one.after.steps < before.steps)
    )


# -- changes ----------------------------------------------------------------------------------


def changes(
    layout: Layout,
    used: set[str] | None,
    edges: bool = True,
    tables: bool = True,
    end: float = inf,
) -> Iterator[LayoutChange]:
    """Yields every change that may be worth a look.

    Tables only where one of those ``used`` is moved.

    Raises `_Ended` at ``end`` (of `time.monotonic`), or where the memory is used up.
    """
    if edges:
        yield from _edges(layout, end)
    if not tables:
        return
    wanted = [t for t in layout.tables if used is None or t.name in used]
    taken = {node for table in layout.tables for node in table.nodes}
    taken |= {layout.entrance, *(layout.bar.nodes if layout.bar else ())}
    for table in wanted:
        for node in layout.nodes:
            if limit := _passed(end):
                raise _Ended(limit)
            if node.name not in taken:
                moved = _moved(layout, table, node.name)
                text = f"move {table.name} to {node.name}"
                yield LayoutChange("move", text, moved, tables=(table.name,))
    for one, other in combinations(layout.tables, 2):
        if one in wanted or other in wanted:
            text = f"swap {one.name} and {other.name}"
            yield LayoutChange(
                "swap", text, _swapped(layout, one, other), tables=(one.name, other.name)
            )


def _edges(layout: Layout, end: float) -> Iterator[LayoutChange]:
    """Edges that are not there: straight, past no other node, through no furniture."""
    near = layout.joined()
    places = {node.name: node.at for node in layout.nodes}
    timed = all(at is not None for at in places.values())
    blocks = None
    if timed:
        from waiter_cli.room.room import ROBOT, build_room, nearest_on_walk

        room = build_room(layout)
        places.update(room.nodes)
        solid = [*room.tables.values(), *room.walls, *([room.bar] if room.bar else [])]

        def blocked(start: Point, end: Point) -> bool:
            return nearest_on_walk(start, end, solid)[1] < ROBOT

        blocks = blocked
    for a, b in combinations((node.name for node in layout.nodes), 2):
        if limit := _passed(end):
            raise _Ended(limit)
        if b in near[a]:
            continue
        start, goal = places[a], places[b]
        if blocks is None or start is None or goal is None:
            around = {far for one in near[a] for far in near[one]}
            around |= {far for one in around for far in near[one]}
            if near[a] and near[b] and b not in around:
                continue
        else:
            if any(
                at is not None and distance_to_segment(at, (start, goal)) < CLEAR
                for name, at in places.items()
                if name not in (a, b)
            ) or blocks(start, goal):
                continue
        layout_ = replace(layout, edges=(*layout.edges, (a, b)), edge_where=())
        yield LayoutChange("edge", f"add the edge {a}-{b}", layout_, edge=(a, b))


def _moved(layout: Layout, table: Table, node: str) -> Layout:
    """Returns the layout with a table beside another node."""
    stand = layout.node(node).at
    at = None
    if stand is not None:
        places = {n.name: n.at for n in layout.nodes}
        ends = [(places[a], places[b]) for a, b in layout.edges]
        ways = [(a, b) for a, b in ends if a is not None and b is not None]
        others = [t.at for t in layout.tables if t.name != table.name and t.at is not None]
        at = beside(stand, table.size, ways, others)
    return _with_tables(layout, {table.name: replace(table, nodes=(node,), at=at)})


def _swapped(layout: Layout, one: Table, other: Table) -> Layout:
    return _with_tables(
        layout,
        {
            one.name: replace(one, nodes=other.nodes, at=other.at),
            other.name: replace(other, nodes=one.nodes, at=one.at),
        },
    )


def _with_tables(layout: Layout, changed: dict[str, Table]) -> Layout:
    tables = tuple(changed.get(table.name, table) for table in layout.tables)
    return replace(layout, tables=tables)


# -- the judge --------------------------------------------------------------------------------


class _Judge:
    """Walks the plans of today again on a changed floor: their stops, in their order."""

    def __init__(
        self, layout: Layout, problems: Sequence[Problem], rows: Sequence[Measured]
    ) -> None:
        self.layout = layout
        self.open = any(row.plan is None for row in rows)
        self.tours = [
            (_Floor(layout, frozenset(node for _, node in problem.state.waiters)), problem, row)
            for problem, row in zip(problems, rows)
            if row.plan is not None
        ]
        reached = _Floor(layout, frozenset()).from_(layout.agent)
        self.reached = set(reached)

    def promise(self, change: LayoutChange) -> tuple[int, float, int, float]:
        """Returns a key that is small for a change that promises much.

        A new way to nodes that could not be reached comes first where some scenario has no plan;
        then whoever saves most metres; then whoever saves most steps.
        """
        joins = 0
        if self.open and change.edge is not None:
            joins = int((change.edge[0] in self.reached) != (change.edge[1] in self.reached))
        metres, steps = 0.0, 0
        for floor, problem, row in self.tours:
            walked = self._walk(floor, problem, row, change)
            if walked is None:
                return (1, 0.0, 0, 0.0)
            steps += walked[0]
            metres += walked[1]
        size = length(self.layout, *change.edge) if change.edge else 0.0
        return (-joins, round(metres, 6), steps, size)

    def _walk(
        self, floor: _Floor, problem: Problem, row: Measured, change: LayoutChange
    ) -> Cost | None:
        """Returns steps and metres walked from stop to stop, None where a stop cannot be reached."""
        assert row.plan is not None
        here: dict[str, Cost] = {problem.state.agent: (0, 0.0)}
        places = {t.name: t.nodes for t in change.layout.tables}
        for action in row.plan.actions:
            if action.name == "go_to":
                continue
            there = _stop(self.layout, places, action.name, action.arguments)
            ahead: dict[str, Cost] = {}
            for node in there:
                ways = [
                    (done[0] + way[0], done[1] + way[1])
                    for start, done in here.items()
                    if (way := floor.way(start, node, change.edge, self.layout)) is not None
                ]
                if ways:
                    ahead[node] = min(ways)
            if not ahead:
                return None
            here = ahead
        for goal in problem.goals:
            if goal.kind == "at" and goal.node is not None:
                ways = [
                    (done[0] + way[0], done[1] + way[1])
                    for start, done in here.items()
                    if (way := floor.way(start, goal.node, change.edge, self.layout)) is not None
                ]
                return min(ways, default=None)
        return min(here.values())


def _stop(
    layout: Layout, places: dict[str, tuple[str, ...]], name: str, arguments: tuple[str, ...]
) -> tuple[str, ...]:
    """Returns the nodes at one of which an action is done."""
    if name == "pick":
        return (layout.entrance,)
    if name in ("send_order", "take_up"):
        return layout.bar.nodes if layout.bar else ()
    return next((places[word] for word in arguments if word in places), ())


class _Floor:
    """Shortest ways past the waiters: fewest steps, and of these the fewest metres (Dijkstra 1959)."""

    def __init__(self, layout: Layout, posts: frozenset[str]) -> None:
        self.posts = posts
        self.near: dict[str, list[tuple[str, float]]] = {node.name: [] for node in layout.nodes}
        for a, b in layout.edges:
            size = length(layout, a, b)
            self.near[a].append((b, size))
            if (a, b) not in layout.one_way:
                self.near[b].append((a, size))
        self.known: dict[str, dict[str, Cost]] = {}

    def from_(self, start: str) -> dict[str, Cost]:
        """Returns steps and metres to every node that can be reached."""
        if start not in self.known:
            best: dict[str, Cost] = {start: (0, 0.0)}
            rest: list[tuple[Cost, str]] = [((0, 0.0), start)]
            while rest:
                cost, here = heapq.heappop(rest)
                if cost > best[here]:
                    continue
                for node, size in self.near[here]:
                    far = (cost[0] + 1, cost[1] + size)
                    if node not in self.posts and (node not in best or far < best[node]):
                        best[node] = far
                        heapq.heappush(rest, (far, node))
            self.known[start] = best
        return self.known[start]

    def way(self, start: str, end: str, extra: Extra, layout: Layout) -> Cost | None:
        """Returns steps and metres between two nodes, with one more edge where ``extra`` has one."""
        ways = [self.from_(start).get(end)]
        if extra is not None and not self.posts.intersection(extra):
            size = length(layout, *extra)
            for a, b in (extra, extra[::-1]):
                to, on = self.from_(start).get(a), self.from_(b).get(end)
                if to is not None and on is not None:
                    ways.append((to[0] + 1 + on[0], to[1] + size + on[1]))
        return min((way for way in ways if way is not None), default=None)
