"""Tables beside their nodes: clear of paths and of other tables, and the first side that will do."""

from __future__ import annotations

import pytest

from waiter_cli.model.geometry import GAP, beside, distance_to_segment

SIZE = (1.0, 0.8)
BELOW = (0.0, round(-GAP - 0.4, 6))
ABOVE = (0.0, round(GAP + 0.4, 6))
RIGHT = (round(GAP + 0.5 + 0.35, 6), 0.0)


@pytest.mark.parametrize(
    ("point", "metres"),
    [((2.0, 1.0), 1.0), ((-3.0, 4.0), 5.0), ((7.0, 4.0), 5.0), ((1.0, 0.0), 0.0)],
    ids=["beside", "before its start", "past its end", "on it"],
)
def test_metres_to_a_segment(point: tuple[float, float], metres: float) -> None:
    assert distance_to_segment(point, ((0.0, 0.0), (4.0, 0.0))) == pytest.approx(metres)


def test_a_segment_without_length_is_a_point() -> None:
    assert distance_to_segment((3.0, 4.0), ((0.0, 0.0), (0.0, 0.0))) == 5.0


def test_a_table_with_room_on_every_side_stands_below() -> None:
    assert beside((0.0, 0.0), SIZE, [], []) == BELOW


def test_a_table_gives_way_to_a_path() -> None:
    down = ((0.0, 0.0), (0.0, -5.0))
    assert beside((0.0, 0.0), SIZE, [down], []) == RIGHT
    across = ((-5.0, 0.0), (5.0, 0.0))
    assert beside((0.0, 0.0), SIZE, [down, across], []) == ABOVE


def test_a_table_gives_way_to_another_one() -> None:
    across = ((0.0, -5.0), (0.0, 5.0))
    assert beside((0.0, 0.0), SIZE, [across], []) == RIGHT
    assert beside((0.0, 0.0), SIZE, [across], [RIGHT]) == (-RIGHT[0], 0.0)


def test_what_is_far_away_does_not_matter() -> None:
    far = ((100.0, -100.0), (100.0, 100.0))
    assert beside((0.0, 0.0), SIZE, [far], [(0.0, -60.0)]) == BELOW
