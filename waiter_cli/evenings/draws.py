"""Draws the guests of an evening by chance: `GuestModel`, seed → `Visit` after `Visit`.

Entry points `visits` and `refill_times`.  Each party has random numbers of its own, seeded by the evening's seed and its
own number, so that it stays the same guest in every layout and with any number of robots: it comes
at the same time, and is as hungry and as patient, whatever happened before.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.guest_model import GuestModel, Span

__all__ = ["Visit", "draw_span", "refill_times", "visits"]


@dataclass(frozen=True)
class Visit:
    """A party as it was drawn; times are in seconds.

    ``arrives`` counts from the beginning of the evening, the others from what they follow.
    """

    number: int
    arrives: float
    heads: int
    order_after: float
    cook: float
    eat: float
    bill_after: float


def visits(model: GuestModel, seed: int) -> Iterator[Visit]:
    """Yields the parties of an evening, in the order in which they come."""
    for number, (minute, heads) in enumerate(_arrivals(model, seed)):
        chance = Random(f"party {number} of evening {seed}")
        drawn = _size(model, chance)
        yield Visit(
            number,
            60.0 * minute,
            drawn if heads is None else heads,
            *(60.0 * draw_span(span, chance) for span in _spans(model)),
        )


def refill_times(model: GuestModel, visit: Visit, seed: int) -> Iterator[float]:
    """Yields the seconds after sitting down at which the party has emptied its jug, endlessly.

    A Poisson process of ``refills`` an hour and guest; nothing where there are none.
    """
    rate = model.refills * visit.heads / 3600.0
    if rate <= 0.0:
        return
    chance = Random(f"refills of party {visit.number} of evening {seed}")
    time = 0.0
    while True:
        time += chance.expovariate(rate)
        yield time


def draw_span(span: Span, chance: Random) -> float:
    """Returns a duration in minutes."""
    if span.kind == "normal":
        return max(0.0, chance.gauss(span.low, span.high))
    return chance.uniform(span.low, span.high)


def _spans(model: GuestModel) -> tuple[Span, ...]:
    return (model.order_after, model.cook, model.eat, model.bill_after)


def _arrivals(model: GuestModel, seed: int) -> Iterator[tuple[float, int | None]]:
    """Yields minutes, and heads where they are given."""
    if model.per_hour is None:
        yield from model.at
        return
    if model.per_hour <= 0.0:
        return
    chance = Random(f"arrivals of evening {seed}")
    minute = 0.0
    while True:
        minute += chance.expovariate(model.per_hour / 60.0)
        if minute >= model.minutes:
            return
        yield minute, None


def _size(model: GuestModel, chance: Random) -> int:
    """Returns the heads of a party."""
    left = chance.random()
    for heads, share in model.sizes:
        left -= share
        if left < 0.0:
            return heads
    return model.sizes[-1][0]
