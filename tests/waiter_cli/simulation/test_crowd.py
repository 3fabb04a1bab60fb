"""People in the room: colleagues on the move and whoever walks round tables."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from tests.support.playing import corridor, layout_of, play, scene
from waiter_cli.model.layout import Layout
from waiter_cli.model.timetable import clashes
from waiter_cli.problems.pose import pose_problem
from waiter_cli.room.room import build_room
from waiter_cli.room.shapes import Box, distance
from waiter_cli.simulation.crowd import Crowd, footpath

WALK_ALONG = tuple(f"go_to(agent,n{k})" for k in range(1, 5))


def test_colleagues_keep_their_timetable() -> None:
    problem = scene("b1")
    layout = replace(problem.layout, timetable=(("w1", 2, "n4"), ("w1", 3, "n7")))
    run = play(replace(problem, layout=layout))
    assert run.outcome.status == "done", run.outcome


@pytest.mark.parametrize("spacing", [0.7, 0.8, 1.0, 2.0])
def test_a_colleague_follows_the_robot_from_node_to_node(spacing: float) -> None:
    due = {step: f"n{step - 1}" for step in (1, 2, 3, 4)}
    run = play(corridor(spacing, due))
    assert run.outcome.status == "done", run.outcome
    assert run.outcome.actions == 4
    assert dict(run.outcome.final_state.waiters) == {"anna": "n3"}
    assert run.outcome.min_clearance is None or run.outcome.min_clearance >= 0.05


def moving(layout: Layout, chance: Random) -> Layout:
    """The layout with colleagues who go about, never two on one node, and home again at step 15."""
    nodes = [node.name for node in layout.nodes]
    posts = dict(layout.waiters)
    while True:
        due = {(who, chance.randint(1, 14)): chance.choice(nodes) for who in [*posts] * 4}
        due |= {(who, 15): home for who, home in posts.items()}
        timetable = tuple((who, step, node) for (who, step), node in sorted(due.items()))
        if not clashes(posts, timetable):
            return replace(layout, timetable=timetable)


@pytest.mark.parametrize(
    "seed", [pytest.param(k, marks=[pytest.mark.slow] * (k % 2)) for k in range(8)]
)
def test_colleagues_on_the_move_are_never_run_into(seed: int) -> None:
    chance = Random(seed)
    layout = moving(layout_of(f"generated{chance.choice((1, 2, 4, 5))}"), chance)
    problem = pose_problem(layout, None, enter=[2, 1])
    run = play(problem)
    assert not run.outcome.failures
    assert run.outcome.status == "done", run.outcome.why
    slipping = play(problem, inject=[f"slip:{chance.choice((0.2, 0.4))}"])
    assert not slipping.outcome.failures
    assert slipping.outcome.status == "done", slipping.outcome.why


def test_a_colleague_who_is_held_up_comes_once_the_robot_is_gone() -> None:
    """The robot slips on the node that anna is due on; whoever follows her is held up, too."""
    problem = corridor(1.0, {1: "n0"})
    layout = replace(
        problem.layout,
        waiters=(("anna", "side"), ("bob", "n4")),
        timetable=(*problem.layout.timetable, ("bob", 1, "side")),
    )
    start = replace(problem.state, waiters=layout.waiters)
    problem = replace(problem, layout=layout, state=start, before_observations=start)
    for planned in (None, WALK_ALONG):
        run = play(problem, planned, inject=["slip:0.6"])
        assert run.events[-1]["status"] == "done" and not run.outcome.failures
        assert run.of("action_failed")[0]["step"] == 0
        assert dict(run.outcome.final_state.waiters) == {"anna": "n0", "bob": "side"}


TABLE = Box("table", 0.0, 0.0, 0.5, 1.0)


def test_a_way_on_foot_is_straight_where_nothing_stands() -> None:
    assert footpath((-2, 3), (2, 3), [TABLE]) == [(-2, 3), (2, 3)]


def test_a_way_on_foot_leads_round_a_table_by_the_shorter_side() -> None:
    path = footpath((-2, 0.8), (2, 0.8), [TABLE])
    assert len(path) == 4 and all(y > 1.0 for _, y in path[1:-1]), "the northern side is nearer"
    for (ax, ay), (bx, by) in zip(path, path[1:]):
        parts = [k / 50 for k in range(51)]
        steps = [(ax + part * (bx - ax), ay + part * (by - ay)) for part in parts]
        assert all(distance(x, y, TABLE) >= 0 for x, y in steps)


def test_who_stands_inside_a_block_walks_straight_out() -> None:
    assert footpath((0, 0), (2, 0), [TABLE]) == [(0, 0), (2, 0)]


def test_whoever_leaves_is_gone_and_his_place_is_free() -> None:
    crowd = Crowd(build_room(layout_of("report")))
    crowd.wait(("c1",), come_in=False)
    first = crowd.people["c1"]
    crowd.remove("c1")
    crowd.wait(("c2",), come_in=False)
    assert set(crowd.people) == {"c2"}
    assert (crowd.people["c2"].x, crowd.people["c2"].y) == (first.x, first.y)
