"""The rules of the house as a rulebook: one robot or several, and no words but their own."""

from __future__ import annotations

from dataclasses import replace

from tests.support.rule_cases import HALL, START, act, at, posed
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Observation, Robot
from waiter_cli.rules.rulebook import HOUSE


def test_one_robot_acts_or_waits() -> None:
    problem = posed(START)
    assert HOUSE.begin(problem) == START
    assert HOUSE.after(problem, START, [act("go_to(agent,b)")], 0).agent == "b"
    timed = posed(START, layout=replace(HALL, timetable=(("w", 1, "b"),)))
    assert HOUSE.after(timed, START, [], 0).waiters == (("w", "b"),)


def test_several_robots_act_together() -> None:
    robots = (Robot("r", "a"), Robot("s", "d"))
    state = replace(START, robots=robots)
    problem = posed(state, layout=replace(HALL, agents=(("r", "a"), ("s", "d"))))
    assert HOUSE.begin(problem) == state
    moves = [Action(0, "go_to", ("r", "b")), Action(0, "go_to", ("s", "e"))]
    assert HOUSE.after(problem, state, moves, 0).stations() == {"r": "b", "s": "e"}


def test_goals_and_observations_are_those_of_the_rules() -> None:
    assert HOUSE.holds(Goal("at", node="b"), at("b"), posed(START))
    seen = (Observation("at", ("agent", "b")),)
    assert HOUSE.observe(START, seen, HALL) == (at("b"), ())


def test_words_of_a_domain_of_ones_own_are_unknown() -> None:
    assert HOUSE.unknown_words(posed(START)) == ()
    own = posed(START, Goal("holds", fluent="on(a,b)"))
    (reason,) = HOUSE.unknown_words(own)
    assert "--domain" in reason.message
