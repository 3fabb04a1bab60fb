"""How long answers took: percentiles of a run. Entry point `Latencies`."""

from __future__ import annotations

from math import ceil

__all__ = ["Latencies", "percentile"]


def percentile(sorted_values: list[float], percent: float) -> float:
    """The smallest value that at least ``percent`` of them do not exceed.

    >>> percentile([1.0, 2.0, 3.0, 40.0], 50), percentile([1.0, 2.0, 3.0, 40.0], 95)
    (2.0, 40.0)
    """
    return sorted_values[max(0, ceil(percent / 100 * len(sorted_values)) - 1)]


class Latencies:
    """Times from a line to its answer, in milliseconds."""

    def __init__(self) -> None:
        self._values: list[float] = []

    def add(self, milliseconds: float) -> None:
        """Notes one answer."""
        self._values.append(milliseconds)

    def summary(self) -> dict[str, float | int]:
        """How many answers, and the percentiles where there are any."""
        if not self._values:
            return {"count": 0}
        ordered = sorted(self._values)
        marks = {f"p{mark}_ms": round(percentile(ordered, mark), 1) for mark in (50, 95, 99)}
        return {"count": len(ordered), **marks, "max_ms": round(ordered[-1], 1)}
