"""What may stand in the way of a plan, and what a person could do about it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.exhaustive import shortest
from tests.support.rule_cases import HALL, ONE, at, posed
from tests.support.small_worlds import small_problem
from waiter_cli.explanation.causes_and_changes import KINDS, causes_of, changes_for, without
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Fact, Goal, Observation

BILL = Goal("paid", table="big")
FULL = at("e", seated=ONE, waiting=(("c5", "c6", "c7", "c8", "c9"),))


def causes(problem: Problem) -> dict[str, list[str]]:
    """The sentences of the causes by kind."""
    found: dict[str, list[str]] = {}
    for cause in causes_of(problem):
        found.setdefault(cause.kind, []).append(cause.message)
    return found


def changes(problem: Problem) -> dict[str, str]:
    return {change.message: change.kind for change in changes_for(problem)}


def test_whatever_may_stand_in_the_way_is_a_cause() -> None:
    order = (BILL, Goal("at", node="e"))
    one_way = replace(HALL, one_way=frozenset({("e", "d")}))
    problem = posed(FULL, BILL, before=(order,), layout=one_way)
    found = causes(problem)
    assert found["waiter"] == ["w stands at c"]
    assert found["size"] == ["big seats 4", "small seats 2"]
    assert len(found["order"]) == len(found["goal"]) == len(found["one_way"]) == 1
    assert any("c1" in told for told in found["party"])
    assert set(found) <= set(KINDS)


def test_a_restaurant_that_is_empty_has_no_cause_but_its_staff() -> None:
    assert causes(posed(at("a"))) == {"waiter": ["w stands at c"]}


def test_each_cause_takes_itself_away() -> None:
    order = (BILL, Goal("at", node="e"))
    problem = posed(FULL, BILL, before=(order,))
    for cause in causes_of(problem):
        changed = without(problem, [cause])
        if cause.kind == "party":  # nobody is sent away: a free twin stands beside the table
            assert [table.name for table in changed.layout.tables][-1] == "big_free"
        else:
            assert cause.message not in causes(changed).get(cause.kind, [])


@pytest.mark.parametrize("seed", range(0, 60, 4))
def test_a_plan_stays_one_whatever_is_taken_away(seed: int) -> None:
    problem = small_problem(seed)
    if problem.contradictions:
        return
    least = shortest(problem).length
    for cause in causes_of(problem):
        relaxed = shortest(without(problem, [cause])).length
        assert least is None or (relaxed is not None and relaxed <= least), cause.message


def test_several_are_taken_away_in_any_order() -> None:
    problem = posed(FULL, BILL)
    every = list(causes_of(problem))
    assert without(problem, every) == without(problem, every[::-1])
    assert not without(problem, every).goals


def test_a_waiter_steps_aside_where_nobody_stands() -> None:
    found = changes(posed(at("b"), Goal("at", node="c")))
    assert "if w stood at a instead of c" in found
    assert "if w stood at b instead of c" not in found, "the robot stands there"


def test_a_bill_may_be_asked_for() -> None:
    assert changes(posed(at("b", seated=ONE), BILL))["if big asked for its bill"] == "bill big"
    assert "if big asked for its bill" not in changes(
        posed(at("b", seated=ONE, wants_bill="big"), BILL)
    )


def test_tables_may_be_larger_or_free() -> None:
    found = changes(posed(FULL, Goal("seated", party=("c5", "c6", "c7", "c8", "c9"))))
    assert found["if big seated 5"] == "size big" and found["if small seated 5"] == "size small"
    assert found["if c1 left big"] == "free big"


def test_what_cannot_be_reached_may_be_joined() -> None:
    cut = replace(HALL, edges=HALL.edges[:2])
    found = changes(posed(at("a"), Goal("at", node="e"), layout=cut))
    assert "if there were an edge [a, d]" in found
    assert not any("an edge" in told for told in changes(posed(at("a"))))


def test_words_of_ones_own_may_be_left_out() -> None:
    problem = posed(replace(at("a"), fluents=("dirty(big)",)))
    problem = replace(
        problem, facts=(Fact("open(big)"),), observations=(Observation("obs", ("spilled(big)",)),)
    )
    found = changes(problem)
    assert "if dirty(big) did not hold at the start" in found
    assert "without the fact open(big)" in found and "if spilled(big) had not been seen" in found


def test_each_wish_may_be_dropped() -> None:
    goals = (BILL, Goal("at", node="e"))
    dropped = [c.problem.goals for c in changes_for(posed(FULL, *goals)) if c.kind == "goal"]
    assert dropped == [goals[1:], goals[:1]]
