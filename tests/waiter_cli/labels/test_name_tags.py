"""Names of people in pictures: whose they are, and what they leave free."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import pytest

from tests.support.pictures import VIEWS, moment, scene
from tests.support.playing import layout_of
from waiter_cli.labels.name_tags import STAYS, Stature, Tag, place_tags
from waiter_cli.pictures.snapshot import Figurine
from waiter_cli.room.label_boxes import Box, overlap
from waiter_cli.room.room import build_room

PICTURE = (300, 300)


def somebody(name: str, x: float, y: float) -> Stature:
    return Stature(name, (x - 10, y, x + 10, y + 20), (x - 15, y, x + 15, y + 80))


def tags(*crowd: Stature, taken: tuple[Box, ...] = (), before: dict[str, Tag] | None = None):  # type: ignore[no-untyped-def]
    names = [who.name for who in crowd]
    return place_tags(crowd, names, 10, PICTURE, taken, [], before or {})


def test_a_tag_is_over_the_head_else_beside_whom_it_names() -> None:
    ada = somebody("ada", 150, 100)
    over = tags(ada)["ada"].box
    assert over[3] <= ada.head[1] and over[0] < 150 < over[2]
    beside = tags(ada, taken=(over,))["ada"].box
    assert not overlap(beside, over) and not overlap(beside, ada.head)
    assert min(abs(beside[0] - 150), abs(beside[2] - 150)) < 30, "it is still near"


def test_a_tag_covers_no_face() -> None:
    ada = somebody("ada", 150, 100)
    alone = tags(ada)["ada"].box
    left, _, right, bottom = alone
    taken = ((0, 0, left, 300), (right, 0, 300, 300), (left, bottom, right, 300))
    assert tags(ada, taken=taken)["ada"].box == alone, "there is no other place"
    bob = Stature("bob", alone, (*alone[:3], bottom + 1))
    assert "ada" not in tags(ada, bob, taken=taken)


def test_in_a_crowd_tags_do_not_cover_each_other() -> None:
    crowd = [somebody(f"waiter{k}", 100 + 34 * k, 100) for k in range(3)]
    assert overlap(tags(crowd[0])["waiter0"].box, tags(crowd[1])["waiter1"].box) > 100
    found = tags(*crowd)
    assert len(found) == 3
    assert not [p for p in combinations(found.values(), 2) if overlap(p[0].box, p[1].box) > 25]


def test_where_no_place_is_left_there_is_no_tag() -> None:
    assert tags(somebody("ada", 150, 100), taken=((0, 0, 300, 300),)) == {}
    assert tags(somebody("ada", 150, -500)) == {}, "she is not in the picture"


def test_a_tag_keeps_its_side_while_that_is_about_as_good() -> None:
    ada, bob = somebody("ada", 150, 100), somebody("bob", 190, 60)
    alone = tags(ada)
    here = tags(ada, taken=(alone["ada"].box,))["ada"]
    assert here.side != alone["ada"].side
    assert tags(ada, before={"ada": here})["ada"] == here
    crossed = tags(ada, bob, before={"ada": alone["ada"]})
    assert crossed["ada"].side == alone["ada"].side
    assert 0 < STAYS < 1


@pytest.mark.parametrize("view", VIEWS)
def test_everybody_has_a_name_and_no_face_is_covered(view: str) -> None:
    """On the picture itself: a full table, colleagues and a queue; letters are where they are said."""
    room = build_room(layout_of("bistro"))
    drawn = scene(view, room)
    sitting = tuple(
        Figurine(f"c{k}", "guest", k, chair.x, chair.y, chair.yaw, "sit", False, 0)
        for k, chair in enumerate((*room.chairs["table5"], *room.chairs["table1"]))
    )
    staff = (Figurine("anna", "waiter", 30, *room.nodes["mid3"], 0.0, "stand", False, 0),)
    waiting = tuple(
        Figurine(f"q{k}", "guest", 40 + k, *spot, 0.0, "stand", False, 0)
        for k, spot in enumerate(room.queue[:2])
    )
    here = replace(moment(room, "west3"), people=(*sitting, *staff, *waiting))
    bare = drawn.draw(replace(here, people=())).convert("RGB")
    picture = drawn.draw(here).convert("RGB")
    assert set(drawn._tags) == {who.name for who in here.people}
    names = [*drawn._signs, *drawn._places.values(), *drawn.heads(here)]
    for name, (box, _) in drawn._tags.items():
        area = (box[2] - box[0]) * (box[3] - box[1])
        assert sum(overlap(box, other) for other in names) <= 0.05 * area, name
        part = [picture.crop(tuple(round(edge) for edge in box)) for picture in (bare, picture)]
        white, ink = (
            [sum(n for n, c in p.getcolors(1 << 16) if wanted(c)) for p in part]
            for wanted in (lambda c: min(c) > 225, lambda c: max(c) < 140)
        )
        assert white[1] > 0.3 * area and ink[1] > 4, f"{name} is written at {box}"
    assert not [
        pair
        for pair in combinations(drawn._tags.values(), 2)
        if overlap(pair[0].box, pair[1].box) > 12
    ]
    drawn.close()


@pytest.mark.parametrize("view", VIEWS)
def test_a_tag_goes_with_whom_it_names(view: str) -> None:
    room = build_room(layout_of("report"))
    drawn = scene(view, room)
    drawn.draw(moment(room, "n1", "n4"))
    assert set(drawn._tags) == {"n4"}
    last = drawn.draw(moment(room, "n1"))
    assert drawn._tags == {}
    assert last.tobytes() == scene(view, room).draw(moment(room, "n1")).tobytes()
    drawn.close()
