"""Text → a number, as options and files write it: decimal digits, finite, of a sane size.

Entry points `whole` and `decimal`; both answer None for what is no such number: ``nan``, ``inf``,
``0x10``, ``1_000``, digits of other scripts, blanks, the empty text, and what is too large.

>>> [whole(text) for text in ("12", "-3", "+4", "1_0", "0x10", "", "²", "99999999999")]
[12, -3, 4, None, None, None, None, None]
>>> [decimal(text) for text in ("2", "0.5", ".5", "1e3", "nan", "inf", "0x1p3", "1e400", "1_0")]
[2.0, 0.5, 0.5, 1000.0, None, None, None, None, None]
"""

from __future__ import annotations

__all__ = ["MOST", "decimal", "whole"]

MOST = 2**31 - 1
"""The largest number of an option: clingo counts with 32 bits, and 68 years of seconds are enough."""

_DIGITS = frozenset("0123456789")
_DECIMAL = frozenset("0123456789.eE+-")
_LONGEST = 60


def whole(text: str, most: int = MOST) -> int | None:
    """Returns the whole number that ``text`` is, from -``most`` to ``most``.

    None for anything else.
    """
    digits = text[1:] if text[:1] in ("+", "-") else text
    if not digits or len(digits) > _LONGEST or not _DIGITS.issuperset(digits):
        return None
    value = int(text)
    return value if -most <= value <= most else None


def decimal(text: str, most: float = MOST) -> float | None:
    """Returns the decimal number that ``text`` is, from -``most`` to ``most``.

    None for anything else.
    """
    body = text[1:] if text[:1] in ("+", "-") else text
    if body[:1] not in _DIGITS and body[:1] != ".":
        return None
    if len(body) > _LONGEST or not _DECIMAL.issuperset(body):
        return None
    try:
        value = float(text)
    except ValueError:
        return None
    return value if -most <= value <= most else None
