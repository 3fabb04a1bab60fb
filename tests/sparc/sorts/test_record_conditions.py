"""Conditions of records as functions of their arguments."""

from __future__ import annotations

import pytest

import sparc
from sparc.sorts.record_conditions import condition_test, condition_variables
from sparc.syntax.tree import Condition, RecordSort


def condition(text: str) -> Condition:
    program = sparc.parse(f"sorts #s = f(#a(X),#a,#a(Y)) : {text}. predicates rules ")
    (definition,) = program.sorts
    assert isinstance(definition.expression, RecordSort) and definition.expression.condition
    return definition.expression.condition


@pytest.mark.parametrize(
    ("text", "less", "equal", "more"),
    [
        ("X < Y", True, False, False), ("X <= Y", True, True, False), ("X != Y", True, False, True),
        ("not(X < Y)", False, True, True), ("X < Y or X = Y", True, True, False),
        ("X <= Y and X >= Y", False, True, False), ("not(X < Y or X > Y)", False, True, False),
        ("not(X <= Y and X != Y) and Y <= X", False, True, True),
    ],
)  # fmt: skip
def test_what_passes(text: str, less: bool, equal: bool, more: bool) -> None:
    run = condition_test(condition(text), {"X": 0, "Y": 2})
    assert [run((1, "z", 2)), run((2, "z", 2)), run((3, "z", 2))] == [less, equal, more]
    names = condition_test(condition(text), {"X": 0, "Y": 2})
    assert [names(("a", 0, "b")), names(("b", 0, "b")), names(("c", 0, "b"))] == [less, equal, more]


def test_the_variables() -> None:
    assert condition_variables(condition("not(X < Y) and (X = X or X > X)")) == {"X", "Y"}
    assert condition_variables(condition("X = X")) == {"X"}
