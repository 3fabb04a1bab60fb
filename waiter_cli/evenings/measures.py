"""Measures an evening: `Stay`s → numbers by name. Entry point `figures_of`.

Waits are in seconds: for a table from coming in, to order from being ready, for the plate from the
order's being taken, for the bill from asking for it.  Each is of the parties for which it ended.
"""

from __future__ import annotations

from collections.abc import Sequence

from waiter_cli.evenings.evening import Stay

__all__ = ["FIGURES", "figures_of", "quantile"]

WAITS = ("seat", "order", "plate", "bill")
FIGURES = (
    "parties", "guests", "served", "lost", "lost_unseated", "lost_unserved",
    *(f"wait_{what}_{measure}" for what in WAITS for measure in ("mean", "p50", "p95")),
    "table_use", "metres", "idle", "late",
)  # fmt: skip
"""The names of all figures, in the order in which they are listed."""


def figures_of(
    stays: Sequence[Stay], seconds: float, tables: int, *, metres: float, idle: float, late: int
) -> dict[str, float | None]:
    """Returns the figures of an evening that took so many seconds, by `FIGURES`.

    ``served`` parties have paid.  ``table_use`` is the share of the time for which a table is taken, over
    all ``tables``; ``idle`` the share for which the robot does nothing; ``late`` the number of decisions that
    were not settled in time.  A wait that nobody had is None.
    """
    lost = [stay.lost for stay in stays if stay.lost is not None]
    figures: dict[str, float | None] = {
        "parties": len(stays),
        "guests": sum(stay.visit.heads for stay in stays),
        "served": sum(1 for stay in stays if stay.paid is not None),
        "lost": len(lost),
        "lost_unseated": lost.count("unseated"),
        "lost_unserved": lost.count("unserved"),
    }
    for what, waits in zip(WAITS, _waits(stays)):
        mean = sum(waits) / len(waits) if waits else None
        figures[f"wait_{what}_mean"] = mean
        figures[f"wait_{what}_p50"] = quantile(waits, 0.5)
        figures[f"wait_{what}_p95"] = quantile(waits, 0.95)
    taken = sum(
        (seconds if stay.left is None else stay.left) - stay.seated
        for stay in stays
        if stay.seated is not None
    )
    figures["table_use"] = taken / (tables * seconds) if tables and seconds else 0.0
    figures |= {"metres": metres, "idle": idle, "late": late}
    return {name: _rounded(figures[name]) for name in FIGURES}


def quantile(values: Sequence[float], share: float) -> float | None:
    """Returns a quantile, interpolated linearly between the nearest ranks; None of nothing."""
    if not values:
        return None
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def _waits(stays: Sequence[Stay]) -> tuple[list[float], ...]:
    spans = (
        [(stay.arrived, stay.seated) for stay in stays],
        [(stay.hungry, stay.taken) for stay in stays],
        [(stay.taken, stay.served) for stay in stays],
        [(stay.calls, stay.paid) for stay in stays],
    )
    return tuple(
        [end - begin for begin, end in pairs if begin is not None and end is not None]
        for pairs in spans
    )


def _rounded(value: float | None) -> float | None:
    return round(value, 3) if isinstance(value, float) else value
