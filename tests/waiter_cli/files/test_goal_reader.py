"""Observations and goals as scenarios, lines and options write them."""

from __future__ import annotations

import pytest

from tests.support.reading import reading
from tests.support.rule_cases import HALL, LED
from waiter_cli.files.goal_reader import (
    GOALS,
    OBSERVATIONS,
    read_before,
    read_goals,
    read_observations,
    unknown_customer,
)
from waiter_cli.files.names import Names
from waiter_cli.model.state import Goal, Observation


def names() -> Names:
    found = Names(HALL)
    found.adopt("customer", ["c1", "c2"])
    return found


@pytest.mark.parametrize(
    ("text", "seen"),
    [
        ("enter: [c1, c2]", [("enter", LED)]),
        ("leave: c1", [("leave", ("c1",))]),
        ("bill: big", [("bill", ("big",))]),
        ("order: big", [("order", ("big",))]),
        ("at: {w: e}", [("at", ("w", "e"))]),
        ("ready: {big: jug}", [("ready", ("big", "jug"))]),
        ("empty: {big: jug}", [("empty", ("big", "jug"))]),
        ("free: big", [("free", ("big",))]),
        ("[{bill: big}, {order: small}]", [("bill", ("big",)), ("order", ("small",))]),
    ],
)
def test_what_is_seen(text: str, seen: list[tuple[str, tuple[str, ...]]]) -> None:
    found, told = reading(text, lambda reader, node: read_observations(reader, node, names()))
    assert found == tuple(Observation(kind, arguments) for kind, arguments in seen) and not told
    assert all(each.where is not None for each in found)


@pytest.mark.parametrize(
    ("text", "goal"),
    [
        ("seated: [c1, c2]", Goal("seated", LED)),
        ("seated: {party: [c1, c2], table: big}", Goal("seated", LED, table="big")),
        ("paid: big", Goal("paid", table="big")),
        ("paid: c1", Goal("paid", ("c1",))),
        ("at: b", Goal("at", node="b")),
        ("ordered: big", Goal("ordered", table="big")),
        ("served: big", Goal("served", table="big")),
        ("served: {big: jug}", Goal("served", table="big", item="jug")),
        ("filled: {big: jug}", Goal("filled", table="big", item="jug")),
        ("chairs: {big: 4}", Goal("chairs", table="big", number=4)),
        ("serve: c1", Goal("serve", ("c1",))),
        ("holds: on(a, b)", Goal("holds", fluent="on(a,b)")),
    ],
)
def test_what_is_wanted(text: str, goal: Goal) -> None:
    found, told = reading(f"- {text}\n", lambda reader, node: read_goals(reader, node, names()))
    assert found == (goal,) and not told and found[0].where is not None


def test_pairs_in_their_order() -> None:
    found, told = reading(
        "- [{paid: big}, {at: b}]\n", lambda reader, node: read_before(reader, node, names())
    )
    assert not told
    assert found == ((Goal("paid", table="big"), Goal("at", node="b")),)


@pytest.mark.parametrize("kind", ["observation", "goal"])
@pytest.mark.parametrize("text", ["[{}]", "[{fly: big}]", "[{at: z}]", "[{served: {big: spoon}}]"])
def test_what_cannot_be_is_a_fault_at_its_place(kind: str, text: str) -> None:
    read = read_goals if kind == "goal" else read_observations
    _, told = reading(text, lambda reader, node: read(reader, node, names()))
    assert len(told) == 1 and told[0].startswith("1:")


def test_two_goals_in_one_are_told() -> None:
    _, told = reading(
        "- {paid: big, at: b}\n", lambda reader, node: read_goals(reader, node, names())
    )
    assert told == ["1:3: 2 goals in one"]


def test_the_kinds_are_those_of_the_documentation() -> None:
    assert OBSERVATIONS[:3] == ("enter", "leave", "bill") and GOALS[-2:] == ("holds", "holds_not")


@pytest.mark.parametrize(
    ("goal", "name", "fault", "hint"),
    [
        (Goal("paid"), "bigg", "unknown table or customer bigg", "did you mean big?"),
        (Goal("seated"), "c3", "unknown customer c3", "known: c1, c2"),
        (Goal("seated"), "smal", "unknown customer smal", "if a table is meant: "),
    ],
)
def test_a_party_that_is_not_inside(goal: Goal, name: str, fault: str, hint: str) -> None:
    message, mend = unknown_customer(goal, name, ["c1", "c2"], ["big", "small"])
    assert message == fault and mend.startswith(hint)
