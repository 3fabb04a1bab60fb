"""The restaurants and scenes that are shipped: lengths, reasons, and room for the robot to pass."""

from __future__ import annotations

from math import hypot

import pytest

from tests.support.exhaustive import shortest
from waiter_cli.file_access.locate import built_in
from waiter_cli.files.documents import state_document
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.model.geometry import distance_to_segment
from waiter_cli.model.graph import layout_warnings
from waiter_cli.model.layout import Layout, Table
from waiter_cli.model.plan import Action
from waiter_cli.problems.from_options import read_problem
from waiter_cli.rules.actions import apply

ROBOT = 0.25
SPARE = 0.05
CHAIR = 0.42
CHAIRS_AT = 0.75


@pytest.mark.parametrize(
    ("scenario", "length"),
    [
        ("b1", 7),
        ("b2", 4),
        ("b3", 1),
        ("b4", 1),
        ("too_big", None),
        ("blocked_aisle", None),
        ("unwanted_bill", None),
    ],
)
def test_scenes_have_their_least_length(scenario: str, length: int | None) -> None:
    problem, warnings = read_problem(None, scenario)
    assert (problem.contradictions, warnings) == ((), ())
    assert shortest(problem).length == length


def test_each_scene_begins_where_the_one_before_ended() -> None:
    for first, then in (("b1", "b2"), ("b2", "b3"), ("b3", "b4")):
        problem, _ = read_problem(None, first)
        state = problem.state
        for step, text in enumerate(shortest(problem).plan):
            name, arguments = text.rstrip(")").split("(")
            state = apply(problem, state, Action(step, name, tuple(arguments.split(","))), step)
        following, _ = read_problem(None, then)
        assert state_document(state, problem.layout) == state_document(
            following.before_observations, following.layout
        )


def test_nobody_is_seated_behind_the_wall() -> None:
    problem, warnings = read_problem("walled_off", None, enter=[1])
    assert shortest(problem).length is None
    assert {"table table1", "table table2"} <= {fault.message[:12] for fault in warnings}


def test_lunch_has_everything_in_it() -> None:
    problem, warnings = read_problem(None, "lunch")
    assert warnings == () and problem.contradictions == () and problem.everybody
    assert len(problem.state.parties()) == 6
    assert {goal.kind for goal in problem.goals} == {"seated", "paid", "sent", "served", "filled"}
    seats = {table.name: table.chairs for table in problem.layout.tables}
    assert max(map(len, problem.state.parties())) > max(seats.values())


def test_the_large_restaurant_has_the_size_of_the_report() -> None:
    layout = read_layout_file("report_large")
    assert (len(layout.nodes), len(layout.edges), len(layout.tables)) == (21, 20, 6)


@pytest.mark.parametrize("name", built_in("layout"))
def test_no_path_comes_near_the_furniture(name: str) -> None:
    layout = read_layout_file(name)
    boxes = [box for table in layout.tables for box in furniture(table)]
    if layout.bar is not None and layout.bar.corners is not None:
        (ax, ay), (bx, by) = layout.bar.corners
        boxes.append((min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)))
    boxes += [(min(a, c), min(b, d), max(a, c), max(b, d)) for (a, b), (c, d) in layout.walls]
    for path in paths(layout):
        for box in boxes:
            assert clearance(path, box) >= ROBOT + SPARE - 1e-9, (path, box)


@pytest.mark.parametrize("name", built_in("layout"))
def test_no_two_tables_overlap(name: str) -> None:
    tables = read_layout_file(name).tables
    for index, table in enumerate(tables):
        for other in tables[index + 1 :]:
            for a in furniture(table):
                for b in furniture(other):
                    apart = a[2] < b[0] or b[2] < a[0] or a[3] < b[1] or b[3] < a[1]
                    assert apart, (table.name, other.name)


def test_only_the_walled_off_layout_has_warnings() -> None:
    assert [n for n in built_in("layout") if layout_warnings(read_layout_file(n))] == ["walled_off"]


Box = tuple[float, float, float, float]
Path = tuple[tuple[float, float], tuple[float, float]]


def paths(layout: Layout) -> list[Path]:
    """The edges as segments."""
    places = {node.name: node.at for node in layout.nodes}
    found = []
    for a, b in layout.edges:
        start, end = places[a], places[b]
        assert start is not None and end is not None
        found.append((start, end))
    return found


def furniture(table: Table) -> list[Box]:
    """The table and its chairs, half of them on either side, spaced along its length."""
    assert table.at is not None
    (x, y), (width, length) = table.at, table.size
    boxes = [(x - width / 2, y - length / 2, x + width / 2, y + length / 2)]
    rows = (table.capacity + 1) // 2
    for row in range(rows):
        along = y + length * ((row + 0.5) / rows - 0.5)
        for side in (-CHAIRS_AT, CHAIRS_AT):
            half = CHAIR / 2
            boxes.append((x + side - half, along - half, x + side + half, along + half))
    return boxes


def clearance(path: Path, box: Box) -> float:
    """Metres between a segment and a box; 0 where they meet."""
    left, low, right, high = box
    corners = [(left, low), (left, high), (right, high), (right, low)]
    if any(left <= x <= right and low <= y <= high for x, y in path):
        return 0.0
    found = [distance_to_segment(corner, path) for corner in corners]
    sides = list(zip(corners, corners[1:] + corners[:1]))
    found += [distance_to_segment(end, side) for end in path for side in sides]
    if any(crosses(path, side) for side in sides):
        return 0.0
    return min(found)


def crosses(one: Path, two: Path) -> bool:
    """Whether two segments cross properly."""

    def turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = one, two
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def test_clearance_knows_crossing_paths() -> None:
    box = (0.0, 0.0, 1.0, 1.0)
    assert clearance(((-1, 0.5), (2, 0.5)), box) == 0
    assert clearance(((0.5, 0.5), (2, 0.5)), box) == 0
    assert clearance(((-1, 2), (2, 2)), box) == 1
    assert clearance(((2, 2), (3, 3)), box) == pytest.approx(hypot(1, 1))
