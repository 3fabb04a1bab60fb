"""Reasons in the user's terms: who bars the way, and the places in files that they come from."""

from __future__ import annotations

from dataclasses import replace

from tests.support.hall import HALL, posed
from waiter_cli.bounds.distances import standing
from waiter_cli.bounds.reasons import (
    Barriers,
    party_text,
    place_of_bill,
    place_of_goal,
    place_of_party,
    place_of_waiter,
    state_place,
)
from waiter_cli.errors import Where
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Observation, State

WHERE = [Where("s.yaml", line, 1) for line in range(9)]


def barriers(**waiters: str) -> Barriers:
    layout = replace(HALL, waiters=tuple(waiters.items()))
    state = State("a", waiters=layout.waiters)
    problem = Problem(layout, state, (), state, ())
    return Barriers(problem, standing(problem))


def messages(found: Barriers, what: str, *nodes: str) -> list[str]:
    return [reason.message for _, reason in found.before(what, nodes, None)]


def test_parties_in_words() -> None:
    assert party_text(("c1",)) == "c1"
    assert party_text(("c1", "c2")) == "a party of 2 (c1 …)"


def test_who_stands_in_the_way_is_named() -> None:
    assert messages(barriers(), "node e", "e") == []
    assert messages(barriers(w="d"), "node e", "e") == [
        "node e can be reached only through d, where w stands"
    ]
    assert messages(barriers(w="e"), "node e", "e") == ["w stands on node e"]
    assert messages(barriers(w="d"), "table small", "d") == [
        "w stands on d, the only place from which table small can be reached"
    ]


def test_each_smallest_group_by_itself() -> None:
    found = barriers(v="b", w="d").before("node e", ["e"], None)
    assert [group for group, _ in found] == [("w",), ("v",)] or [g for g, _ in found] == [
        ("v",),
        ("w",),
    ]


def test_where_no_path_leads_nobody_is_blamed() -> None:
    problem = replace(posed(State("a")), layout=replace(HALL, edges=(("b", "c"),)))
    found = Barriers(problem, standing(problem))
    assert messages(found, "the bar", "b") == ["no path of edges leads from a to the bar (b)"]
    assert messages(found, "node e", "e") == ["no path of edges leads from a to node e"]


def test_the_place_of_a_waiter_is_that_of_what_was_said_last() -> None:
    layout = replace(
        HALL, waiters=(("w", "d"),), key_where=(("waiters", WHERE[1]), ("waiters.w", WHERE[2]))
    )
    state = State("a", waiters=layout.waiters)
    problem = Problem(layout, state, (), state, ())
    assert place_of_waiter(problem, "w") == WHERE[2]
    assert place_of_waiter(problem, "v") == WHERE[1]
    told = replace(problem, state_where=(("waiters.w", WHERE[3]),))
    assert place_of_waiter(told, "w") == WHERE[3]
    seen = Observation("at", ("w", "d"), where=WHERE[4])
    assert place_of_waiter(replace(told, observations=(seen,)), "w") == WHERE[4]


def test_the_place_of_a_party_and_of_a_goal() -> None:
    state = State(
        "a",
        waiting=(("c1",),),
        with_agent=("c2",),
        seated=(("big", ("c3",)),),
        wants_bill=frozenset({"big"}),
    )
    keys = ("waiting", "with_agent", "seated.big", "wants_bill", "empty.big.jug")
    problem = replace(posed(state), state_where=tuple(zip(keys, WHERE)))
    assert [place_of_party(problem, party) for party in (("c1",), ("c2",), ("c3",))] == WHERE[:3]
    assert place_of_bill(problem, "big") == WHERE[3]
    assert state_place(problem, "nothing", "seated.big") == WHERE[2]
    assert place_of_goal(problem, Goal("paid", table="big")) == WHERE[3]
    assert place_of_goal(problem, Goal("filled", table="big", item="jug")) == WHERE[4]
    assert place_of_goal(problem, Goal("seated", party=("c1",))) == WHERE[0]
    assert place_of_goal(problem, Goal("seated", party=("c1",), where=WHERE[8])) == WHERE[8]
    bill = Observation("bill", ("big",), where=WHERE[5])
    entered = Observation("enter", ("c1",), where=WHERE[6])
    seen = replace(problem, observations=(bill, entered))
    assert place_of_bill(seen, "big") == WHERE[5]
    assert place_of_party(seen, ("c1",)) == WHERE[6]
