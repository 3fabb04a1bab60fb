"""The room from above."""

from __future__ import annotations

import pytest

from tests.support.pictures import moment, scene
from tests.support.playing import SHIPPED, layout_of
from waiter_cli.room.room import build_room


@pytest.mark.parametrize("name", SHIPPED)
def test_all_of_a_room_is_in_the_picture(name: str) -> None:
    room = build_room(layout_of(name))
    drawn = scene("2d", room)
    x0, x1, y0, y1 = room.bounds
    for x, y in ((x0, y0), (x1, y0), (x0, y1), (x1, y1)):
        px, py = drawn.project(x, y, 0.0)
        assert 0 <= px <= drawn.width and 0 <= py <= drawn.height


def test_a_metre_is_as_long_across_as_down() -> None:
    drawn = scene("2d", build_room(layout_of("bistro")))
    (ax, ay), (bx, by), (cx, cy) = (drawn.project(x, y, 0.0) for x, y in ((0, 0), (1, 0), (0, 1)))
    assert abs(bx - ax) + abs(by - ay) == pytest.approx(abs(cx - ax) + abs(cy - ay))


def test_the_robot_is_drawn_where_it_is_said_to_be() -> None:
    room = build_room(layout_of("report"))
    drawn = scene("2d", room)
    pictures = [drawn.draw(moment(room, node)).convert("L") for node in ("n1", "n4")]
    changed = image_chops().difference(*pictures).point(lambda v: 255 * (v > 60))
    for node in ("n1", "n4"):
        px, py = drawn.project(*room.nodes[node], 0.3)
        near = changed.crop((round(px) - 12, round(py) - 12, round(px) + 12, round(py) + 12))
        assert near.getbbox() is not None, node
    drawn.close()


def image_chops():  # type: ignore[no-untyped-def]
    return pytest.importorskip("PIL.ImageChops")
