"""Escapes text from outside for a terminal: what would command it, or hide, becomes a code.

Entry points `escaped`, and `on_one_line` for what must not begin a line of its own, such as a name.

>>> print(escaped("\\x1b[31m, \\x9b1m, \\u202e, caf\\u00e9"))
\\x1b[31m, \\x9b1m, \\u202e, caf\u00e9
"""

from __future__ import annotations

import re

__all__ = ["UNSAFE", "decoded", "escaped", "on_one_line"]

UNSAFE = (
    "[\x00-\x08\x0b-\x1f\x7f-\x9f"  # C0 but for the tab and the line end, DEL and C1
    "\xad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb"
    "\ud800-\udfff\U000e0000-\U000e007f]"
)
"""Control characters, marks of direction, characters of no width, and lone surrogates: a class of `re`."""


def decoded(text: str) -> str:
    """Returns text in which the bytes of a file's name are the characters that they mean in UTF-8."""
    try:
        return text.encode("utf-8", "surrogateescape").decode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return text


def escaped(text: str) -> str:
    """Returns the text with each character of `UNSAFE` as its code in Python; line ends and tabs stay."""
    if text.replace("\n", "").isprintable():  # nothing unsafe is: most texts need no expression
        return text
    return re.sub(UNSAFE, _code, decoded(text))


def on_one_line(text: str) -> str:
    """Returns the text as `escaped` does, with line ends and tabs as codes, too.

    >>> on_one_line("a\\nb")
    'a\\\\nb'
    """
    return escaped(text).replace("\n", "\\n").replace("\t", "\\t")


def _code(found: re.Match[str]) -> str:
    sign = found[0]
    return repr(sign)[1:-1] if sign < "\x80" else sign.encode("ascii", "backslashreplace").decode()
