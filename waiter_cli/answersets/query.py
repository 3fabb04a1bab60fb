"""Answers queries to a program of another translator: `AspProgram`, text → `Answer`.

The meaning is that of `sparc.query`: a literal is true when it is in all answer sets, false when
its contrary is.  Faults of the query are found against the declarations of the SPARC program.
"""

from __future__ import annotations

import time

from sparc.checking.typed_program import TypedProgram
from sparc.solving.query import Answer, ask, checked_conjunction
from sparc.syntax.tree import Arithmetic, Atom, Identifier, Number, Record, Term, Variable
from sparc.translation.asp_program import AspProgram

__all__ = ["ask_asp"]

_ANSWER = "___answer"


def ask_asp(
    program: AspProgram, typed: TypedProgram, text: str, *, time_limit: float | None = None
) -> Answer:
    """Returns the answer of the answer sets of ``program`` to ``text``, literals joined by commas.

    ``typed`` is the same program with its declarations.  Raises `SparcSyntaxError`,
    `SourceErrors` for a query that is none; ``time_limit`` is in seconds.
    """
    deadline = None if time_limit is None else time.monotonic() + time_limit
    atoms = checked_conjunction(typed, text)
    literals = ",".join(_literal(atom, atom.negated) for atom in atoms)
    terms = [term for atom in atoms for term in atom.arguments]
    names = list(dict.fromkeys(name for term in terms for name in _names(term)))
    if names:
        extra = f"{_ANSWER}({','.join(names)}):-{literals}."
    else:
        contraries = [_literal(atom, not atom.negated) for atom in atoms]
        extra = f"{_ANSWER}(yes):-{literals}. "
        extra += " ".join(f"{_ANSWER}(no):-{contrary}." for contrary in contraries)
    return ask(program, extra, f"{_ANSWER}/{len(names) or 1}", names, deadline)


def _literal(atom: Atom, negated: bool) -> str:
    arguments = ",".join(map(_text, atom.arguments))
    return f"{'-' if negated else ''}{atom.name}{f'({arguments})' if arguments else ''}"


def _text(term: Term) -> str:
    """Returns the term in clingo's words."""
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
    """Returns the variables of a term, in order."""
    match term:
        case Variable(name):
            return [name]
        case Record(_, arguments):
            return [name for argument in arguments for name in _names(argument)]
        case Arithmetic(_, left, right):
            return _names(left) + _names(right)
    return []
