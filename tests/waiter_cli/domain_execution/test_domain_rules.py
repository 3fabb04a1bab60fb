"""Execution by the domain itself: as ours in Python for the shipped rules, clear where it cannot be."""

from __future__ import annotations

import gc
import subprocess
import sys
from random import Random

import pytest

import waiter_cli
from tests.support.own_domains import dirty_domain
from tests.support.sampling import mostly_slow_blocks
from tests.support.small_worlds import fleet_problem, small_problem
from waiter_cli.domain_execution.domain_rules import DomainRules
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import InputError
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation, State
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.rules.validator import run

RESTAURANT = find_domain("restaurant")


def after(rules: Rulebook, problem: Problem, state: State, actions: list[Action]) -> State | None:
    try:
        return rules.after(problem, state, actions, 0)
    except Illegal:
        return None


def candidates(problem: Problem, state: State, rng: Random) -> list[Action]:
    """Actions of every kind, most of them impossible; parties go by their leader."""
    layout = problem.layout
    nodes = [node.name for node in layout.nodes]
    tables = [table.name for table in layout.tables]
    leaders = [party[0] for party in state.parties()]
    found = []
    for robot in state.stations():
        found += [("go_to", robot, node) for node in nodes]
        found += [("pick", robot, who) for who in leaders]
        found += [("seat", robot, who, table) for who in leaders for table in tables]
        if layout.bar is None:
            names: tuple[str, ...] = ("give_bill",)
        else:
            names = ("give_bill", "take_order", "send_order")
            for item in layout.objects:
                found += [("take_up", robot, item, table) for table in tables]
                found += [("bring", robot, item, table) for table in tables]
                if item != "plate":
                    found += [("refill", robot, item, table) for table in tables]
        found += [(name, robot, table) for name in names for table in tables]
    rng.shuffle(found)
    return [
        Action(0, name, arguments) for name, *rest in found[:40] for arguments in (tuple(rest),)
    ]


def seen(problem: Problem, state: State, rng: Random) -> Observation:
    """Something that may be seen, possible or not."""
    table = rng.choice(problem.layout.tables).name
    inside = [name for party in state.parties() for name in party]
    kinds = [("enter", ("guest1", "guest2")), ("bill", (table,)), ("free", (table,))]
    if inside:
        kinds.append(("leave", (rng.choice(inside),)))
    if problem.layout.bar is not None:
        kinds.append(("order", (table,)))
        kinds += [("ready", (table, item)) for item in problem.layout.objects]
        kinds += [("empty", (table, item)) for item in problem.layout.objects if item != "plate"]
    return Observation(*rng.choice(kinds))


def require_same(problem: Problem, seed: int) -> None:
    rng = Random(seed)
    rules = DomainRules(RESTAURANT, reasons=False)
    if problem.contradictions:
        return
    try:
        state = HOUSE.begin(problem)
    except Illegal:
        with pytest.raises(Illegal):
            rules.begin(problem)
        return
    assert rules.begin(problem) == state
    from dataclasses import replace

    problem = replace(problem, layout=replace(problem.layout, timetable=()))
    for _ in range(6):
        possible = []
        for action in [*candidates(problem, state, rng), None]:
            done = [] if action is None else [action]
            ours, its = (after(book, problem, state, done) for book in (HOUSE, rules))
            assert ours == its, (seed, action)
            possible += [] if ours is None else [ours]
        look = [seen(problem, state, rng)]
        believed, _reasons = HOUSE.observe(state, look, problem.layout)
        assert rules.observe(state, look, problem.layout)[0] == believed, (seed, look)
        if not possible:
            return
        state = rng.choice(possible)


@pytest.mark.parametrize("seeds", mostly_slow_blocks(range(2000), range(4)))
def test_both_ways_agree(seeds: range) -> None:
    """Every action, legal or not, and every observation leads to the same state, or to none."""
    for seed in seeds:
        require_same(small_problem(seed), seed)
        gc.collect()  # groundings are large, and count as few objects


@pytest.mark.parametrize("seeds", mostly_slow_blocks(range(300), range(1, 2)))
def test_both_ways_agree_on_several_robots(seeds: range) -> None:
    for seed in seeds:
        require_same(fleet_problem(seed), seed)
        gc.collect()  # groundings are large, and count as few objects


