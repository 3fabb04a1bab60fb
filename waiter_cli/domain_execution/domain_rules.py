"""Plays and judges by a domain's own program: `DomainRules`, a `Rulebook`.

The state after an action is the one that the program's answer sets of that one step agree in; what
has none, or several that differ, is `Illegal` with the reason.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from sparc.source import Source
from waiter_cli.domain_execution.refusals import forbidden, left_open
from waiter_cli.domain_execution.states import parted, state_of
from waiter_cli.domain_execution.step_program import (
    ONE_AT_A_TIME,
    StepProgram,
    given_lines,
    is_of_a_step,
    step_source,
)
from waiter_cli.encoding.domains import Domain, domain_for, domain_of_words
from waiter_cli.encoding.template import fill_template
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Fact, Goal, Observation, State
from waiter_cli.rules.actions import Illegal, holds
from waiter_cli.rules.observations import observe
from waiter_cli.rules.rulebook import HOUSE, Rulebook

__all__ = [
    "DomainRules", "believed", "begun", "kept_rules", "require_events", "require_words", "rules_for"
]  # fmt: skip


def rules_for(problem: Problem, domain: Domain) -> Rulebook:
    """Returns what plays plans of a domain: ours in Python for a built-in one, else the domain itself."""
    return HOUSE if domain_of_words(problem, domain).built_in else kept_rules(domain)


@lru_cache(maxsize=4)
def kept_rules(domain: Domain) -> DomainRules:
    """Returns the rules of a domain, the same for as long as they are in use, so that they stay warm."""
    return DomainRules(domain)


def believed(problem: Problem, domain: Domain) -> Problem:
    """Returns the problem less the fluents that what was seen has ended, where the domain can tell.

    Raises `InputError` where the domain has no words for what the problem says.
    """
    if domain_of_words(problem, domain).built_in or problem.contradictions:
        return problem
    if not (problem.observations and problem.state.fluents):
        return problem
    fill_template(domain_for(problem, domain).template, problem, 1)
    try:
        kept = set(kept_rules(domain).begin(problem).fluents)
    except (InputError, Illegal):
        return problem
    fluents = tuple(each for each in problem.state.fluents if each in kept)
    return replace(problem, state=replace(problem.state, fluents=fluents))


def require_words(problem: Problem, domain: Domain) -> None:
    """Raises `InputError` or `SourceErrors` with all that a problem says and a domain has no words for.

    So does a fact about what is done at a step: a run counts its steps anew whenever it plans.
    """
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse

    if domain_of_words(problem, domain).built_in:
        return
    typed = check(parse(fill_template(domain_for(problem, domain).template, problem, 1)))
    faults = []
    for fact in problem.facts:
        sorts = typed.predicates[parted(fact.text.removeprefix("-"))[0]].sorts
        if sorts and sorts[-1].name == "step" and not is_of_a_step(fact.text):
            said = f"{fact.text} is about a step, and a run plans anew from many"
            faults.append(Fault(fact.where, said, "write a rule of the domain"))
    if faults:
        raise InputError(faults)


def begun(problem: Problem, rules: Rulebook) -> Problem:
    """Returns the problem with what its domain makes of facts and observations in its state.

    Raises `InputError` where the domain has no such situation.
    """
    if rules is HOUSE or problem.contradictions:
        return problem
    if isinstance(rules, DomainRules):
        require_words(problem, rules.domain)
    try:
        state = rules.begin(problem)
    except Illegal as fault:
        where = Where(problem.scenario_file) if problem.scenario_file else None
        raise InputError([Fault(where, f"no such situation: {fault.reason}")]) from None
    return replace(problem, state=state, facts=_lasting(problem))


def require_events(problem: Problem, events: Sequence[TimedEvent], rules: Rulebook) -> None:
    """Raises `InputError` with every observation of the domain's own, later on, that it has no name for."""
    seen = tuple(each for event in events for each in event.observations if each.kind == "obs")
    if not seen:
        return
    posed = replace(problem, observations=seen)
    if isinstance(rules, DomainRules):
        fill_template(domain_for(posed, rules.domain).template, posed, 1)
    elif unknown := rules.unknown_words(posed):
        raise InputError([Fault(seen[0].where, reason.message) for reason in unknown])


_PROGRAMS = 8  # groundings that are kept
_CLOSURES = 256  # states of which it is remembered what holds in them


