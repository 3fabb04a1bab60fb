"""Guests against their distributions, and against whatever else happens in an evening."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from itertools import islice
from math import erf, exp, sqrt

import pytest

from waiter_cli.evenings.draws import Visit, refill_times, visits
from waiter_cli.model.guest_model import GuestModel, Span

MANY = 10_000
MODEL = GuestModel(
    minutes=30_000.0,
    per_hour=20.0,
    order_after=Span("uniform", 2.0, 6.0),
    cook=Span("normal", 12.0, 3.0),
    eat=Span("uniform", 25.0, 45.0),
    bill_after=Span("normal", 1.0, 2.0),
    refills=0.5,
)


@pytest.fixture(scope="module")
def drawn() -> list[Visit]:
    return list(islice(visits(MODEL, 7), MANY))


def distance(values: Sequence[float], share_below: Callable[[float], float]) -> float:
    """The Kolmogorov-Smirnov distance of a sample from a continuous distribution."""
    ordered, n = sorted(values), len(values)
    return max(
        max(abs(share_below(x) - k / n), abs(share_below(x) - (k + 1) / n))
        for k, x in enumerate(ordered)
    )


def fits(values: Sequence[float], share_below: Callable[[float], float]) -> bool:
    """At one per cent; a sample that fits is refused once in a hundred seeds."""
    return distance(values, share_below) < 1.63 / sqrt(len(values))


def uniform(low: float, high: float) -> Callable[[float], float]:
    return lambda x: min(1.0, max(0.0, (x - low) / (high - low)))


def normal(mean: float, sd: float) -> Callable[[float], float]:
    return lambda x: (1.0 + erf((x - mean) / (sd * sqrt(2.0)))) / 2.0


def exponential(mean: float) -> Callable[[float], float]:
    return lambda x: 1.0 - exp(-x / mean)


def test_parties_come_as_a_poisson_process(drawn: list[Visit]) -> None:
    times = [0.0, *(visit.arrives for visit in drawn)]
    gaps = [after - before for before, after in zip(times, times[1:])]
    assert len(gaps) > 9_000
    assert fits(gaps, exponential(180.0))
    assert not fits(gaps, exponential(170.0))


def test_durations_are_drawn_as_was_asked_for(drawn: list[Visit]) -> None:
    assert fits([visit.order_after for visit in drawn], uniform(120.0, 360.0))
    assert fits([visit.cook for visit in drawn], normal(720.0, 180.0))
    assert fits([visit.eat for visit in drawn], uniform(1500.0, 2700.0))
    assert not fits([visit.eat for visit in drawn], uniform(1500.0, 2600.0))


def test_a_normal_duration_is_cut_at_nothing(drawn: list[Visit]) -> None:
    waits = [visit.bill_after for visit in drawn]
    assert min(waits) == 0.0
    assert sum(wait == 0.0 for wait in waits) / len(waits) == pytest.approx(0.3085, abs=0.015)
    above = normal(60.0, 120.0)
    positive = [wait for wait in waits if wait > 0.0]
    assert fits(positive, lambda x: (above(x) - above(0.0)) / (1.0 - above(0.0)))


def test_sizes_have_their_shares(drawn: list[Visit]) -> None:
    counts = Counter(visit.heads for visit in drawn)
    expected = {heads: share * len(drawn) for heads, share in MODEL.sizes}
    assert set(counts) == set(expected)
    chi = sum((counts[heads] - count) ** 2 / count for heads, count in expected.items())
    assert chi < 11.34  # one per cent, three degrees of freedom


def test_jugs_are_emptied_by_the_hour_and_guest() -> None:
    visit = Visit(3, 0.0, 4, 0.0, 0.0, 0.0, 0.0)
    times = [0.0, *islice(refill_times(MODEL, visit, 1), MANY)]
    gaps = [after - before for before, after in zip(times, times[1:])]
    assert fits(gaps, exponential(3600.0 / (0.5 * 4)))


def test_without_refills_no_jug_is_emptied() -> None:
    visit = Visit(3, 0.0, 4, 0.0, 0.0, 0.0, 0.0)
    assert not list(refill_times(GuestModel(60.0), visit, 1))


def test_a_party_is_the_same_whatever_else_is_asked_for() -> None:
    """More guests, or other durations of others, leave each one's draws as they were."""
    some = list(islice(visits(MODEL, 5), 20))
    assert list(islice(visits(MODEL, 5), 40))[:20] == some
    assert list(islice(visits(MODEL, 6), 20)) != some


def test_given_times_are_kept() -> None:
    model = GuestModel(30.0, at=((0.0, 2), (7.5, 4)))
    assert [(v.arrives, v.heads) for v in visits(model, 1)] == [(0.0, 2), (450.0, 4)]


def test_nobody_comes_after_the_last_minute() -> None:
    model = GuestModel(60.0, per_hour=30.0)
    assert all(visit.arrives < 3600.0 for seed in range(20) for visit in visits(model, seed))
