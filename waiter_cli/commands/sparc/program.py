"""The argument PROGRAM of the SPARC commands, and its translation within the time limit."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from sparc.translation.asp_program import AspProgram
    from waiter_cli.commands.options import TranslatorName

__all__ = ["ProgramArgument", "report_time_limit", "translated"]

ProgramArgument = Annotated[
    str, typer.Argument(metavar="PROGRAM", help="A SPARC program; - is standard input.")
]


def translated(
    source: Any, translator: TranslatorName, sparc_jar: str | None, time_limit: float | None
) -> AspProgram | None:
    """Returns the translation, None when the time was up."""
    import waiter_cli
    from sparc.solving.jar_translator import TranslationTimeout

    try:
        return waiter_cli.find_translator(translator.value, sparc_jar).translate(
            source, time_limit=time_limit
        )
    except TranslationTimeout:
        return None


def report_time_limit(as_json: bool) -> int:
    """Reports that the time limit came first and returns the exit code."""
    from waiter_cli.console.output import print_json, print_text
    from waiter_cli.errors import Exit

    if as_json:
        print_json({"status": "undecided", "limit": "time"})
    print_text("waiter: the time limit was reached.", sys.stderr)
    return Exit.UNDECIDED
