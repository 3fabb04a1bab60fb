"""The robot acts: what the world forbids fails, and a broken plan is mended or ends the run."""

from __future__ import annotations

from tests.support.playing import WALK, layout_of, play, scene
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.outcome import Rules


def test_a_plan_that_skips_an_edge() -> None:
    run = play(scene("b1"), ("go_to(agent,n2)", "go_to(agent,n4)"), rules=Rules(on_failure="stop"))
    assert [f.check for f in run.outcome.failures] == ["edge"]
    assert run.outcome.status == "failed"
    assert "precondition_failed" in run.types()


def test_a_plan_that_seats_five_on_four_chairs() -> None:
    layout = layout_of("report")
    five = ("c1", "c2", "c3", "c4", "c5")
    problem = pose_problem(layout, None, enter=[5])
    steps = (*WALK, "pick(agent,c1)", "go_to(agent,n6)", "seat(agent,c1,table2)")
    run = play(problem, steps, rules=Rules(on_failure="stop"))
    assert len(problem.state.waiting[0]) == len(five)
    assert [f.check for f in run.outcome.failures] == ["chairs"]


def test_a_plan_that_gives_the_bill_to_the_wrong_table() -> None:
    run = play(scene("b3"), ("give_bill(agent,table2)",), rules=Rules(on_failure="stop"))
    assert [f.check for f in run.outcome.failures] == ["preconditions"]


def test_a_broken_plan_is_mended_unless_told_otherwise() -> None:
    run = play(scene("b1"), ("go_to(agent,n4)",))
    assert run.outcome.status == "failed"
    assert run.of("seated")
    assert run.outcome.replans == 1


def test_stop_on_failure_stops() -> None:
    run = play(scene("b1"), inject=["slip:1"], rules=Rules(on_failure="stop"))
    assert run.outcome.status == "failed"
    assert run.outcome.failed_actions == 1
    assert not run.outcome.failures
