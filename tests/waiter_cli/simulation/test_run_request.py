"""What is to be played, as a command line says it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import waiter
from waiter_cli.errors import InputError
from waiter_cli.simulation.run_request import read_run_request


def test_a_scenario_names_its_layout() -> None:
    cue = read_run_request(None, "b1", None)
    assert (cue.problem.layout.name, cue.scenario) == ("report", "b1")
    assert cue.plan is None and cue.predicted is None


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ((None, None, None), "which restaurant"),
        (("-", "-", None), "only one file can come from standard input"),
        ((None, None, "plan.json", ["2"]), "a plan file has its own situation"),
    ],
)
def test_what_cannot_be_played_is_said(given: tuple[object, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_run_request(*given)  # type: ignore[arg-type]


def test_a_plan_whose_steps_go_back_is_refused(tmp_path: Path) -> None:
    plan = waiter("plan", "--scenario", "b3", "--json").json()
    plan["actions"] = [*plan["actions"], *plan["actions"]]
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(plan))
    with pytest.raises(InputError, match="out of order or past the horizon"):
        read_run_request(None, None, str(file))
