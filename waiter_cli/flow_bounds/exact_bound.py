"""Bounds that prices of rows prove, in whole numbers: no rounding can make them too high.

Entry points `lean_of` and `rounded`.  Whatever the prices, every walk that keeps to the rows costs
at least the rows' bounds times their prices, less what its columns are too cheap at those prices.
A plan of at most ``most`` steps uses a column at most ``most`` times.  So the bound holds for prices
of any origin; good ones make it high.  Prices are whole numbers of 1/`UNIT`, so that all of this is
exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from waiter_cli.flow_bounds.modes import FlowRow

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

__all__ = ["UNIT", "Whole", "lean_of", "rounded", "steps_of"]

UNIT = 1 << 30
"""Prices are whole numbers of its reciprocal."""
_HIGHEST = 1 << 17
"""No price may be higher, or sums would not fit in 64 bits."""


def rounded(rows: Sequence[FlowRow], prices: Sequence[float]) -> list[int]:
    """Returns the prices as whole numbers, 0 where a row cannot have one of that sign."""
    found = []
    for row, price in zip(rows, prices):
        whole = round(min(max(price, -_HIGHEST), _HIGHEST) * UNIT)
        if (whole > 0 and row.low is None) or (whole < 0 and row.high is None):
            whole = 0
        found.append(whole)
    return found


def lean_of(costs: Whole, rows: Sequence[FlowRow], prices: Sequence[int]) -> tuple[int, Whole]:
    """Returns what the rows are worth at these prices, and what each column costs beyond, in units."""
    import numpy as np

    lean = costs * UNIT
    total = 0
    columns: list[int] = []
    amounts: list[int] = []
    for row, price in zip(rows, prices):
        if price:
            bound = row.low if price > 0 else row.high
            assert bound is not None
            total += price * bound
            for column, factor in row.columns:
                columns.append(column)
                amounts.append(price * factor)
    np.subtract.at(lean, columns, np.array(amounts, dtype=np.int64))
    return total, lean


def steps_of(units: int) -> int:
    """Returns the least whole number of steps that is no less than so many units."""
    return -(-units // UNIT)
