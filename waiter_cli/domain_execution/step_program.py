"""A domain's program of one step, grounded once for all states: entry point `StepProgram`.

The program is the domain's, filled for a problem but for its situation, with horizon 0 (what holds at
once) or 1 (what holds after an action).  What a state says is given atom by atom, as externals, and
what is done as assumptions; so one grounding answers for every state of the same restaurant.  The goal
0, reached at the horizon and not before, keeps the goals out of the way.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from threading import RLock
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.source import Source
from waiter_cli.encoding.facts import ProgramLine
from waiter_cli.encoding.own_words import observed_lines
from waiter_cli.encoding.slots import SITUATION, SLOTS, parts_of
from waiter_cli.encoding.template import (
    fill_pieces,
    read_template,
    slot_names,
    state_lines,
)
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    import clingo

    from sparc.checking.typed_program import TypedProgram
    from sparc.solving.clingo_solver import Grounding
    from sparc.sorts.extents import Extent

__all__ = [
    "ONE_AT_A_TIME", "Outcomes", "StepProgram", "given_lines", "is_of_a_step", "one_step_problem", "step_source"
]  # fmt: skip

ONE_AT_A_TIME = RLock()
"""Held while programs of steps are asked: clingo's own data do not survive two threads, and what is given
to a program by one must not be answered by what another gave."""
_VARYING = SITUATION | {"timetable"}
_MOST_INPUTS = 200_000  # atoms that may be given


@dataclass(frozen=True)
class Outcomes:
    """The outcomes of a step: the fluents that hold at the horizon, of two answer sets at most.

    ``unknown`` are what was to be given or done and is not in the program at all.
    """

    held: tuple[frozenset[str], ...]
    unknown: tuple[str, ...] = ()


def one_step_problem(problem: Problem) -> Problem:
    """Returns the problem without what a program of one step leaves out: goals and their order."""
    chairs = tuple(goal for goal in problem.all_goals() if goal.kind == "chairs")
    return replace(problem, goals=chairs, before=(), everybody=False, prefer=())


def given_lines(template: Source, problem: Problem, *, start: bool) -> list[ProgramLine]:
    """Returns the facts of the situation; with ``start`` also what the scenario adds at step 0."""
    lines: list[ProgramLine] = []
    names = slot_names(template)
    facts = tuple(fact for fact in problem.facts if is_of_a_step(fact.text)) if start else ()
    seen = problem.observations if start else ()
    posed = replace(problem, facts=facts, observations=seen)
    for name in names:
        if name == "state":
            lines += state_lines(template, posed)
        elif name == "guest_state":
            lines += SLOTS[name](posed, 1)
        elif name == "observations":
            lines += [*SLOTS[name](posed, 1), *observed_lines(template, posed)]
    lines += SLOTS["timetable"](problem, 1)
    return lines


def step_source(template: Source, problem: Problem, horizon: int) -> Source:
    """Returns the domain's program without the situation."""
    posed = one_step_problem(problem)
    lasting = [
        ProgramLine(f"{fact.text}.", fact.where)
        for fact in problem.facts
        if not is_of_a_step(fact.text)
    ]
    placed: list[str] = []

    def lines_of(name: str) -> Iterable[ProgramLine]:
        if name in ("state", "guest_state") and not placed:
            placed.append(name)
            return lasting
        return () if name in _VARYING else SLOTS[name](posed, horizon)

    have = parts_of(posed) | {"choice"}
    return fill_pieces(template.name, read_template(template), lines_of, have)


def is_of_a_step(fact: str) -> bool:
    """Returns whether a fact is about step 0, and not about the restaurant for good."""
    return fact.removeprefix("-").startswith(("holds(", "obs("))


