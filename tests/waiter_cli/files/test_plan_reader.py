"""Plan files: actions by name or by text, what they remember, and every fault at its place."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.rule_cases import HALL
from waiter_cli.errors import InputError, LayoutError, ReplayError
from waiter_cli.files.plan_reader import read_final_state, read_plan, read_plan_file
from waiter_cli.model.plan import Action, Plan

STEP = {"step": 0, "name": "go_to", "args": ["agent", "b"]}


def text_of(*actions: Any, **more: Any) -> str:
    return json.dumps({"status": "plan", "actions": list(actions), **more})


def faults(text: str) -> list[str]:
    with pytest.raises(ReplayError) as told:
        read_plan(text, "p.json")
    return [fault.message for fault in told.value.faults]


def test_actions_by_their_parts_or_by_their_text() -> None:
    plan = read_plan(text_of(STEP, {"step": 2, "text": "pick(agent, c1)"}), "p.json").plan
    assert plan == Plan((Action(0, "go_to", ("agent", "b")), Action(2, "pick", ("agent", "c1"))), 3)
    assert read_plan(text_of(STEP, horizon=5), "p.json").plan.horizon == 5


def test_what_a_plan_remembers() -> None:
    document = read_plan(text_of(STEP, layout="hall", domain="report"), "p.json")
    assert (document.layout, document.domain, document.layout_file) == ("hall", "report", None)
    assert document.remarks == () and document.name == "p.json"


def test_a_text_that_says_another_action_is_remarked() -> None:
    document = read_plan(text_of({**STEP, "text": "go_to(agent,c)"}), "p.json")
    (remark,) = document.remarks
    assert remark == "step 0 is go_to(agent,b) by its name and args, whatever its text says"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("{", "this is no JSON"),
        ("nodes: {a: [0, 0]}\nedges: []\n", "this is a layout, not a plan"),
        ('{"a": NaN}', "this JSON is nested too deeply or too large"),
        ('{"status": "no_plan", "actions": []}', "the file holds no plan: its status is no_plan"),
        ('{"status": "plan"}', "the file has no actions"),
        (text_of({"name": "go_to", "args": []}), "this action has no step"),
        (text_of({"step": 0, "args": []}), "this action has no name"),
        (text_of({"step": 0, "name": "go_to"}), "this action has no args"),
        (text_of({"step": 0, "text": "go to b"}), "go to b is no action"),
    ],
)
def test_a_fault_is_told(text: str, message: str) -> None:
    assert faults(text) == [message]


def test_all_faults_come_together() -> None:
    assert len(faults(text_of({"step": 0}, {"name": "x", "args": []}))) == 2


def test_json_that_is_no_yaml_is_read() -> None:
    """JSON may write a sign in two halves, YAML not."""
    text = r'{"actions": [], "x": "\ud83d\ude00"}'
    document = read_plan(text, "p.json")
    assert document.plan == Plan((), 0)
    assert document.text == '{"actions": [], "x": "😀"}'
    assert read_final_state(document, HALL) is None


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(InputError) as told:
        read_plan_file(str(tmp_path / "gone.json"))
    assert told.value.faults[0].message == "no such file or directory"


def test_the_final_state_it_predicts() -> None:
    document = read_plan(text_of(STEP, final_state={"agent": "b"}), "p.json")
    state = read_final_state(document, HALL)
    assert state is not None and state.agent == "b"
    assert read_final_state(read_plan(text_of(STEP), "p.json"), HALL) is None
    with pytest.raises(LayoutError):
        read_final_state(read_plan(text_of(final_state={"agent": "z"}), "p.json"), HALL)
