"""What the jar writes and says: its translation as a program, its messages as faults with places."""

from __future__ import annotations

import pytest

from sparc.errors import (
    MissingToolError,
    PredicateError,
    RuleError,
    SolverError,
    SortError,
    SourceError,
    SparcSyntaxError,
)
from sparc.solving.jar_output import asp_program, is_complete, run_failure, source_error
from sparc.source import Origin, Source
from tests.support.jar import FAMILY, FAMILY_ASP

# ------------------------------------------------------------------ what the jar wrote


def test_helper_rules_become_show_directives() -> None:
    program = asp_program(FAMILY_ASP, Source("family.sparc", FAMILY))
    assert program.show.split("\n") == [
        "#show.",
        "#show happy/0.",
        "#show -happy/0.",
        "#show knows/2.",
        "#show -knows/2.",
        "#show born/2.",
        "#show -born/2.",
        "",
    ]
    assert "happy_" not in program.text
    assert program.has_preferences


def test_each_line_knows_its_statement() -> None:
    program = asp_program(FAMILY_ASP, Source("family.sparc", FAMILY))
    lines = program.text.split("\n")
    assert len(lines) == len(program.line_spans)
    places = [span and span.location.line for span in program.line_spans]
    assert places == [10, 11, 11, 13, 13, 13, 14, None, None, None, None, None]
    assert program.line_spans[2] is not None
    assert program.line_spans[2].text.startswith("happy :- knows(X, Y),\n")


def test_display_patterns() -> None:
    text = (
        "sorts\n#p = {a}.\npredicates\np(#p). q(#p,#p).\nrules\np(a).\n"
        "display\np(a). -p. q(_,_). #p.\n"
    )
    output = "\np(a).\np_(a).\np__(a):-p(a).\np___(X1):--p(X1).\nq_(_,_):-q(_,_).\n"
    output += "p____(X):-p_(X).\n% p__ p___ q_ p____\n"
    shown = asp_program(output, Source("d.sparc", text)).show.split("\n")
    assert shown[1:4] == ["#show p(a) : p(a).", "#show -p/1.", "#show q(_A0,_A1) : q(_A0,_A1)."]
    assert shown[4].endswith(": p_(X).") and "p_(X)" not in shown[4].split(":")[0]


def test_weak_constraints_are_refused_in_place() -> None:
    source = Source("w.sparc", "sorts\n#s={a}.\npredicates\np(#s).\nrules\np(a).\n:~ p(a). [1:2]\n")
    output = "\np(a).\n:~p(a). [1:2]\np_(X1):-p(X1).\np__(X1):--p(X1).\n% p_ p__\n"
    with pytest.raises(RuleError, match="weak constraints") as caught:
        asp_program(output, source)
    assert caught.value.span is not None
    assert str(caught.value.span.location) == "w.sparc:7:1"


@pytest.mark.parametrize("cut", [10, 200, len(FAMILY_ASP) - 60])
def test_a_torn_file_is_no_translation(cut: int) -> None:
    with pytest.raises(SolverError, match="sparc.jar"):
        asp_program(FAMILY_ASP[:cut], Source("family.sparc", FAMILY))


# ------------------------------------------------------------------ its messages


@pytest.mark.parametrize(
    ("stderr", "kind", "message", "place"),
    [
        (
            (
                'program.sparc: argument number 1 of predicate p/1, "b", at line 2, column 3 '
                'violates definition of sort "#s"'
            ),
            PredicateError,
            'argument number 1 of predicate p/1, "b" violates definition of sort "#s"',
            "2:3",
        ),
        ("Line 1, column 2: sort '#t' was not defined", SortError, "sort '#t' was not", "1:2"),
        ("sort s at line 2 column 1 was already defined", SortError, "sort s was already", "2:1"),
        (
            (
                "program.sparc: program rule p(X):-X<Y. at line 3, column 1 contains unrestricted "
                "global variables Y"
            ),
            RuleError,
            "program rule p(X):-X<Y. contains unrestricted global variables Y",
            "3:1",
        ),
        (
            'Encountered " "." ". "" at line 4, column 9.\nWas expecting:\n    "x" ...',
            SparcSyntaxError,
            'unexpected "q"',
            "4:2",
        ),
        (
            (
                "Exception in thread x parser.TokenMgrError: Lexical error at line 2, column 3.  "
                'Encountered: "?" (63), after : ""'
            ),
            SparcSyntaxError,
            'unexpected "b"',
            "2:3",
        ),
    ],
)
def test_messages_get_their_place(
    stderr: str, kind: type[SourceError], message: str, place: str
) -> None:
    source = Source("mine.sparc", "abc\np(b)\n1234\n\tq(X)\n")
    error = source_error(f"SPARC  V2.57\n{stderr}\n", source, "program.sparc")
    assert type(error) is kind
    assert message in error.message
    assert error.span is not None
    assert str(error.span.location) == f"mine.sparc:{place}"


