"""Least steps of one robot's tours, for every set of jobs at once: `Problem`, jobs → `TourTable`.

Dynamic programming over how far each job is (Held and Karp, 1962, with jobs of several stages): no
robot is in another one's way, and tables are free for whoever comes.  So what the table says of one
robot, no plan falls short of.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.fleets.jobs import Job, Jobs
from waiter_cli.fleets.routing import alone
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers = NDArray[np.int64]
    Costs = NDArray[np.int16]
    Flags = NDArray[np.bool_]

__all__ = ["NEVER", "Costs", "Flags", "Numbers", "TourJob", "TourTable", "tour_jobs"]

NEVER = 15_000
"""Steps of what cannot be done; twice as many are still a small number."""
MOST_CELLS = 40_000_000
"""So many entries a table may have: rows times nodes."""


@dataclass(frozen=True)
class TourJob:
    """A job for one robot from its first stage to its last; its places are numbers of nodes.

    ``deeds`` says of each stage whether it takes a step.  ``after`` is the number of the job that
    has to be done first, -1: none.
    """

    job: Job
    places: tuple[tuple[int, ...], ...]
    deeds: tuple[bool, ...]
    after: int = -1

    @property
    def last(self) -> int:
        """Returns the number of stages."""
        return len(self.places)


def tour_jobs(problem: Problem, jobs: Jobs, floor: WalkDistances) -> tuple[TourJob, ...]:
    """Returns the jobs, each in as many parts as different robots may do."""
    tables = {table.name: table.nodes for table in problem.layout.tables}

    def numbers(names: Sequence[str]) -> tuple[int, ...]:
        found = (floor.number[name] for name in dict.fromkeys(names))
        return tuple(node for node in found if node not in floor.shut)

    def made(job: Job, after: int = -1) -> TourJob:
        places = [numbers(stage.nodes) for stage in job.stages]
        deeds = [bool(stage.name) for stage in job.stages]
        if job.party:
            places.append(numbers([node for name in job.tables for node in tables[name]]))
            deeds.append(True)
        return TourJob(job, tuple(places), tuple(deeds), after)

    found: list[TourJob] = []
    for job in jobs.jobs:
        names = [stage.name for stage in job.stages]
        cut = names.index("send_order") + 1 if "send_order" in names else len(names)
        if cut == len(names):
            found.append(made(job))
        else:
            found.append(made(Job(job.stages[:cut], job.robot)))
            found.append(made(Job(job.stages[cut:], hands=True), len(found) - 1))
    return tuple(found)


class TourTable:
    """Rows are how far each job is; a job of another robot counts as done.

    ``costs`` [row, node] is the least number of steps from there until all is done.  A row is the sum
    of what is done of each job times its ``strides``; ``full`` is the row in which all is done.
    """

    def __init__(self, problem: Problem, jobs: Jobs) -> None:
        import numpy as np

        self.np = np
        staff = standing(problem)
        self.floor = WalkDistances(alone(problem, problem.state.robots[0]), staff.fixed.values())
        self.jobs = tour_jobs(problem, jobs, self.floor)
        self.sizes = [job.last + 1 for job in self.jobs]
        self.strides = [1, *accumulate(self.sizes, lambda a, b: a * b)][: len(self.jobs)]
        self.full = sum(stride * job.last for stride, job in zip(self.strides, self.jobs))
        count = len(self.floor.names)
        self.fits = (self.full + 1) * count <= MOST_CELLS
        self.ways = np.array([self.floor.row(node) for node in range(count)])
        self.ways = np.minimum(self.ways, NEVER).astype(np.int16)
        self._tables: dict[tuple[str | None, frozenset[str]], Costs] = {}

    def costs(self, end: str | None = None, never: frozenset[str] = frozenset()) -> Costs:
        """Returns the table for a robot that has to stand on ``end`` at last, None: anywhere.

        It can be on none of the nodes ``never``.
        """
        if (end, never) not in self._tables:
            self._tables[end, never] = self._filled(end, [self.floor.number[n] for n in never])
        return self._tables[end, never]

    def row_of(self, own: Sequence[tuple[int, int]]) -> int:
        """Returns the row in which just these jobs are not done: pairs of number and stages done."""
        left = sum((self.jobs[k].last - stage) * self.strides[k] for k, stage in own)
        return int(self.full - left)

    def begun(self, robot: Robot) -> tuple[tuple[int, int], ...]:
        """Returns the jobs that a robot has in hand at step 0."""
        return tuple((k, 0) for k, job in enumerate(self.jobs) if job.job.robot == robot.name)

    def offsets(self) -> Numbers:
        """Returns for each set of jobs (as bits) how much lower a row is in which they are to do."""
        np = self.np
        found: Numbers = np.zeros(1, dtype=np.int64)
        for stride, job in zip(self.strides, self.jobs):
            found = np.concatenate([found, found + stride * job.last])
        return found

    def _legal(self) -> Flags:
        """Rows in which at most one party is led, and the hands are full of one thing at most."""
        np = self.np
        rows = np.arange(self.full + 1)
        led, held = np.zeros(len(rows), np.int8), np.zeros(len(rows), np.int8)
        for stride, size, job in zip(self.strides, self.sizes, self.jobs):
            done = rows // stride % size
            busy = (done < size - 1) & ((done > 0) | (job.job.robot is not None))
            if job.job.party:
                led += busy
            if job.job.hands:
                held += busy
        legal: Flags = (led <= 1) & (held <= 1)
        return legal

    def _filled(self, end: str | None, never: list[int]) -> Costs:
        np = self.np
        nodes = self.ways.shape[0]
        table: Costs = np.full((self.full + 1, nodes), NEVER, dtype=np.int16)
        table[self.full] = 0 if end is None else self.ways[:, self.floor.number[end]]
        table[self.full, never] = NEVER
        legal, rows = self._legal(), np.arange(self.full + 1)
        level = sum(rows // s % size for s, size in zip(self.strides, self.sizes))
        order = np.argsort(level, kind="stable")
        first = np.searchsorted(level[order], np.arange(level[-1] + 2))
        stops = sorted({node for job in self.jobs for places in job.places for node in places})
        place = {node: index for index, node in enumerate(stops)}
        for depth in range(level[-1] - 1, -1, -1):
            here = order[first[depth] : first[depth + 1]]
            here = here[legal[here]]
            at_stop = np.full((len(here), len(stops)), NEVER, dtype=np.int16)
            for stride, size, job in zip(self.strides, self.sizes, self.jobs):
                done = here // stride % size
                for stage, places in enumerate(job.places):
                    chosen = np.nonzero(
                        (done == stage) & legal[np.minimum(here + stride, self.full)]
                    )[0]
                    if len(chosen):
                        cost = table[np.ix_(here[chosen] + stride, places)] + job.deeds[stage]
                        cells = np.ix_(chosen, [place[node] for node in places])
                        at_stop[cells] = np.minimum(at_stop[cells], cost)
            best = np.full((len(here), nodes), NEVER, dtype=np.int16)
            for index, node in enumerate(stops):
                np.minimum(best, at_stop[:, index, None] + self.ways[None, :, node], out=best)
            best[:, never] = NEVER
            table[here] = best
        return table
