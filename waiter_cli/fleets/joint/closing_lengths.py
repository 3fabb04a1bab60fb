"""The least length of a plan for several robots, from both sides. Entry point `close_lengths`.

From below, lengths are refuted one after the other (`LeastLength`); from above, beam search finds
plans (`JointLayers`).  Both look at more and more states, until they meet or the time or work is spent.
"""

from __future__ import annotations

import time

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.deals import Deals
from waiter_cli.fleets.jobs import Jobs, find_jobs
from waiter_cli.fleets.joint.joint_layers import JointLayers, Outcome
from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.joint.least_length import LeastLength
from waiter_cli.fleets.tour_table import NEVER, TourTable
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.rules.validator import run

__all__ = ["Lengths", "close_lengths"]

ROUNDS = ((500, 10_000), (3_000, 200_000), (10_000, 2_000_000), (40_000, 20_000_000))
"""So many states a layer may have in beam search, and so many are looked at from below, by turns."""
WORK = 400_000
"""So many states are looked at where there is no deadline."""
LENGTH_WORK = 20
"""As many states as a layer takes of time, however small it is."""
MOST_LENGTHS = 40
"""So many lengths are refuted at a time, as long as no plan is known: there may be none."""
MOST_ROBOTS = 5


@dataclass(frozen=True)
class Lengths:
    """``lower``: no plan is shorter.  ``plan`` is the shortest that is known, None: none is."""

    lower: int
    plan: Plan | None


def close_lengths(
    problem: Problem, lower: int, plan: Plan | None, deadline: float | None = None
) -> Lengths:
    """Returns better bounds than ``lower`` and ``plan`` where it finds any; the same where it does not.

    ``deadline`` is of `time.monotonic`.
    """
    jobs = find_jobs(problem)
    if jobs is None or not jobs.jobs or len(problem.state.robots) > MOST_ROBOTS:
        return Lengths(lower, plan)
    table = TourTable(problem, jobs)
    if not table.fits:
        return Lengths(lower, plan)
    deals = Deals(problem, table, jobs.ends)
    least = deals.least()
    if least >= NEVER:  # no deal will do, but why is not known here
        return Lengths(lower, plan)
    lower = max(lower, least)
    if not _is_whole(problem, jobs):
        return Lengths(lower, plan)
    states = JointStates(problem, deals, jobs.anywhere)
    closing = _Closing(problem, states, LeastLength(states, least), lower, plan, deadline)
    closing.run()
    return Lengths(closing.lower, closing.plan)


def _is_whole(problem: Problem, jobs: Jobs) -> bool:
    """Returns whether a plan needs nothing but the jobs: hands and chairs are not in their way."""
    chairs = dict(problem.state.chairs)
    lacking = any(len(job.party) > chairs[table] for job in jobs.jobs for table in job.tables)
    return not (lacking or problem.before or any(
        (robot.leads and not any(job.party == robot.leads for job in jobs.jobs))
        or (robot.carries and not any(job.hands and job.robot == robot.name for job in jobs.jobs))
        for robot in problem.state.robots
    ))  # fmt: skip


class _Closing:
    """Both bounds, and what was spent on them."""

    def __init__(
        self,
        problem: Problem,
        states: JointStates,
        below: LeastLength,
        lower: int,
        plan: Plan | None,
        deadline: float | None,
    ) -> None:
        self.problem, self.deadline = problem, deadline
        self.layers, self.below = JointLayers(states), below
        self.lower, self.plan = lower, plan
        self.longest = 8 * max(lower, 16)  # no plan is looked for beyond that
        self.spent = 0
        self.failed = False

    def run(self) -> None:
        """Goes on until the bounds meet, or time or work is spent."""
        for width, most in ROUNDS:
            self._refute(most)
            if not self._open():
                return
            if self.plan is None:
                self._find(width)
            self._shorten(self.lower, width)

    def _open(self) -> bool:
        """Returns whether there is something to do, and time to do it."""
        met = self.plan is not None and self.plan.horizon <= self.lower
        late = self.deadline is not None and time.monotonic() > self.deadline
        spent = self.deadline is None and self.spent > WORK
        return not (met or late or spent or self.failed)

    def _take(self, outcome: Outcome, length: int) -> None:
        """Takes what became of one length: a plan that is found is kept."""
        self.spent += outcome.states + LENGTH_WORK * length
        if outcome.plan is not None:
            verdict = run(self.problem, outcome.plan)
            self.failed = not verdict.valid
            if verdict.makespan is not None and verdict.valid:
                actions = tuple(a for a in outcome.plan.actions if a.step < verdict.makespan)
                self.plan = Plan(actions, verdict.makespan)
        elif outcome.refuted:
            self.lower = max(self.lower, length + 1)

    def _refute(self, most: int) -> None:
        """Asks for the shortest open length until there is a plan, or ``most`` states were looked at."""
        last = self.lower + MOST_LENGTHS if self.plan is None else self.plan.horizon
        while self._open() and self.below.left.whole and self.below.next < last and most > 0:
            length = self.below.next
            outcome = self.below.ask(most, self.deadline)
            self._take(outcome, length)
            most -= outcome.states
            if not outcome.refuted:
                break

    def _beam(self, length: int, width: int) -> bool:
        """Returns whether beam search finds a plan of a length."""
        outcome = self.layers.search(length, width, self.deadline)
        self._take(outcome, length)
        return outcome.plan is not None

    def _find(self, width: int) -> None:
        """Looks for a plan in growing steps."""
        step = 1
        while self._open() and self.lower + step < self.longest:
            if self._beam(self.lower + step, width):
                return
            step *= 2

    def _shorten(self, shortest: int, width: int) -> None:
        """Looks for plans shorter than the one known, always halfway to the shortest that was not found."""
        while self.plan is not None and self._open() and shortest < self.plan.horizon:
            middle = (shortest + self.plan.horizon - 1) // 2
            if not self._beam(middle, width):
                shortest = middle + 1
