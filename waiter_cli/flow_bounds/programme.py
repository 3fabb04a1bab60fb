"""The linear programme over the graph, solved by HiGHS: rows can be added, and are kept warm.

`Programme` is the one module that knows HiGHS.  What HiGHS says of a bound is never believed: it
gives prices (duals) of the rows, and `exact` works out in whole numbers what they prove.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.flow_bounds.layers import Layers
from waiter_cli.flow_bounds.modes import FlowRow

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Programme"]


class Programme:
    """Minimal cost of a flow; ``values`` of columns and ``prices`` of rows after `solve`."""

    def __init__(self, layers: Layers) -> None:
        import highspy
        import numpy as np

        class Quiet(highspy.Highs):
            """Without callbacks, the setting up of which makes HiGHS print who it is."""

            def __init__(self) -> None:
                super(highspy.Highs, self).__init__()

        self.np, self.highspy = np, highspy
        self.costs = np.array(layers.costs, dtype=np.int64)
        self.rows: list[FlowRow] = []
        self.highs = highs = Quiet()
        highs.setOptionValue("output_flag", False)
        highs.setOptionValue("threads", 1)
        highs.setOptionValue("random_seed", 0)
        count = len(layers.costs)
        highs.addVars(count, np.zeros(count), np.full(count, highspy.kHighsInf))
        columns = np.arange(count, dtype=np.int32)
        highs.changeColsCost(count, columns, self.costs.astype(np.float64))
        self.values: Floats = np.zeros(count)
        self.prices: Floats = np.zeros(0)
        self.value = 0.0
        self.add(layers.rows)

    def add(self, rows: Sequence[FlowRow]) -> None:
        """Adds rows at the end."""
        if not rows:
            return
        np, infinity = self.np, self.highspy.kHighsInf
        self.rows += rows
        low = np.array([-infinity if row.low is None else row.low for row in rows], dtype=float)
        high = np.array([infinity if row.high is None else row.high for row in rows], dtype=float)
        sizes = [len(row.columns) for row in rows]
        starts = np.concatenate(([0], np.cumsum(sizes)[:-1])).astype(np.int32)
        indices = np.array([c for row in rows for c, _ in row.columns], dtype=np.int32)
        factors = np.array([f for row in rows for _, f in row.columns], dtype=float)
        self.highs.addRows(len(rows), low, high, len(indices), starts, indices, factors)

    def limit(self, row: int, low: int | None, high: int | None) -> None:
        """Changes the bounds of a row."""
        infinity = self.highspy.kHighsInf
        old = self.rows[row]
        self.rows[row] = FlowRow(low, high, old.columns)
        self.highs.changeRowBounds(
            row, -infinity if low is None else low, infinity if high is None else high
        )

    def solve(self, deadline: float | None = None) -> bool | None:
        """Solves; False where there is no solution (``prices`` are then a proof of that), None undecided."""
        highs, np = self.highs, self.np
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
