"""`Problem`, translator → `SearchResult`: a plan with the proof that no shorter one exists.

Entry point `find_minimal_plan`.  The SPARC program decides (`probing`); bounds only say where to look.

*Monotone.*  In our domains nothing need happen once the goals hold, and nothing can: an answer
set for horizon h is one for h+1 with an idle end.  So a plan exists within h+1 steps if one exists
within h, and bisection is sound; `tests/waiter_cli/planning/test_strategies.py` compares it with linear search.
A domain of the user's own need not be monotone: unless it says ``%@ monotone``, it is asked for all
horizons of a grounding at once, each as the program of its own that it is (`horizon_ranges`).
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, cast

from sparc import limits
from waiter_cli.encoding.declarations import declarations_of
from waiter_cli.encoding.domains import Domain, domain_of_words
from waiter_cli.encoding.tie_breaks import chosen_preferences, fewest_actions, preference_rules
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.planning.horizon_ranges import HorizonRanges
from waiter_cli.planning.prober import LimitReached
from waiter_cli.planning.search_results import (
    InvalidPlanError,
    SearchOptions,
    SearchResult,
    SearchStatus,
)

if TYPE_CHECKING:
    from waiter_cli.bounds import Bounds
    from waiter_cli.fleets.fleet_bounds import FleetBounds
    from waiter_cli.translators.base import Translator

__all__ = ["STRATEGIES", "crude_cap", "end_of_bounds", "find_minimal_plan"]

STRATEGIES = ("binary", "linear", "gallop", "minimize")
LONG = 30  # steps from which a refutation takes clingo longer than better bounds take us
FIRST_EFFORT = 2  # what is spent on bounds before the programme has its turn
SMALL = 2000  # nodes times steps, up to which all the effort costs less than to load HiGHS
LARGE = 10_000  # nodes times steps, from which more effort gains less than it costs
PROGRAMME_SHARE = 0.5  # of the time limit; the rest is for the program to accept the plan
TELL_EVERY = 1.0  # seconds between two lines about the bounds
TIE_CONFLICTS = 20_000  # a second or two
# Seconds for ties, and the share of what the search took, if that is more: unasked, and asked for.
TIE_BUDGETS = {False: (0.5, 0.25), True: (4.0, 1.0)}
# Horizons of a domain of the user's own, before it is asked whether any helps, with the most states
# that are looked at then.
PROOF_AFTER = {3: 0, 9: 200, 17: 3000}
OWN_DOMAIN_MAX_STEPS = 100  # for a domain of the user's own, unless told
_DEALT_TRIES, _DEALT_CONFLICTS = 8, 4000  # horizons, and what each may cost
# Of the time for several robots the program has a share to take a plan, which rarely needs more; at
# least so many seconds (a floor of 120 nodes takes them), unless that is more than half.
_PROGRAM_SHARE, _PROGRAM_SECONDS = 0.2, 1.5
_MOST_PLACES = 3_500  # robots times nodes times steps, of which the best plan is looked for
FLEET_MAX_STEPS = 200  # for several robots, of whom no length is known to suffice, unless told


class _NoPlan(Exception):
    """Every horizon up to the cap is refuted."""


def find_minimal_plan(
    problem: Problem,
    translator: Translator,
    domain: Domain,
    options: SearchOptions = SearchOptions(),
    *,
    required: Action | None = None,
) -> SearchResult:
    """Returns the shortest plan for a problem, or the proof that there is none.

    ``required`` asks for one in which that action occurs, at whatever step it may.
    Raises `InputError` and `sparc.SourceErrors` where the domain is wrong, `sparc.SolverError`
    where clingo refuses its text.
    """
    from waiter_cli.domain_execution.domain_rules import believed

    domain = domain_of_words(problem, domain)
    problem = believed(problem, domain)
    search = _Search(problem, translator, domain, options, required)
    passed = limits.reached()
    if passed is not None:  # by what came before
        limits.settle()
        return search.result(SearchStatus.UNDECIDED, limit=passed)
    limits.resume()
    if problem.contradictions:
        return search.result(SearchStatus.CONTRADICTION, reasons=problem.contradictions)
    try:
        result = search.settle_ties(search.run())
    except _NoPlan:
        return search.result(SearchStatus.NO_PLAN, reasons=search.unexplained())
    except LimitReached as limit:
        return search.result(SearchStatus.UNDECIDED, limit=limit.args[0])
    except limits.OverLimit as over:
        limits.settle()
        return search.result(SearchStatus.UNDECIDED, limit=over.limit)
    except MemoryError:
        search.grounding = None
        return search.result(SearchStatus.UNDECIDED, limit="memory")
    if limits.reached() is not None:
        return result
    try:
        return search.tidied(result)
    except limits.OverLimit:  # the plan stands, as short as any
        limits.settle()
        return result


class _Search(HorizonRanges):
    """A prober with the strategies."""

    asked = 0  # horizons that were refuted when it was asked last whether any helps
    least = 0  # the lower bound for several robots, before anything was refuted
    chosen: tuple[str, ...] = ()  # the preferences, the most important first

    def result(self, status: SearchStatus, **more: object) -> SearchResult:
        upper = self.best.horizon if self.best else None
        minimal = status is SearchStatus.PLAN
        return SearchResult(
            status,
            (self.lower, upper),
            self.options.strategy,
            plan=self.best,
            minimal=minimal,
            proof=("bound" if self.bound_proof else "unsat") if minimal else None,
            probes=tuple(self.probes),
            seconds=time.monotonic() - self.start,
            stages=tuple(self.stages),
            max_steps=self.most,
            lacking=self.lacking,
            **more,  # type: ignore[arg-type]
        )

    @property
    def most(self) -> int | None:
        """The steps beyond which nothing is looked for."""
        if self.options.max_steps is None and not self.domain.built_in:
            return OWN_DOMAIN_MAX_STEPS
        if self.options.max_steps is None and self.problem.layout.agents:
            return max(FLEET_MAX_STEPS, 2 * self.least)
        return self.options.max_steps

    def run(self) -> SearchResult:
        if not self.domain.built_in:
            if self.options.strategy == "linear":
                return self.linear(self.most)
            return self.doubling() if declarations_of(self.domain).monotone else self.by_ranges()
        bounds = self.bounds()
        if bounds is not None and bounds.impossible:
            return self.result(SearchStatus.NO_PLAN, reasons=bounds.impossible)
        self.chosen = chosen_preferences(self.problem)
        self.preferences = preference_rules(self.problem, self.chosen)
        if self.problem.layout.agents:
            self.preferences = fewest_actions(self.problem) + self.preferences
        match self.options.strategy:
            case "linear":
                return self.linear()
            case "minimize":
                return self.minimize()
            case "gallop":
                return self.bisect()
        if bounds is not None:
            self.lower = bounds.lower
            if self.problem.layout.agents:
                return self.together(cast("FleetBounds", bounds))
            self.hint = None if self.demand else self.in_order(bounds.plan)
        return self.bisect()

    def bounds(self) -> Bounds | FleetBounds | None:
        """Returns the bounds of the abstraction, None when they are left out."""
        self.enough = self.cap = crude_cap(self.problem)
        if self.problem.layout.agents:
            return self.bounds_together()
        if not self.options.use_bounds:
            return None
        from waiter_cli.bounds import find_bounds

        since = time.monotonic()
        known = self.options.known
        bounds = known or find_bounds(self.problem, deadline=self.deadline)
        if known is None and bounds.plan is not None and bounds.lower < bounds.plan.horizon >= LONG:
            bounds = self.tightened(bounds)
        if bounds.cap is not None:
            self.cap = bounds.cap if self.cap is None else min(self.cap, bounds.cap)
        self.enough = self.cap
        if bounds.plan is not None and not self.demand:
            self.enough = bounds.plan.horizon
        told = f"a plan of {bounds.plan.horizon}" if bounds.plan else "no plan known"
        self.stage("bounds", f"at least {bounds.lower} steps, {told}", since)
        return bounds

    def bounds_together(self) -> FleetBounds | None:
        """Returns the bounds for several robots, of whose plans no length is known to suffice."""
        self.enough = self.cap = None
        if not self.options.use_bounds:
            return None
        from waiter_cli.fleets.fleet_bounds import find_fleet_bounds

        since = time.monotonic()
        deadline = None if self.deadline is None else end_of_bounds(since, self.deadline)
        bounds = find_fleet_bounds(self.problem, deadline, self.required)
        known = f"a plan of {bounds.plan.horizon}" if bounds.plan else "no plan known"
        self.stage("bounds", f"at least {bounds.lower} steps, {known}", since)
        return bounds

    def together(self, bounds: FleetBounds) -> SearchResult:
        """Searches for several robots: from the lower bound on, or down from what they were dealt."""
        self.least = self.lower
        limit = self.most
        hint = bounds.plan
        if hint is not None and (limit is None or hint.horizon <= limit):
            self.ground(hint.horizon, offer=hint)
            if not self.probe(hint.horizon):
                self.probes.pop()
                self.lower, self.bound_proof = self.least, True  # only the offer was refused
        if self.best is None or self.best.horizon > self.lower:
            self.deals = bounds.deals
            if self.deals:
                self.follow_deals(max(self.lower, bounds.length))
            if self.best is None or not self.deals:
                self.ascend()
        assert self.best is not None
        while self.best.horizon > self.lower:
            self.probe_anew(self.best.horizon - 1)
        return self.result(SearchStatus.PLAN)

    def probe_anew(self, horizon: int, reach: int = 0) -> bool:
        """Returns whether a plan of ``horizon`` steps exists; grounds for ``reach`` where it has to."""
        if self.offered or horizon > self.horizon:
            self.ground(max(horizon, reach))
        return self.probe(horizon)

    def follow_deals(self, first: int) -> None:
        """Looks for a plan in which each robot does what was dealt to it, from the shortest on."""
        last = first + _DEALT_TRIES if self.best is None else self.best.horizon - 1
        if self.most is not None:
            last = min(last, self.most)
        if first > last:
            return
        self.ground(last)
        for horizon in range(first, last + 1):
            if self.probe_dealt(horizon, _DEALT_CONFLICTS):
                return

    def ascend(self) -> None:
        """Probes from the lower bound on, in growing steps, until there is a plan."""
        stride = 0
        while self.best is None or self.best.horizon > self.lower:
            top = self.most if self.best is None else self.best.horizon - 1
            if top is not None and self.lower > top:
                raise LimitReached("max_steps")
            reach = self.lower + stride if top is None else min(self.lower + stride, top)
            ahead = reach + 2 if top is None else min(reach + 2, top)
            if self.probe_anew(reach, ahead):
                return
            stride = max(1, 2 * stride)

    def tightened(self, bounds: Bounds) -> Bounds:
        """Returns better bounds: by more effort, then by the programme, where they do not meet.

        Where the programme cannot be had, the effort is all there is, and larger.  So it is in small
        problems, which it nearly always closes before HiGHS is loaded.  In large ones there is none.
        """
        from waiter_cli.flow_bounds import is_available, tighten

        programme = is_available()
        assert bounds.plan is not None
        size = len(self.problem.layout.nodes) * bounds.plan.horizon
        if not programme or size <= LARGE:
            effort = self.options.effort
            if programme and size > SMALL:
                effort = min(effort, FIRST_EFFORT)
            bounds = self.improved(bounds, effort)
        assert bounds.plan is not None
        plan = bounds.plan
        if not programme or bounds.lower >= plan.horizon:
            self.lacking = "" if programme else "highspy"
            return bounds
        since = last = time.monotonic()
        self.stage("bounds", f"at least {bounds.lower} steps, a plan of {plan.horizon}", since)

        def tell(lower: int, upper: int) -> None:
            nonlocal last
            self.lower = lower
            if time.monotonic() > last + TELL_EVERY:
                last = time.monotonic()
                self.stage("programme", f"at least {lower} steps, a plan of {upper}", since)

        deadline = None
        if self.options.time_limit is not None:
            deadline = self.start + PROGRAMME_SHARE * self.options.time_limit
        return tighten(self.problem, bounds, deadline=deadline, tell=tell)

    def improved(self, bounds: Bounds, effort: int) -> Bounds:
        """Returns the best of these bounds and of those that ``effort`` finds."""
        from dataclasses import replace

        from waiter_cli.bounds import find_bounds

        found = find_bounds(self.problem, deadline=self.deadline, effort=effort)
        plans = [plan for plan in (found.plan, bounds.plan) if plan is not None]
        plan = min(plans, key=lambda plan: plan.horizon)
        return replace(found, lower=max(bounds.lower, found.lower), plan=plan)

    def linear(self, max_steps: int | None = None, first: int = 0) -> SearchResult:
        """Horizon after horizon, each translated and grounded anew, as in the original.

        A costly translator translates once, for a horizon that suffices for all.
        """
        limit = self.most if max_steps is None else max_steps
        horizon = first
        while True:
            self.within(horizon, limit)
            if not (self.domain.built_in and horizon <= self.horizon):
                self.ground(self.reach(horizon))
            if self.probe(horizon):
                if not self.domain.built_in:
                    self.replay()
                return self.result(SearchStatus.PLAN)
            horizon += 1
            reasons = self.proved_impossible()
            if reasons is not None:
                return self.result(SearchStatus.NO_PLAN, reasons=reasons)

    def doubling(self) -> SearchResult:
        """Doubles the horizon until there is a plan, then halves what is open, in one grounding.

        For a domain that says it is monotone; the plan is checked at its own horizon all the same.
        """
        most, reach = self.most or OWN_DOMAIN_MAX_STEPS, 1
        while self.best is None:
            self.within(self.lower, most)
            self.ground(min(reach, most))
            if not self.probe(min(reach, most)):
                reasons = self.proved_impossible()
                if reasons is not None:
                    return self.result(SearchStatus.NO_PLAN, reasons=reasons)
            reach *= 2
        while self.best.horizon > self.lower:
            self.probe((self.lower + self.best.horizon - 1) // 2)
        self.replay()
        return self.result(SearchStatus.PLAN)

    def by_ranges(self) -> SearchResult:
        """Asks for all horizons of one grounding at once, then for all that are shorter than what was found.

        For a domain that need not be monotone.  Groundings double; a program that has no open horizon
        is searched horizon after horizon.
        """
        most, reach = self.most, 1
        assert most is not None
        while self.best is None:
            self.within(self.lower, most)
            reach = min(max(reach, self.lower), most)
            if not self.ground_open(reach):
                return self.linear(most, self.lower)
            if not self.ask_range(self.lower, reach):
                reasons = self.proved_impossible()
                if reasons is not None:
                    return self.result(SearchStatus.NO_PLAN, reasons=reasons)
            reach *= 2
        while self.best.horizon > self.lower:
            self.ask_range(self.lower, self.best.horizon - 1)
        self.replay()
        return self.result(SearchStatus.PLAN)

    def proved_impossible(self) -> tuple[Reason, ...] | None:
        """Returns why a domain of one's own has no plan of any length, None where that is not proved.

        It is asked when so many horizons were refuted as `PROOF_AFTER` says, and at the limit.
        """
        if self.domain.built_in:
            return None
        at_limit = self.most is not None and self.lower > self.most
        refuted = max(self.lower, min(PROOF_AFTER)) if at_limit else self.lower
        due = [after for after in PROOF_AFTER if self.asked < after <= refuted]
        if not due:
            return None
        from waiter_cli.planning.no_plan_proof import prove_no_plan

        since = time.monotonic()
        self.asked = due[-1]
        most = PROOF_AFTER[self.asked]
        reasons = prove_no_plan(self.problem, self.domain, self.deadline, self.required, most)
        self.stage("proof", "no plan of any length" if reasons else "none found", since)
        return reasons

    def replay(self) -> None:
        """Checks a plan by its own domain: with its actions as facts there is an answer set.

        Raises `InvalidPlanError` when there is none, which would be a defect of ours, `LimitReached`
        where the time is over before that is known.
        """
        from sparc.solving.clingo_solver import Satisfiability

        assert self.best is not None
        facts = "".join(f"occurs({action.text},{action.step}). " for action in self.best.actions)
        self.ground(self.best.horizon, facts)
        assert self.grounding is not None
        if list(self.grounding.models(limit=1, deadline=self.deadline)):
            return
        if self.grounding.outcome.satisfiability is Satisfiability.UNKNOWN:
            raise LimitReached("time")
        raise InvalidPlanError(f"the domain refuses its own plan: {facts}")

    def within(self, horizon: int, limit: int | None) -> None:
        """Raises the limit that ``horizon`` passes; past the cap, nothing is left to search."""
        if self.domain.built_in and self.cap is not None and horizon > self.cap:
            raise _NoPlan
        if limit is not None and horizon > limit:
            raise LimitReached("max_steps")

    def bisect(self) -> SearchResult:
        """Gallops to a horizon with a plan, unless one is known; then halves what is open."""
        limit = self.most
        ceiling = min((x for x in (self.cap, limit) if x is not None), default=None)
        if self.hint is not None and (limit is None or self.hint.horizon <= limit):
            self.try_hint(self.hint)
        reach = max(self.lower, 1)
        while self.best is None:
            if ceiling is not None:
                if self.lower > ceiling:
                    if self.cap is not None and self.lower > self.cap:
                        return self.result(SearchStatus.NO_PLAN, reasons=self.unexplained())
                    raise LimitReached("max_steps")
                reach = min(reach, ceiling)
            if reach > self.horizon:
                self.ground(self.reach(reach))
            self.probe(reach)
            reach = 2 * reach
        while self.best.horizon > self.lower:
            middle = (self.lower + self.best.horizon - 1) // 2
            self.probe(middle)
        return self.result(SearchStatus.PLAN)

    def minimize(self) -> SearchResult:
        """One optimization at a horizon that has a plan."""
        limit = self.most
        reach = 4
        while self.best is None:
            top = min(x for x in (reach, self.cap, limit) if x is not None)
            if top > self.horizon:
                self.ground(self.reach(top))
            if not self.probe(top):
                if self.cap is not None and top >= self.cap:
                    return self.result(SearchStatus.NO_PLAN, reasons=self.unexplained())
                if limit is not None and top >= limit:
                    raise LimitReached("max_steps")
            reach *= 2
        if self.best.horizon > self.lower:
            self.optimize()
        return self.result(SearchStatus.PLAN)

    def unexplained(self) -> tuple[Reason, ...]:
        return (
            Reason(
                f"no plan of up to {self.cap} steps reaches the goals, and where one exists "
                "at all, one of that length does"
            ),
        )

    def try_hint(self, hint: Plan) -> None:
        """Asks the program for one plan; falls back to any plan of that length.

        A plan that cannot be improved on, with no ties to settle, is offered to a program that
        has nothing else to choose from, which is much smaller.
        """
        if hint.horizon == self.lower and not self.preferences and self.takes_offers:
            self.ground(hint.horizon, offer=hint)
            if self.probe(hint.horizon):
                return
            self.probes.pop()
            self.lower, self.bound_proof = hint.horizon, True  # only the offer was refused
        self.ground(self.reach(hint.horizon))
        if not self.probe(hint.horizon, hint):
            self.probe(hint.horizon)

    def settle_ties(self, result: SearchResult) -> SearchResult:
        """Returns the result with the plan that the preferences choose among those of least length.

        To prove a choice the best can take longer than the plan itself, so the search for better
        ones ends after `TIE_CONFLICTS` conflicts, and after the seconds of `TIE_BUDGETS`.  When
        that or a limit comes first, the best choice so far stands: it is as short as any.
        """
        if result.plan is None or not self.preferences or not result.plan.actions:
            return result
        if not self.options.choose:
            return result
        horizon = result.plan.horizon
        size = len(self.problem.layout.nodes) * len(self.problem.layout.agents) * horizon
        if size > _MOST_PLACES and (self.offered or horizon > self.horizon):
            return result  # several robots on a large floor: to choose takes longer than to plan
        now = time.monotonic()
        least, share = TIE_BUDGETS[bool(self.problem.prefer)]
        until = now + max(least, share * (now - self.start))
        if self.deadline is not None:
            until = min(until, self.deadline)
        try:
            if horizon > self.horizon or self.offered:
                self.ground(self.reach(horizon))
            proved = self.improve(horizon, TIE_CONFLICTS, until)
            late = self.deadline is not None and time.monotonic() >= self.deadline
            ties = "proved" if proved else "limit" if late else "budget"
        except (LimitReached, MemoryError, limits.OverLimit):
            limits.settle()
            self.stage("ties", "left open at the limit", time.monotonic())
            ties = "limit"
        return self.result(SearchStatus.PLAN, ties=ties)

    # ------------------------------------------------------------ what people call sensible

    def in_order(self, plan: Plan | None) -> Plan | None:
        """Returns a plan as long, with nothing postponed that lies on the way, as far as Python can tell."""
        if plan is None:
            return None
        from waiter_cli.planning.tidy_plan import tidy

        return tidy(self.problem, plan, self.chosen)

    def tidied(self, result: SearchResult) -> SearchResult:
        """Returns the result with its plan in order, where the program accepts that plan, too."""
        plan = result.plan
        settled = plan is None or not plan.actions or plan == self.hint
        settled = settled or bool(self.problem.layout.agents)
        if plan is None or settled or self.demand or not self.domain.built_in:
            return result
        found = self.in_order(plan)
        if self.hint is not None and self.hint.horizon == plan.horizon and result.ties != "proved":
            from waiter_cli.planning.tidy_plan import better

            found = better(self.problem, found or plan, self.hint, self.chosen)
        try:
            if found is None or found == plan or not self.accepts(found):
                return result
        except (LimitReached, MemoryError):
            return result
        self.best = found
        return self.result(result.status, ties=result.ties)


def crude_cap(problem: Problem) -> int | None:
    """Returns a length within which a plan exists if one exists at all.

    Every deed that changes more than the robot's place can be needed only once: a party is picked
    and seated once, a bill given once, an order taken, sent, taken up and brought once, an object
    refilled, carried and brought once, chairs brought once a table.  Between two deeds the robot
    walks a path that visits no node twice.  A timetable adds the steps until it has ended.
    """
    state, layout = problem.state, problem.layout
    parties = 2 * len(state.waiting) + bool(state.with_agent)
    orders = 4 * len(state.ready_to_order) + 3 * len(state.ordered) + 2 * len(state.sent)
    objects = 2 * len(state.ready) + 3 * len(state.empty) + bool(state.carrying)
    deeds = parties + len(state.wants_bill) + orders + objects + len(layout.tables)
    last = max((step for _, step, _ in layout.timetable), default=0)
    return last + (deeds + len(problem.before) + 2) * (1 + len(layout.nodes))


def end_of_bounds(since: float, deadline: float) -> float:
    """Returns when bounds for several robots end, so that the program has the time to take the plan."""
    left = deadline - since
    return deadline - max(left * _PROGRAM_SHARE, min(left / 2, _PROGRAM_SECONDS))
