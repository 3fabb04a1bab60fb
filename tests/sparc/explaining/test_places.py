"""Where a statement stands, its text on one line, and the sentence above it."""

from __future__ import annotations

import pytest

from sparc.explaining.places import place_of
from sparc.source import Source, Span


def sentence(before: str, statement: str = "p(a).") -> str | None:
    source = Source("x", f"{before}{statement}")
    return place_of(Span(source, len(before), len(source.text))).sentence


@pytest.mark.parametrize(
    ("before", "above"),
    [
        ("% A sentence.\n", "A sentence."),
        ("% Two\n%   lines.\n", "Two lines."),
        ("%% Marked twice.\n", "Marked twice."),
        ("  % Indented.\n  ", "Indented."),
        ("% Of a group.\np(c).\np(b).\n", "Of a group."),
        ("% Of others.\nq(b).\n", None),
        ("% Apart.\n\n", None),
        ("q. % behind\n", None),
        ("%------\n% Below a line.\n", "Below a line."),
        ("% Above a line.\n%------\n", None),
        ("%{ if\n", None),
        ("% Before a mark.\n%?\n", None),
        ("%\n", None),
        ("", None),
    ],
)
def test_the_sentence_above(before: str, above: str | None) -> None:
    assert sentence(before) == above


def test_constraints_are_a_group_as_well() -> None:
    assert sentence("% Never.\n:- p.\n", ":- q.") == "Never."
    assert sentence("% Never.\n:- p.\n", "q.") is None
    assert sentence("% Negated too.\np(b).\n", "-p(a).") == "Negated too."


def test_the_text_on_one_line() -> None:
    text = "\n  p(X) :-  % first\n\tq(X),\n  % all of a line\n  r(X)."
    place = place_of(Span(Source("x.sparc", text), 3, len(text)))
    assert (place.text, place.line, place.column) == ("p(X) :- q(X), r(X).", 2, 3)
    assert str(place) == "x.sparc:2"
    assert place.as_dict() == {
        "file": "x.sparc", "line": 2, "column": 3, "text": "p(X) :- q(X), r(X).",
    }  # fmt: skip
