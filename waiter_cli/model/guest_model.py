"""Guests who come by chance, `GuestModel`: when, how many, how long they take, how long they wait."""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass

__all__ = ["GuestModel", "Span"]


@dataclass(frozen=True)
class Span:
    """A duration in minutes, to be drawn for each party.

    ``kind`` is ``uniform`` (from ``low`` to ``high``) or ``normal`` (mean ``low``, standard deviation
    ``high``, cut at 0).
    """

    kind: str
    low: float
    high: float


@dataclass(frozen=True)
class GuestModel:
    """The behaviour of an evening's guests; durations are in minutes.

    Parties come ``per_hour`` (a Poisson process) during the first ``minutes``, or at the times ``at``:
    pairs of a minute and heads.  ``sizes`` gives the share of parties by heads, summing to 1.
    ``refills`` is how often an hour one guest empties the table's jug.  A party that has no table
    after ``patience`` minutes leaves, and one that has no plate ``patience_served`` minutes after it
    was ready to order; None: it stays.
    """

    minutes: float
    per_hour: float | None = None
    at: tuple[tuple[float, int], ...] = ()
    sizes: tuple[tuple[int, float], ...] = ((1, 0.2), (2, 0.5), (3, 0.1), (4, 0.2))
    order_after: Span = Span("uniform", 2.0, 6.0)
    cook: Span = Span("uniform", 8.0, 15.0)
    eat: Span = Span("uniform", 25.0, 45.0)
    bill_after: Span = Span("uniform", 0.0, 5.0)
    refills: float = 0.0
    patience: float | None = None
    patience_served: float | None = None
