"""Sorts that are too small: which are, what they lack, and a definition that would do."""

from __future__ import annotations

import re

import pytest

import sparc
from sparc.checking.typed_program import TypedProgram
from sparc.explaining.small_sorts import small_sorts
from sparc.explaining.subsets import Undecided
from tests.support.inconsistent import found


def test_a_sort_that_is_too_small() -> None:
    explanation = found("r(4). total(N+1) :- r(N). u :- total(N). :- not u.")
    (cause,) = explanation.causes
    (sort,) = (member for member in cause.members if member.is_sort)
    assert (sort.place.line, sort.place.text, sort.instances) == (3, "#n = 0..4.", ("total(5)",))
    assert sort.larger == "#n = 0..5."


@pytest.mark.parametrize(
    ("sorts", "rules", "lost", "larger"),
    [
        # what another sort has, and a rule carries over
        ("#l = {a,b,c,d}. #s = {a,b}.", "l(c). s(X) :- l(X). t :- s(X).", r"s\(c\)", "{a, b, c}"),
        ("#l = 0..9. #s = 0..2.", "l(4). s(X) :- l(X). t :- s(X).", r"s\(4\)", "{0, 1, 2, 4}"),
        # arithmetic
        ("#s = {0,1,2}. #l = {a}.", "s(2). s(N+1) :- s(N), N < 9. t :- s(N), N > 3.",
         r"s\(3\), s\(4\)", "{0, 1, 2, 3, 4}"),
        # a choice among all of them
        ("#l = {x,y,z}. #s = {s1,s2}.", "1{at(X,Y)}1 :- l(X). l(X) :- #l(X). t :- not c. "
         "c :- at(X,Y), at(Z,Y), X != Z.", r"at\(.,s3\)", "{s1, s2, s3}"),
        ("#l = {x,y,z}. #s = {red,blue}.", "1{at(X,Y)}1 :- l(X). l(X) :- #l(X). t :- not c. "
         "c :- at(X,Y), at(Z,Y), X != Z.", r"at\(.,new_s1\)", "{red, blue, new_s1}"),
        ("#l = {x,y,z}. #s = 1..2.", "1{at(X,Y)}1 :- l(X). l(X) :- #l(X). t :- not c. "
         "c :- at(X,Y), at(Z,Y), X != Z.", r"at\(.,3\)", "{1, 2, 3}"),
        # ranges and strings
        ("#l = a..d. #s = a..b.", "l(c). s(X) :- l(X). t :- s(X).", r"s\(c\)", "{a, b, c}"),
        ("#l = [k][1..4]. #s = [k][1..2].", "l(k3). s(X) :- l(X). t :- s(X).", r"s\(k3\)", "{k1, k2, k3}"),
    ],
)  # fmt: skip
def test_a_listed_sort_that_is_too_small(sorts: str, rules: str, lost: str, larger: str) -> None:
    """The definition that is advised, put in its place, leaves an answer set."""
    program = f"sorts\n{sorts}\npredicates\nl(#l). s(#s). at(#l,#s). c(). t().\nrules\n{rules} :- not t.\n"
    (cause,) = sparc.explain(program).causes
    (sort,) = (member for member in cause.members if member.is_sort)
    assert re.fullmatch(lost, ", ".join(sort.instances))
    assert sort.larger == f"#s = {larger}."
    assert not list(sparc.solve(program, models=1))
    assert list(sparc.solve(program.replace(sort.place.text, sort.larger), models=1))


@pytest.mark.parametrize(
    "rules",
    [
        "r(3). total(N+1) :- r(N). u :- total(N). :- u.",  # no number leaves its sort
        "r(4). total(N+1) :- r(N). :- not u.",  # nor does a larger one help
        "1{r(N)}1. :- r(N).",
        "1{p(X)}1. :- p(X).",
        "p(a). q(X) :- p(X). :- q(X).",
    ],
)
def test_a_sort_that_is_large_enough(rules: str) -> None:
    assert not any(m.is_sort for cause in found(rules).causes for m in cause.members)


def typed(sorts: str, rules: str) -> TypedProgram:
    return sparc.check(
        sparc.parse(f"sorts {sorts} predicates p(#s). q(#t). t(). u(). rules {rules}")
    )


def test_each_cause_has_its_own_sorts() -> None:
    program = typed(
        "#s = 0..1. #t = {a}.", "p(1). p(N+1) :- p(N), N < 2. t :- p(N), N > 1. :- not t. :- not u."
    )
    first, second = small_sorts(program, [frozenset({3}), frozenset({4})], None)
    assert [(one.index, one.literals, one.larger) for one in first] == [
        (0, ("p(2)",), "#s = 0..2.")
    ]
    assert second == []


def test_a_definition_too_long_to_be_read_is_left_out() -> None:
    names = ", ".join(f"a_rather_long_name_{n}" for n in range(12))
    program = typed(f"#s = {{{names}}}. #t = {{x}}.", "q(x). p(X) :- q(X). t :- p(X). :- not t.")
    (told,) = small_sorts(program, [frozenset({3})], None)
    assert [(one.literals, one.larger) for one in told] == [(("p(x)",), "")]


def test_the_search_ends_at_its_deadline() -> None:
    program = typed("#s = 0..1. #t = {a}.", "p(1). p(N+1) :- p(N). :- not t.")
    with pytest.raises(Undecided):
        small_sorts(program, [frozenset({2})], 0.0)


SUMS = """sorts #item = {a, b}. #num = 0..50.
predicates price(#item, #num). total(#num). double(#num). t().
rules price(a, 40). price(b, 15). :- not t.
"""
CARRIED = """sorts #r = {r1, r2}. #o = {o1, o2, o3}. #carry = carry(#r, #o).
predicates does(#carry).
rules 1{does(carry(R,O)) : #r(R)}1 :- #o(O).
:- does(carry(R,O1)), does(carry(R,O2)), O1 != O2.
"""


@pytest.mark.parametrize(
    ("program", "lost", "old"),
    [
        (SUMS + "total(S) :- #sum{P,I : price(I,P)} = S. t :- total(_).", "total(55)", "#num = 0..50."),
        (SUMS + "double(D) :- price(a, P), D = P*2. t :- double(_).", "double(80)", "#num = 0..50."),
        (CARRIED, "r3", "#r = {r1, r2}."),
    ],
    ids=["sum", "comparison", "record"],
)  # fmt: skip
def test_what_is_calculated_or_chosen_inside_of_a_record_can_lie_outside(
    program: str, lost: str, old: str
) -> None:
    (cause,) = sparc.explain(program).causes
    (sort,) = (member for member in cause.members if member.is_sort)
    assert sort.place.text == old and lost in ", ".join(sort.instances)
    assert sort.larger is not None
    assert list(sparc.solve(program.replace(old, sort.larger), models=1))
