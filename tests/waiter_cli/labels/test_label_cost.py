"""What a name would be hard to read on, in pixels."""

from __future__ import annotations

from tests.support.playing import layout_of
from waiter_cli.labels.label_cost import obstacles_of
from waiter_cli.room.room import build_room


def test_tables_and_ways_are_in_the_way() -> None:
    room = build_room(layout_of("report"))
    obstacles = obstacles_of(room, lambda x, y, z: (100 * x, -100 * y), upright=False)
    table = room.tables["table2"]
    x, y = 100 * table.x, -100 * table.y
    assert obstacles.cost((x - 10, y - 10, x + 10, y + 10)) >= 0.8 * 400
    (ax, ay), (bx, by) = room.nodes["n1"], room.nodes["n2"]
    x, y = 50 * (ax + bx), -50 * (ay + by)
    assert 0 < obstacles.cost((x - 10, y - 10, x + 10, y + 10)) < 20 * 40
