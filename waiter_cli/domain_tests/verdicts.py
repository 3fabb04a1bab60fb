"""Template, cases → what became of each case. Entry point `run_cases`.

A literal under ``then`` fails where an answer set is without it, one under ``never`` where an
answer set has it: each is a question to the solver, and the answer set that it gives back tells
what holds instead.  A case that could pass for the wrong reason fails: where its situation has no
answer set at all, where the step before the impossible one is impossible already.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from sparc.source import Source
from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.domain_tests.claims import Claims
from waiter_cli.domain_tests.ground_cases import GroundCases
from waiter_cli.domain_tests.programs import CaseProgram, make_programs
from waiter_cli.errors import Where

if TYPE_CHECKING:
    import clingo

    from sparc.syntax.tree import Atom
    from waiter_cli.domain_tests.ground_cases import Assumption, Model

__all__ = ["Failure", "CaseVerdict", "run_cases", "run_programs"]

_LISTED = 6


@dataclass(frozen=True)
class Failure:
    """One expectation that was not met: where it stands, what is wrong, what is true instead."""

    where: Where
    message: str
    instead: str | None = None


@dataclass(frozen=True)
class CaseVerdict:
    """The result of one case; it passed when there is no failure."""

    case: Case
    failures: tuple[Failure, ...]

    @property
    def passed(self) -> bool:
        """Returns whether everything is as the case expects."""
        return not self.failures


def run_cases(template: Source, cases: Sequence[Case]) -> tuple[CaseVerdict, ...]:
    """Returns the verdict on each case, in their order.

    Raises `InputError`, `SourceError` and `SourceErrors` as `make_programs` does.
    """
    return run_programs(make_programs(template, cases))


def run_programs(programs: Sequence[CaseProgram]) -> tuple[CaseVerdict, ...]:
    """Returns the verdicts on the cases of several programs, in the order of the cases."""
    verdicts: dict[int, CaseVerdict] = {}
    for program in programs:
        bench = GroundCases(program)
        for number, index in enumerate(program.indices):
            case, claims = program.cases[number], program.claims[number]
            verdicts[index] = CaseVerdict(
                case, tuple(_Judge(bench, number, case, claims).failures())
            )
    return tuple(verdicts[index] for index in sorted(verdicts))


class _Judge:
    """Looks at one case."""

    def __init__(self, bench: GroundCases, number: int, case: Case, claims: Claims) -> None:
        self.bench = bench
        self.number = number
        self.case = case
        self.claims = claims
        bench.select(number)
        self.base: list[Assumption] = []
        if case.when is not None:
            self.base = bench.happening(claims.when)

    def failures(self) -> Iterator[Failure]:
        if self.case.impossible:
            yield from self.impossible()
            return
        first = self.bench.model(self.base)
        if first is None:
            yield self.no_answer_set()
            return
        case, claims = self.case, self.claims
        for said, atom in zip(case.then, claims.then, strict=True):
            yield from self.always(said, atom, first)
        for said, atom in zip(case.never, claims.never, strict=True):
            yield from self.never(said, atom)
        for said, atom in zip(case.some, claims.some, strict=True):
            symbol = self.bench.symbol(atom)
            assert symbol is not None
            if not self.bench.possible([*self.base, (symbol, True)]):
                message = f"{_shown(symbol)} holds in no answer set"
                yield Failure(said.where, message, _instead(symbol, first))
        if case.exactly is not None:
            count = len(self.bench.models(self.base, case.exactly + 1))
            if count != case.exactly:
                sets = "answer set" if case.exactly == 1 else "answer sets"
                more = "more than " if count > case.exactly else ""
                number = case.exactly if more else count
                message = f"there are {more}{number}, not exactly {case.exactly} {sets}"
                yield Failure(case.where, message)

    def always(self, said: SparcText, atom: Atom, first: Model) -> Iterator[Failure]:
        symbol = self.bench.symbol(atom)
        assert symbol is not None
        if symbol in first and not self.bench.possible([*self.base, (symbol, False)]):
            return
        counter = first
        if symbol in first:
            counter = self.bench.model([*self.base, (symbol, False)]) or first
        message = f"{_shown(symbol)} does not hold{self.choices(counter)}"
        yield Failure(said.where, message, _instead(symbol, counter))

    def never(self, said: SparcText, atom: Atom) -> Iterator[Failure]:
        for symbol in self.bench.matching(atom):
            model = self.bench.model([*self.base, (symbol, True)])
            if model is not None:
                message = f"{_shown(symbol)} holds{self.choices(model, symbol)}"
                yield Failure(said.where, message)
                return

    def impossible(self) -> Iterator[Failure]:
        case, bench = self.case, self.bench
        model = bench.model(self.base)
        if model is not None:
            what = "the facts hold together" if case.when is None else "it can happen"
            message = f"impossible, but there is an answer set: {what}{self.choices(model)}"
            yield Failure(case.where, message)
            return
        if case.when is None:
            bench.select(self.number, facts=False)
            if not bench.possible(()):
                yield Failure(case.where, "it is impossible already without its facts")
            return
        last = len(self.claims.when) - 1
        if not bench.possible(bench.happening(self.claims.when, only=last)):
            what = "before its last step" if last else "whatever is done"
            yield Failure(case.where, f"it is impossible already {what}")

    def no_answer_set(self) -> Failure:
        """Returns the cause of there being no answer set: the situation, or the
        first impossible step.
        """
        case, claims, bench = self.case, self.claims, self.bench
        if not bench.possible(()):
            return Failure(case.where, "what is given has no answer set at all", self.culprit())
        for step, atom in enumerate(claims.when):
            if bench.possible(bench.happening(claims.when, only=step + 1)):
                continue
            action = (case.when or ())[step]
            before = bench.happening(claims.when, only=step)
            others = [
                symbol
                for symbol, at in bench.actions
                if at == step and bench.possible([*before, (symbol, True)])
            ]
            instead = "nothing else can occur then"
            if others:
                instead = f"possible then: {_listed(symbol.arguments[0] for symbol in others)}"
            what = "doing nothing is" if atom is None else f"{action.text} is"
            return Failure(action.where, f"{what} impossible at step {step}", instead)
        return Failure(case.where, "after this nothing may hold: there is no answer set")

    def culprit(self) -> str | None:
        """Returns the likely cause of the situation of the case being impossible."""
        case = self.case
        if case.facts:
            self.bench.select(self.number, facts=False)
            blamed = self.bench.possible(())
            self.bench.select(self.number)
            if blamed:
                return "without its facts it has one"
        if case.has_goals:
            steps = "1 step" if case.horizon == 1 else f"{case.horizon} steps"
            return f"its goals may be out of reach in {steps}"
        return None

    def choices(self, model: Model, but: clingo.Symbol | None = None) -> str:
        """Returns the actions of an answer set, for a case that leaves the choice to the program."""
        if self.case.when is not None:
            return ""
        done = sorted(s for s in model if s.name == "occurs" and s.positive and s != but)
        return f", where {_listed(done)}" if done else ""


def _listed(symbols: Any) -> str:
    shown = [_shown(symbol) for symbol in symbols]
    more = f", … ({len(shown)} in all)" if len(shown) > _LISTED else ""
    return ", ".join(shown[:_LISTED]) + more


def _shown(symbol: clingo.Symbol) -> str:
    """Returns a symbol as a person writes it, with a space after each comma."""
    text = str(symbol)
    return text.replace(",", ", ")


def _instead(symbol: clingo.Symbol, model: Model) -> str | None:
    """Returns what an answer set has in the place of a literal: the contrary, or the nearest to it."""
    import clingo

    contrary = clingo.Function(symbol.name, symbol.arguments, not symbol.positive)
    if contrary in model:
        return f"instead: {_shown(contrary)}"
    alike = [
        other
        for other in model
        if other.name == symbol.name
        and other.positive
        and len(other.arguments) == len(symbol.arguments)
        and _step(other) == _step(symbol)
    ]
    subject = symbol.arguments[0] if symbol.arguments else None
    if subject is None or subject.type != clingo.SymbolType.Function:
        return None
    alike = [other for other in alike if _name(other) == subject.name]
    for length in range(len(subject.arguments), -1, -1):
        nearest = sorted(
            other
            for other in alike
            if other.arguments[0].arguments[:length] == subject.arguments[:length]
        )
        if nearest and nearest != [symbol]:
            return f"instead: {_listed(nearest)}"
    step = "" if _step(symbol) is None else f" at step {_step(symbol)}"
    return f"there is no {symbol.name}({subject.name}(…)){step}"


def _step(symbol: clingo.Symbol) -> int | None:
    last = symbol.arguments[-1] if symbol.arguments else None
    return last.number if last is not None and last.type == last.type.Number else None


def _name(symbol: clingo.Symbol) -> str | None:
    first = symbol.arguments[0]
    return first.name if first.type == first.type.Function else None