class DomainRules:
    """The rules of one domain, from its program alone; programs are grounded when first needed.

    To find out why something cannot be takes longer than to see that it cannot; ``reasons`` false
    leaves it out.  Several threads may ask at once.  Raises `InputError` where the domain cannot be executed, `SourceErrors` where its program is wrong.
    """

    def __init__(self, domain: Domain, *, reasons: bool = True) -> None:
        self.domain = domain
        self._reasons = reasons
        self._programs: OrderedDict[tuple[str, int], StepProgram] = OrderedDict()
        self._closures: OrderedDict[tuple[State, Layout], frozenset[str]] = OrderedDict()

    # ------------------------------------------------------------ the rulebook

    def begin(self, problem: Problem) -> State:
        """Returns the state at step 0: what follows from the situation, facts and observations too."""
        problem = self._without_ended(problem)
        held = self._held(problem, (), 0)
        return self._state(held, problem.state, problem, 0)

    def _without_ended(self, problem: Problem) -> Problem:
        """Returns the problem less the fluents of the domain's own that what was seen has ended."""
        if not problem.observations or not problem.state.fluents:
            return problem
        template = domain_for(problem, self.domain).template
        fluents = frozenset(problem.state.fluents)
        bare = replace(problem, state=replace(problem.state, fluents=()))
        program = self._program(template, problem, 0)
        if program.outcomes(given_lines(template, problem, start=True)).held:
            return problem
        ended = program.ended(given_lines(template, bare, start=True))
        kept = tuple(sorted(fluents - ended))
        return replace(problem, state=replace(problem.state, fluents=kept))

    def after(self, problem: Problem, state: State, actions: Sequence[Action], step: int) -> State:
        """Returns the state after the actions of one step; raises `Illegal` with the reason."""
        now = _at(problem, state, step)
        held = self._held(now, tuple(actions), 1)
        return self._state(held, state, now, 1)

    def holds(self, goal: Goal, state: State, problem: Problem) -> bool:
        """Returns whether a goal holds in a state; of a fluent the program is asked."""
        if goal.fluent is None:
            return holds(goal, state, problem)
        return (goal.fluent in self._closure(problem, state)) == (goal.kind == "holds")

    def observe(
        self, state: State, seen: Sequence[Observation], layout: Layout
    ) -> tuple[State, tuple[Reason, ...]]:
        """Returns the state after what was seen: by the rules for what every scenario can say, and
        then by the program for what it makes of that.
        """
        after, reasons = observe(state, seen, layout)
        if reasons:
            return after, reasons
        problem = Problem(layout, state, tuple(seen), after, ())
        if any(each.kind == "obs" for each in seen):
            unknown = self.unknown_words(problem)
            if unknown:
                return after, unknown
        try:
            return self.begin(problem), ()
        except Illegal as fault:
            where = next((one.where for one in seen), None)
            return after, (Reason(fault.reason, where),)

    def unknown_words(self, problem: Problem) -> tuple[Reason, ...]:
        """Returns what a problem says that the domain has no words for, each with its mend."""
        try:
            fill_template(domain_for(problem, self.domain).template, problem, 1)
        except InputError as error:
            return tuple(
                Reason(fault.message + (f"; {fault.hint}" if fault.hint else ""), fault.where)
                for fault in error.faults
            )
        return ()

    def possible(self, problem: Problem, state: State, step: int) -> list[Action]:
        """Returns every action that the program allows in a state."""
        now = _at(problem, state, step)
        template = domain_for(now, self.domain).template
        program = self._program(template, now, 1)
        given = given_lines(template, now, start=False)
        actions = (Action(step, *parted(text)) for text in program.actions)
        return [action for action in actions if program.outcomes(given, (action,)).held]

    # ------------------------------------------------------------ the program

    def _held(self, problem: Problem, actions: tuple[Action, ...], horizon: int) -> frozenset[str]:
        """Returns all that holds at the horizon; raises `Illegal` where that is not one thing."""
        template = domain_for(problem, self.domain).template
        program = self._program(template, problem, horizon)
        given = given_lines(template, problem, start=horizon == 0)
        outcomes = program.outcomes(given, actions)
        what = " and ".join(action.text for action in actions)
        if len(outcomes.held) == 1:
            return outcomes.held[0]
        if outcomes.held and not self._reasons:
            raise Illegal(f"{what or 'waiting'}: the domain leaves open what comes of it")
        if outcomes.held:
            raise Illegal(left_open(outcomes.held, what or "waiting", template, problem, horizon))
        if not self._reasons:
            raise Illegal(f"{what or 'waiting'}: the domain has no such step")
        raise Illegal(forbidden(template, problem, actions, horizon))

    def _program(self, template: Source, problem: Problem, horizon: int) -> StepProgram:
        source = step_source(template, problem, horizon)
        key = (source.text, horizon)
        with ONE_AT_A_TIME:
            program = self._programs.get(key)
            if program is None:
                program = self._programs[key] = StepProgram(source, horizon)
                while len(self._programs) > _PROGRAMS:
                    self._programs.popitem(last=False)
            self._programs.move_to_end(key)
        return program

    def _state(self, held: frozenset[str], before: State, problem: Problem, horizon: int) -> State:
        template = domain_for(problem, self.domain).template
        program = self._program(template, problem, horizon)
        return state_of(held, before, program.known, program.inertial)

    def _closure(self, problem: Problem, state: State) -> frozenset[str]:
        """Returns all that holds in a state, what is defined by other fluents too."""
        key = (state, problem.layout)
        closure = self._closures.get(key)
        if closure is None:
            try:
                closure = self._held(_at(problem, state, 0), (), 0)
            except Illegal:
                closure = frozenset(state.fluents)
            with ONE_AT_A_TIME:
                self._closures[key] = closure
                while len(self._closures) > _CLOSURES:
                    self._closures.popitem(last=False)
        return closure


def _at(problem: Problem, state: State, step: int) -> Problem:
    """Returns the problem as it is at a step, in which nothing is observed."""
    layout = problem.layout
    if layout.timetable and step:
        later = tuple((who, at - step, node) for who, at, node in layout.timetable if at > step)
        layout = replace(layout, timetable=later)
    return replace(
        problem,
        layout=layout,
        state=state,
        before_observations=state,
        observations=(),
        facts=_lasting(problem),
    )


def _lasting(problem: Problem) -> tuple[Fact, ...]:
    """Returns the facts that are not about step 0."""
    return tuple(fact for fact in problem.facts if not is_of_a_step(fact.text))
