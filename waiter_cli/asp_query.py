"""Queries to a program that another translator made: `AspProgram`, text → `Answer`.

The meaning is that of `sparc.query`: a literal is true when it is in all answer sets, false when
its contrary is.  Faults of the query are found against the declarations of the SPARC program.
"""

from __future__ import annotations

import time

from sparc.answer_sets import Ground, GroundLiteral
from sparc.asp import AspProgram
from sparc.check import check_literal
from sparc.query import Answer, Verdict, parse_query
from sparc.syntax import Arithmetic, Atom, Identifier, Number, Record, Term, Variable
from sparc.typed import TypedProgram

__all__ = ["ask_asp"]

_ANSWER = "___answer"


def ask_asp(
    program: AspProgram, typed: TypedProgram, text: str, *, time_limit: float | None = None
) -> Answer:
    """What the answer sets of ``program`` say about the literal ``text``.

    ``typed`` is the same program with its declarations.  Raises `SparcSyntaxError`,
    `SourceErrors` for a query that is none; ``time_limit`` is in seconds.
    """
    from sparc.solvers.native import Abandoned, Grounding, Satisfiability, ground_literal

    deadline = None if time_limit is None else time.monotonic() + time_limit
    atom = parse_query(text)
    check_literal(typed, atom)
    literal, contrary = _literal(atom, atom.negated), _literal(atom, not atom.negated)
    names = list(dict.fromkeys(name for term in atom.arguments for name in _names(term)))
    if names:
        extra = f"{_ANSWER}({','.join(names)}):-{literal}."
    else:
        extra = f"{_ANSWER}(yes):-{literal}. {_ANSWER}(no):-{contrary}."
    options = ["--enum-mode=cautious"]
    if program.has_preferences:
        options.append("--opt-mode=optN")
    grounding = Grounding(
        program, extra=extra, show=f"#show {_ANSWER}/{len(names) or 1}.", options=options
    )
    try:
        grounding.ground(deadline)
    except Abandoned:
        return Answer(Verdict.UNDECIDED)
    common: list[GroundLiteral] | None = None
    for model in grounding.models(deadline=deadline):
        common = [ground_literal(symbol) for symbol in model.symbols(shown=True)]
    outcome = grounding.outcome
    if outcome.satisfiability is Satisfiability.UNSATISFIABLE:
        return Answer(Verdict.INCONSISTENT)
    if not outcome.exhausted or common is None:
        return Answer(Verdict.UNDECIDED)
    if names:
        rows = sorted((found.arguments for found in common), key=lambda row: list(map(_order, row)))
        bindings = tuple(dict(zip(names, row, strict=True)) for row in rows)
        return Answer(Verdict.YES if bindings else Verdict.UNKNOWN, bindings)
    said = {str(found.arguments[0]) for found in common}
    if "yes" in said:
        return Answer(Verdict.YES, ({},))
    return Answer(Verdict.NO if "no" in said else Verdict.UNKNOWN)


def _literal(atom: Atom, negated: bool) -> str:
    arguments = ",".join(map(_text, atom.arguments))
    return f"{'-' if negated else ''}{atom.name}{f'({arguments})' if arguments else ''}"


def _text(term: Term) -> str:
    """The term in clingo's words."""
    match term:
        case Variable(name) | Identifier(name):
            return name
        case Number(value):
            return str(value)
        case Record(name, arguments):
            return f"{name}({','.join(map(_text, arguments))})"
        case Arithmetic(operator, left, right):
            return f"({_text(left)}{operator}{_text(right)})"
    raise TypeError(term)


def _names(term: Term) -> list[str]:
    """The variables of a term, in order."""
    match term:
        case Variable(name):
            return [name]
        case Record(_, arguments):
            return [name for argument in arguments for name in _names(argument)]
        case Arithmetic(_, left, right):
            return _names(left) + _names(right)
    return []


def _order(value: Ground) -> tuple[int, int, str]:
    """Numbers before identifiers before records."""
    if isinstance(value, int):
        return (0, value, "")
    return (2 if value.arguments else 1, 0, str(value))
