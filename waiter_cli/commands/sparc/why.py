"""``waiter sparc why``: why a literal is in an answer set, or not."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from waiter_cli.command_line.command import takes_literal
from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    MemoryLimitOption,
    TimeLimitOption,
)
from waiter_cli.commands.sparc.program import ProgramArgument

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sparc.explaining.why import Why
    from sparc.source import Source

__all__ = ["explain_query", "print_why", "why"]


@takes_literal
def why(
    program: ProgramArgument,
    literal: Annotated[
        str,
        typer.Argument(
            metavar="LITERAL", help="Such as 'flies(tweety)', or several: 'p(X), q(X)'."
        ),
    ],
    number: Annotated[
        int, typer.Option("--set", min=1, metavar="K", help="Ask about the K-th answer set.")
    ] = 1,
    constants: ConstantOption = None,
    as_json: JsonOption = False,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
) -> int:
    """Say why a literal is in an answer set, or why it is not.

    Of a literal that is there the smallest derivation is shown; of one that is
    not, each rule that could give it and the first premise that fails.  Several
    are joined by commas; variables get the first values that fit all of them.
    Where none do, the literal is explained that fails with those that fit best.

    \b
    Examples:
      waiter sparc why family.sparc 'ancestor(anna,dora)'
      waiter sparc why family.sparc '-ancestor(dora,anna)'
      waiter sparc why family.sparc 'parent(anna,X), ancestor(X,dora)'
    """
    from sparc.limits import begin
    from waiter_cli.file_access.sparc_file import read_program

    begin(time_limit, memory_limit)
    source = read_program(program, constants)
    return explain_query(source, literal, number=number, time_limit=time_limit, as_json=as_json)


def explain_query(
    source: Source, query: str, *, number: int, time_limit: float | None, as_json: bool
) -> int:
    """Prints why a query is true in the ``number``-th answer set of a program, or not.

    Returns the exit code; raises `InputError` where there is no such answer set.
    """
    import sparc
    from sparc.explaining.why import why_query

    typed = sparc.check(sparc.parse(source))
    answers = why_query(typed, query, number=number, time_limit=time_limit)
    return print_why(answers, source.name, as_json=as_json)


def print_why(answers: Sequence[Why], name: str, *, as_json: bool) -> int:
    """Prints what `why_query` found in the program ``name``, and returns the exit code.

    Raises `InputError` where there is no such answer set.
    """
    from waiter_cli.answersets.why_document import why_document
    from waiter_cli.console.output import print_json, print_text, say
    from waiter_cli.errors import Exit, InputError

    found = answers[0]  # what is missing, a set or time, is missing for all of them
    if found.sets:
        some = "one answer set" if found.sets == 1 else f"{found.sets} answer sets"
        raise InputError(f"--set {found.number}: {name} has {some}", "give a smaller number")
    if as_json:
        print_json(why_document(answers))
    if found.holds is None:
        if found.limit is None:
            print_text(f"waiter: {name} is inconsistent: it has no answer set.", sys.stderr)
            print_text(f"  hint: waiter sparc explain {name}", sys.stderr)
            return Exit.PROVED
        print_text(f"waiter: {found.literal}: the {found.limit} limit was reached.", sys.stderr)
        return Exit.UNDECIDED
    if not as_json:
        for number, answer in enumerate(answers):
            if number:
                print_text("")
            for line in answer.lines():
                say(line, hang=4)
    return Exit.OK
