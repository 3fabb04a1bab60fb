"""Breaks text at words to the width of a terminal. Entry points `wrapped`, `table_lines`.

A path, a place (``FILE:LINE:COLUMN``) or a command that one may want to copy stays in one piece.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from typing import Any

from waiter_cli.console.styling import unmarked

__all__ = ["cells", "columns", "table_lines", "wrapped"]

_COMMANDS = (
    "plan|explain|answersets|serve|simulate|validate|domain|sparc|layout|compare|doctor|tour"
)
_PLACE = r"( *)([^ :][^:]*:\d+:\d+:)(?= )"
_INSTALL = r"\S*python[\d.]*\ -m\ pip\ install\ \S+"
_PIECE = rf"""(?x) (\ *) (
    {_INSTALL}
  | (?: waiter\ (?: --|(?:{_COMMANDS})\b ) | pip\ install\  ) [^;,.()]*\S*
  | '[^']{{1,40}}'\S* | `[^`]*`\S*
  | [\d.,]*\d\ (?: s|ms|m|MB )\b\S*
  | [^ ]+
)"""


def columns(stream: Any) -> int | None:
    """Returns the width of the terminal that a stream writes to; None where it is no terminal."""
    if not stream.isatty():
        return None
    told = os.environ.get("COLUMNS", "")
    if told.isdecimal() and int(told):
        return int(told)
    try:
        found = os.get_terminal_size(stream.fileno()).columns
    except (OSError, ValueError):
        found = 0
    return found or 80  # a terminal that does not know its size says 0


def cells(text: str) -> int:
    """Returns the number of terminal columns that a text takes; styles take none."""
    text = unmarked(text)
    if text.isascii():
        return len(text)
    import unicodedata  # only for letters beyond ASCII

    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)


def wrapped(text: str, width: int, hang: int = 2) -> str:
    """Returns the text broken at words; what a line carries over is indented by ``hang`` more.

    >>> print(wrapped("  hint: see waiter plan --help, or ask a friend", 28))
      hint: see
        waiter plan --help, or
        ask a friend
    """
    return "\n".join(_line(line, width, hang) for line in text.split("\n"))


def _line(line: str, width: int, hang: int) -> str:
    if cells(line) <= width:
        return line
    indent = " " * min(len(line) - len(line.lstrip(" ")) + hang, max(width - 16, 0))
    out: list[str] = []
    taken = 0
    for gap, piece in _pieces(line, width - len(indent)):
        size = cells(piece)
        if taken and taken + len(gap) + size > width:
            out.append(f"\n{indent}{piece}")
            taken = len(indent) + size
        else:
            out.append(gap + piece)
            taken += len(gap) + size
    return "".join(out)


def _pieces(line: str, room: int) -> Iterator[tuple[str, str]]:
    """Yields the pieces that stay together, each with the spaces before it."""
    place = re.match(_PLACE, line)
    if place is not None:
        yield place[1], place[2]
    for gap, piece in re.findall(_PIECE, line[place.end() if place is not None else 0 :]):
        if " " in piece and cells(piece) > room and not re.fullmatch(_INSTALL, piece):
            first, *rest = piece.split()
            yield gap, first
            yield from ((" ", word) for word in rest)
        else:
            yield gap, piece


def table_lines(
    headings: Sequence[str],
    rows: Sequence[Sequence[str]],
    right: Sequence[int] = (0,),
    prose: int | None = None,
    width: int | None = None,
) -> list[str]:
    """Returns rows as aligned plain text, two spaces apart; columns in ``right`` align right.

    Where ``width`` is too small for them, the cells of the column ``prose`` are broken at words.

    >>> table_lines(("step", "in words"), [("0", "walk from n1 to n2")], prose=1, width=20)
    ['step  in words', '   0  walk from n1', '      to n2']
    """
    widths = [max(cells(row[i]) for row in [headings, *rows]) for i in range(len(headings))]
    if prose is not None and width is not None:
        words = max(cells(word) for row in rows for word in (row[prose].split() or [""]))
        others = sum(widths) - widths[prose] + 2 * (len(widths) - 1)
        room = max(width - others, words, cells(headings[prose]))
        if room < widths[prose]:
            widths[prose] = room
            rows = [part for row in rows for part in _parts(row, prose, room)]
    lines = []
    for row in [headings, *rows]:
        padded = []
        for i, (text, size) in enumerate(zip(row, widths, strict=True)):
            pad = " " * (size - cells(text))
            padded.append(pad + text if i in right else text + pad)
        lines.append("  ".join(padded).rstrip())
    return lines


def _parts(row: Sequence[str], prose: int, room: int) -> Iterator[list[str]]:
    """Yields a row as the rows that it takes where the cell ``prose`` has that much room."""
    first, *more = wrapped(row[prose], room, 0).split("\n")
    yield [*row[:prose], first, *row[prose + 1 :]]
    for text in more:
        yield ["" if i != prose else text for i in range(len(row))]
