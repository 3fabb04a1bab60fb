"""Joint states of several robots as rows of whole numbers, and what comes after them: `JointStates`.

A row has the state of each robot (`RobotMoves`), the jobs that nobody has begun and the tables taken,
as bits, and at last the actions done so far.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.joint.robot_moves import RobotMoves, RobotOption
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Flags, Numbers

__all__ = ["JointStates"]

KEY_BITS = 63
"""As many bits as a whole number holds that is not negative."""


class JointStates:
    """The states of one problem.  ``fits`` says whether each can be told by one number, its key."""

    def __init__(self, problem: Problem, deals: Deals, anywhere: tuple[str, ...] = ()) -> None:
        self.np, table = deals.np, deals.table
        self.deals, self.robots = deals, problem.state.robots
        self.moves = RobotMoves(problem, table)
        self.count, self.jobs = len(self.robots), table.jobs
        nodes = self.np.arange(self.moves.nodes)
        self.cell = (self.moves.row[:, None] * self.moves.nodes + nodes[None, :]).reshape(-1)
        self.flat = [costs.reshape(-1) for costs in deals.tables]
        self.own = [flat[self.cell] for flat in self.flat]
        number = table.floor.number
        self.anywhere = [number[node] for node in anywhere]
        groups = [
            tuple(k for k in range(self.count) if deals.tables[k] is costs)
            for costs in deals.tables
        ]
        self.alike = [group for group in dict.fromkeys(groups) if len(group) > 1]
        one = (len(self.cell) - 1).bit_length()
        self.bits = [*[one] * self.count, len(self.jobs), len(self.moves.tables)]
        self.fits = sum(self.bits) <= KEY_BITS
        self.first_parts = sum({1 << job.after for job in self.jobs if job.after >= 0})
        posts = dict(problem.state.waiters)
        self.last = max((step for _, step, _ in problem.layout.timetable), default=0)
        self.staff: list[list[int]] = []
        for step in range(self.last + 1):
            posts |= {who: to for who, at, to in problem.layout.timetable if at == step}
            self.staff.append([number[node] for node in posts.values()])

    def start(self) -> Numbers:
        """Returns the state at step 0, as the only row."""
        states = [self.moves.start(robot) for robot in self.robots]
        row: Numbers = self.np.array([[*states, sum(1 << k for k in self.deals.open), 0, 0]])
        return row

    def done(self, rows: Numbers) -> Flags:
        """Returns which states reach the goals."""
        done: Flags = rows[:, self.count] == 0
        for robot in range(self.count):
            done &= self.own[robot][rows[:, robot]] == 0
        for node in self.anywhere:
            done &= (rows[:, : self.count] % self.moves.nodes == node).any(1)
        return done

    # ------------------------------------------------------------ keys

    def keys(self, rows: Numbers) -> Numbers:
        """Returns a number for each state; states with equal ones can be gone on from alike.

        Robots with the same table are alike, so who of them is where makes no difference; nor does
        which tables are taken where no party is to come to them any more.
        """
        columns = [rows[:, robot] for robot in range(self.count)]
        for group in self.alike:
            for last in range(len(group) - 1, 0, -1):  # the largest goes to the end
                for one, next_ in zip(group[:last], group[1:]):
                    pair = columns[one], columns[next_]
                    columns[one], columns[next_] = self.np.minimum(*pair), self.np.maximum(*pair)
        taken = rows[:, self.count + 1] & self._wanted(rows)
        return self._packed([*columns, rows[:, self.count], taken])

    def _packed(self, columns: Sequence[Numbers]) -> Numbers:
        key: Numbers = self.np.zeros(len(columns[0]), dtype=self.np.int64)
        for column, bits in zip(columns, self.bits):
            key = key << bits | column
        return key

    def _undone(self, rows: Numbers) -> Numbers:
        """Returns the jobs that are not done, begun or not, as bits."""
        undone: Numbers = rows[:, self.count].copy()
        for robot in range(self.count):
            undone |= self.moves.busy[rows[:, robot] // self.moves.nodes]
        return undone

    def _wanted(self, rows: Numbers) -> Numbers:
        """Returns the tables at which parties may sit that do not sit yet, as bits."""
        np, undone = self.np, self._undone(rows)
        wanted: Numbers = np.zeros(len(rows), dtype=np.int64)
        for k, job in enumerate(self.jobs):
            bits = sum(1 << self.moves.tables.index(name) for name in job.job.tables)
            if job.job.party:
                wanted |= np.where(undone >> k & 1, bits, 0)
        return wanted

    def different(self, rows: Numbers) -> tuple[Numbers, Numbers]:
        """Returns the numbers of rows that are all the different ones, with fewest actions, and their keys.

        The keys are in order.
        """
        keys = self.keys(rows)
        first = self._first(keys, rows[:, -1])
        return first, keys[first]

    def _first(self, keys: Numbers, actions: Numbers) -> Numbers:
        """Returns for each different key the number of an entry with the fewest actions."""
        np = self.np
        order = np.argsort(actions.astype(np.int16), kind="stable")
        found: Numbers = order[np.unique(keys[order], return_index=True)[1]]
        return found

    def with_one_more_done(self, keys: Numbers) -> list[tuple[Numbers, Numbers]]:
        """Returns for each job the numbers of the keys in which it is open, and the keys without it."""
        found = []
        for k in range(len(self.jobs)):
            bit = 1 << (k + self.bits[-1])
            open_: Numbers = self.np.nonzero(keys & bit)[0]
            if len(open_):
                found.append((open_, keys[open_] - bit))
        return found

    # ------------------------------------------------------------ steps

    def following(self, rows: Numbers, step: int, length: int) -> tuple[Numbers, Numbers]:
        """Returns the states after a step, and the number of the row of which each one comes.

        Those are left out in which a robot cannot end what it has in hand within ``length``.
        """
        np, k, n = self.np, self.count, self.moves.nodes
        now, then = np.zeros(n, dtype=bool), np.zeros(n, dtype=bool)
        now[self.staff[min(step, self.last)]] = True
        then[self.staff[min(step + 1, self.last)]] = True
        here, undone = rows[:, :k] % n, self._undone(rows)
        source = np.arange(len(rows))
        for robot in range(k):
            index, option = self._options_of(rows[:, robot])
            moves, own = self.moves, self.moves.after[option]
            of = source[index]
            node, old = own % n, here[of, robot]
            fits = self.own[robot][own] < length - step
            fits &= (moves.job[option] & ~rows[index, k]) == 0
            fits &= (moves.seat[option] & rows[index, k + 1]) == 0
            fits &= (moves.need[option] & undone[of]) == 0
            fits &= ~then[node] & ((node == old) | ~now[node])
            for other in range(robot):
                there = rows[index, other] % n
                fits &= (there != node) & ((node != here[of, other]) | (there != old))
            index, option, source = index[fits], option[fits], of[fits]
            acted = option > moves.first[rows[index, robot]]
            rows = rows[index]
            rows[:, robot] = own[fits]
            rows[:, k] &= ~moves.job[option]
            rows[:, k + 1] |= moves.seat[option]
            rows[:, -1] += acted
            if robot + 1 < k and k > 2 and self.fits:
                keep = self._merged(rows, robot, here[source], undone[source])
                rows, source = rows[keep], source[keep]
        return rows, source

    def _options_of(self, states: Numbers) -> tuple[Numbers, Numbers]:
        """Returns all options of one robot's states: the number of the state, and of the option."""
        np, first = self.np, self.moves.first[states]
        counts = self.moves.first[states + 1] - first
        index: Numbers = np.repeat(np.arange(len(states)), counts)
        option = np.arange(len(index)) + (first - np.cumsum(counts) + counts)[index]
        return index, option

    def _merged(self, rows: Numbers, moved: int, here: Numbers, undone: Numbers) -> Numbers:
        """Returns which rows go on in the middle of a step, after the robots up to ``moved``.

        Of equal ones a single one does, where it makes no difference to the other robots where those
        came from: no robot stands where another one has yet to go away, and none has just ended the
        first part of a job in two.
        """
        np, n = self.np, self.moves.nodes
        bound: Flags = (undone & ~self._undone(rows) & self.first_parts) != 0
        for robot in range(moved + 1):
            for other in range(moved + 1, self.count):
                bound |= rows[:, robot] % n == here[:, other]
        free = np.nonzero(~bound)[0]
        columns = [rows[free, column] for column in range(self.count + 2)]
        first = free[self._first(self._packed(columns), rows[free, -1])]
        kept: Numbers = np.concatenate([first, np.nonzero(bound)[0]])
        return kept

    # ------------------------------------------------------------ plans

    def plan(self, rows: Sequence[Sequence[int]]) -> Plan:
        """Returns the plan that goes through these states, one a step."""
        actions = []
        for step, (before, after) in enumerate(zip(rows, rows[1:])):
            for robot, option in zip(self.robots, self._chosen(before, after)):
                if option.name:
                    actions.append(Action(step, option.name, (robot.name, *option.arguments)))
        return Plan(tuple(actions), len(rows) - 1)

    def _chosen(self, before: Sequence[int], after: Sequence[int]) -> list[RobotOption]:
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
