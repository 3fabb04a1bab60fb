"""Faults as text: the place, the excerpt with its carets, the mend."""

from __future__ import annotations

import json
import unicodedata

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sparc.diagnostics import as_dict, render, render_all
from sparc.errors import SortError, SourceError, SparcSyntaxError, SparcWarning
from sparc.escaping import escaped
from sparc.source import Origin, Source, Span
from sparc.syntax.parser import parse


def at(text: str, start: int, end: int, **options: object) -> SourceError:
    source = Source("domain.sparc", text, **options)  # type: ignore[arg-type]
    return SortError("unknown sort", Span(source, start, end), "look again")


def test_the_form() -> None:
    text = "predicates\nedge(#node, #nodee).\n"
    assert render(at(text, 23, 29, first_line=40)) == (
        "domain.sparc:41:13: error: unknown sort\n"
        "   41 | edge(#node, #nodee).\n"
        "      |             ^^^^^^\n"
        "  hint: look again"
    )


def test_from_the_parser() -> None:
    with pytest.raises(SparcSyntaxError) as info:
        parse(Source("x.sparc", "predicates\np().\nrules\np :- not not p.\n"))
    assert render(info.value) == (
        'x.sparc:4:10: error: expected an atom after "not", found "not"\n'
        "    4 | p :- not not p.\n"
        "      |          ^^^\n"
        '  hint: "not" stands once before an atom: there is no double negation'
    )


def test_without_a_place_or_a_mend() -> None:
    assert render(SourceError("the solver died")) == "error: the solver died"
    assert render(SourceError("it died", None, "try again")) == (
        "error: it died\n  hint: try again"
    )


def test_warnings() -> None:
    source = Source("x", "p(_, _).")
    warning = SparcWarning("two anonymous variables", Span(source, 5, 6))
    assert render(warning) == (
        "x:1:6: warning: two anonymous variables\n    1 | p(_, _).\n      |      ^"
    )


def test_tabs_are_spread_out_and_count_one_column() -> None:
    assert render(at("\tp(\tX).", 4, 5)).split("\n")[:3] == [
        "domain.sparc:1:5: error: unknown sort",
        "    1 |         p(      X).",
        "      |                 ^",
    ]


def test_a_place_behind_the_line() -> None:
    assert render(at("p :- q\nr.", 6, 6)).split("\n")[1:3] == [
        "    1 | p :- q",
        "      |       ^",
    ]


def test_the_end_of_the_text() -> None:
    assert render(at("p.\n", 3, 3)).split("\n")[:3] == [
        "domain.sparc:2:1: error: unknown sort",
        "    2 |",
        "      | ^",
    ]


def test_carets_stay_on_the_first_line() -> None:
    assert render(at("ab cd\nef gh", 3, 9)).split("\n")[1:3] == [
        "    1 | ab cd",
        "      |    ^^",
    ]


def test_a_line_that_was_made_from_another_file() -> None:
    origin = Origin("layout.yaml", 7, 3, "  n1: [0, 1]")
    assert render(at("node(n1).", 5, 7, origins=(origin,))) == (
        "layout.yaml:7:3: error: unknown sort\n"
        "    7 |   n1: [0, 1]\n"
        "      |   ^\n"
        "  hint: look again"
    )
    silent = Origin("layout.yaml", 7, 3)
    assert render(at("node(n1).", 5, 7, origins=(silent,))) == (
        "layout.yaml:7:3: error: unknown sort\n  hint: look again"
    )


def test_a_line_that_was_copied_from_another_file() -> None:
    origin = Origin("domain.sparc", 30, verbatim=True)
    assert render(at("node(n1).", 5, 7, origins=(origin,))).split("\n")[:3] == [
        "domain.sparc:30:6: error: unknown sort",
        "   30 | node(n1).",
        "      |      ^^",
    ]


def test_wide_letters_and_control_characters() -> None:
    assert render(at("% 大é\x1b q", 6, 7)).split("\n")[1:3] == [
        "    1 | % 大é\\x1b q",
        "      |           ^",
    ]


@pytest.mark.parametrize("start", [0, 40, 500, 999, 1000])
def test_long_lines_are_cut(start: int) -> None:
    text = "".join(chr(ord("a") + i % 26) for i in range(1000))
    _, excerpt, carets, _ = render(at(text, start, start + 1)).split("\n")
    assert len(excerpt) <= 180
    assert carets.count("^") == 1
    if start < 1000:
        assert excerpt[carets.index("^")] == text[start]


@settings(max_examples=150, deadline=None, derandomize=True)
@given(
    st.text(alphabet="ab(\t\n\r大é\u0301\x00 ", max_size=40),
    st.integers(0, 40),
    st.integers(0, 40),
)
def test_the_first_caret_stands_under_the_character(text: str, first: int, length: int) -> None:
    start = min(first, len(text))
    end = min(start + length, len(text))
    lines = render(at(text, start, end)).split("\n")
    assert len(lines) == 4
    carets = lines[2]
    assert "^" in carets
    if start < len(text) and text[start] in "ab(" and text[:start].isascii():
        assert lines[1][carets.index("^")] == text[start]
    line = text[:start].split("\n")[-1] + text[start:].split("\n")[0]
    shown = escaped(line.expandtabs(8))
    cells = sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in shown)
    assert len(carets) <= len("      | ") + cells + 1


def test_several() -> None:
    one, two = SourceError("one"), SourceError("two")
    assert render_all([one, two]) == "error: one\nerror: two"
    assert render_all([]) == ""


def test_as_dict() -> None:
    found = as_dict(at("p.\nq(\tX).", 6, 7))
    assert json.loads(json.dumps(found)) == {
        "message": "unknown sort",
        "file": "domain.sparc",
        "line": 2,
        "column": 4,
        "hint": "look again",
    }
    assert as_dict(SourceError("lost")) == {
        "message": "lost",
        "file": None,
        "line": None,
        "column": None,
        "hint": None,
    }
