"""Recognises slips of people who know another language: a faulty statement → the
fault that is meant.

The parser stops where it cannot go on; the slip is often elsewhere.  ``r(X) <- q(X).`` fails as
a comparison, and an arrow is what was meant.  :func:`meant` looks at the whole statement.
"""

from __future__ import annotations

import re

from sparc.errors import Edit, SourceError, SparcSyntaxError
from sparc.source import Span
from sparc.syntax.cursor import QUANTIFIER_MEND, QUANTIFIERS, RELATIONS, Cursor
from sparc.syntax.literal_parser import AGGREGATES
from sparc.syntax.recovery import begins_line, behind_fault, statement_end

__all__ = ["meant", "recover"]

_ARROW = re.compile(
    r":[ \t]*-|:[ \t]*[\u2010-\u2015\u2212]|<[-\u2010-\u2015\u2212]+|<==?|:=|[\u2190\u21d0\u27f5]"
)
_FORWARD = re.compile(r"[-=\u2010-\u2015\u2212]{1,2}>|[\u2192\u21d2\u27f6]")
_WORDS = ("if", "when", "because")
_NEGATIONS = ("neg", "non", "no", "never")
_CLOSING = {"(": ")", "[": "]", "{": "}"}
_PLAIN = {"identifier", "-", "|", "("}


def recover(reader: Cursor, error: SourceError, first: int) -> None:
    """Keeps the fault of the statement that begins with the token ``first``, and
    moves on to the next statement.

    Raises :class:`SourceErrors` when there are ``MAX_FAULTS``.
    """
    fault, following = meant(reader, first, error)
    if first != reader.reported:
        reader.keep(fault)
    reader.at = behind_fault(reader, first, reader.at) if following is None else following


def meant(reader: Cursor, first: int, error: SourceError) -> tuple[SourceError, int | None]:
    """Returns the fault to report about the statement that begins with the token ``first``.

    Also the index at which the next statement begins, where that is known.
    """
    comma = _comma_for_dot(reader, first)
    if comma is not None:
        fault = reader.fault(
            'expected ".", found ","', comma, 'every statement ends with "."; the next begins below'
        )
        return reader.renamed(fault, comma, "."), comma + 1
    minus = _dot_before_minus(reader, first)
    if minus is not None:
        return reader.missing_dot('expected "." before "-"', minus - 1), minus
    known = _arrow(reader, first, error) or _quantifier(reader, first) or _logic(reader, first)
    known = known or _name(reader, first) or _label(reader, first) or _capital(reader, first)
    known = known or _aggregate(reader, first)
    known = known or _open_brace(reader, first) or _closed_twice(reader, first, error)
    return known or _open_bracket(reader, first, error) or error, None


