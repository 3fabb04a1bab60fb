"""Splices: stretches of a YAML text with what stands there instead. Entry points are functions.

All but what is spliced stays byte for byte, comments and order included.  `applied` makes the new text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Any, NamedTuple

from waiter_cli.editing.spans import Piece
from waiter_cli.errors import InputError
from waiter_cli.files.layout_writer import flow

__all__ = [
    "Splice",
    "applied",
    "as_number",
    "new_entry",
    "new_item",
    "new_number",
    "new_value",
    "renamed",
    "without_entry",
    "without_item",
    "written",
]


class Splice(NamedTuple):
    """The stretch from ``start`` to before ``end`` becomes ``new``."""

    start: int
    end: int
    new: str


def applied(text: str, splices: Iterable[Splice]) -> str:
    """Returns the text with splices that do not overlap."""
    for start, end, new in sorted(set(splices), reverse=True):
        text = text[:start] + new + text[end:]
    return text


def as_number(value: float, like: str = "") -> str:
    """Returns metres to the millimetre, with a point where ``like`` has one.

    >>> as_number(1.25), as_number(-0.0), as_number(2, like="0.0")
    ('1.25', '0', '2.0')
    """
    shown = f"{round(value, 3) + 0.0:.3f}".rstrip("0").rstrip(".")
    shown = "0" if shown == "-0" else shown
    return f"{shown}.0" if "." in like and "." not in shown else shown


def written(text: str, value: Any) -> str:
    """Returns a value as a text has its values: as JSON where the text is JSON, else as YAML."""
    if text.lstrip().startswith("{") and re.match(r'\s*\{\s*"', text):
        return json.dumps(value, ensure_ascii=False)
    return flow(value)


def new_value(text: str, piece: Piece, value: Any) -> Splice:
    """Writes a value in the place of another one; a block of several lines becomes one line."""
    new = written(text, value)
    gap = " " if piece.start == piece.end and text[piece.start - 1 : piece.start] in ":-" else ""
    return Splice(piece.start, piece.end, gap + new)


def new_number(piece: Piece, value: float) -> list[Splice]:
    """Writes a number in the place of another one, unless they are equal."""
    try:
        if abs(float(piece.text) - value) < 5e-7:
            return []
    except ValueError:
        pass
    return [Splice(piece.start, piece.end, as_number(value, piece.text))]


def renamed(text: str, piece: Piece, name: str) -> Splice:
    """Writes a name in the place of another one, in the quotes that were there."""
    quote = text[piece.start : piece.start + 1]
    new = f"{quote}{name}{quote}" if quote in ("'", '"') and piece.flow else name
    return Splice(piece.start, piece.end, new)


def new_entry(text: str, piece: Piece, key: str, value: Any, owner: Piece | None = None) -> Splice:
    """Adds a key with its value after the last entry of a map.

    ``owner`` is the key whose value the map is, for one that was left out.
    """
    line = _entry(text, key, value)
    if piece.is_nothing and owner is not None:
        return _instead_of_nothing(text, piece, owner, "{" + line + "}")
    if piece.kind != "map":
        raise InputError("there is no place for it in the text", "write it there yourself")
    return _after_last(text, piece, [value for _, value in piece.entries], line, "{}")


def new_item(text: str, piece: Piece, value: Any, owner: Piece | None = None) -> Splice:
    """Adds an item at the end of a list; ``owner`` as in `new_entry`."""
    item = written(text, value)
    if piece.is_nothing and owner is not None:
        return _instead_of_nothing(text, piece, owner, f"[{item}]")
    if piece.kind != "list":
        raise InputError("there is no place for it in the text", "write it there yourself")
    return _after_last(text, piece, piece.items, item if piece.flow else f"- {item}", "[]")


def without_entry(text: str, piece: Piece, key: str, owner: Piece | None = None) -> Splice:
    """Takes a key and its value out of a map; the line of a block's entry goes as a whole.

    A map that is empty then stays as ``{}``, after its ``owner``.
    """
    names = [name.text for name, _ in piece.entries]
    spans = [(name.start, value.end) for name, value in piece.entries]
    return _without(text, piece, spans, names.index(key), owner, "{}")


def without_item(text: str, piece: Piece, index: int, owner: Piece | None = None) -> Splice:
    """Takes an item out of a list; as `without_entry`."""
    spans = [(item.start, item.end) for item in piece.items]
    if not piece.flow:
        spans = [(text.rindex("-", 0, start), end) for start, end in spans]
    return _without(text, piece, spans, index, owner, "[]")


# -- how it is done -------------------------------------------------------------------------


def _entry(text: str, key: str, value: Any) -> str:
    shown = written(text, value)
    return f"{written(text, key)}: {shown}"


def _newline(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def _line_start(text: str, at: int) -> int:
    return max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1


def _line_end(text: str, at: int) -> int:
    """Returns the end of the line in which a place is, before its line break."""
    found = re.compile(r"[\r\n]").search(text, at)
    return found.start() if found else len(text)


def _instead_of_nothing(text: str, piece: Piece, owner: Piece, new: str) -> Splice:
    if piece.end > piece.start:  # a null that was written
        return Splice(piece.start, piece.end, new)
    colon = text.index(":", owner.end) + 1
    return Splice(colon, colon, f" {new}")


def _after_last(
    text: str, piece: Piece, values: Iterable[Piece], new: str, brackets: str
) -> Splice:
    """Adds to a collection, in its own style."""
    values = list(values)
    if piece.flow and not values:
        return Splice(piece.start, piece.start + 1, piece_open(brackets, new, text, piece))
    last = values[-1]
    if piece.flow:
        start = last.start
        if piece.kind == "map":
            start = piece.entries[-1][0].start
        before = text[_line_start(text, start) : start]
        if not before.strip():  # each on a line of its own
            return Splice(last.end, last.end, f",{_newline(text)}{before}{new}")
        return Splice(last.end, last.end, f", {new}")
    first = piece.start
    indent = text[_line_start(text, first) : first]
    indent = re.sub(r"[^ ]", " ", indent)
    if (
        last.end and text[last.end - 1] in "\r\n"
    ):  # a text of several lines ends with its line break
        return Splice(last.end, last.end, f"{indent}{new}{_newline(text)}")
    end = _line_end(text, last.end)
    return Splice(end, end, f"{_newline(text)}{indent}{new}")


def piece_open(brackets: str, new: str, text: str, piece: Piece) -> str:
    """Returns the opening bracket of an empty collection, with its first item behind it."""
    rest = text[piece.start + 1 : piece.end - 1]
    return brackets[0] + new + (" " if "#" in rest and not rest.startswith((" ", "\n")) else "")


def _without(
    text: str,
    piece: Piece,
    spans: list[tuple[int, int]],
    index: int,
    owner: Piece | None,
    brackets: str,
) -> Splice:
    start, end = spans[index]
    if piece.flow:
        return _out_of_brackets(text, spans, index)
    if len(spans) == 1 and owner is not None:
        colon = text.index(":", owner.end) + 1
        return Splice(colon, _line_end(text, end), f" {brackets}")
    line = _line_start(text, start)
    after = end if text[end - 1 : end] in "\r\n" and end else _line_end(text, end)
    if text[line:start].strip():  # it begins in the line of another dash
        following = spans[index + 1][0] if index + 1 < len(spans) else after
        return Splice(start, following, "")
    if text[after - 1 : after] not in ("\r", "\n"):
        broken = re.compile(r"\r\n?|\n").match(text, after)
        if broken:
            return Splice(line, broken.end(), "")
        if line:  # the last line, which has no line break: the one before it goes
            line -= 2 if text[line - 2 : line] == "\r\n" else 1
    return Splice(line, after, "")


def _out_of_brackets(text: str, spans: list[tuple[int, int]], index: int) -> Splice:
    start, end = spans[index]
    comma = re.compile(r"\s*,").match(text, end)
    if comma is None and index:
        return Splice(spans[index - 1][1], end, "")
    if comma is not None:
        end = comma.end()
        line = _line_start(text, start)
        rest = re.compile(r"[ \t]*(\r\n?|\n)").match(text, end)
        if rest and not text[line:start].strip() and line:
            return Splice(line, rest.end(), "")
        blank = re.compile(r"[ \t]*").match(text, end)
        end = blank.end() if blank else end
    return Splice(start, end, "")