@pytest.mark.parametrize("seeds", mostly_slow_blocks(range(300), range(3)))
def test_both_ways_agree_on_plans(seeds: range) -> None:
    """Timetables move colleagues meanwhile; a plan that is cut short is invalid both ways."""
    for seed in seeds:
        require_same_plan(small_problem(seed))
        gc.collect()  # groundings are large, and count as few objects


def require_same_plan(problem: Problem) -> None:
    answer = waiter_cli.plan(problem, time_limit=20)
    if answer.plan is None:
        return
    rules = DomainRules(RESTAURANT, reasons=False)
    verdict = run(problem, answer.plan, rules)
    assert verdict.valid and verdict.states == run(problem, answer.plan).states
    short = Plan(answer.plan.actions[:-1], answer.plan.horizon)
    ours, its = run(problem, short), run(problem, short, rules)
    assert (ours.valid, ours.states) == (its.valid, its.states)


# ------------------------------------------------------------ reasons


def told(*rules: str, action: str = "go_to(agent,n2)") -> str:
    problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), goals=["at: n3"])
    name, arguments = action.removesuffix(")").split("(")
    plan = Plan((Action(0, name, tuple(arguments.split(","))),), 1)
    verdict = run(problem, plan, DomainRules(dirty_domain(*rules)))
    assert verdict.misstep is not None
    return verdict.misstep.message


@pytest.mark.parametrize(
    ("rules", "action", "said"),
    [
        ([], "go_to(agent,n5)", "edge(n1,n5) does not hold, needed by dirty.sparc:"),
        ([], "give_bill(agent,table1)", "holds(wantsbill(table1),0) does not hold"),
        ([], "go_to(agent,n33)", "n33 is no node, in go_to(agent,n33)"),
        ([], "fly(agent,n2)", "the domain has no action fly"),
        (
            ["% Nobody walks to n2.", ":- occurs(go_to(agent, n2), I)."],
            "go_to(agent,n2)",
            ":- occurs(go_to(agent, n2), I). (Nobody walks to n2)",
        ),
        (
            ["holds(isdirty(T), I+1) | -holds(isdirty(T), I+1) :- occurs(go_to(agent, N), I)."],
            "go_to(agent,n2)",
            "the domain leaves open what comes of it: one answer set is",
        ),
    ],
)
def test_why_there_is_no_state_after_an_action(rules: list[str], action: str, said: str) -> None:
    assert said in told(*rules, action=action)


def test_what_is_defined_is_told_of_too() -> None:
    problem = waiter_cli.pose_problem(
        waiter_cli.read_layout("report"), goals=["holds: isfree(table1)", "at: n2"]
    )
    plan = Plan((Action(0, "go_to", ("agent", "n2")),), 1)
    assert run(problem, plan, DomainRules(RESTAURANT)).valid
    assert not run(problem, plan).valid  # Python knows no fluents of the domain's


def test_a_domain_without_goals_of_the_form_cannot_be_executed() -> None:
    from dataclasses import replace

    from sparc.source import Source

    text = RESTAURANT.template.text.replace("required(", "wished(").replace("required(1)", "x")
    own = replace(RESTAURANT, template=Source("own.sparc", text), built_in=False)
    problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"))
    with pytest.raises(InputError, match=r"no predicate required\(#goal\)"):
        DomainRules(own).begin(problem)


THREADS = """
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import waiter_cli
from waiter_cli.domain_execution.domain_rules import DomainRules
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.state import Observation

sys.setswitchinterval(1e-5)
layout = read_layout_file("report")
state = state_of_layout(layout)[0]
rules = DomainRules(waiter_cli.find_domain("housekeeping"))


def spilled(number):
    seen = Observation("obs", (f"spilled(table{1 + number % 2})",))
    return rules.observe(replace(state, agent=f"n{number % 8}"), (seen,), layout)[0]


told = [spilled(number) for number in range(16)]
with ThreadPoolExecutor(4) as pool:
    assert list(pool.map(spilled, range(160))) == told * 10
"""


@pytest.mark.wide
def test_several_threads_may_ask_at_once() -> None:
    """The page of the studio asks while the evening goes on; unguarded, clingo dies of it."""
    ran = subprocess.run([sys.executable, "-c", THREADS], capture_output=True, timeout=60)
    assert ran.returncode == 0, ran.stderr.decode()[-400:]
