"""What of all that is wanted there is room for, and how often a planner is asked for it."""

from __future__ import annotations

from dataclasses import replace

from tests.support.serving import thinker
from waiter_cli.execution.agenda import PlannerAnswer, Selection, Wanted, choose
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal
from waiter_cli.problems.pose import pose_problem

WISHES = tuple(Goal("paid", table=f"table{k}") for k in range(4))
SOME = PlannerAnswer("plan", Plan((), 0), True)


def chosen(planner, asked: list[int], wanted: Wanted) -> Selection:  # type: ignore[no-untyped-def]
    """The selection by a planner that is told how many wishes it is asked for; ``asked`` keeps that."""
    posed = pose_problem(read_layout_file("report"), None, enter=[1])

    def answer(problem: Problem) -> PlannerAnswer:
        asked.append(len(problem.goals))
        return planner(len(problem.goals))  # type: ignore[no-any-return]

    def pose(some: Wanted) -> Problem:
        return replace(posed, goals=(*some.must, *some.wishes))

    return choose(wanted, pose, answer, lambda problem: ())


def test_nothing_is_searched_for_twice_in_one_decision() -> None:
    asked: list[int] = []
    found = chosen(
        lambda wishes: SOME if wishes <= 2 else PlannerAnswer("no_plan"),
        asked,
        Wanted(wishes=WISHES),
    )
    assert found.problem.goals == WISHES[:2]
    assert [each.goal for each in found.pending] == list(WISHES[2:])
    assert asked == [4, 1, 2, 3, 3]  # the two of three wishes are not the same


def test_what_is_impossible_alone_is_asked_for_once() -> None:
    asked: list[int] = []
    found = chosen(lambda wishes: PlannerAnswer("no_plan"), asked, Wanted(wishes=WISHES[:1]))
    assert found.answer.status == "no_plan"
    assert asked == [1, 0]  # nothing at all comes out after that


def test_what_no_plan_was_found_for_in_time_waits_for_the_rest() -> None:
    """The older wishes have a plan: that one is followed, and nobody stands still for the others."""
    answers = {3: PlannerAnswer("no_plan"), 1: SOME, 2: PlannerAnswer("undecided", limit="time")}
    found = chosen(answers.__getitem__, [], Wanted(wishes=WISHES[:3]))
    assert found.answer.status == "plan" and found.problem.goals == WISHES[:1]
    (reason,) = found.pending[0].reasons
    assert reason.message == "no plan that does this, too, was found in time"


def test_searches_of_one_decision_share_their_time() -> None:
    problem = pose_problem(read_layout_file("report"), None, enter=[1])
    planner = replace(thinker(30.0), seconds_in_all=0.0)
    with planner.decision():
        late = planner.plan(problem)
    assert (late.status, late.limit, planner.searches) == ("undecided", "time", 0)
    assert planner.plan(problem).status == "plan"  # by itself it has the time of a search
    planner.seconds_in_all = 30.0
    with planner.decision():
        assert planner.plan(problem).minimal
