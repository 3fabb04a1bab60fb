"""The floor in perspective."""

from __future__ import annotations

import pytest

from tests.support.playing import layout_of
from waiter_cli.room.camera import frame_room
from waiter_cli.room.room import build_room


def test_a_pixel_looks_at_the_place_that_the_camera_puts_there() -> None:
    pytest.importorskip("numpy")
    from waiter_cli.pictures.floor_texture import FloorTexture

    room = build_room(layout_of("report"))
    camera = frame_room(room, 200, 150)
    floor = FloorTexture(room, camera, 400, 300, 2)
    xs, ys = floor.places(slice(0, 300))
    for x, y in room.nodes.values():
        px, py = camera.project(x, y, 0.0)
        row, column = int(2 * py), int(2 * px)
        assert xs[row, column] == pytest.approx(x, abs=0.1)
        assert ys[row, column] == pytest.approx(y, abs=0.1)
