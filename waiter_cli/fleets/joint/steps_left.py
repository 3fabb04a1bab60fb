"""The steps that are left at least from joint states, over all ways to deal out what is left: `StepsLeft`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from waiter_cli.fleets.joint.joint_states import JointStates
from waiter_cli.fleets.tour_table import NEVER

if TYPE_CHECKING:
    from waiter_cli.fleets.tour_table import Costs, Numbers

__all__ = ["StepsLeft"]

MANY_DEALS, FEW_DEALS = 7_000, 100
"""So many deals are kept where they are all there are, and where only the best of them are."""
CELLS = 3_000_000
"""So many pairs of a state and a deal are looked at in one go."""


class StepsLeft:
    """The deals whose tours keep to ``length``; ``whole`` says whether they are all there are.

    ``none`` says that there is not even one.
    """

    def __init__(self, states: JointStates, length: int) -> None:
        self.np, self.states, self.length = states.np, states, length
        self._dealt, self.whole = states.deals.within(length, MANY_DEALS)
        if not self.whole:
            self._dealt = self._dealt[:FEW_DEALS]
        self.none = not len(self._dealt)
        self._dealt_of: dict[int, Numbers] = {}

    def least(self, rows: Numbers) -> Numbers:
        """Returns of each state the steps that are left at least.

        They are exact for states whose tours end within ``length``, if the deals are ``whole``.  Of
        others they may be too many, but then these do not end within it.
        """
        return self._counted(rows, sums=False)[0]

    def least_and_total(self, rows: Numbers) -> tuple[Numbers, Numbers]:
        """Returns the same, and how many steps all robots do then."""
        return self._counted(rows, sums=True)

    def _counted(self, rows: Numbers, sums: bool) -> tuple[Numbers, Numbers]:
        np, k = self.np, self.states.count
        least, total = np.full((2, len(rows)), NEVER, dtype=np.int64)
        order = np.argsort(rows[:, k], kind="stable")
        sets, first = np.unique(rows[order, k], return_index=True)
        for jobs, chosen in zip(sets.tolist(), np.split(order, first[1:])):
            deals = self._deals_of(jobs)
            size = max(1, CELLS // len(deals))
            for at in range(0, len(chosen), size):
                part = chosen[at : at + size]
                costs = self._costs(rows[part], deals)
                longest = costs[0]
                for cost in costs[1:]:
                    longest = np.maximum(longest, cost)
                least[part] = longest.min(1)
                if sums:
                    every = np.minimum(sum(cost.astype(np.int64) for cost in costs), NEVER)
                    total[part] = np.where(longest == least[part, None], every, NEVER).min(1)
        if self.states.anywhere:
            least = np.where(self.states.done(rows), least, np.maximum(least, 1))
        return least, total

    def _costs(self, rows: Numbers, deals: Numbers) -> list[Costs]:
        """Returns for each robot the steps of its tour in each state (rows) by each deal (columns)."""
        found = []
        for robot, flat in enumerate(self.states.flat):
            cell = self.states.cell[rows[:, robot]]
            found.append(flat[cell[:, None] - deals[None, :, robot]])
        return found

    def _deals_of(self, jobs: int) -> Numbers:
        """Returns what is left of the deals where only ``jobs`` are left, as distances between cells."""
        found = self._dealt_of.get(jobs)
        if found is None:
            left = self.np.unique(self._dealt & jobs, axis=0)
            found = self._dealt_of[jobs] = self.states.deals.offsets[left] * self.states.moves.nodes
        return found
