"""Why no plan exists: each reason in the user's words and at the place in his files.

The hall (entrance e, agent at a, bar at a):

    a — b — c — e        big (4) at c, small (2) at b and d, attic (6) at x
        |   |
        d ——+            x has no way to it
"""

from __future__ import annotations

import pytest

from tests.support.exhaustive import shortest
from waiter_cli.bounds import find_bounds
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import SIZES, UNSOLVABLE, generate_instance
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem

HALL = """\
name: hall
nodes: [a, b, c, d, e, x]
edges: [[a, b], [b, c], [b, d], [c, d], [c, e]]
entrance: e
agent: a
tables:
  big: {capacity: 4, nodes: [c]}
  small: {capacity: 2, nodes: [b, d]}
  attic: {capacity: 6, nodes: [x]}
waiters: {w: d}
bar: [a]
"""


def posed(scenario: str, layout: str = HALL) -> Problem:
    hall = read_layout(layout, "hall.yaml")
    return pose_problem(hall, read_scenario(scenario, "evening.yaml", hall))


CASES = {
    "entrance blocked": (
        "state:\n  waiters: {w: c}\nobserve:\n  - enter: [c1]\n",
        "the entrance e can be reached only through c, where w stands",
        "evening.yaml:2:13",
    ),
    "waiter seen in the way": (
        "observe:\n  - enter: [c1]\n  - at: {w: c}\n",
        "the entrance e can be reached only through c, where w stands",
        "evening.yaml:3:",
    ),
    "waiter on the entrance": (
        "state:\n  waiters: {w: e}\n  waiting: [[c1]]\n",
        "w stands on the entrance e",
        "evening.yaml:2:13",
    ),
    "waiter at the only place of a table": (
        "state:\n  waiters: {w: c}\n  seated: {big: [c1]}\n  wants_bill: [big]\n",
        "w stands on c, the only place from which big can be reached",
        "evening.yaml:2:13",
    ),
    "no path": (
        "state:\n  waiting: [[c1]]\ngoals:\n  - seated: {party: c1, table: attic}\n",
        "no path of edges leads from a to attic (x)",
        "hall.yaml:9:",
    ),
    "place to end at": (
        "goals:\n  - at: d\n",
        "w stands on d",
        "hall.yaml:10:",
    ),
    "two places to end at": (
        "goals:\n  - at: a\n  - at: b\n",
        "the agent cannot end both at a and at b",
        "evening.yaml:3:",
    ),
    "too large for every table": (
        "observe:\n  - enter: [c1, c2, c3, c4, c5, c6, c7]\n",
        "a party of 7 (c1 …) fits no table: the largest, attic, seats 6",
        "evening.yaml:2:",
    ),
    "too large for what can be reached": (
        "observe:\n  - enter: [c1, c2, c3, c4, c5]\n",
        "no path of edges leads from a to attic (x)",
        "hall.yaml:9:",
    ),
    "too large for the table": (
        "state:\n  waiting: [[c1, c2, c3]]\ngoals:\n  - seated: {party: c1, table: small}\n",
        "a party of 3 (c1 …) does not fit small, which seats 2",
        "evening.yaml:4:",
    ),
    "table taken": (
        "state:\n  waiting: [[c1]]\n  seated: {big: [c2]}\ngoals:\n"
        "  - seated: {party: c1, table: big}\n",
        "big is not free for c1: the party of c2 sits there",
        "evening.yaml:5:",
    ),
    "sits elsewhere": (
        "state:\n  seated: {big: [c1]}\ngoals:\n  - seated: {party: c1, table: small}\n",
        "c1 sits at big already",
        "evening.yaml:4:",
    ),
    "two parties, one table": (
        "state:\n  waiting: [[c1, c2, c3], [c4, c5, c6]]\n",
        "a party of 3 (c1 …) and a party of 3 (c4 …) need 2 tables, and there is only big",
        "evening.yaml:2:",
    ),
    "led party in the way": (
        "state:\n  with_agent: [c1, c2, c3, c4, c5]\n  waiting: [[c6]]\ngoals:\n  - seated: c6\n",
        "a party of 5 (c1 …) with the agent fits no free table within reach, "
        "so nobody else can be picked up",
        "evening.yaml:2:",
    ),
    "bill of nobody": (
        "state:\n  wants_bill: [big]\ngoals:\n  - paid: big\n",
        "nobody can sit at big, so its bill can never be given",
        "evening.yaml:4:",
    ),
    "bill not wanted": (
        "state:\n  seated: {big: [c1]}\ngoals:\n  - paid: big\n",
        "big has not paid and does not want its bill",
        "evening.yaml:4:",
    ),
    "two bills, one party": (
        "state:\n  waiting: [[c1]]\n  wants_bill: [big, small]\n",
        "big and small must all be sat at, and only c1 could",
        "evening.yaml:3:",
    ),
    "not ready to order": (
        "state:\n  seated: {big: [c1]}\ngoals:\n  - ordered: big\n",
        "big is not ready to order",
        "evening.yaml:4:",
    ),
    "no plate": (
        "state:\n  seated: {big: [c1]}\n  ready_to_order: [big]\ngoals:\n  - served: big\n",
        "no plate for big is ready, and nothing says when one will be",
        "evening.yaml:5:",
    ),
    "chairs": (
        "goals:\n  - chairs: {small: 3}\n",
        "small has room for 2 chairs, not for 3",
        "evening.yaml:2:",
    ),
    "circle": (
        "state:\n  waiting: [[c1], [c2]]\nbefore:\n  - [{seated: c1}, {seated: c2}]\n"
        "  - [{seated: c2}, {seated: c1}]\n",
        "the order goes in a circle",
        "evening.yaml:4:",
    ),
    "held from the start": (
        "state:\n  waiting: [[c1]]\nbefore:\n  - [{seated: c1}, {at: a}]\n",
        "at: a holds already, so nothing can come before it",
        "evening.yaml:4:",
    ),
    "on the way": (
        "state:\n  waiting: [[c1]]\nbefore:\n  - [{seated: c1}, {at: b}]\n",
        "seated: [c1] cannot come before at: b: every way there leads over b",
        "evening.yaml:4:",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_reason(name: str) -> None:
    scenario, message, where = CASES[name]
    problem = posed(scenario)
    assert shortest(problem).length is None
    reasons = find_bounds(problem).impossible
    assert len(reasons) == 1, reasons
    assert reasons[0].message.startswith(message)
    assert str(reasons[0].where).startswith(where)


def test_waiters_on_both_ways_are_one_reason_and_one_after_the_other_are_two() -> None:
    ring = HALL.replace("waiters: {w: d}", "waiters: {v: b, w: d}").replace(
        "[[a, b], [b, c], [b, d], [c, d], [c, e]]", "[[a, b], [a, d], [b, c], [d, c], [c, e]]"
    )
    together = find_bounds(posed("state:\n  waiting: [[c1]]\n", ring)).impossible
    assert [reason.message for reason in together] == [
        "the entrance e can be reached only through b, where v stands or through d, where w stands"
    ]
    row = HALL.replace("waiters: {w: d}", "waiters: {v: b, w: c}")
    apart = find_bounds(posed("state:\n  waiting: [[c1]]\n", row)).impossible
    assert {reason.message for reason in apart} == {
        "the entrance e can be reached only through b, where v stands",
        "the entrance e can be reached only through c, where w stands",
    }


def test_a_waiter_who_will_move_is_no_reason() -> None:
    moving = HALL.replace("waiters: {w: d}", "waiters: {w: c}\ntimetable: {w: {4: d}}")
    problem = posed("state:\n  waiting: [[c1]]\n", moving)
    bounds = find_bounds(problem)
    assert bounds.impossible == ()
    assert bounds.plan is not None and bounds.plan.horizon == shortest(problem).length


def test_an_empty_hall_is_never_at_fault() -> None:
    assert find_bounds(posed("name: nothing\n")).impossible == ()


@pytest.mark.parametrize("kind", UNSOLVABLE)
@pytest.mark.parametrize("size", SIZES)
def test_generated_evenings_without_a_plan_are_proved_at_once(size: str, kind: str) -> None:
    for seed in range(3):
        try:
            layout_text, scenario_text = generate_instance(seed, size, unsolvable=kind)
        except InputError:
            continue
        layout = read_layout(layout_text, "layout.yaml")
        problem = pose_problem(layout, read_scenario(scenario_text, "scenario.yaml", layout))
        reasons = find_bounds(problem).impossible
        assert reasons
        assert all(reason.where is not None for reason in reasons)
