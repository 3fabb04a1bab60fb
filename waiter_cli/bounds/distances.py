"""Measures walks of the agent: `Layout`, nodes that are taken → `WalkDistances`,
distances in steps.

Entry points `standing` (who stands where, and for ever or not) and `WalkDistances`.
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.problem import Problem

__all__ = ["FAR", "WalkDistances", "Staff", "standing"]

FAR = 1 << 20
"""The distance of nodes that no path joins; larger than every length that can occur."""


@dataclass(frozen=True)
class Staff:
    """The other waiters: ``now`` where each stands at step 0, ``fixed`` those who never move.

    ``last`` is the last step at which somebody moves, ``after`` where each stands from then on.
    """

    now: dict[str, str]
    fixed: dict[str, str]
    after: dict[str, str]
    last: int


def standing(problem: Problem) -> Staff:
    """Returns the places of the other waiters of ``problem``."""
    now = dict(problem.state.waiters)
    later: dict[str, set[str]] = {}
    last = 0
    for who, step, node in problem.layout.timetable:
        if step <= 0:
            now[who] = node
    after = dict(now)
    for who, step, node in problem.layout.timetable:
        if step > 0:
            later.setdefault(who, set()).add(node)
            after[who] = node
            last = max(last, step)
    fixed = {who: node for who, node in now.items() if later.get(who, {node}) == {node}}
    return Staff(now, fixed, after, last)


class WalkDistances:
    """The nodes of a layout, numbered in its order, and the shortest ways between open ones.

    ``shut`` nodes cannot be entered; distances are to and from any node, but lead only over open
    ones (a shut source counts as left, never as entered).  ``nodes_of`` tables, and ``bar``, are those
    within reach of the agent.
    """

    def __init__(self, problem: Problem, shut: Iterable[str]) -> None:
        layout = problem.layout
        self.names = [node.name for node in layout.nodes]
        self.number = {name: index for index, name in enumerate(self.names)}
        self.shut = frozenset(self.number[name] for name in shut if name in self.number)
        near: list[list[int]] = [[] for _ in self.names]
        number, closed, one_way = self.number, self.shut, layout.one_way
        for a, b in layout.edges:
            i, j = number[a], number[b]
            if i == j:
                continue
            if j not in closed and j not in near[i]:
                near[i].append(j)
            if i not in closed and i not in near[j] and (a, b) not in one_way:
                near[j].append(i)
        self.near = near
        self.one_way = bool(one_way)
        self._rows: dict[int, list[int]] = {}
        self._columns: dict[int, list[int]] = {}
        here = self.row(number[problem.state.agent])
        self.nodes_of = {table.name: self._reached(here, table.nodes) for table in layout.tables}
        self.bar = self._reached(here, layout.bar.nodes if layout.bar is not None else ())
        self.door = number[layout.entrance]

    def _reached(self, here: list[int], names: Iterable[str]) -> tuple[int, ...]:
        """Returns the numbers of those nodes that the agent can get to."""
        numbers = (self.number[name] for name in dict.fromkeys(names))
        return tuple(node for node in numbers if here[node] < FAR and node not in self.shut)

    def row(self, source: int) -> list[int]:
        """Returns the number of steps from ``source`` to every node, `FAR` where there is no way."""
        row = self._rows.get(source)
        if row is None:
            row = self._rows[source] = _steps(self.near, source)
        return row

    def column(self, target: int) -> list[int]:
        """Returns the number of steps to ``target`` from every open node, `FAR`
        where there is no way.

        Where no path is one way that is the row of ``target``.
        """
        if not self.one_way:
            return self.row(target)
        column = self._columns.get(target)
        if column is None:
            before: list[list[int]] = [[] for _ in self.names]
            for here, nodes in enumerate(self.near):
                for there in nodes:
                    before[there].append(here)
            column = self._columns[target] = _steps(before, target)
        return column

    def nearest(self, source: int, targets: Iterable[int]) -> int:
        """Returns the number of steps from ``source`` to the nearest of ``targets``."""
        row = self.row(source)
        return min((row[node] for node in targets), default=FAR)

    def path(self, source: int, target: int) -> list[int]:
        """Returns the nodes entered on one shortest way, in order; there must be one."""
        if self.one_way:
            return self._way_on(source, target)
        row = self.row(source)
        way = [target]
        while row[way[-1]] > 1:
            here = way[-1]
            way.append(next(n for n in self.near[here] if row[n] == row[here] - 1))
        return [] if source == target else way[::-1]

    def _way_on(self, source: int, target: int) -> list[int]:
        """Returns the same, found from its beginning: where a path is one way, nodes
        know what follows.
        """
        left, here, way = self.column(target), source, []
        while here != target:
            here = min(self.near[here], key=left.__getitem__)
            way.append(here)
        return way

    def farthest(self, targets: Iterable[int]) -> int:
        """Returns the greatest finite distance to any of ``targets`` from any open node."""
        return max(
            (steps for target in targets for steps in self.column(target) if steps < FAR), default=0
        )


def _steps(near: list[list[int]], source: int) -> list[int]:
    """Breadth first: the number of steps from ``source`` to every node."""
    row = [FAR] * len(near)
    row[source] = 0
    edge, length = [source], 0
    while edge:
        length += 1
        fresh = []
        for here in edge:
            for there in near[here]:
                if row[there] == FAR:
                    row[there] = length
                    fresh.append(there)
        edge = fresh
    return row
