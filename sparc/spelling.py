"""Suggests the nearest known names for one that is unknown. Entry points `nearest`, `near`.

This is the one place where names are compared by their letters.
"""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ["likeness", "near", "nearest"]


def nearest(name: str, candidates: Iterable[str], cutoff: float = 0.6) -> str | None:
    """Returns the candidate that ``name`` may be a misspelling of; None where none is close.

    >>> nearest("tabel", ["table", "bar"])
    'table'
    """
    close = near(name, candidates, 1, cutoff)
    return close[0] if close else None


def near(name: str, candidates: Iterable[str], most: int, cutoff: float = 0.6) -> list[str]:
    """Returns at most ``most`` candidates like ``name``, the likest first.

    ``cutoff`` is the least likeness, from 0 to 1.

    >>> near("tabel", ["table", "tables", "bar"], 2)
    ['table', 'tables']
    """
    from difflib import get_close_matches  # costs time to load, and only errors need it

    return get_close_matches(name, list(candidates), most, cutoff)


def likeness(name: str, other: str) -> float:
    """Returns how like two names are, from 0 to 1."""
    from difflib import SequenceMatcher

    return SequenceMatcher(None, name, other).ratio()
