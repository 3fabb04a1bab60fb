"""What a name would be hard to read on, in pixels."""

from __future__ import annotations

import pytest

from tests.support.playing import layout_of
from waiter_cli.pictures.label_cost import Clutter, clutter_of, length_inside
from waiter_cli.room.room import build_room


def test_a_box_costs_what_it_hides() -> None:
    clutter = Clutter()
    clutter.box((100.0, 100.0, 200.0, 200.0), 0.5)
    assert clutter.cost((150.0, 150.0, 250.0, 250.0)) == 0.5 * 50 * 50
    assert clutter.cost((200.0, 100.0, 300.0, 200.0)) == 0.0


def test_a_line_costs_its_length_inside() -> None:
    clutter = Clutter()
    clutter.line((0.0, 50.0, 300.0, 50.0), 3.0)
    assert clutter.cost((100.0, 40.0, 160.0, 60.0)) == pytest.approx(180.0)
    assert length_inside((0, 0, 30, 40), (-9, -9, 99, 99)) == pytest.approx(50.0)


def test_what_is_in_several_cells_counts_once() -> None:
    clutter = Clutter()
    clutter.box((0.0, 0.0, 1000.0, 10.0), 1.0)
    assert clutter.cost((0.0, 0.0, 1000.0, 10.0)) == pytest.approx(10_000.0)


def test_tables_and_ways_are_in_the_way() -> None:
    room = build_room(layout_of("report"))
    clutter = clutter_of(room, lambda x, y, z: (100 * x, -100 * y), upright=False)
    table = room.tables["table2"]
    x, y = 100 * table.x, -100 * table.y
    assert clutter.cost((x - 10, y - 10, x + 10, y + 10)) >= 0.8 * 400
    (ax, ay), (bx, by) = room.nodes["n1"], room.nodes["n2"]
    x, y = 50 * (ax + bx), -50 * (ay + by)
    assert 0 < clutter.cost((x - 10, y - 10, x + 10, y + 10)) < 20 * 40
