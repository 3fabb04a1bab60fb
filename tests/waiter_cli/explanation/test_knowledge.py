"""What is known at each step of a plan, and the sentences of the rules that may give it."""

from __future__ import annotations

from typing import Any

import pytest

import waiter_cli
from tests.support.planning import scenario
from waiter_cli.encoding.domains import find_domain
from waiter_cli.explanation.knowledge import Knowledge, find_knowledge
from waiter_cli.model.plan import Plan
from waiter_cli.translators.native import NativeTranslator


@pytest.fixture(scope="module")
def plan() -> Plan:
    found = waiter_cli.plan(scenario("b4")).plan
    assert found is not None and found.horizon == 1
    return found


@pytest.fixture(scope="module")
def known(plan: Plan) -> Knowledge:
    return find_knowledge(scenario("b4"), plan, find_domain("restaurant"), NativeTranslator())


def rows(known: Knowledge, step: int) -> dict[str, dict[str, Any]]:
    return {row["text"]: row for row in known.at(step)}


def test_the_action_of_the_plan_is_known_at_its_step_only(known: Knowledge, plan: Plan) -> None:
    (action,) = plan.actions
    text = f"occurs({action.text},0)"
    assert text in rows(known, 0) and not any("occurs" in told for told in rows(known, 1))


def test_at_the_start_nothing_is_new(known: Knowledge) -> None:
    assert {row["change"] for row in known.at(0)} == {"same"}


def test_what_an_action_changes_is_new_and_what_it_ends_is_gone(known: Knowledge) -> None:
    found = {row["change"] for row in known.at(1)}
    assert {"same", "new"} <= found <= {"same", "new", "gone"}
    for row in known.at(1):
        step = 0 if row["change"] == "gone" else 1
        assert row["text"].endswith(f",{step})"), row
        assert row["change"] != "gone" or row["sentences"] == []


def test_negative_literals_are_told_as_such(known: Knowledge) -> None:
    for text, row in rows(known, 1).items():
        assert row["negative"] is text.startswith("-")
    assert any(row["negative"] for row in known.at(1))


def test_literals_have_the_sentences_of_their_rules(known: Knowledge, plan: Plan) -> None:
    """An action is chosen by one rule; what it causes has a sentence, and none of another head."""
    (action,) = plan.actions
    told = rows(known, 1)
    caused = [row for row in told.values() if row["change"] == "new" and not row["negative"]]
    assert caused and all(row["sentences"] for row in caused), caused
    heads = {(rule.head.name, rule.head.negated) for rule in known.rules}
    assert ("holds", False) in heads and ("holds", True) in heads
    assert all(rule.sentence for rule in known.rules) and action.name


def test_a_plan_that_cannot_be_carried_out_has_no_answer_set() -> None:
    from tests.support.rule_cases import plan as planned

    found = find_knowledge(
        scenario("b4"), planned("go_to(agent,n99)"), find_domain("restaurant"), NativeTranslator()
    )
    assert found.literals == () and found.at(0) == []
