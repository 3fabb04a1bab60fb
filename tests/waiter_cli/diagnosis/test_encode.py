"""The program of a diagnosis: the facts that matter, and how far it looks back."""

from __future__ import annotations

from dataclasses import replace

import sparc
from tests.support.rule_cases import HALL, START
from waiter_cli.diagnosis.case import Surprise
from waiter_cli.diagnosis.encode import program_of

SEEN = Surprise(
    HALL, START, (), step=0, trail=(), at=(("w", "e"),), free=(), taken=(), strangers=()
)


def facts(case: Surprise, *walkers: str, elsewhere: bool = False) -> tuple[set[str], int]:
    source, moments = program_of(case, walkers, elsewhere)
    return {line.strip() for line in source.text.splitlines()}, moments


def test_it_is_a_program() -> None:
    source, _ = program_of(SEEN, ["w"], False)
    typed = sparc.check(sparc.parse(source))
    assert len(list(sparc.solve(typed, models=1))) == 1


def test_it_looks_back_as_far_as_the_walk_is_long() -> None:
    lines, moments = facts(SEEN, "w")
    assert moments == 3  # c, b, d, e
    assert {"last(3).", "seen_at(w, e).", "holds(stands(w, c), 0).", "may_walk(w)."} <= lines
    assert {"along(w, b, 1).", "along(w, d, 2)."} <= lines and "along(w, a, 2)." not in lines


def test_a_table_seen_taken_may_be_anybodys_that_fits() -> None:
    state = replace(START, waiting=(("c1",), ("c2", "c3", "c4")))
    case = replace(SEEN, state=state, at=(), taken=("small",), strangers=(("small", "s1"),))
    lines, _ = facts(case)
    assert {
        "seen_taken(small).",
        "fits(c1, small).",
        "fits(s1, small).",
        "is_stranger(s1).",
    } <= lines
    assert "fits(c2, small)." not in lines


def test_a_table_seen_free_had_a_party() -> None:
    state = replace(START, seated=(("big", ("c1",)),))
    lines, _ = facts(replace(SEEN, state=state, at=(), free=("big",)))
    assert {"seen_free(big).", "holds(sits(c1, big), 0)."} <= lines


def test_people_are_off_the_floor_only_where_that_is_suspected() -> None:
    assert "may_be_elsewhere(w)." not in facts(SEEN, "w")[0]
    assert "may_be_elsewhere(w)." in facts(SEEN, "w", elsewhere=True)[0]


def test_where_the_robot_was_is_known_from_its_trail() -> None:
    case = replace(SEEN, state=replace(START, agent="b"), step=2, trail=((0, "a"), (1, "a")))
    lines, moments = facts(replace(case, at=(("w", "d"),)), "w")
    assert moments == 2
    assert {"holds(stands(agent, a), 1).", "holds(stands(agent, b), 2)."} <= lines