def test_places_lead_to_the_file_a_person_edits() -> None:
    source = Source("filled", "one\ntwo\n", origins=(None, Origin("layout.yaml", 7, 3)))
    error = source_error("sort s at line 2 column 2 was already defined", source, "program.sparc")
    assert error is not None and error.span is not None
    assert str(error.span.location) == "layout.yaml:7:3"


def test_no_message_is_no_error() -> None:
    said = "SPARC  V2.57\nprogram translated\nERROR: Your program is inconsistent\n"
    assert source_error(said, Source("x", "sorts\n"), "program.sparc") is None


@pytest.mark.parametrize(
    ("expected", "hint"),
    [
        ("Was expecting:\n    <IDENTIFIER> ...", "expected identifier"),
        ('Was expecting one of:\n    <SORT_NAME> ...\n    "}" ...', 'expected sort name or "}"'),
        ("Was expecting one of:\n" + '    "x" ...\n' * 5, None),
    ],
    ids=["one", "two", "too many"],
)
def test_what_the_jar_would_have_taken_is_the_hint(expected: str, hint: str | None) -> None:
    said = f'Encountered " "." ". "" at line 1, column 3.\n{expected}\n'
    error = source_error(said, Source("x", "p( .\n"), "program.sparc")
    assert error is not None and error.hint == hint


@pytest.mark.parametrize(
    ("text", "line", "column", "found"),
    [
        ("a\tb", 1, 9, "b"), ("\t\tb", 1, 17, "b"), ("1234567\tb", 1, 9, "b"), ("#s = x.", 1, 2, "#s"),
        ("abc\n", 1, 99, ""), ("abc", 7, 1, "abc"), ("abc", 0, 0, "abc"),
    ],
)  # fmt: skip
def test_places_as_the_jar_counts_them(text: str, line: int, column: int, found: str) -> None:
    said = f"sort s at line {line} column {column} was already defined"
    error = source_error(said, Source("x", text), "program.sparc")
    assert error is not None and error.span is not None and error.span.text == found


@pytest.mark.parametrize(
    ("text", "complete"), [("p.\n% p_\n", True), ("p.\n%", True), ("p.\n", False), ("", False)]
)
def test_the_last_line_tells_whether_it_is_all(text: str, complete: bool) -> None:
    assert is_complete(text) is complete


@pytest.mark.parametrize(
    ("said", "kind", "message"),
    [
        ("Error: Unable to access jarfile x", MissingToolError, "cannot read sparc.jar"),
        ("java.lang.UnsupportedClassVersionError: 61", MissingToolError, "too old"),
        ("Unable to locate a Java Runtime", MissingToolError, "no Java runtime"),
        ("java.lang.OutOfMemoryError: heap", SolverError, "ran out of memory"),
        ("java.lang.StackOverflowError", SolverError, "nested this deeply"),
        ("x\nException in thread main\n at y", SolverError, "Exception in thread main"),
        ("SPARC  V2.57\nodd words\n\n", SolverError, "odd words"),
        ("", SolverError, "no message, exit status 3"),
    ],
)
def test_a_run_without_a_result(said: str, kind: type[SolverError], message: str) -> None:
    error = run_failure(said, 3)
    assert type(error) is kind and message in error.message


def test_preferences_and_a_display_are_seen_in_the_text() -> None:
    source = Source("x", "predicates\np().\nrules\np.\n% display\n")
    plain = asp_program("\np.\np_:-p.\n% p_\n", source)
    assert not plain.has_preferences and not plain.has_display
    shown = Source("x", source.text + "display\np.\n")
    least = asp_program("\np.\n#minimize{1:p}.\np_:-p.\n% p_\n", shown)
    assert least.has_preferences and least.has_display


def test_a_map_that_does_not_fit_has_no_places() -> None:
    source = Source("x", "predicates\np(). q().\nrules\np. q.\n")
    program = asp_program("\np.\np_:-p.\n% p_\n", source)
    assert set(program.line_spans) == {None}
