"""What a label would cover, in weighted pixels."""

from __future__ import annotations

import pytest

from waiter_cli.room.label_boxes import WeightedBoxes, length_inside, touching


def test_a_box_costs_what_it_hides() -> None:
    obstacles = WeightedBoxes()
    obstacles.box((100.0, 100.0, 200.0, 200.0), 0.5)
    assert obstacles.cost((150.0, 150.0, 250.0, 250.0)) == 0.5 * 50 * 50
    assert obstacles.cost((200.0, 100.0, 300.0, 200.0)) == 0.0


def test_a_line_costs_its_length_inside() -> None:
    obstacles = WeightedBoxes()
    obstacles.line((0.0, 50.0, 300.0, 50.0), 3.0)
    assert obstacles.cost((100.0, 40.0, 160.0, 60.0)) == pytest.approx(180.0)
    assert length_inside((0, 0, 30, 40), (-9, -9, 99, 99)) == pytest.approx(50.0)


def test_what_is_in_several_cells_counts_once() -> None:
    obstacles = WeightedBoxes()
    obstacles.box((0.0, 0.0, 1000.0, 10.0), 1.0)
    assert obstacles.cost((0.0, 0.0, 1000.0, 10.0)) == pytest.approx(10_000.0)


def test_what_a_label_belongs_on_costs_it_nothing() -> None:
    boxes = WeightedBoxes()
    boxes.box((0.0, 0.0, 10.0, 10.0), 2.0, "walk n1-n2")
    boxes.box((0.0, 0.0, 10.0, 10.0), 1.0)
    label = (0.0, 0.0, 10.0, 10.0)
    assert boxes.cost(label) == 300.0
    assert boxes.cost(label, {"walk n1-n2"}) == 100.0


def test_what_lies_far_off_touches_nothing() -> None:
    near, far = (5.0, 5.0, 9.0, 9.0), (90.0, 0.0, 99.0, 9.0)
    assert touching([(0.0, 0.0, 6.0, 6.0), (8.0, 8.0, 20.0, 20.0)], [near, far]) == [near]
