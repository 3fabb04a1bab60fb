"""The layers of a picture: the ground, furniture with its guests, the way in, people."""

from __future__ import annotations

from dataclasses import replace

from tests.support.canvases import Noted, drawing_of
from tests.support.rule_cases import HALL, at
from waiter_cli.drawing.canvas import PALETTE as C
from waiter_cli.drawing.furniture import (
    draw_dots,
    draw_furniture,
    draw_ground,
    draw_people,
    draw_way_in,
)
from waiter_cli.drawing.subject import make_subject
from waiter_cli.model.state import State

STATE = at("a", seated=(("big", ("c1", "c2")),), waiting=(("c7",),), wants_bill="big")


def layer(
    draw: object, state: State = STATE, marked: tuple[str, ...] = (), **layout: object
) -> Noted:
    hall = replace(HALL, **layout)  # type: ignore[arg-type]
    drawing, canvas = drawing_of(make_subject(hall, state, highlights=marked))
    draw(drawing)  # type: ignore[operator]
    return canvas


def colours(canvas: Noted, shape: str, index: int) -> list[str]:
    return [each.given[index] for each in canvas.of(shape)]


def test_every_path_is_a_lane_and_a_line() -> None:
    canvas = layer(draw_ground)
    assert colours(canvas, "line", 1).count(C.lane) == colours(canvas, "line", 1).count(C.path) == 4
    assert not canvas.of("polygon") and not canvas.of("circle")


def test_a_path_one_way_has_an_arrow() -> None:
    assert len(layer(draw_ground, one_way=frozenset({("e", "d")})).of("polygon")) == 1


def test_what_is_pointed_out_glows() -> None:
    canvas = layer(draw_ground, marked=("c", "big", "b-d"))
    assert len(canvas.of("circle")) == 1 and C.glow in colours(canvas, "box", 2)
    assert C.mark in colours(canvas, "line", 1)


def test_guests_sit_on_chairs_that_are_there() -> None:
    canvas = layer(draw_furniture)
    assert {"c1", "c2"} <= set(canvas.texts()) and "c7" not in canvas.texts()
    assert colours(canvas, "box", 2).count(C.guest) == 2
    few = replace(STATE, chairs=(("big", 2), ("small", 2)))
    dashed = [each for each in layer(draw_furniture, few).of("box") if each.named.get("dashed")]
    assert len(dashed) == 2, "places without a chair"


def test_tables_have_their_names_and_what_is_waited_for() -> None:
    assert {"big", "small", "bar", "bill"} <= set(layer(draw_furniture).texts())
    asked = replace(STATE, ready_to_order=frozenset({"big"}))
    assert "bill, order" in layer(draw_furniture, asked).texts()


def test_walls_are_drawn() -> None:
    canvas = layer(draw_furniture, walls=(((0.0, 0.0), (1.0, 0.0)),))
    assert colours(canvas, "line", 1) == [C.wall]


def test_every_node_has_a_ring_and_the_entrance_a_green_one() -> None:
    canvas = layer(draw_dots)
    assert len(canvas.of("circle")) == 5
    assert [each.given[3] for each in canvas.of("circle")].count(C.door) == 1


def test_people_are_those_who_stand_somewhere() -> None:
    canvas = layer(draw_people)
    drawn = {each.given[2] for each in canvas.drawn if each.shape in ("box", "circle")}
    assert {C.waiter, C.guest, C.robot} <= drawn
    nobody = layer(draw_people, State("a", chairs=STATE.chairs))
    assert C.guest not in {
        each.given[2] for each in nobody.drawn if each.shape in ("box", "circle")
    }


def test_the_way_in_ends_in_an_arrow_at_the_entrance() -> None:
    canvas = layer(draw_way_in)
    assert colours(canvas, "line", 1) == [C.door, C.door]
    (arrow,) = canvas.of("polygon")
    drawing, _ = drawing_of(make_subject(HALL, STATE))
    (x, y), (u, v) = arrow.given[0][0], drawing.nodes["e"]
    assert abs(x - u) + abs(y - v) < drawing.scale
