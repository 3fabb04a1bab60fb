"""The answer about a literal of an answer set: which set, which literals, and limits."""

from __future__ import annotations

import pytest

import sparc
from tests.support.explained import BIRDS, found, step
from tests.support.replaying import faults_of


def test_each_answer_set() -> None:
    program = "predicates p(). q(). rules p | q. "
    sets = [{str(one) for one in each.literals} for each in sparc.solve(program)]
    for number, literals in enumerate(sets, 1):
        for literal in ("p", "q"):
            assert found(literal, program, number=number).holds is (literal in literals)
    assert found("p", program, number=3).sets == 2


def test_hidden_literals_can_be_asked_about() -> None:
    program = "predicates p(). q(). rules q. p :- q. display p. "
    assert found("q", program).holds
    choice = "predicates p(). q(). r(). rules {q}. {r}. p. display p. r. "
    assert found("p", choice, number=2).holds and found("p", choice, number=3).sets == 2


def test_without_an_answer_set() -> None:
    why = found("p", "predicates p(). rules p. -p. ")
    assert (why.holds, why.sets, why.limit) == (None, 0, None)


def test_time_that_is_up() -> None:
    why = sparc.why(BIRDS, "flies(sam)", time_limit=0.0)
    assert (why.holds, why.limit) == (None, "time")


@pytest.mark.parametrize("literal", ["p(X)", "p(", "", "not p", "p(a), p(b)"])
def test_what_is_no_literal(literal: str) -> None:
    with pytest.raises(sparc.SourceError):
        sparc.why("sorts #s = {a,b}. predicates p(#s). rules p(a). ", literal)


def test_a_constant_stands_for_its_number() -> None:
    program = "#const n = 2. sorts #n = 0..4. predicates p(#n). rules p(n). p(N+n) :- p(N). "
    assert step("p(n)", program).literal == "p(2)"
    assert step("p(4)", program).instance == "p(4) :- p(2)"


def test_everything_about_birds_replays() -> None:
    from tests.support.replaying import all_literals

    assert faults_of(BIRDS, all_literals(sparc.check(sparc.parse(BIRDS)))) == []
