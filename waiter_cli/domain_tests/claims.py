"""The literals of a case, parsed and checked against a domain: `Case` → `Claims`.
Entry point `ClaimsReader`.

A name that is misspelt, a step that does not exist, an action of another kind: each is a fault with
the place in the file of cases, never a case that passes because nothing of that name can hold.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.syntax.tree import Identifier, Record, RecordSort, SetExpression, TermSet
from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.errors import Fault

if TYPE_CHECKING:
    from sparc.checking.typed_program import TypedProgram
    from sparc.syntax.tree import Atom, Program, Term

__all__ = ["Claims", "ClaimsReader"]

_OCCURS = "occurs("


@dataclass(frozen=True)
class Claims:
    """The literals of one case: ``when`` has None for a step at which nothing occurs."""

    when: tuple[Atom | None, ...]
    then: tuple[Atom, ...]
    never: tuple[Atom, ...]
    some: tuple[Atom, ...]


class ClaimsReader:
    """Parses and checks the literals of cases against the declarations of their program."""

    def __init__(self, typed: TypedProgram, faults: list[Fault]) -> None:
        self.typed = typed
        self.faults = faults
        self.known: dict[str, Atom] = {}
        self.names = _names_of(typed.program)

    def claims(self, case: Case) -> Claims:
        """Returns the literals of a case; faults are noted."""
        when: list[Atom | None] = []
        for step, said in enumerate(case.when or ()):
            if not said.text:
                when.append(None)
                continue
            atom = self.literal(
                said, f"{_OCCURS}{said.text.rstrip().rstrip('.')}, {step})", len(_OCCURS)
            )
            if atom is not None:
                when.append(atom)
        return Claims(
            tuple(when),
            self.literals(case.then),
            self.literals(case.never, variables=True),
            self.literals(case.some),
        )

    def literals(self, said: Iterable[SparcText], *, variables: bool = False) -> tuple[Atom, ...]:
        atoms = [self.literal(one, one.text, 0, variables=variables) for one in said]
        return tuple(atom for atom in atoms if atom is not None)

    def literal(
        self, said: SparcText, text: str, shift: int, *, variables: bool = False
    ) -> Atom | None:
        """Returns the literal of ``text``, in which ``shift`` characters come before what was said."""
        from sparc.checking.checker import check_literal
        from sparc.checking.typed_program import Undefined, evaluate, is_ground
        from sparc.errors import SourceError, SourceErrors
        from sparc.solving.query import parse_query

        atom = self.known.get(text)
        if atom is None:
            try:
                atom = parse_query(text)
                check_literal(self.typed, atom)
                for term in atom.arguments:
                    evaluate(term, self.typed.constants)
            except Undefined as error:
                self.faults.append(said.fault(str(error)))
                return None
            except (SourceError, SourceErrors) as error:
                errors = error.errors if isinstance(error, SourceErrors) else (error,)
                for one in errors:
                    offset = 0
                    if one.span is not None and one.span.location.line == 1:
                        offset = one.span.location.column - 1 - shift
                        offset = min(offset, len(said.text))
                    hint = self.mend(atom) or one.hint
                    self.faults.append(said.fault(one.message, hint, offset))
                return None
            self.known[text] = atom
        if not variables and not all(is_ground(term) for term in atom.arguments):
            hint = "name one literal; a variable may stand under never only"
            self.faults.append(said.fault("a variable stands here", hint))
            return None
        return atom

    def mend(self, atom: Atom | None) -> str | None:
        """Returns the name that was probably meant, where a literal has one that
        nothing is called by.
        """
        from waiter_cli.spelling import suggest

        for name in _names(atom.arguments) if atom is not None else ():
            if name not in self.names:
                close = suggest(name, self.names)
                return None if close is None else f"did you mean {close}?"
        return None


def _names(terms: Iterable[Term]) -> Iterable[str]:
    """Returns the names in terms, at any depth."""
    for term in terms:
        if isinstance(term, Identifier):
            yield term.name
        elif isinstance(term, Record):
            yield term.name
            yield from _names(term.arguments)


def _names_of(program: Program) -> frozenset[str]:
    """Returns the names of things, fluents and actions that the sorts of a program have."""
    names: set[str] = set()
    todo = [definition.expression for definition in program.sorts]
    while todo:
        expression = todo.pop()
        if isinstance(expression, TermSet):
            names.update(_names(expression.terms))
        elif isinstance(expression, RecordSort):
            names.add(expression.name)
        elif isinstance(expression, SetExpression):
            todo += [expression.left, expression.right]
    return frozenset(names)
