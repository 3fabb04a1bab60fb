"""Plan files judged: on the layout they remember, and with notes on what has changed since."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.files.plan_reader import PlanDocument, read_plan
from waiter_cli.problems.from_options import read_layout_of, what_changed
from waiter_cli.problems.plan_file import judge, problem_of


@pytest.fixture
def own(tmp_path: Path) -> Path:
    """A layout file, and a plan for it beside."""
    layout = tmp_path / "my.yaml"
    layout.write_text((ROOT / "layouts" / "report.yaml").read_text())
    (tmp_path / "plan.json").write_text(
        waiter("plan", "--layout", str(layout), "--enter", "2", "--json").out
    )
    return layout


def document(own: Path, **changes: Any) -> PlanDocument:
    found = json.loads((own.parent / "plan.json").read_text())
    found |= changes
    kept = {key: value for key, value in found.items() if value is not None}
    return read_plan(json.dumps(kept), str(own.parent / "plan.json"))


def test_a_plan_is_judged_on_the_layout_it_remembers(own: Path) -> None:
    plan = document(own)
    problem = problem_of(plan)
    verdict = judge(plan, problem)
    assert problem.layout.name == "report"
    assert verdict.valid and verdict.makespan == plan.plan.horizon and verdict.notes == ()


def test_another_final_state_than_it_says_is_noted(own: Path) -> None:
    plan = document(own, final_state={"agent": "n5"})
    note = "the final_state in the file is not where the actions lead"
    assert judge(plan, problem_of(plan)).notes == (note,)
    assert judge(plan, problem_of(plan), own=False).notes == ()


def test_a_layout_that_has_changed_is_refused_or_noted(own: Path) -> None:
    plan = document(own)
    own.write_text(own.read_text() + "# mine\n")
    with pytest.raises(InputError):
        problem_of(plan)
    now = read_layout_file(str(own))
    (note,) = what_changed(plan, now)
    assert note == f"the layout {own} has changed since the plan was made"
    assert judge(plan, problem_of(plan, now)).notes[-1:] == (note,)


def test_a_plan_for_another_layout_is_told_in_one_fault(own: Path) -> None:
    with pytest.raises(InputError) as told:
        problem_of(document(own), read_layout_file("bistro"))
    (fault,) = told.value.faults
    assert fault.message == "the plan is for the layout report, not for bistro"


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (None, "which restaurant is this plan for?"),
        ("nowhere", "the plan is for the layout nowhere, which is not built in"),
    ],
)
def test_a_plan_that_remembers_no_layout_asks_for_one(
    own: Path, name: str | None, message: str
) -> None:
    plan = document(own, layout=name, layout_file=None)
    with pytest.raises(InputError) as told:
        read_layout_of(plan)
    assert told.value.faults[0].message == message
