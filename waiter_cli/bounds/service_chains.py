"""Lists what must happen to one plate or jug before wishes about it hold: `Problem`, table → links.

A table's order with its plate, and each of its refillable objects, is a little machine of its own:
a few marks (`MARKS`) that actions set and clear.  `course` finds a shortest way through it, and
which deeds occur in that order in *every* way through it: only these may count in a lower bound.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import State

__all__ = [
    "BAR_LINKS",
    "CARRIED",
    "HAND_LINKS",
    "Link",
    "course",
    "marks_of",
    "wish",
]
EAGER, HELD, SENT, SERVED, READY, CARRIED, EMPTY = (1 << k for k in range(7))
BAR_LINKS = frozenset(("send_order", "take_up", "fill"))
HAND_LINKS = frozenset(("take_up", "refill"))


@dataclass(frozen=True)
class Link:
    """Something to be done at one of some nodes: an action by its name, or only to be there.

    ``fill`` (to be at the bar with something empty) and ``visit`` (to be at ``node``) are no
    actions and take no step; ``number`` is the number of chairs.
    """

    name: str
    table: str = ""
    item: str = ""
    number: int = 0
    node: str = ""

    @property
    def is_deed(self) -> bool:
        """Returns whether this takes a step of its own."""
        return self.name not in ("fill", "visit")


def marks_of(state: State, table: str, item: str) -> int:
    """Returns the marks of the order and plate of a table, or of one of its refillable objects."""
    thing = (table, item)
    marks = READY * (thing in state.ready) | CARRIED * (thing == state.carrying)
    marks |= EMPTY * (thing in state.empty)
    if item == "plate":
        marks |= EAGER * (table in state.ready_to_order) | HELD * (table in state.ordered)
        marks |= SENT * (table in state.sent) | SERVED * (table in state.served)
    return marks


def wish(kind: str, item: str, whole_order: bool) -> Callable[[int], bool]:
    """Returns the test of marks for a goal of that kind; ``serve`` stands for a table left content."""
    away = READY | CARRIED
    if kind == "ordered":
        return lambda marks: bool(marks & (HELD | SENT))
    if kind == "sent":
        return lambda marks: bool(marks & SENT)
    if kind == "filled":
        return lambda marks: not marks & (CARRIED | EMPTY)
    if kind == "served" and item == "plate":
        bad = away | (HELD if whole_order else 0)
        return lambda marks: bool(marks & SERVED) and not marks & bad
    if kind == "serve":
        return lambda marks: not marks & (away | EMPTY | EAGER | HELD)
    return lambda marks: not marks & (away | EMPTY)


def _moves(problem: Problem, item: str, marks: int) -> Iterator[tuple[str, int]]:
    layout = problem.layout
    if layout.bar is None:
        return
    exists = item in layout.objects
    if item == "plate":
        if marks & EAGER:
            yield "take_order", marks & ~(EAGER | SENT | SERVED) | HELD
        if marks & HELD:
            cooked = READY if problem.instant_kitchen and exists else 0
            yield "send_order", marks & ~HELD | SENT | cooked
    elif marks & EMPTY and not marks & CARRIED and exists:
        yield "refill", marks | CARRIED
    if not exists:
        return
    if marks & READY and not marks & CARRIED:
        after = marks & ~READY | CARRIED
        yield "take_up", after & ~EMPTY if item in REFILLABLES else after
    if marks & CARRIED:
        if marks & EMPTY:
            if item in REFILLABLES:
                yield "fill", marks & ~EMPTY
        else:
            after = marks & ~CARRIED
            yield "bring", after | SERVED if item == "plate" else after


def course(
    problem: Problem, marks: int, table: str, item: str, test: Callable[[int], bool]
) -> tuple[tuple[Link, ...], tuple[Link, ...]] | None:
    """Returns the certain and all the links of a shortest way to marks that pass ``test``.

    None when no way leads there.  The certain ones occur, in their order, whatever is done.
    """
    came: dict[int, tuple[int, str]] = {marks: (-1, "")}
    queue, goal = [marks], -1
    for here in queue:
        if test(here):
            goal = here
            break
        for name, after in _moves(problem, item, here):
            if after not in came:
                came[after] = (here, name)
                queue.append(after)
    if goal < 0:
        return None
    names: list[str] = []
    while came[goal][1]:
        goal, name = came[goal]
        names.append(name)
    names.reverse()
    sure = _certain(problem, marks, item, test, names)
    links = [Link(name, table, item if name not in _WHOLE else "") for name in names]
    return tuple(link for link, kept in zip(links, sure) if kept), tuple(links)


_WHOLE = ("take_order", "send_order")


def _certain(
    problem: Problem, marks: int, item: str, test: Callable[[int], bool], names: list[str]
) -> list[bool]:
    """Returns which of ``names`` are kept so that all of these occur in their order on every way."""
    kept = [True] * len(names)
    while True:
        chain = [name for name, keep in zip(names, kept) if keep]
        seen, queue, short = {(marks, 0)}, [(marks, 0)], len(chain)
        for here, done in queue:
            if done < short and test(here):
                short = done
            for name, after in _moves(problem, item, here):
                on = done + (done < len(chain) and name == chain[done])
                if (after, on) not in seen:
                    seen.add((after, on))
                    queue.append((after, on))
        if short == len(chain):
            return kept
        kept[[place for place, keep in enumerate(kept) if keep][short]] = False
