"""Tidies a plan: `Problem`, a plan → a plan of the same length that people would call sensible.

Entry point `tidy`.  Of plans of one length some postpone what lies on the way, fetch who came
last first, or give a couple the table for six.  Here a plan is put in order, in steps that each
make it better, by `Draft.worth`, and never longer:

1. a party gets a smaller table, which may lie elsewhere if the walk is no longer for it;
2. who came first is picked up first: parties change places in the plan, with or without tables;
3. a deed is done at an earlier visit, as is a pair of deeds that fills the hands in between.

That ends where none of these is possible, or with the work that is allowed.  What is done to a
plan is judged by the rules in plain Python (`waiter_cli.rules.validator`), one change at a time where the
clock or an order of goals matters, else in the end; a plan that does not pass is not returned.
Nothing here decides what a plan is: that is for the SPARC program to say, which is asked about
the plan that comes out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.planning.draft_plan import Draft, Slots, clash, is_deed

__all__ = ["better", "tidy"]

WORK = 20_000
"""Steps of plans that are looked at, at most; some microseconds each."""


def tidy(problem: Problem, plan: Plan, prefer: tuple[str, ...] = (), work: int = WORK) -> Plan:
    """Returns a plan as long as ``plan`` and as legal, with nothing postponed that lies on the way.

    ``prefer`` are the preferences that the plan fulfils: it goes on to do so as well at least.
    """
    draft = Draft(problem, plan, prefer, work)
    if not any(map(is_deed, draft.slots)):
        return plan
    _improve(draft)
    if not draft.checked and not draft.valid(draft.slots):
        draft = Draft(problem, plan, prefer, work, careful=True)
        _improve(draft)
    return draft.plan()


def better(problem: Problem, plan: Plan, other: Plan, prefer: tuple[str, ...]) -> Plan:
    """Returns the better of two plans of one length; ``plan`` where they are worth the same."""
    first, second = (Draft(problem, each, prefer, WORK).best for each in (plan, other))
    return other if second < first else plan


def _improve(draft: Draft) -> None:
    """Makes the draft better until nothing helps."""
    from waiter_cli.planning.table_exchange import exchanges, smaller_tables, wider_exchanges

    while draft.left > 0:
        changed = _exhaust(draft, smaller_tables)
        changed |= _exhaust(draft, exchanges)
        changed |= _exhaust(draft, wider_exchanges)
        changed |= _hurry(draft)
        if not changed:
            return


def _exhaust(draft: Draft, neighbours: Callable[[Draft], Iterator[tuple[Slots, bool]]]) -> bool:
    """Takes the first of ``neighbours`` that is better, again and again; whether there was one."""
    changed = False
    while draft.left > 0:
        if not any(draft.take(slots, sure) for slots, sure in neighbours(draft)):
            return changed
        changed = True
    return changed


# -- deeds at an earlier visit ----------------------------------------------------------------


def _hurry(draft: Draft) -> bool:
    """Does what can be done at an earlier visit there; whether there was something."""
    changed = again = False
    j = 0
    while j < len(draft.slots) and draft.left > 0:
        if is_deed(draft.slots[j]):
            for slots in _earlier(draft, j):
                if draft.take(slots, sure=True):
                    changed = True
                    break
            else:
                again |= any(draft.take(slots, sure=False) for slots in _earlier_pair(draft, j))
        j += 1
    return changed or again


def _earlier(draft: Draft, j: int) -> Iterator[Slots]:
    """Yields the slots with the deed at step ``j`` done before, at the earliest visit first."""
    slots, where = draft.slots, draft.where
    deed = slots[j]
    assert deed is not None
    allowed = draft.places(deed)
    low = j
    while low > 0:
        other = slots[low - 1]
        if other is not None and is_deed(other) and clash(deed, other, draft.instant):
            break
        low -= 1
    low = max(low, draft.filled_from(slots, where, j))
    spots = [k for k in range(low, j) if where[k] in allowed]
    visits = {k: _visit(slots, k) for k in spots}
    for k in sorted(spots, key=lambda k: (visits[k], -k)):
        if visits[k] == visits[j] if j in visits else all(map(is_deed, slots[k:j])):
            continue
        for gap in (*(g for g in range(k, j) if slots[g] is None), j):
            out = list(slots)
            out[j] = None
            del out[gap]
            out.insert(k, deed)
            yield out


def _visit(slots: Slots, k: int) -> int:
    """Returns the step since which the robot has been where it is at step ``k``."""
    while k > 0 and is_deed(slots[k - 1]):
        k -= 1
    return k


def _earlier_pair(draft: Draft, j: int) -> Iterator[Slots]:
    """Yields the slots with the deed at ``j`` and the one that ends what it begins done before.

    Both go where hands are free, or nobody follows, from the one to the other.
    """
    first = draft.slots[j]
    assert first is not None
    if first.name not in ("pick", "take_up", "refill"):
        return
    end = next((k for k in range(j + 1, len(draft.slots)) if _ends(draft, k, j)), None)
    if end is None:
        return
    second = draft.slots[end]
    assert second is not None
    rest = [slot for k, slot in enumerate(draft.slots) if k not in (j, end)]
    where = draft.walk(rest)
    kind = "lead" if first.name == "pick" else "hands"
    free = draft.free_spells(rest, kind)
    early, late = draft.places(first), draft.places(second)
    deeds = [(k, slot) for k, slot in enumerate(rest) if slot is not None and is_deed(slot)]
    low = [
        max(
            (k + 1 for k, other in deeds if k < until and _waits(draft, deed, other, kind)),
            default=0,
        )
        for deed, until in ((first, j), (second, end - 1))
    ]
    for start, stop in free:
        if start >= j:
            return
        a = next((k for k in range(max(start, low[0]), stop + 1) if where[k] in early), None)
        if a is None:
            continue
        full = a
        if first.name == "refill":
            bar = draft.bar
            full = next((k for k in range(a, stop + 1) if where[k] in bar), stop + 1)
        b = next((k for k in range(max(full, low[1]), stop + 1) if where[k] in late), None)
        if b is not None:
            yield [*rest[:a], first, *rest[a:b], second, *rest[b:]]


def _ends(draft: Draft, k: int, j: int) -> bool:
    """Returns whether the deed at ``k`` ends what the one at ``j`` begins."""
    first, second = draft.slots[j], draft.slots[k]
    if first is None or second is None:
        return False
    if first.name == "pick":
        return second.name == "seat" and second.arguments[1] == first.arguments[1]
    return second.name == "bring" and second.arguments[1:] == first.arguments[1:]


def _waits(draft: Draft, deed: Action, other: Action, kind: str) -> bool:
    """Returns whether ``deed`` cannot come before ``other``, be it for more than hands or a party."""
    return clash(deed, other, draft.instant, leaving_out=kind)
