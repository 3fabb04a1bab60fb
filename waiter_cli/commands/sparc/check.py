"""``waiter sparc check`` and ``waiter sparc translate``: what is wrong with a program, and its ASP."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import (
    ConstantOption,
    JsonOption,
    MemoryLimitOption,
    SparcJarOption,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
)

if TYPE_CHECKING:
    from sparc.translation.asp_program import AspProgram

__all__ = ["ProgramArgument", "annotated", "check", "translate", "translated"]

ProgramArgument = Annotated[
    str, typer.Argument(metavar="PROGRAM", help="A SPARC program; - is standard input.")
]


def check(
    program: ProgramArgument,
    warnings: Annotated[
        bool, typer.Option("--warnings", help="Report what is legal but probably a mistake, too.")
    ] = False,
    constants: ConstantOption = None,
    as_json: JsonOption = False,
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
) -> int:
    """Find every fault of a program: syntax, sorts, predicates, rules.

    \b
    Examples:
      waiter sparc check family.sparc --warnings
      waiter sparc check - --json < family.sparc
    """
    import sparc
    from sparc.diagnostics import as_dict
    from sparc.limits import begin
    from waiter_cli.console.output import print_json, print_source_faults, say
    from waiter_cli.console.styling import styled
    from waiter_cli.files.sparc_file import read_program

    begin(time_limit, memory_limit)
    source = read_program(program, constants)
    if translator is TranslatorName.jar:
        if translated(source, translator, sparc_jar, time_limit) is None:
            return _out_of_time(as_json)
        if not warnings:
            if as_json:
                print_json({"status": "ok", "warnings": []})
            else:
                say(f"{source.name}: {styled('no fault', 'green')}.")
            return 0
    typed = sparc.check(sparc.parse(source))
    sparc.translate(typed)
    found = sparc.find_warnings(typed) if warnings else ()
    numbers = {
        "sorts": len(typed.program.sorts),
        "predicates": len(typed.program.predicates),
        "rules": len(typed.program.statements),
    }
    if as_json:
        print_json({"status": "ok", **numbers, "warnings": [as_dict(each) for each in found]})
        return 0
    if found:
        print_source_faults(found)
    sizes = ", ".join(
        f"{number} {name if number != 1 else name[:-1]}" for name, number in numbers.items()
    )
    say(f"{source.name}: {styled('no fault', 'green')} in {sizes}.")
    return 0


def translated(
    source: Any, translator: TranslatorName, sparc_jar: str | None, time_limit: float | None
) -> AspProgram | None:
    """The translation, None when the time was up."""
    import waiter_cli
    from sparc.solving.jar_translator import TranslationTimeout

    try:
        return waiter_cli.find_translator(translator.value, sparc_jar).translate(
            source, time_limit=time_limit
        )
    except TranslationTimeout:
        return None


def _out_of_time(as_json: bool) -> int:
    from waiter_cli.console.output import print_json, print_text
    from waiter_cli.errors import Exit

    if as_json:
        print_json({"status": "undecided", "limit": "time"})
    print_text("waiter: the time limit was reached.", sys.stderr)
    return Exit.UNDECIDED


# ------------------------------------------------------------------ translate


def translate(
    program: ProgramArgument,
    output: Annotated[
        Optional[str],
        typer.Option("--output", "-o", metavar="FILE", help="Write FILE instead of printing."),
    ] = None,
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
    from waiter_cli.files.sparc_file import read_program

    begin(time_limit, memory_limit)
    asp = translated(read_program(program, constants), translator, sparc_jar, time_limit)
    if asp is None:
        return _out_of_time(as_json)
    text = annotated(asp)
    file = None if output == "-" else output
    if file is not None:
        from waiter_cli.files.atomic import write_whole

        write_whole(file, text)
    if as_json:
        from waiter_cli.console.output import print_json

        print_json({"status": "ok", "file": file, "text": text})
    elif file is None:
        print_document(text)
    return 0


def annotated(program: AspProgram) -> str:
    """The clingo program with a comment above what each SPARC statement became.

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
    """The name of a file as a comment can hold it."""
    return "".join(c if c >= " " else ascii(c)[1:-1] for c in name)
