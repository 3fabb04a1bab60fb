"""A program that is being edited is checked as a whole one, and what stayed is not looked at again."""

from __future__ import annotations

import random

import pytest

import sparc
from sparc.checking import rechecking
from sparc.checking.rechecking import Examined
from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.rereading import Reading

TEXT = """\
#const n = 3.
sorts
#s = {a,b}.
#n = 0..n.
predicates
p(#s). q(#s). n(#n).
rules
p(a).
q(X) :- p(X), not -p(X).
n(1..2).
n(X*X) :- n(X).
q(b) :- p(Y), n(2).
r0 : p(b) :+ q(b).
"""


def whole(text: str) -> list[str]:
    """The faults, or else the warnings, of a text as a whole."""
    try:
        typed = sparc.check(sparc.parse(Source("x", text)))
    except SourceErrors as found:
        return [str(error) for error in found.errors]
    try:
        return [str(warning) for warning in sparc.find_warnings(typed)]
    except SourceError:
        return []


class Edited:
    """A text in its versions."""

    def __init__(self, text: str) -> None:
        self.reading = Reading(Source("x", text))
        self.examined = Examined(self.reading.program)

    def change(self, text: str) -> None:
        self.reading = Reading(Source("x", text), self.reading)
        self.examined = Examined(self.reading.program, self.examined)

    def found(self) -> list[tuple[int, str]]:
        """The places, now, and the messages."""
        placed = self.examined.findings(self.reading.moved())
        return [(each.start, each.what.message) for each in placed]


def expected(text: str) -> list[tuple[int, str]]:
    try:
        typed = sparc.check(sparc.parse(Source("x", text)))
        found: tuple[SourceError, ...] = sparc.find_warnings(typed)
    except SourceErrors as errors:
        found = errors.errors
    return [(-1 if one.span is None else one.span.start, one.message) for one in found]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("p(a).", "p(b)."),
        ("p(a).", "p(c)."),
        ("p(a).", ""),
        ("p(a).", "p(a). q(c). q(d)."),
        ("{a,b}", "{a,c}"),
        ("n = 3", "n = 9"),
        ("n = 3", "n = 1"),
        ("n(#n).", "n(#s)."),
        ("n(#n).", ""),
        ("n(#n).", "n(#n). m(#zz)."),
        ("p(#s).", "\n\np(#s)."),
        ("r0 : ", ""),
        ("r0 : ", "r0 : q(a) :+ . r0 : "),
        ("n(X*X)", "n(X)"),
        ("q(b) :-", "q(b) :- n(2000),"),
        ("rules", "rules\nn(X) :- n(X), X > 99."),
    ],
)
def test_what_is_found_is_what_the_whole_has(old: str, new: str) -> None:
    assert old in TEXT
    changed = TEXT.replace(old, new, 1)
    edited = Edited(TEXT)
    assert edited.found() == expected(TEXT) and len(edited.found()) > 1
    edited.change(changed)
    assert edited.found() == expected(changed)
    edited.change(TEXT)
    assert edited.found() == expected(TEXT)


@pytest.mark.parametrize(
    ("old", "new", "looked_at"),
    [
        ("p(a).\n", "p(b).\n", 2),
        ("#n = 0..n.", "#n = 0..4.", 4),
        ("p(#s). q(#s).", "p(#s).  q(#s).", 1),
        ("n(#n).", "n(#n). m(#s).", 1),
        ("q(#s).", "q(#n).", 3),
    ],
    ids=["a fact", "a sort", "white space", "a new predicate", "another sort"],
)
def test_what_is_looked_at_again(
    old: str, new: str, looked_at: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    edited = Edited(TEXT)
    edited.found()
    statements: list[object] = []
    real = rechecking.Checker.statement

    def statement(self: rechecking.Checker, one: object) -> None:
        statements.append(one)
        real(self, one)  # type: ignore[arg-type]

    monkeypatch.setattr(rechecking.Checker, "statement", statement)
    edited.change(TEXT.replace(old, new, 1))
    edited.found()
    assert len(statements) == looked_at


def test_any_edit_of_many() -> None:
    random_ = random.Random(5)
    pieces = ["", "p(a). ", "q(c). ", " ", "X", "n", "1", "-", "not ", "\n", "n(X+1) :- n(X). "]
    edited, text = Edited(TEXT), TEXT
    for _ in range(60):
        start = random_.randrange(len(text) + 1)
        text = text[:start] + random_.choice(pieces) + text[start + random_.choice((0, 0, 1)) :]
        edited.change(text)
        if edited.reading.faults:
            text = TEXT
            edited.change(text)
        assert edited.found() == expected(text), text


def test_a_program_nested_too_deeply_has_one_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_deep(self: object, statement: object) -> None:
        raise RecursionError

    monkeypatch.setattr(rechecking.Checker, "statement", too_deep)
    ((place, message),) = Edited(TEXT).found()
    assert (place, message) == (-1, "the program is nested too deeply to be checked")
