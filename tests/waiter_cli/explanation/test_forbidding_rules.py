"""Rules of a domain that only forbid, those that permit, and the domain without them."""

from __future__ import annotations

from sparc.syntax.parser import parse
from tests.support.own_domains import dirty_domain
from tests.support.planning import scenario
from waiter_cli.encoding.template import fill_template
from waiter_cli.explanation.forbidding_rules import (
    forbidding_rules,
    permitting_rules,
    without_rules,
)

RULE = ":- occurs(pick(agent, C), I), holds(isdirty(T), I), #step(I)."
DOMAIN = dirty_domain("% A dirty room has no guests.", RULE)
PROBLEM = scenario("b1")


def test_a_constraint_of_ones_own_forbids_and_has_its_sentence_and_place() -> None:
    (found,) = [rule for rule in forbidding_rules(PROBLEM, DOMAIN) if "isdirty" in rule.text]
    assert found.text == f"{RULE} (A dirty room has no guests)"
    line = DOMAIN.template.text.split("\n").index(RULE) + 1
    assert str(found.where) == f"dirty.sparc:{line}:1"


def test_what_says_that_goals_have_to_hold_is_not_to_blame() -> None:
    assert not [rule for rule in forbidding_rules(PROBLEM, DOMAIN) if "success" in rule.text]


def test_rules_of_effects_neither_forbid_nor_permit() -> None:
    both = (*forbidding_rules(PROBLEM, DOMAIN), *permitting_rules(PROBLEM, DOMAIN))
    assert not [rule for rule in both if rule.text.startswith("holds(")]


def test_what_permits_is_relaxed_to_its_head() -> None:
    rules = permitting_rules(PROBLEM, DOMAIN)
    text = DOMAIN.template.text
    for rule in rules:
        assert rule.instead == "." and text[rule.start : rule.end].lstrip().startswith(":-")
        assert text[rule.end - 1] == "."


def test_without_a_rule_every_other_line_is_where_it_was() -> None:
    every = (*forbidding_rules(PROBLEM, DOMAIN), *permitting_rules(PROBLEM, DOMAIN))
    assert every
    for rule in every:
        before = DOMAIN.template.text.split("\n")
        after = without_rules(DOMAIN, [rule]).template.text.split("\n")
        assert len(after) == len(before) and after != before
        changed = [k for k, (a, b) in enumerate(zip(before, after)) if a != b]
        assert changed[0] >= rule.place.line - 1
    less = without_rules(DOMAIN, every)
    program = parse(fill_template(less.template, PROBLEM, 1))
    whole = parse(fill_template(DOMAIN.template, PROBLEM, 1))
    gone = sum(not rule.instead for rule in every)
    assert len(program.statements) == len(whole.statements) - gone
    left = {rule.text for rule in forbidding_rules(PROBLEM, less)}
    assert not left & {rule.text for rule in every}
