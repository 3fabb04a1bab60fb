"""Tables, chairs and the bar in characters."""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.drawing.characters import BOXES
from waiter_cli.drawing.subject import make_subject
from waiter_cli.drawing.text_cells import Sheet
from waiter_cli.drawing.text_tables import draw_tables
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.model.state import State

TEXT = """\
nodes: {a: [0, 0], b: [6, 0]}
edges: [[a, b]]
entrance: a
agent: a
bar: {nodes: [a], from: [-2, -1], to: [-1, 1]}
tables:
  terrace_left: {capacity: 4, nodes: [b], at: [6, 3], size: [1.6, 1.6]}
"""
LAYOUT = read_layout(TEXT, "x")
STATE = State("a", chairs=(("terrace_left", 4),))


def drawn(state: State = STATE, width: int = 80, **more: object) -> tuple[Sheet, str]:
    sheet = Sheet(make_subject(LAYOUT, state, **more), width, BOXES)  # type: ignore[arg-type]
    draw_tables(sheet)
    return sheet, "\n".join(sheet.lines(lambda text, style: text))


def test_a_table_is_a_frame_with_its_name_and_its_seats() -> None:
    _, text = drawn()
    assert all(text.count(corner) == 1 for corner in BOXES.frame[:4])
    assert "terrace_left" in text and "4 seats" in text


def test_the_bar_is_named() -> None:
    assert " bar " in drawn()[1] and "*bar*" in drawn(highlights=["bar"])[1]


def test_chairs_guests_and_places_without_a_chair() -> None:
    assert drawn()[1].count(BOXES.chair) == 4
    seated = replace(STATE, seated=(("terrace_left", ("c1",)),), chairs=(("terrace_left", 3),))
    text = drawn(seated)[1]
    assert (text.count(BOXES.guest), text.count(BOXES.chair), text.count(BOXES.place)) == (1, 2, 1)


def test_what_guests_wait_for_is_told() -> None:
    asked = replace(STATE, wants_bill=frozenset({"terrace_left"}))
    assert "bill" in drawn(asked)[1] and "bill" not in drawn()[1]


def test_where_there_is_little_room_names_are_cut_and_told() -> None:
    sheet, text = drawn(width=26)
    assert "terrace_left" not in text and "terrace_left" in sheet.short.values()
    assert next(short for short, name in sheet.short.items() if name == "terrace_left") in text


def test_where_there_is_hardly_any_room_tables_are_words() -> None:
    far = TEXT.replace("b: [6, 0]", "b: [60, 0]").replace("at: [6, 3]", "at: [60, 3]")
    sheet = Sheet(make_subject(read_layout(far, "x")), 60, BOXES)
    draw_tables(sheet)
    text = "\n".join(sheet.lines(lambda text, style: text))
    assert not set(BOXES.frame[:4]) & set(text) and "4" in text


def test_a_table_that_is_pointed_out_has_stars() -> None:
    assert "*terrace_left*" in drawn(highlights=["terrace_left"])[1]
