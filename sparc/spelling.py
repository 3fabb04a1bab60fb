"""Suggests the nearest known name for one that is unknown."""

from __future__ import annotations

__all__ = ["nearest"]


def nearest(name: str, candidates: object) -> str | None:
    """Returns the candidate that ``name`` may be a misspelling of."""
    from difflib import get_close_matches  # costs time to load, and only errors need it

    near = get_close_matches(name, list(candidates), 1, 0.6)  # type: ignore[call-overload]
    return near[0] if near else None
