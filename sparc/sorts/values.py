"""Ground terms in compact form: the elements of sorts.

A number is an ``int``, an identifier a ``str``, and a record a tuple of its name and its
arguments.

>>> text(("f", 1, ("g", "a")))
'f(1,g(a))'
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from sparc.answer_sets import Ground, GroundTerm

__all__ = [
    "Value",
    "as_value",
    "compare",
    "from_ground",
    "is_identifier",
    "spells_value",
    "text",
    "to_ground",
]

Value: TypeAlias = "int | str | tuple[Value, ...]"


def text(value: Value) -> str:
    """Returns a ground term as clingo and SPARC write it."""
    if type(value) is tuple:
        return f"{value[0]}({','.join(map(text, value[1:]))})"
    return str(value)


def to_ground(value: Value) -> Ground:
    """Returns the public form of a ground term."""
    if type(value) is tuple:
        return GroundTerm(str(value[0]), tuple(map(to_ground, value[1:])))
    return value if type(value) is int else GroundTerm(str(value))


def from_ground(term: Ground) -> Value:
    """Returns the compact form of a public ground term."""
    if isinstance(term, int):
        return term
    if term.arguments:
        return (term.name, *map(from_ground, term.arguments))
    return term.name


def compare(left: Value, operator: str, right: Value) -> bool:
    """Returns the result of a comparison in a record's condition.

    Numbers compare as numbers, identifiers by their characters; across kinds, and with records,
    only ``=`` and ``!=`` can hold.
    """
    if operator == "=":
        return left == right
    if operator == "!=":
        return left != right
    if type(left) is int and type(right) is int:
        return _ORDER[operator]((left > right) - (left < right))
    if type(left) is str and type(right) is str:
        return _ORDER[operator]((left > right) - (left < right))
    return False


_ORDER: dict[str, Callable[[int], bool]] = {
    "<": lambda sign: sign < 0,
    "<=": lambda sign: sign <= 0,
    ">": lambda sign: sign > 0,
    ">=": lambda sign: sign >= 0,
}


def as_value(word: str) -> Value:
    """Returns the number or the identifier that a word spells."""
    return int(word) if word.isdigit() else word


def spells_value(word: str) -> bool:
    """Returns whether a word is an identifier or a number without leading zeros."""
    return not word.isdigit() or len(word) == 1 or word[0] != "0"


def is_identifier(word: str) -> bool:
    """Returns whether a word is an identifier of SPARC."""
    return word.isascii() and word.isidentifier() and "a" <= word[0] <= "z"
