"""Suggests the nearest known name for one that is unknown."""

from __future__ import annotations

from collections.abc import Iterable

from sparc.spelling import nearest

__all__ = ["did_you_mean", "suggest"]


def suggest(name: str, known: Iterable[str]) -> str | None:
    """Returns the known name that is closest to ``name``; None where none is close.

    >>> suggest("tabel1", ["table1", "bar"])
    'table1'
    """
    return nearest(name[:60], _in_order(known)[:2000])


def did_you_mean(
    name: str, known: Iterable[str], kind: str = "", listed: str = "known"
) -> str | None:
    """Returns a hint for an unknown name: the closest known one, or which are ``listed``.

    None if none.
    """
    names = _in_order(known)
    close = suggest(name, names)
    if close is not None:
        return f"did you mean {close}?"
    if not names:
        return f"there is no {kind}" if kind else None
    return f"{listed}: {', '.join(names[:8])}{', …' if len(names) > 8 else ''}"


def _in_order(known: Iterable[str]) -> list[str]:
    unordered = isinstance(known, set | frozenset)
    return sorted(known) if unordered else list(dict.fromkeys(known))
