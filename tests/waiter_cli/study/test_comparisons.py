"""Paired differences: by hand where they are few, by their coverage where they are many."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.sampling import mostly_slow
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.study.comparisons import (
    ENOUGH,
    Comparison,
    Difference,
    Interval,
    bootstrap,
    compare_rows,
)
from waiter_cli.study.study_words import (
    comparison_sentences,
    difference_sentence,
    level_sentences,
)

numpy = pytest.importorskip("numpy")


def row(
    seed: int, agents: int = 1, speed: float = 0.8, status: str = "done", **figures: Any
) -> Any:
    """A row of a store, with figures that are 0 unless given."""
    empty = dict.fromkeys(FIGURES, 0)
    where = {"layout": "bistro", "agents": agents, "speed": speed, "seed": seed, "status": status}
    return {**empty, **where, **figures}


def test_a_difference_is_that_of_the_same_evening() -> None:
    lost = {1: (9, 7), 2: (3, 2), 3: (14, 11), 4: (6, 5), 5: (8, 6), 6: (0, 0)}
    rows = [row(s, 1, lost_unseated=a) for s, (a, _) in lost.items()]
    rows += [row(s, 2, lost_unseated=b) for s, (_, b) in reversed(lost.items())]
    rows += [row(7, 1, lost_unseated=99), row(8, 2, lost_unseated=99)]
    rows += [row(7, 2, status="failed", lost_unseated=None)]
    (comparison,) = compare_rows(rows)
    assert (comparison.vary, comparison.first, comparison.other) == ("agents", 1, 2)
    assert (comparison.evenings, comparison.left_out) == (6, 2)
    found = {each.figure: each for each in comparison.differences}
    lost_unseated = found["lost_unseated"]
    assert lost_unseated.found is not None and lost_unseated.found.mean == -1.5
    assert lost_unseated.verdict == "less" and found["served"].verdict == "same"
    told = list(comparison_sentences(comparison))
    low, high = lost_unseated.found.low, lost_unseated.found.high
    assert low is not None and high is not None and -3 <= low < -1.5 < high < 0
    assert told[0] == (
        "With a second robot 1.5 parties fewer leave unseated an evening "
        f"({-high:.1f} to {-low:.1f})."
    )
    assert told[-1] == "2 evenings are left out of this: a run of the pair is not done."


def test_what_agrees_in_all_else_is_a_pair() -> None:
    rows = [
        row(seed, agents, speed, metres=100 * seed + 10 * agents + speed)
        for seed in range(1, 7) for agents in (1, 2) for speed in (0.5, 1.0)
    ]  # fmt: skip
    agents, speed = compare_rows(rows)
    for comparison, exact in ((agents, 10.0), (speed, 0.5)):
        found = {each.figure: each.found for each in comparison.differences}["metres"]
        assert found is not None and found.evenings == 6
        assert (found.mean, found.low, found.high) == pytest.approx((exact, exact, exact))


def test_what_the_data_do_not_support_is_said() -> None:
    waits = [(100, 160), (200, 130), (150, 170), (90, 60), (300, 310), (40, 35)]
    rows = []
    for seed, (a, b) in enumerate(waits):
        rows += [row(seed, 1, wait_seat_mean=a), row(seed, 2, wait_seat_mean=b)]
    (comparison,) = compare_rows(rows)
    wait = next(each for each in comparison.differences if each.figure == "wait_seat_mean")
    assert wait.verdict == "unsupported"
    said = difference_sentence(comparison, wait)
    assert said.startswith(
        "With a second robot, the data do not say whether the mean wait for a table is longer or "
        "shorter ("
    )
    assert "seconds shorter to " in said and said.endswith(" seconds longer).")


def test_several_that_are_not_known_stand_in_one_sentence() -> None:
    waits = [(100, 160), (200, 130), (150, 170), (90, 60), (300, 310), (40, 35)]
    rows = []
    for seed, (a, b) in enumerate(waits):
        rows += [row(seed, 1, wait_seat_mean=a, metres=a), row(seed, 2, wait_seat_mean=b, metres=b)]
    (comparison,) = compare_rows(rows)
    (told,) = (s for s in comparison_sentences(comparison) if "do not say" in s)
    begin = (
        "With a second robot, the data do not say which way these go: the mean wait for a table ("
    )
    assert told.startswith(begin) and " seconds longer); metres driven (" in told
    assert told.endswith(" metres more).") and told.count("the data") == 1


def test_an_end_that_is_not_nothing_does_not_read_so() -> None:
    found = Interval(0.31, 0.04, 0.71, 9)
    comparison = Comparison("agents", 1, 2, 9, 0, (Difference("served", found, "more"),))
    assert list(comparison_sentences(comparison)) == [
        "With a second robot 0.31 parties more are served an evening (0.04 to 0.71)."
    ]


def test_a_mean_has_the_unit_of_its_interval() -> None:
    rows = [row(s, wait_seat_mean=w) for s, w in enumerate((60, 75, 90, 105, 110, 94))]
    told = list(level_sentences(rows))
    assert told[1].startswith("A party waits 1.5 minutes for its table (1.")
    rows = [row(s, wait_seat_mean=60) for s in range(6)]
    assert list(level_sentences(rows))[1] == "A party waits 60 seconds for its table."


def test_what_is_the_same_each_evening_is_said_so() -> None:
    rows = [row(s, agents, lost_unseated=s + agents) for s in range(6) for agents in (1, 2)]
    (comparison,) = compare_rows(rows)
    assert next(comparison_sentences(comparison)) == (
        "With a second robot 1.0 parties more leave unseated an evening (as much each evening)."
    )


def test_few_evenings_have_no_interval() -> None:
    rows = [row(s, agents, lost_unseated=agents) for s in range(ENOUGH - 1) for agents in (1, 2)]
    (comparison,) = compare_rows(rows)
    assert {each.verdict for each in comparison.differences} == {"too_few"}
    assert list(comparison_sentences(comparison)) == [
        "With a second robot: 4 evenings have a run of either that is done; an interval takes 5."
    ]


@pytest.mark.parametrize("count", mostly_slow([6, 12, 40], 12))
def test_intervals_hold_the_mean_as_often_as_they_say(count: int) -> None:
    """Differences of counts, and skewed ones; 95 % of 400, less what chance takes."""
    chance = numpy.random.default_rng(count)
    for draw, mean in (
        (lambda: chance.poisson(3, count) - chance.poisson(2, count), 1.0),
        (lambda: chance.normal(2.0, 5.0, count), 2.0),
    ):
        held = 0
        for _ in range(400):
            found = bootstrap([float(value) for value in draw()])
            assert found is not None and found.low is not None and found.high is not None
            held += found.low <= mean <= found.high
        assert held >= 400 * (0.90 if count < 12 else 0.915)


def test_equal_values_give_equal_intervals() -> None:
    values = [1.0, 4.0, 2.0, 8.0, 5.0, 7.0]
    assert bootstrap(values) == bootstrap(values)
    assert bootstrap([]) is None
