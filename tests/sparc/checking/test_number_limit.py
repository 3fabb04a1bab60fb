"""Numbers above ``#maxint`` are faults where they stand."""

from __future__ import annotations

from dataclasses import replace

import pytest

import sparc
from sparc.checking.number_limit import NumberLimit

HEAD = "sorts #s = 1..9. predicates p(#s). rules "


def told(text: str, maxint: int = 20) -> list[str]:
    program = sparc.parse(text)
    faults = NumberLimit(program, maxint).faults(
        (program.directives, program.sorts, program.statements, program.display)
    )
    return sorted(f"{fault.span and fault.span.text}: {fault.hint}" for fault in faults)


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        (HEAD + "p(20).", []),
        (HEAD + "p(21).", ["21"]),
        (
            HEAD + "p(X) :- p(X), X < 3*(40+f), #count{Y : p(Y)} > 50.".replace("+f", "+1"),
            ["40", "50"],
        ),
        (HEAD + "p(3). % p(99) is too large", []),
        (HEAD + "p(3).\n% p(99)\np(77).", ["77"]),
        (HEAD + "p(a99).", []),
        ("sorts #s = 1..99. predicates p(#s). rules ", ["99"]),
        ("sorts #s = {f(30)}. predicates p(#s). rules ", ["30"]),
        ("#const n = 88. " + HEAD, ["88"]),
        ("#maxint = 88. " + HEAD, []),
        (HEAD + "p(1..25).", ["25"]),
        (HEAD + "#minimize{60 : p(X)}. :~ p(X). [31:32]", ["31", "32", "60"]),
        (HEAD + "p(1). display p(41).", ["41"]),
    ],
)
def test_what_is_too_large(text: str, numbers: list[str]) -> None:
    hint = "write #maxint = {0}. (or more) as the first line"
    assert told(text) == [f"{number}: {hint.format(number)}" for number in numbers]


def test_numbers_of_one_digit_are_always_allowed() -> None:
    assert told(HEAD + "p(9).", 0) == []
    assert len(told(HEAD + "p(10).", 0)) == 1


def test_a_tree_without_a_text_is_searched() -> None:
    program = replace(sparc.parse(HEAD + "p(21)."), source=None)  # type: ignore[type-var]
    assert len(NumberLimit(program, 20).faults(program.statements)) == 1
    assert NumberLimit(program, 21).faults(program.statements) == []
