"""Branching: what cuts leave open is divided into cases until each is refuted or is a plan.

Entry point `Branching`.  Where a flow splits something that a plan does not (a table is used by half,
a deed is done half in one mode), two rows make two cases: at most so often, or at least once more.
Every plan is in one of them.  A case is refuted as the whole is, by prices in whole numbers.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.relaxation import FlowRelaxation

__all__ = ["Branching"]

_WHOLE = 0.02
"""What is nearer to a whole number than this is not divided."""
_DEPTH = 60
"""So deep cases are divided, at most."""

_READ = 6
"""After so many cases a plan is looked for, even if the flow is not whole."""

_Columns = tuple[tuple[int, int], ...]
_Range = tuple[int | None, int | None]


class Branching:
    """The cases of one relaxation, which was solved; what is looked for are plans below ``enough``."""

    def __init__(
        self,
        relaxation: FlowRelaxation,
        enough: int,
        read: Callable[[], int],
        deadline: float | None = None,
    ) -> None:
        """``read`` looks for a plan near the last solution, and returns what is ``enough`` then."""
        self.relaxation, self.enough, self.read = relaxation, enough, read
        self.deadline = deadline
        self.levels = [list(level) for level in _levels(relaxation.layers)]
        self.ranges: dict[_Columns, _Range] = {}
        self.settled = 0

    def refute(self, depth: int = 0) -> bool:
        """Returns whether no case is left with a plan below ``enough``, which falls as plans are found."""
        if depth > _DEPTH:
            return False
        chosen = self.divided()
        while chosen is None:  # whole, yet perhaps in circles: then there are cuts to come
            done = self.relaxation.solve(self.enough, self.deadline, everywhere=False)
            if self.relaxation.refuted:
                return True
            if done or self.late():
                return False
            chosen = self.divided()
        columns, value = chosen
        least, most = before = self.ranges.get(columns, (None, None))
        low = int(value)
        cases: list[_Range] = [(least, low), (low + 1, most)]
        if value - low > 0.5:
            cases.reverse()
        try:
            return all(self.settle(columns, case, depth) for case in cases)
        finally:
            self.put(columns, before)

    def settle(self, columns: _Columns, case: _Range, depth: int) -> bool:
        """Returns whether one case is refuted, divided further where it has to be."""
        self.put(columns, case)
        self.relaxation.solve(self.enough, self.deadline, everywhere=False)
        if self.relaxation.refuted:
            return True
        if self.late():
            return False
        self.settled += 1
        if self.settled % _READ == 0 or self.divided() is None:
            self.enough = min(self.enough, self.read())
        return self.relaxation.case >= self.enough or self.refute(depth + 1)

    def late(self) -> bool:
        """Returns whether the deadline is over."""
        return self.deadline is not None and time.monotonic() > self.deadline

    def put(self, columns: _Columns, case: _Range) -> None:
        """Makes a case hold for what comes next."""
        self.ranges[columns] = case
        self.relaxation.divide(columns, *case)

    def divided(self) -> tuple[_Columns, float] | None:
        """Returns the columns whose sum is to be divided, and that sum; None where all are whole."""
        values = self.relaxation.programme.values.tolist()
        for level in self.levels:
            sums = [sum(values[column] for column in columns) for columns in level]
            parts = [abs(each - round(each)) for each in sums]
            best = max(range(len(level)), key=parts.__getitem__, default=-1)
            if best >= 0 and parts[best] > _WHOLE:
                return tuple((column, 1) for column in level[best]), sums[best]
        return None


def _levels(layers: Layers) -> Iterator[Sequence[tuple[int, ...]]]:
    """Yields groups of columns that a plan uses a whole number of times, the most telling first.

    These are deeds in one mode, deeds at one node, walks from one node to another in whatever mode,
    and columns by themselves.
    """
    count = len(layers.tails)
    modes = _grouped((key, layers.places[layers.tails[k]][0]) if key[0] != "walk" else None
                     for k, key in enumerate(layers.keys[:count]))  # fmt: skip
    nodes = _grouped((key, layers.places[layers.tails[k]][1]) if key[0] != "walk" else None
                     for k, key in enumerate(layers.keys[:count]))  # fmt: skip
    ways = _grouped(
        (layers.places[layers.tails[k]][1], layers.places[layers.heads[k]][1]) for k in range(count)
    )
    yield modes + [(k,) for k in range(count, len(layers.costs))]
    yield nodes
    yield ways
    yield [(k,) for k in range(count)]


def _grouped(names: Iterator[object]) -> list[tuple[int, ...]]:
    """Returns the indices of each name, None left out."""
    groups: dict[object, list[int]] = {}
    for index, name in enumerate(names):
        if name is not None:
            groups.setdefault(name, []).append(index)
    return [tuple(group) for group in groups.values()]
