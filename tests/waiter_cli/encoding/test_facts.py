"""State, observations and goals as lines of SPARC, each with its place in the user's files."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, JUG, LED, ONE, PLATE, START, at, posed
from waiter_cli.encoding.facts import (
    ProgramLine,
    bills_seen,
    entered,
    goal_facts,
    guest_goals,
    guest_state,
    has_chairs,
    objects_of,
    observation_facts,
    refillables_of,
    state_facts,
)
from waiter_cli.encoding.slots import parts_of
from waiter_cli.errors import InputError, Where
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Observation, Robot, State

HERE = Where("s.yaml", 4, 2)


def texts(lines: list[ProgramLine]) -> set[str]:
    return {line.text for line in lines}


def seen(state: State, *observations: Observation) -> Problem:
    return replace(posed(state), observations=observations)


def test_the_state_is_what_holds_at_step_0() -> None:
    state = at(
        "b", seated=ONE, waiting=(LED,), wants_bill="big", ordered="small", sent="big",
        ready=PLATE, empty=JUG, carrying=("small", "plate"),
    )  # fmt: skip
    assert texts(state_facts(posed(state))) == {
        "holds(currentlocation(agent, b), 0).",
        "holds(currentlocation(w, c), 0).",
        "leader(c1).",
        "holds(aretogether(c1, c2), 0).",
        "holds(isattable(c1, big), 0).",
        "holds(iswaiting(c1), 0).",
        "holds(wantsbill(big), 0).",
        "holds(hasorder(agent, small), 0).",
        "holds(issent(big), 0).",
        "holds(isready(plate, big), 0).",
        "holds(isempty(jug, big), 0).",
        "holds(iscarrying(agent, plate, small), 0).",
    }


def test_what_is_carried_empty_to_the_bar_is_full() -> None:
    state = at("a", empty=JUG, carrying=("big", "jug"))
    assert not any("isempty" in line for line in texts(state_facts(posed(state))))


def test_chairs_are_told_where_some_are_missing() -> None:
    fewer = at("a", chairs=(("big", 2), ("small", 2)))
    assert has_chairs(posed(fewer)) and not has_chairs(posed(START))
    assert has_chairs(posed(START, Goal("chairs", table="big", number=4)))
    assert "holds(has_chairs(big, 2), 0)." in texts(state_facts(posed(fewer)))


def test_a_line_comes_from_where_the_state_says_so() -> None:
    problem = replace(posed(at("a", seated=ONE)), state_where=(("seated", HERE),))
    assert ProgramLine("holds(isattable(c1, big), 0).", HERE) in state_facts(problem)


def test_who_enters_and_who_asks_is_observed() -> None:
    problem = seen(
        at("a", waiting=(LED,), seated=(("big", ("c5",)),), wants_bill="big"),
        Observation("enter", LED, where=HERE),
        Observation("bill", ("big",), where=HERE),
    )
    assert entered(problem) == [(LED, HERE)] and bills_seen(problem) == {"big": HERE}
    assert texts(observation_facts(problem)) == {
        "leader(c1).",
        "obs(has_entered(c1), true, 0).",
        "obs(has_entered(c2), true, 0).",
        "obs(group(c1, c2), true, 0).",
        "obs(bill_wave(big), true, 0).",
    }
    known = texts(state_facts(problem))
    assert "leader(c1)." not in known and "holds(wantsbill(big), 0)." not in known


@pytest.mark.parametrize(
    ("goal", "body"),
    [
        (Goal("seated", LED), "holds(isattable(c1, T), I)"),
        (Goal("seated", LED, table="big"), "holds(isattable(c1, big), I)"),
        (Goal("at", node="b"), "holds(currentlocation(agent, b), I)"),
        (Goal("sent", table="big"), "holds(issent(big), I)"),
        (Goal("chairs", table="big", number=3), "holds(has_chairs(big, X), I), X >= 3"),
        (Goal("holds", fluent="on(a)"), "holds(on(a), I)"),
        (Goal("holds_not", fluent="on(a)"), "#step(I), not holds(on(a), I)"),
    ],
)
def test_a_goal_is_reached_when_its_body_holds(goal: Goal, body: str) -> None:
    problem = posed(START, goal)
    found = texts(goal_facts(problem, parts_of(problem)))
    assert found == {"required(1).", f"reached(1, I) :- {body}."}


def test_an_order_is_taken_or_sent() -> None:
    problem = posed(START, Goal("ordered", table="big"))
    assert len([line for line in goal_facts(problem, frozenset()) if "reached" in line.text]) == 2


def test_to_serve_a_party_leaves_nothing_open_at_its_table() -> None:
    problem = posed(START, Goal("serve", ("c1",)))
    everything = texts(goal_facts(problem, parts_of(problem)))
    bare = texts(goal_facts(problem, frozenset()))
    assert "reached(1, I) :- holds(isattable(c1, T), I), not open(1, I)." in bare
    assert bare < everything and len([line for line in everything if "open(1, I) :-" in line]) == 6


def test_pairs_are_told_by_the_numbers_of_their_goals() -> None:
    first, then = Goal("at", node="b"), Goal("at", node="e")
    problem = replace(posed(START, then), before=((first, then),))
    found = texts(goal_facts(problem, frozenset()))
    assert "before(2, 1)." in found and "required(2)." not in found


def test_several_robots_are_told_apart() -> None:
    robots = (Robot("r", "a"), Robot("s", "b", leads=LED))
    layout = replace(HALL, agents=(("r", "a"), ("s", "b")))
    state = replace(START, robots=robots)
    problem = posed(state, Goal("at", node="e"), Goal("at", node="d", robot="s"), layout=layout)
    known = texts(state_facts(problem))
    assert {"holds(currentlocation(r, a), 0).", "holds(iswith(s, c1), 0)."} <= known
    goals = texts(goal_facts(problem, frozenset()))
    assert "reached(1, I) :- stands(e, I)." in goals
    assert "reached(2, I) :- holds(currentlocation(s, d), I)." in goals


def test_without_a_bar_there_are_no_objects() -> None:
    assert objects_of(posed(START)) == ("plate", "jug", "basket")
    assert refillables_of(posed(START)) == ("jug", "basket")
    assert objects_of(posed(START, layout=replace(HALL, bar=None))) == ()


def test_a_domain_without_parties_has_every_guest_alone() -> None:
    known = texts(guest_state(posed(at("a", waiting=(LED,)))))
    assert {"holds(iswaiting(c1), 0).", "holds(iswaiting(c2), 0)."} <= known
    assert not any("leader" in line for line in known)


def test_what_such_a_domain_has_no_words_for_is_a_fault() -> None:
    timed = posed(START, layout=replace(HALL, timetable=(("w", 2, "b"),)))
    with pytest.raises(InputError, match="knows no timetable"):
        guest_state(timed)
    with pytest.raises(InputError, match="knows no goal ordered"):
        guest_goals(posed(START, Goal("ordered", table="big")))
    assert guest_goals(posed(START, Goal("at", node="b")))
