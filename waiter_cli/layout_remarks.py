"""Advice → what a person is told: remarks of a kind in one, a mend said once. Entry point `told`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from waiter_cli.exits import Fault
from waiter_cli.layout_advice import Advice, in_words, islands

if TYPE_CHECKING:
    from collections.abc import Hashable

    from waiter_cli.layout import Layout

__all__ = ["told", "told_warnings"]


def told(found: Sequence[Advice]) -> list[Fault]:
    """The remarks, in the order of the file.

    A dead end is not called unused as well.  Where several things have the same fault, one remark
    names them all, each but the first with its line and column.  A mend stands after the last of
    the remarks that it is for.
    """
    ends = {one.fault.where for one in found if one.kind == "dead_end"}
    groups: dict[Hashable, list[Advice]] = {}
    for number, one in enumerate(found):
        if one.kind != "unused_node" or one.fault.where not in ends:
            groups.setdefault(one.several or number, []).append(one)
    faults = [_together(group) for group in groups.values()]
    return [
        replace(fault, hint=None) if fault.hint == then.hint else fault
        for fault, then in zip(faults, faults[1:], strict=False)
    ] + faults[-1:]


def told_warnings(layout: Layout) -> list[Fault]:
    """What a person is told of a layout before anything is planned in it."""
    return told(tuple(islands(layout)))


def _together(group: list[Advice]) -> Fault:
    """One remark for several of a kind, in the place of the first."""
    first, *others = group
    if not others:
        return first.fault
    names = [first.about]
    for other in others:
        where = other.fault.where
        place = f" ({where.line}:{where.column})" if where is not None and where.line else ""
        names.append(f"{other.about}{place}")
    return replace(first.fault, message=first.several.format(in_words(names)))
