"""What came first is said: each limit by its name, in words and in JSON, by every command.

"Timed out", "out of memory", "not found within the bound" and "proved impossible" are four results,
and none is ever taken for another.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from sparc.solving.clingo_solver import Grounding
from sparc.solving.clingo_threads import Abandoned
from tests.support.cli import waiter
from tests.support.sampling import mostly_wide
from waiter_cli.encoding.domains import find_domain
from waiter_cli.planning import planner as planning
from waiter_cli.planning import strategies as search
from waiter_cli.planning.search_results import SearchResult, SearchStatus

B1 = ("--scenario", "b1")
SECOND = ("--time-limit", "1")
FOIL = ("--why-not", "go_to(agent,n0)")


@pytest.fixture
def no_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is grounded is left behind at its time limit."""

    def ground(*_: object) -> None:
        raise Abandoned

    monkeypatch.setattr(Grounding, "ground", ground)


def limit_of(document: dict[str, Any]) -> str:
    """The limit that a document names, wherever its command has it."""
    if "scenarios" in document:  # compare: one for each scenario and layout
        (limit,) = {each["limit"] for row in document["scenarios"] for each in row["results"]}
        return str(limit)
    return str(document["limit"])


def told_apart(arguments: tuple[str, ...], limit: str, word: str) -> None:
    as_json = waiter(*arguments, "--json")
    assert (as_json.code, limit_of(as_json.json())) == (4, limit)
    told = waiter(*arguments)
    said = (told.out + told.err).lower()
    assert told.code == 4 and word in said
    assert "no plan of any length" not in said and "no plan at all" not in said


@pytest.mark.parametrize(
    "arguments",
    [
        ("plan", *B1, *SECOND),
        ("answersets", *B1, *SECOND),
        ("explain", *B1, *SECOND),
        ("explain", *B1, *FOIL, *SECOND),
        ("compare", "report", "report", *B1, *SECOND),
    ],
    ids=" ".join,
)
def test_time_that_is_up_is_told(arguments: tuple[str, ...], no_time: None) -> None:
    told_apart(arguments, "time", "time")


@pytest.mark.parametrize(
    "arguments",
    [
        ("plan", *B1, "--max-steps", "3"),
        ("answersets", *B1, "--max-steps", "3"),
        ("explain", *B1, "--max-steps", "3"),
        ("explain", *B1, *FOIL, "--max-steps", "3"),
        ("explain", *B1, *FOIL, "--max-steps", "8"),
        ("simulate", *B1, "--max-steps", "3"),
    ],
    ids=" ".join,
)
def test_steps_that_are_too_few_are_told(arguments: tuple[str, ...]) -> None:
    told_apart(arguments, "max_steps", f"--max-steps {arguments[-1]}")


def test_the_bound_of_ones_own_domain_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search, "OWN_DOMAIN_MAX_STEPS", 4)
    own = tmp_path / "own.sparc"
    own.write_text(find_domain("restaurant").template.text)
    told = waiter("plan", *B1, "--domain", own)
    assert (told.code, told.out) == (
        4,
        "Undecided: no plan found within --max-steps 4, and no proof that none exists; "
        "if there is a plan, it has at least 5 steps.\n",
    )


def test_a_foil_that_costs_the_last_step_is_settled() -> None:
    assert waiter("explain", *B1, *FOIL, "--max-steps", "9", "--json").json()["price"] == 2


