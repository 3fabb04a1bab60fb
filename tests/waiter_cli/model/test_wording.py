"""Goals, actions and counts in words."""

from __future__ import annotations

import pytest

from tests.support.rule_cases import LED, act, at
from waiter_cli.model.state import Goal
from waiter_cli.model.wording import describe, goal_text


@pytest.mark.parametrize(
    ("goal", "text"),
    [
        (Goal("seated", party=LED), "seated: [c1, c2]"),
        (Goal("seated", party=LED, table="big"), "seated: {party: c1, table: big}"),
        (Goal("filled", table="big", item="jug"), "filled: {big: jug}"),
        (Goal("at", node="b"), "at: b"),
    ],
)
def test_goals_are_said_as_a_scenario_writes_them(goal: Goal, text: str) -> None:
    assert goal_text(goal) == text


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("go_to(agent,b)", "walk from a to b"),
        ("pick(agent,c1)", "ask the party of c1 (2) to follow"),
        ("seat(agent,c2,big)", "seat the party of c1 (2) at big"),
        ("pick(agent,c9)", "ask c9 to follow"),
        ("give_bill(agent,big)", "give big its bill"),
        ("take_order(agent,big)", "take the order of big"),
        ("send_order(agent,big)", "send the order of big to the kitchen"),
        ("take_up(agent,jug,big)", "take up the jug for big"),
        ("bring(agent,jug,big)", "bring the jug to big"),
        ("refill(agent,jug,big)", "take the empty jug of big along"),
        ("bring_chairs(agent,big,3)", "bring chairs: big now has 3"),
        ("greet(agent,c1)", "greet(agent,c1)"),
    ],
)
def test_an_action_in_words(text: str, words: str) -> None:
    assert describe(act(text), at("a", with_agent=LED)) == words
