"""The shipped domain of dirty tables, through the doors; and its claim to be monotone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import waiter_cli
from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide
from waiter_cli.encoding.domains import find_domain
from waiter_cli.files.scenario_reader import read_scenario

FOLDER = ROOT / "domains" / "housekeeping"
OPTIONS = ("--scenario", str(FOLDER / "scenario.yaml"), "--domain", "housekeeping")


def test_no_python_knows_of_it() -> None:
    assert not list(FOLDER.rglob("*.py"))
    for path in (ROOT / "waiter_cli").rglob("*.py"):
        assert "isdirty" not in path.read_text().replace("isdirty(table1)", "") or "%@" in (
            path.read_text()
        ), path


@pytest.mark.wide
def test_through_plan_validate_explain_answersets_and_its_cases(tmp_path: Path) -> None:
    made = waiter("plan", *OPTIONS, "--json")
    plan = json.loads(made.out)
    assert (plan["horizon"], plan["validated"]) == (6, "domain")
    assert plan["initial_state"]["fluents"] == ["isdirty(table2)"]
    assert "fluents" not in plan["final_state"]
    (tmp_path / "plan.json").write_text(made.out)
    assert waiter("validate", str(tmp_path / "plan.json")).code == 0
    assert "wipe table2" in waiter("plan", *OPTIONS).out
    explained = waiter("explain", *OPTIONS, "--why-not", "clean(agent,table2)")
    assert explained.code == 0
    assert "clean(agent,table2)" in waiter("answersets", *OPTIONS, "--only", "occurs").out
    assert waiter("domain", "test", "--domain", "housekeeping").code == 0


def test_a_dirty_table_takes_no_one(tmp_path: Path) -> None:
    plan = json.loads(waiter("plan", *OPTIONS, "--json").out)
    plan["actions"] = [each for each in plan["actions"] if each["name"] != "clean"]
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    ran = waiter("validate", str(tmp_path / "plan.json"))
    assert ran.code == 3
    assert "A dirty table takes no one" in " ".join(ran.out.split())


GOALS = (
    "[{at: n6}]", "[{holds_not: isdirty(table1)}]", "[{seated: c1}]",
    "[{holds_not: isdirty(table2)}, {seated: c1}, {at: n0}]",
)  # fmt: skip


@pytest.mark.parametrize("goals", mostly_wide(GOALS, GOALS[0], GOALS[1]))
def test_doubling_finds_what_going_up_finds(goals: str) -> None:
    layout = waiter_cli.read_layout("report")
    text = f"{{state: {{waiting: [[c1]], fluents: [isdirty(table1), isdirty(table2)]}}, goals: {goals}}}"
    problem = waiter_cli.pose_problem(layout, read_scenario(text, "s.yaml", layout))
    domain = find_domain("housekeeping")
    found = [waiter_cli.plan(problem, domain=domain, strategy=s) for s in ("binary", "linear")]
    assert [answer.plan.horizon for answer in found if answer.plan] == [found[0].plan.horizon] * 2
    assert len(found[0].result.probes) <= len(found[1].result.probes) + 1
    assert all(answer.result.minimal for answer in found)
