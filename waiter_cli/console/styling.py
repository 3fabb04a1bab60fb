"""Styles text with colour and weight in a way that nothing from outside can imitate.

`styled` puts marks about a text that only this process knows; `printable` escapes all but these,
and makes them what a terminal obeys.  Colour appears on a terminal only, and never with
``NO_COLOR``.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable
from typing import Any

from sparc.escaping import escaped

__all__ = ["between_marks", "printable", "styled", "unmarked", "visible"]

_CODES = {
    "red": "31",
    "green": "32",
    "yellow": "33",
    "blue": "34",
    "cyan": "36",
    "bold": "1",
    "dim": "2",
}
_SECRET = os.urandom(4).hex()
_MARK = rf"(\x1b{_SECRET}\[[0-9;]*m)"


def _wants_colour(stream: Any) -> bool:
    return (
        bool(stream.isatty())
        and not os.environ.get("NO_COLOR")
        and os.environ.get("TERM") != "dumb"
    )


def styled(text: str, style: str, stream: Any = None) -> str:
    """Marks ``text`` for a style (``red``, ``bold``, …) where ``stream`` (stdout) takes colour.

    What is marked is to be shown by way of `printable`, as `output` does it.
    """
    if not _wants_colour(sys.stdout if stream is None else stream):
        return text
    begin = ";".join(_CODES[word] for word in style.split())
    return f"\x1b{_SECRET}[{begin}m{text}\x1b{_SECRET}[0m"


def between_marks(text: str, change: Callable[[str], str]) -> str:
    """Returns the text with ``change`` applied to all of it but the marks of `styled`."""
    if "\x1b" not in text:
        return change(text)
    parts = re.split(_MARK, text)
    return "".join(part if i % 2 else change(part) for i, part in enumerate(parts))


def visible(text: str) -> str:
    """Returns the text escaped, its marks kept, so that it can be measured and broken into lines."""
    return between_marks(text, escaped)


def unmarked(text: str) -> str:
    """Returns the text without the marks of `styled`."""
    return re.sub(_MARK, "", text) if "\x1b" in text else text


def printable(text: str) -> str:
    """Returns the text for a terminal: escaped, the marks of `styled` as escape sequences."""
    seen = visible(text)
    return seen.replace(f"\x1b{_SECRET}", "\x1b") if "\x1b" in seen else seen
