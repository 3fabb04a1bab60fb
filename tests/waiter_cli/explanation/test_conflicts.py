"""Minimal sets of causes that leave no plan, found with a judge that knows which sets those are."""

from __future__ import annotations

import pytest

from tests.support.rule_cases import ONE, at, posed
from waiter_cli.encoding.domains import Domain, find_domain
from waiter_cli.explanation.causes_and_changes import causes_of
from waiter_cli.explanation.conflicts import find_conflicts
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal

WAITER, BIG, SMALL = "w stands at c", "big seats 4", "small seats 2"
PROBLEM = posed(
    at("e", seated=ONE, waiting=(("c5", "c6", "c7", "c8", "c9"),)),
    Goal("paid", table="big"), Goal("at", node="e"),
)  # fmt: skip
BILL = next(c.message for c in causes_of(PROBLEM) if c.kind == "goal")


class Invented:
    """There is no plan as long as all causes of one of the sets are there."""

    def __init__(self, *sets: set[str], patience: int = 1000) -> None:
        self.sets, self.patience, self.undecided = sets, patience, False

    def solvable(self, problem: Problem, domain: Domain) -> bool:
        self.patience -= 1
        self.undecided = self.patience < 0
        there = {cause.message for cause in causes_of(problem)}
        return not any(needed <= there for needed in self.sets)


def told(judge: Invented) -> list[set[str]]:
    found = find_conflicts(PROBLEM, find_domain("restaurant"), judge)
    assert all(len({cause.message for cause in causes}) == len(causes) for causes in found)
    return [{cause.message for cause in causes} for causes in found]


@pytest.mark.parametrize("needed", [{WAITER}, {WAITER, BILL}, {BIG, SMALL, BILL}])
def test_one_set_is_found_to_its_last_cause(needed: set[str]) -> None:
    assert told(Invented(needed)) == [needed]


def test_sets_that_share_nothing_are_each_found() -> None:
    first, second = {WAITER}, {BIG, BILL}
    assert sorted(told(Invented(first, second)), key=len) == [first, second]


def test_sets_that_share_a_cause_are_each_found() -> None:
    found = told(Invented({WAITER, BIG}, {WAITER, SMALL}))
    assert found[0] != found[1] and all(WAITER in causes for causes in found)


def test_where_there_is_a_plan_there_is_no_conflict() -> None:
    assert told(Invented({"nothing of the kind"})) == []


def test_a_judge_who_gives_up_ends_the_search() -> None:
    judge = Invented({WAITER}, {BIG}, patience=3)
    assert len(told(judge)) <= 1 and judge.undecided
