"""SPARC: answer set programs with sorts and consistency-restoring rules.

The front door.  Each stage takes a value and gives a value, and is loaded when it is first used:

>>> import sparc
>>> program = sparc.check(sparc.parse("sorts #s = 1..2. predicates p(#s). rules {p(X)}. "))
>>> sorted(len(answer_set.literals) for answer_set in sparc.solve(program))
[0, 1, 1, 2]
>>> sparc.to_asp(program).text
'{p(X): __s(X)}.\\n__s(1..2).'

Faults in a program are a `SourceError` (a single one of syntax) or `SourceErrors` (all that the
parser or the type check finds); `sparc.diagnostics.render_all` makes text of them.
"""

from __future__ import annotations

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from typing import Any

    from sparc.answer_sets import AnswerSet, GroundLiteral, GroundTerm
    from sparc.checking.typed_program import TypedProgram
    from sparc.errors import SourceError, SourceErrors, SparcWarning
    from sparc.explaining.explain import Inconsistency
    from sparc.explaining.why import Why
    from sparc.solving.answers import Answers
    from sparc.solving.query import Answer
    from sparc.source import Source, Span
    from sparc.syntax.tree import Program
    from sparc.translation.asp_program import AspProgram

__all__ = [
    "Answer",
    "AnswerSet",
    "Answers",
    "AspProgram",
    "GroundLiteral",
    "GroundTerm",
    "Inconsistency",
    "Program",
    "Source",
    "SourceError",
    "SourceErrors",
    "SparcWarning",
    "Span",
    "TypedProgram",
    "Why",
    "check",
    "explain",
    "find_warnings",
    "parse",
    "query",
    "solve",
    "to_asp",
    "translate",
    "why",
]

_HOMES = {
    "Answer": "solving.query",
    "AnswerSet": "answer_sets",
    "Answers": "solving.answers",
    "AspProgram": "translation.asp_program",
    "GroundLiteral": "answer_sets",
    "GroundTerm": "answer_sets",
    "Inconsistency": "explaining.explain",
    "Program": "syntax.tree",
    "Source": "source",
    "SourceError": "errors",
    "SourceErrors": "errors",
    "SparcWarning": "errors",
    "Span": "source",
    "TypedProgram": "checking.typed_program",
    "Why": "explaining.why",
}


def parse(source: Source | str, name: str = "<program>") -> Program:
    """Returns the tree of a program, given as a `Source` or as text.

    Raises `SourceError` for the one fault of syntax, `SourceErrors` for several.
    """
    from sparc.source import Source
    from sparc.syntax.parser import parse as run

    return run(Source(name, source) if isinstance(source, str) else source)


def check(program: Program) -> TypedProgram:
    """Returns the program with its sorts and predicates; raises `SourceErrors` with all its faults."""
    from sparc.checking.checker import check as run

    return run(program)


def translate(program: TypedProgram) -> AspProgram:
    """Returns the program for clingo; raises `LimitError` when a sort it needs listed is too large."""
    from sparc.translation.translator import translate as run

    return run(program)


def to_asp(program: Source | str | Program | TypedProgram) -> AspProgram:
    """Returns the program for clingo, from any stage."""
    return translate(_typed(program))


def solve(
    program: Source | str | Program | TypedProgram,
    *,
    models: int = 0,
    time_limit: float | None = None,
) -> Answers:
    """Returns an iterator over the answer sets, each as it is found; ``models`` at most (0: all).

    With preferences (consistency-restoring rules, weak constraints, optimization) these are all
    optimal ones and no others.  ``time_limit`` is in seconds.  Raises what the stages before
    raise, and `SolverError` when clingo fails.
    """
    asp = to_asp(program)
    from sparc.solving.answers import Answers

    return Answers(asp, models=models, time_limit=time_limit)


def query(
    program: Source | str | Program | TypedProgram,
    literal: str,
    *,
    time_limit: float | None = None,
) -> Answer:
    """Returns the answer to a query: yes, no, unknown, or the bindings that fit."""
    from sparc.solving.query import query as run

    return run(_typed(program), literal, time_limit=time_limit)


def explain(
    program: Source | str | Program | TypedProgram,
    *,
    every: bool = False,
    time_limit: float | None = None,
) -> Inconsistency:
    """Returns why the program has no answer set: minimal causes, and the least mends.

    Causes that share no statement, or ``every`` one (100 at most).  ``time_limit`` is in seconds;
    what it left open is said to be so (`Inconsistency.complete`).
    """
    from sparc.explaining.explain import explain as run

    return run(_typed(program), every=every, time_limit=time_limit)


def why(
    program: Source | str | Program | TypedProgram,
    literal: str,
    *,
    number: int = 1,
    time_limit: float | None = None,
) -> Why:
    """Returns why a ground literal is in the ``number``-th answer set, or why it is not.

    Its smallest derivation, or each rule that could give it with the premise that fails.
    """
    from sparc.explaining.why import why as run

    return run(_typed(program), literal, number=number, time_limit=time_limit)


def find_warnings(program: TypedProgram) -> tuple[SparcWarning, ...]:
    """Returns warnings about what is legal and probably a mistake, in the order of the text."""
    from sparc.checking.warnings import find_warnings as run

    return run(program)


def _typed(program: Source | str | Program | TypedProgram) -> TypedProgram:
    from sparc.checking.typed_program import TypedProgram

    if isinstance(program, TypedProgram):
        return program
    from sparc.syntax.tree import Program

    return check(program if isinstance(program, Program) else parse(program))


def __getattr__(name: str) -> Any:
    """Returns the classes of the front door, loaded when asked for."""
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{home}"), name)
