"""The report of a command that a limit ended before it could say so itself."""

from __future__ import annotations

import json

import pytest

from waiter_cli.console.limit_report import UNDECIDED, last_words, undecided


@pytest.mark.parametrize(
    ("line", "keys"),
    [
        ("plan --json", {"status", "limit", "layout", "bounds", "minimal", "actions", "search"}),
        ("answersets p.sparc --json", {"satisfiable", "complete", "answer_sets", "limit"}),
        ("answersets p.sparc --jsonl", {"satisfiable", "complete", "limit"}),
        ("explain --json", {"status", "limit", "reasons", "causes", "changes", "diagnosis"}),
        ("sparc query p.sparc --json", {"status", "answer", "limit", "bindings"}),
        ("sparc explain p.sparc --json", {"status", "complete", "limit", "causes", "mends"}),
        ("sparc why p.sparc --json", {"literal", "holds", "set", "limit"}),
        ("compare a b --json", {"status", "limit"}),
    ],
)
def test_the_document_is_that_of_the_command(line: str, keys: set[str]) -> None:
    out, err = last_words(line.split(), "memory")
    document = json.loads(out)
    assert set(document) == keys and document["limit"] == "memory"
    assert err == "waiter: undecided: the memory ran out\n"


def test_without_json_there_is_a_sentence_alone() -> None:
    assert last_words(["plan"], "time") == ("", "waiter: undecided: the time limit came first\n")
    assert last_words(["serve", "--json"], "time")[0] == ""


def test_it_is_said_on_both_streams(capsys: pytest.CaptureFixture[str]) -> None:
    assert undecided(["plan", "--json"], "time") == UNDECIDED == 4
    said = capsys.readouterr()
    assert json.loads(said.out)["status"] == "undecided" and said.err.startswith("waiter: ")
