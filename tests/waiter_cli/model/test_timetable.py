"""Where colleagues are by their timetable, who would share a node, and who is put off."""

from __future__ import annotations

import pytest

from waiter_cli.model.timetable import Clash, clashes, places_at, put_off

START = {"w1": "a", "w2": "b"}


@pytest.mark.parametrize(("step", "node"), [(0, "a"), (2, "a"), (3, "c"), (5, "c"), (6, "d")])
def test_the_latest_entry_up_to_a_step_counts(step: int, node: str) -> None:
    timetable = [("w1", 6, "d"), ("w1", 3, "c")]  # in any order
    assert places_at(START, timetable, step) == {"w1": node, "w2": "b"}


def test_nobody_clashes_who_changes_places() -> None:
    assert clashes(START, [("w1", 2, "b"), ("w2", 2, "a")]) == ()


def test_a_clash_is_told_with_who_led_to_it_once_for_each_time_it_begins() -> None:
    timetable = [("w1", 2, "b"), ("w1", 4, "a"), ("w2", 6, "a")]
    assert clashes(START, timetable) == (
        Clash("w1", "w2", "b", 2, ("w1", 2)),
        Clash("w1", "w2", "a", 6, ("w2", 6)),
    )


def test_a_clash_that_lasts_is_one() -> None:
    third = {**START, "w3": "e"}
    assert len(clashes(third, [("w1", 1, "b"), ("w3", 2, "f"), ("w3", 3, "g")])) == 1


def test_who_shares_a_node_from_the_start_was_led_there_by_nothing() -> None:
    assert clashes({"w1": "a", "w2": "a"}, []) == (Clash("w1", "w2", "a", 0, None),)


def test_who_is_due_where_the_agent_stands_comes_a_step_later() -> None:
    timetable = [("w1", 3, "n"), ("w2", 3, "m")]
    assert put_off(START, timetable, 3, "n") == (("w1", 4, "n"), ("w2", 3, "m"))


def test_so_does_who_is_due_where_one_of_those_still_stands() -> None:
    timetable = [("w1", 3, "n"), ("w2", 3, "a")]
    assert put_off(START, timetable, 3, "n") == (("w1", 4, "n"), ("w2", 4, "a"))


def test_an_entry_for_the_next_step_stands_as_it_is() -> None:
    timetable = [("w1", 3, "n"), ("w1", 4, "d")]
    assert put_off(START, timetable, 3, "n") == (("w1", 4, "d"),)


def test_nothing_changes_where_nobody_is_in_the_way() -> None:
    timetable = [("w1", 3, "n"), ("w2", 5, "m")]
    assert put_off(START, timetable, 3, "z") == tuple(timetable)
    assert put_off(START, timetable, 4, "n") == tuple(timetable)
