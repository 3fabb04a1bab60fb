"""Another number of robots: who is there stays, others stand near and in nobody's way."""

from __future__ import annotations

import pytest

from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.study.fleet_size import with_fleet_size


def test_further_robots_stand_near_where_nobody_works() -> None:
    bistro = read_layout_file("bistro")
    assert with_fleet_size(bistro, 1) is bistro
    three = with_fleet_size(bistro, 3)
    assert three.agents == (("r1", "bar1"), ("r2", "south3"), ("r3", "south2"))
    assert with_fleet_size(three, 2).agents == three.agents[:2]
    assert with_fleet_size(three, 1).agents == () and with_fleet_size(three, 1).agent == "bar1"
    read = read_layout(write_layout(three), "three")
    assert read.agents == three.agents


def test_they_stand_where_a_robot_can_get_to() -> None:
    text = (
        "{name: x, nodes: [a, b, c, d], edges: [[a, b], [b, c], [c, d]], entrance: a, agent: b,"
        " waiters: {w: c}, tables: {t: {capacity: 2, nodes: [b]}}}"
    )
    with pytest.raises(InputError, match="places for 1 robots, not for 2; ask for fewer"):
        with_fleet_size(read_layout(text, "x.yaml"), 2)
