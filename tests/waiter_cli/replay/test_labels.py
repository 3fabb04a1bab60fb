"""Names in pictures: where they stand, and how they give way to people."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest

from tests.support.playing import SHIPPED, layout_of
from waiter_cli.replay.labels import Box, Label, give_way, overlap
from waiter_cli.replay.room import Room, build_room
from waiter_cli.replay.snapshot import Figurine, Snapshot

HOME, RIGHT, LEFT = (40.0, 0.0, 60.0, 10.0), (70.0, 0.0, 90.0, 10.0), (10.0, 0.0, 30.0, 10.0)
LABEL = Label("n1", (HOME, RIGHT, LEFT))


def people(*boxes: Box):  # type: ignore[no-untyped-def]
    """What is covered where people fill these boxes."""
    return lambda box: sum(overlap(box, other) for other in boxes)


def test_a_name_stands_at_its_place_else_at_the_first_that_is_free() -> None:
    assert give_way([LABEL], people()) == {LABEL: HOME}
    assert give_way([LABEL], people((45, -50, 55, 20))) == {LABEL: RIGHT}
    assert give_way([LABEL], people((45, -50, 75, 20))) == {LABEL: LEFT}
    assert give_way([LABEL], people((0, 0, 99, 10))) == {}


def test_a_name_does_not_move_to_where_another_one_stands() -> None:
    other = Label("n2", (RIGHT,))
    shown = give_way([LABEL, other], people((45, 0, 55, 10)))
    assert shown == {other: RIGHT, LABEL: LEFT}


def test_a_name_stays_where_it_went_until_nobody_is_near_its_own_place() -> None:
    gone = {LABEL: LEFT}
    assert give_way([LABEL], people((45, 0, 55, 10)), gone) == gone, "the first place is free"
    assert give_way([LABEL], people((62, 0, 66, 10)), gone) == gone, "somebody is still near"
    assert give_way([LABEL], people((66.1, 0, 69, 10)), gone) == {LABEL: HOME}
    assert give_way([LABEL], people((62, 0, 66, 10)), {LABEL: HOME}) == {LABEL: HOME}


def test_a_name_that_went_leaves_when_another_one_comes_home() -> None:
    other = Label("n2", ((60.0, 0.0, 80.0, 10.0),))
    shown = give_way([LABEL, other], people((45, 0, 55, 10)), {LABEL: RIGHT})
    assert shown == {other: other.spots[0], LABEL: LEFT}


def moment(room: Room, robot: str, *guests: str) -> Snapshot:
    """The robot on a node, facing up, and guests on others."""
    figures = tuple(
        Figurine(node, "guest", k, *room.nodes[node], 1.6, "stand", False, 0)
        for k, node in enumerate(guests)
    )
    chairs = tuple((table.name, table.chairs) for table in room.layout.tables)
    x, y = room.nodes[robot]
    return Snapshot("", 0.0, (x, y, 1.6), None, figures, chairs, (), (), "", (), 0)


def scene(view: str, room: Room) -> Any:
    pytest.importorskip("PIL")
    pytest.importorskip("numpy")
    if view == "2d":
        from waiter_cli.replay.scene2d import Scene2D

        return Scene2D(room, 600, 450, 1)
    pytest.importorskip("pybullet")
    from waiter_cli.replay.scene3d import Scene3D

    return Scene3D(room, 600, 450, 1)


VIEWS = ["2d", pytest.param("3d", marks=pytest.mark.sim)]


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", SHIPPED)
def test_names_cover_neither_each_other_nor_nodes(name: str, view: str) -> None:
    room = build_room(layout_of(name))
    drawn = scene(view, room)
    assert [label.text.split()[0] for label in drawn._labels].count(room.layout.entrance) == 1
    homes = [label.spots[0] for label in drawn._labels]
    assert not [pair for pair in combinations(homes, 2) if overlap(*pair) > 4]
    dots = [drawn.project(x, y, 0.0) for x, y in room.nodes.values()]
    for label in drawn._labels:
        for spot in label.spots[1:]:
            assert not any(overlap(spot, home) for home in homes if home != label.spots[0])
        for left, top, right, bottom in label.spots:
            assert not any(left < x < right and top < y < bottom for x, y in dots)
    drawn.close()


@pytest.mark.parametrize("view", VIEWS)
def test_whoever_stands_on_a_node_does_not_hide_its_name(view: str) -> None:
    """On the picture itself: the letters are where the name is said to stand."""
    room = build_room(layout_of("report"))
    drawn = scene(view, room)
    drawn.draw(moment(room, "n1"))
    away = {label.text: box for label, box in drawn._places.items()}
    picture = drawn.draw(moment(room, "n6", "n7", "n4"))
    here = {label.text: box for label, box in drawn._places.items()}
    assert set(here) == {"n0", "n1", "n2", "n3", "n4", "n5 · entrance", "n6", "n7"}
    assert away["n6"] != here["n6"], "the robot stands where the name was"
    for text, box in here.items():
        part = picture.crop(tuple(round(edge) for edge in box)).convert("RGB")
        ink = sum(n for n, (r, g, b) in part.getcolors(1 << 16) if r < 90 and g < 110 and b > 70)
        assert ink > 8, f"{text} is written at {box}"
    assert (
        drawn.draw(moment(room, "n1")).tobytes()
        == scene(view, room).draw(moment(room, "n1")).tobytes()
    ), "when they have gone the picture is as before"
    drawn.close()
