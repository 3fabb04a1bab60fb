"""Queries to a program that another translator made: the answers are those of `sparc.query`."""

from __future__ import annotations

import pytest

import sparc
from sparc.errors import SparcSyntaxError
from sparc.source import Source
from tests.support.random_programs import random_program
from waiter_cli.answersets.query import ask_asp
from waiter_cli.translators.native import NativeTranslator

FAMILY = """\
sorts
#person = {anna, ben, carla}.
#age = 1..9.
predicates
parent(#person, #person). age(#person, #age). kind(#person).
rules
parent(anna, ben). parent(ben, carla). -parent(carla, anna).
age(ben, 4).
kind(anna) | kind(ben).
"""


def asked(text: str, query: str) -> str:
    typed = sparc.check(sparc.parse(text))
    program = NativeTranslator().translate(Source("p.sparc", text))
    return str(ask_asp(program, typed, query))


@pytest.mark.parametrize(
    "query",
    [
        "parent(anna,ben)",
        "parent(carla,anna)",
        "parent(anna,carla)",
        "kind(anna)",
        "-parent(carla,anna)",
        "parent(anna,X)",
        "parent(X,Y)",
        "parent(X,Y), parent(Y,Z)",
        "parent(X,X)",
        "age(ben,2+2)",
        "age(X,A)",
    ],
)
def test_the_answer_is_that_of_the_library(query: str) -> None:
    assert asked(FAMILY, query) == str(sparc.query(sparc.check(sparc.parse(FAMILY)), query))


def test_answers_agree_on_programs_by_chance() -> None:
    compared = 0
    for seed in range(40):
        text = random_program(seed)
        try:
            typed = sparc.check(sparc.parse(text))
            literal = next(iter(next(iter(sparc.solve(typed, models=1))).literals))
        except (sparc.SourceError, sparc.SourceErrors, StopIteration):
            continue
        if not literal.name.startswith("#"):
            assert asked(text, str(literal)) == str(sparc.query(typed, str(literal))), text
            compared += 1
    assert compared > 10


def test_what_is_no_query_is_a_fault() -> None:
    with pytest.raises(SparcSyntaxError):
        asked(FAMILY, "parent(anna,")
    with pytest.raises(sparc.SourceErrors):
        asked(FAMILY, "parent(anna,zoe)")
