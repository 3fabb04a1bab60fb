"""The slots of a template: sorts, the layout, and which optional parts a problem has."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, LED, START, at, posed
from waiter_cli.encoding.slots import PARTS, SITUATION, SLOTS, parts_of
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal


def slot(name: str, problem: Problem, horizon: int = 5) -> list[str]:
    return [line.text for line in SLOTS[name](problem, horizon)]


PLAIN = posed(START)


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        ("steps", ["#step = 0..5."]),
        ("nodes", ["#node = {a, b, c, d, e}."]),
        ("tables", ["#table = {big, small}."]),
        ("employees", ["#employee = {agent, w}."]),
        ("robots", ["robot(agent)."]),
        ("objects", ["#object = {plate, jug, basket}."]),
        ("refillables", ["#refillable = {jug, basket}."]),
        ("numbers", ["#num = 0..4."]),
        ("entrance", ["entrance(e)."]),
        ("bar", ["bar(a)."]),
        ("edges", ["edge(a, b).", "edge(b, c).", "edge(b, d).", "edge(e, d)."]),
        ("one_way", []),
        ("timetable", []),
        ("directives", []),
        ("offer", []),
    ],
)
def test_the_slots_of_a_plain_hall(name: str, lines: list[str]) -> None:
    assert slot(name, PLAIN) == lines


def test_tables_have_their_nodes_and_their_capacity() -> None:
    assert slot("table_facts", PLAIN) == [
        "areassociated(b, big).",
        "areassociated(d, big).",
        "hascapacity(big, 4).",
        "areassociated(d, small).",
        "hascapacity(small, 2).",
    ]


def test_customers_are_those_of_whom_is_spoken_and_no_fewer_than_the_layout_says() -> None:
    assert slot("customers", PLAIN) == ["#customer = {c1}."]
    problem = posed(at("a", waiting=(("anna",),)), Goal("seated", ("ben",)))
    assert slot("customers", problem) == ["#customer = {anna, ben}."]
    more = replace(problem, layout=replace(HALL, customers=3))
    assert slot("customers", more) == ["#customer = {anna, ben, c1}."]


def test_no_sort_is_empty() -> None:
    assert slot("tables", posed(START, layout=replace(HALL, tables=()))) == ["#table = {notable}."]


def test_numbers_reach_as_far_as_anything_that_is_counted() -> None:
    party = tuple(f"c{k}" for k in range(7))
    assert slot("numbers", posed(at("a", waiting=(party,)))) == ["#num = 0..7."]
    assert slot("directives", PLAIN, horizon=3000) == ["#maxint = 3000."]


def test_who_is_due_within_the_horizon_is_told() -> None:
    timed = posed(START, layout=replace(HALL, timetable=(("w", 2, "b"), ("w", 9, "c"))))
    assert slot("timetable", timed) == ["willbe(w, b, 2)."]


def test_parts_are_those_that_the_problem_has() -> None:
    assert parts_of(PLAIN) == {"bar", "objects", "plates", "refillables"}
    assert parts_of(posed(START, layout=replace(HALL, bar=None))) == set()
    rich = replace(
        posed(
            START,
            Goal("chairs", table="big", number=4),
            layout=replace(HALL, timetable=(("w", 2, "b"),), one_way=frozenset({("a", "b")})),
        ),
        before=((Goal("at", node="b"), Goal("at", node="c")),),
        instant_kitchen=True,
    )
    assert parts_of(rich) == set(PARTS) - {"choice", "offer"}
    assert slot("one_way", rich) == ["oneway(a, b)."]
    assert "#order_fluent" in slot("inertial_fluent", rich)[0]


def test_the_slots_of_a_situation_are_slots() -> None:
    assert set(SLOTS) > SITUATION
    assert slot("goal_sort", posed(START, Goal("seated", LED))) == ["#goal = 0..1."]
