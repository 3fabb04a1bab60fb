"""``waiter layout draw``: what is in the drawings, in three forms; files whole or not at all."""

from __future__ import annotations

import io
import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.drawing.characters import ASCII, BOXES, fits_encoding
from waiter_cli.drawing.label_placement import Area, Placer, around
from waiter_cli.drawing.picture import draw_svg
from waiter_cli.drawing.subject import make_subject
from waiter_cli.drawing.text import draw_text
from waiter_cli.errors import InputError
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.layout_tools.generate_floor import build_layout
from waiter_cli.room.label_boxes import overlap

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plan of seven steps: four to the entrance, one to table1."""
    ran = waiter("plan", "--scenario", "b1", "--json")
    assert ran.json()["horizon"] == 7
    path = tmp_path_factory.mktemp("plans") / "b1.json"
    path.write_text(ran.out)
    return path


def words_of(svg: str) -> list[str]:
    """The texts of an SVG document, which is well-formed."""
    return [element.text or "" for element in ElementTree.fromstring(svg).iter(f"{SVG}text")]


# -- text ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", built_in("layout"))
@pytest.mark.parametrize("characters", [BOXES, ASCII], ids=["boxes", "ascii"])
def test_every_name_is_in_the_text_drawing(name: str, characters: object) -> None:
    layout = read_layout_file(name)
    text = draw_text(make_subject(layout), 80, characters)  # type: ignore[arg-type]
    assert max(map(len, text.splitlines())) <= 80
    for table in layout.tables:
        assert table.name in text
    staff = {node for _, node in layout.waiters}
    named = sum(f"{node.name}" in text for node in layout.nodes if node.name not in staff)
    assert named >= len(layout.nodes) - len(staff) - 1
    if characters is ASCII:
        assert text.isascii()


def test_paths_have_corners_and_crossings() -> None:
    layout = read_layout(
        "nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [2, 2], e: [2, -2], f: [4, 2]}\n"
        "edges: [[a, b], [b, c], [d, e], [d, f]]\nentrance: a\nagent: a\n"
        "tables: {t1: {capacity: 1, nodes: [f], at: [5, 2.6]}}\n",
        "f",
    )
    rows = draw_text(make_subject(layout)).splitlines()
    assert any("R" in row and "─" in row and "●" in row for row in rows)
    assert sum("│" in row for row in rows) >= 4


def test_a_drawing_of_a_large_restaurant_keeps_its_columns() -> None:
    layout = build_layout(3, 120, 50, bar=True, waiters=3)
    text = draw_text(make_subject(layout), 80)
    assert max(map(len, text.splitlines())) <= 80
    assert all(f"t{k}" in text for k in (1, 12, 33))
    assert "bar" in text
    assert "w3" in text


def test_the_walk_has_its_step_numbers(plan: Path) -> None:
    ran = waiter("layout", "draw", "--plan", str(plan))
    assert ran.code == 0
    drawing, listing = ran.out.split("R robot")
    for number in ("0", "1", "2", "3", "5"):
        assert (
            f" {number} " in drawing
            or f"─{number}─" in drawing
            or f"-{number}-" in drawing
            or f"{number}." in drawing
        )
    assert "[4]" in drawing
    assert "[6]" in drawing
    assert "0-3  walk n1 -> n2 -> n3 -> n4 -> n5" in listing
    assert "6  seat c1 at table1" in listing


def test_highlights_show_without_colour_and_wrong_ones_are_faults() -> None:
    ran = waiter("layout", "draw", "report", "--highlight", "table1", "--highlight", "n3-n4")
    assert "*table1*" in ran.out
    assert "o****" in ran.out
    ran = waiter("layout", "draw", "report", "--highlight", "tabel1", "--highlight", "n1-n7")
    assert ran.code == 2
    assert "did you mean table1" in ran.err
    assert "there is no edge n1-n7" in ran.err
    with pytest.raises(InputError, match="nothing in report is called x"):
        make_subject(read_layout_file("report"), highlights=["x"])


def test_box_characters_only_where_the_encoding_has_them() -> None:
    assert fits_encoding("utf-8") is BOXES
    assert fits_encoding("ascii") is ASCII
    assert fits_encoding("latin-1") is ASCII
    assert fits_encoding(None) is ASCII
    assert fits_encoding("no-such") is ASCII


def test_styles_change_nothing_but_the_style() -> None:
    subject = make_subject(read_layout_file("bistro"), highlights=["mid2", "bar"])
    marked = draw_text(subject, style=lambda text, style: f"<{style}>{text}</>")
    assert "<green bold>" in marked
    plain = draw_text(subject)
    import re

    assert re.sub(r"<[a-z/ ]*>", "", marked) == plain


# -- pictures -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", built_in("layout"))
def test_every_name_is_in_the_svg_picture(name: str) -> None:
    layout = read_layout_file(name)
    svg = draw_svg(make_subject(layout))
    words = words_of(svg)
    for node in layout.nodes:
        assert any(word.split(" ")[0] == node.name for word in words)
    for table in layout.tables:
        assert table.name in words
    assert svg == draw_svg(make_subject(layout))


def test_svg_escapes_what_xml_would_misread() -> None:
    text = generate_layout(1, 6, 2)
    named = text.replace("name: generated", 'name: "A & B <é>"', 1)
    assert named != text
    words = words_of(draw_svg(make_subject(read_layout(named, "f"))))
    assert "A & B <é>" in words


def test_the_picture_of_a_plan_has_numbers_and_words(plan: Path, tmp_path: Path) -> None:
    target = tmp_path / "walk.svg"
    ran = waiter("layout", "draw", "report", "--plan", str(plan), "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    words = words_of(target.read_text())
    assert {"0", "1", "2", "3", "5", "4 pick c1", "6 seat c1"} <= set(words)
    assert "walk n1 → n2 → n3 → n4 → n5" in words


def test_a_plan_that_is_not_valid_is_drawn_as_far_as_it_goes(plan: Path, tmp_path: Path) -> None:
    document = json.loads(plan.read_text())
    document["actions"][2]["args"] = ["agent", "n7"]
    bad = tmp_path / "bad.json"
    bad.write_text(json.dumps(document))
    ran = waiter("layout", "draw", "--plan", str(bad))
    assert ran.code == 0
    assert "the plan is not valid" in ran.err
    assert "0-1  walk n1 -> n2 -> n3\n" in ran.out
    assert "seat c1" not in ran.out


def test_png_is_a_picture_of_the_same_shape(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    png, svg = tmp_path / "a.png", tmp_path / "a.svg"
    ran = waiter("layout", "draw", "report", "--png", str(png), "--svg", str(svg))
    assert ran.code == 0
    with image.open(io.BytesIO(png.read_bytes())) as picture:
        root = ElementTree.fromstring(svg.read_text())
        assert picture.size == (2 * int(root.attrib["width"]), 2 * int(root.attrib["height"]))
        colours = {colour for _, colour in picture.convert("RGB").getcolors(1 << 20)}
        assert (0x0F, 0x76, 0x6E) in colours  # the robot
        assert (0xC9, 0x93, 0x5F) in colours  # a table


def test_png_without_pillow_says_what_to_get(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "PIL", None)
    target = tmp_path / "a.png"
    ran = waiter("layout", "draw", "report", "--png", str(target))
    assert ran.code == 5
    assert "pip install" in ran.err and ".svg" in ran.err
    assert not target.exists()


def test_faults_of_the_command_line(tmp_path: Path) -> None:
    assert waiter("layout", "draw").code == 2
    ran = waiter("layout", "draw", "report", "-o", str(tmp_path / "a.gif"))
    assert ran.code == 2
    assert ".svg, .png or .txt" in ran.err
    ran = waiter("layout", "draw", "report", "-o", str(tmp_path / "no" / "a.svg"))
    assert ran.code == 2
    assert "cannot write: no such file" in ran.err
    assert ran.err.endswith(f"  hint: make the folder {tmp_path / 'no'} first\n")
    names = "nodes: [a, b]\nedges: [[a, b]]\nentrance: a\nagent: a\ntables: {t: {capacity: 1, nodes: [b]}}\n"
    some = names.replace("[a, b]", "{a: [0, 0], b: }", 1)
    ran = waiter("layout", "draw", "-", stdin=some)
    assert ran.code == 2 and "<stdin>:1:" in ran.err
    assert waiter("layout", "draw", "-", "--watch", stdin=names).code == 2


def test_without_coordinates_the_nodes_are_placed_by_their_edges(tmp_path: Path) -> None:
    text = (
        "nodes: [a, b, c, d]\nedges: [[a, b], [b, c], [c, d], [d, a]]\nentrance: a\nagent: b\n"
        "tables:\n  t1: {capacity: 2, nodes: [c]}\n  t2: {capacity: 4, nodes: [d, c]}\n"
    )
    ran = waiter("layout", "draw", "-", stdin=text)
    assert ran.code == 0 and "no coordinates; they are drawn where they fit" in ran.err
    assert all(name in ran.out for name in ("t1", "t2"))
    assert waiter("layout", "draw", "-", stdin=text).out == ran.out, "the same picture again"
    picture = tmp_path / "a.svg"
    assert waiter("layout", "draw", "-", "-o", str(picture), stdin=text).code == 0
    assert "t2" in picture.read_text()


def test_files_are_replaced_whole(tmp_path: Path) -> None:
    target = tmp_path / "plan of mine.txt"
    target.write_text("old")
    target.chmod(0o640)
    assert waiter("layout", "draw", "report", "-o", str(target)).code == 0
    assert target.read_text().startswith("report: 8 nodes")
    assert target.stat().st_mode & 0o777 == 0o640
    assert [path.name for path in tmp_path.iterdir()] == [target.name]


@pytest.mark.parametrize("metres", [0, 0.01, 3, 900_000])
def test_rooms_of_any_size_are_drawn(metres: float, tmp_path: Path) -> None:
    layout = read_layout(
        f"nodes: {{a: [0, 0], b: [{metres}, 0], c: [0, {metres}]}}\nedges: [[a, b], [b, c]]\n"
        f"entrance: a\nagent: b\ntables: {{a_table_with_a_long_name: {{capacity: 40, nodes: [c]}}}}\n"
        f"walls: [[[0, 0], [0, 0]], [[0, 1], [{metres}, 1]]]\nbar: [c]\n",
        "f",
    )
    subject = make_subject(layout)
    root = ElementTree.fromstring(draw_svg(subject))
    assert 500 < int(root.attrib["width"]) < 10_000
    for width in (40, 80, 200):
        lines = draw_text(subject, width, ASCII).splitlines()
        assert max(map(len, lines)) <= width + 12
        assert len(lines) < 130


# -- labels -----------------------------------------------------------------------------------------


def test_labels_keep_off_what_is_there() -> None:
    placer = Placer(Area(0, 0, 200, 200))
    placer.block(Area(100, 0, 200, 200))
    first = placer.place(around((90, 100), (40, 10), (8,)))
    assert first.right <= 100
    second = placer.place(around((90, 100), (40, 10), (8, 20)))
    assert overlap(second, first) == 0
    assert overlap(second, Area(100, 0, 200, 200)) == 0
    assert placer.cost(Area(-10, 0, 10, 10)) > 0