def _name(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that a statement begins with a word of another language."""
    word, following = reader.texts[first], reader.kinds[first + 1]
    if word in _NEGATIONS and following == "identifier" and not reader.on_new_line(first + 1):
        mend = f'write "-{reader.texts[first + 1]}", the sign touching the atom'
        return reader.fault(f'"{word}" has no meaning in SPARC', first, mend)
    if word in _WORDS and following == "identifier" and not reader.on_new_line(first + 1):
        mend = 'write ":-", with the conclusion first: q :- p'
        return reader.fault(f'"{word}" has no meaning in SPARC', first, mend)
    return None


def _label(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that no colon stands behind the label of a consistency-restoring rule."""
    if reader.kinds[first] != "identifier" or reader.kinds[first + 1] != "identifier":
        return None
    if (
        reader.at != first + 1
        or ":+" not in reader.kinds[first : statement_end(reader, first, first)]
    ):
        return None
    label, head = reader.texts[first : first + 2]
    mend = f'a label has ":" behind it: {label} : {head}'
    return reader.fault(f'expected ":" behind "{label}"', first + 1, mend)


def _aggregate(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that an aggregate has round brackets."""
    for index in range(first, min(reader.at, statement_end(reader, first, reader.at))):
        if reader.texts[index] in AGGREGATES and reader.kinds[index + 1] == "(":
            word = reader.texts[index]
            mend = f"an aggregate has braces: {word}{{X : p(X)}}"
            return reader.fault('expected "{", found "("', index + 1, mend)
    return None


def _closed_twice(reader: Cursor, first: int, error: SourceError) -> SourceError | None:
    """Returns the fault that a bracket closes where none is open, with the mend."""
    at = reader.at
    closing = reader.kinds[at]
    if error.hint is not None or closing not in _CLOSING.values() or error.span is None:
        return None
    opening = next(sign for sign, its in _CLOSING.items() if its == closing)
    before = reader.kinds[first:at]
    if error.span.start != reader.starts[at] or before.count(opening) > before.count(closing):
        return None
    error.hint = f'no bracket is open here: leave out "{closing}"'
    error.edit = Edit(reader.starts[at], reader.end(at), "")
    return error


def _capital(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that a predicate, or a record, where reading stopped is in upper case."""
    at = reader.at
    for index in (at, at - 1, at + 1 if reader.kinds[at] == "-" else at):
        if index < first or reader.kinds[index] != "variable" or reader.kinds[index + 1] != "(":
            continue
        word = reader.texts[index]
        if word == "_" or not reader.touches_next(index):
            continue
        small = word[0].lower() + word[1:]
        inside = sum(reader.kinds[first:index].count(sign) for sign in "([")
        inside -= sum(reader.kinds[first:index].count(sign) for sign in ")]")
        record = inside > 0 or reader.kinds[first + 1] == "="
        what, kind = ("a term", "records") if record else ("an atom", "predicates")
        mend = f"names of {kind} begin with a lower-case letter: {small}"
        return reader.renamed(
            reader.fault(f'expected {what}, found "{word}"', index, mend), index, small
        )
    return None


def _open_brace(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that no ``}`` stands before the comparison of a choice or an aggregate.

    As in ``#count{X : p(X) > 2.``, where the comparison could be a literal of the condition.
    """
    opened: list[int] = []
    begins = closing = first
    for index in range(first, statement_end(reader, first, first)):
        kind = reader.kinds[index]
        if kind in _CLOSING:
            opened.append(index)
            if kind == "{":
                begins = closing = index + 1
        elif kind in _CLOSING.values():
            if not opened or _CLOSING[reader.kinds[opened.pop()]] != kind:
                return None
        elif kind in (",", ";", ":") and _innermost(reader, opened) == "{":
            begins = index + 1
        elif kind in RELATIONS and _innermost(reader, opened) == "{":
            literal = reader.kinds[begins:index]
            is_atom = literal[:1] in (["identifier"], ["not"], ["-"])
            if is_atom or not set(RELATIONS).isdisjoint(literal):
                closing = index
    if _innermost(reader, opened) != "{" or closing <= opened[-1] or reader.at < opened[-1]:
        return None
    if reader.kinds[closing] not in RELATIONS:
        return None
    end = reader.end(closing - 1)
    message = f'expected "}}" before "{reader.texts[closing]}"'
    fault = SparcSyntaxError(message, Span(reader.source, end, end), 'close the bracket: "}"')
    fault.edit = Edit(end, end, "}")
    return fault


def _innermost(reader: Cursor, opened: list[int]) -> str:
    """Returns the bracket that was opened last."""
    return reader.kinds[opened[-1]] if opened else ""


def _open_bracket(reader: Cursor, first: int, error: SourceError) -> SourceError | None:
    """Returns the fault that a statement ends inside of brackets, with the bracket
    that closes them.
    """
    if error.hint is not None or error.span is None or reader.kinds[reader.at] not in (".", "end"):
        return None
    if error.span.start != reader.starts[reader.at]:
        return None
    depth: list[str] = []
    for index in range(first, reader.at):
        if reader.kinds[index] in _CLOSING:
            depth.append(_CLOSING[reader.kinds[index]])
        elif depth and reader.kinds[index] == depth[-1]:
            depth.pop()
    if not depth:
        return None
    error.hint = f'close the bracket: "{depth[-1]}"'
    return error


def _comma_for_dot(reader: Cursor, first: int) -> int | None:
    """Returns the index of a comma at the end of a line behind which another statement begins."""
    at = reader.at
    margin = reader.column(first)
    if reader.kinds[at] == ",":
        return at if begins_line(reader, at + 1, margin) else None
    if reader.kinds[at] not in (":-", ":+"):
        return None
    for index in range(at, first, -1):
        if reader.on_new_line(index):
            found = reader.kinds[index - 1] == "," and begins_line(reader, index, margin)
            return index - 1 if found else None
    return None


def _dot_before_minus(reader: Cursor, first: int) -> int | None:
    """Returns the index of a ``-`` that begins a statement, and was read as one between two terms."""
    for index in range(reader.at, first, -1):
        if (
            reader.kinds[index] == "-"
            and begins_line(reader, index, reader.column(first))
            and reader.touches_next(index)
            and reader.kinds[index - 1] in ("identifier", "variable", "number", ")", "}")
        ):
            return index
    return None


def _arrow(reader: Cursor, first: int, error: SourceError) -> SourceError | None:
    """Returns the fault that another sign stands for ``:-``."""
    fault_at = error.span.start if error.span is not None else 0
    depth = 0
    front: list[str] = []  # the kinds of the tokens before the arrow, outside of brackets
    arrow: tuple[int, int, bool] | None = None
    for index in range(first, statement_end(reader, first, first)):
        kind, start = reader.kinds[index], reader.starts[index]
        depth -= kind in (")", "]", "}")
        if depth == 0 and kind in (":-", ":+"):
            return None
        if depth == 0 and arrow is None and kind not in (")", "]", "}"):
            arrow = _arrow_at(reader, index, front)
            front.append(kind)
        elif start == fault_at and arrow is None:
            return None  # a fault of its own, in front of an arrow
        depth += kind in ("(", "[", "{")
    if arrow is None:
        return None
    start, stop, forward = arrow
    mend = 'write ":-"' + (", with the conclusion first: q :- p" if forward else "")
    text = reader.source.text[start:stop]
    return SparcSyntaxError(
        f'expected ":-", found "{text}"', Span(reader.source, start, stop), mend
    )


def _arrow_at(reader: Cursor, index: int, front: list[str]) -> tuple[int, int, bool] | None:
    """Returns the places where an arrow begins and ends, and whether it points forward.

    None: no arrow.
    """
    start, text = reader.starts[index], reader.source.text
    if reader.texts[index] in _WORDS and front:
        return (start, start + len(reader.texts[index]), False) if _is_head(front) else None
    forward = _FORWARD.match(text, start)
    match = forward or _ARROW.match(text, start)
    if match is None:
        return None
    relation = match[0] in ("<=", "=>")  # these may stand before or behind the bound of a choice
    if relation and ("{" in front or text[match.end() :].lstrip(" \t")[:1] == "{"):
        return None
    if forward and not (front and _is_head([kind for kind in front if kind not in (",", "not")])):
        return None
    return (start, match.end(), forward is not None) if forward or _is_head(front) else None


def _is_head(front: list[str]) -> bool:
    """Returns whether tokens may be the head of a rule, by their kinds outside of brackets."""
    if "{" in front:
        return front[0] in ("{", "number", "variable", "identifier")
    return not front or (front[0] in ("identifier", "-") and set(front) <= _PLAIN)


def _quantifier(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that a statement of logic stands for a rule."""
    for index in range(first, statement_end(reader, first, reader.at)):
        if reader.texts[index] in QUANTIFIERS and reader.kinds[index + 1] in (
            "(",
            "variable",
            "identifier",
        ):
            word = reader.texts[index]
            return reader.fault(f'"{word}" has no meaning in SPARC', index, QUANTIFIER_MEND)
    return None


def _logic(reader: Cursor, first: int) -> SourceError | None:
    """Returns the fault that ``/\\`` or ``\\/`` stands between literals."""
    text = reader.source.text
    for index in range(first, statement_end(reader, first, reader.at)):
        start = reader.starts[index]
        word = text[start : start + 2]
        if word in ("/\\", "\\/"):
            mend = "write a comma between literals" if word == "/\\" else 'write "|" in a head'
            span = Span(reader.source, start, start + 2)
            return SparcSyntaxError(f'"{word}" has no meaning in SPARC', span, mend)
    return None
