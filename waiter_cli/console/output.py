"""Prints what a person sees: plans, faults and results as text.

Results go to stdout, faults and progress to stderr.  On a terminal lines are broken at words to its
width (`say`); into a pipe or a file they go whole (`print_text`).  Whatever is shown is escaped here, so
that no name, path, option or line of a file commands a terminal; only colour of `styling` passes.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from sparc.escaping import escaped, on_one_line
from waiter_cli.console.streams import printable_json
from waiter_cli.console.styling import between_marks, printable, styled, visible
from waiter_cli.console.wrapping import cells, columns, table_lines, wrapped
from waiter_cli.errors import Fault

if TYPE_CHECKING:
    from sparc.errors import SourceError
    from waiter_cli.errors import Where

__all__ = [
    "print_faults",
    "print_json",
    "print_source_faults",
    "print_table",
    "say",
    "print_text",
    "print_document",
]


def say(text: str, stream: Any = None, hang: int = 2) -> None:
    """Prints text for people on ``stream`` (stdout), broken at words to the width of a terminal.

    What a line carries over is indented by ``hang`` more than the line itself.
    """
    stream = sys.stdout if stream is None else stream
    width = columns(stream)
    seen = visible(text)
    print_text(seen if width is None else wrapped(seen, width, hang), stream)


def print_text(text: str, stream: Any = None, end: str = "\n") -> None:
    """Prints text for people on ``stream`` (stdout) and leaves long lines whole."""
    print(printable(text), end=end, file=sys.stdout if stream is None else stream)


def print_document(text: str) -> None:
    """Writes the contents of a file to stdout: unchanged, but escaped where stdout is a terminal."""
    sys.stdout.write(escaped(text) if sys.stdout.isatty() else text)


def print_json(document: Any) -> None:
    """Prints one JSON document on stdout."""
    print(printable_json(json.dumps(document, ensure_ascii=False)))


def print_faults(faults: Iterable[Fault], word: str = "error") -> None:
    """Prints ``FILE:LINE:COLUMN: error: what`` on stderr, with the line of the file and the mend."""
    room = max(20, min(100, (columns(sys.stderr) or 108) - len("12345 | ")))
    for fault in faults:
        place = f"{on_one_line(str(fault.where))}: " if fault.where else ""
        style = "bold yellow" if word == "warning" else "bold red"
        say(f"{place}{styled(word + ':', style, sys.stderr)} {fault.message}", sys.stderr, 4)
        excerpt = fault.excerpt
        if excerpt is None and word == "error":  # advice goes without, being many lines already
            excerpt = _line_of(fault.where)
        if excerpt is not None and fault.where and fault.where.line:
            line, column = _around(excerpt, fault.where.column, room)
            print_text(f"{fault.where.line:>5} | {line}", sys.stderr)
            before = escaped(line[: column - 1])
            pad = re.sub(r"[^\t]+", lambda part: " " * cells(part[0]), before)
            print_text(f"      | {pad}{styled('^', style, sys.stderr)}", sys.stderr)
        if fault.hint:
            say(f"  hint: {fault.hint}", sys.stderr, len("hint: "))


def _line_of(where: Where | None) -> str | None:
    """Reads the line of a fault that was found when the text of its file was no longer at hand."""
    if where is None or where.line < 1:
        return None
    from itertools import islice

    from sparc.reading import MAX_PROGRAM, read_capped, text_of

    try:
        if not os.path.isfile(where.name):  # a device or a pipe is not read again
            return None
        text = text_of(read_capped(where.name, MAX_PROGRAM))
    except (OSError, ValueError):
        return None
    line = next(islice(text.split("\n"), where.line - 1, None), None)
    return None if line is None else line.rstrip("\r")


def print_source_faults(faults: Iterable[SourceError]) -> None:
    """Prints faults and warnings of a SPARC program on stderr, each with its line."""
    from sparc.diagnostics import parts

    room = max(20, min(160, (columns(sys.stderr) or 170) - len("12345 | ……")))
    for fault in faults:
        head, excerpt, hint = parts(fault, room)
        say(head, sys.stderr, 4)
        for line in excerpt:
            print_text(line, sys.stderr)
        if hint is not None:
            say(f"  hint: {hint}", sys.stderr, len("hint: "))


def _around(line: str, column: int, width: int) -> tuple[str, int]:
    """Cuts a line to ``width`` about a column (from 1); returns it and the column in it.

    >>> _around("abcdefghij", 9, 6)
    ('…ghij', 4)
    """
    if len(line) <= width:
        return line, column
    first = max(0, min(column - 1 - width // 3, len(line) - width + 2))
    cut = line[first : first + width - 2]
    before, after = "…" if first else "", "…" if first + width - 2 < len(line) else ""
    return before + cut + after, column - first + len(before)


def print_table(
    headings: Sequence[str],
    rows: Sequence[Sequence[str]],
    right: Sequence[int] = (0,),
    prose: int | None = None,
) -> None:
    """Prints a table on stdout; on a narrow terminal the column ``prose`` is broken at words."""
    cells_of = [[between_marks(cell, on_one_line) for cell in row] for row in rows]
    head, *body = table_lines(headings, cells_of, right, prose, columns(sys.stdout))
    print_text("\n".join([styled(head, "bold"), *body]))
