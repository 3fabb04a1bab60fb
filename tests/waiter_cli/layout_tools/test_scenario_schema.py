"""Scenarios in all their forms fit their schema, and what no scenario says does not."""

from __future__ import annotations

import pytest

from tests.support.cli import waiter
from tests.support.schemas import schema_faults
from waiter_cli.file_access.locate import built_in, read_text
from waiter_cli.layout_tools.scenario_schema import scenario_schema

pytest.importorskip("jsonschema")


FULL = """\
state:
  agent: n6
  waiters: {w1: n7}
  seated: {table1: [c1]}
  waiting: [[c2, c3]]
  with_agent: []
  wants_bill: [table1]
  paid: []
  ready_to_order: [table1]
  ready: {table1: plate}
  carrying: {table2: jug}
  empty: {table2: [jug, basket]}
  chairs: {table2: 2}
observe:
  - enter: [c4, c5]
  - enter: c6
  - bill: table1
  - {at: {w1: n3, agent: n4}}
  - {order: table1}
  - {leave: [c1]}
  - {free: table1}
goals:
  - seated: [c4, c5]
  - seated: {party: c4, table: table2}
  - paid: table1
  - at: n4
  - served: table1
  - served: {table1: plate}
  - filled: {table1: jug}
  - chairs: {table1: 4}
  - serve: c1
before:
  - [{paid: table1}, {seated: c4}]
prefer: [shortest_walk, smallest_table, longest_waiting]
events:
  - {time: 12.5, bill: table1}
  - {time: 30, enter: [c8]}
instant_kitchen: false
"""


@pytest.mark.parametrize("name", built_in("scenario"))
def test_shipped_scenarios_fit(name: str) -> None:
    assert schema_faults(scenario_schema(), read_text(name, "scenario").text) == []


def test_every_form_of_a_scenario_fits() -> None:
    assert schema_faults(scenario_schema(), FULL) == []
    for single in ("observe: {bill: table1}", "goals: {at: n1}", "goals: []", "layout:"):
        assert schema_faults(scenario_schema(), single) == []


@pytest.mark.parametrize(
    "text",
    [
        "goal: []", "state: {agnet: n1}", "observe: [{bil: table1}]", "observe: [{}]",
        "goals: [{at: n1, paid: table1}]", "goals: [{seated: {table: table1}}]",
        "before: [[{at: n1}]]", "prefer: [fastest]", "events: [{time: 3}]", "events: [{bill: table1}]",
        "instant_kitchen: perhaps", "goals: [{filled: {table1: plate}}]",
    ],
)  # fmt: skip
def test_what_no_scenario_says_is_refused(text: str) -> None:
    assert schema_faults(scenario_schema(), text)
    assert waiter("plan", "--layout", "bistro", "--scenario", "-", stdin=text).code == 2
