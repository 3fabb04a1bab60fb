"""Measures the latency of answers: percentiles of a run. Entry point `Latencies`."""

from __future__ import annotations

from collections import deque
from math import ceil

__all__ = ["KEPT", "Latencies", "percentile"]

KEPT = 10_000
"""So many times are kept."""


def percentile(sorted_values: list[float], percent: float) -> float:
    """Returns the smallest value that at least ``percent`` of them do not exceed.

    >>> percentile([1.0, 2.0, 3.0, 40.0], 50), percentile([1.0, 2.0, 3.0, 40.0], 95)
    (2.0, 40.0)
    """
    return sorted_values[max(0, ceil(percent / 100 * len(sorted_values)) - 1)]


class Latencies:
    """Times from a line to its answer, in milliseconds.

    All of them are counted; percentiles are those of the last `KEPT`.
    """

    def __init__(self) -> None:
        self._values: deque[float] = deque(maxlen=KEPT)
        self._count = 0
        self._most = 0.0

    def add(self, milliseconds: float) -> None:
        """Notes one answer."""
        self._values.append(milliseconds)
        self._count += 1
        self._most = max(self._most, milliseconds)

    def summary(self) -> dict[str, float | int]:
        """Returns the number of answers, and the percentiles where there are any."""
        if not self._values:
            return {"count": 0}
        ordered = sorted(self._values)
        marks = {f"p{mark}_ms": round(percentile(ordered, mark), 1) for mark in (50, 95, 99)}
        return {"count": self._count, **marks, "max_ms": round(self._most, 1)}
