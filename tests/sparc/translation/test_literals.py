"""Heads and bodies in clingo's words, and the variables that a statement has."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.typed_program import TypedProgram
from sparc.errors import NumberError
from sparc.syntax.tree import Rule
from sparc.translation.guards import NoInstance
from sparc.translation.literals import Literals, global_names

HEAD = """
#const n = 3. #maxint = 2000000.
sorts
#s = {a,b}. #n = 0..5. #t = {b,c}. #much = 1900000..2000000.
predicates
p(#s). q(#s). t(#t). n(#n). e(#s,#s). z(). m(#s,#much).
rules
"""


def typed(rule: str) -> TypedProgram:
    return sparc.check(sparc.parse(HEAD + rule))


def written(rule: str) -> tuple[str, list[str], list[str]]:
    """The head, the body and the guards of a rule."""
    program = typed(rule)
    (statement,) = program.program.statements
    assert isinstance(statement, Rule)
    literals = Literals(program)
    literals.index = 0
    body = literals.body(statement.body, statement.head)
    return literals.head(statement.head), body, literals.guards


@pytest.mark.parametrize(
    ("rule", "head", "body", "due"),
    [
        ("p(X) :- q(X).", "p(X)", ["q(X)"], []),
        ("z :- not p(X), q(X).", "z", ["not p(X)", "q(X)"], []),
        ("z :- not p(X), not -q(X).", "z", ["not p(X)", "not -q(X)"], ["__s(X)"]),
        ("z :- #s(X), not t(X).", "z", ["not t(X)"], ["__s(X)", "__t(X)"]),
        ("z :- not #t(X), p(X).", "z", ["not __t(X)", "p(X)"], []),
        ("z :- n(X), X < n.", "z", ["n(X)", "X<3"], []),
        ("z :- X*2 = 4.", "z", ["X*2=4"], ["__nat(X)"]),
        ("p(a) | -t(b).", "p(a)|-t(b)", [], []),
        ("{p(X) : e(X,Y), not q(Y); z} :- n(_).", "{p(X): e(X,Y),not q(Y);z}", ["n(_)"], []),
        ("1{p(X)}n.", "1<={p(X): __s(X)}<=3", [], []),
        ("{t(X) : p(X)} = 1.", "{t(X): p(X),__t(X)}=1", [], []),
        ("z :- #count{X : p(X)} > 1.", "z", ["#count{X: p(X)}>1"], []),
        ("z :- p(X), #count{X : q(X)} > 1.", "z", ["p(X)", "#count{_V1: q(_V1)}>1"], []),
        ("z :- #count{X : p(X)}, p(a).", "z", ["p(a)"], []),
        ("z :- 1 <= #sum{2,X : p(X); 3 : q(a)} <= n.", "z",
         ["1<=#sum{2,X: p(X);3: q(a)}<=3"], []),
        ("z :- #count{X : p(X), not t(X)} > 1.", "z", ["#count{X: p(X),not t(X),__t(X)}>1"], []),
    ],
)  # fmt: skip
def test_statements(rule: str, head: str, body: list[str], due: list[str]) -> None:
    assert written(rule) == (head, body, due)


def test_an_element_without_instance_is_left_out() -> None:
    assert written("{p(X) : t(X), #s(X); p(a) : not #s(a)}.")[0] == "{p(X): t(X),__s(X)}"
    assert written("z :- #count{X : p(X), not #s(a); Y : q(Y)} > 0.")[1] == ["#count{Y: q(Y)}>0"]


def test_a_body_that_a_sort_forbids_has_no_instance() -> None:
    with pytest.raises(NoInstance):
        written("z :- not #s(a).")


def test_what_is_derived_is_kept() -> None:
    literals = Literals(typed("p(a) | -q(b) :- t(b)."))
    (statement,) = literals.typed.program.statements
    assert isinstance(statement, Rule)
    literals.head(statement.head)
    assert literals.derived == {("p", 1, False), ("q", 1, True)}


def test_a_sum_that_may_not_fit_is_counted_exactly() -> None:
    _, (_, aggregate), _ = written("z :- p(Y), #sum{N,X : n(N), e(X,Y)} > 3.")
    assert aggregate == "#sum{N,X: n(N),e(X,Y)}>3"
    _, (_, aggregate), _ = written("z :- p(Y), #sum{W,X : m(X,W), e(X,Y)} > 3.")
    assert aggregate == "#sum{W,X: m(X,W),e(X,Y),@total(0,(0,0,Y),(W,X,0))=0}>3"


def test_a_weight_beyond_all_numbers_is_refused() -> None:
    rule = "z :- #sum{2000000*2000 : p(a)} > 3."
    with pytest.raises(NumberError, match="4000000000 is beyond") as caught:
        written(rule)
    assert caught.value.span is not None and caught.value.span.text == "2000000*2000"


@pytest.mark.parametrize(
    ("rule", "names"),
    [
        ("p(X) :- e(X,Y), not q(Y), n(N), N+M > 1.", "X Y N M"),
        ("N {p(X) : q(X)} K :- n(N), n(K).", "N K"),
        ("z :- #count{X : e(X,Y)} = N, n(N), p(Z).", "N Z"),
        ("p(_) :- e(_,X).", "X"),
    ],
)
def test_the_variables_outside_of_elements(rule: str, names: str) -> None:
    (statement,) = typed(rule).program.statements
    assert isinstance(statement, Rule)
    assert global_names(statement.head, statement.body) == names.split()
