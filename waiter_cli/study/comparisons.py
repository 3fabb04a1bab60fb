"""Paired differences between the combinations of a study, with intervals: rows → `Comparison`s.

Entry points `compare_rows`, `compare_values` and `bootstrap`.

Each thing that varies is compared with its first value on the same evenings: an evening's
difference is that of two runs which agree in all else, its mean where there are several such pairs.
Intervals are of the mean over evenings, by the bootstrap: evenings are drawn with replacement, and
the percentiles are widened for small numbers as in T. Hesterberg, "What Teachers Should Know About
the Bootstrap", The American Statistician 69 (2015), section 5.2 (expanded percentiles).
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import NormalDist
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import MissingError
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.optional_packages import extra_line
from waiter_cli.study.store import Row

__all__ = [
    "ENOUGH",
    "Comparison",
    "Difference",
    "Interval",
    "bootstrap",
    "compare_rows",
    "compare_values",
    "difference_of",
    "level_of",
    "numpy_or_missing",
    "paired_differences",
]

VARYING = ("agents", "speed", "layout")
ENOUGH = 5
"""So many evenings there must be for an interval."""
DRAWS = 10_000
SEED = 20_15


@dataclass(frozen=True)
class Interval:
    """A mean over so many ``evenings``; ``low`` and ``high`` are None where they are too few."""

    mean: float
    low: float | None
    high: float | None
    evenings: int


@dataclass(frozen=True)
class Difference:
    """The difference of a figure, the other less the first; None where no evening has it in both.

    ``verdict`` is ``more``, ``less``, ``same`` (no evening differs), ``unsupported`` (the interval
    has both signs, or ends at 0) or ``too_few`` (evenings).
    """

    figure: str
    found: Interval | None
    verdict: str


@dataclass(frozen=True)
class Comparison:
    """Two values of what varies: ``vary`` is ``agents``, ``speed`` or ``layout``.

    ``evenings`` have a pair of runs that are done; ``left_out`` have none.
    """

    vary: str
    first: Any
    other: Any
    evenings: int
    left_out: int
    differences: tuple[Difference, ...]


def numpy_or_missing() -> Any:
    """Returns numpy; raises `MissingError` where it is not installed."""
    try:
        import numpy
    except ImportError as error:
        raise MissingError("intervals need numpy", extra_line("study")) from error
    return numpy


def compare_rows(rows: Sequence[Row]) -> list[Comparison]:
    """Returns the comparisons of each thing that varies with its first value."""
    comparisons = []
    for vary in VARYING:
        values = list(dict.fromkeys(row[vary] for row in rows))
        for other in values[1:]:
            comparisons.append(compare_values(rows, vary, values[0], other))
    return comparisons


def level_of(rows: Sequence[Row], figure: str) -> Interval | None:
    """Returns the mean of a figure over evenings, of runs that are done; None where none has it."""
    by_seed: dict[int, list[float]] = {}
    for row in rows:
        if row["status"] == "done" and row[figure] is not None:
            by_seed.setdefault(row["seed"], []).append(row[figure])
    return bootstrap([sum(each) / len(each) for each in by_seed.values()])


def bootstrap(values: Sequence[float], level: float = 0.95) -> Interval | None:
    """Returns the mean of values, one an evening, and its interval; None of nothing.

    Equal values give equal intervals: the draws are seeded.
    """
    np = numpy_or_missing()
    count = len(values)
    if not count:
        return None
    array = np.asarray(values, dtype=float)
    mean = float(array.mean())
    if count < ENOUGH:
        return Interval(mean, None, None, count)
    if float(np.ptp(array)) == 0.0:
        return Interval(mean, mean, mean, count)
    tail = _tail(count, level)
    low, high = np.quantile(_means(np, array), [tail, 1.0 - tail])
    return Interval(mean, float(low), float(high), count)


def _means(np: Any, array: Any) -> Any:
    """Returns the means of samples that are drawn with replacement."""
    chance = np.random.default_rng(SEED)
    count = len(array)
    at_once = max(1, min(DRAWS, 2_000_000 // count))
    drawn = 0
    means = []
    while drawn < DRAWS:
        some = min(at_once, DRAWS - drawn)
        means.append(array[chance.integers(0, count, (some, count))].mean(axis=1))
        drawn += some
    return np.concatenate(means)


def _tail(count: int, level: float) -> float:
    """Returns the share of means below an interval: Φ(-√(n/(n-1)) t), t with n-1 degrees of freedom."""
    normal = NormalDist()
    z = normal.inv_cdf(0.5 + level / 2.0)
    n = count - 1
    t = (  # Abramowitz and Stegun 26.7.5
        z
        + (z**3 + z) / (4 * n)
        + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2)
        + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * n**3)
    )
    return normal.cdf(-((count / n) ** 0.5) * t)


def compare_values(rows: Sequence[Row], vary: str, first: Any, other: Any) -> Comparison:
    """Returns the comparison of two values of what varies."""
    pairs = _pairs(rows, vary, first, other)
    seeds = {row["seed"] for row in rows if row[vary] in (first, other)}
    evenings = {seed for seed, _, _ in pairs}
    differences = tuple(_difference(name, pairs, 0.95) for name in FIGURES)
    return Comparison(vary, first, other, len(evenings), len(seeds - evenings), differences)


def difference_of(
    rows: Sequence[Row], vary: str, first: Any, other: Any, figure: str, level: float = 0.95
) -> Difference:
    """Returns the difference of one figure between two values of what varies."""
    return _difference(figure, _pairs(rows, vary, first, other), level)


def paired_differences(
    rows: Sequence[Row], vary: str, first: Any, other: Any, figure: str
) -> list[float]:
    """Returns the differences of a figure, the other less the first, one an evening that has both."""
    return _by_evening(figure, _pairs(rows, vary, first, other))


Pair = tuple[int, Row, Row]


def _pairs(rows: Sequence[Row], vary: str, first: Any, other: Any) -> list[Pair]:
    """Returns the seeds with the runs of the first value and of the other that agree in all else."""
    rest = [name for name in VARYING if name != vary]
    sides: list[dict[tuple[Any, ...], Row]] = [{}, {}]
    for row in rows:
        if row[vary] in (first, other) and row["status"] == "done":
            place = (row["seed"], *(row[name] for name in rest))
            sides[row[vary] == other][place] = row
    return [(place[0], sides[0][place], sides[1][place]) for place in sides[0] if place in sides[1]]


def _by_evening(figure: str, pairs: Sequence[Pair]) -> list[float]:
    by_seed: dict[int, list[float]] = {}
    for seed, one, other in pairs:
        if one[figure] is not None and other[figure] is not None:
            by_seed.setdefault(seed, []).append(other[figure] - one[figure])
    return [sum(each) / len(each) for each in by_seed.values()]


def _difference(figure: str, pairs: Sequence[Pair], level: float) -> Difference:
    values = _by_evening(figure, pairs)
    found = bootstrap(values, level)
    if found is None or found.low is None or found.high is None:
        return Difference(figure, found, "too_few")
    if not any(values):
        return Difference(figure, found, "same")
    if found.low > 0.0:
        return Difference(figure, found, "more")
    return Difference(figure, found, "less" if found.high < 0.0 else "unsupported")
