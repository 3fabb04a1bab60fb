"""The front door for Python: each stage is one call, and the commands go through it."""

from __future__ import annotations

import ast
import doctest
import json
from collections.abc import Callable
from dataclasses import FrozenInstanceError, replace
from pathlib import Path
from typing import Any

import pytest

import waiter_cli
from tests.support.cli import waiter
from waiter_cli import InputError, LayoutError, MissingError, NoPlanError, SearchStatus

SOURCE = ast.parse(Path(waiter_cli.__file__).read_text(encoding="utf-8"))
CALLS = [name for name in waiter_cli.__all__ if name[0].islower()]


@pytest.fixture(scope="module")
def problem() -> waiter_cli.Problem:
    return waiter_cli.pose_problem(waiter_cli.read_layout("report"), enter=[1])


@pytest.fixture(scope="module")
def blocked() -> waiter_cli.Problem:
    return waiter_cli.pose_problem(*waiter_cli.read_scenario("blocked_aisle"))


# ------------------------------------------------------------------ the door itself


def test_the_examples_of_its_docstrings_run() -> None:
    ran = doctest.testmod(waiter_cli)
    assert ran.failed == 0
    assert ran.attempted > 20


def test_every_name_leads_somewhere() -> None:
    assert all(getattr(waiter_cli, name) is not None for name in waiter_cli.__all__)
    assert waiter_cli.__all__ == sorted(waiter_cli.__all__)
    with pytest.raises(AttributeError, match="has no attribute 'pan'"):
        waiter_cli.pan  # noqa: B018


@pytest.mark.parametrize("name", CALLS)
def test_every_call_says_what_it_returns_and_what_it_raises(name: str) -> None:
    text = getattr(waiter_cli, name).__doc__
    assert text.startswith("Returns ")
    assert "aises" in text or "raised" in text


def test_classes_are_loaded_from_where_the_types_say() -> None:
    """What a type checker is told and what `__getattr__` loads are the same."""
    told = {
        alias.name: node.module
        for node in ast.walk(SOURCE)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
        if node.module is not None
    }
    for name in waiter_cli.__all__:
        if name[0].isupper():
            assert getattr(waiter_cli, name).__module__ == told[name], name


# ------------------------------------------------------------------ planning


def _timeless(document: Any) -> Any:
    if isinstance(document, dict):
        return {key: _timeless(value) for key, value in document.items() if key != "seconds"}
    return list(map(_timeless, document)) if isinstance(document, list) else document


def test_the_pipeline_and_the_command_agree() -> None:
    answer = waiter_cli.search_plan("report", enter=[2], goals=["at: n2"], bills=["table1"])
    ran = waiter(
        "plan", "--layout", "report", "--enter", "2", "--goal", "at: n2", "--bill", "table1", "--json",
    )  # fmt: skip
    assert _timeless(json.loads(json.dumps(answer.document()))) == _timeless(ran.json())


def test_values_are_frozen(problem: waiter_cli.Problem) -> None:
    answer = waiter_cli.plan(problem)
    for value, field in ((problem, "goals"), (answer, "result"), (answer.plan, "horizon")):
        with pytest.raises((FrozenInstanceError, AttributeError)):
            setattr(value, field, None)


def test_no_plan_is_an_answer(blocked: waiter_cli.Problem) -> None:
    answer = waiter_cli.plan(blocked)
    assert answer.plan is None and answer.result.status is SearchStatus.NO_PLAN
    found = waiter_cli.explain(blocked)
    assert [helped.horizon for helped in found.helped] == [7, 0]


def test_limits_are_answers_too(problem: waiter_cli.Problem) -> None:
    answer = waiter_cli.plan(problem, max_steps=3)
    assert (answer.result.status, answer.result.limit) == (SearchStatus.UNDECIDED, "max_steps")
    answer = waiter_cli.plan(problem, time_limit=0)
    assert (answer.result.status, answer.result.limit) == (SearchStatus.UNDECIDED, "time")


def test_stages_are_told(problem: waiter_cli.Problem) -> None:
    stages: list[Any] = []
    answer = waiter_cli.plan(problem, listener=stages.append)
    assert tuple(stages) == answer.result.stages != ()


