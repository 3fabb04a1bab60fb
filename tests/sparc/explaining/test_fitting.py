"""Queries with variables and conjunctions are explained with values that fit."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.typed_program import TypedProgram
from sparc.errors import SourceErrors, SparcSyntaxError
from sparc.explaining.why import why_query

PROGRAM = """\
#const most = 7.
sorts
#person = {ann, ben, carla}.
#age = 0..9.
#act = give(#person, #person).
predicates
parent(#person, #person).
old(#person).
age(#person, #age).
done(#act).
rules
parent(ann, ben). parent(ben, carla).
age(ann, most). age(ben, 3).
done(give(ann, carla)).
old(X) :- parent(X, Y), parent(Y, Z).
-old(carla).
"""


@pytest.fixture(scope="module")
def program() -> TypedProgram:
    return sparc.check(sparc.parse(PROGRAM))


@pytest.mark.parametrize(
    ("query", "told"),
    [
        ("parent(X, carla)", [("parent(ben,carla)", True)]),
        ("parent(X, Y), old(X).", [("parent(ann,ben)", True), ("old(ann)", True)]),
        ("parent(ann, ben), -old(carla)", [("parent(ann,ben)", True), ("-old(carla)", True)]),
        ("done(give(X, Y)), parent(X, Z)", [("done(give(ann,carla))", True), ("parent(ann,ben)", True)]),
        ("age(X, Y+4), age(Z, Y)", [("age(ann,7)", True), ("age(ben,3)", True)]),
        ("age(X, most)", [("age(ann,7)", True)]),
        ("age(X, 9)", [("age(X,9)", False)]),
        ("parent(X, Y), old(Y)", [("old(ben)", False)]),
        ("parent(carla, X), old(X)", [("parent(carla,X)", False)]),
        ("old(ann)", [("old(ann)", True)]),
        ("old(dora)", [("old(dora)", False)]),
    ],
)  # fmt: skip
def test_the_values_that_fit(
    program: TypedProgram, query: str, told: list[tuple[str, bool]]
) -> None:
    found = why_query(program, query)
    assert [(each.literal, each.holds) for each in found] == told
    for each in found:
        assert bool(each.because) == each.holds and bool(each.because_not) != each.holds


@pytest.mark.parametrize(("query", "fault"), [("p(X)", SourceErrors), ("p(", SparcSyntaxError)])
def test_what_is_no_query_is_refused(
    program: TypedProgram, query: str, fault: type[Exception]
) -> None:
    with pytest.raises(fault):
        why_query(program, query)


def test_a_search_of_too_many_values_is_given_up() -> None:
    facts = "p(1..60)."
    text = f"sorts #s = 1..60. predicates p(#s). q(#s). rules {facts} q(1)."
    program = sparc.check(sparc.parse(text))
    query = ", ".join([*(f"p(X{i})" for i in range(6)), "-p(X0)"])
    assert [each.holds for each in why_query(program, query)] == [False]
