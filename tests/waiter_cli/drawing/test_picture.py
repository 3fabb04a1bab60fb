"""Pictures of floor plans: every text can be read, walks show their way, the way in leads to the entrance."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import combinations
from math import atan2, dist, hypot, pi
from typing import Any

import pytest

from tests.support.walks import busy
from waiter_cli.drawing.canvas import PALETTE, text_width
from waiter_cli.drawing.frame import Frame
from waiter_cli.drawing.label_placement import Area
from waiter_cli.drawing.picture import draw_svg
from waiter_cli.drawing.subject import Leg, Subject, make_subject
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.room.label_boxes import overlap
from waiter_cli.room.shapes import Disc, walk_distance

SVG = "{http://www.w3.org/2000/svg}"


def by_chance(name: str, *, slow: bool, **busyness: int) -> Any:
    """A restaurant by chance, as a case that runs by default unless it is ``slow``."""
    return pytest.param(partial(busy, **busyness), id=name, marks=[pytest.mark.slow] * slow)


SUBJECTS = [
    *(by_chance(f"seed{seed}", slow=seed > 4, seed=seed) for seed in range(12)),
    *(by_chance(f"long{k}", slow=k > 1, seed=k, walk=60, guests=10) for k in range(4)),
    *(by_chance(f"large{k}", slow=k > 0, seed=k, nodes=40, tables=15) for k in range(3)),
    *(
        pytest.param(lambda name=name: busy(1, layout=read_layout_file(name), guests=3), id=name)
        for name in built_in("layout")
    ),
    *(
        pytest.param(lambda name=name: make_subject(read_layout_file(name)), id=f"{name}-empty")
        for name in built_in("layout")
    ),
]


@pytest.fixture(scope="module", params=SUBJECTS)
def subject(request: pytest.FixtureRequest) -> Subject:
    """A restaurant, made once for all that is looked at in its picture."""
    return request.param()


@pytest.fixture(scope="module")
def picture(subject: Subject) -> str:
    return draw_svg(subject)


def texts_of(svg: str) -> Iterator[tuple[str, Area]]:
    """Every text of a picture and the box of its letters, about."""
    for element in ElementTree.fromstring(svg).iter(f"{SVG}text"):
        text, size = element.text or "", float(element.attrib["font-size"])
        wide = text_width(text, size, "font-weight" in element.attrib)
        x, y = float(element.attrib["x"]), float(element.attrib["y"])
        x -= {"middle": wide / 2, "end": wide}.get(element.attrib.get("text-anchor", ""), 0.0)
        yield text, Area(x, y - 0.73 * size, x + wide, y)


def drawn(svg: str, shape: str, **attributes: str) -> list[dict[str, str]]:
    """The shapes that have some attributes."""
    return [
        each.attrib
        for each in ElementTree.fromstring(svg).iter(f"{SVG}{shape}")
        if attributes.items() <= each.attrib.items()
    ]


def points_of(shape: dict[str, str]) -> list[tuple[float, float]]:
    """The corners of a polygon, or the bends of a line."""
    pairs = (pair.split(",") for pair in shape["points"].split())
    return [(float(x), float(y)) for x, y in pairs]


def test_no_two_texts_overlap(picture: str) -> None:
    texts = list(texts_of(picture))
    for (one, area), (other, its) in combinations(texts, 2):
        assert overlap(area, its) < 1.0, f"{one} on {other}"


def test_every_step_has_its_number_and_stays_in_the_picture(subject: Subject, picture: str) -> None:
    root = ElementTree.fromstring(picture)
    wide, high = int(root.attrib["width"]), int(root.attrib["height"])
    numbers: list[int] = []
    for text, area in texts_of(picture):
        assert area.left >= 0 and area.right <= wide and area.top >= 0 and area.bottom <= high
        if re.fullmatch(r"\d+(, \d+)*", text):
            numbers += map(int, text.split(", "))
    for leg in subject.legs:
        assert leg.step in numbers


def test_names_of_nodes_keep_off_edges_furniture_and_people(subject: Subject) -> None:
    """Where a walk takes no room, there is always a free place."""
    subject = replace(subject, legs=(), deeds=(), listing=())
    frame = Frame(subject, 0)
    lying = []
    names = {node.name for node in subject.layout.nodes}
    things = [*subject.room.tables.values(), *([subject.room.bar] if subject.room.bar else [])]
    things += [chair.box for chairs in subject.room.chairs.values() for chair in chairs]
    for text, area in texts_of(draw_svg(subject)):
        name = text.removesuffix(" (entrance)")
        if name not in names or name in dict(subject.state.waiters):
            continue
        for box in things:
            corners = [frame.at(*corner) for corner in box.corners()]
            xs, ys = [x for x, _ in corners], [y for _, y in corners]
            if overlap(area, (min(xs), min(ys), max(xs), max(ys))) > 2:
                lying.append(f"{name} on {box.name}")
        for a, b in subject.layout.edges:
            (ax, ay), (bx, by) = frame.at(*subject.room.nodes[a]), frame.at(*subject.room.nodes[b])
            for k in range(201):
                x, y = ax + k / 200 * (bx - ax), ay + k / 200 * (by - ay)
                if area.left < x < area.right and area.top < y < area.bottom:
                    lying.append(f"{name} on {a}-{b}")
                    break
        guests = sum(map(len, subject.state.waiting))
        for x, y in (frame.at(*at) for at in subject.room.queue[:guests]):
            nearest = min(max(x, area.left), area.right), min(max(y, area.top), area.bottom)
            if dist((x, y), nearest) < 0.17 * frame.scale:
                lying.append(f"{name} on a guest")
    assert not lying


def test_the_way_in_ends_at_the_entrance(subject: Subject, picture: str) -> None:
    frame, svg = Frame(subject, 0), picture
    (head,) = drawn(svg, "polygon", fill=PALETTE.door)
    tip, left, right = points_of(head)
    middle = ((left[0] + right[0]) / 2, (left[1] + right[1]) / 2)
    (entrance,) = (each for each in drawn(svg, "circle", stroke=PALETTE.door) if each["r"] != "5.5")
    at = float(entrance["cx"]), float(entrance["cy"])
    assert dist(tip, at) < 0.3 * frame.scale + 6
    off = atan2(tip[1] - middle[1], tip[0] - middle[0]) - atan2(at[1] - tip[1], at[0] - tip[0])
    assert abs((off + pi) % (2 * pi) - pi) < 0.01, "it points at the entrance"


def test_the_way_in_leads_past_no_other_node() -> None:
    """In the report's restaurant n0 stands between the entrance and the nearest side of the room."""
    subject = make_subject(read_layout_file("report"))
    frame, svg = Frame(subject, 0), draw_svg(subject)
    door, way = (points_of(line) for line in drawn(svg, "polyline", stroke=PALETTE.door))
    entrance = frame.at(*subject.room.nodes["n5"])
    dx, dy = way[0][0] - entrance[0], way[0][1] - entrance[1]
    assert hypot(dx, dy) < frame.scale
    for name, at in subject.room.nodes.items():
        there = frame.at(*at)
        assert name == "n5" or dist(there, way[0]) > 0.3 * frame.scale
    assert dist(*door) < frame.scale


