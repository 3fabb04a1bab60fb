"""Metres to pixels, and what every layer of a picture knows of places."""

from __future__ import annotations

import pytest

from tests.support.canvases import drawing_of
from tests.support.playing import layout_of
from tests.support.rule_cases import HALL, ONE, at, plan, posed
from waiter_cli.drawing.frame import Frame, edge_name, pill_size, wrapped_listing
from waiter_cli.drawing.subject import make_subject

SUBJECT = make_subject(layout_of("report"))


def test_y_counts_upwards_and_one_scale_serves_both_ways() -> None:
    frame = Frame(SUBJECT, 0.0)
    (x0, y0), (x1, y1) = frame.at(0.0, 0.0), frame.at(1.0, 1.0)
    assert x1 - x0 == pytest.approx(frame.scale) == pytest.approx(y0 - y1)


def test_the_room_lies_in_the_picture() -> None:
    frame = Frame(SUBJECT, 0.0)
    left, top, right, bottom = frame.area
    assert 0 < left < right < frame.width and 0 < top < bottom < frame.height
    for x, y in SUBJECT.room.nodes.values():
        across, down = frame.at(x, y)
        assert left <= across <= right and top <= down <= bottom


def test_a_picture_is_as_wide_as_asked_and_has_room_for_the_plan() -> None:
    assert Frame(SUBJECT, 2000.0).width >= 2000
    state = at("b", seated=ONE, wants_bill="big")
    played = make_subject(HALL, played=(posed(state), plan("give_bill(agent,big)")))
    assert Frame(played, 0.0).panel_left < Frame(played, 0.0).width
    assert Frame(make_subject(HALL), 0.0).panel_left == Frame(make_subject(HALL), 0.0).width


def test_long_lines_of_the_plan_are_wrapped_and_have_their_step_once() -> None:
    texts = [f"go_to(agent,{node})" for node in "bdbdbdbdbdbdbdbdbdbdbdbd"]
    subject = make_subject(HALL, played=(posed(at("a")), plan(*texts)))
    lines = wrapped_listing(subject)
    assert len(lines) > 1 and [bool(step) for step, _ in lines] == [True] + [False] * (
        len(lines) - 1
    )
    assert not any(text.endswith("→") for _, text in lines)


def test_a_drawing_knows_who_stands_where_and_how_far_they_reach() -> None:
    drawing, _ = drawing_of(make_subject(HALL))
    assert drawing.robots == {"a": "agent"} and drawing.staff == {"c": "w"}
    assert drawing.reach("a") > drawing.reach("c") > drawing.reach("b")


def test_an_arrow_points_where_it_turns() -> None:
    drawing, canvas = drawing_of(make_subject(HALL))
    drawing.arrow((10.0, 10.0), 0.0, 5.0, "#111111")
    (points, colour), _ = canvas.of("polygon")[0][1:]
    assert points[0] == (10.0, 10.0) and colour == "#111111"
    assert all(x < 10.0 for x, _ in points[1:]) and sum(
        y - 10.0 for _, y in points[1:]
    ) == pytest.approx(0)


def test_a_pill_has_its_rows_one_below_the_other() -> None:
    drawing, canvas = drawing_of(make_subject(HALL))
    drawing.pill((50.0, 50.0), ["1, 2", "3"], 10.0, ("#111111", "#222222", "#333333"))
    assert canvas.texts() == ["1, 2", "3"]
    first, second = (each.given[0] for each in canvas.of("text"))
    assert first[1] < second[1] and first[1] + second[1] == pytest.approx(100.0)
    assert pill_size(["1"], 10.0)[0] == pill_size(["1"], 10.0)[1], "a single short one is in a disc"


def test_an_edge_has_one_name_both_ways() -> None:
    assert edge_name("b", "a") == edge_name("a", "b") != edge_name("a", "c")
