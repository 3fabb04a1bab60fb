"""Customers under numbers and back: nothing else of a problem or a plan is touched."""

from __future__ import annotations

from dataclasses import replace

from tests.support.rule_cases import HALL, LED, ONE, at, plan, posed
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.aliases import Aliases
from waiter_cli.model.layout import Node
from waiter_cli.model.state import Goal, Observation, Robot


def test_names_go_by_numbers_in_their_order_and_come_back() -> None:
    aliases = Aliases(["zoe", "anna"], HALL)
    assert aliases.names(("agent", "guest001", "guest002", "big")) == (
        "agent",
        "anna",
        "zoe",
        "big",
    )


def test_no_alias_is_the_name_of_something_else() -> None:
    layout = replace(HALL, nodes=(*HALL.nodes, Node("guest001")))
    assert Aliases(["anna"], layout).names(("guestx001",)) == ("anna",)


def test_everybody_of_whom_a_problem_speaks_is_renamed_everywhere() -> None:
    problem = replace(
        posed(at("a", waiting=(LED,), seated=(("big", ("ben",)),)), Goal("seated", LED)),
        observations=(Observation("enter", LED), Observation("bill", ("big",))),
        before=((Goal("paid", ("ben",)), Goal("seated", LED)),),
    )
    renamed = Aliases.of_problem(problem).problem(problem)
    assert renamed.state.waiting == (("guest002", "guest003"),)
    assert renamed.state.seated == (("big", ("guest001",)),)
    assert renamed.goals == (Goal("seated", ("guest002", "guest003")),)
    assert renamed.before[0][0] == Goal("paid", ("guest001",))
    assert [o.arguments for o in renamed.observations] == [("guest002", "guest003"), ("big",)]
    assert renamed.layout == problem.layout


def test_who_follows_a_robot_is_renamed_too() -> None:
    state = at("a", robots=(Robot("r", "a", leads=LED),))
    assert Aliases(LED, HALL).state(state).robots[0].leads == ("guest001", "guest002")


def test_plans_go_both_ways() -> None:
    aliases = Aliases([*LED, "c3"], HALL)
    told = plan("go_to(agent,b)", "pick(agent,c1)", "seat(agent,c1,big)")
    posed_plan = aliases.posed(told)
    assert [action.text for action in posed_plan.actions][1] == "pick(agent,guest001)"
    assert aliases.plan(posed_plan) == told


def test_as_many_are_inside_as_before() -> None:
    for seed in range(20):
        problem = small_problem(seed)
        renamed = Aliases.of_problem(problem).problem(problem)
        assert sorted(map(len, renamed.state.parties())) == sorted(
            map(len, problem.state.parties())
        )
        assert replace(renamed.state, seated=(), waiting=(), with_agent=(), robots=()) == replace(
            problem.state, seated=(), waiting=(), with_agent=(), robots=()
        )
    assert Aliases.of_problem(posed(at("a", seated=ONE))).names(("guest001",)) == ("c1",)
