"""The executive alone, with a planner that tries everything: events in, decisions out."""

from __future__ import annotations

import copy
import json
from typing import Any

import pytest

from tests.support.exhaustive import shortest
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.serve.memory import restore, snapshot

CAFE = """
name: cafe
nodes: [door, a, b, c]
edges: [[door, a], [a, b], [b, c]]
entrance: door
agent: c
tables:
  t1: {capacity: 2, nodes: [a]}
  t2: {capacity: 4, nodes: [b]}
"""


def oracle(problem: Problem) -> PlannerAnswer:
    """The shortest plan, by breadth-first search over all states."""
    found = shortest(problem)
    if found.length is None:
        return PlannerAnswer("no_plan", reasons=(Reason("nothing leads there"),))
    actions = []
    for step, text in enumerate(found.plan):
        if text:
            name, arguments = text[:-1].split("(")
            actions.append(Action(step, name, tuple(arguments.split(","))))
    return PlannerAnswer("plan", Plan(tuple(actions), found.length), True)


class Counting:
    """The oracle, and how often it was asked."""

    def __init__(self) -> None:
        self.asked = 0

    def __call__(self, problem: Problem) -> PlannerAnswer:
        self.asked += 1
        return oracle(problem)


def executive(text: str = CAFE, **more: Any) -> Executive:
    layout = read_layout(text, "cafe.yaml")
    more.setdefault("state", state_of_layout(layout)[0])
    planner = more.pop("planner", oracle)
    return Executive(layout, planner, **more)


def enter(*names: str) -> list[Observation]:
    return [Observation("enter", names)]


def bill(table: str) -> list[Observation]:
    return [Observation("bill", (table,))]


def leave(name: str) -> list[Observation]:
    return [Observation("leave", (name,))]


def at(who: str, node: str) -> list[Observation]:
    return [Observation("at", (who, node))]


def texts(decision: Decision) -> list[str]:
    return [f"{action.step}:{action.text}" for action in decision.plan]


def do(run: Executive, decision: Decision) -> Decision:
    while decision.horizon:
        decision = run.done(run.step)
    return decision


# -- planning and doing -----------------------------------------------------------------------


def test_nothing_to_do_at_first() -> None:
    decision = executive().decision
    assert (decision.revision, decision.plan, decision.horizon) == (0, (), 0)
    assert decision.minimal and decision.status == "plan"


def test_a_party_is_seated_and_steps_are_dropped_as_they_are_done() -> None:
    planner = Counting()
    run = executive(planner=planner)
    decision = run.observe(enter("c1"))
    assert (decision.revision, decision.horizon, decision.minimal) == (1, 6, True)
    asked = planner.asked
    for step in range(6):
        before = texts(decision)
        decision = run.done(step)
        assert texts(decision) == before[1:]
        assert (decision.revision, decision.horizon) == (1, 5 - step)
    assert planner.asked == asked, "a plan that goes as planned is not planned again"
    assert run.state.seated == (("t1", ("c1",)),)


def test_steps_count_on_through_the_whole_run() -> None:
    run = executive()
    do(run, run.observe(enter("c1")))
    decision = run.observe(enter("c2", "c3", "c4"))
    assert decision.plan[0].step == 6 == run.step
    assert [action.step for action in decision.plan] == list(range(6, 6 + decision.horizon))


def test_a_plan_that_is_still_minimal_is_kept() -> None:
    run = executive()
    first = run.observe(enter("c1"))
    second = run.observe([*leave("c1"), *enter("c1")])
    assert second.plan == first.plan
    assert second.revision == first.revision


def test_the_revision_grows_when_the_plan_changes() -> None:
    run = executive()
    first = run.observe(enter("c1"))
    second = run.observe(enter("c2"))
    assert second.revision == first.revision + 1
    assert second.horizon > first.horizon


