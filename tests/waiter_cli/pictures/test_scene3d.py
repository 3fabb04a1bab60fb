"""The room in perspective."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.pictures import moment, scene
from tests.support.playing import layout_of
from waiter_cli.pictures.snapshot import RobotFigure
from waiter_cli.room.figures import rings_of
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


def test_the_ring_around_each_robot_is_in_its_colour() -> None:
    room = build_room(layout_of("report"))
    places = [room.nodes[node] for node in ("n1", "n4")]
    crew = tuple(RobotFigure(f"r{k + 1}", k, (*place, 0.0), None) for k, place in enumerate(places))
    drawn = scene("3d", room)
    picture = drawn.draw(replace(moment(room, "n1"), crew=crew)).convert("RGB")
    for k, (x, y) in enumerate(places):
        px, py = drawn.project(x, y - 0.40, 0.0)
        near = [(round(px) + a, round(py) + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
        off, other = (
            min(
                sum(abs(a - b) for a, b in zip(picture.getpixel(place), rings_of(number)[0]))
                for place in near
            )
            for number in (k, 1 - k)
        )
        assert off < 120 < other, (k, off, other)
    drawn.close()
