"""Finds the sort that is wanted at a place of a rule: the argument of a predicate, a sort atom or a record.

Entry point `sort_at`.  Works on tokens, so that it answers while a rule is half written.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import NamedTuple

from sparc.language_server.document import Document
from sparc.sorts.extents import Sort

__all__ = ["sort_at"]

_OPENING = frozenset("([{")
_CLOSING = frozenset(")]}")
_STATEMENT_ENDS = (".", ":-", ":+", ":~", "section")


class _Argument(NamedTuple):
    """The place of an argument: the token of the name in front of its parenthesis, its number from 0."""

    name: int
    number: int


def sort_at(document: Document, offset: int) -> Sort | None:
    """Returns the sort of the argument in which an offset lies; None where that is not known."""
    return _sort(document, bisect_left(document.lexemes.starts, offset))


def _sort(document: Document, token: int) -> Sort | None:
    """Returns the sort wanted where the token of an index stands."""
    place = _argument(document, token)
    if place is None:
        return None
    kinds, texts, starts = document.lexemes
    name = texts[place.name]
    if kinds[place.name] == "sort name":
        return document.declared.sorts.get(name[1:])
    one = document.at(starts[place.name])
    if one is not None and one.kind == "predicate":
        signature = document.declared.predicates.get(name)
        known = signature is not None and place.number < len(signature.sorts)
        return signature.sorts[place.number] if signature is not None and known else None
    whole = _sort(document, place.name)
    return None if whole is None else _of_record(whole, name, place.number)


def _of_record(whole: Sort, name: str, number: int) -> Sort | None:
    """Returns the sort of an argument of the records ``name`` in a sort, where they have one alone."""
    wanted: dict[str, Sort] = {}
    for each, arity in whole.signatures():
        if each == name and number < arity:
            for box in whole.extent.boxes(name, arity) or ():
                sort = box.arguments[number]
                wanted[sort.name] = sort
    return next(iter(wanted.values())) if len(wanted) == 1 else None


def _argument(document: Document, token: int) -> _Argument | None:
    """Returns the innermost argument in which a token lies."""
    kinds = document.lexemes.kinds
    depth = number = 0
    for index in range(token - 1, 0, -1):
        kind = kinds[index]
        if kind in _CLOSING:
            depth += 1
        elif kind in _OPENING and depth:
            depth -= 1
        elif kind in _OPENING:
            named = kind == "(" and kinds[index - 1] in ("identifier", "sort name")
            return _Argument(index - 1, number) if named else None
        elif kind in _STATEMENT_ENDS:
            return None
        elif kind == "," and depth == 0:
            number += 1
    return None