def test_a_failed_step_uses_its_number_up_without_effect() -> None:
    run = executive()
    first = run.observe(enter("c1"))
    run.done(0)
    place = run.state.agent
    decision = run.failed(1, "door shut")
    assert run.state.agent == place
    assert decision.revision == first.revision + 1
    assert [a.text for a in decision.plan] == [a.text for a in first.plan[1:]]
    assert [a.step for a in decision.plan] == [2, 3, 4, 5, 6]


@pytest.mark.parametrize("what", ["done", "failed", "started"])
@pytest.mark.parametrize("step", [1, 7])
def test_reports_out_of_order_are_refused_and_change_nothing(what: str, step: int) -> None:
    run = executive()
    run.observe(enter("c1"))
    before = (run.state, run.step, run.decision, run.running)
    with pytest.raises(Refused, match="out of order"):
        getattr(run, what)(step)
    assert (run.state, run.step, run.decision, run.running) == before


@pytest.mark.parametrize("what", ["done", "failed", "started"])
def test_what_is_not_planned_is_not_reported(what: str) -> None:
    with pytest.raises(Refused, match="no action at step 0"):
        getattr(executive(), what)(0)


# -- a running action -------------------------------------------------------------------------


def test_a_running_action_comes_first_in_the_new_plan() -> None:
    run = executive()
    run.observe(enter("c1"))
    started = run.started(0)
    assert started.revision == 1 and texts(started)[0] == "0:go_to(agent,b)"
    decision = run.observe([*leave("c1")])
    assert texts(decision) == ["0:go_to(agent,b)"], "it is finished, then there is nothing to do"
    assert decision.horizon == 1
    assert run.done(0).plan == ()
    assert run.state.agent == "b"


def test_a_running_action_that_became_impossible_is_abandoned() -> None:
    text = CAFE.replace("agent: c", "agent: c\nwaiters: {w1: door}")
    run = executive(text, goals=(Goal("at", node="a"),))
    run.started(0)
    decision = run.observe(at("w1", "b"))
    assert decision.abandoned is not None and decision.abandoned.text == "go_to(agent,b)"
    assert decision.status == "no_plan" and decision.plan == ()
    with pytest.raises(Refused, match="cannot be done"):
        run.done(0)
    decision = run.failed(0)
    assert run.step == 1 and decision.abandoned is None
    again = run.observe(at("w1", "door"))
    assert texts(again) == ["1:go_to(agent,b)", "2:go_to(agent,a)"]


def test_an_arrival_that_was_seen_first_can_still_be_reported() -> None:
    run = executive(goals=(Goal("at", node="a"),))
    run.started(0)
    decision = run.observe(at("agent", "b"))
    assert texts(decision) == ["0:go_to(agent,b)", "1:go_to(agent,a)"]
    assert texts(run.done(0)) == ["1:go_to(agent,a)"]


def test_two_actions_do_not_run_at_once() -> None:
    run = executive(goals=(Goal("at", node="a"),))
    run.started(0)
    with pytest.raises(Refused, match="running already"):
        run.started(0)


# -- wishes that must wait --------------------------------------------------------------------


def test_a_party_too_many_waits_and_is_seated_when_a_table_becomes_free() -> None:
    run = executive()
    for names in (("c1",), ("c2",), ("c3",)):
        decision = run.observe(enter(*names))
    assert [p.goal.party for p in decision.pending] == [("c3",)]
    assert decision.pending[0].reasons and decision.status == "plan" and decision.plan
    do(run, decision)
    assert {party for _, party in run.state.seated} == {("c1",), ("c2",)}
    decision = run.observe(leave("c1"))
    assert decision.pending == () and decision.plan
    do(run, decision)
    assert run.state.table_of("c3") == "t1"


def test_older_wishes_come_first_and_innocent_ones_stay() -> None:
    run = executive()
    run.observe(enter("b1", "b2", "b3", "b4", "b5"))
    decision = run.observe(enter("c1"))
    assert [p.goal.party[0] for p in decision.pending] == ["b1"], "five fit at no table"
    assert any(action.name == "seat" for action in decision.plan)


