"""The room in perspective."""

from __future__ import annotations

import pytest

from tests.support.pictures import moment, scene
from tests.support.playing import layout_of
from waiter_cli.room.room import build_room

pytestmark = pytest.mark.sim


def test_the_robot_is_drawn_where_it_is_said_to_be() -> None:
    room = build_room(layout_of("report"))
    drawn = scene("3d", room)
    pictures = [drawn.draw(moment(room, node)).convert("L") for node in ("n1", "n4")]
    changed = image_chops().difference(*pictures).point(lambda v: 255 * (v > 60))
    for node in ("n1", "n4"):
        px, py = drawn.project(*room.nodes[node], 0.3)
        near = changed.crop((round(px) - 12, round(py) - 12, round(px) + 12, round(py) + 12))
        assert near.getbbox() is not None, node
    drawn.close()


def image_chops():  # type: ignore[no-untyped-def]
    return pytest.importorskip("PIL.ImageChops")
