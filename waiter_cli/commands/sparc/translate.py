"""``waiter sparc translate``: a program for clingo, with the SPARC above each rule."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    MemoryLimitOption,
    OutputOption,
    SparcJarOption,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
)
from waiter_cli.commands.sparc.program import ProgramArgument, report_time_limit, translated

if TYPE_CHECKING:
    from sparc.translation.asp_program import AspProgram

__all__ = ["annotated", "translate"]


def translate(
    program: ProgramArgument,
    output: OutputOption = None,
    constants: ConstantOption = None,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
) -> int:
    """Translate a program for clingo; above each rule stands the SPARC it comes from.

    \b
    Examples:
      waiter sparc translate family.sparc
      waiter sparc translate family.sparc -o family.lp
    """
    from sparc.limits import begin
    from waiter_cli.console.output import print_document
    from waiter_cli.file_access.sparc_file import read_program

    begin(time_limit, memory_limit)
    asp = translated(read_program(program, constants), translator, sparc_jar, time_limit)
    if asp is None:
        return report_time_limit(as_json)
    text = annotated(asp)
    if output is not None:
        from waiter_cli.file_access.atomic import write_whole

        write_whole(output, text)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json({"status": "ok", "file": output, "text": text})
    elif output is None:
        print_document(text)
    return 0


def annotated(program: AspProgram) -> str:
    """Returns the clingo program with a comment above what each SPARC statement became.

    The comment has the place of the statement and its lines.
    """
    from itertools import zip_longest

    lines: list[str] = []
    before: Any = None
    texts = program.text.rstrip("\n").split("\n")
    spans = program.line_spans[: len(texts)]
    for text, span in zip_longest(texts, spans):
        if span is not None and span is not before:
            lines += ["", f"% {_on_one_line(span.location.name)}:{span.location.line}"]
            lines += [f"%   {line.rstrip()}" for line in span.text.split("\n")]
        elif span is None and (before is not None or not lines):
            lines += ["", "% what the rules need to know of sorts and constants"]
        lines.append(text)
        before = span
    shown = program.show.rstrip("\n")
    return "\n".join([*lines, "", "% what is shown", shown, *program.script(), ""]).lstrip("\n")


def _on_one_line(name: str) -> str:
    """Returns the name of a file as a comment can hold it."""
    return "".join(c if c >= " " else ascii(c)[1:-1] for c in name)