def test_where_everything_must_wait_there_is_no_plan_and_the_reasons_are_told() -> None:
    decision = executive().observe(enter("b1", "b2", "b3", "b4", "b5"))
    assert decision.status == "no_plan" and decision.plan == () and not decision.minimal
    assert decision.reasons


def test_a_goal_of_ones_own_does_not_wait() -> None:
    run = executive(goals=(Goal("paid", table="t1"),))
    assert run.decision.status == "no_plan" and run.decision.pending == ()


# -- goals ------------------------------------------------------------------------------------


def test_serve_stays_open_until_the_party_has_left() -> None:
    run = executive()
    decision = run.add_goal(Goal("serve", party=("c1",)))
    assert "not inside yet" in decision.pending[0].reasons[0].message
    decision = run.observe(enter("c1"))
    do(run, decision)
    assert run.goals and run.state.table_of("c1") is not None
    decision = run.observe(bill(run.state.table_of("c1") or ""))
    assert [action.name for action in decision.plan][-1] == "give_bill"
    do(run, decision)
    assert run.goals, "paid, but still there"
    decision = run.observe(leave("c1"))
    assert run.goals == () and [goal.kind for goal in decision.closed] == ["serve"]


def test_with_goals_only_those_are_pursued_and_without_them_everybody_is() -> None:
    run = executive()
    run.observe(enter("c1"))
    decision = run.add_goal(Goal("at", node="b"))
    assert texts(decision) == ["0:go_to(agent,b)"]
    decision = run.drop_goal(Goal("at", node="b"))
    assert decision.horizon == 6 and run.goals == ()


def test_goals_name_parties_by_any_member() -> None:
    run = executive()
    run.observe(enter("c1", "c2"))
    run.add_goal(Goal("seated", party=("c2",)))
    assert run.goals == (Goal("seated", party=("c1", "c2")),)
    with pytest.raises(Refused, match="wanted already"):
        run.add_goal(Goal("seated", party=("c1",)))
    run.drop_goal(Goal("seated", party=("c2", "c1")))
    assert run.goals == ()


@pytest.mark.parametrize(
    ("goal", "message"),
    [
        (Goal("seated", party=("nobody",)), "unknown customer nobody"),
        (Goal("seated", party=("c1", "d1")), "not of one party"),
    ],
    ids=["unknown", "two parties"],
)
def test_goals_that_cannot_be_meant_are_refused(goal: Goal, message: str) -> None:
    run = executive()
    run.observe([*enter("c1"), *enter("d1")])
    with pytest.raises(Refused, match=message):
        run.add_goal(goal)
    assert run.goals == ()


def test_an_unknown_goal_cannot_be_dropped() -> None:
    with pytest.raises(Refused, match="is no goal"):
        executive().drop_goal(Goal("at", node="a"))


def test_the_order_of_goals_holds_across_plans() -> None:
    layout = read_layout(CAFE, "cafe.yaml")
    state = State("c", seated=(("t1", ("g1",)), ("t2", ("g2",))), chairs=(("t1", 2), ("t2", 4)))
    paid = Goal("paid", table="t1"), Goal("paid", table="t2")
    run = Executive(layout, oracle, state=state, before=(paid,))
    decision = run.observe([*bill("t1"), *bill("t2")])
    assert [a.text for a in decision.plan if a.name == "give_bill"] == [
        "give_bill(agent,t1)",
        "give_bill(agent,t2)",
    ]
    while run.state.agent != "a" or "t1" not in run.state.paid:
        decision = run.done(run.step)
    decision = run.observe(enter("c1"))  # planned anew: the first of the pair was reached already
    assert not decision.pending or decision.pending[0].then is None
    assert any(a.text == "give_bill(agent,t2)" for a in decision.plan)