def test_other_rules_may_be_given(problem: waiter_cli.Problem) -> None:
    by_name = waiter_cli.plan(problem, domain="report")
    rules = waiter_cli.find_domain("report")
    assert waiter_cli.plan(problem, domain=rules).plan == by_name.plan
    assert by_name.domain.name == "report"


def test_no_file_of_its_name_stands_for_the_rules_unasked(
    problem: waiter_cli.Problem, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "restaurant").write_text("no program")
    monkeypatch.chdir(tmp_path)
    assert waiter_cli.plan(problem).plan is not None
    with pytest.raises(InputError):
        waiter_cli.plan(problem, domain="restaurant")


def test_a_price_is_that_of_the_command() -> None:
    problem = waiter_cli.pose_problem(*waiter_cli.read_scenario("b1"))
    foil = waiter_cli.why_not(problem, "go_to(agent,n0)")
    ran = waiter("explain", "--scenario", "b1", "--why-not", "go_to(agent,n0)", "--json")
    assert foil.document() == ran.json()


# ------------------------------------------------------------------ answer sets


def test_answer_sets_come_one_by_one(problem: waiter_cli.Problem) -> None:
    longer = waiter_cli.answer_sets(problem, horizon=9, models=2)
    assert len({answer_set.literals for answer_set in longer}) == 2
    assert longer.satisfiable and not longer.complete
    assert not list(waiter_cli.answer_sets(problem, horizon=3))


def test_answer_sets_need_a_plan(problem: waiter_cli.Problem, blocked: waiter_cli.Problem) -> None:
    with pytest.raises(NoPlanError) as none:
        waiter_cli.answer_sets(blocked)
    assert none.value.result.status is SearchStatus.NO_PLAN
    with pytest.raises(NoPlanError) as cut:
        waiter_cli.answer_sets(problem, max_steps=3)
    assert cut.value.result.limit == "max_steps"


# ------------------------------------------------------------------ plans


def test_a_plan_is_held_to_its_problem(problem: waiter_cli.Problem, tmp_path: Path) -> None:
    answer = waiter_cli.plan(problem)
    assert answer.plan is not None
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(answer.document()))
    held = [
        waiter_cli.validate(answer),
        waiter_cli.validate(answer.plan, problem),
        waiter_cli.validate(str(file)),
        waiter_cli.validate(waiter_cli.read_plan(str(file))),
        waiter_cli.validate(str(file), problem),
    ]
    assert [(verdict.valid, verdict.makespan) for verdict in held] == [(True, 7)] * 5
    short = replace(answer.plan, actions=answer.plan.actions[:-1])
    verdict = waiter_cli.validate(short, problem)
    assert not verdict.valid and verdict.reasons


def test_a_file_that_contradicts_itself_is_noted(
    problem: waiter_cli.Problem, tmp_path: Path
) -> None:
    file = tmp_path / "plan.json"
    document = waiter_cli.plan(problem).document()
    document["final_state"] = document["initial_state"]
    file.write_text(json.dumps(document))
    note = "the final_state in the file is not where the actions lead"
    assert note in waiter_cli.validate(str(file)).notes


def test_a_plan_is_played(problem: waiter_cli.Problem, tmp_path: Path) -> None:
    told: list[str] = []
    out = tmp_path / "run.html"
    plan = waiter_cli.plan(problem).plan
    outcome = waiter_cli.simulate(
        problem, plan, backend="geometric", record=str(out), listener=told.append
    )
    assert (outcome.status, outcome.steps, outcome.events) == ("done", 7, len(told))
    assert "<html" in out.read_text(encoding="utf-8")
    again: list[str] = []
    waiter_cli.simulate(problem, plan, backend="geometric", listener=again.append)
    assert again == told


def test_what_happens_by_chance_has_a_seed(problem: waiter_cli.Problem) -> None:
    runs = [
        waiter_cli.simulate(problem, backend="geometric", inject=["slip:0.5"], seed=seed)
        for seed in (1, 1, 2, 3)
    ]
    assert runs[0] == runs[1]
    assert len({run.failed_actions for run in runs}) > 1


# ------------------------------------------------------------------ what is wrong

