"""Floor plans in characters: words stand apart, whole or explained; no drawing drops what others show."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.sampling import mostly_slow
from tests.support.walks import busy
from waiter_cli.drawing.canvas import ROBOTS
from waiter_cli.drawing.characters import ASCII, BOXES, Characters
from waiter_cli.drawing.subject import Subject, make_subject
from waiter_cli.drawing.text import draw_text
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.layout_tools.generate_floor import build_layout


def parts(text: str) -> tuple[str, str]:
    """The drawing without its heading, and what is below it."""
    drawing = text.split("\n\n", 1)[1]
    drawing, below = drawing.split("\n\nR robot", 1)
    return drawing, below


def short_names(below: str) -> dict[str, str]:
    """What the line of short names says."""
    line = " ".join(below.partition("short names: ")[2].split("\n\n")[0].split())
    return dict(re.findall(r"(\S+) is (\w+)", line))


def known_words(subject: Subject, below: str) -> set[str]:
    """Everything that may stand in a drawing as a word."""
    layout, state = subject.layout, subject.state
    words = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    words |= {name for name, _ in layout.waiters} | {"R", "bar", "seats", "seat", "bill", "order"}
    words |= {guest for party in state.waiting for guest in party}
    words |= {str(table.capacity) for table in layout.tables} | {
        str(leg.step) for leg in subject.legs
    }
    told = short_names(below)
    words |= set(told)
    stems = {re.sub(r"\d+$", "", short): re.sub(r"\d+$", "", name) for short, name in told.items()}
    for short, name in stems.items():  # "… and so on"
        if "and so on" in " ".join(below.split()):
            words |= {w.replace(name, short, 1) for w in words if re.fullmatch(name + r"\d+", w)}
    return words


@pytest.mark.parametrize("width", [44, 80, 140])
@pytest.mark.parametrize("characters", [BOXES, ASCII], ids=["boxes", "ascii"])
@pytest.mark.parametrize("seed", mostly_slow(range(8), 0, 1, 2))
def test_words_never_touch(seed: int, characters: Characters, width: int) -> None:
    subject = busy(seed, nodes=12 + 4 * seed, tables=4 + seed)
    drawing, below = parts(draw_text(subject, width, characters))
    known = known_words(subject, below)
    signs = "".join(characters[1:]) + characters.lines
    letters = drawing.translate({ord(sign): " " for sign in signs if sign not in "_og"})
    for word in re.findall(r"\[[0-9,]+\]|[\w*]+", letters):
        if word in known or re.fullmatch(r"\[\d+(,\d+)*\]", word) or not word.strip("og_"):
            continue
        pytest.fail(f"{word!r} in\n{drawing}")


@pytest.mark.parametrize("seed", range(6))
def test_tables_have_their_whole_names_where_there_is_room(seed: int) -> None:
    text = generate_layout(seed, 16, 6, bar=True, waiters=1)
    layout = read_layout(text, "f")
    drawn = draw_text(make_subject(layout), 80)
    assert "short names" not in drawn
    for table in layout.tables:
        assert table.name in drawn
    assert drawn.count(" seats") + drawn.count("seats╝") >= len(layout.tables)


def test_names_that_are_cut_are_told() -> None:
    layout = read_layout_file("bistro")
    drawing, below = parts(draw_text(make_subject(layout), 50))
    assert "║t6 ║" in drawing
    assert short_names(below) == {"t1": "table1", "t2": "table2"}
    assert "and so on" in " ".join(below.split())
    assert "short names" not in draw_text(make_subject(layout), 80)


def test_cut_names_stay_different() -> None:
    layout = read_layout(
        "nodes: {a: [0, 0], b: [4, 0], t1: [20, 0]}\nedges: [[a, b], [b, t1]]\n"
        "entrance: a\nagent: a\n"
        "tables:\n  terrace_left: {capacity: 2, nodes: [a], at: [0, 1.2]}\n"
        "  terrace_right: {capacity: 2, nodes: [b], at: [4, 1.2]}\n"
        "  table1: {capacity: 2, nodes: [b], at: [8, 1.2]}\n",
        "f",
    )
    drawing, below = parts(draw_text(make_subject(layout), 50))
    told = short_names(below)
    assert sorted(told.values()) == ["table1", "terrace_left", "terrace_right"]
    assert len(told) == 3 and "t1" not in told, "t1 is a node"
    assert all(short in drawing for short in told)


@pytest.mark.parametrize("name", built_in("layout"))
@pytest.mark.parametrize("width", [60, 80, 120])
def test_every_table_shows_its_seats(name: str, width: int) -> None:
    layout = read_layout_file(name)
    drawing, _ = parts(draw_text(make_subject(layout), width))
    seats = re.findall(r"(?<=[║╚═ ])(\d+)(?: seats?)?(?=[║╝═ ])", drawing)
    assert sorted(seats) == sorted(str(table.capacity) for table in layout.tables)


def test_a_layout_that_was_placed_shows_its_seats(tmp_path: Path) -> None:
    program, placed = tmp_path / "r.sparc", tmp_path / "r.yaml"
    program.write_text(waiter("plan", "--scenario", "b1", "--show", "sparc").out)
    assert waiter("layout", "convert", str(program), "--place", "-o", str(placed)).code == 0
    drawn = waiter("layout", "draw", str(placed)).out
    assert "2 seats" in drawn and "4 seats" in drawn
    layout = read_layout_file(str(placed))
    assert drawn.count("#") - 1 == sum(table.capacity for table in layout.tables), "every chair"


def test_a_waiter_stands_beside_the_robot_with_a_name_of_its_own() -> None:
    layout = read_layout(
        "nodes: {n1: [0, 0], n2: [0.8, 0], n3: [1.6, 0], n4: [20, 0]}\n"
        "edges: [[n1, n2], [n2, n3], [n3, n4]]\nentrance: n4\nagent: n1\n"
        "waiters: {anna: n2, bert: n3}\n"
        "tables: {t1: {capacity: 2, nodes: [n4], at: [20, 1.2]}}\n",
        "f",
    )
    for characters in (BOXES, ASCII):
        drawing, below = parts(draw_text(make_subject(layout), 60, characters))
        row = next(line for line in drawing.splitlines() if "R" in line)
        words = re.findall(r"[A-Za-z0-9]+", row)
        told = short_names(below)
        assert words[words.index("R") :][:2] == ["R", "a"] and told["a"] == "anna"
        assert told.get(words[words.index("R") + 2], "bert") == "bert"


def test_ways_are_shown_with_arrows() -> None:
    subject = busy(2, walk=40)
    nodes = [subject.legs[0].start, *(leg.end for leg in subject.legs)]
    for characters, arrow in ((BOXES, "→"), (ASCII, "->")):
        below = parts(draw_text(subject, 60, characters))[1]
        rows = below.splitlines()
        assert f" {arrow} ".join(nodes) in " ".join(" ".join(rows).split())
        assert not any(row.rstrip().endswith(arrow) for row in rows), "kept with where it leads"
        assert characters is BOXES or below.isascii()


def test_a_large_restaurant_keeps_its_words_apart() -> None:
    layout = build_layout(3, 120, 50, bar=True, waiters=3)
    subject = make_subject(layout)
    drawing, below = parts(draw_text(subject, 80))
    known = known_words(subject, below)
    assert set(re.findall(r"\w+", drawing)) - set("▒") <= known
    assert sum(f"t{k}" in drawing for k in range(1, 51)) == 50


PAIR = """\
nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [6, 0], e: [2, 2]}
edges: [[a, b], [b, c], [c, d], [b, e]]
entrance: a
agents: {r1: b, r2: d}
tables: {}
"""


def test_each_of_several_robots_stands_there_by_its_name(tmp_path: Path) -> None:
    layout = tmp_path / "pair.yaml"
    layout.write_text(PAIR)
    drawn = waiter("layout", "draw", str(layout)).out
    assert "r1" in drawn and "r2" in drawn and "r1 robot" in drawn
    plan = tmp_path / "plan.json"
    plan.write_text(waiter("plan", "-l", str(layout), "--goal", "at: {r1: d, r2: b}", "--json").out)
    listing = waiter("layout", "draw", "--plan", str(plan)).out
    assert "r1: walk b" in listing and "r2: walk d" in listing
    svg = tmp_path / "pair.svg"
    assert waiter("layout", "draw", "--plan", str(plan), "-o", str(svg)).code == 0
    text = svg.read_text()
    assert all(f">{name}</text>" in text for name in ("r1", "r2"))
    assert all(colour in text for colour in ROBOTS[:2]) and ROBOTS[2] not in text
