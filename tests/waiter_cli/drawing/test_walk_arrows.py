"""The walk in a picture: a line for each way, its steps in one pill, tags for what is done."""

from __future__ import annotations

import pytest

from tests.support.canvases import Noted, drawing_of
from tests.support.rule_cases import HALL, ONE, at, plan, posed
from waiter_cli.drawing.frame import Drawing
from waiter_cli.drawing.subject import make_subject
from waiter_cli.drawing.walk_arrows import Track, draw_numbers, draw_tracks

STATE = at("a", seated=ONE, wants_bill="big")


def walked(*texts: str) -> tuple[Drawing, Noted, list[Track]]:
    drawing, canvas = drawing_of(make_subject(HALL, played=(posed(STATE), plan(*texts))))
    return drawing, canvas, draw_tracks(drawing)


def test_a_way_that_is_walked_again_is_one_line_with_all_its_steps() -> None:
    _, canvas, tracks = walked(*(f"go_to(agent,{node})" for node in "bdbdb"))
    assert {track.way: track.steps for track in tracks} == {
        ("a", "b"): (0,), ("b", "d"): (1, 3), ("d", "b"): (2, 4),
    }  # fmt: skip
    assert len(canvas.of("polygon")) == 3, "an arrow head each"


def test_ways_there_and_back_lie_side_by_side() -> None:
    _, _, tracks = walked("go_to(agent,b)", "go_to(agent,a)")
    there, back = tracks
    assert there.at(0.5) != back.at(0.5)


def test_a_spot_on_a_track_and_beside_it() -> None:
    track = Track(("a", "b"), (0.0, 0.0), (10.0, 0.0), (0,))
    assert track.at(0.4) == (4.0, 0.0)
    assert track.at(0.4, 3.0) == pytest.approx((4.0, 3.0))


def test_who_stays_leaves_no_line() -> None:
    _, canvas, tracks = walked("", "")
    assert tracks == [] and canvas.drawn == []


def test_numbers_and_deeds_are_told() -> None:
    drawing, canvas, tracks = walked("go_to(agent,b)", "give_bill(agent,big)")
    draw_numbers(drawing, tracks)
    assert sorted(canvas.texts()) == ["0", "1 bill big"]


def test_many_steps_stand_in_rows() -> None:
    drawing, canvas, tracks = walked(*(f"go_to(agent,{node})" for node in "bababababa"))
    draw_numbers(drawing, tracks)
    assert sorted(canvas.texts()) == sorted(["0, 2, 4", "6, 8", "1, 3, 5", "7, 9"])
