"""Certificates: what is made is believed, what was tampered with is not, in exact fractions."""

from __future__ import annotations

import copy
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.exhaustive import TooLarge, shortest
from tests.support.paths import ROOT
from tests.support.small_worlds import small_problem
from waiter_cli.bounds import find_bounds
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario, read_scenario_file
from waiter_cli.flow_bounds.certificate import make_certificate
from waiter_cli.flow_bounds.certificate_checker import check_certificate
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem

pytest.importorskip("highspy")


def evening() -> Problem:
    layout_text, scenario = generate_instance(4, "M", bar=True)
    layout = read_layout(layout_text, "layout.yaml")
    return pose_problem(layout, read_scenario(scenario, "evening.yaml", layout))


@pytest.fixture(scope="module")
def problem() -> Problem:
    return evening()


@pytest.fixture(scope="module")
def document(problem: Problem) -> dict[str, Any]:
    plan = find_bounds(problem, effort=10).plan
    assert plan is not None
    made = make_certificate(problem, plan)
    assert made is not None
    return json.loads(json.dumps(made))  # type: ignore[no-any-return]


def test_a_certificate_proves_what_it_says(problem: Problem, document: dict[str, Any]) -> None:
    assert check_certificate(problem, document) == document["bound"] == 55


def test_small_worlds_are_certified_and_never_beyond_the_truth() -> None:
    exact = 0
    for seed in range(60):
        world = small_problem(seed)
        bounds = find_bounds(world)
        if bounds.plan is None or bounds.impossible or not bounds.plan.horizon:
            continue
        try:
            length = shortest(world, 60_000).length
        except TooLarge:
            continue
        made = make_certificate(world, bounds.plan)
        if made is not None:
            proved = check_certificate(world, made)
            assert length is not None and made["bound"] <= proved <= length, seed
            exact += proved == length
    assert exact >= 20


def test_a_price_too_high_proves_less_not_more(problem: Problem, document: dict[str, Any]) -> None:
    """Prices are only a suggestion: whatever they are, what comes out is true."""
    for index in range(0, len(document["cuts"]), 3):
        forged = copy.deepcopy(document)
        forged["cuts"][index]["price"] *= 50
        assert check_certificate(problem, forged) <= 55


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: d.update(certificate="x"), "no certificate"),
        (lambda d: d.update(most=-1), "most is"),
        (lambda d: d.update(unit=0), "unit"),
        (lambda d: d.update(unit="1"), "unit is a whole number"),
        (lambda d: d.update(rows=7), "rows is a list"),
        (lambda d: d["graph"].update(nodes=3), "the graph of this problem"),
        (lambda d: d["rows"].append([-1, 5]), "number of a row"),
        (lambda d: d["rows"].append([0, 0.5]), "number of a row"),
        (lambda d: d["cuts"].append(3), "mapping"),
        (lambda d: d["cuts"].append({"price": 1, "visit": 99, "inside": []}), "no visit 99"),
        (lambda d: d["cuts"].append({"price": 1, "deed": 999, "inside": []}), "no deed 999"),
        (lambda d: d["cuts"].append({"price": 1, "visit": 0, "inside": []}), "nodes of the visit"),
        (lambda d: d["cuts"].append({"price": -1, "deed": 0, "inside": [1]}), "sign"),
        (lambda d: d["cuts"].append({"price": 1, "deed": 0, "inside": [-4]}), "numbers of nodes"),
    ],
)
def test_what_is_no_certificate_is_refused(
    problem: Problem, document: dict[str, Any], change: Any, said: str
) -> None:
    forged = copy.deepcopy(document)
    change(forged)
    with pytest.raises(ValueError, match=said):
        check_certificate(problem, forged)


def test_a_set_with_the_start_or_the_end_in_it_is_refused(
    problem: Problem, document: dict[str, Any]
) -> None:
    everything = list(range(document["graph"]["nodes"]))
    for inside, said in ((everything, "the end"), (everything[:-1], "the start")):
        forged = copy.deepcopy(document)
        forged["cuts"].append({"price": 1, "deed": 0, "inside": inside})
        with pytest.raises(ValueError, match=said):
            check_certificate(problem, forged)


def test_a_certificate_of_another_evening_is_refused(document: dict[str, Any]) -> None:
    layout, scenario = read_scenario_file("lunch")
    with pytest.raises(ValueError, match="graph"):
        check_certificate(pose_problem(layout, scenario), document)


def test_plan_writes_one(tmp_path: Path) -> None:
    path = tmp_path / "b1.json"
    done = waiter("plan", "--scenario", "b1", "--certificate", str(path))
    assert done.code == 0 and "fewer than 7 steps" in done.err
    layout, scenario = read_scenario_file("b1", read_layout_file("report"))
    assert check_certificate(pose_problem(layout, scenario), json.loads(path.read_text())) == 7


def test_checking_takes_no_solver() -> None:
    code = (
        "import sys, waiter_cli.flow_bounds.certificate_checker\n"
        "print(*{'highspy', 'numpy', 'clingo'} & sys.modules.keys())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == ""