def test_a_way_that_is_walked_again_is_one_line_with_one_pill() -> None:
    layout = read_layout(
        "nodes: {door: [0, 0], aisle: [2, 0]}\nedges: [[door, aisle]]\nentrance: door\nagent: door\n"
        "tables: {t1: {capacity: 2, nodes: [aisle], at: [2, -2]}}\n",
        "f",
    )
    ways = [("door", "aisle"), ("aisle", "door")] * 4
    legs = tuple(Leg(step, *way) for step, way in enumerate(ways))
    svg = draw_svg(replace(make_subject(layout), legs=legs))
    words = [text for text, _ in texts_of(svg)]
    assert {"0, 2", "4, 6", "1, 3", "5, 7"} <= set(words)
    heads = [points_of(head) for head in drawn(svg, "polygon", fill=PALETTE.walk)]
    turns = [tip[0] > left[0] for tip, left, _ in heads]
    assert sorted(turns) == [False, True], "one arrow head there, one back"


@pytest.mark.parametrize("seed", range(4))
def test_every_way_has_an_arrow_head_that_points_where_it_leads(seed: int) -> None:
    subject = busy(seed, walk=30)
    frame, svg = Frame(subject, 0), draw_svg(subject)
    ways = dict.fromkeys((leg.start, leg.end) for leg in subject.legs)
    heads = [points_of(head) for head in drawn(svg, "polygon", fill=PALETTE.walk)]
    assert len(heads) == len(ways)
    for (start, end), (tip, left, right) in zip(ways, heads):
        (ax, ay), (bx, by) = (frame.at(*subject.room.nodes[name]) for name in (start, end))
        dx, dy = tip[0] - (left[0] + right[0]) / 2, tip[1] - (left[1] + right[1]) / 2
        along = (dx * (bx - ax) + dy * (by - ay)) / (hypot(dx, dy) * dist((ax, ay), (bx, by)))
        assert along > 0.95
        room = frame.origin[0] + (tip[0] - frame.left) / frame.scale
        deep = frame.origin[1] - (tip[1] - frame.top) / frame.scale
        here = Disc("", room, deep, 0.0)
        assert walk_distance(subject.room.nodes[start], subject.room.nodes[end], here) < 0.25


