"""The camera: metres to pixels as a pinhole has it, all of the room in the picture, nodes in sight."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import cos, pi, radians, sin, tan

import pytest

from tests.support.playing import SHIPPED, layout_of
from waiter_cli.room.camera import FIELD, Camera, frame_room, hidden_nodes
from waiter_cli.room.room import build_room
from waiter_cli.room.shapes import Box

DOWN = Camera(
    (0.0, 0.0, 10.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 400, 300, 0.2, 20.0
)


def test_what_lies_straight_ahead_is_in_the_middle() -> None:
    assert DOWN.project(0.0, 0.0) == pytest.approx((200.0, 150.0))


def test_right_is_right_and_up_is_up() -> None:
    x, y = DOWN.project(1.0, 1.0)
    assert x > 200.0 and y < 150.0


def test_the_edge_of_the_field_of_view_is_the_edge_of_the_picture() -> None:
    top = 10.0 * tan(radians(FIELD / 2))
    assert DOWN.project(0.0, top)[1] == pytest.approx(0.0)
    assert DOWN.project(top * 400 / 300, 0.0)[0] == pytest.approx(400.0)


def test_what_is_nearer_is_larger() -> None:
    pixels = DOWN.project(1.0, 0.0)[0] - 200.0
    assert DOWN.scale_at(0.0, 0.0) == pytest.approx(pixels)
    assert DOWN.scale_at(0.0, 0.0, 5.0) == pytest.approx(2 * pixels)


@pytest.mark.parametrize("size", [(1280, 720), (480, 960)], ids=["across", "upright"])
@pytest.mark.parametrize("name", SHIPPED)
def test_all_of_the_room_is_in_the_picture_and_fills_it(name: str, size: tuple[int, int]) -> None:
    room = build_room(layout_of(name))
    camera = frame_room(room, *size)
    x0, x1, y0, y1 = room.bounds
    corners = [camera.project(*c) for c in product((x0, x1), (y0, y1), (0.0, 1.15))]
    for axis, most in enumerate(size):
        assert all(0 <= corner[axis] <= most for corner in corners)
    spans = [(max(c) - min(c)) / most for c, most in zip(zip(*corners), size)]
    assert max(spans) > 0.85, "no smaller than it must be"


def looking(elevation: float) -> Camera:
    """A camera south of the origin that looks at it from above."""
    c, s = cos(elevation), sin(elevation)
    return Camera(
        (0.0, -20 * c, 20 * s), (0.0, c, -s), (1.0, 0.0, 0.0), (0.0, s, c), 400, 300, 0.2, 60.0
    )


def test_a_node_behind_a_wall_is_hidden_and_from_above_it_is_not() -> None:
    room = build_room(layout_of("report"))
    wall = Box("wall", 0.0, -0.4, 2.0, 0.05, 0.0, 2.0)
    room = replace(
        room,
        nodes={"behind": (0.0, 0.0), "before": (0.0, -2.0)},
        tables={},
        walls=(wall,),
        bar=None,
    )
    assert hidden_nodes(room, looking(radians(30))) == ["behind"]
    assert hidden_nodes(room, looking(radians(89))) == []
    turned = replace(wall, yaw=pi / 2)
    assert hidden_nodes(replace(room, walls=(turned,)), looking(radians(30))) == [
        "behind",
        "before",
    ]
    aside = replace(turned, x=1.0)
    assert hidden_nodes(replace(room, walls=(aside,)), looking(radians(30))) == []
