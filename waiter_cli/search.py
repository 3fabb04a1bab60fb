"""`Problem`, translator → `SearchResult`: a plan with the proof that no shorter one exists.

Entry point `find_minimal_plan`.  The SPARC program decides; bounds only say where to look.

*Monotone.*  In our domains nothing need happen once the goals hold, and nothing can: an answer
set for horizon h is one for h+1 with an idle end.  So a plan exists within h+1 steps if one exists
within h, and bisection is sound; `tests/waiter_cli/test_search.py` compares it with linear search.
A domain of the user's own need not be monotone: it is searched horizon by horizon from 0.

*One grounding, many horizons.*  A program grounded at horizon H answers for every h <= H: the
atom ``__deadline(h)``, assumed true, demands that the goals hold at some step up to h.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from enum import Enum
from typing import TYPE_CHECKING, Protocol

from sparc.asp import AspProgram
from sparc.source import Source
from sparc.values import dataclass, field
from waiter_cli.plan import Action, Plan
from waiter_cli.preferences import chosen_preferences, preference_rules
from waiter_cli.problem import Problem, Reason
from waiter_cli.template import fill_template

if TYPE_CHECKING:
    import clingo

    from sparc.solvers.native import Grounding
    from waiter_cli.bounds import Bounds

__all__ = [
    "STRATEGIES",
    "Domain",
    "InvalidPlanError",
    "Probe",
    "SearchOptions",
    "SearchResult",
    "SearchStatus",
    "Translator",
    "find_minimal_plan",
]

STRATEGIES = ("binary", "linear", "gallop", "minimize")
LONG = 40  # steps from which a refutation takes clingo longer than better bounds take us
TIE_CONFLICTS = 20_000  # a second or two
OWN_DOMAIN_MAX_STEPS = 100  # for a domain of the user's own, unless told


class Translator(Protocol):
    """Either backend: SPARC text → ASP text."""

    @property
    def name(self) -> str:
        """``native`` or ``jar``."""
        ...

    @property
    def costly(self) -> bool:
        """Whether a translation takes so long that one is to serve for all horizons."""
        ...

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        """The clingo program; raises `sparc.SourceErrors` where the text is wrong."""
        ...


class SearchStatus(Enum):
    """How a search ended; four results that never stand for each other."""

    PLAN = "plan"
    NO_PLAN = "no_plan"
    CONTRADICTION = "contradiction"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Domain:
    """A template and what is known of it: ``built_in`` ones are monotone and have caps."""

    name: str
    template: Source
    built_in: bool = True


@dataclass(frozen=True, slots=True)
class Probe:
    """One horizon that was tried: ``result`` is ``sat``, ``unsat`` or ``unknown``."""

    horizon: int
    result: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Stage:
    """One stage of the work, for ``-v``: what came out, and the seconds it took."""

    name: str
    outcome: str
    seconds: float


@dataclass(frozen=True, slots=True)
class SearchOptions:
    """How to search; ``max_steps`` and ``time_limit`` (seconds) None: as long as it takes.

    ``use_bounds`` False leaves the module of bounds and hints out altogether; ``effort`` is what
    is spent on them where they do not meet at once (1: a quarter of a second, 10: two seconds).
    """

    strategy: str = "binary"
    max_steps: int | None = None
    time_limit: float | None = None
    use_bounds: bool = True
    effort: int = 10


@dataclass(frozen=True)
class SearchResult:
    """What was found.

    ``bounds`` are proved: no plan is shorter than the first, one of the second's length exists
    (None: not known).  ``proof`` says what shows the plan minimal: ``unsat`` (the next smaller
    horizon was refuted by solving) or ``bound`` (no plan can be shorter, by an admissible bound).
    ``limit`` says what stopped an undecided search: ``time``, ``memory`` or ``max_steps``.
    """

    status: SearchStatus
    bounds: tuple[int, int | None]
    strategy: str
    plan: Plan | None = None
    minimal: bool = False
    proof: str | None = None
    limit: str | None = None
    reasons: tuple[Reason, ...] = ()
    probes: tuple[Probe, ...] = ()
    seconds: float = 0.0
    stages: tuple[Stage, ...] = field(default=(), compare=False)


class InvalidPlanError(Exception):
    """A plan that the program allows and its check refuses: a defect of ours."""


class _Limit(Exception):
    """A limit was reached; ``args[0]`` is its name."""


class _NoPlan(Exception):
    """Every horizon up to the cap is refuted."""


# The deadline: assumed true for one h, it demands the goals by step h.
_DEADLINE = """
#defined goal/1.
__by(D) :- goal(I), D = I..{horizon}.
{{ __deadline(0..{horizon}) }}.
:- __deadline(D), not __by(D).
"""
# One action has to occur, while the goals do not hold yet.
_REQUIRED = """
__required :- occurs({action},I), not __by(I).
:- not __required.
"""
_SHOW = "#show occurs/2. #show goal/1."
# Each step before the goals hold costs one.
_MINIMIZE = "#minimize {{ 1,I : I = 0..{horizon}, not __by(I) }}."


def find_minimal_plan(
    problem: Problem,
    translator: Translator,
    domain: Domain,
    options: SearchOptions = SearchOptions(),
    *,
    required: Action | None = None,
) -> SearchResult:
    """The shortest plan for a problem, or the proof that there is none.

    ``required`` asks for one in which that action occurs, at whatever step it may.
    Raises `InputError` and `sparc.SourceErrors` where the domain is wrong, `sparc.SolverError`
    where clingo refuses its text.
    """
    search = _Search(problem, translator, domain, options, required)
    if problem.contradictions:
        return search.result(SearchStatus.CONTRADICTION, reasons=problem.contradictions)
    try:
        result = search.run()
        return search.settle_ties(result)
    except _NoPlan:
        return search.result(SearchStatus.NO_PLAN, reasons=search.unexplained())
    except _Limit as limit:
        return search.result(SearchStatus.UNDECIDED, limit=limit.args[0])
    except MemoryError:
        return search.result(SearchStatus.UNDECIDED, limit="memory")


class _Search:
    """The state of one search: what is proved so far, and the program grounded last."""

    def __init__(
        self,
        problem: Problem,
        translator: Translator,
        domain: Domain,
        options: SearchOptions,
        required: Action | None = None,
    ) -> None:
        self.problem = problem
        self.translator = translator
        self.domain = domain
        self.options = options
        self.start = time.monotonic()
        self.deadline = None if options.time_limit is None else self.start + options.time_limit
        self.lower = 0  # proved: no plan is shorter
        self.best: Plan | None = None  # the shortest plan known, an answer set
        self.probes: list[Probe] = []
        self.stages: list[Stage] = []
        self.grounding: Grounding | None = None
        self.horizon = -1  # of the grounding
        self.translated: tuple[int, AspProgram] | None = None  # the last translation
        self.bound_proof = True  # ``lower`` comes from a bound, not from a refutation
        self.cap: int | None = None
        self.enough: int | None = None  # a horizon that suffices, if there is a plan at all
        self.hint: Plan | None = None
        self.preferences = ""  # clingo text that settles ties, part of every grounding
        self.demand = "" if required is None else _REQUIRED.format(action=required.text)

    # ------------------------------------------------------------ results

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
            **more,  # type: ignore[arg-type]
        )

    def stage(self, name: str, outcome: str, since: float) -> None:
        self.stages.append(Stage(name, outcome, time.monotonic() - since))

    # ------------------------------------------------------------ the search

    def run(self) -> SearchResult:
        if not self.domain.built_in:
            return self.linear(OWN_DOMAIN_MAX_STEPS if self.options.max_steps is None else None)
        bounds = self.bounds()
        if bounds is not None and bounds.impossible:
            return self.result(SearchStatus.NO_PLAN, reasons=bounds.impossible)
        self.preferences = preference_rules(self.problem, chosen_preferences(self.problem))
        match self.options.strategy:
            case "linear":
                return self.linear()
            case "minimize":
                return self.minimize()
            case "gallop":
                return self.bisect()
        if bounds is not None:
            self.lower = bounds.lower
            self.hint = None if self.demand else bounds.plan
        return self.bisect()

    def bounds(self) -> Bounds | None:
        """What the abstraction says, None when it is left out."""
        self.enough = self.cap = crude_cap(self.problem)
        if not self.options.use_bounds:
            return None
        from waiter_cli.bounds import find_bounds

        since = time.monotonic()
        bounds = find_bounds(self.problem, deadline=self.deadline)
        if bounds.plan is not None and bounds.lower < bounds.plan.horizon >= LONG:
            bounds = find_bounds(self.problem, deadline=self.deadline, effort=self.options.effort)
        if bounds.cap is not None:
            self.cap = bounds.cap if self.cap is None else min(self.cap, bounds.cap)
        self.enough = self.cap
        if bounds.plan is not None and not self.demand:
            self.enough = bounds.plan.horizon
        upper = bounds.plan.horizon if bounds.plan else "unknown"
        self.stage("bounds", f"at least {bounds.lower} steps, a plan of {upper}", since)
        return bounds

    def linear(self, max_steps: int | None = None) -> SearchResult:
        """Horizon after horizon, each translated and grounded anew, as in the original.

        A costly translator translates once, for a horizon that suffices for all.
        """
        limit = self.options.max_steps if max_steps is None else max_steps
        horizon = 0
        while True:
            self.within(horizon, limit)
            if not (self.domain.built_in and horizon <= self.horizon):
                self.ground(self.reach(horizon))
            if self.probe(horizon):
                if not self.domain.built_in:
                    self.replay()
                return self.result(SearchStatus.PLAN)
            horizon += 1

    def replay(self) -> None:
        """Checks a plan by its own domain: with its actions as facts there is an answer set.

        Raises `InvalidPlanError` when there is none, which would be a defect of ours.
        """
        assert self.best is not None
        facts = "".join(f"occurs({action.text},{action.step}). " for action in self.best.actions)
        self.ground(self.best.horizon, facts)
        assert self.grounding is not None
        if not any(self.grounding.models(limit=1, deadline=self.deadline)):
            raise InvalidPlanError(f"the domain refuses its own plan: {facts}")

    def reach(self, horizon: int) -> int:
        """The horizon to ground for when ``horizon`` is to be probed."""
        if not (self.domain.built_in and self.translator.costly):
            return horizon
        top = horizon if self.enough is None else max(horizon, self.enough)
        return (
            top
            if self.options.max_steps is None
            else max(horizon, min(top, self.options.max_steps))
        )

    def within(self, horizon: int, limit: int | None) -> None:
        """Raises the limit that ``horizon`` passes; past the cap, nothing is left to search."""
        if self.domain.built_in and self.cap is not None and horizon > self.cap:
            raise _NoPlan
        if limit is not None and horizon > limit:
            raise _Limit("max_steps")

    def bisect(self) -> SearchResult:
        """Gallops to a horizon with a plan, unless one is known; then halves what is open."""
        limit = self.options.max_steps
        ceiling = min((x for x in (self.cap, limit) if x is not None), default=None)
        if self.hint is not None and (limit is None or self.hint.horizon <= limit):
            self.try_hint(self.hint)
        reach = max(self.lower, 1)
        while self.best is None:
            if ceiling is not None:
                if self.lower > ceiling:
                    if self.cap is not None and self.lower > self.cap:
                        return self.result(SearchStatus.NO_PLAN, reasons=self.unexplained())
                    raise _Limit("max_steps")
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
        limit = self.options.max_steps
        reach = 4
        while self.best is None:
            top = min(x for x in (reach, self.cap, limit) if x is not None)
            if top > self.horizon:
                self.ground(self.reach(top))
            if not self.probe(top):
                if self.cap is not None and top >= self.cap:
                    return self.result(SearchStatus.NO_PLAN, reasons=self.unexplained())
                if limit is not None and top >= limit:
                    raise _Limit("max_steps")
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

    # ------------------------------------------------------------ programs

    @property
    def template(self) -> str:
        """The text of the domain's template."""
        return self.domain.template.text

    def translate(self, horizon: int, offer: Plan | None = None) -> AspProgram:
        """The clingo program with steps 0..``horizon``; the last one is kept."""
        if offer is None and self.translated is not None and self.translated[0] == horizon:
            return self.translated[1]
        since = time.monotonic()
        source = fill_template(self.domain.template, self.problem, horizon, offer)
        self.stage("template", f"{source.text.count(chr(10)) + 1} lines of SPARC", since)
        since = time.monotonic()
        left = None if self.deadline is None else max(0.01, self.deadline - since)
        try:
            program = self.translator.translate(source, time_limit=left)
        except TimeoutError:
            raise _Limit("time") from None
        self.stage("translate", f"{program.text.count(chr(10)) + 1} lines of ASP", since)
        if offer is None:
            self.translated = (horizon, program)
        return program

    def ground(self, horizon: int, objective: str | None = None, offer: Plan | None = None) -> None:
        """Makes the program with steps 0..``horizon`` the one that is probed.

        ``objective`` takes the place of the preferences; ``offer`` is all it may choose from.
        """
        from sparc.solvers.native import Abandoned, Grounding

        program = self.translate(horizon, offer)
        since = time.monotonic()
        extra = self.demand + (self.preferences if objective is None else objective)
        grounding = Grounding(program, show=_SHOW, extra=_DEADLINE.format(horizon=horizon) + extra)
        try:
            grounding.ground(self.deadline)
        except Abandoned:
            raise _Limit("time") from None
        self.grounding, self.horizon = grounding, horizon
        self.stage("ground", f"horizon {horizon}", since)

    def probe(self, horizon: int, fixed: Plan | None = None) -> bool:
        """Whether a plan of at most ``horizon`` steps exists; keeps what that proves.

        ``fixed`` asks for one particular plan, whose failure proves nothing.
        """
        from sparc.solvers.native import Satisfiability

        assert self.grounding is not None
        since = time.monotonic()
        wanted = [_deadline(horizon)]
        if fixed is not None:
            wanted += [(_occurs(action), True) for action in fixed.actions]
        found = False
        for model in self.grounding.models(
            limit=1, assumptions=wanted, deadline=self.deadline, optimize=False
        ):
            found = True
            plan = _read_plan(model.symbols(shown=True), horizon)
            if self.best is None or plan.horizon < self.best.horizon:
                self.best = plan
        result = self.grounding.outcome.satisfiability
        seconds = time.monotonic() - since
        self.stage("solve", f"horizon {horizon}: {result.value}", since)
        if fixed is not None and not found:
            return False
        self.probes.append(Probe(horizon, result.value, round(seconds, 6)))
        if result is Satisfiability.UNKNOWN:
            raise _Limit("time")
        if not found:
            self.lower, self.bound_proof = horizon + 1, False
        return found

    def try_hint(self, hint: Plan) -> None:
        """Asks the program for one plan; falls back to any plan of that length.

        A plan that cannot be improved on, with no ties to settle, is offered to a program that
        has nothing else to choose from, which is much smaller.
        """
        if hint.horizon == self.lower and not self.preferences and "%{ offer" in self.template:
            self.ground(hint.horizon, offer=hint)
            if self.probe(hint.horizon):
                return
            self.probes.pop()
            self.lower, self.bound_proof = hint.horizon, True  # only the offer was refused
        self.ground(self.reach(hint.horizon))
        if not self.probe(hint.horizon, hint):
            self.probe(hint.horizon)

    def optimize(self) -> None:
        """Makes the best plan as short as can be, in one optimization."""
        assert self.best is not None
        known = self.best.horizon
        since = time.monotonic()
        self.ground(self.reach(known), _MINIMIZE.format(horizon=known))
        if not self.improve(known):
            raise _Limit("time")
        seconds = round(time.monotonic() - since, 6)
        self.probes.append(Probe(self.best.horizon, "sat", seconds))
        if self.best.horizon > self.lower:
            self.probes.append(Probe(self.best.horizon - 1, "unsat", 0.0))
            self.lower, self.bound_proof = self.best.horizon, False
        self.horizon = -1  # this program has another objective

    def settle_ties(self, result: SearchResult) -> SearchResult:
        """The result with the plan that the preferences choose among those of least length.

        To prove a choice the best can take longer than the plan itself, so the search for better
        ones ends after `TIE_CONFLICTS` conflicts: the same problem gets the same plan everywhere.
        When that or a limit comes first, the best choice so far stands: it is as short as any.
        """
        if result.plan is None or not self.preferences or not result.plan.actions:
            return result
        horizon = result.plan.horizon
        try:
            if horizon > self.horizon:
                self.ground(self.reach(horizon))
            self.improve(horizon, TIE_CONFLICTS)
        except (_Limit, MemoryError):
            self.stage("ties", "left open at the limit", time.monotonic())
        return self.result(SearchStatus.PLAN)

    def improve(self, horizon: int, conflicts: int | None = None) -> bool:
        """Replaces the best plan by one that is best for the grounding; whether that was proved.

        ``conflicts`` is where clingo ends at the latest.
        """
        assert self.grounding is not None
        since = time.monotonic()
        cost: list[int] = []
        for model in self.grounding.models(
            limit=0,
            assumptions=[_deadline(horizon)],
            deadline=self.deadline,
            optimize=True,
            conflicts=conflicts,
        ):
            cost = model.cost
            self.best = _read_plan(model.symbols(shown=True), horizon)
        proved = self.grounding.outcome.exhausted
        found = f"cost {cost}" if cost else "nothing better found"
        self.stage("optimize", f"horizon {horizon}, {found}, proved: {proved}", since)
        return proved


def _deadline(horizon: int) -> tuple[clingo.Symbol, bool]:
    """The assumption that the goals hold by step ``horizon``."""
    import clingo

    return clingo.Function("__deadline", [clingo.Number(horizon)]), True


def _occurs(action: Action) -> clingo.Symbol:
    import clingo

    arguments = [
        clingo.Number(int(name)) if name.isdigit() else clingo.Function(name)
        for name in action.arguments
    ]
    term = clingo.Function(action.name, arguments)
    return clingo.Function("occurs", [term, clingo.Number(action.step)])


def _read_plan(symbols: Sequence[clingo.Symbol], horizon: int) -> Plan:
    """The plan of one model: what occurs before the goals first hold."""
    end = min((s.arguments[0].number for s in symbols if s.name == "goal"), default=horizon)
    actions = []
    for symbol in symbols:
        if symbol.name == "occurs" and not symbol.negative:
            step = symbol.arguments[1].number
            if step < end:
                term = symbol.arguments[0]
                actions.append(Action(step, term.name, tuple(map(str, term.arguments))))
    actions.sort(key=lambda action: action.step)
    return Plan(tuple(actions), end)


def crude_cap(problem: Problem) -> int | None:
    """A length within which a plan exists if one exists at all.

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
