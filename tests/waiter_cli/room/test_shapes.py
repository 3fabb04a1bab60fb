"""How far a straight walk keeps from a box, beside a search along the walk."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from waiter_cli.room.shapes import Box, distance, walk_distance

places = st.tuples(st.floats(-3, 3), st.floats(-3, 3))
boxes = st.builds(
    Box,
    st.just("t"),
    st.floats(-1, 1),
    st.floats(-1, 1),
    st.floats(0.05, 1.5),
    st.floats(0.05, 1.5),
    st.one_of(st.just(0.0), st.floats(-3.2, 3.2)),
)


def searched(start: tuple[float, float], end: tuple[float, float], box: Box) -> float:
    """The least distance by halving the walk by thirds: the distance to a box is convex along it."""
    (ax, ay), (bx, by) = start, end

    def at(part: float) -> float:
        return distance(ax + part * (bx - ax), ay + part * (by - ay), box)

    low, high = 0.0, 1.0
    for _ in range(90):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, right) if at(left) <= at(right) else (left, high)
    return min(at(low), at(0.0), at(1.0))


@settings(max_examples=300)
@given(places, places, boxes)
@example((-2.0, 0.0), (2.0, 0.0), Box("t", 0.0, 0.0, 0.5, 0.5))
@example((-2.0, 0.5), (2.0, 0.5), Box("t", 0.0, 0.0, 0.5, 0.5))
@example((0.1, 0.2), (0.1, 0.2), Box("t", 0.0, 0.0, 0.5, 1.0, 0.4))
@example((2.0, 2.0), (2.0, 2.0), Box("t", 0.0, 0.0, 0.5, 1.0, 0.4))
@example((-2.0, 1.0), (1.0, -2.0), Box("t", 0.0, 0.0, 0.5, 1.0))
def test_a_walk_keeps_as_far_from_a_box_as_its_nearest_point(
    start: tuple[float, float], end: tuple[float, float], box: Box
) -> None:
    found, least = walk_distance(start, end, box), searched(start, end, box)
    assert found <= least + 1e-9
    if found <= 2.0:  # farther away a bound will do
        assert abs(found - least) < 1e-9
    assert abs(found - walk_distance(end, start, box)) < 1e-9


def test_a_box_far_away_is_answered_by_a_bound() -> None:
    box = Box("t", 0.0, 0.0, 0.5, 0.5)
    assert 2.0 < walk_distance((5.0, 0.0), (6.0, 0.0), box) <= distance(5.0, 0.0, box)
