"""``waiter validate`` from the front door: plan files good, bad and broken."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from waiter_cli.app import run
from waiter_cli.file_access.locate import read_text

TEXTS = (
    *("go_to(agent,n2)", "go_to(agent,n3)", "go_to(agent,n4)", "go_to(agent,n5)"),
    *("pick(agent,c1)", "go_to(agent,n6)", "seat(agent,c1,table1)"),
)


def document(texts: tuple[str, ...] = TEXTS, **more: Any) -> dict[str, Any]:
    """A plan for one customer on the report's layout, as `waiter plan --json` prints it."""
    actions = [
        {"step": k, "name": t.split("(")[0], "args": t[t.index("(") + 1 : -1].split(","), "text": t}
        for k, t in enumerate(texts)
    ]
    return {
        "status": "plan",
        "layout": "report",
        "horizon": len(texts),
        "initial_state": {"agent": "n1", "waiters": {"w1": "n7"}, "waiting": [["c1"]]},
        "goals": [{"seated": ["c1"]}],
        "before": [],
        "actions": actions,
        **more,
    }


class Front:
    """Calls the command and keeps what it printed."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self.capsys = folder, capsys

    def __call__(self, content: object, *options: str) -> tuple[int, str, str]:
        """Exit code, stdout and stderr for a plan file of this content."""
        path = self.folder / "plan.json"
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        code = run(["validate", str(path), *options])
        return code, *self.capsys.readouterr()


@pytest.fixture
def validate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Front:
    return Front(tmp_path, capsys)


def test_a_valid_plan(validate: Front) -> None:
    assert validate(document(), "--layout", "report") == (
        0,
        "valid: 7 steps, and all goals hold at the end\n",
        "",
    )


def test_the_layout_is_taken_from_the_plan_where_it_is_not_given(validate: Front) -> None:
    assert validate(document())[0] == 0
    nameless = document()
    del nameless["layout"]
    code, _, err = validate(nameless)
    assert code == 2 and "which restaurant is this plan for?" in err


@pytest.mark.parametrize("command", [["validate"], ["simulate", "--plan"]])
def test_a_plan_of_a_layout_of_ones_own_says_how_to_name_its_file(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plan = tmp_path / "plan.json"
    plan.write_text(json.dumps({**document(), "layout": "mine"}))
    assert run([*command, str(plan)]) == 2
    assert capsys.readouterr().err == (
        f"{plan}: error: the plan is for the layout mine, which is not built in\n"
        "  hint: say which file it is: --layout FILE.yaml\n"
    )
    mine = tmp_path / "mine.yaml"
    mine.write_text(read_text("report", "layout").text.replace("name: report", "name: mine"))
    assert run([*command, str(plan)]) == 2
    assert f"--layout {mine}\n" in capsys.readouterr().err
    assert run([*command, str(plan), "--layout", str(mine)]) == 0


def test_what_was_changed_by_hand_and_is_not_played_is_told(validate: Front) -> None:
    actions = [
        {"step": 0, "name": "go_to", "args": ["agent", "n2"], "text": "go_to(agent,n4)"},
    ]
    code, out, _ = validate(document(actions=actions, horizon=1))
    assert code == 3
    assert "step 0 is go_to(agent,n2) by its name and args, whatever its text says" in out
    again = json.loads(waiter("plan", "--scenario", "b1", "--json").out)
    assert validate(again) == (0, "valid: 7 steps, and all goals hold at the end\n", "")
    again["final_state"]["agent"] = "n1"
    code, out, _ = validate(again)
    assert code == 0 and "the final_state in the file is not where the actions lead" in out
    again["final_state"] = {"agent": "nowhere"}
    assert "is not where the actions lead" in validate(again)[1]


def test_a_plan_for_another_layout_is_one_fault(validate: Front) -> None:
    plan = json.loads(waiter("plan", "--scenario", "lunch", "--json").out)
    code, _, err = validate(plan, "--layout", "report")
    assert code == 2
    assert err.count("error:") == 1 and "is for the layout bistro, not for report" in err


def test_json_says_all(validate: Front) -> None:
    code, out, err = validate(document(), "--json")
    found = json.loads(out)
    assert (code, err) == (0, "")
    assert found["status"] == "valid" and found["reasons"] == [] and found["unmet"] == []
    assert (found["steps"], found["makespan"]) == (7, 7)
    assert found["goals"] == [{"seated": ["c1"]}]
    assert found["final_state"] == {
        "agent": "n6",
        "waiters": {"w1": "n7"},
        "seated": {"table1": ["c1"]},
    }


INVALID = {
    "an action left out": (
        document((*TEXTS[:4], *TEXTS[5:])),
        "step 5: seat(agent,c1,table1): the party of c1 does not follow the agent",
    ),
    "the last one left out": (
        document(TEXTS[:-1]),
        "the goal seated: [c1] does not hold at the end (step 6)",
    ),
    "two swapped": (
        document((TEXTS[1], TEXTS[0], *TEXTS[2:])),
        "step 0: go_to(agent,n3): n3 is no neighbour of n1",
    ),
    "onto a waiter": (
        document((*TEXTS[:3], "go_to(agent,n7)")),
        "step 3: go_to(agent,n7): w1 stands on n7",
    ),
    "an unknown table": (
        document((*TEXTS[:-1], "seat(agent,c1,table9)")),
        "step 6: seat(agent,c1,table9): there is no table table9",
    ),
    "an unknown action": (
        document(("fly(agent,n6)",)),
        "step 0: fly(agent,n6): there is no action fly",
    ),
    "a horizon too small": (
        document(horizon=6),
        "step 6: seat(agent,c1,table1): the plan ends at step 6",
    ),
    "goals of another evening": (
        document(goals=[{"paid": "table1"}]),
        "the goal paid: table1 does not hold at the end (step 7)",
    ),
    "goals in another order": (
        document(before=[[{"seated": ["c1"]}, {"at": "n6"}]]),
        "seated: [c1] (first at step 7) was wanted before at: n6 (first at step 6)",
    ),
    "an empty plan": (
        document(()),
        "the goal seated: [c1] does not hold at the end (step 0)",
    ),
}


@pytest.mark.parametrize("case", INVALID)
def test_an_invalid_plan_says_at_which_step_and_why(case: str, validate: Front) -> None:
    content, reason = INVALID[case]
    code, out, _ = validate(content)
    assert code == 3 and out.startswith("invalid: ") and f"  {reason}\n" in out
    code, out, _ = validate(content, "--json")
    found = json.loads(out)
    assert code == 3 and found["status"] == "invalid"
    assert reason in [one["message"] for one in found["reasons"]]


def test_two_actions_at_one_step_are_refused(validate: Front) -> None:
    content = document()
    content["actions"][1]["step"] = 0
    code, out, _ = validate(content)
    assert code == 3 and "there is another action at this step" in out


def test_a_longer_plan_is_valid_and_remarked(validate: Front) -> None:
    code, out, _ = validate(document((*TEXTS, "go_to(agent,n5)")))
    assert code == 0 and "note: not minimal: the goals hold already at step 7" in out


def test_a_party_may_be_named_by_any_member(validate: Front) -> None:
    content = document((*TEXTS[:4], "pick(agent,c2)", TEXTS[5], TEXTS[6]))
    content["initial_state"]["waiting"] = [["c1", "c2"]]
    assert validate(content)[0] == 0


def test_a_scenario_wins_over_what_the_plan_says(validate: Front) -> None:
    other = document(initial_state={"agent": "n6"}, goals=[])
    assert validate(other)[0] == 3
    assert validate(other, "--scenario", "b1")[0] == 0
    code, out, _ = validate(document(), "--scenario", "b3")
    assert code == 3 and "step 0: go_to(agent,n2): n2 is no neighbour of n6" in out


def test_another_layout_is_remarked(validate: Front) -> None:
    code, out, _ = validate(document(layout="elsewhere"), "--layout", "report")
    assert code == 0 and "note: the plan was made for the layout elsewhere, not report" in out


def test_actions_may_be_given_as_texts_alone(validate: Front) -> None:
    texts = [{"step": k, "text": text} for k, text in enumerate(TEXTS)]
    assert validate(document(actions=texts))[0] == 0


def test_json_with_tabs_is_json(validate: Front) -> None:
    assert validate(json.dumps(document(), indent="\t"))[0] == 0


BROKEN = {
    "empty file": ("", "1:1: error: the file is empty"),
    "no JSON": ('{"status": plan}', "1:12: error: this is no JSON"),
    "cut off": (json.dumps(document())[:-40], "error: this is no JSON"),
    "an empty mapping": ("{}", "1:1: error: the file has no actions"),
    "a list": ("[]", "1:1: error: a plan file must be a mapping"),
    "a number": ("7", "1:1: error: a plan file must be a mapping"),
    "nothing": ("null", "1:1: error: the file has no actions"),
    "deep nesting": ("[" * 100_000, "error: this JSON is nested too deeply"),
    "a long number": ("1" * 5000, "error: this JSON is nested too deeply or too large"),
    "no plan": ('{"status": "no_plan"}', "its status is no_plan"),
    "undecided": ('{"status": "undecided", "actions": []}', "its status is undecided"),
    "actions that are none": (json.dumps(document(actions=7)), "actions must be a list"),
    "an action that is none": (json.dumps(document(actions=[7])), "an action must be a mapping"),
    "no step": (
        json.dumps(document(actions=[{"name": "go_to", "args": []}])),
        "this action has no step",
    ),
    "no name": (json.dumps(document(actions=[{"step": 0, "args": []}])), "has no name"),
    "no args": (json.dumps(document(actions=[{"step": 0, "name": "go_to"}])), "has no args"),
    "a step before the first": (
        json.dumps(document(actions=[{"step": -1, "text": "go_to(agent,n2)"}])),
        "step must be a whole number",
    ),
    "a step that is no number": (
        json.dumps(document(actions=[{"step": "one", "text": "go_to(agent,n2)"}])),
        "step must be a whole number",
    ),
    "a text that is no action": (
        json.dumps(document(actions=[{"step": 0, "text": "go on"}])),
        "go on is no action",
    ),
    "a horizon without end": (json.dumps(document(horizon=10**12)), "horizon must be"),
    "no state": (json.dumps({"actions": [], "goals": [], "layout": "report"}), "initial_state"),
    "a state with an unknown table": (
        json.dumps(document(initial_state={"paid": ["table9"]})),
        "unknown table table9",
    ),
    "an unknown layout": (
        json.dumps(document(layout="nowhere")),
        "the plan is for the layout nowhere, which is not built in",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_a_broken_file_is_an_input_error_with_its_place(case: str, validate: Front) -> None:
    content, message = BROKEN[case]
    code, out, err = validate(content)
    assert code == 2 and out == ""
    assert message in err and "Traceback" not in err
    code, out, _ = validate(content, "--json")
    found = json.loads(out)
    assert code == 2 and found["status"] == "error" and found["errors"]


def test_a_file_that_is_not_there_or_no_text(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["validate", str(tmp_path / "none.json")]) == 2
    assert "no such file" in capsys.readouterr().err
    assert run(["validate", str(tmp_path)]) == 2
    assert "is a directory" in capsys.readouterr().err
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\x00")
    assert run(["validate", str(tmp_path / "bytes.json")]) == 2
    assert "bytes.json:1:1: error: the file is in UTF-16" in capsys.readouterr().err
    (tmp_path / "bytes.json").write_bytes(b'{"plan":\n "caf\xe9"}')
    assert run(["validate", str(tmp_path / "bytes.json")]) == 2
    assert "bytes.json:2:6: error: no UTF-8 text" in capsys.readouterr().err


def test_a_plan_from_standard_input(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    stdin = io.TextIOWrapper(io.BytesIO(json.dumps(document()).encode()))
    monkeypatch.setattr(sys, "stdin", stdin)
    assert run(["validate", "-"]) == 0
    assert capsys.readouterr().out.startswith("valid: 7 steps")
    assert run(["validate", "-", "--scenario", "-"]) == 2


@pytest.mark.parametrize(("scene", "steps"), [("b1", 7), ("b2", 4), ("b3", 1), ("b4", 1)])
def test_what_plan_prints_is_valid(
    scene: str, steps: int, validate: Front, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["plan", "--scenario", scene, "--json"]) == 0
    printed = capsys.readouterr().out
    code, out, _ = validate(printed, "--json")
    found = json.loads(out)
    assert code == 0 and found["steps"] == found["makespan"] == steps
    assert found["final_state"] == json.loads(printed)["final_state"]


def test_a_plan_of_a_domain_of_ones_own_is_played_by_it(tmp_path: Path) -> None:
    """What follows from an observation is part of the plan's initial state."""
    from tests.support.own_domains import dirty_domain

    (tmp_path / "own.sparc").write_text(
        dirty_domain("holds(isdirty(T), I) :- obs(has_left(T), true, I).").template.text
    )
    scenario = tmp_path / "s.yaml"
    scenario.write_text(
        "{layout: report, state: {seated: {table1: [c1]}}, observe: [{leave: c1}], "
        "goals: [{holds: isdirty(table1)}, {at: n2}]}"
    )
    options = ("--scenario", str(scenario), "--domain", str(tmp_path / "own.sparc"), "--json")
    made = waiter("plan", *options)
    found = json.loads(made.out)
    assert (found["status"], found["validated"]) == ("plan", "domain")
    assert found["initial_state"]["fluents"] == ["isdirty(table1)"]
    assert found["final_state"]["fluents"] == ["isdirty(table1)"]
    (tmp_path / "plan.json").write_text(made.out)
    ran = waiter("validate", str(tmp_path / "plan.json"), "--json")
    assert (ran.code, json.loads(ran.out)["validated"]) == (0, "domain")
    assert "by its domain" in waiter("validate", str(tmp_path / "plan.json")).out
    found["actions"][0]["args"][1] = "n5"
    (tmp_path / "plan.json").write_text(json.dumps(found))
    ran = waiter("validate", str(tmp_path / "plan.json"))
    assert ran.code == 3 and "edge(n1,n5) does not hold" in " ".join(ran.out.split())


def test_a_shipped_plan_can_be_played_by_its_domain(tmp_path: Path) -> None:
    made = waiter("plan", "--scenario", "b1", "--json")
    (tmp_path / "plan.json").write_text(made.out)
    ran = waiter("validate", str(tmp_path / "plan.json"), "--domain", "restaurant", "--json")
    assert (ran.code, json.loads(ran.out)["validated"]) == (0, "domain")
    assert "validated" not in json.loads(
        waiter("validate", str(tmp_path / "plan.json"), "--json").out
    )
