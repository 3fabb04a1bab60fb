"""``waiter sparc check``: every fault of a program."""

from __future__ import annotations

from typing import Annotated

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
from waiter_cli.commands.sparc.program import ProgramArgument, report_time_limit, translated

__all__ = ["check"]


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
    from waiter_cli.file_access.sparc_file import read_program

    begin(time_limit, memory_limit)
    source = read_program(program, constants)
    if translator is TranslatorName.jar:
        if translated(source, translator, sparc_jar, time_limit) is None:
            return report_time_limit(as_json)
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
