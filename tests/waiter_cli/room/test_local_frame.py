"""A restaurant far from the origin: the same events, clearances and pictures as beside it."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from tests.support.pictures import VIEWS, moment, scene
from tests.support.playing import SHIPPED, PlayedRun, layout_of, play
from waiter_cli.model.layout import Layout, Point
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.problems.from_options import read_problem
from waiter_cli.room.local_frame import near_origin, to_local
from waiter_cli.room.room import build_room, sweep

UTM: Point = (500_000.0, 5_400_000.0)
ODD: Point = (-123_456.78, 9_123_456.789)


def away(layout: Layout, far: Point) -> Layout:
    """A copy of the layout that stands elsewhere."""
    return to_local(layout, (-far[0], -far[1]))


@cache
def lived(scenario: str, far: Point, backend: str = "geometric") -> PlayedRun:
    """A scenario lived through where its restaurant stands elsewhere."""
    given: tuple[Problem, tuple[TimedEvent, ...]] = read_problem(None, scenario)
    problem, timed = given[0], given[1]
    problem = replace(problem, layout=away(problem.layout, far))
    return play(problem, timed=timed, backend=backend)


def at_home(run: PlayedRun, far: Point) -> list[dict[str, Any]]:
    """Its events, the robot's place told as if the restaurant were at the origin."""
    events = run.events
    for event in events:
        for axis, there in zip("xy", far):
            event["robot"][axis] = round(event["robot"][axis] - there, 3) + 0.0
    return events


@pytest.mark.parametrize("far", [UTM, ODD])
@pytest.mark.parametrize("scenario", ["b1", "lunch"])
def test_the_same_happens_far_off(scenario: str, far: Point) -> None:
    here, there = lived(scenario, (0.0, 0.0)), lived(scenario, far)
    assert at_home(there, far) == here.events
    assert there.outcome.min_clearance == pytest.approx(here.outcome.min_clearance, abs=1e-3)


@pytest.mark.sim
def test_bullet_measures_the_same_far_off() -> None:
    pytest.importorskip("pybullet")
    here, there = lived("b2", (0.0, 0.0)), lived("b2", ODD, "pybullet")
    assert at_home(there, ODD)[1:] == here.events[1:], "the first tells the backend"
    assert there.outcome.min_clearance == pytest.approx(here.outcome.min_clearance, abs=1e-3)


def test_events_tell_the_coordinates_of_the_file() -> None:
    x, y = away(layout_of("report"), UTM).node("n1").at or UTM
    robot = json.loads(lived("b1", UTM).lines[0])["robot"]
    assert (robot["x"], robot["y"]) == (x, y)


@pytest.mark.parametrize("far", [UTM, ODD])
@pytest.mark.parametrize("name", SHIPPED)
def test_nothing_is_run_into_far_off(name: str, far: Point) -> None:
    layout = layout_of(name)
    seats = {table.name: table.capacity for table in layout.tables}
    assert not sweep(build_room(away(layout, far)), seats)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_drawing_of_a_place_far_off_is_the_same(name: str) -> None:
    from waiter_cli.drawing.picture import draw_svg
    from waiter_cli.drawing.subject import make_subject
    from waiter_cli.drawing.text import draw_text
    from waiter_cli.pictures.html_page import room_document

    layout = layout_of(name)
    here, there = make_subject(layout), make_subject(away(layout, UTM))
    assert draw_svg(there) == draw_svg(here)
    assert draw_text(there) == draw_text(here)
    assert room_document(there.room) == room_document(here.room)


@pytest.mark.parametrize("view", VIEWS)
def test_a_picture_of_a_place_far_off_is_the_same(view: str) -> None:
    layout = layout_of("report")
    pictures = []
    for shown in (layout, away(layout, UTM)):
        room = build_room(shown)
        drawn = scene(view, room)
        pictures.append(drawn.draw(moment(room, "n4", "n6")).tobytes())
        drawn.close()
    assert pictures[0] == pictures[1]


def test_a_room_about_the_origin_stays_where_it_is() -> None:
    layout = layout_of("bistro")
    assert near_origin(layout) == (0.0, 0.0)
    assert to_local(layout, (0.0, 0.0)) is layout
    bare = replace(layout, nodes=tuple(replace(node, at=None) for node in layout.nodes))
    assert near_origin(bare) == (0.0, 0.0)
