"""A file that was read, `File`: its text, and how messages call it."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["File"]


class File(NamedTuple):
    """A file that was read: its text, its name for messages, its path (None: standard input)."""

    text: str
    shown: str
    path: str | None
