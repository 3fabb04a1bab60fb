"""Listings for people and for programs: the same answer sets, and how the search ended."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import pytest

from sparc.source import Source
from waiter_cli.answersets import writers
from waiter_cli.answersets.enumerate import AnswerListing, prepare
from waiter_cli.answersets.timeline import Filter, read_patterns
from waiter_cli.answersets.writers import JsonWriter, TextWriter, Writer
from waiter_cli.errors import Exit
from waiter_cli.translators.native import NativeTranslator

PROGRAM = """\
sorts
#n = {a, b}.
predicates
p(#n). q(#n).
rules
q(a).
p(a) | p(b).
"""


def listing(text: str = PROGRAM, *patterns: str, limit: int = 0) -> AnswerListing:
    program, timeline = prepare(Source("p.sparc", text), NativeTranslator())
    return AnswerListing(program, timeline, Filter(read_patterns(patterns)), limit=limit)


def written(writer: Writer, found: AnswerListing) -> None:
    writer.timeline = found.timeline
    for answer_set in found:
        writer.write(answer_set)
    writer.finish(found, "it is inconsistent")


def lines(text: str) -> list[Any]:
    return [json.loads(line) for line in text.splitlines()]


def sets(document: dict[str, Any]) -> list[list[str]]:
    return sorted(each["literals"] for each in document["answer_sets"])


def test_people_get_a_heading_for_each(capsys: pytest.CaptureFixture[str]) -> None:
    written(TextWriter(Filter(), True), listing())
    out = capsys.readouterr().out
    assert out.startswith("Answer set 1\n  p(") and "\nAnswer set 2\n" in out
    assert out.endswith("2 answer sets; there are no more.\n")


def test_more_are_announced(capsys: pytest.CaptureFixture[str]) -> None:
    written(TextWriter(Filter(), True), listing(limit=1))
    assert capsys.readouterr().out.endswith("1 answer set; there are more (-n 0 shows all).\n")


def test_programs_get_one_document(capsys: pytest.CaptureFixture[str]) -> None:
    written(JsonWriter(lines=False), listing())
    (document,) = lines(capsys.readouterr().out)
    assert document["satisfiable"] and document["complete"]
    assert sets(document) == [["p(a)", "q(a)"], ["p(b)", "q(a)"]]


def test_or_one_object_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    written(JsonWriter(lines=True), listing())
    *found, last = lines(capsys.readouterr().out)
    assert len(found) == 2 and last == {"satisfiable": True, "complete": True}


def test_a_long_document_is_written_as_it_comes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(writers, "HELD", 1)
    written(JsonWriter(lines=False), listing())
    (document,) = lines(capsys.readouterr().out)
    assert sets(document) == [["p(a)", "q(a)"], ["p(b)", "q(a)"]] and document["complete"]


def test_what_was_begun_is_ended_whole(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(writers, "HELD", 1)
    writer, found = JsonWriter(lines=False), listing()
    writer.timeline = found.timeline
    assert not writer.broken_off()
    writer.write(next(iter(found)))
    assert writer.broken_off()
    (document,) = lines(capsys.readouterr().out)
    assert len(document["answer_sets"]) == 1 and not document["complete"]


def each_writer() -> Iterable[Writer]:
    return TextWriter(Filter(), True), JsonWriter(lines=False)


@pytest.mark.parametrize("writer", each_writer(), ids=["text", "json"])
def test_none_is_proved_and_an_open_end_is_undecided(
    writer: Writer, capsys: pytest.CaptureFixture[str]
) -> None:
    written(writer, listing(PROGRAM + ":- q(a).\n"))
    assert writer.exit_code == Exit.PROVED
    assert capsys.readouterr().err == "waiter: it is inconsistent.\n"
    writer.undecided("time")
    assert writer.exit_code == Exit.UNDECIDED
    assert "the time limit was reached" in capsys.readouterr().err


def test_a_count_alone(capsys: pytest.CaptureFixture[str]) -> None:
    found = listing()
    number = len(list(found))
    TextWriter(Filter(), True).count(found, number, "")
    JsonWriter(lines=False).count(found, number, "")
    text, document = capsys.readouterr().out.splitlines()
    assert text == "2 answer sets" and json.loads(document)["count"] == 2


def test_differences_leave_out_what_all_have(capsys: pytest.CaptureFixture[str]) -> None:
    for writer in each_writer():
        found = listing()
        writer.timeline = found.timeline
        writer.differences(found, list(found), "")
    out = capsys.readouterr().out
    text, _, document = out.rpartition("\n{")
    assert text.startswith("1 literal in all of them; beyond these:")
    told = json.loads("{" + document)
    assert told["common"] == ["q(a)"] and sets(told) == [["p(a)"], ["p(b)"]]


def test_a_pattern_in_the_other_case_is_remarked(capsys: pytest.CaptureFixture[str]) -> None:
    found = listing(PROGRAM, "^P")
    written(TextWriter(found.chosen, True), found)
    said = capsys.readouterr()
    assert "(no literal matches)" in said.out and "would with -i" in said.err
