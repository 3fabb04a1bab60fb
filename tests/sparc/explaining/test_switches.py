"""A program taken apart by statement, each with a switch."""

from __future__ import annotations

import pytest

import sparc
from sparc.explaining.switches import ON, SwitchedProgram, conditional, parted, switched
from sparc.solving.answers import Answers
from tests.support.inconsistent import SORTS


def program(rules: str) -> SwitchedProgram:
    return switched(sparc.check(sparc.parse(SORTS + rules)))


@pytest.mark.parametrize(
    ("rules", "lines", "switches"),
    [
        ("p(a). q(X) :- p(X). :- q(a).", [(0, "p(a)."), (1, "q(X):-p(X)."), (2, ":-q(a).")], (0, 1, 2)),
        ("p(X) | -p(X).", [(0, "p(X):-not -p(X),__s(X)."), (0, "-p(X):-not p(X),__s(X)."),
                           (None, "__s(a;b).")], (0,)),
        ("t. #minimize{1 : t}. :~ t. [1:1]", [(0, "t.")], (0,)),
        ("t :+ . r(1..2).", [(0, "{___appl(r_0)}."), (0, "t:-___appl(r_0)."), (1, "r(1..2).")], (1,)),
        ("q(X) :- p(X), not #s(a). t.", [(1, "t.")], (1,)),
        ("", [], ()),
    ],
    ids=["rules", "two lines", "preferences", "no switch", "no instance", "nothing"],
)  # fmt: skip
def test_the_lines_and_their_statements(
    rules: str, lines: list[tuple[int | None, str]], switches: tuple[int, ...]
) -> None:
    found = program(rules)
    assert (list(found.lines), found.switches) == (lines, switches)


def test_an_answer_set_tells_which_statements_are_on() -> None:
    plain = program("t. u :- t. :- u.")
    shown = plain.text()
    sets = {
        frozenset(literal.arguments[0] for literal in each.literals)
        for each in Answers(type(shown)(shown.text, f"#show {ON}/1."))
    }
    on = ((), (0,), (1,), (2,), (0, 1), (0, 2), (1, 2))
    assert sets == set(map(frozenset, on))  # all but the whole program


@pytest.mark.parametrize(
    ("line", "parts", "with_one_more"),
    [
        ("p(a).", ("p(a)", ""), "p(a):-c."),
        ("p(X):-q(X),not r.", ("p(X)", "q(X),not r"), "p(X):-q(X),not r,c."),
        (":-q.", ("", "q"), ":-q,c."),
        ("r(1..2).", ("r(1..2)", ""), "r(1..2):-c."),
    ],
)
def test_one_more_condition(line: str, parts: tuple[str, str], with_one_more: str) -> None:
    assert parted(line) == parts and conditional(line, "c") == with_one_more
