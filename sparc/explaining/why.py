"""Explains why a literal is in an answer set, or not: TypedProgram, text → `Why`, with `why`;
several, or with variables, with `why_query`.

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
from collections.abc import Callable, Iterator, Mapping

from sparc import limits
from sparc.answer_sets import Ground, GroundLiteral
from sparc.checking.checker import check_literal
from sparc.checking.typed_program import TypedProgram
from sparc.errors import SourceError, SourceErrors, SparcSyntaxError
from sparc.explaining.absence import explain_absence, explain_absent_form, open_negation
from sparc.explaining.answer_model import AnswerModel, literal_of, nth_model
from sparc.explaining.derivation import Absence, Derivation, derive
from sparc.explaining.fitting import first_fit, with_values
from sparc.explaining.in_words import absence_lines, derivation_lines
from sparc.explaining.subsets import Undecided
from sparc.lazy_dataclass import dataclass
from sparc.solving.query import checked_conjunction, parse_conjunction, parse_query
from sparc.syntax.tree import Atom, Identifier, Number, Term

__all__ = ["Why", "why", "why_query"]


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

    def __str__(self) -> str:
        """Returns the answer as `lines`, or why there is none."""
        if self.holds is not None:
            return "\n".join(self.lines())
        if self.limit is not None:
            return f"{self.literal}: the {self.limit} limit was reached"
        return f"{self.literal}: there is no answer set{f' {self.number}' if self.sets else ''}"

    def lines(self) -> Iterator[str]:
        """Yields the answer as lines; what supports a line stands below it, indented."""
        where = "the answer set" if self.number == 1 else f"answer set {self.number}"
        if self.holds:
            yield f"{self.literal} is in {where}, because:"
            for number, root in enumerate(self.because):
                if number:
                    yield ""
                yield from derivation_lines(root, "  ")
        elif self.because_not is not None:
            yield f"{self.literal} is not in {where}."
            yield from absence_lines(self.because_not, "  ")


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

    def found(model: AnswerModel) -> tuple[Why, ...]:
        forbidden = _forbidden(typed, atom)
        if forbidden is not None:
            absence = Absence(str(literal), note=forbidden)
            return (Why(str(literal), number, False, because_not=absence),)
        return (_answer(model, literal, number),)

    return _asked(typed, str(literal), number, deadline, found)[0]


def why_query(
    typed: TypedProgram, text: str, *, number: int = 1, time_limit: float | None = None
) -> tuple[Why, ...]:
    """Returns why a query, literals joined by commas, is true in an answer set, or why not.

    Where it is, each literal is explained with the first values that make all of them true, in the order
    of terms; where it is not, the literal that fails with the values that make most of them true.
    Raises what `query` raises of the text.

    >>> from sparc import check, parse
    >>> program = check(parse("sorts #s={a,b}. predicates p(#s). q(#s). rules p(a). p(b). q(b)."))
    >>> [(each.literal, each.holds) for each in why_query(program, "p(X), q(X)")]
    [('p(b)', True), ('q(b)', True)]
    """
    atoms = parse_conjunction(text)
    if len(atoms) == 1 and literal_of(_with_constants(atoms[0], typed), {}) is not None:
        return (why(typed, text, number=number, time_limit=time_limit),)
    deadline = None if time_limit is None else time.monotonic() + time_limit
    wanted = tuple(_with_constants(atom, typed) for atom in checked_conjunction(typed, text))

    def found(model: AnswerModel) -> tuple[Why, ...]:
        values, failing = first_fit(wanted, model.literals)
        told = wanted if failing is None else (failing,)
        return tuple(_answer_about(model, atom, values, number) for atom in told)

    return _asked(typed, text.strip(), number, deadline, found)


def _asked(
    typed: TypedProgram,
    shown: str,
    number: int,
    deadline: float | None,
    found: Callable[[AnswerModel], tuple[Why, ...]],
) -> tuple[Why, ...]:
    """Returns what is ``found`` in the ``number``-th answer set, or that it cannot be told."""
    try:
        atoms, sets = nth_model(typed, number, deadline)
        if atoms is None:
            return (Why(shown, number, sets=sets),)
        return found(AnswerModel(typed, atoms, deadline))
    except Undecided:
        limit = "time"
    except limits.OverLimit as over:
        limits.settle()
        limit = over.limit
    except MemoryError:
        limit = "memory"
    return (Why(shown, number, limit=limit),)


def _answer(model: AnswerModel, literal: GroundLiteral, number: int) -> Why:
    if literal in model.literals:
        return Why(str(literal), number, True, derive(model, literal, open_negation(model)))
    return Why(str(literal), number, False, because_not=explain_absence(model, literal))


def _answer_about(model: AnswerModel, atom: Atom, values: Mapping[str, Ground], number: int) -> Why:
    """Returns why a literal is there with these values, or why none of its form is."""
    literal = literal_of(atom, values)
    if literal is not None:
        return _answer(model, literal, number)
    absence = explain_absent_form(model, with_values(atom, values))
    return Why(absence.literal, number, False, because_not=absence)


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
