"""Several robots in files: the forms of layouts, states and goals, and what is wrong with others."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.errors import LayoutError
from waiter_cli.files.documents import state_document
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.layout_schema import layout_schema
from waiter_cli.layout_tools.scenario_schema import scenario_schema
from waiter_cli.model.state import Robot

LAYOUT = """\
name: pair
nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [6, 0], e: [2, 2]}
edges: [[a, b], [b, c], [c, d], [b, e]]
entrance: a
agents: {r1: b, r2: d}
tables: {t1: {capacity: 2, nodes: [c]}, t2: {capacity: 4, nodes: [e]}}
bar: [d]
waiters: {w1: e}
"""
STATE = """\
state:
  agents: {r2: c}
  with_agent: {r1: [c1, c2]}
  carrying: {r2: {t1: jug}}
  ordered: {t2: r1}
  seated: {t1: [c3], t2: [c4]}
  empty: {t1: jug}
goals:
  - at: {r1: a, r2: d}
  - at: c
"""


def faults(text: str, layout: str = LAYOUT) -> list[str]:
    with pytest.raises(LayoutError) as caught:
        read_scenario(text, "s.yaml", read_layout(layout, "l.yaml"))
    return [
        f"{f.where.line}:{f.where.column}: {f.message}; {f.hint}"
        for f in caught.value.faults
        if f.where
    ]


def test_the_forms_of_a_state() -> None:
    layout = read_layout(LAYOUT, "l.yaml")
    scenario = read_scenario(STATE, "s.yaml", layout)
    assert layout.agents == (("r1", "b"), ("r2", "d"))
    state = scenario.state
    assert state.robots == (
        Robot("r1", "b", ("c1", "c2"), None, frozenset({"t2"})),
        Robot("r2", "c", (), ("t1", "jug"), frozenset()),
    )
    assert [goal.as_dict() for goal in scenario.goals or ()] == [
        {"at": {"r1": "a"}}, {"at": {"r2": "d"}}, {"at": "c"},
    ]  # fmt: skip
    document = state_document(state, layout)
    assert document["agents"] == {"r1": "b", "r2": "c"}
    assert document["with_agent"] == {"r1": ["c1", "c2"]}
    assert document["carrying"] == {"r2": {"t1": "jug"}}
    assert document["ordered"] == {"t2": "r1"}
    again = read_scenario(json.dumps({"state": document}), "again", layout)
    assert again.state == state
    assert read_layout(write_layout(layout), "l.yaml").agents == layout.agents


@pytest.mark.parametrize(
    ("layout", "expected"),
    [
        (LAYOUT.replace("agents", "agent: a\nagents"), "5:8: agent and agents are both given"),
        (LAYOUT.replace("{r1: b, r2: d}", "{}"), "5:9: there are no robots"),
        (LAYOUT.replace("r2: d", "r2: b"), "5:17: r2 and r1 both stand on b"),
        (LAYOUT.replace("r2: d", "r2: e"), "8:11: w1 and r2 both stand on e"),
        (LAYOUT.replace("r2: d", "t1: d"), "5:17: t1 is a table already, so no robot can be called that"),
        (LAYOUT.replace("r2: d", "r2: z"), "5:21: unknown node z"),
        (LAYOUT.replace("r2: d", "agent: d"), "agent"),
        (LAYOUT.replace("{r1: b, r2: d}", "[b, d]"), "5:9: agents must be"),
        (LAYOUT.replace("agents: {r1: b, r2: d}\n", ""), "the layout has no agent"),
    ],
)  # fmt: skip
def test_layouts_with_faults(layout: str, expected: str) -> None:
    with pytest.raises(LayoutError) as caught:
        read_layout(layout, "l.yaml")
    told = [f"{f.where.line}:{f.where.column}: {f.message}" for f in caught.value.faults if f.where]
    assert any(expected in line for line in told), told


@pytest.mark.parametrize(
    ("state", "expected"),
    [
        ("agent: a", "1:16: the layout has several robots: r1, r2; write agents: {r1: NODE}"),
        ("agents: {r3: a}", "1:18: unknown robot r3; known: r1, r2"),
        ("agents: {r1: d}", "r2 and r1 both stand on d"),
        ("agents: {r1: e}", "w1 and r1 both stand on e"),
        ("agents: a", "agents must be a mapping"),
        ("with_agent: [c1]", "with_agent must be a mapping, which robot each party follows"),
        ("with_agent: {r1: [c1], r2: [c1]}", "c1 is in two places"),
        ("carrying: {t1: jug}", "unknown robot t1"),
        ("carrying: {r1: {t1: [jug, plate]}}", "r1 carries two things; its hands hold one"),
        ("carrying: {r1: {t1: jug}, r2: {t1: jug}}", "r2 and r1 both carry the jug for t1"),
        ("ordered: [t1]", "ordered must be a mapping, a table and the robot that took its order"),
        ("ordered: {t1: r9}", "unknown robot r9"),
    ],
)  # fmt: skip
def test_states_with_faults(state: str, expected: str) -> None:
    told = faults(f"state: {{{state}}}\n")
    assert any(expected in line for line in told), told


def test_one_robot_has_the_forms_for_one() -> None:
    single = LAYOUT.replace("agents: {r1: b, r2: d}", "agent: b")
    told = faults("state: {agents: {r1: a}}", single)
    assert "the layout has one robot, called agent; write agent: NODE" in told[0]
    told = faults("goals: [{at: {r1: a}}]", single)
    assert "the agent's place must be the name of a node" in told[0]


def test_schemas_take_the_forms() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    yaml = pytest.importorskip("yaml")
    jsonschema.validate(yaml.safe_load(LAYOUT), layout_schema())
    jsonschema.validate(yaml.safe_load(STATE), scenario_schema())
    both = LAYOUT.replace("agents", "agent: a\nagents")
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(yaml.safe_load(both), layout_schema())


def test_a_plan_for_two_is_planned_printed_and_judged(tmp_path: Path) -> None:
    layout = tmp_path / "pair.yaml"
    layout.write_text(LAYOUT.replace("waiters: {w1: e}\n", ""))
    swap = ("--goal", "at: {r1: d, r2: b}")
    document = waiter("plan", "-l", str(layout), *swap, "--json").json()
    assert (document["agents"], document["horizon"], document["minimal"]) == (["r1", "r2"], 5, True)
    assert document["search"]["fewest_actions"] == "proved"
    assert document["final_state"]["agents"] == {"r1": "d", "r2": "b"}
    assert {action["args"][0] for action in document["actions"]} == {"r1", "r2"}
    shown = waiter("plan", "-l", str(layout), *swap).out
    assert shown.splitlines()[0].split() == ["step", "r1", "r2"]
    plan = tmp_path / "plan.json"
    plan.write_text(json.dumps(document))
    assert waiter("validate", str(plan)).code == 0
    for moves, told in (
        ([("r1", "c"), ("r2", "c")], "step 0: r1 and r2 would both stand on c at step 1"),
        ([("r1", "c")], "at the end"),
    ):
        actions = [{"step": 0, "name": "go_to", "args": list(move)} for move in moves]
        plan.write_text(json.dumps(document | {"actions": actions}))
        ran = waiter("validate", str(plan))
        assert ran.code == 3 and told in ran.out, ran.out
    close = document | {"initial_state": {"agents": {"r1": "b", "r2": "c"}}, "actions": [
        {"step": 0, "name": "go_to", "args": ["r1", "c"]},
        {"step": 0, "name": "go_to", "args": ["r2", "b"]},
    ]}  # fmt: skip
    plan.write_text(json.dumps(close))
    ran = waiter("validate", str(plan))
    assert ran.code == 3 and "r1 and r2 would exchange b and c at step 0" in ran.out


@pytest.mark.parametrize(
    "command",
    [
        ("plan", "--domain", "report", "--enter", "1", "-l"),
        ("layout", "improve"),
    ],
    ids=" ".join,
)
def test_what_takes_one_robot_only_says_so_where_they_are_given(
    tmp_path: Path, command: tuple[str, ...]
) -> None:
    (tmp_path / "pair.yaml").write_text(LAYOUT)
    ran = waiter(*command, str(tmp_path / "pair.yaml"), stdin="")
    assert ran.code == 2, ran.out + ran.err
    assert "pair.yaml:5:9: error: several robots: " in ran.err
