"""Text in pictures."""

from __future__ import annotations

import sys

import pytest

from waiter_cli.errors import MissingError
from waiter_cli.labels.lettering import put, require, width_of


def test_what_is_written_is_as_wide_as_it_is_said_to_be() -> None:
    image_module = pytest.importorskip("PIL.Image")
    draw_module = pytest.importorskip("PIL.ImageDraw")
    image = image_module.new("L", (400, 60), 0)
    put(draw_module.Draw(image), (10, 30), "table for two", 24, 255)
    left, _, right, _ = image.getbbox()
    assert abs((right - left) - width_of("table for two", 24)) <= 4
    assert 8 <= left <= 14


def test_a_halo_is_written_round_the_letters() -> None:
    image_module = pytest.importorskip("PIL.Image")
    draw_module = pytest.importorskip("PIL.ImageDraw")
    boxes = []
    for halo in (None, 128):
        image = image_module.new("L", (200, 60), 0)
        put(draw_module.Draw(image), (20, 30), "n1", 24, 255, halo=halo, halo_width=3)
        boxes.append(image.getbbox())
    (a, b, c, d), (e, f, g, h) = boxes
    assert e <= a - 2 and f <= b - 2 and g >= c + 2 and h >= d + 2


def test_a_missing_library_is_said_with_the_mend(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numpy", None)
    with pytest.raises(MissingError, match="pictures need numpy, which is missing"):
        require()
