"""No plan of any length, for a domain of one's own: never said where there is a plan, and said why."""

from __future__ import annotations

from dataclasses import replace

import pytest

import waiter_cli
from sparc.source import Source
from tests.support.own_domains import dirty_domain
from tests.support.sampling import mostly_slow_blocks
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.domains import Domain, find_domain
from waiter_cli.planning.no_plan_proof import prove_no_plan
from waiter_cli.planning.search_results import SearchStatus

RESTAURANT = replace(find_domain("restaurant"), built_in=False)
REPORT = waiter_cli.read_layout("report")


@pytest.mark.parametrize("seeds", mostly_slow_blocks(range(2000), range(12)))
def test_no_plan_is_never_proved_where_there_is_one(seeds: range) -> None:
    for seed in seeds:
        problem = small_problem(seed)
        answer = waiter_cli.plan(problem, time_limit=20)
        if answer.plan is None or answer.plan.horizon == 0 or problem.contradictions:
            continue
        assert prove_no_plan(problem, RESTAURANT, most_states=40) is None, seed


def test_what_nothing_can_make_true_is_proved_impossible() -> None:
    """A table can be dirty in this domain, and no rule ends it."""
    problem = waiter_cli.pose_problem(REPORT, goals=["holds: isdirty(table1)", "at: n3"])
    answer = waiter_cli.plan(problem, domain=dirty_domain())
    assert answer.result.status is SearchStatus.NO_PLAN
    (reason,) = answer.result.reasons
    assert reason.message.startswith("holds isdirty(table1): nothing that can come about")
    assert str(reason.where) == "--goal"


@pytest.mark.parametrize(
    "rule",
    [
        "holds(isdirty(T), I+1) :- occurs(go_to(agent, N), I), near(T, I).",
        "holds(isdirty(T), I) :- holds(currentlocation(agent, n6), I), #table(T).",
        "holds(isdirty(T), I+1) :- holds(currentlocation(agent, n6), I+1), #table(T).",
        "holds(isdirty(T), I) :- #table(T), #step(I), I >= 4.",
        "holds(isdirty(T), I+2) :- occurs(go_to(agent, N), I), #table(T).",
        "holds(isdirty(T), I-1) :- occurs(go_to(agent, n5), I), #table(T).",
        "holds(isdirty(T), I) :- #table(T), #step(I), #count{J : occurs(go_to(agent, N), J)} > 2.",
        "holds(isdirty(T), I) :- success, #table(T), #step(I).",
    ],
)
def test_rules_of_other_forms_prove_nothing_wrong(rule: str) -> None:
    """Each of these can make a table dirty, some only at a step that a proof by single steps is blind to."""
    problem = waiter_cli.pose_problem(REPORT, goals=["holds: isdirty(table1)"])
    assert prove_no_plan(problem, dirty_domain(rule), most_states=150) is None


@pytest.mark.parametrize(
    "constraint",
    [
        ":- occurs(go_to(agent, N), 0).",
        ":- occurs(A, I), I < 4.",
        ":- occurs(go_to(agent, N), I), occurs(go_to(agent, M), J), J > I + 6.",
        ":- #count{A : occurs(A, I)} < 1.",
        ":- occurs(go_to(agent, n3), I), not holds(currentlocation(agent, n2), I).",
    ],
)
def test_constraints_of_time_are_relaxed(constraint: str) -> None:
    problem = waiter_cli.pose_problem(REPORT, goals=["at: n4"])
    assert prove_no_plan(problem, dirty_domain(constraint), most_states=150) is None


def test_a_situation_that_contradicts_the_rules_is_told() -> None:
    domain = dirty_domain(":- holds(isdirty(table1), I), holds(isdirty(table2), I).")
    problem = waiter_cli.pose_problem(REPORT, goals=["at: n4"])
    state = replace(problem.state, fluents=("isdirty(table1)", "isdirty(table2)"))
    answer = waiter_cli.plan(replace(problem, state=state), domain=domain)
    assert answer.result.status is SearchStatus.NO_PLAN
    assert "contradict each other" in answer.result.reasons[0].message


def test_goals_that_exclude_each_other() -> None:
    problem = waiter_cli.pose_problem(
        REPORT, enter=[1], goals=["holds: isfree(table1)", "holds_not: isfree(table1)"]
    )
    answer = waiter_cli.plan(problem, domain=dirty_domain())
    assert answer.result.status is SearchStatus.NO_PLAN
    assert "all goals hold at one step" in answer.result.reasons[0].message


@pytest.mark.wide
def test_goals_that_exclude_each_other_by_what_is_done_for_them() -> None:
    """Each of two parties can sit at the table, and all that can come about has both there."""
    goals = ["holds: isattable(ada,table1)", "holds: isattable(cleo,table1)"]
    problem = waiter_cli.pose_problem(
        REPORT, seen=["enter: [ada, ben]", "enter: [cleo]"], goals=goals
    )
    domain = dirty_domain()
    assert prove_no_plan(problem, domain) is None
    assert prove_no_plan(problem, domain, most_states=20) is None
    (reason,) = prove_no_plan(problem, domain, most_states=3000) or ()
    assert "all goals hold at one step" in reason.message


def test_preferences_and_timetables_leave_it_open() -> None:
    problem = waiter_cli.pose_problem(REPORT, goals=["holds: isdirty(table1)"])
    late = replace(problem, layout=replace(REPORT, timetable=(("w1", 9, "n0"),)))
    assert prove_no_plan(late, dirty_domain()) is None
    text = dirty_domain().template.text.replace("\ndisplay", "\n:~ occurs(A, I). [1]\ndisplay")
    assert prove_no_plan(problem, Domain("w", Source("w", text), built_in=False)) is None
