"""Observations believed one after the other, and those that cannot be left out with their reason."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, JUG, LED, ONE, PLATE, START, at
from waiter_cli.model.state import Observation, Robot, State
from waiter_cli.rules.observations import each_party_once, observe, settle

BIG = frozenset({"big"})


def see(*texts: str) -> tuple[Observation, ...]:
    return tuple(Observation(kind, tuple(rest)) for kind, *rest in map(str.split, texts))


def believed(state: State, *texts: str) -> State:
    after, reasons = observe(state, see(*texts), HALL)
    assert not reasons
    return after


def objections(state: State, *texts: str) -> list[str]:
    return [reason.message for reason in observe(state, see(*texts), HALL)[1]]


@pytest.mark.parametrize(
    ("before", "seen", "after"),
    [
        (at("a"), "enter c1 c2", at("a", waiting=(LED,))),
        (at("a", seated=ONE, paid="big"), "bill big", at("a", seated=ONE, wants_bill="big")),
        (at("a", seated=ONE), "order big", at("a", seated=ONE, ready_to_order="big")),
        (at("a"), "empty big jug", at("a", empty=JUG)),
        (at("a"), "ready big jug", at("a", ready=JUG)),
        (
            at("a", ordered="big", served="big"),
            "ready big plate",
            at("a", ready=PLATE, sent="big"),
        ),
        (at("a"), "at agent b", at("b")),
        (at("a"), "at w e", replace(START, waiters=(("w", "e"),))),
        (at("a", waiting=(LED, ("c3",))), "leave c2", at("a", waiting=(("c3",),))),
        (at("a", with_agent=LED), "leave c1", at("a")),
        (at("a"), "free big", at("a")),
    ],
)
def test_what_is_seen_is_so(before: State, seen: str, after: State) -> None:
    assert believed(before, seen) == after


def test_a_table_whose_party_leaves_is_as_new() -> None:
    before = at(
        "a", seated=ONE, wants_bill="big", ordered="big", sent="big", served="big",
        ready=PLATE, carrying=("big", "plate"), empty=JUG,
    )  # fmt: skip
    assert believed(before, "leave c1") == at("a", empty=JUG)


def test_what_several_robots_hold_of_a_party_goes_with_it() -> None:
    robots = (
        Robot("r", "a", carries=("big", "plate"), orders=BIG),
        Robot("s", "d", leads=("c3",)),
    )
    before = at("a", seated=ONE, robots=robots)
    assert [r.carries for r in believed(before, "leave c1").robots] == [None, None]
    assert [r.orders for r in believed(before, "leave c1").robots] == [frozenset(), frozenset()]
    assert [r.leads for r in believed(before, "leave c3").robots] == [(), ()]
    assert believed(before, "at s b").stations() == {"r": "a", "s": "b"}


@pytest.mark.parametrize(
    ("state", "seen", "reason"),
    [
        (at("a", waiting=(LED,)), "enter c2", "c2 enters, but is inside already: waiting at the entrance"),
        (at("a", seated=ONE), "enter c1", "c1 enters, but is inside already: at big"),
        (at("a", with_agent=LED), "enter c1", "c1 enters, but is inside already: with the robot"),
        (at("a"), "leave c1", "c1 leaves, but is not inside"),
        (at("a"), "order big", "big is ready to order, but nobody sits there"),
        (at("a", seated=ONE), "free big", "big is seen free, but c1 should sit there"),
        (
            at("a", carrying=("big", "jug")),
            "empty big jug",
            "the jug of big is seen empty there, but the robot carries it",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_is_left_out(state: State, seen: str, reason: str) -> None:
    assert objections(state, seen) == [reason]
    assert observe(state, see(seen), HALL)[0] == state


def test_a_party_that_leaves_is_told_of_once() -> None:
    state = at("a", waiting=(LED,))
    assert [o.arguments for o in each_party_once(see("leave c1", "leave c2"), state)] == [("c1",)]
    again = see("leave c1", "enter c2", "leave c2")
    assert len(each_party_once(again, state)) == 3


def test_no_two_stand_on_one_node() -> None:
    assert len(objections(at("a"), "at w a")) == 1
    assert objections(at("a"), "at w b", "at agent c") == []  # they change places


def test_what_is_carried_empty_fills_at_the_bar() -> None:
    state = at("a", empty=JUG, carrying=("big", "jug"))
    assert not settle(state, HALL).empty
    assert settle(state, replace(HALL, bar=None)) == state
    assert settle(replace(state, agent="b"), HALL).empty == JUG
