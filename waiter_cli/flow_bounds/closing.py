"""Closes the gap between two bounds: relaxation, plans read off it, and branching where it is left.

Entry point `Closing`.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from waiter_cli.bounds import Bounds
from waiter_cli.bounds.distances import WalkDistances, standing
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.seating import Seating
from waiter_cli.flow_bounds.branching import Branching
from waiter_cli.flow_bounds.contraction import floor_of
from waiter_cli.flow_bounds.layer_builder import build_layers
from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.ordered_jobs import find_ordered_jobs
from waiter_cli.flow_bounds.relaxation import FlowRelaxation
from waiter_cli.flow_bounds.walk_reading import read_plan
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem

__all__ = ["Closing"]

_WORK = 100_000
"""What is spent on improving a plan that was read off, in about microseconds."""
_TRIES = 8
"""How often plans are looked for, at most."""
_APPROACHES = (1, 3)
"""The patience of each approach: a plan is read early, since its length ends much of the work."""
_REPAIRS = 4
"""How many flows in whole numbers are looked at, each without the circles of the one before."""
_SECONDS = 2.0
"""What looking for a flow in whole numbers may take, each time."""


class Closing:
    """One problem's bounds, ``lower`` and the length of ``plan``, and what makes them better."""

    def __init__(self, problem: Problem, bounds: Bounds) -> None:
        assert bounds.plan is not None
        self.lower = bounds.lower
        self.plan: Plan = bounds.plan
        needs = find_needs(problem)
        self.staff = standing(problem)
        walks = WalkDistances(problem, self.staff.fixed.values())
        self.seating = Seating(problem, needs, walks)
        self.jobs = find_ordered_jobs(self.seating, Builder(self.seating, Clock(0, None)))
        self.floor = floor_of(walks, self.seating.start)
        self.layers: Layers | None = None
        self.relaxation: FlowRelaxation | None = None

    def run(
        self,
        deadline: float | None = None,
        tell: Callable[[int, int], None] = lambda lower, upper: None,
    ) -> None:
        """Improves the bounds until they meet, nothing more helps, or the deadline."""
        most = self.plan.horizon
        self.layers = build_layers(self.jobs, self.floor)
        relaxation = self.relaxation = FlowRelaxation(self.layers, most, fixes=True)

        def better(bound: int) -> None:
            bound = min(bound + self.jobs.deeds, self.plan.horizon)
            if bound > self.lower:
                self.lower = bound
                tell(self.lower, self.plan.horizon)

        for attempt in range(_TRIES):
            enough = self.plan.horizon - self.jobs.deeds
            if attempt < len(_APPROACHES):
                done = relaxation.approach(enough, deadline, better, _APPROACHES[attempt])
            else:
                done = relaxation.solve(enough, deadline, better)
            late = deadline is not None and time.monotonic() > deadline
            if self.lower >= self.plan.horizon or late:
                return
            known = self.plan.horizon
            self.read(deadline)
            if self.plan.horizon < known:
                tell(self.lower, self.plan.horizon)
                if self.lower >= self.plan.horizon:
                    return
            elif done:
                break
        self.branch(deadline, tell)

    def branch(
        self,
        deadline: float | None = None,
        tell: Callable[[int, int], None] = lambda lower, upper: None,
    ) -> None:
        """Divides what is open into cases."""
        relaxation = self.relaxation
        assert relaxation is not None

        def read() -> int:
            known = self.plan.horizon
            self.read(deadline)
            if self.plan.horizon < known:
                tell(self.lower, self.plan.horizon)
            return self.plan.horizon - self.jobs.deeds

        branching = Branching(relaxation, self.plan.horizon - self.jobs.deeds, read, deadline)
        if branching.refute():
            self.lower = self.plan.horizon
            tell(self.lower, self.plan.horizon)

    def prove(self, deadline: float | None = None) -> None:
        """Improves the lower bound alone, as far as cuts go."""
        self.layers = build_layers(self.jobs, self.floor)
        relaxation = self.relaxation = FlowRelaxation(self.layers, self.plan.horizon)
        enough = self.plan.horizon - self.jobs.deeds
        for _ in range(_TRIES):
            if relaxation.solve(enough, deadline) or relaxation.bound >= enough:
                break
        self.lower = max(self.lower, min(relaxation.bound + self.jobs.deeds, self.plan.horizon))

    def read(self, deadline: float | None) -> None:
        """Looks for a shorter plan near the last solution."""
        relaxation = self.relaxation
        assert relaxation is not None and self.layers is not None
        until = time.monotonic() + _SECONDS
        until = until if deadline is None else min(until, deadline)
        for _ in range(_REPAIRS):
            flow = relaxation.whole_flow(until)
            if flow is None:
                return
            builder = Builder(self.seating, Clock(_WORK, deadline))
            found = read_plan(builder, self.staff, self.layers, flow, self.lower)
            if found is not None and found.horizon < self.plan.horizon:
                self.plan = found
            if self.plan.horizon <= self.lower or not relaxation.repair(flow):
                return
