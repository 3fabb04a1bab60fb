"""States of scenarios, completed from the layout, with the places of what they say."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.reading import reading
from tests.support.rule_cases import HALL, JUG, LED, ONE, PLATE
from waiter_cli.errors import Where
from waiter_cli.files.names import Names
from waiter_cli.files.state_reader import read_state, state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Robot, State

EMPTY = State("a", waiters=(("w", "c"),), chairs=(("big", 4), ("small", 2)))


def read(text: str, layout: Layout = HALL) -> tuple[State, dict[str, Where], list[str]]:
    (state, places), told = reading(
        text, lambda reader, node: read_state(reader, node, Names(layout))
    )
    return state, places, told


def test_without_a_state_the_restaurant_is_empty() -> None:
    assert state_of_layout(HALL)[0] == EMPTY
    timed = replace(HALL, timetable=(("w", 0, "b"),))
    assert state_of_layout(timed)[0].waiters == (("w", "b"),)
    several = replace(HALL, agents=(("r", "a"), ("s", "b")))
    assert state_of_layout(several)[0].robots == (Robot("r", "a"), Robot("s", "b"))


@pytest.mark.parametrize(
    ("text", "state"),
    [
        ("{agent: b}", replace(EMPTY, agent="b")),
        ("{waiters: {w: e}}", replace(EMPTY, waiters=(("w", "e"),))),
        ("{seated: {big: [c1]}}", replace(EMPTY, seated=ONE)),
        ("{waiting: [[c1, c2]]}", replace(EMPTY, waiting=(LED,))),
        ("{with_agent: [c1, c2]}", replace(EMPTY, with_agent=LED)),
        (
            "{seated: {big: [c1]}, wants_bill: [big]}",
            replace(EMPTY, seated=ONE, wants_bill=frozenset({"big"})),
        ),
        (
            "{seated: {big: [c1]}, sent: [big], ready: {big: plate}}",
            replace(EMPTY, seated=ONE, sent=frozenset({"big"}), ready=PLATE),
        ),
        ("{empty: {big: jug}}", replace(EMPTY, empty=JUG)),
        ("{carrying: {big: jug}}", replace(EMPTY, carrying=("big", "jug"))),
        ("{chairs: {big: 2}}", replace(EMPTY, chairs=(("big", 2), ("small", 2)))),
    ],
)
def test_what_is_said_is_so_and_all_else_is_the_layouts(text: str, state: State) -> None:
    found, _, told = read(text)
    assert (found, told) == (state, [])


def test_places_are_kept_for_what_is_said() -> None:
    _, places, _ = read("seated: {big: [c1, c2]}\nwants_bill: [big]\nempty: {big: jug}\n")
    lines = {key: where.line for key, where in places.items()}
    assert lines["party.c1"] == 1 and lines["wants_bill.big"] == 2 and lines["empty.big.jug"] == 3


@pytest.mark.parametrize(
    "text",
    [
        "{agent: z}", "{agent: c}", "{seated: {big: [c1], small: [c1]}}", "{chairs: {small: 3}}",
        "{waiting: [[c1], [c1]]}", "{wants_bill: [bigg]}", "{carrying: {big: jug, small: jug}}",
        "{seated: {small: [c1, c2, c3]}}", "{nothing: 1}", "{ready: {big: spoon}}",
    ],
)  # fmt: skip
def test_what_cannot_be_is_a_fault_at_its_place(text: str) -> None:
    _, _, told = read(text)
    assert told and all(fault.startswith("1:") for fault in told)


def test_without_a_bar_nothing_is_served() -> None:
    _, _, told = read("{sent: [big]}", replace(HALL, bar=None, objects=()))
    assert told[0].endswith("sent needs a bar, and the layout has none")
