"""What a problem says of itself: all its goals, and whether it speaks its domain's own words."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import START, posed
from waiter_cli.model.state import Fact, Goal, Observation

BILL, DOOR, BAR = Goal("paid", table="big"), Goal("at", node="e"), Goal("at", node="a")


def test_goals_that_only_an_order_names_come_after_the_others_and_once() -> None:
    problem = posed(START, DOOR, BILL, before=((BILL, BAR), (BAR, DOOR)))
    assert problem.all_goals() == (DOOR, BILL, BAR)


def test_goals_alone_are_all_goals() -> None:
    assert posed(START, DOOR).all_goals() == (DOOR,)


@pytest.mark.parametrize(
    "changes",
    [
        {"facts": (Fact("dirty(big)"),)},
        {"state": replace(START, fluents=("dirty(big)",))},
        {"before_observations": replace(START, fluents=("dirty(big)",))},
        {"observations": (Observation("obs", ("spilled(big)",)),)},
        {"goals": (Goal("holds", fluent="dirty(big)"),)},
        {"before": ((DOOR, Goal("holds_not", fluent="dirty(big)")),)},
    ],
    ids=["fact", "state", "before", "seen", "goal", "order"],
)
def test_words_of_its_own_are_found_wherever_they_stand(changes: dict[str, object]) -> None:
    plain = posed(START, DOOR)
    assert not plain.has_own_words
    assert replace(plain, **changes).has_own_words  # type: ignore[arg-type]


def test_what_every_restaurant_knows_is_no_word_of_its_own() -> None:
    seen = (Observation("enter", ("c1",)),)
    assert not replace(posed(START, BILL, before=((BILL, BAR),)), observations=seen).has_own_words
