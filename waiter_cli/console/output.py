"""What a person sees: plans, faults and results as text.

Results go to stdout, faults and progress to stderr.  On a terminal lines are broken at words to its
width (`say`); into a pipe or a file they go whole.  Colour appears on a terminal only, and never
with ``NO_COLOR``.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from waiter_cli.console.streams import printable_json
from waiter_cli.console.wrapping import columns, table_lines, wrapped
from waiter_cli.errors import Fault

if TYPE_CHECKING:
    from sparc.errors import SourceError
    from waiter_cli.errors import Where

__all__ = ["print_faults", "print_json", "print_source_faults", "print_table", "say", "styled"]


def _wants_colour(stream: Any) -> bool:
    return (
        bool(stream.isatty())
        and not os.environ.get("NO_COLOR")
        and os.environ.get("TERM") != "dumb"
    )


_CODES = {
    "red": "31",
    "green": "32",
    "yellow": "33",
    "blue": "34",
    "cyan": "36",
    "bold": "1",
    "dim": "2",
}


def styled(text: str, style: str, stream: Any = None) -> str:
    """``text`` in a style (``red``, ``bold``, …), where ``stream`` (stdout) takes colour."""
    if not _wants_colour(sys.stdout if stream is None else stream):
        return text
    return f"\x1b[{';'.join(_CODES[word] for word in style.split())}m{text}\x1b[0m"


def say(text: str, stream: Any = None, hang: int = 2) -> None:
    """Prints text for people on ``stream`` (stdout): on a terminal no line is broken inside a word.

    What a line carries over is indented by ``hang`` more than the line itself.
    """
    stream = sys.stdout if stream is None else stream
    width = columns(stream)
    print(text if width is None else wrapped(text, width, hang), file=stream)


def print_json(document: Any) -> None:
    """One JSON document on stdout."""
    print(printable_json(json.dumps(document, ensure_ascii=False)))


def print_faults(faults: Iterable[Fault], word: str = "error") -> None:
    """``FILE:LINE:COLUMN: error: what`` on stderr, with the line of the file and the mend."""
    room = max(20, min(100, (columns(sys.stderr) or 108) - len("12345 | ")))
    for fault in faults:
        place = f"{fault.where}: " if fault.where else ""
        style = "bold yellow" if word == "warning" else "bold red"
        say(f"{place}{styled(word + ':', style, sys.stderr)} {fault.message}", sys.stderr, 4)
        excerpt = fault.excerpt
        if excerpt is None and word == "error":  # advice goes without, being many lines already
            excerpt = _line_of(fault.where)
        if excerpt is not None and fault.where and fault.where.line:
            line, column = _around(excerpt, fault.where.column, room)
            print(f"{fault.where.line:>5} | {line}", file=sys.stderr)
            pad = "".join("\t" if c == "\t" else " " for c in line[: column - 1])
            print(f"      | {pad}{styled('^', style, sys.stderr)}", file=sys.stderr)
        if fault.hint:
            say(f"  hint: {fault.hint}", sys.stderr, len("hint: "))


def _line_of(where: Where | None) -> str | None:
    """The line of a file, for a fault that was found when its text was no longer at hand."""
    if where is None or where.line < 1:
        return None
    from itertools import islice

    from sparc.reading import MAX_PROGRAM, read_capped

    try:
        if not os.path.isfile(where.name):  # a device or a pipe is not read again
            return None
        text = read_capped(where.name, MAX_PROGRAM).decode("utf-8-sig")
    except (OSError, ValueError):
        return None
    line = next(islice(text.split("\n"), where.line - 1, None), None)
    return None if line is None else line.rstrip("\r")


def print_source_faults(faults: Iterable[SourceError]) -> None:
    """Faults and warnings of a SPARC program on stderr, each with the line of the program."""
    from sparc.diagnostics import render_all

    room = max(20, min(160, (columns(sys.stderr) or 170) - len("12345 | ……")))
    for line in render_all(faults, room).split("\n"):
        if line[5:8] == " | ":
            print(line, file=sys.stderr)
        else:
            say(line, sys.stderr, len("hint: ") if line.startswith(" ") else 4)


def _around(line: str, column: int, width: int) -> tuple[str, int]:
    """A line cut to ``width`` about a column (from 1), and that column of what is left.

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
    """A table on stdout; on a terminal that is too narrow the column ``prose`` gives way."""
    head, *body = table_lines(headings, rows, right, prose, columns(sys.stdout))
    print("\n".join([styled(head, "bold"), *body]))