WRONG: list[tuple[str, Callable[[waiter_cli.Problem], object], str]] = [
    ("layout", lambda p: waiter_cli.read_layout("nope"), "nope"),
    ("scenario", lambda p: waiter_cli.read_scenario("nope"), "nope"),
    ("goal", lambda p: waiter_cli.pose_problem(p.layout, goals=["at: n99"]), "n99"),
    ("nothing", lambda p: waiter_cli.search_plan(), "which restaurant?"),
    ("domain", lambda p: waiter_cli.plan(p, domain="nope"), "nope"),
    ("translator", lambda p: waiter_cli.plan(p, translator="java"), "give native or jar"),
    ("strategy", lambda p: waiter_cli.plan(p, strategy="fast"), "give binary, linear, gallop or"),
    ("time", lambda p: waiter_cli.explain(p, time_limit=-1), "time_limit is -1"),
    ("no time", lambda p: waiter_cli.explain(p, time_limit=float("nan")), "time_limit is nan"),
    ("steps", lambda p: waiter_cli.why_not(p, "go_to(n2)", max_steps=-1), "max_steps is -1"),
    ("action", lambda p: waiter_cli.why_not(p, "fly(n2)"), "fly"),
    ("horizon", lambda p: waiter_cli.answer_sets(p, horizon=-1), "horizon is -1"),
    ("models", lambda p: waiter_cli.answer_sets(p, models=-1), "models is -1"),
    ("plan file", lambda p: waiter_cli.validate("nope.json"), "nope.json"),
    ("bare plan", lambda p: waiter_cli.validate(waiter_cli.Plan((), 0)), "give its problem"),
    ("no plan", lambda p: waiter_cli.validate(waiter_cli.plan(p, max_steps=1)), "no plan to"),
    ("speed", lambda p: waiter_cli.simulate(p, speed=0), "speed is 0"),
    ("seed", lambda p: waiter_cli.simulate(p, seed=-1), "seed is -1"),
    ("backend", lambda p: waiter_cli.simulate(p, backend="unity"), "auto, pybullet or geometric"),
    ("drive", lambda p: waiter_cli.simulate(p, drive="legs"), "kinematic or physics"),
    ("failure", lambda p: waiter_cli.simulate(p, on_failure="cry"), "stop, wait or replan"),
    ("record", lambda p: waiter_cli.simulate(p, record="film.wav"), "film.wav"),
    ("injection", lambda p: waiter_cli.simulate(p, inject=["fire@3"]), "fire"),
]  # fmt: skip


@pytest.mark.parametrize(("call", "words"), [w[1:] for w in WRONG], ids=[w[0] for w in WRONG])
def test_wrong_input_is_told(
    problem: waiter_cli.Problem, call: Callable[[waiter_cli.Problem], object], words: str
) -> None:
    with pytest.raises(InputError) as told:
        call(problem)
    assert words in str(told.value)


def test_faults_have_their_places(tmp_path: Path) -> None:
    file = tmp_path / "cafe.yaml"
    file.write_text("nodes: {a: [0, 0], b: [2, 0]}\nedges: [[a, bb]]\nentrance: a\nagent: a\n")
    with pytest.raises(LayoutError) as told:
        waiter_cli.read_layout(str(file))
    assert [fault.where.line for fault in told.value.faults if fault.where] == [1, 2]


def test_contradictions_are_answers_and_cannot_be_played(tmp_path: Path) -> None:
    file = tmp_path / "two.yaml"
    file.write_text("layout: report\nobserve: [{at: {agent: n4}}, {at: {w1: n4}}]\n")
    impossible = waiter_cli.pose_problem(*waiter_cli.read_scenario(str(file)))
    assert waiter_cli.plan(impossible).result.status is SearchStatus.CONTRADICTION
    with pytest.raises(InputError):
        waiter_cli.simulate(impossible)
    with pytest.raises(InputError):
        waiter_cli.answer_sets(impossible)


def test_a_missing_jar_is_missing(tmp_path: Path) -> None:
    with pytest.raises((MissingError, InputError)) as told:
        waiter_cli.find_translator("jar", str(tmp_path / "none.jar"))
    assert "none.jar" in str(told.value)


def test_a_layout_reads_as_a_line() -> None:
    told = "report: 8 nodes, 7 paths, 2 tables for 6 guests, 1 robot, other staff: w1"
    assert str(waiter_cli.read_layout("report")) == told
