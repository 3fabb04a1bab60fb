"""Labels where they cover least: off what is in the way, in the frame, the first of equals."""

from __future__ import annotations

import pytest

from waiter_cli.drawing.label_placement import Area, Placer, around, centred, led, nearest

FRAME = Area(0.0, 0.0, 100.0, 100.0)
SIZE = (10.0, 10.0)


def test_the_first_of_equals_is_taken_and_is_in_the_way_from_then_on() -> None:
    placer = Placer(FRAME)
    places = [centred((20.0, 20.0), SIZE), centred((60.0, 60.0), SIZE)]
    assert placer.place(places) == places[0]
    assert placer.place(places) == places[1]


def test_a_label_keeps_off_what_weighs_more() -> None:
    placer = Placer(FRAME)
    places = [centred((20.0, 20.0), SIZE), centred((60.0, 60.0), SIZE)]
    placer.block(places[0], 5.0)
    placer.block(places[1], 1.0)
    assert placer.cost(places[0]) == 5 * placer.cost(places[1]) > 0
    assert placer.place(places) == places[1]


def test_a_label_is_let_onto_what_it_belongs_to() -> None:
    placer, place = Placer(FRAME), centred((50.0, 50.0), SIZE)
    placer.block_line((0.0, 50.0), (100.0, 50.0), 4.0, 3.0, "edge a b")
    assert placer.cost(place) > 0 == placer.cost(place, ("edge a b",))
    assert placer.line_cost((10.0, 50.0), (90.0, 50.0), 4.0) > 0
    assert placer.line_cost((10.0, 90.0), (90.0, 90.0), 4.0) == 0


def test_sticking_out_of_the_frame_counts_most() -> None:
    placer = Placer(FRAME)
    out, inside = centred((0.0, 50.0), SIZE), centred((50.0, 50.0), SIZE)
    placer.block(inside, 5.0)
    assert placer.place([out, inside]) == inside


def test_later_places_cost_more() -> None:
    placer = Placer(FRAME)
    places = [centred((20.0, 20.0), SIZE), centred((60.0, 60.0), SIZE)]
    placer.block(places[0], 0.1)
    assert placer.place(places, later=50.0) == places[0]


@pytest.mark.parametrize(
    ("spot", "point"),
    [((0.0, 50.0), (40.0, 50.0)), ((90.0, 90.0), (60.0, 60.0)), ((50.0, 50.0), (50.0, 50.0))],
)
def test_the_nearest_point_of_an_area(
    spot: tuple[float, float], point: tuple[float, float]
) -> None:
    assert nearest(Area(40.0, 40.0, 60.0, 60.0), spot) == point


def test_a_line_leads_from_off_the_spot_to_the_label_where_it_is_long_enough() -> None:
    area = Area(40.0, 40.0, 60.0, 60.0)
    assert led(area, (0.0, 50.0), 10.0) == ((10.0, 50.0), (37.5, 50.0))
    assert led(area, (30.0, 50.0), 8.0) is None


def test_places_round_a_point_are_clear_of_it_and_nearest_first() -> None:
    found = around((50.0, 50.0), SIZE, [4.0, 9.0])
    assert len(found) == 32 and found[0].middle == (59.0, 50.0)
    for area in found:
        assert nearest(area, (50.0, 50.0)) != (50.0, 50.0)
        assert (area.right - area.left, area.bottom - area.top) == SIZE
