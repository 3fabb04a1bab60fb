"""A `CaseProgram` in clingo: one case after another is looked at. Entry point `GroundCases`.

Grounded once; which case holds, what occurs and what is asked are assumptions of each solve.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from sparc.checking.typed_program import evaluate
from sparc.syntax.tree import Atom, Record, Term, Variable
from sparc.translation.asp_program import AspProgram
from waiter_cli.domain_tests.programs import CaseProgram

if TYPE_CHECKING:
    import clingo

    from sparc.sorts.values import Value

    Assumption = tuple[clingo.Symbol, bool]
    Model = frozenset[clingo.Symbol]

__all__ = ["Assumption", "GroundCases", "Model"]


class GroundCases:
    """One grounded program; `select` says which of its cases holds from now on."""

    def __init__(self, program: CaseProgram, asp: AspProgram | None = None) -> None:
        from sparc.solving.clingo_solver import Grounding

        self.program = program
        self.grounding = Grounding(program.asp() if asp is None else asp, show="")
        self.grounding.ground()
        self.control = self.grounding.control
        self.selected: int | None = None
        self.actions: list[tuple[clingo.Symbol, int]] = []
        for atom in self.control.symbolic_atoms.by_signature("occurs", 2):
            step = atom.symbol.arguments[1]
            if step.type == step.type.Number:
                self.actions.append((atom.symbol, step.number))

    def select(self, number: int, *, facts: bool = True) -> None:
        """Makes what is given in the case of that number hold, with or without its facts."""
        import clingo

        def turn(name: str, case: int, on: bool) -> None:
            self.control.assign_external(clingo.Function(name, [clingo.Number(case)]), on)

        if self.selected is not None and self.selected != number:
            turn("__case", self.selected, False)
            turn("__facts", self.selected, False)
        turn("__case", number, True)
        turn("__facts", number, facts)
        self.selected = number

    def models(self, assumptions: Sequence[Assumption], limit: int) -> list[Model]:
        """Returns at most ``limit`` answer sets, with every atom."""
        return [
            frozenset(model.symbols(atoms=True))
            for model in self.grounding.models(limit=limit, assumptions=assumptions)
        ]

    def model(self, assumptions: Sequence[Assumption]) -> Model | None:
        """Returns an answer set, None where there is none."""
        return next(iter(self.models(assumptions, 1)), None)

    def possible(self, assumptions: Sequence[Assumption]) -> bool:
        """Returns whether there is an answer set."""
        return bool(list(self.grounding.models(limit=1, assumptions=assumptions)))

    def happening(
        self, when: Sequence[Atom | None], *, only: int | None = None
    ) -> list[Assumption]:
        """Returns the assumptions that this occurs and nothing else.

        ``only`` steps below that are fixed.
        """
        symbols = {
            symbol
            for atom in when[:only]
            if atom is not None and (symbol := self.symbol(atom)) is not None
        }
        fixed = [
            (symbol, symbol in symbols)
            for symbol, step in self.actions
            if only is None or step < only
        ]
        known = {symbol for symbol, _ in fixed}
        return fixed + [(symbol, True) for symbol in sorted(symbols - known)]

    def matching(self, atom: Atom) -> Iterator[clingo.Symbol]:
        """Yields the atoms of the grounding that a literal, perhaps with variables, stands for."""
        symbol = self.symbol(atom)
        if symbol is not None:
            yield symbol
            return
        constants = self.program.typed.constants
        known = self.control.symbolic_atoms.by_signature(
            atom.name, len(atom.arguments), not atom.negated
        )
        for found in known:
            bound: dict[str, clingo.Symbol] = {}
            pairs = zip(atom.arguments, found.symbol.arguments, strict=True)
            if all(_fits(term, value, constants, bound) for term, value in pairs):
                yield found.symbol

    def symbol(self, atom: Atom) -> clingo.Symbol | None:
        """Returns the symbol of a ground literal, None for one with variables."""
        import clingo

        constants = self.program.typed.constants
        arguments = []
        for term in atom.arguments:
            value = evaluate(term, constants)
            if value is None:
                return None
            arguments.append(_symbol(value))
        return clingo.Function(atom.name, arguments, not atom.negated)


def _symbol(value: Value) -> clingo.Symbol:
    import clingo

    if isinstance(value, int):
        return clingo.Number(value)
    if isinstance(value, str):
        return clingo.Function(value)
    name, *arguments = value
    return clingo.Function(str(name), [_symbol(argument) for argument in arguments])


def _fits(
    term: Term, value: clingo.Symbol, constants: Mapping[str, int], bound: dict[str, clingo.Symbol]
) -> bool:
    """Returns whether a term with variables stands for a value.

    ``bound`` keeps what they stand for.
    """
    if isinstance(term, Variable):
        return bound.setdefault(term.name, value) == value
    known = evaluate(term, constants)
    if known is not None:
        return _symbol(known) == value
    if not isinstance(term, Record) or value.type != value.type.Function:
        return False
    if value.name != term.name or len(value.arguments) != len(term.arguments):
        return False
    pairs = zip(term.arguments, value.arguments, strict=True)
    return all(_fits(inner, found, constants, bound) for inner, found in pairs)
