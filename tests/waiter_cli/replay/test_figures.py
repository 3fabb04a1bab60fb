"""Figures: guests come and go all evening, and their shapes are few."""

from __future__ import annotations

from waiter_cli.replay.figures import LOOKS, person


def test_guests_of_a_long_evening_share_their_shapes() -> None:
    shapes = {id(person(number, "guest", "stand")) for number in range(20 * LOOKS)}
    assert len(shapes) == LOOKS
    assert person(3, "guest", "sit") is person(3 + LOOKS, "guest", "sit")


def test_neighbours_at_a_table_look_different() -> None:
    colours = {tuple(part.colour for part in person(k, "guest", "sit")) for k in range(LOOKS)}
    assert len(colours) == LOOKS
