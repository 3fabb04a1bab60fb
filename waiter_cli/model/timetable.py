"""Gives the places of other waiters at a step, by their timetable.

Entry points `places_at`, `clashes`, `put_off`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

__all__ = ["Clash", "clashes", "places_at", "put_off"]


class Clash(NamedTuple):
    """Two waiters on one node from ``step`` on; ``entry`` is the (waiter, step) that led to it.

    ``entry`` is None where they share the node from the start, without any timetable.
    """

    first: str
    second: str
    node: str
    step: int
    entry: tuple[str, int] | None


def places_at(
    start: Mapping[str, str], timetable: Sequence[tuple[str, int, str]], step: int
) -> dict[str, str]:
    """Returns each waiter's node at a step: the latest entry up to it, else where he started.

    >>> places_at({"w1": "n7", "w2": "n1"}, [("w1", 3, "n4")], 5)
    {'w1': 'n4', 'w2': 'n1'}
    """
    places = dict(start)
    for waiter, since, node in sorted(timetable, key=lambda entry: entry[1]):
        if since <= step:
            places[waiter] = node
    return places


def clashes(
    start: Mapping[str, str], timetable: Sequence[tuple[str, int, str]]
) -> tuple[Clash, ...]:
    """Returns every pair of waiters that would share a node, once for each time it begins.

    Waiters who leave and arrive at one step may follow each other; so a step's entries all hold
    before places are compared.
    """
    clashes: list[Clash] = []
    sharing: set[frozenset[str]] = set()
    by_step: dict[int, list[tuple[str, str]]] = {}
    for waiter, step, node in timetable:
        by_step.setdefault(step, []).append((waiter, node))
    places = dict(start)
    for step in (-1, *sorted(by_step)):
        moved = by_step.get(step, [])
        places.update(moved)
        on_node: dict[str, list[str]] = {}
        for waiter, node in places.items():
            on_node.setdefault(node, []).append(waiter)
        now: set[frozenset[str]] = set()
        for node, staff in on_node.items():
            for other in staff[1:]:
                pair = frozenset((staff[0], other))
                now.add(pair)
                if pair not in sharing:
                    mover = next((w for w, _ in moved if w in pair), None)
                    entry = None if mover is None else (mover, step)
                    clashes.append(Clash(staff[0], other, node, max(step, 0), entry))
        sharing = now
    return tuple(clashes)


def put_off(
    posts: Mapping[str, str], timetable: Sequence[tuple[str, int, str]], step: int, agent: str
) -> tuple[tuple[str, int, str], ...]:
    """Returns the timetable when the agent is still on its node at ``step``: who is
    due there comes a step later.

    So does whoever is due where one of those still stands.  An entry of his for the next step
    stands as it is; he goes there at once.

    >>> put_off({"w1": "n7"}, [("w1", 3, "n4"), ("w1", 6, "n7")], 3, "n4")
    (('w1', 4, 'n4'), ('w1', 6, 'n7'))
    """
    due = {who: node for who, at, node in timetable if at == step}
    taken, late = {agent}, set[str]()
    while True:
        held = {who for who, node in due.items() if node in taken} - late
        if not held:
            break
        late |= held
        taken |= {posts[who] for who in held}
    next_step = {who for who, at, _ in timetable if at == step + 1}
    moved = (
        (who, at + (at == step and who in late), node)
        for who, at, node in timetable
        if not (at == step and who in late and who in next_step)
    )
    return tuple(moved)
