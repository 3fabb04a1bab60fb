"""Grounds a problem's program and asks it for plans: the building block of every strategy.

*One grounding, many horizons.*  A program grounded at horizon H answers for every h <= H: the
atom ``__deadline(h)``, assumed true, demands that the goals hold at some step up to h.
Entry point `Prober`.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from sparc.translation.asp_program import AspProgram
from waiter_cli.encoding.domains import Domain, domain_for
from waiter_cli.encoding.template import fill_template, slot_names
from waiter_cli.model.graph import distances
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import Probe, SearchOptions, SearchStage

if TYPE_CHECKING:
    import clingo

    from sparc.solving.clingo_solver import Grounding
    from waiter_cli.translators.base import Translator

__all__ = ["LimitReached", "Prober"]


class LimitReached(Exception):
    """A limit was reached; ``args[0]`` is its name."""


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
_HURRY = ":- holds(currentlocation(R,N),I), __left(R,N,D), I+D > {horizon}.\n"
# While it is assumed, each robot does nothing but walk and what was dealt to it.
_DEALT = """
{{ __dealt }}.
__goes(go_to(R,N)) :- occurs(go_to(R,N),I).
:- __dealt, occurs(A,I), not __goes(A), not __deal(A).
__did(A,I+1) :- occurs(A,I), __deal(A).
__did(A,I+1) :- __did(A,I), I < {horizon}.
:- __dealt, occurs(B,I), __then(A,B), not __did(A,I).
"""
_SHOW = "#show occurs/2. #show goal/1."
# Each step before the goals hold costs one.
_MINIMIZE = "#minimize {{ 1,I : I = 0..{horizon}, not __by(I) }}."


class Prober:
    """The bounds proved so far, and the program grounded last.

    ``required`` is an action that has to occur, at whatever step it may.
    """

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
        self.domain = domain_for(problem, domain)
        self.options = options
        self.start = time.monotonic()
        self.deadline = None if options.time_limit is None else self.start + options.time_limit
        self.lower = 0  # proved: no plan is shorter
        self.best: Plan | None = None  # the shortest plan known, an answer set
        self.probes: list[Probe] = []
        self.stages: list[SearchStage] = []
        self.grounding: Grounding | None = None
        self.horizon = -1  # of the grounding
        self.translated: tuple[int, AspProgram] | None = None  # the last translation
        self.lacking = ""  # a package without which the bounds stay apart
        self.bound_proof = True  # ``lower`` comes from a bound, not from a refutation
        self.cap: int | None = None
        self.enough: int | None = None  # a horizon that suffices, if there is a plan at all
        self.hint: Plan | None = None
        self.preferences = ""  # clingo text that settles ties, part of every grounding
        self.offered = False  # the grounding has nothing to choose from but one plan
        self.deals: tuple[Action, ...] = ()  # which of several robots does what, as a suggestion
        self.required = required
        self.demand = "" if required is None else _REQUIRED.format(action=required.text)

    def stage(self, name: str, outcome: str, since: float) -> None:
        self.stages.append(SearchStage(name, outcome, time.monotonic() - since))
        if self.options.listener is not None:
            self.options.listener(self.stages[-1])

    # ------------------------------------------------------------ programs

    def reach(self, horizon: int) -> int:
        """Returns the horizon to ground for when ``horizon`` is to be probed."""
        if not (self.domain.built_in and self.translator.costly):
            return horizon
        top = horizon if self.enough is None else max(horizon, self.enough)
        return (
            top
            if self.options.max_steps is None
            else max(horizon, min(top, self.options.max_steps))
        )

    @property
    def takes_offers(self) -> bool:
        """Returns whether the domain's template has a slot for one plan to choose from."""
        return "offer" in slot_names(self.domain.template)

    def translate(self, horizon: int, offer: Plan | None = None) -> AspProgram:
        """Returns the clingo program with steps 0..``horizon``; the last one is kept."""
        if offer is None and self.translated is not None and self.translated[0] == horizon:
            return self.translated[1]
        since = time.monotonic()
        source = fill_template(self.domain.template, self.problem, horizon, offer)
        self.stage("template", f"{len(source.text.splitlines())} lines of SPARC", since)
        since = time.monotonic()
        left = None if self.deadline is None else max(0.01, self.deadline - since)
        try:
            program = self.translator.translate(source, time_limit=left)
        except TimeoutError:
            raise LimitReached("time") from None
        self.stage("translate", f"{len(program.text.splitlines())} lines of ASP", since)
        if offer is None:
            self.translated = (horizon, program)
        return program

    def ground(self, horizon: int, objective: str | None = None, offer: Plan | None = None) -> None:
        """Makes the program with steps 0..``horizon`` the one that is probed.

        ``objective`` takes the place of the preferences; ``offer`` is all it may choose from.
        """
        from sparc.solving.clingo_solver import Grounding
        from sparc.solving.clingo_threads import Abandoned

        program = self.translate(horizon, offer)
        since = time.monotonic()
        extra = (
            self.hurry_text(horizon)
            + self.demand
            + self.dealt_text(horizon)
            + (self.preferences if objective is None else objective)
        )
        grounding = Grounding(program, show=_SHOW, extra=_DEADLINE.format(horizon=horizon) + extra)
        try:
            grounding.ground(self.deadline)
        except Abandoned:
            raise LimitReached("time") from None
        self.grounding, self.horizon, self.offered = grounding, horizon, offer is not None
        self.stage("ground", f"horizon {horizon}", since)

    def hurry_text(self, horizon: int) -> str:
        """Returns rules by which each of several robots is never farther from where it has to end than it can walk.

        They are implied; with them much is out of the question from the start.
        """
        goals = [g for g in self.problem.goals if g.kind == "at" and g.robot is not None]
        if not goals or not self.domain.built_in:
            return ""
        near = self.problem.layout.neighbours()
        before: dict[str, list[str]] = {name: [] for name in near}
        for here, nodes in near.items():
            for there in nodes:
                before[there].append(here)
        facts = []
        for goal in goals:
            left = distances(before, goal.node or "")
            facts += [
                f"__left({goal.robot},{node},{left.get(node, horizon + 1)})." for node in near
            ]
        return _HURRY.format(horizon=horizon) + "".join(facts)

    def dealt_text(self, horizon: int) -> str:
        """Returns the rules by which, while ``__dealt`` is assumed, robots do what was dealt to them."""
        if not self.deals:
            return ""
        facts = [f"__deal({action.text}). " for action in self.deals]
        for first, then in zip(self.deals, self.deals[1:]):
            if first.arguments[0] == then.arguments[0]:
                facts.append(f"__then({first.text},{then.text}). ")
        return _DEALT.format(horizon=horizon) + "".join(facts)

    def probe_dealt(self, horizon: int, conflicts: int) -> bool:
        """Returns whether there is a plan of at most ``horizon`` steps as dealt, found soon enough.

        That there is none proves nothing.
        """
        import clingo

        assert self.grounding is not None
        since = time.monotonic()
        wanted = [_deadline(horizon), (clingo.Function("__dealt"), True)]
        has_plan = False
        for model in self.grounding.models(
            limit=1, assumptions=wanted, deadline=self.deadline, optimize=False, conflicts=conflicts
        ):
            has_plan = True
            plan = self.read(model.symbols(shown=True), horizon)
            if self.best is None or plan.horizon < self.best.horizon:
                self.best = plan
        self.stage(
            "solve", f"horizon {horizon}, as dealt: {'sat' if has_plan else 'not found'}", since
        )
        return has_plan

    def probe(self, horizon: int, fixed: Plan | None = None) -> bool:
        """Returns whether a plan of at most ``horizon`` steps exists; keeps what that proves.

        ``fixed`` asks for one particular plan, whose failure proves nothing.
        """
        from sparc.solving.clingo_solver import Satisfiability

        assert self.grounding is not None
        since = time.monotonic()
        wanted = [_deadline(horizon)]
        if fixed is not None:
            wanted += self.exactly(fixed)
        has_plan = False
        for model in self.grounding.models(
            limit=1, assumptions=wanted, deadline=self.deadline, optimize=False
        ):
            has_plan = True
            plan = self.read(model.symbols(shown=True), horizon)
            if self.best is None or plan.horizon < self.best.horizon:
                self.best = plan
        result = self.grounding.outcome.satisfiability
        seconds = time.monotonic() - since
        self.stage("solve", f"horizon {horizon}: {result.value}", since)
        if fixed is not None and not has_plan:
            return False
        self.probes.append(Probe(horizon, result.value, round(seconds, 6)))
        if result is Satisfiability.UNKNOWN:
            raise LimitReached("time")
        if not has_plan:
            self.lower, self.bound_proof = horizon + 1, False
        return has_plan

    def read(self, symbols: Sequence[clingo.Symbol], horizon: int) -> Plan:
        """Returns the plan of one model, the actions of a step in the order of the robots."""
        plan = _read_plan(symbols, horizon)
        if not self.problem.layout.agents:
            return plan
        rank = {name: k for k, (name, _) in enumerate(self.problem.layout.agents)}
        actions = sorted(plan.actions, key=lambda action: (action.step, rank[action.arguments[0]]))
        return Plan(tuple(actions), plan.horizon)

    def exactly(self, plan: Plan) -> list[tuple[clingo.Symbol, bool]]:
        """Returns the assumptions that the grounding's plan is this one: also that nothing else is done."""
        assert self.grounding is not None
        wanted = [(_occurs(action), True) for action in plan.actions]
        if self.problem.layout.agents:
            return wanted + self._nothing_else(plan)
        idle = set(range(plan.horizon)) - {action.step for action in plan.actions}
        if idle:
            known = self.grounding.control.symbolic_atoms.by_signature("occurs", 2)
            symbols = (atom.symbol for atom in known)
            wanted += [(s, False) for s in symbols if s.arguments[1].number in idle]
        return wanted

    def _nothing_else(self, plan: Plan) -> list[tuple[clingo.Symbol, bool]]:
        """Returns the assumptions that nothing occurs but what the plan has."""
        assert self.grounding is not None
        done = {_occurs(action) for action in plan.actions}
        known = self.grounding.control.symbolic_atoms.by_signature("occurs", 2)
        return [(atom.symbol, False) for atom in known if atom.symbol not in done]

    def accepts(self, plan: Plan) -> bool:
        """Returns whether the program has this plan of the least length: an answer set with its actions."""
        since = time.monotonic()
        if self.grounding is None or self.offered or plan.horizon > self.horizon >= 0:
            self.ground(self.reach(plan.horizon), "")
        assert self.grounding is not None
        wanted = [_deadline(plan.horizon), *self.exactly(plan)]
        has_plan = any(
            True
            for _ in self.grounding.models(
                limit=1, assumptions=wanted, deadline=self.deadline, optimize=False
            )
        )
        word = "accepted" if has_plan else "not accepted"
        self.stage("tidy", f"deeds and parties put in order: {word}", since)
        return has_plan

    def optimize(self) -> None:
        """Makes the best plan as short as can be, in one optimization."""
        assert self.best is not None
        known = self.best.horizon
        since = time.monotonic()
        self.ground(self.reach(known), _MINIMIZE.format(horizon=known))
        if not self.improve(known):
            raise LimitReached("time")
        seconds = round(time.monotonic() - since, 6)
        self.probes.append(Probe(self.best.horizon, "sat", seconds))
        if self.best.horizon > self.lower:
            self.probes.append(Probe(self.best.horizon - 1, "unsat", 0.0))
            self.lower, self.bound_proof = self.best.horizon, False
        self.horizon = -1  # this program has another objective

    def improve(
        self, horizon: int, conflicts: int | None = None, until: float | None = None
    ) -> bool:
        """Replaces the best plan by one that is best for the grounding; whether that was proved.

        ``conflicts``, and the time ``until`` (of `time.monotonic`), are where clingo ends at the
        latest.
        """
        assert self.grounding is not None
        since = time.monotonic()
        cost: list[int] = []
        for model in self.grounding.models(
            limit=0,
            assumptions=[_deadline(horizon)],
            deadline=self.deadline if until is None else until,
            optimize=True,
            conflicts=conflicts,
        ):
            cost = model.cost
            self.best = self.read(model.symbols(shown=True), horizon)
        proved = self.grounding.outcome.exhausted
        improved = (
            f"cost {' '.join(map(str, cost))}" if cost else "no better one than the plan found"
        )
        known = "proved the best" if proved else "as far as was looked"
        self.stage("optimize", f"horizon {horizon}, {improved}, {known}", since)
        return proved


def _deadline(horizon: int) -> tuple[clingo.Symbol, bool]:
    """Returns the assumption that the goals hold by step ``horizon``."""
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
    """Returns the plan of one model: what occurs before the goals first hold."""
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
