"""The room of a layout: chairs, waiting guests, clear ways, what the camera sees, scripts of motion."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import hypot, pi

import pytest

from tests.support.playing import SHIPPED, layout_of, plan_of
from waiter_cli.errors import LayoutError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.model.layout import Node
from waiter_cli.room.camera import frame_room
from waiter_cli.room.motion import script_of_plan, write_script
from waiter_cli.room.room import PERSON, ROBOT, Room, build_room, nearest_on_walk, sweep
from waiter_cli.room.shapes import Box, Disc, distance, walk_distance


@cache
def room_of(name: str) -> Room:
    return build_room(layout_of(name))


ROOMS = (*SHIPPED, *(f"generated{k}" for k in range(1, 11)))


@pytest.mark.parametrize("name", ROOMS)
def test_every_table_has_chairs_that_leave_the_ways_clear(name: str) -> None:
    layout = layout_of(name)
    room = room_of(name)
    assert not sweep(room, {table.name: table.capacity for table in layout.tables})
    for table in layout.tables:
        places = {(chair.x, chair.y) for chair in room.chairs[table.name]}
        assert len(places) == table.capacity
        for x, y in places:
            assert distance(x, y, room.tables[table.name]) > PERSON, "nobody sits inside a table"


@pytest.mark.parametrize("name", ROOMS)
def test_who_waits_stands_clear_of_ways_and_furniture(name: str) -> None:
    layout = layout_of(name)
    room = room_of(name)
    solids = list(room.furniture({table.name: table.capacity for table in layout.tables}))
    for spot in room.queue[:6]:
        assert all(distance(*spot, solid) >= PERSON for solid in solids)
        for a, b in layout.edges:
            _, gap = nearest_on_walk(room.nodes[a], room.nodes[b], [Disc("guest", *spot, PERSON)])
            assert gap >= ROBOT


@pytest.mark.parametrize("name", ROOMS)
@pytest.mark.parametrize("size", [(960, 720), (480, 360), (300, 600)])
def test_the_camera_sees_the_whole_room(name: str, size: tuple[int, int]) -> None:
    room = room_of(name)
    camera = frame_room(room, *size)
    x0, x1, y0, y1 = room.bounds
    corners = [(x, y) for x in (x0, x1) for y in (y0, y1)]
    for x, y in [*room.nodes.values(), *corners]:
        for z in (0.0, 1.0):
            px, py = camera.project(x, y, z)
            assert 0 <= px <= size[0] and 0 <= py <= size[1]


def test_an_edge_through_furniture_is_named_with_its_place() -> None:
    text = (
        "name: narrow\nnodes: {a: [0, 0], b: [4, 0]}\nedges:\n  - [a, b]\nentrance: a\nagent: a\n"
        "tables: {t: {capacity: 2, nodes: [a], at: [2, 0.5]}}\n"
    )
    (fault,) = sweep(build_room(read_layout(text, "narrow.yaml")))
    assert "a-b" in fault.message and "through t" in fault.message
    assert str(fault.where) == "narrow.yaml:4:5"


def test_walls_and_bars_are_furniture_too() -> None:
    layout = layout_of("report")
    walled = replace(layout, walls=(((-1.0, -3.0), (-1.0, 2.0)),))
    found = [fault.message for fault in sweep(build_room(walled))]
    assert len(found) == 2 and all("wall1" in message for message in found)


def test_a_layout_without_coordinates_cannot_be_simulated() -> None:
    layout = layout_of("report")
    bare = replace(layout, nodes=tuple(Node(node.name) for node in layout.nodes))
    with pytest.raises(LayoutError) as caught:
        build_room(bare)
    (fault,) = caught.value.faults
    assert fault.message == "8 nodes have no coordinates: enough to plan, not to simulate"
    assert fault.hint is not None and "`waiter layout convert --place " in fault.hint


@pytest.mark.parametrize(
    ("solid", "start", "end", "gap"),
    [
        (Box("b", 0, 0, 1, 1), (-3.0, 2.0), (3.0, 2.0), 1.0),
        (Box("b", 0, 0, 1, 1), (-3.0, 0.0), (3.0, 0.0), -1.0),
        (Box("b", 0, 0, 1, 1), (2.0, 2.0), (3.0, 3.0), 2**0.5),
        (Box("b", 0, 0, 1, 1, pi / 4), (-3.0, 2.0), (3.0, 2.0), 2 - 2**0.5),
        (Disc("d", 0, 0, 1), (-3.0, 2.5), (3.0, 2.5), 1.5),
    ],
)
def test_the_least_distance_of_a_walk(solid: Box | Disc, start, end, gap: float) -> None:  # type: ignore[no-untyped-def]
    assert walk_distance(start, end, solid) == pytest.approx(gap, abs=1e-6)


def test_a_script_drives_along_the_edges_and_arrives() -> None:
    room = build_room(layout_of("report"))
    plan = plan_of("go_to(agent,n2)", "go_to(agent,n3)", "give_bill(agent,table1)")
    scripts = script_of_plan(plan, (*room.nodes["n1"], 0.0), room, 0.8)
    assert [moves[-1].kind for moves in scripts] == ["drive", "drive", "gesture"]
    for moves, node in zip(scripts, ("n2", "n3")):
        assert moves[-1].end[:2] == room.nodes[node]
        assert moves[-1].pose_at(moves[-1].seconds) == moves[-1].end


def test_no_drive_is_faster_than_its_speed() -> None:
    room = build_room(layout_of("report"))
    (*_, move) = write_script(plan_of("go_to(agent,n4)").actions[0], (-3.8, 0.875, 0.0), room, 0.8)
    steps = [move.pose_at(k / 60) for k in range(int(move.seconds * 60) + 2)]
    fastest = max(hypot(b[0] - a[0], b[1] - a[1]) * 60 for a, b in zip(steps, steps[1:]))
    assert 0.79 < fastest < 0.8001
