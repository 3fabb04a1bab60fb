"""A picture as SVG: each shape as an element with its colours, texts that XML can hold."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from waiter_cli.drawing.svg import SvgCanvas

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def canvas() -> SvgCanvas:
    return SvgCanvas(200, 100.5, "#ffffff", "a <title> & more")


def last(canvas: SvgCanvas) -> ElementTree.Element:
    return list(ElementTree.fromstring(canvas.document()))[-1]


def test_the_file_has_its_size_its_title_and_its_paper(canvas: SvgCanvas) -> None:
    root = ElementTree.fromstring(canvas.document())
    assert (root.attrib["width"], root.attrib["viewBox"]) == ("200", "0 0 200 100.5")
    title, paper = root
    assert title.text == "a <title> & more" and paper.attrib["fill"] == "#ffffff"


def test_a_box_is_where_its_centre_says(canvas: SvgCanvas) -> None:
    canvas.box((50, 40), (20, 10), "#111111", "#222222", 1.5, radius=3, angle=30)
    shape = last(canvas)
    assert [shape.attrib[key] for key in ("x", "y", "width", "height", "rx")] == [
        "40", "35", "20", "10", "3",
    ]  # fmt: skip
    assert shape.attrib["transform"] == "rotate(30 50 40)"
    assert (shape.attrib["stroke"], shape.attrib["stroke-width"]) == ("#222222", "1.5")


def test_a_frame_is_empty_and_may_be_dashed(canvas: SvgCanvas) -> None:
    canvas.box((50, 40), (20, 10), "", "#222222", 1.0, dashed=True, angle=180)
    shape = last(canvas)
    assert shape.attrib["fill"] == "none" and "stroke-dasharray" in shape.attrib
    assert "transform" not in shape.attrib, "turned half round it is the same"


def test_lines_polygons_and_discs(canvas: SvgCanvas) -> None:
    canvas.line([(0, 0), (1.234, 5)], "#333333", 2.0, (1.0, 5.0))
    line = last(canvas)
    assert (line.attrib["points"], line.attrib["stroke-dasharray"]) == ("0,0 1.23,5", "1 5")
    canvas.polygon([(0, 0), (1, 0), (0, 1)], "#444444")
    assert last(canvas).tag == f"{SVG}polygon" and "stroke" not in last(canvas).attrib
    canvas.circle((5, 6), 7, "", "#555555", 1)
    assert [last(canvas).attrib[key] for key in ("cx", "cy", "r", "fill")] == [
        "5",
        "6",
        "7",
        "none",
    ]


def test_a_text_is_escaped_and_stands_on_its_middle(canvas: SvgCanvas) -> None:
    canvas.text((10, 20), "a<b>&\x1b\u202e", 10, "#666666", bold=True, halo="#ffffff")
    text = last(canvas)
    assert text.text is not None and text.text.startswith("a<b>&")
    assert "\x1b" not in canvas.document() and "\u202e" not in canvas.document()
    assert (text.attrib["y"], text.attrib["text-anchor"]) == ("23.6", "middle")
    assert text.attrib["stroke"] == "#ffffff" and text.attrib["font-weight"] == "600"
    canvas.text((10, 20), "x", 10, "#666666", anchor="start")
    assert "text-anchor" not in last(canvas).attrib
