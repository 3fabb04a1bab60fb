"""Scans a changed text: keeps the tokens of the version before, and cuts only the changed lines. Entry point `rescan`.

No token and no comment goes beyond its line, so the lines around a change keep their tokens.

>>> from sparc.syntax.lexer import scan
>>> old, new = Source("x", "p(a).\\nq(b).\\nr."), Source("x", "p(a).\\nq.\\nr.")
>>> tokens = rescan(new, old, scan(old))
>>> tokens.lexemes == scan(new), tokens.front, tokens.back
(True, 5, 10)
"""

from __future__ import annotations

from bisect import bisect_left
from typing import NamedTuple

from sparc.source import Source
from sparc.syntax.lexer import MAX_CHARACTERS, Lexemes, scan

__all__ = ["Rescan", "rescan"]

_ENDS = 4  # tokens of kind ``end``


class Rescan(NamedTuple):
    """The tokens of a new version of a text, and which of the old one's they kept.

    Those with an index below ``front`` are the same; those from ``back`` on are the same, too, and
    have moved by ``moved`` indices.
    """

    lexemes: Lexemes
    front: int
    back: int
    moved: int


def rescan(source: Source, before: Source, known: Lexemes) -> Rescan:
    """Returns the tokens of ``source``, given those ``known`` of the version ``before``.

    Raises `LimitError` as `scan` does.
    """
    old, new = before.text, source.text
    grown = len(new) - len(old)
    same = _common_front(old, new)
    first = new.rfind("\n", 0, same) + 1
    line_end = new.find("\n", len(new) - _common_back(old, new, min(len(old), len(new)) - same))
    end = line_end + 1 if line_end >= 0 else len(new)
    front = bisect_left(known.starts, first)
    back = bisect_left(known.starts, end - grown)
    if len(new) > MAX_CHARACTERS:
        scan(source)  # which says so
    lines = scan(Source(source.name, new[first:end]))
    size = len(lines.kinds) - _ENDS
    lexemes = Lexemes(
        known.kinds[:front] + lines.kinds[:size] + known.kinds[back:],
        known.texts[:front] + lines.texts[:size] + known.texts[back:],
        known.starts[:front]
        + [first + start for start in lines.starts[:size]]
        + [start + grown for start in known.starts[back:]],
    )
    return Rescan(lexemes, front, back, front + size - back)


def _common_front(one: str, other: str) -> int:
    """Returns how many characters two texts have in common at their beginning."""
    low, high = 0, min(len(one), len(other))
    while low < high:  # the first `low` are the same, the first `high` + 1 are not, or too many
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


def _common_back(one: str, other: str, most: int) -> int:
    """Returns how many characters, ``most`` at most, two texts have in common at their end."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if one[len(one) - middle : len(one) - low] == other[len(other) - middle : len(other) - low]:
            low = middle
        else:
            high = middle - 1
    return low