def test_guests_who_wait_far_off_are_in_the_picture() -> None:
    subject = busy(3, guests=20)
    frame = Frame(subject, 0)
    for x, y in (frame.at(*at) for at in subject.room.queue[:20]):
        assert overlap((x - 5, y - 5, x + 5, y + 5), frame.area) == pytest.approx(100)


def test_the_door_is_on_the_rim_of_what_is_drawn() -> None:
    subject = busy(2, guests=20)
    area = Frame(subject, 0).area
    door, way = (
        points_of(line) for line in drawn(draw_svg(subject), "polyline", stroke=PALETTE.door)
    )
    assert area.right > Frame(subject, 0).at(*subject.room.door)[0] + 5, "guests wait farther out"
    assert {round(x) for x, _ in door} == {round(area.right)} == {round(way[0][0])}


def test_lines_of_the_plan_begin_with_the_arrow_to_the_next_node() -> None:
    subject = busy(2, walk=40)
    words = [text for text, _ in texts_of(draw_svg(subject)) if "→" in text]
    assert len(words) > 2
    assert words[0].startswith("walk ") and all(text.startswith("→ ") for text in words[1:])
    nodes = [subject.legs[0].start, *(leg.end for leg in subject.legs)]
    assert " ".join(words) == f"walk {' → '.join(nodes)}"


def test_arrows_in_png_text_are_lines() -> None:
    """The font that Pillow brings has no arrow: it would draw a box, two uprights far apart."""
    image = pytest.importorskip("PIL.Image")
    from io import BytesIO

    from waiter_cli.drawing.png import PngCanvas

    columns = []
    for text in ("n1 → n2", "→"):
        canvas = PngCanvas(120, 24, "#ffffff", "t")
        canvas.text((60, 12), text, 16, "#000000")
        with image.open(BytesIO(canvas.document())) as picture:
            dark = picture.convert("L").point(lambda shade: 255 if shade < 128 else 0)
            columns.append(dark.getbbox())
            if text == "→":
                left, top, right, bottom = dark.getbbox()
                shaft = [dark.getpixel((x, (top + bottom) // 2)) for x in range(left, right)]
                assert all(shaft) and right - left > 2 * (bottom - top) * 0.8
    (left, _, right, _), (start, _, end, _) = columns
    assert left < start and end < right and abs((left + right) - (start + end)) < 12


def test_lines_to_numbers_pass_under_all_of_them() -> None:
    svg = draw_svg(busy(1, nodes=40, tables=15, walk=120))
    lines = svg.splitlines()
    leaders = [k for k, line in enumerate(lines) if 'stroke-width="1.4"' in line and "poly" in line]
    pills = [k for k, line in enumerate(lines) if "<rect" in line and PALETTE.walk in line]
    assert len(leaders) > 5 and max(leaders) < min(pills)