# -- what cannot be ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "seen",
    [enter("c1"), leave("nobody"), [Observation("at", ("w1", "c"))], [*enter("x"), *enter("x")]],
    ids=["inside already", "not inside", "on the robot's node", "twice"],
)
def test_contradictions_are_refused_and_change_nothing(seen: list[Observation]) -> None:
    run = executive(CAFE.replace("agent: c", "agent: c\nwaiters: {w1: door}"))
    run.observe(enter("c1"))
    before = (run.state, run.decision, run.goals)
    with pytest.raises(Refused) as refused:
        run.observe(seen)
    assert refused.value.reasons
    assert (run.state, run.decision, run.goals) == before


def test_leaving_may_be_told_with_every_member() -> None:
    run = executive()
    run.observe(enter("c1", "c2"))
    run.observe([*leave("c1"), *leave("c2")])
    assert run.state.parties() == ()


# -- timetables, copies, limits ---------------------------------------------------------------


def test_a_timetable_counts_from_the_start_of_the_run() -> None:
    text = CAFE.replace("agent: c", "agent: c\nwaiters: {w1: b}\ntimetable: {w1: {3: a, 5: door}}")
    run = executive(text, goals=(Goal("at", node="b"),))
    assert (run.decision.horizon, len(run.decision.plan)) == (4, 1), "idle until he has gone"
    for step in range(3):
        decision = run.done(step)
    assert dict(run.state.waiters) == {"w1": "a"}
    assert texts(decision) == ["3:go_to(agent,b)"]
    assert run.done(3).horizon == 0 and run.state.agent == "b"


def test_who_is_due_where_the_robot_has_failed_to_leave_comes_a_step_later() -> None:
    places = "agent: a\nwaiters: {w1: c, w2: door}\ntimetable: {w1: {1: a}, w2: {3: b, 5: c}}"
    run = executive(CAFE.replace("agent: c", places), goals=(Goal("at", node="b"),))
    assert texts(run.decision) == ["0:go_to(agent,b)"]
    run.failed(0)
    assert dict(run.state.waiters) == {"w1": "c", "w2": "door"}
    assert run.layout.timetable == (("w1", 2, "a"), ("w2", 3, "b"), ("w2", 5, "c"))
    again = executive(CAFE.replace("agent: c", places), goals=(Goal("at", node="b"),))
    restore(json.loads(json.dumps(snapshot(run))), again)
    assert again.layout.timetable == run.layout.timetable
    for each in (run, again):
        assert texts(each.decision) == ["1:go_to(agent,b)"]
        each.done(1)
        assert dict(each.state.waiters) == {"w1": "a", "w2": "door"}


def test_a_copy_goes_its_own_way() -> None:
    run = executive()
    run.observe(enter("c1"))
    fork = copy.copy(run)
    fork.done(0)
    fork.observe(enter("c2"))
    assert (run.step, run.state.agent, len(run.state.waiting)) == (0, "c", 1)
    assert texts(run.decide()) == texts(run.decision)


def test_a_search_that_ran_out_of_time_keeps_the_old_plan_where_it_is_no_worse() -> None:
    answers: list[PlannerAnswer] = []

    def planner(problem: Problem) -> PlannerAnswer:
        return answers[-1] if answers else oracle(problem)

    run = executive(planner=planner)
    first = run.observe(enter("c1"))
    answers.append(PlannerAnswer("undecided", None, limit="time"))
    decision = run.observe(bill("t2"))
    assert decision.status == "undecided" and decision.limit == "time" and not decision.minimal
    assert decision.plan == () or decision.plan == first.plan


def test_other_edges_another_plan() -> None:
    run = executive(CAFE.replace("[b, c]]", "[b, c], [c, a]]"), goals=(Goal("at", node="a"),))
    assert texts(run.decision) == ["0:go_to(agent,a)"]
    shut = read_layout(CAFE, "cafe.yaml")
    assert isinstance(shut, Layout)
    assert texts(run.change_layout(shut)) == ["0:go_to(agent,b)", "1:go_to(agent,a)"]
