"""`waiter sparc check|translate|query|fetch-jar` at the command line."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.jar import JAR_MARKS, needs_jar
from tests.support.terminal import Terminal
from waiter_cli.commands.sparc import fetch_jar as sparc_fetching
from waiter_cli.translators import jar_store

FAMILY = """sorts
#person = {ann, bob, eve}.
#year = 1..3.
predicates
parent(#person, #person).
old(#person).
born(#person, #year).
rules
parent(ann, bob).   % ann is first
parent(bob,
       eve).
old(X) | -old(X) :- parent(X, eve).
-old(eve).
born(X, Y+1) :- parent(Z, X), born(Z, Y).
born(ann, 1).
"""


@pytest.fixture
def family(tmp_path: Path) -> str:
    path = tmp_path / "family.sparc"
    path.write_text(FAMILY)
    return str(path)


both = pytest.mark.parametrize("translator", ["native", pytest.param("jar", marks=JAR_MARKS)])


# ------------------------------------------------------------------ check


def test_check_counts_what_it_read(family: str) -> None:
    ran = waiter("sparc", "check", family)
    assert (ran.code, ran.err) == (0, "")
    assert ran.out == f"{family}: no fault in 2 sorts, 3 predicates, 6 rules.\n"


def test_check_reports_every_fault_in_place(tmp_path: Path) -> None:
    path = tmp_path / "bad.sparc"
    path.write_text(FAMILY + "old(zoe).\nyoung(ann).\n")
    ran = waiter("sparc", "check", str(path))
    assert (ran.code, ran.out) == (2, "")
    assert f"{path}:16:" in ran.err and f"{path}:17:1" in ran.err
    document = waiter("sparc", "check", str(path), "--json").json()
    assert document["status"] == "error"
    assert [error["line"] for error in document["errors"]] == [16, 17]


def test_warnings_are_no_faults(tmp_path: Path) -> None:
    path = tmp_path / "odd.sparc"
    path.write_text(FAMILY + "old(X) :- born(X, Y), Y > 3.\n")
    assert waiter("sparc", "check", str(path)).err == ""
    ran = waiter("sparc", "check", str(path), "--warnings")
    assert ran.code == 0
    assert f"{path}:16:1: warning:" in ran.err
    document = waiter("sparc", "check", str(path), "--warnings", "--json").json()
    assert (document["status"], document["warnings"][0]["line"]) == ("ok", 16)


@needs_jar
def test_check_with_the_jar(tmp_path: Path, family: str) -> None:
    assert waiter("sparc", "check", family, "--translator", "jar").code == 0
    path = tmp_path / "bad.sparc"
    path.write_text(FAMILY + "old(zoe).\n")
    ran = waiter("sparc", "check", str(path), "--translator", "jar")
    assert ran.code == 2
    assert f"{path}:16:1: error:" in ran.err


# ------------------------------------------------------------------ translate


@both
def test_above_each_rule_stands_its_sparc(family: str, translator: str) -> None:
    lines = waiter("sparc", "translate", family, "--translator", translator).out.splitlines()
    at = lines.index(f"% {family}:10")
    assert lines[at : at + 3] == [f"% {family}:10", "%   parent(bob,", "%          eve)."]
    assert lines[at + 3] == "parent(bob,eve)."
    assert "%   old(X) | -old(X) :- parent(X, eve)." in lines
    assert "#show old/1." in lines


def test_a_file_is_written_whole_or_not_at_all(family: str, tmp_path: Path) -> None:
    target = tmp_path / "out" / "family.lp"
    ran = waiter("sparc", "translate", family, "-o", str(target))
    assert ran.code == 2
    assert str(target) in ran.err
    target.parent.mkdir()
    assert waiter("sparc", "translate", family, "-o", str(target)).out == ""
    first = target.read_text()
    assert first == waiter("sparc", "translate", family).out
    bad = tmp_path / "bad.sparc"
    bad.write_text("sorts\n")
    assert waiter("sparc", "translate", str(bad), "-o", str(target)).code == 2
    assert target.read_text() == first
    assert os.listdir(target.parent) == ["family.lp"]


def test_the_mode_of_a_file_is_kept(family: str, tmp_path: Path) -> None:
    target = tmp_path / "family.lp"
    target.write_text("old")
    target.chmod(0o640)
    waiter("sparc", "translate", family, "-o", str(target))
    assert target.stat().st_mode & 0o777 == 0o640


# ------------------------------------------------------------------ query


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


# ------------------------------------------------------------------ fetch-jar


@pytest.fixture
def published(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The address of a file that stands for the jar; its hash is that of version 2.57."""
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "data"))
    body = b"the jar" * 1000
    (tmp_path / "published.jar").write_bytes(body)
    release = jar_store.JarRelease("2.57", hashlib.sha256(body).hexdigest(), len(body), "0" * 40)
    monkeypatch.setattr(jar_store, "RELEASES", {"2.57": release})
    return (tmp_path / "published.jar").as_uri()


def test_fetch_installs_for_this_user(published: str) -> None:
    ran = waiter("sparc", "fetch-jar", "--yes", "--url", published)
    assert (ran.code, ran.err) == (0, "")
    assert str(jar_store.store_path()) in ran.out
    assert jar_store.find_jar().sha256() == jar_store.RELEASES["2.57"].sha256
    again = waiter("sparc", "fetch-jar", "--url", "http://127.0.0.1:9/never-asked")
    assert (again.code, "installed already" in again.out) == (0, True)


def test_progress_is_for_terminals_that_can_take_it_away_again(published: str) -> None:
    """Here the file is not the jar; whatever came before, the last lines say so."""
    arguments = ("sparc", "fetch-jar", "--yes", "--url", published)
    assert "bytes" not in waiter("sparc", "fetch-jar", "--yes", "--url", published + "x").err
    for term, bar in (("dumb", False), ("xterm", True)):
        with Terminal(*arguments, TERM=term) as terminal:
            assert terminal.end() == 5
            assert ("7.0/7.0 kB" in terminal.seen) == bar, term
            assert "0/?" not in terminal.seen
            assert terminal.seen.count("is not sparc.jar V2.57") == 1


def test_fetch_asks_first(published: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ran = waiter("sparc", "fetch-jar", "--url", published)
    assert (ran.code, ran.out) == (2, "")
    assert "--yes" in ran.err

    class Terminal:
        isatty = staticmethod(lambda: True)

    asked = Terminal()
    monkeypatch.setattr(sparc_fetching.sys, "stdin", asked)
    for answer, installed in (("\n", False), ("n\n", False), ("Y\n", True)):
        asked.readline = lambda answer=answer: answer  # type: ignore[attr-defined]
        assert sparc_fetching._agreed("Download?") is installed


def test_declined_is_not_done(published: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sparc_fetching, "_agreed", lambda question: False)
    ran = waiter("sparc", "fetch-jar", "--url", published)
    assert ran.code != 0
    assert "nothing was downloaded" in ran.err
    assert not jar_store.store_path().exists()


def test_what_is_not_the_jar_is_not_installed(published: str, tmp_path: Path) -> None:
    (tmp_path / "published.jar").write_bytes(b"something else")
    ran = waiter("sparc", "fetch-jar", "--yes", "--url", published)
    assert (ran.code, ran.out) == (5, "")
    assert "nothing was installed" in ran.err
    assert not list(jar_store.store_path().parent.iterdir())


def test_versions_that_are_known(published: str) -> None:
    ran = waiter("sparc", "fetch-jar", "--yes", "--version", "3.0", "--url", published)
    assert ran.code == 2
    assert "known are 2.57" in ran.err
