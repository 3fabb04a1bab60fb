"""Queries: yes, no, unknown, bindings, and what cannot be asked."""

from __future__ import annotations

import pytest

import sparc
from sparc.errors import SparcSyntaxError
from sparc.solving.query import Verdict

FAMILY = """
#const n = 2.
sorts
#s = {a,b,c}. #n = 0..5. #f = f(#s,#n).
predicates
p(#s). q(#n). w(#f). e(#s,#s). never().
rules
p(a). -p(b). q(2). q(3) | q(4). w(f(a,2)). w(f(b,3)). e(a,a). e(a,b). e(b,b).
"""


def typed(text: str = FAMILY) -> sparc.TypedProgram:
    return sparc.check(sparc.parse(text))


@pytest.mark.parametrize(
    ("literal", "expected"),
    [
        ("p(a)", "yes"),
        ("p(a).", "yes"),
        ("  p( a ) . ", "yes"),
        ("-p(a)", "no"),
        ("p(b)", "no"),
        ("-p(b)", "yes"),
        ("p(c)", "unknown"),
        ("never", "unknown"),
        ("q(2)", "yes"),
        ("q(1+1)", "yes"),
        ("q(n)", "yes"),
        ("q(3)", "unknown"),
        ("w(f(a,1+1))", "yes"),
        ("w(f(b,n))", "unknown"),
        ("p(X)", "X = a"),
        ("-p(X)", "X = b"),
        ("q(X)", "X = 2"),
        ("w(f(X,Y))", "X = a Y = 2\nX = b Y = 3"),
        ("w(X)", "X = f(a,2)\nX = f(b,3)"),
        ("e(X,X)", "X = a\nX = b"),
        ("e(a,X)", "X = a\nX = b"),
        ("q(X+1)", "X = 1"),
        ("-q(X)", "unknown"),
    ],
)
def test_answers(literal: str, expected: str) -> None:
    assert str(sparc.query(FAMILY, literal)) == expected


@pytest.mark.parametrize(
    ("literal", "message"),
    [
        ("p(d)", "d is not in sort #s"),
        ("p(a,b)", "predicate p has 1 argument"),
        ("pp(a)", "unknown predicate pp/1"),
        ("q(7)", "7 is not in sort #n"),
        ("q(1/0)", "division by zero"),
        ("w(g(X))", "no sort has a record g"),
        ("p(_)", "no anonymous variables"),
        ("not p(a)", "a query is literals"),
        ("p(a), not p(b)", "a query is literals"),
        ("p(a), p(d)", "d is not in sort #s"),
        ("p(a), p(_)", "no anonymous variables"),
        ("p(a). p(b)", "a query is literals"),
        ("X = a", "a query is literals"),
        ("#s(a)", "a query is literals"),
        ("", "the query is empty"),
        (".", "the query is empty"),
        ("p(", "expected"),
        ("p(a) :- p(b)", "expected"),
    ],
)
def test_what_cannot_be_asked(literal: str, message: str) -> None:
    with pytest.raises((sparc.SourceError, sparc.SourceErrors), match=message):
        sparc.query(typed(), literal)


def test_places_are_those_of_the_query() -> None:
    with pytest.raises(sparc.SourceErrors) as caught:
        sparc.query(typed(), "p(d)")
    (error,) = caught.value.errors
    assert error.span is not None and str(error.span.location) == "query:1:1"


@pytest.mark.parametrize(
    ("literal", "place", "message"),
    [
        ("p(", "1:3", "expected a term, found the end of the query"),
        ("p(a.", "1:4", 'expected "," or ")", found the end of the query'),
        ("  p(a b)", "1:5", 'expected "," or ")", found "b"'),
        ("p(a),", "1:6", "expected a literal, found the end of the query"),
        ("p(a,\nb", "2:2", 'expected "," or ")", found the end of the query'),
        ("not p(a)", "1:1", "a query is literals, joined by commas"),
        ("p(a). p(b)", "1:1", "a query is literals, joined by commas"),
        ("", "1:1", "the query is empty"),
    ],
)
def test_syntax_errors_have_their_place(literal: str, place: str, message: str) -> None:
    with pytest.raises(SparcSyntaxError) as caught:
        sparc.query(typed(), literal)
    error = caught.value
    assert error.span is not None
    assert (str(error.span.location), error.message) == (f"query:{place}", message)


def test_inconsistency_is_no_answer() -> None:
    text = "predicates p(). rules p. :- p. "
    assert sparc.query(text, "p").verdict is Verdict.INCONSISTENT


def test_queries_are_about_minimal_supports() -> None:
    text = "sorts #s = {a,b}. predicates p(#s). ok(). rules p(X) :+ . ok :- p(X). :- not ok. "
    assert str(sparc.query(text, "ok")) == "yes"
    assert str(sparc.query(text, "p(a)")) == "unknown"
    assert str(sparc.query(text, "p(X)")) == "unknown"


def test_queries_are_about_all_sets_where_no_cr_rule_can_fire() -> None:
    text = "predicates p(). q(). z(). never(). rules {p; q}. z :+ never. "
    assert str(sparc.query(text, "p")) == "unknown"


def test_queries_are_about_optimal_sets() -> None:
    text = "sorts #n = 1..3. predicates p(#n). rules 1{p(X)}1. #minimize{X : p(X)}. "
    assert str(sparc.query(text, "p(X)")) == "X = 1"


def test_display_has_no_influence() -> None:
    text = "predicates p(). q(). rules p. q. display\nq."
    assert str(sparc.query(text, "p")) == "yes"


def test_a_query_does_not_list_answer_sets() -> None:
    """2^60 answer sets, and an answer at once."""
    text = "sorts #n = 1..60. predicates p(#n). q(#n). rules q(7). {p(X)}. "
    assert str(sparc.query(text, "q(7)", time_limit=20)) == "yes"
    assert str(sparc.query(text, "p(7)", time_limit=20)) == "unknown"
    assert str(sparc.query(text, "q(X)", time_limit=20)) == "X = 7"


def test_variables_in_arithmetic_only_are_numbers() -> None:
    text = "sorts #n = 0..9. predicates p(#n). rules p(4). p(9). "
    assert str(sparc.query(text, "p(X*X)")) == "X = 2\nX = 3"


def test_bindings_are_values() -> None:
    (binding,) = sparc.query(FAMILY, "q(X)").bindings
    assert binding == {"X": 2}


COLOURS = """sorts #s = {a,b,c}. predicates p(#s). q(#s). r(#s).
rules p(a). p(b). q(b). q(c). -q(a). r(a) | r(b). """


@pytest.mark.parametrize(
    ("conjunction", "expected"),
    [
        ("p(a), q(b)", "yes"),
        ("p(a), q(b), -q(a).", "yes"),
        ("p(a), q(a)", "no"),
        ("p(a), r(a)", "unknown"),
        ("p(c), q(c)", "unknown"),
        ("p(X), q(X)", "X = b"),
        ("p(X), q(Y)", "X = a Y = b\nX = a Y = c\nX = b Y = b\nX = b Y = c"),
        ("p(X), -q(X)", "X = a"),
        ("p(X), r(X)", "unknown"),
        ("-q(X), q(X)", "unknown"),
    ],
)
def test_conjunctions(conjunction: str, expected: str) -> None:
    assert str(sparc.query(COLOURS, conjunction)) == expected
