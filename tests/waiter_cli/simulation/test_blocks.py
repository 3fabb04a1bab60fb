"""Strangers who block edges: driven round, waited for, given up."""

from __future__ import annotations

from dataclasses import replace

from tests.support.playing import layout_of, play, scene
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.state import Goal
from waiter_cli.problems.pose import pose_problem


def test_a_block_is_driven_round_where_there_is_another_way() -> None:
    layout = layout_of("bistro")
    ring = next(
        (a, b) for a, b in layout.edges
        if "south1" in (a, b) and "south2" in (a, b)
    )  # fmt: skip
    text = "state: {agent: south1, waiters: {w1: window}}\ngoals: [at: south2]"
    problem = pose_problem(layout, read_scenario(text, "walk", layout))
    run = play(problem, inject=[f"block:{ring[0]}-{ring[1]}@0"])
    assert run.outcome.status == "done"
    assert run.of("blocked")[0]["answer"] == "reroute"
    assert [e["node"] for e in run.of("arrived")][-1] == "south2"


def test_a_block_that_goes_away_is_waited_for() -> None:
    run = play(scene("b1"), inject=["block:n5-n6@0+20"])
    assert run.outcome.status == "done"
    assert run.of("blocked")[0]["answer"] == "wait"
    assert run.of("unblocked")


def test_a_block_that_stays_ends_in_giving_up() -> None:
    run = play(scene("b1"), inject=["block:n5-n6@0"])
    assert run.outcome.status == "gave_up"
    assert "n5-n6" in (run.outcome.why or "")


def test_a_block_that_another_table_helps_past_is_replanned() -> None:
    problem = scene("b2")
    free = replace(problem.state, waiters=(("w1", "n0"),), agent="n4", seated=())
    problem = replace(
        problem,
        state=free,
        before_observations=free,
        goals=(Goal("seated", party=free.waiting[0]),),
    )
    steps = ("go_to(agent,n5)", "pick(agent,c2)", "go_to(agent,n6)", "seat(agent,c2,table2)")
    run = play(problem, steps, inject=["block:n5-n6@0"])
    assert run.of("blocked")[0]["answer"] == "replan"
    assert run.outcome.status == "done"
    assert [e["node"] for e in run.of("arrived")][-1] == "n7"
