"""A plan is found, checked by the rules in plain Python or by its domain, and explained."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.own_domains import dirty_domain
from tests.support.planning import scenario
from tests.support.rule_cases import ONE, at, plan, posed
from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal
from waiter_cli.planning import planner
from waiter_cli.planning.answer import PlanAnswer
from waiter_cli.planning.planner import explained, find_plan
from waiter_cli.planning.search_results import (
    InvalidPlanError,
    SearchOptions,
    SearchResult,
    SearchStatus,
)
from waiter_cli.translators.native import NativeTranslator

PROBLEM = posed(at("b", seated=ONE, wants_bill="big"), Goal("paid", table="big"))
HOUSE = find_domain("restaurant")


def answered(problem: Problem, domain: object = HOUSE) -> PlanAnswer:
    return find_plan(problem, NativeTranslator(), domain, SearchOptions())  # type: ignore[arg-type]


def test_a_plan_comes_with_the_states_it_passes_through() -> None:
    answer = answered(PROBLEM)
    assert answer.plan is not None and answer.validated
    assert len(answer.states) == answer.plan.horizon + 1 == 2
    assert answer.states[0] == PROBLEM.state and answer.states[-1].paid == {"big"}
    assert answer.translator == "native"


def test_where_there_is_none_there_are_reasons_and_no_states() -> None:
    answer = answered(scenario("blocked_aisle"))
    assert answer.plan is None and answer.states == () and answer.result.reasons


def test_a_plan_that_the_rules_refuse_is_a_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = SearchResult(SearchStatus.PLAN, (1, 1), "binary", plan("go_to(agent,e)"), minimal=True)
    monkeypatch.setattr(planner, "find_minimal_plan", lambda *_: wrong)
    with pytest.raises(InvalidPlanError, match=r"go_to\(agent,e\).*refused by the validator"):
        answered(PROBLEM)


def test_a_domain_of_ones_own_plays_its_plan_itself() -> None:
    answer = answered(PROBLEM, dirty_domain())
    assert answer.validated and answer.states[-1].paid == {"big"}
    assert answer.start == answer.states[0]


def test_a_plan_that_its_own_domain_refuses_is_told_not_raised(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    wrong = SearchResult(SearchStatus.PLAN, (1, 1), "binary", plan("go_to(agent,e)"), minimal=True)
    monkeypatch.setattr(planner, "find_minimal_plan", lambda *_: wrong)
    answer = answered(PROBLEM, dirty_domain())
    assert not answer.validated and answer.refusal and answer.states == ()


def test_surprises_are_explained_where_that_was_settled() -> None:
    assert explained(answered(PROBLEM)).diagnosis == (), "nothing was observed"
    seen = scenario("b2")
    answer = answered(seen)
    undecided = replace(answer, result=replace(answer.result, status=SearchStatus.UNDECIDED))
    assert explained(undecided) is undecided
    own = replace(answer, domain=dirty_domain())
    assert explained(own) is own
