"""Least cuts between the start and where something is done: sets that too little flows into.

Entry point `Net`.  Ways are looked for from the end, since a set that lacks flow is small and near
it: once no way is left, what the end can still be reached from is that set.  Ways with much room
come first, so that few are needed.
"""

from __future__ import annotations

__all__ = ["Net"]

_ROOMS = (1 << 17, 1 << 12, 1)
"""Ways are looked for with so much room on each arc, one after the other."""


class Net:
    """A graph with an amount on each arc."""

    def __init__(self) -> None:
        self.into: dict[int, list[int]] = {}
        self.tails: list[int] = []  # arc k ^ 1 is arc k the other way round
        self.rooms: list[int] = []
        self.arcs: dict[tuple[int, int], int] = {}

    def join(self, tail: int, head: int, amount: int) -> None:
        """Adds so much to the arc from ``tail`` to ``head``; a loop is left out."""
        if tail == head:
            return
        arc = self.arcs.get((tail, head))
        if arc is None:
            arc = self.arcs[tail, head] = len(self.rooms)
            self.arcs[head, tail] = arc + 1
            self.tails += (tail, head)
            self.rooms += (0, 0)
            self.into.setdefault(head, []).append(arc)
            self.into.setdefault(tail, []).append(arc + 1)
        self.rooms[arc] += amount

    def short(self, start: int, amounts: dict[int, int], wanted: int) -> set[int] | None:
        """Returns the smallest set of a least cut, None where ``wanted`` gets from ``start`` to its ends.

        ``amounts`` is how much may end in each node; what may end in ``start`` is there.
        """
        rooms, ends, level = self.rooms.copy(), dict(amounts), 0
        total = ends.pop(start, 0)
        while total < wanted:
            after, seen = self._reaching(rooms, ends, start, _ROOMS[level])
            if start in after:
                total += self._send(rooms, ends, after, start)
            elif level == len(_ROOMS) - 1:
                return seen
            else:
                level += 1
        return None

    def _reaching(
        self, rooms: list[int], ends: dict[int, int], start: int, room: int
    ) -> tuple[dict[int, int], set[int]]:
        """Returns the arc to follow from each node that gets to an end, and those nodes with the ends."""
        into, tails = self.into, self.tails
        queue = [node for node, amount in ends.items() if amount >= room]
        after: dict[int, int] = {}
        seen = set(queue)
        for here in queue:
            for arc in into.get(here, ()):
                tail = tails[arc]
                if rooms[arc] >= room and tail not in seen:
                    seen.add(tail)
                    after[tail] = arc
                    if tail == start:
                        return after, seen
                    queue.append(tail)
        return after, seen

    def _send(
        self, rooms: list[int], ends: dict[int, int], after: dict[int, int], start: int
    ) -> int:
        """Sends all that fits along the way that was found; returns how much that is."""
        way, here = [], start
        while here in after:
            way.append(after[here])
            here = self.tails[after[here] ^ 1]
        least = min(ends[here], min(rooms[arc] for arc in way))
        for arc in way:
            rooms[arc] -= least
            rooms[arc ^ 1] += least
        ends[here] -= least
        return least
