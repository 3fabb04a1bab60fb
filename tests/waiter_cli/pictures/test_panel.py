"""What lies over and beside the picture of the room."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from waiter_cli.pictures.snapshot import Bubble, Row, Snapshot
from waiter_cli.room.label_boxes import Box, overlap

pytest.importorskip("PIL")

from waiter_cli.pictures.panel import Panel

EMPTY = Snapshot("b1", 0.0, (0.0, 0.0, 0.0), None, (), (), (), (), "", (), 0)


def panel(heads: tuple[Box, ...] = ()) -> Panel:
    """Its stage is 480 x 360 pixels, a metre is 100."""
    return Panel(632, 360, lambda x, y, z: (100 * x, 360 - 100 * y), lambda moment: heads)


def says(x: float, y: float, text: str, speaker: str = "c1") -> Bubble:
    return Bubble(speaker, x, y, 1.8, text)


def test_a_bubble_leaves_faces_free() -> None:
    here = replace(EMPTY, bubbles=(says(2.4, 1.8, "a table for 2, please"),))
    (middle,) = panel().covered(here)
    assert abs((middle[0] + middle[2]) / 2 - 240) < 2
    left = (middle[0], middle[1], middle[0] + 20, middle[3])
    right = (middle[2] - 20, middle[1], middle[2], middle[3])
    for heads in ((left,), (right,), (left, right)):
        (box,) = panel(heads).covered(here)
        assert not any(overlap(box, head) for head in heads)
        assert box[0] < 240 < box[2], "its tip is still at whom it is of"


def test_a_bubble_stays_on_its_side_and_its_place_is_told_as_drawn() -> None:
    here = replace(EMPTY, bubbles=(says(2.4, 1.8, "a table for 2, please"),))
    heads: list[Box] = [(280.0, 160.0, 300.0, 180.0)]
    drawn = Panel(632, 360, lambda x, y, z: (100 * x, 360 - 100 * y), lambda moment: heads)
    (moved,) = drawn.covered(here)
    heads[:] = [(306.0, 160.0, 400.0, 180.0)]  # hardly covered from the middle
    assert drawn.covered(replace(here, time=1.0)) == [moved]
    from PIL import Image

    room = Image.new("RGB", (480, 360), (9, 99, 9))
    picture = drawn.draw(room, replace(here, time=2.0)).crop((0, 0, 480, 360))
    seen = picture.point(lambda v: 255 if v > 110 else 0).getbbox()
    assert seen is not None
    assert all(abs(a - b) <= 2 for a, b in zip(seen, moved))


def test_the_longest_line_of_a_plan_fits() -> None:
    long = Row("send the order of table1 to the kitchen", "next")
    wide = Panel(1260, 720, lambda x, y, z: (0.0, 0.0))
    assert wide.letters_of((Row("walk from n1 to n2", "now"),)) == wide.text
    assert round(wide.text * 0.75) <= wide.letters_of((long, Row("walk", "now"))) < wide.text


def test_a_film_tells_the_room_what_bubbles_will_hide() -> None:
    from waiter_cli.pictures.film import Film

    told: list[Any] = []
    scene: Any = SimpleNamespace(draw=lambda moment, hidden: told.append(list(hidden)))
    beside: Any = SimpleNamespace(covered=lambda moment: [(1, 2, 3, 4)], draw=lambda *both: both)
    Film(scene, beside, (), 12.0, ("a.mp4",))._picture(EMPTY)
    assert told == [[(1, 2, 3, 4)]]
