"""The cells of a drawing in characters: places, paths that join, words that do not touch."""

from __future__ import annotations

from dataclasses import replace

from tests.support.playing import layout_of
from tests.support.rule_cases import HALL, at
from waiter_cli.drawing.characters import ASCII, BOXES
from waiter_cli.drawing.subject import make_subject
from waiter_cli.drawing.text_cells import Sheet
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.model.layout import Layout

CROSS = """\
nodes: {m: [0, 0], e: [4, 0], w: [-4, 0], n: [0, 4], s: [0, -4]}
edges: [[m, e], [m, w], [m, n], [m, s]]
entrance: s
agent: m
tables: {}
"""


def sheet_of(layout: Layout, width: int = 80, **more: object) -> Sheet:
    return Sheet(make_subject(layout, **more), width, BOXES)  # type: ignore[arg-type]


def plain(sheet: Sheet) -> list[str]:
    return sheet.lines(lambda text, style: text)


def test_north_is_up_and_metres_are_columns_and_rows() -> None:
    sheet = sheet_of(read_layout(CROSS, "x"))
    (x, y), (east, _), (_, north) = (sheet.cell(*at) for at in ((0, 0), (1, 0), (0, 1)))
    assert east > x and north < y
    assert sheet.across >= sheet.down


def test_paths_join_where_they_cross() -> None:
    sheet = sheet_of(read_layout(CROSS, "x"))
    sheet.draw_floor()
    column, row = sheet.nodes["m"]
    lines = plain(sheet)
    top = min(y for _, y in sheet.paths)
    assert lines[row - top][column] == "┼" and lines[row - top][column + 1] == "─"
    assert lines[row - top - 1][column] == "│"


def test_a_path_one_way_has_a_head() -> None:
    layout = read_layout(CROSS, "x")
    sheet = sheet_of(replace(layout, one_way=frozenset({("m", "e")})))
    sheet.draw_floor()
    assert BOXES.heads[0] in "".join(plain(sheet))


def test_everybody_and_every_name_that_fits_is_there() -> None:
    sheet = sheet_of(read_layout(CROSS, "x"))
    sheet.draw_floor()
    sheet.draw_people()
    text = "\n".join(plain(sheet))
    assert "R" in text and BOXES.entrance in text and text.count(BOXES.node) == 3
    assert all(f" {name}" in text or f"{name} " in text for name in "ewns")


def test_a_drawing_is_no_wider_than_asked() -> None:
    for width in (24, 40, 80):
        sheet = sheet_of(layout_of("report_large"), width)
        sheet.draw_floor()
        sheet.draw_people()
        assert max(map(len, plain(sheet))) <= width


def test_styles_go_in_runs() -> None:
    sheet = sheet_of(read_layout(CROSS, "x"))
    sheet.write((0, 0), "ab", "bold")
    sheet.write((2, 0), "c", "red")
    assert sheet.lines(lambda text, style: f"<{style}:{text}>") == ["<bold:ab><red:c>"]


def test_a_word_is_apart_from_others() -> None:
    sheet = sheet_of(read_layout(CROSS, "x"))
    sheet.write((5, 0), "ab", "")
    assert not sheet.apart((3, 0), 2) and not sheet.apart((7, 0), 1)
    assert sheet.apart((2, 0), 2) and sheet.apart((5, 1), 2)


def test_a_name_that_is_cut_is_unlike_others_and_told() -> None:
    sheet = sheet_of(HALL)
    short = sheet.fitted("small", 3)
    sheet.name((0, 0), short, "small", "")
    assert len(short) <= 3 and sheet.short == {short: "small"}
    assert sheet.fitted("big", 3) == "big"
    pointed = sheet_of(HALL, highlights=["big"])
    assert pointed.shown("big") == "*big*" and pointed.fitted("big", 3) == "*b*"


def test_the_legend_tells_only_what_is_there() -> None:
    empty = sheet_of(read_layout(CROSS, "x")).legend()
    assert empty[0] == "R robot" and not any("guest" in word or "waiter" in word for word in empty)
    full = sheet_of(HALL, state=at("a", waiting=(("c1",),))).legend()
    assert "w waiter" in full and any("guest" in word for word in full)
    ascii_ = Sheet(make_subject(HALL), 80, ASCII).legend()
    assert all(word.isascii() for word in ascii_)
