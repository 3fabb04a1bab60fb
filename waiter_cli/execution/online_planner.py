"""Plans for an executive within one process. Entry point `OnlinePlanner`.

Nothing is started for a search and nothing is loaded twice.  The bounds say at once what cannot be,
and mostly how long a plan must be; the plan itself is an answer set of the SPARC program, checked
by executing it.  Where that cannot be had in the time allowed, the constructed plan of the bounds is
given, marked as what it is.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from sparc import limits
from waiter_cli.encoding.aliases import Aliases
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal

if TYPE_CHECKING:
    from waiter_cli.bounds import Bounds
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.state import State
    from waiter_cli.planning.search_results import SearchStage
    from waiter_cli.rules.rulebook import Rulebook
    from waiter_cli.translators.base import Translator

__all__ = ["TIME_LIMIT", "OnlinePlanner"]

TIME_LIMIT = 0.4
"""Seconds that a search may take unless told otherwise: a robot that waits is of no use."""
_FOR_BOUNDS = 0.3  # of the time, at most
_FOR_PROGRAMME = 0.7  # of the time, at most, with what the bounds took
_SECONDS_PER_STEP_AND_PLACE = 1e-4  # to ground and to solve once, on a machine that is not fast

_HOPELESS = 6.0  # so many times the time that is left, even for a plan that need only be confirmed


@dataclass
class OnlinePlanner:
    """The planner of one domain; ``time_limit`` is in seconds for each search, None for no limit.

    Plans have ``max_steps`` steps at most, where that is given.  ``report`` is told the stages of
    each search.  ``searches`` and ``late`` count the searches, and those that the limit ended.

    With ``by_bounds``, for runs of thousands of decisions, the program is not asked for a plan where
    the bounds have one that they prove to be least: it is judged by the rules alone (and several
    robots take any plan of the bounds).  So it is always
    where the program could by no means be grounded in time.

    ``seconds_in_all`` limit the searches of one `decision` together, where somebody waits for its answer.

    With ``limited_as_a_whole`` a limit of the whole command (`sparc.limits`) that comes in a search ends
    the command; else the search has an answer for it, and whoever asked goes on.
    """

    translator: Translator
    domain: Domain
    time_limit: float | None = TIME_LIMIT
    strategy: str = "binary"
    max_steps: int | None = None
    report: Callable[[Sequence[SearchStage]], None] | None = None
    searches: int = 0
    late: int = 0
    by_bounds: bool = False
    limited_as_a_whole: bool = False
    seconds_in_all: float | None = None
    _until: float | None = field(default=None, repr=False)
    _last: tuple[Problem, Bounds] | None = field(default=None, repr=False)

    @property
    def rules(self) -> Rulebook:
        """Returns the rules by which the plans are played: the domain's own, unless Python has them."""
        from waiter_cli.domain_execution.domain_rules import kept_rules
        from waiter_cli.rules.rulebook import HOUSE

        return HOUSE if self.domain.built_in else kept_rules(self.domain)

    @contextmanager
    def decision(self) -> Iterator[None]:
        """Has the searches within share ``seconds_in_all``; what is asked later is undecided at once."""
        if self.seconds_in_all is not None:
            self._until = time.monotonic() + self.seconds_in_all
        try:
            yield
        finally:
            self._until = None

    def _seconds(self) -> float | None:
        """Returns how long a search may take that begins now."""
        if self._until is None:
            return self.time_limit
        left = max(0.0, self._until - time.monotonic())
        return left if self.time_limit is None else min(self.time_limit, left)

    def plan(self, problem: Problem) -> PlannerAnswer:
        """Returns the shortest plan, or the best one found in time, or why there is none."""
        try:
            return self._plan(problem)
        finally:
            if self.limited_as_a_whole:
                limits.resume()

    def _plan(self, problem: Problem) -> PlannerAnswer:
        from waiter_cli.planning.planner import find_plan
        from waiter_cli.planning.search_results import SearchOptions

        limit = self._seconds()
        if limit == 0.0 and self.time_limit:
            return PlannerAnswer("undecided", limit="time")
        self.searches += 1
        if problem.layout.agents:
            return self._together(problem)
        start = time.monotonic()
        bounds = self.bounds(problem) if self.domain.built_in else None
        left = limit
        tightened: Bounds | None = None
        if limit is not None:
            left = max(0.0, limit - (time.monotonic() - start))
            if bounds is not None and _takes_longer(problem, bounds, left):
                bounds = tightened = self._tightened(problem, bounds, start)
                left = max(0.0, limit - (time.monotonic() - start))
                if _takes_longer(problem, bounds, left):
                    return self._makeshift(problem, bounds.lower)
        quick = self._quick(problem, bounds, left)
        if quick is not None:
            return quick
        aliases = Aliases.of_problem(problem) if self.domain.built_in else None
        if aliases is not None and tightened is not None and tightened.plan is not None:
            tightened = replace(tightened, plan=aliases.posed(tightened.plan))
        options = SearchOptions(self.strategy, self.max_steps, left, known=tightened)
        posed = problem if aliases is None else aliases.problem(problem)
        answer = find_plan(posed, self.translator, self.domain, options)
        result = answer.result
        plan = aliases.plan(answer.plan) if aliases and answer.plan else answer.plan
        if self.report is not None:
            self.report(result.stages)
        if answer.plan is None and result.limit is not None and bounds is not None:
            return self._makeshift(problem, result.bounds[0], result.limit)
        self.late += result.limit == "time"
        return PlannerAnswer(
            result.status.value,
            plan,
            result.minimal,
            self._reasons(problem, result.reasons),
            result.limit,
            result.bounds,
        )

    def _quick(
        self, problem: Problem, bounds: Bounds | None, left: float | None
    ) -> PlannerAnswer | None:
        """Returns what the bounds alone say, where the program need not or had better not be asked."""
        if bounds is None:
            return None
        if self.by_bounds and not problem.prefer:
            return self._proved(problem, bounds)
        if left is None:
            return None
        from sparc.solving.clingo_threads import left_behind

        if left_behind():  # a search of before cannot be stopped; two of them help nobody
            return self._proved(problem, bounds) or self._makeshift(problem, bounds.lower)
        if _grounding_seconds(problem, bounds) > _HOPELESS * left:
            return self._proved(problem, bounds)
        return None

    def _together(self, problem: Problem) -> PlannerAnswer:
        """Returns the answer for several robots, whose bounds the search finds by itself."""
        from sparc.solving.clingo_threads import left_behind
        from waiter_cli.planning.planner import find_plan
        from waiter_cli.planning.search_results import SearchOptions

        if self.by_bounds or left_behind():  # a search of before cannot be stopped
            from waiter_cli.fleets.fleet_bounds import find_fleet_bounds

            limit = self._seconds()
            bounds = find_fleet_bounds(problem, None if limit is None else time.monotonic() + limit)
            if bounds.impossible:
                return PlannerAnswer("no_plan", reasons=bounds.impossible)
            if bounds.plan is not None:
                least = bounds.plan.horizon
                found = bounds.lower, least
                return PlannerAnswer("plan", bounds.plan, bounds.lower == least, bounds=found)
        options = SearchOptions(self.strategy, self.max_steps, self._seconds())
        answer = find_plan(problem, self.translator, self.domain, options)
        result = answer.result
        if self.report is not None:
            self.report(result.stages)
        self.late += result.limit == "time"
        return PlannerAnswer(
            result.status.value,
            answer.plan,
            result.minimal,
            result.reasons,
            result.limit,
            result.bounds,
        )

    def _proved(self, problem: Problem, bounds: Bounds) -> PlannerAnswer | None:
        """Returns the plan of the bounds where nothing shorter can be and the rules allow it."""
        from waiter_cli.planning.tidy_plan import tidy
        from waiter_cli.rules.validator import run

        if bounds.plan is None or bounds.plan.horizon != bounds.lower:
            return None
        if self.max_steps is not None and bounds.lower > self.max_steps:
            return None
        plan = tidy(problem, bounds.plan, problem.prefer)
        if plan.horizon != bounds.lower or not run(problem, plan).valid:
            return None
        return PlannerAnswer("plan", plan, True, bounds=(bounds.lower, bounds.lower))

    def _reasons(self, problem: Problem, found: tuple[Reason, ...]) -> tuple[Reason, ...]:
        """Returns the reasons for no plan, in the names of the problem as it was given."""
        if not found or not self.domain.built_in:
            return found
        return self.bounds(problem).impossible or self.impossible(problem) or found

    def _makeshift(self, problem: Problem, lower: int, limit: str = "time") -> PlannerAnswer:
        """Returns the plan that the bounds put together, if it stands up to being executed."""
        from waiter_cli.rules.validator import run

        self.late += limit == "time"
        plan = self.bounds(problem).plan
        too_long = plan and self.max_steps is not None and plan.horizon > self.max_steps
        if plan is None or too_long or not run(problem, plan).valid:
            return PlannerAnswer("undecided", None, limit=limit, bounds=(lower, None))
        from waiter_cli.planning.tidy_plan import tidy

        plan = tidy(problem, plan, problem.prefer)
        bounds = (lower, plan.horizon)
        return PlannerAnswer("undecided", plan, limit=limit, bounds=bounds)

    def bounds(self, problem: Problem) -> Bounds:
        """Returns the bounds, which take no search; the last answer is kept."""
        if self._last is None or self._last[0] is not problem:
            from waiter_cli.bounds import find_bounds

            deadline = None
            if self.time_limit is not None:
                deadline = time.monotonic() + _FOR_BOUNDS * self.time_limit
            self._last = problem, find_bounds(problem, deadline=deadline)
        return self._last[1]

    def _tightened(self, problem: Problem, bounds: Bounds, start: float) -> Bounds:
        """Returns the bounds that the programme makes of these, in its share of the time."""
        from waiter_cli.flow_bounds import tighten

        assert self.time_limit is not None
        bounds = tighten(problem, bounds, deadline=start + _FOR_PROGRAMME * self.time_limit)
        self._last = problem, bounds
        return bounds

    def impossible(self, problem: Problem) -> tuple[Reason, ...]:
        """Returns reasons for no plan of any length, as far as they can be found without a search."""
        if not self.domain.built_in:
            return ()
        if problem.layout.agents:
            from waiter_cli.fleets.barriers import find_barriers

            return find_barriers(problem)
        from waiter_cli.bounds import find_impossible

        return find_impossible(problem)

    def least(self, problem: Problem) -> int:
        """Returns a length that no plan falls short of; 0 where nothing is known."""
        if problem.layout.agents or not self.domain.built_in:
            return 0
        return self.bounds(problem).lower

    def warm_up(self, layout: Layout, state: State) -> None:
        """Loads all that a search needs, by one that costs next to nothing; counts for nothing."""
        from waiter_cli.planning.planner import find_plan
        from waiter_cli.planning.search_results import SearchOptions

        if layout.bar is not None and self.domain.built_in:
            from waiter_cli.flow_bounds import load

            load()
        place = next(iter(state.stations().values()))
        near = layout.neighbours()[place]
        if near:
            goal = Goal("at", node=near[0])
            problem = Problem(layout, state, (), state, (goal,))
            find_plan(problem, self.translator, self.domain, SearchOptions(time_limit=1.0))


def _takes_longer(problem: Problem, bounds: Bounds, seconds: float) -> bool:
    """Returns whether a search is likely to be cut off before it has found anything better.

    Grounding cannot be stopped once it has begun, so it had better not be.
    """
    if bounds.plan is None or bounds.plan.horizon == bounds.lower:
        return False
    return _grounding_seconds(problem, bounds) > seconds


def _grounding_seconds(problem: Problem, bounds: Bounds) -> float:
    """Returns about how long it takes to ground and to solve for the plan of the bounds."""
    places = len(problem.layout.nodes) + len(problem.layout.tables)
    horizon = bounds.plan.horizon if bounds.plan is not None else 0
    return horizon * places * _SECONDS_PER_STEP_AND_PLACE
