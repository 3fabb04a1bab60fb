"""Suggests the nearest known name for one that is unknown."""

from __future__ import annotations

from collections.abc import Iterable

__all__ = ["did_you_mean"]


def did_you_mean(name: str, known: Iterable[str], kind: str = "") -> str | None:
    """A hint for an unknown name: the closest known one, or which there are; None if none."""
    import difflib

    unordered = isinstance(known, set | frozenset)
    names = sorted(known) if unordered else list(dict.fromkeys(known))
    close = difflib.get_close_matches(name[:60], names[:2000], n=1, cutoff=0.6)
    if close:
        return f"did you mean {close[0]}?"
    if not names:
        return f"there is no {kind}" if kind else None
    listed = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
    return f"known: {listed}"
