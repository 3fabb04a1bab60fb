"""Walks what robots did again on a changed floor, stop by stop: `LayoutChange` → what it promises.

Entry point `StopJudge`; `WalkedTour` says what is walked again, `stops_of_plan` what that is for a plan.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

from sparc.lazy_dataclass import dataclass
from waiter_cli.layout_tools.layout_changes import LayoutChange
from waiter_cli.layout_tools.measure import length
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = ["Stop", "StopJudge", "WalkedTour", "stops_of_plan"]

Cost = tuple[int, float]
Extra = tuple[str, str] | None
Stop = tuple[str, str]
"""``(table, NAME)``, ``(node, NAME)``, or ``bar`` or ``entrance`` without a name."""


@dataclass(frozen=True)
class WalkedTour:
    """The start of a robot and its stops in order; ``posts`` are nodes that are taken meanwhile."""

    start: str
    posts: frozenset[str]
    stops: tuple[Stop, ...]


def stops_of_plan(problem: Problem, plan: Plan) -> tuple[Stop, ...]:
    """Returns the stops of a plan for one robot, the node of a goal ``at`` last."""
    tables = {table.name for table in problem.layout.tables}
    stops: list[Stop] = []
    for action in plan.actions:
        if action.name == "go_to":
            continue
        if action.name == "pick":
            stops.append(("entrance", ""))
        elif action.name in ("send_order", "take_up"):
            stops.append(("bar", ""))
        else:
            stops += [("table", word) for word in action.arguments if word in tables][:1]
    wanted = [goal.node for goal in problem.goals if goal.kind == "at" and goal.node is not None]
    return (*stops, *(("node", node) for node in wanted[:1]))


class StopJudge:
    """Walks tours of today again on a changed floor: their stops, in their order.

    With ``unreached`` a way to nodes that could not be reached promises most.
    """

    def __init__(
        self, layout: Layout, tours: Sequence[WalkedTour], *, unreached: bool = False
    ) -> None:
        self.layout = layout
        self.open = unreached
        self.tours = [(_Floor(layout, tour.posts), tour) for tour in tours]
        self.reached = set(_Floor(layout, frozenset()).from_(layout.agent))

    def promise(self, change: LayoutChange) -> tuple[int, float, int, float]:
        """Returns a key that is small for a change that promises much.

        A new way to nodes that could not be reached comes first where that is asked for; then
        whoever saves most metres; then whoever saves most steps.
        """
        joins = 0
        if self.open and change.edge is not None:
            joins = int((change.edge[0] in self.reached) != (change.edge[1] in self.reached))
        metres, steps = 0.0, 0
        for floor, tour in self.tours:
            walked = self._walk(floor, tour, change)
            if walked is None:
                return (1, 0.0, 0, 0.0)
            steps += walked[0]
            metres += walked[1]
        size = length(self.layout, *change.edge) if change.edge else 0.0
        return (-joins, round(metres, 6), steps, size)

    def _walk(self, floor: _Floor, tour: WalkedTour, change: LayoutChange) -> Cost | None:
        """Returns steps and metres walked from stop to stop, None where a stop cannot be reached."""
        here: dict[str, Cost] = {tour.start: (0, 0.0)}
        places = {table.name: table.nodes for table in change.layout.tables}
        for stop in tour.stops:
            ahead: dict[str, Cost] = {}
            for node in self._nodes(stop, places):
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
        return min(here.values())

    def _nodes(self, stop: Stop, places: dict[str, tuple[str, ...]]) -> tuple[str, ...]:
        """Returns the nodes at one of which a stop is."""
        kind, name = stop
        if kind == "entrance":
            return (self.layout.entrance,)
        if kind == "bar":
            return self.layout.bar.nodes if self.layout.bar else ()
        return (name,) if kind == "node" else places[name]


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
