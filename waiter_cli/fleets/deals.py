"""Jobs dealt out to robots in all ways whose tours keep to a length: `TourTable` → deals. Entry point `Deals`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from waiter_cli.fleets.narrow_rows import out_of_bounds
from waiter_cli.fleets.tour_table import NEVER, TourTable
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Costs, Numbers

__all__ = ["Deals"]

MOST_DEALS = 100_000
"""So many are dealt out side by side."""


class Deals:
    """The robots of a problem, each with its table and the jobs that it has begun.

    Sets of jobs are numbers, a bit a job; a deal is a row of them, one a robot.  ``open`` are the
    jobs that any robot may do.
    """

    def __init__(self, problem: Problem, table: TourTable, ends: dict[str, str]) -> None:
        self.np, self.table = table.np, table
        self.robots = problem.state.robots
        never = out_of_bounds(problem)
        self.tables: list[Costs] = [
            table.costs(ends.get(robot.name), never.get(robot.name, frozenset()))
            for robot in self.robots
        ]
        self.begun = [table.begun(robot) for robot in self.robots]
        owned = {k for own in self.begun for k, _ in own}
        self.open = [k for k in range(len(table.jobs)) if k not in owned]
        self.offsets = table.offsets()

    def within(self, length: int, most: int = MOST_DEALS) -> tuple[Numbers, bool]:
        """Returns the deals whose tours keep to ``length``, the shortest first, and whether that is all.

        It is not all where there were more than `MOST_DEALS` on the way, or more than ``most``.
        """
        np = self.np
        deals, whole = np.zeros((1, len(self.robots)), dtype=np.int64), True
        for k in self.open:
            parts = np.repeat(deals[None], len(self.robots), axis=0)
            for robot in range(len(self.robots)):
                parts[robot, :, robot] |= 1 << k
            deals = parts.reshape(-1, len(self.robots))
            costs = self._costs(deals)
            longest = costs.max(1)
            keep = np.nonzero(longest <= length)[0]
            if len(keep) > MOST_DEALS:
                keep, whole = (
                    keep[np.lexsort((costs[keep].sum(1), longest[keep]))[:MOST_DEALS]],
                    False,
                )
            deals = deals[keep]
        costs = self._costs(deals)
        longest = costs.max(1)
        order = np.lexsort((costs.sum(1), longest))
        order = order[longest[order] <= length]
        return deals[order[:most]], whole and len(order) <= most

    def least(self) -> int:
        """Returns a length that some tour has however jobs are dealt out; `NEVER` or more: none will do.

        It is the least such length unless there are too many deals to look at.
        """
        none = self.np.zeros((1, len(self.robots)), dtype=self.np.int64)
        refuted, step = int(self._costs(none).max()) - 1, 1
        while refuted + step < NEVER:
            deals, whole = self.within(refuted + step)
            if len(deals) and (whole or step == 1):
                return int(self._costs(deals[:1]).max()) if whole else refuted + 1
            refuted, step = (refuted, 1) if len(deals) or not whole else (refuted + step, 2 * step)
        return NEVER

    def _costs(self, deals: Numbers) -> Numbers:
        """Returns the steps of each robot's tour, a row a deal."""
        found = []
        for k, robot in enumerate(self.robots):
            row = self.table.row_of(self.begun[k])
            node = self.table.floor.number[robot.at]
            found.append(self.tables[k][row - self.offsets[deals[:, k]], node].astype(int))
        costs: Numbers = self.np.stack(found, axis=1)
        return costs