class StepProgram:
    """The program of ``horizon`` steps (0 or 1) for the restaurant of a problem."""

    def __init__(self, source: Source, horizon: int) -> None:
        from sparc.checking.checker import check
        from sparc.solving.clingo_solver import Grounding
        from sparc.syntax.parser import parse
        from sparc.translation.translator import translate

        self.horizon = horizon
        typed = check(parse(source))
        require_goals(typed, source.name)
        asp = translate(typed)
        if asp.has_preferences:
            message = "a domain with preferences among its answer sets cannot be executed"
            hint = "leave its cr-rules, weak constraints and optimization out"
            raise InputError([Fault(Where(source.name, 1, 1), message, hint)])
        fluents = typed.predicates["holds"].sorts[0].extent
        inertial = typed.sorts.get("inertial_fluent")
        self.known = _names(fluents)
        """The names of all fluents of the program."""
        self.inertial = self.known if inertial is None else _names(inertial.extent)
        """Those that are a state's to keep."""
        text = [*_inputs(typed), f"required(0). reached(0,{horizon}). goal({horizon})."]
        shown = f"#show. #show F : holds(F,{horizon})."
        self._grounding: Grounding = Grounding(
            asp, extra="\n".join(text), show=shown, options=("--project=show",)
        )
        self._grounding.ground()
        self._given: set[clingo.Symbol] = set()
        atoms = self._grounding.control.symbolic_atoms
        self._inputs = {atom.symbol.arguments[0] for atom in atoms.by_signature("__given", 1)}
        occurs = [atom.symbol for atom in atoms.by_signature("occurs", 2)]
        self._actions = {each.arguments[0] for each in occurs if each.arguments[1].number == 0}

    @property
    def actions(self) -> tuple[str, ...]:
        """Returns every action that some situation may allow, as SPARC writes it."""
        return tuple(sorted(map(str, self._actions)))

    def outcomes(self, given: Iterable[ProgramLine], actions: Sequence[Action] = ()) -> Outcomes:
        """Returns what can hold at the horizon when this is given and these actions are done."""
        with ONE_AT_A_TIME:
            return self._outcomes(given, actions)

    def _outcomes(self, given: Iterable[ProgramLine], actions: Sequence[Action]) -> Outcomes:
        import clingo

        unknown = self._give(clingo.parse_term(_atom(line)) for line in given)
        done = {clingo.parse_term(action.text): action for action in actions}
        unknown += [action.text for term, action in done.items() if term not in self._actions]
        if unknown:
            return Outcomes((), tuple(unknown))
        wanted = [
            (clingo.Function("occurs", [term, clingo.Number(0)]), term in done)
            for term in self._actions
        ]
        held = tuple(
            frozenset(str(symbol) for symbol in model.symbols(shown=True))
            for model in self._grounding.models(limit=2, assumptions=wanted)
        )
        return Outcomes(held)

    def ended(self, given: Iterable[ProgramLine]) -> frozenset[str]:
        """Returns the fluents that what is given says not to hold, in some answer set; empty without one."""
        with ONE_AT_A_TIME:
            return self._ended(given)

    def _ended(self, given: Iterable[ProgramLine]) -> frozenset[str]:
        import clingo

        self._give(clingo.parse_term(_atom(line)) for line in given)
        for model in self._grounding.models(limit=1):
            return frozenset(
                str(symbol.arguments[0])
                for symbol in model.symbols(atoms=True)
                if symbol.name == "holds" and symbol.negative
            )
        return frozenset()

    def _give(self, symbols: Iterable[clingo.Symbol]) -> list[str]:
        """Makes these atoms given, and no others; returns those that the program does not know."""
        import clingo

        wanted = set(symbols)
        control = self._grounding.control
        unknown = sorted(str(symbol) for symbol in wanted - self._inputs)
        for symbol in self._given - wanted:
            control.assign_external(clingo.Function("__given", [symbol]), False)
        for symbol in (wanted & self._inputs) - self._given:
            control.assign_external(clingo.Function("__given", [symbol]), True)
        self._given = wanted & self._inputs
        return unknown


def require_goals(typed: TypedProgram, name: str) -> None:
    """Raises `InputError` where a program cannot be given the goal that a single step has."""
    holds = typed.predicates.get("holds")
    required, reached = typed.predicates.get("required"), typed.predicates.get("reached")
    zero = required is not None and len(required.sorts) == 1 and 0 in required.sorts[0].extent
    missing = None
    if holds is None or len(holds.sorts) != 2:
        missing = "holds(#fluent, #step)"
    elif not zero:
        missing = "required(#goal)"
    elif reached is None or len(reached.sorts) != 2:
        missing = "reached(#goal, #step)"
    if missing is not None:
        message = f"this domain cannot be executed: it has no predicate {missing}"
        hint = "goals are required(G), and reached(G, I) at a step; #goal begins at 0"
        raise InputError([Fault(Where(name, 1, 1), message, hint)])


def _names(extent: Extent) -> frozenset[str]:
    """Returns the names of the terms of a sort, those without arguments too."""
    plain = (
        {value for value in extent if isinstance(value, str)} if extent.bound() < 10_000 else set()
    )
    return frozenset(name for name, _ in extent.signatures()) | plain


def _atom(line: ProgramLine) -> str:
    text = line.text.removesuffix(".")
    return f"-{text[1:]}" if text.startswith("-") else text


def _inputs(typed: TypedProgram) -> list[str]:
    """Returns the rules by which atoms of a situation are given."""
    from itertools import product

    from sparc.sorts.values import text

    steps = {"holds": 0, "obs": 0, "willbe": 1}
    lines: list[str] = []
    for name in ("holds", "obs", "leader", "willbe"):
        signature = typed.predicates.get(name)
        if signature is None:
            continue
        extents = [sort.extent for sort in signature.sorts]
        if name in steps:
            extents = extents[:-1]
        size = 1
        for extent in extents:
            size *= extent.bound()
        if size > _MOST_INPUTS:
            continue
        after = f",{steps[name]}" if name in steps else ""
        for values in product(*extents):
            arguments = ",".join(map(text, values))
            lines.append(f"__input({name}({arguments}{after})).")
        variables = ",".join(f"X{k}" for k in range(len(extents)))
        atom = f"{name}({variables}{after})"
        lines.append(f"{atom} :- __given({atom}).")
        if name == "holds":
            for values in product(*extents):
                lines.append(f"__input(-holds({','.join(map(text, values))},0)).")
            lines.append("-holds(X,0) :- __given(-holds(X,0)).")
    lines.append("#external __given(A) : __input(A).")
    return lines
