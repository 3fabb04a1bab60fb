"""Asks a program about one literal: (TypedProgram, text) → `Answer`, with `query`.

>>> from sparc import check, parse
>>> program = check(parse("sorts #s = {a,b}. predicates p(#s). rules p(a). -p(b). "))
>>> query(program, "p(a)").verdict.value, query(program, "p(b)").verdict.value
('yes', 'no')
>>> query(program, "p(X)").bindings
({'X': GroundTerm(name='a', arguments=())},)

A literal is true when it is in all answer sets (of the minimal supports, or optimal, where there
are preferences), false when its contrary is.  Neither is decided by listing answer sets: clingo
computes what they have in common.

Follows the SPARC manual, "Query mode".
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from enum import Enum

from sparc.answer_sets import Ground
from sparc.checking.checker import check_literal
from sparc.checking.typed_program import TypedProgram, Undefined, evaluate
from sparc.errors import RuleError, SourceError, SourceErrors, SparcSyntaxError
from sparc.lazy_dataclass import dataclass
from sparc.source import Source, Span
from sparc.syntax.parser import parse
from sparc.syntax.tree import Arithmetic, Atom, Program, Record, Rule, Term, Variable
from sparc.translation.asp_program import AspProgram
from sparc.translation.translator import QUERY, translate, translate_query

__all__ = [
    "Answer",
    "Verdict",
    "ask",
    "checked_conjunction",
    "parse_conjunction",
    "parse_query",
    "query",
]


_BEFORE = "predicates\nrules\n:-\n"
"""What a query is read behind, as the body of a rule; three lines, so that its own is line 1."""


class Verdict(Enum):
    """The truth of a literal in all answer sets."""

    YES = "yes"
    NO = "no"
    UNKNOWN = "unknown"
    INCONSISTENT = "inconsistent"
    UNDECIDED = "undecided"  # the time was up


@dataclass(frozen=True)
class Answer:
    """The verdict on a query, and for one with variables the assignments that make it true.

    ``bindings`` are in the order of terms, numbers first; without any the verdict is ``UNKNOWN``.
    """

    verdict: Verdict
    bindings: tuple[dict[str, Ground], ...] = ()

    def __str__(self) -> str:
        if self.bindings and self.bindings != ({},):
            return "\n".join(
                " ".join(f"{name} = {value}" for name, value in binding.items())
                for binding in self.bindings
            )
        return self.verdict.value


def parse_query(text: str) -> Atom:
    """Returns the literal of a query such as ``-p(X,2).``.

    Raises `SparcSyntaxError` when it is none.

    Places count from the query's first character: ``query:1:1``.
    """
    atoms = parse_conjunction(text)
    if len(atoms) == 1:
        return atoms[0]
    raise SparcSyntaxError("this must be one literal", atoms[0].span.to(atoms[-1].span), _MEND)


_MEND = "ask p(t1,…,tn) or -p(t1,…,tn)"


def parse_conjunction(text: str) -> tuple[Atom, ...]:
    """Returns the literals of a query such as ``p(X), -q(X)``.

    Raises `SparcSyntaxError` for anything else.
    """
    asked = text.strip().removesuffix(".").rstrip()
    source = Source("query", f"{_BEFORE}{asked}\n.\n", -2)
    whole = Span(source, len(_BEFORE), len(_BEFORE) + len(asked))
    if not asked:
        raise SparcSyntaxError("the query is empty", whole, _MEND)
    try:
        statements = _parsed(source).statements
    except SparcSyntaxError as error:
        if error.span is None or error.span.start < whole.end:
            raise
        message = error.message
        if error.expected is not None:
            message = f"expected {error.expected}, found the end of the query"
        raise SparcSyntaxError(message, Span(source, whole.end, whole.end), _MEND) from None
    if len(statements) == 1:
        (statement,) = statements
        if isinstance(statement, Rule) and not statement.head:
            atoms = tuple(item for item in statement.body if isinstance(item, Atom))
            if len(atoms) == len(statement.body):
                for atom in atoms:
                    anonymous = next(filter(None, map(_anonymous, atom.arguments)), None)
                    if anonymous is not None:
                        raise SparcSyntaxError(
                            "a query has no anonymous variables",
                            anonymous.span,
                            "give it a name",
                        )
                return atoms
    raise SparcSyntaxError("a query is literals, joined by commas", whole, _MEND)


def _parsed(source: Source) -> Program:
    """Returns the tree of a program; raises only its first fault of syntax."""
    try:
        return parse(source)
    except SourceErrors as error:
        raise error.errors[0] from None


def query(program: TypedProgram, text: str, *, time_limit: float | None = None) -> Answer:
    """Returns the answer to ``text``, a literal or several joined by commas, in ``program``.

    A conjunction is true when all answer sets have each of its literals, false when each has the
    contrary of one of them.  Raises `SparcSyntaxError` when ``text`` is neither, and `SourceErrors`
    when it does not fit the declarations.  ``time_limit`` is in seconds.
    """
    deadline = None if time_limit is None else time.monotonic() + time_limit
    atoms = checked_conjunction(program, text)
    try:
        atoms = tuple(
            Atom(
                atom.name,
                tuple(_evaluated(term, program) for term in atom.arguments),
                atom.negated,
                atom.span,
                atom.name_span,
            )
            for atom in atoms
        )
    except Undefined as error:
        raise SourceErrors([RuleError(str(error), error.span)]) from None
    extra, names = translate_query(program, atoms)
    return ask(translate(program), extra, f"{QUERY}/{len(names) or 1}", names, deadline)


def checked_conjunction(program: TypedProgram, text: str) -> tuple[Atom, ...]:
    """Returns the literals of a query; raises what `query` raises of its text."""
    atoms = parse_conjunction(text)
    faults: list[SourceError] = []
    for atom in atoms:
        try:
            check_literal(program, atom)
        except SourceErrors as error:
            faults.extend(error.errors)
    if faults:
        raise SourceErrors(faults)
    return atoms


def ask(
    program: AspProgram,
    extra: str,
    asked: str,
    names: Sequence[str],
    deadline: float | None,
) -> Answer:
    """Returns what all answer sets of ``program`` share of the predicate ``asked`` (name/arity).

    ``extra`` are the rules that derive it: for each assignment of the variables ``names``, or
    from ``yes`` and ``no`` where there are none.  ``deadline`` is by `time.monotonic`.
    """
    from sparc.solving.clingo_solver import Grounding, Satisfiability, ground_literal
    from sparc.solving.clingo_threads import Abandoned

    options = ["--enum-mode=cautious"]
    if program.has_preferences:
        options.append("--opt-mode=optN")
    grounding = Grounding(program, extra=extra, show=f"#show {asked}.", options=options)
    try:
        grounding.ground(deadline)
    except Abandoned:
        return Answer(Verdict.UNDECIDED)
    common = None
    for model in grounding.models(deadline=deadline):
        common = [ground_literal(symbol) for symbol in model.symbols(shown=True)]
    outcome = grounding.outcome
    if outcome.satisfiability is Satisfiability.UNSATISFIABLE:
        return Answer(Verdict.INCONSISTENT)
    if not outcome.exhausted or common is None:
        return Answer(Verdict.UNDECIDED)
    if not names:
        said = {str(literal.arguments[0]) for literal in common}
        if "yes" in said:
            return Answer(Verdict.YES, ({},))
        return Answer(Verdict.NO if "no" in said else Verdict.UNKNOWN)
    found = sorted((literal.arguments for literal in common), key=_order)
    bindings = tuple(dict(zip(names, values, strict=True)) for values in found)
    return Answer(Verdict.YES if bindings else Verdict.UNKNOWN, bindings)


def _anonymous(term: Term) -> Variable | None:
    """Returns an anonymous variable of a term."""
    if isinstance(term, Variable):
        return term if term.name == "_" else None
    parts: tuple[Term, ...] = ()
    if isinstance(term, Record):
        parts = term.arguments
    elif isinstance(term, Arithmetic):
        parts = (term.left, term.right)
    return next(filter(None, map(_anonymous, parts)), None)


def _evaluated(term: Term, program: TypedProgram) -> Term:
    """Returns the term with its ground arithmetic worked out; raises `Undefined`."""
    if isinstance(term, Record):
        parts = tuple(_evaluated(part, program) for part in term.arguments)
        return Record(term.name, parts, term.span)
    evaluate(term, program.constants)  # refuses 1/0; clingo does the rest
    return term


def _order(values: tuple[Ground, ...]) -> list[tuple[int, int, str]]:
    """Returns a sort key: numbers before identifiers before records."""
    return [
        (0, value, "") if isinstance(value, int) else (2 if value.arguments else 1, 0, str(value))
        for value in values
    ]
