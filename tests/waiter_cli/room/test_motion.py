"""Moves of the robot's body: how long they last, where it is meanwhile, what it turns to."""

from __future__ import annotations

from cmath import rect
from math import pi, sqrt

import pytest

from tests.support.playing import layout_of, plan_of
from waiter_cli.model.plan import Action
from waiter_cli.room.motion import (
    GAIN,
    GESTURES,
    TURN,
    Move,
    drive,
    gesture,
    script_of_plan,
    turn,
    way,
    write_script,
)
from waiter_cli.room.room import build_room

ROOM = build_room(layout_of("report"))
HERE = (0.0, 0.0, 0.0)


def test_a_long_drive_takes_its_way_and_a_ramp_more() -> None:
    assert drive(HERE, (8.0, 0.0), 0.8).seconds == pytest.approx(8.0 / 0.8 + 0.8 / GAIN)


def test_a_short_drive_never_reaches_its_speed() -> None:
    move = drive(HERE, (0.3, 0.0), 0.8)
    assert move.seconds == pytest.approx(2 * sqrt(0.3 / GAIN))
    assert move.pose_at(move.seconds / 2)[0] == pytest.approx(0.15)


def test_a_drive_speeds_up_goes_on_and_slows_down() -> None:
    move = drive(HERE, (8.0, 0.0), 0.8)
    ramp = 0.8 / GAIN
    assert move.pose_at(ramp / 2)[0] == pytest.approx(GAIN * ramp**2 / 8)
    first, second = (move.pose_at(t)[0] for t in (3.0, 4.0))
    assert second - first == pytest.approx(0.8)
    assert 8.0 - move.pose_at(move.seconds - ramp)[0] == pytest.approx(GAIN * ramp**2 / 2)
    places = [move.pose_at(k / 20)[0] for k in range(240)]
    assert places == sorted(places) and places[-1] == 8.0


def test_the_robot_looks_where_it_drives() -> None:
    assert drive((0.0, 0.0, 1.0), (0.0, 2.0), 0.8).start[2] == pytest.approx(pi / 2)
    assert drive((1.0, 1.0, 1.0), (1.0, 1.0), 0.8) == Move(
        "drive", (1.0, 1.0, 1.0), (1.0, 1.0, 1.0), 0.0, 0.8
    )


def test_a_turn_takes_the_short_way_round() -> None:
    move = turn((0.0, 0.0, 3.0), -3.0)
    assert move.seconds == pytest.approx((2 * pi - 6.0) / TURN)
    assert abs(move.pose_at(move.seconds / 2)[2]) == pytest.approx(pi)


def test_a_gesture_stands_still() -> None:
    move = gesture((1.0, 2.0, 3.0), 1.5)
    assert [move.pose_at(t) for t in (0.0, 1.0, 9.0)] == [(1.0, 2.0, 3.0)] * 3


def test_a_way_turns_first_where_that_is_needed() -> None:
    assert [move.kind for move in way(HERE, (0.0, 2.0), 0.8)] == ["turn", "drive"]
    assert [move.kind for move in way(HERE, (2.0, 0.0), 0.8)] == ["drive"]
    assert way(HERE, (0.0, 0.0), 0.8) == ()


@pytest.mark.parametrize(
    ("name", "arguments", "faced"),
    [
        ("pick", ("agent", "c1"), ROOM.queue[0]),
        ("seat", ("agent", "c1", "table1"), None),
        ("give_bill", ("agent", "table1"), None),
    ],
)
def test_a_deed_turns_to_what_it_is_about(
    name: str, arguments: tuple[str, ...], faced: tuple[float, float] | None
) -> None:
    table = ROOM.tables["table1"]
    x, y = faced or (table.x, table.y)
    start = (*ROOM.nodes["n5"], 0.0)
    *_, last = moves = write_script(Action(0, name, arguments), start, ROOM, 0.8)
    assert last.kind == "gesture" and last.seconds == GESTURES[name]
    assert moves[0].kind == "turn"
    away = complex(x - start[0], y - start[1])
    assert rect(abs(away), moves[0].end[2]) == pytest.approx(away)


def test_an_action_of_ones_own_is_done_where_it_is_declared() -> None:
    action = Action(0, "wipe", ("agent", "table1"))
    start = (*ROOM.nodes["n5"], 0.0)
    there = write_script(action, start, ROOM, 0.8, place="n3")
    assert there[-1] == gesture(there[-1].start, 1.0)
    assert there != write_script(action, start, ROOM, 0.8, place="table2")


def test_a_plan_is_written_from_where_each_action_ends() -> None:
    plan = plan_of("go_to(agent,n4)", "go_to(agent,n3)", "give_bill(agent,table1)")
    scripts = script_of_plan(plan, (*ROOM.nodes["n5"], 0.0), ROOM, 0.8)
    assert len(scripts) == 3
    moves = [move for script in scripts for move in script]
    assert all(a.end[:2] == b.start[:2] for a, b in zip(moves, moves[1:]))
    assert scripts[1][-1].end[:2] == ROOM.nodes["n3"]