def test_memory_that_runs_out_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def out_of_memory(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(Grounding, "ground", out_of_memory)
    for command in ("plan", "explain", "answersets"):
        ran = waiter(command, *B1, "--json")
        assert (ran.code, ran.json()["limit"]) == (4, "memory")
        told = waiter(command, *B1)
        assert told.code == 4 and "memory" in told.out + told.err


def test_a_plan_that_was_found_before_the_limit_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    found = planning.find_minimal_plan
    limit: dict[str, Any] = {"limit": "time"}

    def cut_short(*arguments: Any, **named: Any) -> SearchResult:
        return replace(
            found(*arguments, **named),
            status=SearchStatus.UNDECIDED,
            minimal=False,
            proof=None,
            bounds=(5, 7),
            **limit,
        )

    monkeypatch.setattr(planning, "find_minimal_plan", cut_short)
    ran = waiter("plan", *B1, "--json")
    document = ran.json()
    assert (ran.code, document["status"], document["limit"]) == (4, "undecided", "time")
    assert (document["minimal"], document["bounds"]) == (False, [5, 7])
    assert len(document["actions"]) == 7 and document["validated"]
    told = waiter("plan", *B1)
    assert told.code == 4
    assert "Not proved minimal: the limit (time) came first; 5 to 7 steps" in told.out
    limit.update(limit="max_steps", max_steps=8)
    assert "the limit (--max-steps 8) came first; 5 to 7 steps" in waiter("plan", *B1).out


def test_a_query_without_an_answer_in_time(tmp_path: Path) -> None:
    program = tmp_path / "pigeons.sparc"
    program.write_text(
        "sorts\n#p = 1..12.\n#h = 1..11.\npredicates\nin(#p, #h).\nsome(#p).\nrules\n"
        "in(P,H) | -in(P,H) :- #p(P), #h(H).\nsome(P) :- in(P,H).\n"
        ":- #p(P), not some(P).\n:- in(P,H), in(Q,H), P != Q.\n"
    )
    query = ("sparc", "query", str(program), "-q", "some(1)", "--time-limit", "0.2")
    ran = waiter(*query, "--json")
    expected = {"query": "some(1)", "answer": "undecided", "limit": "time", "bindings": []}
    assert (ran.code, ran.json()) == (4, expected)
    told = waiter(*query)
    assert (told.code, told.out) == (4, "") and "time limit" in told.err


def test_what_is_proved_needs_no_time_and_no_bound(no_time: None) -> None:
    """Impossible is impossible, whatever the limits."""
    for limit in (SECOND, ("--max-steps", "0")):
        ran = waiter("plan", "--scenario", "blocked_aisle", "--json", *limit)
        assert (ran.code, ran.json()["status"], "limit" in ran.json()) == (3, "no_plan", False)


@pytest.mark.parametrize("searches", range(4))
def test_explanations_cut_short_claim_nothing(
    searches: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However many searches there was time for: all causes, or none."""
    explain = ("explain", "--scenario", "blocked_aisle", "--json")
    full = waiter(*explain).json()
    ground, left = Grounding.ground, iter(range(searches))

    def while_there_is_time(self: Grounding, deadline: float | None = None) -> None:
        if next(left, None) is None:
            raise Abandoned
        ground(self, deadline)

    monkeypatch.setattr(Grounding, "ground", while_there_is_time)
    cut = waiter(*explain, *SECOND)
    assert (cut.code, cut.json()["reasons"]) == (0, full["reasons"])
    assert len(full["causes"]) == 2 and cut.json()["causes"] in ([], full["causes"])
    assert all(change in full["changes"] for change in cut.json()["changes"])


def test_a_run_that_reached_its_goals_did_not_give_up(no_time: None) -> None:
    """A plan made up in no time serves as well as one that is proved minimal."""
    ran = waiter("simulate", *B1, *SECOND, "--json")
    assert (ran.code, ran.json()["status"], "limit" in ran.json()) == (0, "done", False)


# -- the options that the commands share ------------------------------------------------------

PLANNING = ("plan", "explain", "answersets", "simulate", "serve")


@pytest.mark.parametrize("command", mostly_wide(PLANNING, "plan", "serve"))
def test_the_search_can_be_chosen_and_watched(command: str) -> None:
    start = ("--layout", "report", "--enter", "1")
    lines = ""
    if command == "serve":
        start = ("--layout", "report", "--time-limit", "60")
        lines = '{"observe": {"enter": ["c1"]}}\n'
    ran = waiter(command, *start, "--search", "linear", "--max-steps", "7", "-v", stdin=lines)
    assert ran.code == 0, ran.err
    for horizon in range(7):
        assert f"horizon {horizon}: unsat" in ran.err
    assert "horizon 7: sat" in ran.err
    assert "ground" not in ran.out
    quiet = waiter(command, *start, "--search", "linear", "--max-steps", "7", stdin=lines)
    assert quiet.code == 0 and "horizon" not in quiet.err


def test_the_loop_plans_no_further_than_told() -> None:
    lines = '{"observe": {"enter": ["c1"]}}\n'
    ran = waiter("serve", "--layout", "report", "--max-steps", "6", stdin=lines)
    assert '"status": "undecided", "limit": "max_steps"' in ran.out.splitlines()[1]
