"""Figures of an evening, computed by hand."""

from __future__ import annotations

import pytest

from waiter_cli.evenings.draws import Visit
from waiter_cli.evenings.evening import Stay
from waiter_cli.evenings.measures import FIGURES, figures_of, quantile


def stay(heads: int, **times: object) -> Stay:
    visit = Visit(0, 0.0, heads, 0.0, 0.0, 0.0, 0.0)
    return Stay(visit, ("c1",), 0.0, **times)  # type: ignore[arg-type]


def test_the_figures_of_three_parties() -> None:
    stays = [
        stay(2, seated=100.0, table="t1", hungry=200.0, taken=230.0, served=500.0, calls=800.0,
             paid=860.0, left=900.0),
        stay(3, seated=300.0, table="t2", left=700.0, lost="unserved"),
        stay(4, left=720.0, lost="unseated"),
    ]  # fmt: skip
    found = figures_of(stays, 1000.0, 3, metres=12.3456, idle=0.25, late=1)
    assert list(found) == list(FIGURES)
    assert (found["parties"], found["guests"], found["served"]) == (3, 9, 1)
    assert (found["lost"], found["lost_unseated"], found["lost_unserved"]) == (2, 1, 1)
    assert (found["wait_seat_mean"], found["wait_seat_p50"]) == (200.0, 200.0)
    assert found["wait_seat_p95"] == 290.0
    assert (found["wait_order_mean"], found["wait_plate_mean"]) == (30.0, 270.0)
    assert found["wait_bill_mean"] == 60.0
    assert found["table_use"] == 0.4  # (800 + 400) of 3000 seconds
    assert (found["metres"], found["idle"], found["late"]) == (12.346, 0.25, 1)


def test_a_wait_that_nobody_had_is_none() -> None:
    found = figures_of([], 1000.0, 3, metres=0.0, idle=1.0, late=0)
    assert found["wait_seat_mean"] is None and found["table_use"] == 0.0


def test_whoever_still_sits_takes_the_table_to_the_end() -> None:
    found = figures_of([stay(1, seated=400.0)], 1000.0, 1, metres=0.0, idle=1.0, late=0)
    assert found["table_use"] == 0.6


@pytest.mark.parametrize(("share", "value"), [(0.0, 1.0), (0.5, 3.0), (0.25, 2.0), (1.0, 10.0)])
def test_quantiles_lie_between_ranks(share: float, value: float) -> None:
    assert quantile([10.0, 3.0, 1.0, 2.0, 4.0], share) == value
