"""Finds numbers of a program that are above its ``#maxint``: parts of the tree → faults, with `NumberLimit`.

Numbers of one digit are never too large; nor is the number of a ``#maxint`` itself, the last of
which counts.
"""

from __future__ import annotations

import re

from sparc.errors import SortError
from sparc.source import Span
from sparc.syntax.tree import ConstDirective, Number, Program

__all__ = ["NumberLimit"]

_PLACES = ("span", "name_span", "label_span", "source")


class NumberLimit:
    """The greatest number that a program may have.

    Its text is looked through once: nearly always no number in it is too large, and the tree need
    not be searched.
    """

    def __init__(self, program: Program, maxint: int) -> None:
        self.maxint = maxint
        source = program.source
        self._may_exceed = source is None or _has_number_above(source.text, maxint)
        self._own = {
            id(directive.value)
            for directive in program.directives
            if not isinstance(directive, ConstDirective) and isinstance(directive.value, Number)
        }

    def faults(self, part: object) -> list[SortError]:
        """Returns a fault for each number in a part of the tree that is too large."""
        if not self._may_exceed:
            return []
        return [
            SortError(
                f"the number {number.value} is above #maxint, which is {self.maxint}",
                number.span,
                f"write #maxint = {number.value}. (or more) as the first line",
            )
            for number in _numbers(part)
            if number.value > max(self.maxint, 9) and id(number) not in self._own
        ]


def _has_number_above(text: str, limit: int) -> bool:
    """Returns whether a number above ``limit`` stands in the text outside of comments."""
    for match in re.finditer(r"(?<![A-Za-z0-9_])[0-9]{2,}", text):
        if int(match[0]) > limit:
            line = text.rfind("\n", 0, match.start()) + 1
            if "%" not in text[line : match.start()]:
                return True
    return False


def _numbers(root: object) -> list[Number]:
    """Returns every number of a tree."""
    numbers: list[Number] = []
    stack: list[object] = [root]
    while stack:
        node = stack.pop()
        if isinstance(node, Number):
            numbers.append(node)
        elif isinstance(node, tuple):
            stack.extend(node)
        elif hasattr(node, "__dataclass_fields__") and not isinstance(node, Span):
            stack.extend(
                getattr(node, name) for name in node.__dataclass_fields__ if name not in _PLACES
            )
    return numbers
