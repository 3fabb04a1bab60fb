"""A tour of the agent: stops in a row, each at one of some nodes; tasks are put in where they cost least.

`Task` is a run of stops in their order, `Tour` the row so far.  Two things the agent has only once:
hands (from taking something up to bringing it) and the lead (from a pick to the seat).
`Tour.insert` finds the best places for all stops of a task at once, by dynamic programming over the
gaps of the row; `Tour.settle` then chooses among the nodes of all stops together.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import FAR, WalkDistances
from waiter_cli.bounds.service_chains import HAND_LINKS, Link
from waiter_cli.model.state import Party

__all__ = ["TourStop", "Task", "Tour"]

# A list of stops found so far, last one first: (gap, node, table, before).
_Trail = tuple[int, int, str, object]


@dataclass(frozen=True)
class TourStop:
    """One link done at ``node`` (one of ``nodes``), by which task; ``party`` for pick and seat."""

    link: Link
    node: int
    nodes: tuple[int, ...]
    task: int
    party: Party = ()


@dataclasses.dataclass
class Task:
    """Links in their order, and for each the places: node → table (empty: as the link says).

    ``hold`` tells for each number of links done whether this task then has the hands; ``lead``
    the same for the lead.  ``after`` are the tables that must be seated before ``after_link``.
    """

    number: int
    links: tuple[Link, ...]
    places: list[dict[int, str]]
    party: Party = ()
    hold: list[bool] = dataclasses.field(default_factory=list)
    lead: list[bool] = dataclasses.field(default_factory=list)
    after: str = ""
    after_link: int = 0

    def __post_init__(self) -> None:
        if not self.hold:
            self.hold = _held(self.links)
        if not self.lead:
            self.lead = [False] * (len(self.links) + 1)


def _held(links: Sequence[Link]) -> list[bool]:
    """After how many links done the hands are full."""
    names = [link.name for link in links if link.name in HAND_LINKS or link.name == "bring"]
    held = [bool(names) and names[0] == "bring"]
    for link in links:
        if link.name in HAND_LINKS:
            held.append(True)
        elif link.name == "bring":
            held.append(False)
        else:
            held.append(held[-1])
    return held


class Tour:
    """The stops so far, from ``start``; ``end`` is the node to be at last, None: anywhere."""

    def __init__(self, floor: WalkDistances, start: int, end: int | None) -> None:
        self.floor, self.start, self.end = floor, start, end
        self.stops: list[TourStop] = []
        self.tasks: dict[int, Task] = {}
        self.work = 0
        """How much was looked at so far, in about microseconds."""
        self.orders: list[tuple[int, int, int]] = []
        """(early task, late task, link of the late one that must come after the early one's last)."""

    def walk(self) -> int:
        """Returns the steps walked."""
        here, steps = self.start, 0
        for stop in self.stops:
            steps += self.floor.row(here)[stop.node]
            here = stop.node
        return steps + (self.floor.row(here)[self.end] if self.end is not None else 0)

    def remove(self, number: int) -> None:
        """Takes a task out."""
        self.stops = [stop for stop in self.stops if stop.task != number]
        self.tasks.pop(number, None)

    def _busy(self) -> tuple[list[bool], list[bool]]:
        """Returns for each gap whether the hands are full, and whether somebody is led."""
        done = dict.fromkeys(self.tasks, 0)
        holding = {number for number, task in self.tasks.items() if task.hold[0]}
        leading = {number for number, task in self.tasks.items() if task.lead[0]}
        hands, lead = [bool(holding)], [bool(leading)]
        for stop in self.stops:
            number = stop.task
            done[number] += 1
            task = self.tasks[number]
            (holding.add if task.hold[done[number]] else holding.discard)(number)
            (leading.add if task.lead[done[number]] else leading.discard)(number)
            hands.append(bool(holding))
            lead.append(bool(leading))
        return hands, lead

    def insert(self, task: Task) -> int | None:
        """Puts the stops of ``task`` where they cost least; the cost in steps, None: impossible."""
        row = self.floor.row
        hands, lead = self._busy()
        nodes = [self.start, *(stop.node for stop in self.stops)]
        count, last = len(task.links), len(self.stops)
        low = [0] * (count + 1)
        if task.after:
            seats = [
                index + 1
                for index, stop in enumerate(self.stops)
                if stop.link.name == "seat" and stop.link.table == task.after
            ]
            if not seats:
                return None
            low[task.after_link + 1] = seats[0]
        high = self._limits(task)
        for early, late, index in self.orders:
            if late == task.number and early in self.tasks:
                low[index + 1] = max(low[index + 1], self._places(early)[-1] + 1)
            elif early == task.number and late in self.tasks:
                high[-1] = min(high[-1], self._places(late)[index])
        arrived: list[tuple[int, _Trail | None] | None] = [None] * (count + 1)
        arrived[0] = (0, None)
        best: tuple[int, _Trail | None] | None = None
        self.work += 20 + (last + 1) * (3 * count + len(task.places[-1])) // 2
        for gap in range(last + 1):
            here = nodes[gap]
            ok = [
                not (task.hold[done] and hands[gap]) and not (task.lead[done] and lead[gap])
                for done in range(count + 1)
            ]
            inside: list[dict[int, tuple[int, _Trail | None]]] = [{} for _ in range(count + 1)]
            for done in range(count):
                if not ok[done] or not ok[done + 1] or gap < low[done + 1] or gap > high[done]:
                    continue
                sources = [(node, cost, trail) for node, (cost, trail) in inside[done].items()]
                came = arrived[done]
                if came is not None:
                    sources.append((here, *came))
                after = inside[done + 1]
                for source, cost, trail in sources:
                    line = row(source)
                    for node, table in task.places[done].items():
                        total = cost + line[node]
                        if node not in after or total < after[node][0]:
                            after[node] = (total, (gap, node, table, trail))
            if gap == last:
                came = arrived[count] if ok[count] else None
                best = came
                stay = row(here)[self.end] if self.end is not None else 0
                for node, (cost, trail) in inside[count].items():
                    total = cost + (row(node)[self.end] - stay if self.end is not None else 0)
                    if best is None or total < best[0]:
                        best = (total, trail)
                break
            there = nodes[gap + 1]
            direct = row(here)[there]
            for done in range(count + 1):
                found = arrived[done] if ok[done] else None
                for node, (cost, trail) in inside[done].items():
                    total = cost + row(node)[there] - direct
                    if found is None or total < found[0]:
                        found = (total, trail)
                arrived[done] = found
        if best is None or best[0] >= FAR:
            return None
        self._put(task, best[1])
        return best[0]

    def _limits(self, task: Task) -> list[int]:
        """For each link the last gap that will do: what must be seated first comes before."""
        high = [len(self.stops)] * len(task.links)
        for index, stop in enumerate(self.stops):
            other = self.tasks[stop.task]
            if other.after and task.party and other.after == task.links[-1].table:
                done = sum(1 for earlier in self.stops[:index] if earlier.task == stop.task)
                if done == other.after_link:
                    high[-1] = min(high[-1], index)
        return high

    def _places(self, number: int) -> list[int]:
        """Returns the places of a task's stops in the row."""
        return [index for index, stop in enumerate(self.stops) if stop.task == number]

    def _put(self, task: Task, trail: object) -> None:
        found: list[_Trail] = []
        while trail is not None:
            assert isinstance(trail, tuple)
            found.append(trail)
            trail = trail[3]
        found.reverse()
        for index in range(len(found) - 1, -1, -1):
            gap, node, table, _ = found[index]
            link = task.links[index]
            if table and table != link.table:
                link = Link(link.name, table, link.item, link.number, link.node)
            places = tuple(n for n, t in task.places[index].items() if t == table)
            self.stops.insert(gap, TourStop(link, node, places, task.number, task.party))
        self.tasks[task.number] = task

    def settle(self) -> int:
        """Chooses the best node of every stop, in the order as it is; the steps walked."""
        row = self.floor.row
        costs: dict[int, tuple[int, tuple[int, object] | None]] = {self.start: (0, None)}
        for stop in self.stops:
            following: dict[int, tuple[int, tuple[int, object] | None]] = {}
            for node in stop.nodes:
                total, source = min((c + row(n)[node], n) for n, (c, _) in costs.items())
                following[node] = (total, (node, costs[source][1]))
            costs = following
        end = self.end
        total, where = min(
            (c + (row(n)[end] if end is not None else 0), n) for n, (c, _) in costs.items()
        )
        trail: object = costs[where][1]
        for index in range(len(self.stops) - 1, -1, -1):
            assert isinstance(trail, tuple)
            node, trail = trail
            stop = self.stops[index]
            if stop.node != node:
                self.stops[index] = TourStop(stop.link, node, stop.nodes, stop.task, stop.party)
        return total
