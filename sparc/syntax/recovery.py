"""Finds the statement at which a parser goes on behind a fault: tokens → the index of its first.

A statement ends with a dot; where that is missing, the next one begins on a line of its own that
is indented no further.  So a slip costs the statement it stands in and no other.

>>> from sparc.source import Source
>>> reader = Reader(Source("", "p(a b). q(c)."))
>>> reader.texts[behind_fault(reader, 0, 3)]
'q'
"""

from __future__ import annotations

from sparc.syntax.cursor import BINDING, RELATIONS, STATEMENT_STARTS, Cursor

__all__ = ["begins_line", "behind_fault", "has_rule_sign", "is_section", "statement_end"]

_OPENING = frozenset("([{")
_CLOSING = frozenset(")]}")
_BEGINS_NOTHING = frozenset((",", ")", "]", "}", ";", "+", "*", "/", "..", ":", "@", "|", "."))
_GOES_ON = (
    frozenset((",", ";", "|", ":", ":-", ":+", ":~", "..", "@", "#", "not", "and", "or", "bad"))
    | frozenset(RELATIONS)
    | frozenset(BINDING)
    | _OPENING
)  # behind these a line cannot end


def behind_fault(reader: Cursor, first: int, at: int) -> int:
    """Returns the index of the token at which the next statement begins, or of the end.

    ``first`` is the first token of the statement that has the fault, ``at`` the token at which
    reading stopped; nothing before ``at`` ends the statement.
    """
    end = statement_end(reader, first, at)
    return end + 1 if reader.kinds[end] == "." and end >= at else max(end, min(first + 1, end))


def statement_end(reader: Cursor, first: int, at: int) -> int:
    """Returns the index of the dot that ends the statement, or of what follows where there is none."""
    kinds, texts = reader.kinds, reader.texts
    margin = reader.column(first)
    depth = 0
    index = first
    if texts[first] == "#script":
        at = max(at, index + ([*texts[index:], "#end"].index("#end")))
        at = min(at, kinds.index("end"))
    while (kind := kinds[index]) != "end":
        if index >= at and index > first:
            if kind == "section" and is_section(reader, index):
                break
            if begins_line(reader, index, margin) and kinds[index - 1] not in _GOES_ON:
                break
        if kind == "." and index >= at and _ends(reader, index, depth):
            break
        if kind in _OPENING:
            depth += 1
        elif kind in _CLOSING:
            depth = max(depth - 1, 0)
        elif kind == "bad" and texts[index] in "\"'":
            index = _quoted(reader, index)
        index += 1
    return index


def begins_line(reader: Cursor, index: int, margin: int) -> bool:
    """Returns whether a token may begin a statement.

    It stands first on its line, at ``margin`` or left of it.
    """
    return (
        reader.kinds[index] in STATEMENT_STARTS
        and reader.on_new_line(index)
        and reader.column(index) <= margin
    )


def is_section(reader: Cursor, index: int) -> bool:
    """Returns whether a section word opens a section, rather than being a name with
    space behind it.
    """
    if index == 0 or reader.kinds[index - 1] not in _GOES_ON:
        return True
    return reader.on_new_line(index) and reader.on_new_line(index + 1)


def has_rule_sign(reader: Cursor, first: int) -> bool:
    """Returns whether what begins with the token ``first`` has a sign that only rules have."""
    signs = (":-", ":+", ":~", "{", "|")
    return any(kind in signs for kind in reader.kinds[first : statement_end(reader, first, first)])


def _ends(reader: Cursor, index: int, depth: int) -> bool:
    """Returns whether a dot ends its statement; in ``3.5``, ``p(a. b)`` and ``1...3`` none does."""
    following = reader.kinds[index + 1]
    if following in _BEGINS_NOTHING or following in RELATIONS:
        return reader.on_new_line(index + 1)
    if depth and _closes(reader, index + 1):
        return False
    before, behind = reader.touches_next(index - 1), reader.touches_next(index)
    if not behind or reader.kinds[index + 1] == "end":
        return True
    if before and reader.kinds[index - 1] in ("..", "number"):
        return reader.kinds[index + 1] != "number"
    return depth == 0


def _closes(reader: Cursor, index: int) -> bool:
    """Returns whether more brackets close than open up to the next dot or the end of the line."""
    depth = 0
    while reader.kinds[index] not in ("end", ".") and not reader.on_new_line(index):
        depth += (reader.kinds[index] in _OPENING) - (reader.kinds[index] in _CLOSING)
        if depth < 0:
            return True
        index += 1
    return False


def _quoted(reader: Cursor, index: int) -> int:
    """Returns the index of the quote that closes the one at ``index`` on the same
    line, else ``index``.
    """
    closing = index + 1
    while reader.kinds[closing] != "end" and not reader.on_new_line(closing):
        if reader.texts[closing] == reader.texts[index]:
            return closing
        closing += 1
    return index
