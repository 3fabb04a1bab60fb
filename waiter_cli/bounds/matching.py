"""Matches rows (parties) to columns (tables).

`cover` finds a largest matching, or the rows that stand in each other's way; `cheapest` a matching
of all rows of least cost, with the prices that prove it.  Both in the plain textbook manner
(augmenting paths; shortest augmenting paths with potentials), for tens of rows.
"""

from __future__ import annotations

from collections.abc import Sequence

from sparc.lazy_dataclass import dataclass

__all__ = ["Assignment", "cheapest", "cover"]


@dataclass(frozen=True)
class Assignment:
    """Every row has the column ``column[row]``; ``cost`` is the sum.

    ``rows`` and ``columns`` are prices (duals): a matching of all rows that uses certain cells costs
    at least ``cost`` plus the sum of ``slack(row, column)`` over those cells.
    """

    column: tuple[int, ...]
    cost: int
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    costs: Sequence[Sequence[int]]

    def slack(self, row: int, column: int) -> int:
        """Returns how much more a matching costs, at least, that uses this cell."""
        return self.costs[row][column] - self.rows[row] - self.columns[column]


def cover(rows: Sequence[Sequence[int]]) -> tuple[dict[int, int], tuple[int, ...]]:
    """Returns a largest matching (row → column) and, unless it has every row, rows
    in each other's way.

    ``rows[i]`` are the columns that row i may have.  The rows in the second part together have
    fewer columns than they are; none of them can be left out of that statement.
    """
    owner: dict[int, int] = {}
    stuck: tuple[int, ...] = ()

    def place(row: int, seen: dict[int, int]) -> bool:
        for column in rows[row]:
            if column not in seen:
                seen[column] = row
                if column not in owner or place(owner[column], seen):
                    owner[column] = row
                    return True
        return False

    for row in range(len(rows)):
        seen: dict[int, int] = {}
        if not place(row, seen) and not stuck:
            stuck = _smallest(rows, (row, *sorted({owner[column] for column in seen} - {row})))
    return {row: column for column, row in owner.items()}, stuck


def _smallest(rows: Sequence[Sequence[int]], group: tuple[int, ...]) -> tuple[int, ...]:
    """Of rows that lack columns, a part that does too and can spare none."""
    kept = list(group)
    for row in group:
        rest = [other for other in kept if other != row]
        if rest and _lacks(rows, rest):
            kept = rest
    return tuple(sorted(kept))


def _lacks(rows: Sequence[Sequence[int]], group: Sequence[int]) -> bool:
    found, _ = cover([rows[row] for row in group]) if len(group) > 1 else ({}, ())
    if len(group) == 1:
        return not rows[group[0]]
    return len(found) < len(group)


def cheapest(costs: Sequence[Sequence[int]], never: int) -> Assignment | None:
    """Returns a matching of all rows of least cost; cells of ``never`` or more cannot be used.

    There must be at least as many columns as rows.  None when rows cannot all be matched.
    """
    height = len(costs)
    width = len(costs[0]) if costs else 0
    if height > width:
        return None
    infinite = never * (height + 2)
    u, v = [0] * (height + 1), [0] * (width + 1)
    owner = [0] * (width + 1)
    for row in range(1, height + 1):
        owner[0] = row
        column = 0
        least = [infinite] * (width + 1)
        before = [0] * (width + 1)
        used = [False] * (width + 1)
        while True:
            used[column] = True
            here = owner[column]
            line, price = costs[here - 1], u[here]
            step, following = infinite, 0
            for other in range(1, width + 1):
                if not used[other]:
                    gap = line[other - 1] - price - v[other]
                    if gap < least[other]:
                        least[other] = gap
                        before[other] = column
                    if least[other] < step:
                        step, following = least[other], other
            if not following:
                return None
            for other in range(width + 1):
                if used[other]:
                    u[owner[other]] += step
                    v[other] -= step
                else:
                    least[other] -= step
            column = following
            if not owner[column]:
                break
        while column:
            owner[column] = owner[before[column]]
            column = before[column]
    chosen = [0] * height
    for column in range(1, width + 1):
        if owner[column]:
            chosen[owner[column] - 1] = column - 1
    cost = sum(costs[row][column] for row, column in enumerate(chosen))
    if any(costs[row][column] >= never for row, column in enumerate(chosen)):
        return None
    return Assignment(tuple(chosen), cost, tuple(u[1:]), tuple(v[1:]), costs)
