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
    from sparc.explaining.why import Why

__all__ = ["print_why", "why"]


@takes_literal
def why(
    program: ProgramArgument,
    literal: Annotated[str, typer.Argument(metavar="LITERAL", help="Such as 'flies(tweety)'.")],
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
    not, each rule that could give it and the first premise that fails.

    \b
    Examples:
      waiter sparc why family.sparc 'ancestor(anna,dora)'
      waiter sparc why family.sparc '-ancestor(dora,anna)'
    """
    import sparc
    from sparc.limits import begin
    from waiter_cli.file_access.sparc_file import read_program

    begin(time_limit, memory_limit)
    source = read_program(program, constants)
    answer = sparc.why(source, literal, number=number, time_limit=time_limit)
    return print_why(answer, source.name, as_json=as_json)


def print_why(found: Why, name: str, *, as_json: bool) -> int:
    """Prints an answer about the program ``name``, and returns the exit code.

    Raises `InputError` where there is no such answer set.
    """
    from waiter_cli.answersets.why_document import why_document
    from waiter_cli.console.output import print_json, print_text, say
    from waiter_cli.errors import Exit, InputError

    if found.sets:
        some = "one answer set" if found.sets == 1 else f"{found.sets} answer sets"
        raise InputError(f"--set {found.number}: {name} has {some}", "give a smaller number")
    if as_json:
        print_json(why_document(found))
    if found.holds is None:
        if found.limit is None:
            print_text(f"waiter: {name} is inconsistent: it has no answer set.", sys.stderr)
            print_text(f"  hint: waiter sparc explain {name}", sys.stderr)
            return Exit.PROVED
        print_text(f"waiter: {found.literal}: the {found.limit} limit was reached.", sys.stderr)
        return Exit.UNDECIDED
    if not as_json:
        for line in found.lines():
            say(line, hang=4)
    return Exit.OK
