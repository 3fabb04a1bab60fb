"""``waiter layout schema``: what the readers take the schemas take, and misspelt keys they do not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.support.cli import waiter
from waiter_cli.file_access.locate import built_in, find, read_text
from waiter_cli.layout_tools.generate import SIZES, UNSOLVABLE, generate_instance
from waiter_cli.layout_tools.json_schema import MODELINE, layout_schema, scenario_schema

jsonschema = pytest.importorskip("jsonschema")

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


def value_of(text: str) -> Any:
    """A YAML text as JSON sees it: keys are texts."""
    return json.loads(json.dumps(yaml.safe_load(text)))


def faults(schema: dict[str, Any], text: str) -> list[str]:
    """What a schema finds wrong with a YAML text."""
    checker = jsonschema.Draft202012Validator(schema)
    return [error.message for error in checker.iter_errors(value_of(text))]


def test_both_are_schemas_of_their_draft() -> None:
    for schema in (layout_schema(), scenario_schema()):
        jsonschema.Draft202012Validator.check_schema(schema)
        assert schema["$schema"].endswith("2020-12/schema")
        json.dumps(schema)


@pytest.mark.parametrize("name", built_in("layout"))
def test_shipped_layouts_fit(name: str) -> None:
    assert faults(layout_schema(), read_text(name, "layout").text) == []


@pytest.mark.parametrize("name", built_in("scenario"))
def test_shipped_scenarios_fit(name: str) -> None:
    assert faults(scenario_schema(), read_text(name, "scenario").text) == []


@pytest.mark.parametrize("size", SIZES)
def test_generated_files_fit(size: str) -> None:
    for seed, reason in enumerate((None, *UNSOLVABLE)):
        if size == "XL" and seed > 1:
            continue
        layout, scenario = generate_instance(seed, size, bar=seed % 2 == 0, unsolvable=reason)
        assert faults(layout_schema(), layout) == []
        assert faults(scenario_schema(), scenario) == []


def test_every_form_of_a_scenario_fits() -> None:
    assert faults(scenario_schema(), FULL) == []
    for single in ("observe: {bill: table1}", "goals: {at: n1}", "goals: []", "layout:"):
        assert faults(scenario_schema(), single) == []


LAYOUT = read_text("report", "layout").text + "timetable: {w1: {3: n4}}\ncustomers: 6\nbar: [n3]\n"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("entrance: n5", "entrence: n5"),
        ("entrance: n5", "entrance: [n5]"),
        ("agent: n1", "agent: N1"),
        ("agent: n1", "agent: and"),
        ("- [n1, n2]", "- [n1, n2, n3]"),
        ("- [n1, n2]", "- [n1, n1]"),
        ("n0: [-1.9, -2.9]", "n0: [-1.9]"),
        ("capacity: 2", "capacity: 0"),
        ("capacity: 2", "capacity: two"),
        ("capacity: 2, nodes: [n6]", "capacity: 2, nodes: []"),
        ("capacity: 2, nodes: [n6]", "nodes: [n6]"),
        ("size: [0.8, 0.8]", "size: [0.8, 0]"),
        ("{3: n4}", "{soon: n4}"),
        ("bar: [n3]", "bar: {from: [0, 1], nodes: [n3]}"),
        ("customers: 6", "customers: -1"),
    ],
)
def test_what_the_reader_refuses_the_schema_refuses(old: str, new: str) -> None:
    assert faults(layout_schema(), LAYOUT) == []
    assert old in LAYOUT
    broken = LAYOUT.replace(old, new)
    assert faults(layout_schema(), broken)
    assert waiter("layout", "check", "-", stdin=broken).code == 2


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
    assert faults(scenario_schema(), text)
    assert waiter("plan", "--layout", "bistro", "--scenario", "-", stdin=text).code == 2


def test_the_command_prints_the_schema_and_the_line_for_editors(tmp_path: Path) -> None:
    ran = waiter("layout", "schema")
    assert ran.code == 0
    assert ran.json() == layout_schema()
    assert f"{MODELINE}layout.schema.json" in ran.err
    target = tmp_path / "s.json"
    ran = waiter("layout", "schema", "--scenario", "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    assert json.loads(target.read_text()) == scenario_schema()
    assert f"{MODELINE}s.json" in ran.err


def test_a_file_with_the_line_is_read_as_before(tmp_path: Path) -> None:
    with open(find("report", "layout"), encoding="utf-8") as file:
        text = f"{MODELINE}layout.schema.json\n" + file.read()
    assert waiter("layout", "check", "-", stdin=text).code == 0
