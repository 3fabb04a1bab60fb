"""Joint plans of several robots for one length, step after step. Entry point `JointLayers.search`.

All that the robots can be and have done after so many steps is a layer.  A joint state stays in it
while some deal of what is left keeps all tours within the length (`Deals`).  No state that can still
reach the goals in time is left out, so a layer without any is a proof that no plan has that length.
Where a layer grows too large only the most promising states go on (beam search, Lowerre, 1976), which
proves nothing.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.robot_moves import RobotMoves, RobotOption
from waiter_cli.fleets.tour_table import NEVER
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Flags, Numbers

__all__ = ["JointLayers", "Outcome"]

MANY_DEALS, FEW_DEALS = 7_000, 100
"""So many deals are kept where they are all there are, and where only the best of them are."""
CELLS = 3_000_000
"""So many pairs of a state and a deal are looked at in one go."""


@dataclass(frozen=True)
class Outcome:
    """``plan`` is one of that length at most; without one, ``refuted`` says that there is none.

    ``states`` is how many states all layers had.
    """

    plan: Plan | None
    refuted: bool
    states: int


class JointLayers:
    """The joint states of a problem: the state of each robot, the jobs not begun, the tables taken.

    Each state is a row of whole numbers, jobs and tables as bits; at last come the actions done so far.
    """

    def __init__(self, problem: Problem, deals: Deals, anywhere: tuple[str, ...] = ()) -> None:
        self.np, table = deals.np, deals.table
        self.problem, self.deals, self.robots = problem, deals, problem.state.robots
        self.moves = RobotMoves(problem, table)
        self.count = len(self.robots)
        nodes = self.np.arange(self.moves.nodes)
        self.cell = (self.moves.row[:, None] * self.moves.nodes + nodes[None, :]).reshape(-1)
        self.flat = [costs.reshape(-1) for costs in deals.tables]
        self.own = [flat[self.cell] for flat in self.flat]
        number = table.floor.number
        self.anywhere = [number[node] for node in anywhere]
        self.alike = [
            [k for k in range(self.count) if deals.tables[k] is costs] for costs in deals.tables
        ]
        self.packs = self._packs()
        posts = dict(problem.state.waiters)
        self.last = max((step for _, step, _ in problem.layout.timetable), default=0)
        self.staff: list[list[int]] = []
        for step in range(self.last + 1):
            posts |= {who: to for who, at, to in problem.layout.timetable if at == step}
            self.staff.append([number[node] for node in posts.values()])
        self.rng = self.np.random.default_rng(1)
        self._dealt: Numbers = self.np.zeros((0, self.count), dtype=int)
        self._dealt_of: dict[int, Numbers] = {}

    def search(
        self, length: int, width: int, deadline: float | None = None, beam: bool = True
    ) -> Outcome:
        """Looks for a plan of ``length`` steps at most, with ``width`` states a layer.

        It ends at the first larger layer unless it is a ``beam``.  ``deadline`` is of `time.monotonic`.
        """
        np = self.np
        self._dealt, whole = self.deals.within(length, MANY_DEALS)
        if not whole:
            self._dealt = self._dealt[:FEW_DEALS]
        self._dealt_of = {}
        if not len(self._dealt):
            return Outcome(None, whole, 0)
        start = [self.moves.start(robot) for robot in self.robots]
        layer = np.array([[*start, sum(1 << k for k in self.deals.open), 0, 0]])
        layers, parents, states = [layer], [np.zeros(1, dtype=int)], 1
        for step in range(length + 1):
            done = self._done(layer)
            if len(done):
                at = int(done[layer[done, -1].argmin()])
                return Outcome(self._plan(layers, parents, at), False, states)
            late = deadline is not None and time.monotonic() > deadline
            if step == length or late:
                return Outcome(None, whole and not late, states)
            layer, parent = self._next(layer, step, length)
            states += len(layer)
            if len(layer) > width:
                if not beam:
                    return Outcome(None, False, states)
                keep = self._spread(layer, width)
                layer, parent, whole = layer[keep], parent[keep], False
            layers.append(layer)
            parents.append(parent)
            if not len(layer):
                break
        return Outcome(None, whole, states)

    def _done(self, layer: Numbers) -> Numbers:
        """Returns which states reach the goals."""
        np = self.np
        if not len(layer):
            return layer[:, 0]
        done: Flags = layer[:, self.count] == 0
        for robot in range(self.count):
            done &= self.own[robot][layer[:, robot]] == 0
        for node in self.anywhere:
            done &= (layer[:, : self.count] % self.moves.nodes == node).any(1)
        found: Numbers = np.nonzero(done)[0]
        return found

    def _next(self, layer: Numbers, step: int, length: int) -> tuple[Numbers, Numbers]:
        """Returns the layer after a step, and of which state each one comes."""
        np, moves, k, n = self.np, self.moves, self.count, self.moves.nodes
        here = layer[:, :k] % n
        now, then = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)
        now[self.staff[min(step, self.last)]] = True
        then[self.staff[min(step + 1, self.last)]] = True
        undone = layer[:, k].copy()
        for robot in range(k):
            undone |= moves.busy[layer[:, robot] // n]
        source = np.arange(len(layer))
        after = np.zeros((len(layer), 0), dtype=np.int64)
        begun, seats, acts = np.zeros((3, len(layer)), dtype=np.int64)
        for robot in range(k):  # each adds its options to what those before it do
            state = layer[source, robot]
            first = moves.first[state]
            counts = moves.first[state + 1] - first
            index = np.repeat(np.arange(len(source)), counts)
            option = np.arange(len(index)) + (first - np.cumsum(counts) + counts)[index]
            of = source[index]
            own = moves.after[option]
            node, old = own % n, here[of, robot]
            job, seat = moves.job[option], moves.seat[option]
            fits = self.own[robot][own] < length - step
            fits &= (job & (~layer[of, k] | begun[index])) == 0
            fits &= (seat & (layer[of, k + 1] | seats[index])) == 0
            fits &= (moves.need[option] & undone[of]) == 0
            fits &= ~then[node] & ((node == old) | ~now[node])
            for other in range(robot):
                there = after[index, other] % n
                fits &= (there != node) & ((node != here[of, other]) | (there != old))
            acted = option[fits] > first[index[fits]]
            index, source = index[fits], of[fits]
            begun, seats = begun[index] | job[fits], seats[index] | seat[fits]
            acts = acts[index] + acted
            after = np.concatenate([after[index], own[fits, None]], axis=1)
        left, taken = layer[source, k] & ~begun, layer[source, k + 1] | seats
        acts += layer[source, -1]
        fresh = np.concatenate([after, np.stack([left, taken, acts], axis=1)], axis=1)
        first = self._different(fresh)
        fresh, source = fresh[first], source[first]
        keep = self._left(fresh)[0] < length - step
        return fresh[keep], source[keep]

    def _different(self, rows: Numbers) -> Numbers:
        """Returns the numbers of rows of which none is as good as another one, with the fewest actions.

        Robots with the same table are alike, so who of them is where makes no difference.
        """
        np = self.np
        alike = rows.copy()
        for group in self.alike:
            if len(group) > 1:
                alike[:, group] = np.sort(rows[:, group], axis=1)
        keys = []
        for columns in self.packs:
            key = np.zeros(len(rows), dtype=np.int64)
            for column, bits in columns:
                key = key << bits | alike[:, column]
            keys.append(key)
        order = np.lexsort([rows[:, -1], *keys])
        new = np.zeros(len(rows), dtype=bool)
        new[:1] = True
        for key in keys:
            new[1:] |= key[order[1:]] != key[order[:-1]]
        found: Numbers = order[new]
        return found if len(keys) > 1 else found[~self._behind(keys[0][found])]

    def _behind(self, keys: Numbers) -> Flags:
        """Returns which states (sorted keys) are as others are in which one job more is done."""
        np = self.np
        behind: Flags = np.zeros(len(keys), dtype=bool)
        for k in range(len(self.deals.table.jobs)):
            bit = 1 << (k + len(self.moves.tables))
            undone = np.nonzero(keys & bit)[0]
            others = keys[undone] - bit
            at = np.minimum(np.searchsorted(keys, others), len(keys) - 1)
            behind[undone] |= keys[at] == others
        return behind

    def _packs(self) -> list[list[tuple[int, int]]]:
        """Returns columns and their bits, as many together as a whole number holds."""
        tables, jobs = len(self.moves.tables), len(self.deals.table.jobs)
        bits = [*[(len(self.cell) - 1).bit_length()] * self.count, jobs, tables]
        packs: list[list[tuple[int, int]]] = [[]]
        for column, width in enumerate(bits):
            if sum(w for _, w in packs[-1]) + width > 63:
                packs.append([])
            packs[-1].append((column, width))
        return packs

    def _left(self, layer: Numbers) -> tuple[Numbers, Numbers]:
        """Returns of each state the steps that are left at least, and how many all robots do then."""
        np, k = self.np, self.count
        least, total = np.full((2, len(layer)), NEVER, dtype=np.int64)
        order = np.argsort(layer[:, k], kind="stable")
        sets, first = np.unique(layer[order, k], return_index=True)
        for jobs, rows in zip(sets.tolist(), np.split(order, first[1:])):
            deals = self._deals_of(jobs)
            size = max(1, CELLS // len(deals))
            for at in range(0, len(rows), size):
                part = rows[at : at + size]
                longest, sums = np.zeros((2, len(part), len(deals)), dtype=np.int16)
                for robot in range(k):
                    cell = self.cell[layer[part, robot]]
                    cost = self.flat[robot][cell[:, None] - deals[None, :, robot]]
                    np.maximum(longest, cost, out=longest)
                    np.minimum(sums + cost, NEVER, out=sums)
                least[part] = longest.min(1)
                total[part] = np.where(longest == least[part, None], sums, NEVER).min(1)
        return least, total

    def _deals_of(self, jobs: int) -> Numbers:
        """Returns what is left of the deals where only ``jobs`` are left, as distances between cells."""
        found = self._dealt_of.get(jobs)
        if found is None:
            left = self.np.unique(self._dealt & jobs, axis=0)
            found = self._dealt_of[jobs] = self.deals.offsets[left] * self.moves.nodes
        return found

    def _spread(self, layer: Numbers, width: int) -> Numbers:
        """Returns which states go on: of every number of steps left as many.

        Where only the best went on, all would lie before the same narrow place and none behind it.
        """
        np = self.np
        least, total = self._left(layer)
        order = np.lexsort((self.rng.random(len(layer)), layer[:, -1], total, least))
        first = np.unique(least[order], return_index=True)[1]
        rank = np.concatenate([np.arange(len(group)) for group in np.split(order, first[1:])])
        found: Numbers = order[np.argsort(rank, kind="stable")[:width]]
        return found

    def _plan(self, layers: list[Numbers], parents: list[Numbers], at: int) -> Plan:
        """Returns the plan that leads to a state of the last layer."""
        rows = []
        for layer, parent in zip(reversed(layers), reversed(parents)):
            rows.append([int(value) for value in layer[at]])
            at = int(parent[at])
        rows.reverse()
        actions = []
        for step, (before, after) in enumerate(zip(rows, rows[1:])):
            for robot, option in zip(self.robots, self._options(before, after)):
                if option.name:
                    actions.append(Action(step, option.name, (robot.name, *option.arguments)))
        return Plan(tuple(actions), len(rows) - 1)

    def _options(self, before: list[int], after: list[int]) -> list[RobotOption]:
        """Returns options, one a robot, that lead from one state to the next."""
        k = self.count

        def choose(robot: int, jobs: int, seats: int) -> list[RobotOption] | None:
            if robot == k:
                return None if jobs or seats else []
            for option in self.moves.of(before[robot]):
                fits = not option.job & ~jobs and not option.table & ~seats
                if option.after == after[robot] and fits:
                    rest = choose(robot + 1, jobs & ~option.job, seats & ~option.table)
                    if rest is not None:
                        return [option, *rest]
            return None

        chosen = choose(0, before[k] & ~after[k], after[k + 1] & ~before[k + 1])
        assert chosen is not None
        return chosen
