"""The stages of a program as text: what ``--show`` prints and golden files hold.

Entry point `show_stage`: ``tokens``, ``ast``, ``sparc`` (canonical text), ``sorts`` or ``asp``.
"""

from __future__ import annotations

from sparc.checking.typed_program import TypedProgram
from sparc.source import Source
from sparc.syntax.tree import Program

__all__ = ["STAGES", "show_stage"]

STAGES = ("tokens", "ast", "sparc", "sorts", "asp")
_LISTED = 1000  # elements of a sort that are written out


def show_stage(stage: str, source: Source) -> str:
    """Returns one stage of a program, without a line end at the end.

    Raises `SourceError` or `SourceErrors` where the program does not get so far.
    """
    if stage == "tokens":
        from sparc.syntax.lexer import tokenize

        return "\n".join(f"{t.span.location}\t{t.kind}\t{t.text}" for t in tokenize(source))
    from sparc.syntax.parser import parse

    program = parse(source)
    if stage == "ast":
        return _tree(program)
    if stage == "sparc":
        from sparc.syntax.printer import print_program

        return print_program(program).rstrip("\n")
    from sparc.checking.checker import check

    typed = check(program)
    if stage == "sorts":
        return _sorts(typed)
    from sparc.translation.translator import translate

    return translate(typed).annotated()


def _tree(program: Program) -> str:
    """Returns the tree, one statement a line."""
    display = () if program.display is None else program.display
    parts = (program.directives, program.sorts, program.predicates, program.statements, display)
    return "\n".join(repr(node) for part in parts for node in part)


def _sorts(typed: TypedProgram) -> str:
    """Returns each sort with its elements, or with its size when it is large."""
    from sparc.sorts.values import text

    lines = []
    for name, sort in typed.sorts.items():
        size = sort.extent.bound()
        if size > _LISTED:
            lines.append(f"#{name}: {size} elements at most")
        else:
            lines.append(f"#{name} = {{{', '.join(map(text, sort.extent))}}}")
    return "\n".join(lines)
