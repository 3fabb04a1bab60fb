"""Problems from names of files and values of options, and the domain a plan was made with."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from waiter_cli.errors import InputError
from waiter_cli.files.plan_reader import read_plan
from waiter_cli.model.state import Goal
from waiter_cli.problems.from_options import domain_of, read_problem, what_changed


def test_a_layout_and_what_is_seen() -> None:
    problem, warnings = read_problem("report", None, enter=[2], bills=["table1"])
    assert problem.layout.name == "report"
    assert [len(party) for party in problem.state.waiting] == [2]
    assert problem.state.wants_bill == {"table1"}
    assert all(warning.message for warning in warnings)


def test_a_scenario_names_its_layout_and_options_add_to_it() -> None:
    problem, _ = read_problem(None, "b1", goals=["at: n1"])
    assert problem.layout.name == "report"
    assert Goal("at", node="n1") in problem.goals


@pytest.mark.parametrize(
    ("layout", "scenario", "message"),
    [
        (None, None, "which restaurant?"),
        ("-", "-", "layout and scenario cannot both come from standard input"),
    ],
)
def test_what_is_no_restaurant(layout: str | None, scenario: str | None, message: str) -> None:
    with pytest.raises(InputError) as told:
        read_problem(layout, scenario)
    assert told.value.faults[0].message == message and told.value.faults[0].hint


def test_several_robots_are_taken_where_they_are_asked_for(tmp_path: Path) -> None:
    text = (ROOT / "layouts" / "report.yaml").read_text()
    line = next(line for line in text.splitlines() if line.startswith("agent:"))
    file = tmp_path / "two.yaml"
    file.write_text(text.replace(line, "agents: {r1: n1, r2: n2}"))
    assert len(read_problem(str(file), None, several=True)[0].layout.agents) == 2
    with pytest.raises(InputError):
        read_problem(str(file), None)


def test_the_domain_of_a_plan_is_found_again_unless_it_has_changed(tmp_path: Path) -> None:
    domain = Path(shutil.copytree(ROOT / "domains" / "report", tmp_path / "mine")) / "domain.sparc"
    made = waiter("plan", "--layout", "report", "--enter", "1", "--domain", str(domain), "--json")
    plan = read_plan(made.out, "plan.json")
    assert domain_of(plan).template.text == domain.read_text()
    problem, _ = read_problem("report", None)
    assert what_changed(plan, problem.layout) == ()
    domain.write_text(domain.read_text() + "% mine\n")
    (note,) = what_changed(plan, problem.layout)
    assert note.endswith("mine/domain.sparc has changed since the plan was made")
    with pytest.raises(InputError):
        domain_of(plan)


def test_a_built_in_domain_is_known_by_its_name() -> None:
    made = waiter("plan", "--layout", "report", "--enter", "1", "--domain", "report", "--json")
    assert domain_of(read_plan(made.out, "plan.json")).name == "report"
    assert json.loads(made.out)["domain"] == "report"
