"""Reads the marks of a template: one line of text → `Mark`. Entry point `mark_of`.

A mark is a comment line of a SPARC program, alone on its line::

    %{ nodes    begins a slot        %}    ends it
    %? bar      begins a part        %.    ends it
"""

from __future__ import annotations

from enum import Enum

from sparc.lazy_dataclass import dataclass

__all__ = ["Mark", "MarkKind", "mark_of"]


class MarkKind(Enum):
    """The kinds of marks in a template."""

    SLOT = "%{"
    SLOT_END = "%}"
    PART = "%?"
    PART_END = "%."


@dataclass(frozen=True)
class Mark:
    """A mark; ``name`` is that of the slot or part it begins, empty where it ends one."""

    kind: MarkKind
    name: str = ""


def mark_of(line: str) -> Mark | None:
    """Returns the mark that a line is, None for any other line.

    >>> mark_of("  %{ nodes")
    Mark(kind=<MarkKind.SLOT: '%{'>, name='nodes')
    >>> mark_of("p(a).  %}") is None
    True
    """
    bare = line.strip()
    for kind in (MarkKind.SLOT, MarkKind.PART):
        if bare.startswith(kind.value):
            return Mark(kind, bare[2:].strip())
    for kind in (MarkKind.SLOT_END, MarkKind.PART_END):
        if bare == kind.value:
            return Mark(kind)
    return None
