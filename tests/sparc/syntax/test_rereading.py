"""A text that is being edited is read as `parse` reads it, and what stayed is kept."""

from __future__ import annotations

import random

import pytest

from sparc.errors import LimitError
from sparc.source import Source
from sparc.syntax import rereading
from sparc.syntax.parser import parse
from sparc.syntax.rereading import Reading
from tests.support.sparc_texts import faults

TEXT = """\
#const n = 3.
sorts
#s = {a,b}.
predicates
p(#s). q(#s).
rules
p(a).
q(X) :- p(X),
    not -p(X).
r0 : p(b) :+ q(b).
q(b).
display
p.
"""


def read(text: str, before: Reading | None = None) -> Reading:
    return Reading(Source("x", text), before)


def same_as_parsed(reading: Reading) -> None:
    expected = faults(reading.source)
    assert [str(one) for one in reading.faults] == [str(one) for one in expected]
    if not expected:
        assert reading.program == parse(reading.source)


@pytest.mark.parametrize(
    ("old", "new", "kept"),
    [
        ("p(a).", "p(b).", [0, 1, 0, 1]),
        ("q(b).\n", "q(b).\nq(a).\n", [1, 1, 0, 0, 0]),
        ("p(a).\n", "", [0, 0, 1]),
        ("#s = {a,b}.", "#s = {a,b,c}.", [1, 1, 0, 1]),
        ("#const n = 3.", "#const m = 3.", [0, 0, 0, 0]),
        ("#const n = 3.", "#const n = 4.", [1, 1, 0, 1]),
        ("not -p(X).", "not -p(X)", [1, 0, 1]),
        ("display\np.", "display\nq.", [1, 1, 0, 0]),
    ],
    ids=["a fact", "a fact more", "a fact less", "a sort", "the name of a constant",
         "its value", "a dot less", "the display"],
)  # fmt: skip
def test_what_is_kept(old: str, new: str, kept: list[bool]) -> None:
    """What stands beside a change is read again, and so is a rule with a label."""
    assert old in TEXT
    before = read(TEXT)
    after = read(TEXT.replace(old, new, 1), before)
    same_as_parsed(after)
    earlier = {id(statement) for statement in before.program.statements}
    assert [id(statement) in earlier for statement in after.program.statements] == kept


def test_how_far_a_statement_has_moved() -> None:
    before = read(TEXT)
    after = read(TEXT.replace("p(a).\n", "p(a).\nq(a). "), before)
    moved = after.moved()
    for statement, by in zip(after.program.statements, moved, strict=True):
        start, end = statement.span.start + by, statement.span.end + by
        assert after.source.text[start:end] == statement.span.text
    assert moved == [0, 0, 0, 0, 6]  # those that were read again stand where they say


def test_a_sort_that_is_a_word_of_another_language_changes_the_reading() -> None:
    text = TEXT.replace("q(b).\nd", "q(X) :- #show(X).\nd")
    before = read(text)
    after = read(text.replace("#s = {a,b}.", "#s = {a,b}. #show = #s."), before)
    assert before.faults and not after.faults
    same_as_parsed(read(text, after))


def test_any_edit_of_many() -> None:
    random_ = random.Random(3)
    pieces = ["", ".", "\n", "p(a).", " :- ", "X", ",", "#s", "rules\n", "n", "- ", "("]
    text, reading = TEXT, read(TEXT)
    for _ in range(150):
        start = random_.randrange(len(text) + 1)
        new = text[:start] + random_.choice(pieces) + text[start + random_.choice((0, 0, 1, 4)) :]
        reading = read(new, reading)
        same_as_parsed(reading)
        text = new if random_.random() < 0.8 else TEXT


def test_a_text_that_is_too_large_has_one_fault_and_no_statements(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sparc.syntax.lexer.MAX_CHARACTERS", 50)
    reading = read(TEXT)
    (fault,) = reading.faults
    assert isinstance(fault, LimitError) and reading.program.statements == ()
    monkeypatch.undo()
    same_as_parsed(read(TEXT, reading))


def test_older_versions_are_let_go_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rereading, "_MOST_HELD", 2 * len(TEXT))
    first = read(TEXT)
    statement = first.program.statements[0]
    second = read(TEXT, first)
    third = read(TEXT, second)
    fourth = read(TEXT, third)
    assert second.program.statements[0] is third.program.statements[0] is statement
    assert fourth.program.statements[0] is not statement
