"""A picture as PNG: what is drawn where, in which colour, and at which size."""

from __future__ import annotations

import io
import sys

import pytest

from waiter_cli.errors import MissingError

Image = pytest.importorskip("PIL.Image")

from waiter_cli.drawing import png  # noqa: E402
from waiter_cli.drawing.png import PngCanvas  # noqa: E402

WHITE, RED = (255, 255, 255), (255, 0, 0)


def drawn(canvas: PngCanvas):  # type: ignore[no-untyped-def]
    return Image.open(io.BytesIO(canvas.document()))


def at(canvas: PngCanvas, x: float, y: float) -> tuple[int, ...]:
    """The colour at a place of the picture; two pixels of the file are one."""
    found: tuple[int, ...] = drawn(canvas).getpixel((round(2 * x), round(2 * y)))
    return found


@pytest.fixture
def canvas() -> PngCanvas:
    return PngCanvas(60, 40, "#ffffff", "a title")


def test_the_file_is_twice_as_large_and_has_its_title(canvas: PngCanvas) -> None:
    image = drawn(canvas)
    assert image.size == (120, 80) and image.text["Title"] == "a title"
    assert at(canvas, 30, 20) == WHITE


def test_a_picture_of_too_many_pixels_is_drawn_less_smoothly(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(png, "_MOST", 60 * 40 * 4)
    assert drawn(PngCanvas(60, 40, "#ffffff", "")).size == (120, 80)
    monkeypatch.setattr(png, "_MOST", 100)
    assert drawn(PngCanvas(60, 40, "#ffffff", "")).size == (60, 40)


def test_shapes_are_filled_inside_and_not_outside(canvas: PngCanvas) -> None:
    canvas.box((30, 20), (20, 10), "#ff0000")
    assert at(canvas, 30, 20) == at(canvas, 22, 17) == RED
    assert at(canvas, 18, 20) == at(canvas, 30, 27) == WHITE
    canvas.circle((10, 10), 5, "#00ff00")
    assert at(canvas, 10, 6) == (0, 255, 0) and at(canvas, 6, 6) == WHITE
    canvas.polygon([(40, 2), (58, 2), (58, 14)], "#0000ff")
    assert at(canvas, 56, 5) == (0, 0, 255) and at(canvas, 42, 12) == WHITE


def test_a_box_is_turned_and_its_corners_are_round(canvas: PngCanvas) -> None:
    canvas.box((30, 20), (20, 4), "#ff0000", angle=90)
    assert at(canvas, 30, 12) == RED and at(canvas, 22, 20) == WHITE
    other = PngCanvas(60, 40, "#ffffff", "")
    other.box((30, 20), (20, 20), "#ff0000", radius=10)
    assert at(other, 21, 11) == WHITE and at(other, 30, 11) == RED


def test_a_frame_is_empty_inside(canvas: PngCanvas) -> None:
    canvas.box((30, 20), (20, 10), "", "#ff0000", 2.0)
    assert at(canvas, 30, 15) == RED and at(canvas, 30, 20) == WHITE


def test_a_dashed_line_has_gaps(canvas: PngCanvas) -> None:
    canvas.line([(0, 20), (60, 20)], "#ff0000", 1.0, (6.0, 6.0))
    colours = [at(canvas, x, 20) for x in (3, 9, 15, 21)]
    assert colours == [RED, WHITE, RED, WHITE]


def test_text_stands_at_its_anchor(canvas: PngCanvas) -> None:
    canvas.text((30, 20), "HHHH", 12, "#ff0000", anchor="start")
    left = [at(canvas, x, 20) for x in range(29)]
    right = [at(canvas, x, 20) for x in range(30, 58)]
    assert set(left) == {WHITE} and RED in right
    before = canvas.document()
    canvas.text((30, 20), "", 12, "#ff0000")
    assert canvas.document() == before


def test_without_pillow_the_mend_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(MissingError, match="Pillow"):
        PngCanvas(10, 10, "#ffffff", "")
