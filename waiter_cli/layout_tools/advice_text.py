"""Advice → what a person is told: remarks of a kind in one, a mend said once. Entry point `told`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from waiter_cli.errors import Fault
from waiter_cli.layout_tools.advice import Advice, islands
from waiter_cli.model.wording import in_words

if TYPE_CHECKING:
    from collections.abc import Hashable

    from waiter_cli.model.layout import Layout

__all__ = ["told", "told_warnings"]


MANY = 8
"""More remarks of a kind than these are summed up."""
_SUMMED = {
    "bottleneck": "{} nodes are bottlenecks, without which others are cut off: {}",
    "edge_through_furniture": "{} edges run through furniture: {}",
    "tables_overlap": "{} tables stand in the same place as something else: {}",
    "seats_do_not_fit": "{} tables have more seats than there is room for: {}",
    "timetable": "{} moves of the timetable lead through somebody: those of {}",
}


def told(found: Sequence[Advice], *, everything: bool = False) -> list[Fault]:
    """Returns the remarks, in the order of the file.

    Where there are many of a kind one says how many, with the first three names, unless
    ``everything`` is wanted.  A dead end is not called unused as well.  Where several things have the same fault, one remark
    names them all, each but the first with its line and column.  A mend stands after the last of
    the remarks that it is for.
    """
    ends = {one.fault.where for one in found if one.kind == "dead_end"}
    groups: dict[Hashable, list[Advice]] = {}
    for number, one in enumerate(found):
        if one.kind != "unused_node" or one.fault.where not in ends:
            groups.setdefault(one.several or number, []).append(one)
    if not everything:
        groups = _summed_up(groups)
    faults = [_together(group, everything) for group in groups.values()]
    return [
        replace(fault, hint=None) if fault.hint == then.hint else fault
        for fault, then in zip(faults, faults[1:], strict=False)
    ] + faults[-1:]


def told_warnings(layout: Layout) -> list[Fault]:
    """Returns the warnings for a person about a layout before anything is planned in it."""
    return told(tuple(islands(layout)))


def _summed_up(groups: dict[Hashable, list[Advice]]) -> dict[Hashable, list[Advice]]:
    """Returns the groups, remarks of one kind that are too many put into one."""
    number = Counter(group[0].kind for group in groups.values() if not group[0].several)
    summed: dict[Hashable, list[Advice]] = {}
    for key, group in groups.items():
        kind = group[0].kind
        many = not group[0].several and number[kind] > MANY and kind in _SUMMED
        summed.setdefault(kind if many else key, []).extend(group)
    return summed


def _together(group: list[Advice], everything: bool) -> Fault:
    """Returns one remark for several of a kind, in the place of the first."""
    first, *others = group
    if not others:
        return first.fault
    if len(group) > MANY and not everything:
        names = [*dict.fromkeys(one.about for one in group)]
        more = [f"{len(names) - 3} more"] if len(names) > 3 else []
        some = in_words([*names[:3], *more])
        if not first.several:
            return replace(first.fault, message=_SUMMED[first.kind].format(len(names), some))
        return replace(first.fault, message=first.several.format(some))
    names = [first.about]
    for other in others:
        where = other.fault.where
        place = f" ({where.line}:{where.column})" if where is not None and where.line else ""
        names.append(f"{other.about}{place}")
    return replace(first.fault, message=first.several.format(in_words(names)))
