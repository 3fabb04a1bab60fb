"""Figures: guests come and go all evening, and their shapes are few."""

from __future__ import annotations

import pytest

from waiter_cli.room.figures import LOOKS, person, robot, shirt_of


def test_guests_of_a_long_evening_share_their_shapes() -> None:
    shapes = {id(person(number, "guest", "stand")) for number in range(20 * LOOKS)}
    assert len(shapes) == LOOKS
    assert person(3, "guest", "sit") is person(3 + LOOKS, "guest", "sit")


def test_neighbours_at_a_table_look_different() -> None:
    colours = {tuple(part.colour for part in person(k, "guest", "sit")) for k in range(LOOKS)}
    assert len(colours) == LOOKS


@pytest.mark.parametrize("load", [None, "plate", "jug", "basket"])
def test_the_tray_stays_out_of_the_way_of_what_is_before_the_robot(load: str | None) -> None:
    reach = max(x for part in robot(load) for x, _, _ in part.vertices)
    assert 0.40 < reach < 0.48


def test_a_tag_has_the_colour_of_the_shirt() -> None:
    for role in ("guest", "waiter", "stranger"):
        for number in range(LOOKS):
            colours = {part.colour for part in person(number, role, "stand")}
            assert shirt_of(number, role) in colours
