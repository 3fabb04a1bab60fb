"""The linear programme over the graph, solved by HiGHS: rows can be added, and are kept warm.

`Programme` is the one module that knows HiGHS.  What HiGHS says of a bound is never believed: it
gives prices (duals) of the rows, and `exact_bound` works out in whole numbers what they prove.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.modes import FlowRow

if TYPE_CHECKING:
    import numpy as np
    from highspy import Highs as Quiet
    from numpy.typing import NDArray

    Flags = NDArray[np.bool_]
    Floats = NDArray[np.float64]

__all__ = ["CORNER", "INSIDE", "THROUGH", "Flags", "Floats", "Programme", "load_highs"]

CORNER, INSIDE, THROUGH = "corner", "inside", "through"
"""Ways to a solution: see `Programme.solve`."""


def load_highs() -> None:
    """Loads HiGHS."""
    import highspy

    assert highspy.__name__


class Programme:
    """Minimal cost of a flow; ``values`` of columns and ``prices`` of rows after `solve`."""

    def __init__(self, layers: Layers) -> None:
        import highspy
        import numpy as np

        class WithoutCallbacks(highspy.Highs):
            """Without callbacks, the setting up of which makes HiGHS print who it is."""

            def __init__(self) -> None:
                super(highspy.Highs, self).__init__()

        self.np, self.highspy = np, highspy
        self.costs = np.array(layers.costs, dtype=np.int64)
        self.rows: list[FlowRow] = []
        self.make = WithoutCallbacks
        self.highs = highs = self.quiet()
        count = len(layers.costs)
        highs.addVars(count, np.zeros(count), np.full(count, highspy.kHighsInf))
        columns = np.arange(count, dtype=np.int32)
        highs.changeColsCost(count, columns, self.costs.astype(np.float64))
        self.values: Floats = np.zeros(count)
        self.prices: Floats = np.zeros(0)
        self.value = 0.0
        self.gone: Flags = np.zeros(count, dtype=bool)
        self.kept: dict[tuple[tuple[int, int], ...], FlowRow] = {}
        self.add(layers.rows)

    def close(self, columns: Flags) -> None:
        """Leaves out columns for good, in addition to those that are left out already."""
        np = self.np
        new = np.flatnonzero(columns & ~self.gone).astype(np.int32)
        if len(new):
            self.gone |= columns
            zeros = np.zeros(len(new))
            self.highs.changeColsBounds(len(new), new, zeros, zeros)

    def between(
        self, columns: tuple[tuple[int, int], ...], low: int | None, high: int | None
    ) -> None:
        """Sets the bounds of a row for these columns, which is made and kept from now on.

        It stands beside other rows with the same columns, whose bounds stay.
        """
        before, row = self.kept.get(columns), FlowRow(low, high, columns)
        self.kept[columns] = row
        if before is None:
            self.add([row])
            return
        index = next(k for k, each in enumerate(self.rows) if each is before)
        self.rows[index] = row
        infinity = self.highspy.kHighsInf
        least, most = -infinity if low is None else low, infinity if high is None else high
        self.highs.changeRowBounds(index, float(least), float(most))

    def quiet(self) -> Quiet:
        """Returns an empty model that prints nothing and keeps to one thread."""
        highs = self.make()
        highs.setOptionValue("output_flag", False)
        highs.setOptionValue("threads", 1)
        highs.setOptionValue("random_seed", 0)
        return highs

    def whole(self, columns: Sequence[int], deadline: float) -> list[float] | None:
        """Returns a good solution in whole numbers with these columns alone, None without one.

        It keeps to all the rows there are now, and nothing is proved by it.
        """
        np, highspy = self.np, self.highspy
        highs = self.quiet()
        place = {column: k for k, column in enumerate(columns)}
        count = len(columns)
        highs.addVars(count, np.zeros(count), np.full(count, highspy.kHighsInf))
        numbers = np.arange(count, dtype=np.int32)
        highs.changeColsCost(count, numbers, self.costs[list(columns)].astype(np.float64))
        whole = np.full(count, highspy.HighsVarType.kInteger)
        highs.changeColsIntegrality(count, numbers, whole)
        rows = [
            FlowRow(row.low, row.high, tuple((place[c], f) for c, f in row.columns if c in place))
            for row in self.rows
        ]
        self._put(highs, rows)
        highs.setOptionValue("mip_rel_gap", 0.0)
        highs.setOptionValue("time_limit", max(0.01, deadline - time.monotonic()))
        highs.run()
        if highs.getInfo().primal_solution_status != 2:  # feasible
            return None
        flow = [0.0] * len(self.costs)
        for column, value in zip(columns, highs.getSolution().col_value):
            flow[column] = float(value)
        return flow

    def add(self, rows: Sequence[FlowRow]) -> None:
        """Adds rows at the end."""
        if rows:
            self.rows += rows
            self._put(self.highs, rows)

    def _put(self, highs: Quiet, rows: Sequence[FlowRow]) -> None:
        np, infinity = self.np, self.highspy.kHighsInf
        low = np.array([-infinity if row.low is None else row.low for row in rows], dtype=float)
        high = np.array([infinity if row.high is None else row.high for row in rows], dtype=float)
        sizes = [len(row.columns) for row in rows]
        starts = np.concatenate(([0], np.cumsum(sizes)[:-1])).astype(np.int32)
        indices = np.array([c for row in rows for c, _ in row.columns], dtype=np.int32)
        factors = np.array([f for row in rows for _, f in row.columns], dtype=float)
        highs.addRows(len(rows), low, high, len(indices), starts, indices, factors)

    def drop(self, first: int, price: float) -> list[int]:
        """Takes out the rows from ``first`` on with less than this price; returns which ones stay.

        They cost time in every round, and come back when they are missing.
        """
        np = self.np
        prices, kept = self.prices, self.kept
        idle = [
            k
            for k in range(first, len(prices))
            if abs(prices[k]) < price and kept.get(self.rows[k].columns) is not self.rows[k]
        ]
        gone = set(idle)
        self.highs.deleteRows(len(idle), np.array(idle, dtype=np.int32))
        self.rows = [row for k, row in enumerate(self.rows) if k not in gone]
        return [k for k in range(first, len(self.rows) + len(idle)) if k not in gone]

    def solve(self, deadline: float | None = None, way: str = CORNER) -> bool | None:
        """Solves it; returns False where there is no solution (``prices`` then prove it), None undecided.

        ``way``: to a corner from the last one (`CORNER`), by far the fastest where little changed;
        to the middle of all the best solutions (`INSIDE`), where no proof that there is none can be
        had; or through the middle to a corner (`THROUGH`).
        """
        highs, np = self.highs, self.np
        highs.setOptionValue("solver", "simplex" if way == CORNER else "ipm")
        highs.setOptionValue("run_crossover", "off" if way == INSIDE else "on")
        if deadline is not None:
            left = deadline - time.monotonic()
            if left <= 0:
                return None
            highs.setOptionValue("time_limit", highs.getRunTime() + left)
        highs.run()
        status, wanted = highs.getModelStatus(), self.highspy.HighsModelStatus
        if status == wanted.kOptimal:
            solution = highs.getSolution()
            self.values = np.array(solution.col_value)
            self.prices = np.array(solution.row_dual)
            self.value = highs.getObjectiveValue()
            return True
        if status == wanted.kInfeasible:
            _, known, ray = highs.getDualRay()  # type: ignore[attr-defined]
            if known:
                self.prices = np.array(ray)
                return False
        return None
