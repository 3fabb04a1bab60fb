"""Names in pictures: where they stand, and how they give way to people."""

from __future__ import annotations

from itertools import combinations

import pytest

from tests.support.pictures import VIEWS, moment, scene
from tests.support.playing import SHIPPED, layout_of
from waiter_cli.labels.label_cost import obstacles_of
from waiter_cli.labels.node_labels import Label, give_way
from waiter_cli.room.label_boxes import Box, overlap
from waiter_cli.room.room import build_room

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


def test_a_name_comes_home_though_somebody_sits_beside_its_place() -> None:
    gone, sitter = {LABEL: LEFT}, people((62, 0, 66, 10))
    assert give_way([LABEL], sitter, gone, passing=people()) == {LABEL: HOME}
    assert give_way([LABEL], sitter, gone, passing=sitter) == gone, "he is only passing"


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", SHIPPED)
def test_names_cover_neither_each_other_nor_nodes_nor_much_else(name: str, view: str) -> None:
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
    obstacles = obstacles_of(room, drawn.project, upright=view == "3d")
    size = drawn._letters
    messy = [label for label in drawn._labels if obstacles.cost(label.spots[0]) > size * size]
    assert len(messy) <= len(drawn._labels) / 10, [label.text for label in messy]
    if view == "2d" and name == "bistro":
        chairs = [drawn._square(c.x, c.y, 0.19) for row in room.chairs.values() for c in row]
        over = [t for t, box in ((x.text, x.spots[0]) for x in drawn._labels)
                if sum(overlap(box, chair) for chair in chairs) > 0.1 * size * size]  # fmt: skip
        assert not over
    drawn.close()


@pytest.mark.parametrize("view", VIEWS)
def test_names_give_way_to_bubbles(view: str) -> None:
    room = build_room(layout_of("report"))
    drawn = scene(view, room)
    here = moment(room, "n1", "n6")
    drawn.draw(here)
    before = {label.text: box for label, box in drawn._places.items()}
    tag = drawn._tags["n6"].box
    bubbles = [before["n3"], tag]
    drawn.draw(here, bubbles)
    after = {label.text: box for label, box in drawn._places.items()}
    names = [*after.values(), *(tag.box for tag in drawn._tags.values())]
    assert after["n3"] != before["n3"] and drawn._tags["n6"].box != tag
    assert not any(overlap(name, bubble) > 12 for name in names for bubble in bubbles)
    drawn.draw(here)
    assert {label.text: box for label, box in drawn._places.items()} == before
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
