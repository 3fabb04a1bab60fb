"""Explains why a literal is in an answer set, or not: TypedProgram, text → `Why`, with `why`.

>>> from sparc import check, parse
>>> program = check(parse("predicates p(). q(). r(). rules q. p :- q, not r. "))
>>> found = why(program, "p")
>>> found.holds, found.because[0].instance, [each.literal for each in found.because[0].premises]
(True, 'p :- q, not r', ['q', 'not r'])
>>> why(program, "r").because_not.note
'no rule gives it'
"""

from __future__ import annotations

import time

from sparc import limits
from sparc.answer_sets import GroundLiteral
from sparc.checking.checker import check_literal
from sparc.checking.typed_program import TypedProgram
from sparc.errors import SourceError, SourceErrors, SparcSyntaxError
from sparc.explaining.absence import explain_absence, open_negation
from sparc.explaining.answer_model import AnswerModel, literal_of, nth_model
from sparc.explaining.derivation import Absence, Derivation, derive
from sparc.explaining.subsets import Undecided
from sparc.lazy_dataclass import dataclass
from sparc.solving.query import parse_query
from sparc.syntax.tree import Atom, Identifier, Number, Term

__all__ = ["Why", "why"]


@dataclass(frozen=True)
class Why:
    """The answer about one literal in one answer set.

    ``holds`` is None where there is no such answer set (then ``sets`` is how many there are), or
    where a limit came first (``limit`` is ``time`` or ``memory``).  ``because`` has the derivation, and behind it
    those of what lies too deep in it.
    """

    literal: str
    number: int
    holds: bool | None = None
    because: tuple[Derivation, ...] = ()
    because_not: Absence | None = None
    sets: int | None = None
    limit: str | None = None


def why(typed: TypedProgram, text: str, *, number: int = 1, time_limit: float | None = None) -> Why:
    """Returns why the literal ``text`` is in the ``number``-th answer set (from 1 on), or why not.

    Raises `SparcSyntaxError` when ``text`` is no ground literal, and what translating raises.
    """
    deadline = None if time_limit is None else time.monotonic() + time_limit
    atom = parse_query(text)
    literal = literal_of(_with_constants(atom, typed), {})
    if literal is None:
        raise SparcSyntaxError(
            "why asks about one literal without variables", atom.span, "give every variable a value"
        )
    try:
        atoms, sets = nth_model(typed, number, deadline)
        if atoms is None:
            return Why(str(literal), number, sets=sets)
        forbidden = _forbidden(typed, atom)
        if forbidden is not None:
            absence = Absence(str(literal), note=forbidden)
            return Why(str(literal), number, False, because_not=absence)
        model = AnswerModel(typed, atoms, deadline)
        return _answer(model, literal, number)
    except Undecided:
        limit = "time"
    except limits.OverLimit as over:
        limits.settle()
        limit = over.limit
    except MemoryError:
        limit = "memory"
    return Why(str(literal), number, limit=limit)


def _answer(model: AnswerModel, literal: GroundLiteral, number: int) -> Why:
    if literal in model.literals:
        return Why(str(literal), number, True, derive(model, literal, open_negation(model)))
    return Why(str(literal), number, False, because_not=explain_absence(model, literal))


def _forbidden(typed: TypedProgram, atom: Atom) -> str | None:
    """Returns how the declarations forbid the literal, with the mend; None where it fits them."""
    try:
        check_literal(typed, atom)
    except SourceErrors as faults:
        return "; ".join(map(_in_words, faults.errors))
    return None


def _in_words(error: SourceError) -> str:
    return f"{error.message} ({error.hint})" if error.hint else error.message


def _with_constants(atom: Atom, typed: TypedProgram) -> Atom:
    """Returns the literal with numbers for constants."""
    return Atom(
        atom.name,
        tuple(_number(term, typed) for term in atom.arguments),
        atom.negated,
        atom.span,
        atom.name_span,
    )


def _number(term: Term, typed: TypedProgram) -> Term:
    if isinstance(term, Identifier) and term.name in typed.constants:
        return Number(typed.constants[term.name])
    return term
