"""`waiter sparc query` at the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.family import FAMILY, both
from tests.support.terminal import Terminal


@both
@pytest.mark.parametrize(
    ("query", "answer"),
    [
        ("parent(ann,bob)", "yes"),
        ("-old(eve).", "yes"),
        ("old(eve)", "no"),
        ("old(bob)", "unknown"),
        ("parent(eve,ann)", "unknown"),
        ("parent(X,bob)", "X = ann"),
        ("born(X,N)", "X = ann N = 1\nX = bob N = 2\nX = eve N = 3"),
        ("born(bob,1+1)", "yes"),
        ("born(X,1)", "X = ann"),
        ("parent(X,X)", "unknown"),
    ],
)
def test_answers(family: str, translator: str, query: str, answer: str) -> None:
    ran = waiter("sparc", "query", family, "--query", query, "--translator", translator)
    assert (ran.code, ran.out, ran.err) == (0, f"{answer}\n", "")


def test_answers_as_json(family: str) -> None:
    ran = waiter("sparc", "query", family, "--query", "born(X,N)", "--json")
    assert ran.json() == {
        "query": "born(X,N)",
        "answer": "yes",
        "bindings": [{"X": "ann", "N": 1}, {"X": "bob", "N": 2}, {"X": "eve", "N": 3}],
    }
    ran = waiter("sparc", "query", family, "-q", "old(bob)", "-q", "old(eve)", "--json")
    assert [each["answer"] for each in ran.json()["answers"]] == ["unknown", "no"]


@pytest.mark.parametrize(
    "query", ["parent(ann)", "uncle(ann)", "old(zoe)", "not old(ann)", "old(_)", "old(ann", ""]
)
def test_no_query_at_all(family: str, query: str) -> None:
    ran = waiter("sparc", "query", family, "--query", query)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err


def test_an_inconsistent_program_answers_nothing(tmp_path: Path) -> None:
    path = tmp_path / "no.sparc"
    path.write_text(FAMILY + "old(eve).\n")
    ran = waiter("sparc", "query", str(path), "--query", "old(eve)")
    assert (ran.code, ran.out) == (3, "")
    assert "inconsistent" in ran.err


@both
def test_the_prompt_goes_on_after_a_mistake(family: str, translator: str) -> None:
    lines = "old(eve)\nold(zoe)\n\n% note\nparent(X,bob).\nexit.\nold(bob)\n"
    ran = waiter("sparc", "query", family, "--translator", translator, stdin=lines)
    assert (ran.code, ran.out) == (0, "no\nX = ann\n")
    assert ran.err.startswith("query:1:1: error: ") and "    1 | old(zoe)\n" in ran.err


def test_the_prompt_ends_with_its_input(family: str) -> None:
    assert waiter("sparc", "query", family, stdin="old(eve)").out == "no\n"


def test_the_history_lasts_even_when_the_prompt_is_killed(family: str, tmp_path: Path) -> None:
    pytest.importorskip("readline")
    with Terminal("sparc", "query", family, XDG_DATA_HOME=str(tmp_path)) as terminal:
        terminal.expect("?- ")
        terminal.type("old(eve)")
        terminal.expect("no\r\n?- ")
        terminal.process.kill()
    with Terminal("sparc", "query", family, XDG_DATA_HOME=str(tmp_path)) as terminal:
        terminal.expect("?- ")
        terminal.type("\x1b[A")  # the key that goes up
        terminal.expect("no\r\n?- ")
        terminal.type("\x04")
        assert terminal.end() == 0


def test_one_standard_input_for_two() -> None:
    assert waiter("sparc", "query", "-", stdin=FAMILY).code == 2
    assert waiter("sparc", "query", "-", "-q", "old(eve)", stdin=FAMILY).out == "no\n"
