"""Programs keep their meaning on the way to clingo, and become lean text."""

from __future__ import annotations

import time

import pytest

import sparc
from sparc.errors import LimitError
from sparc.source import Source
from sparc.translation.asp_program import AspProgram
from tests.support.answer_corpus import Example, answer_sets, parameters
from tests.support.random_programs import random_program

SORTS = """
sorts
#s = {a,b}. #t = {b,c}. #n = 0..5. #m = 2..9.
#f = at(#s,#n) + in(#s). #g = g(#s(X),#s(Y)) : X != Y. #l = {k(a,b), k(b,a)}.
predicates
p(#s). q(#s). pt(#t). n(#n). m(#m). h(#f,#n). w(#g). k(#l). z(). e(#s,#s).
rules
"""


def asp(rules: str) -> AspProgram:
    return sparc.to_asp(SORTS + rules)


def rule_lines(rules: str) -> list[str]:
    """The lines that our rules became, without sort facts."""
    program = asp(rules)
    return [
        line
        for line, span in zip(program.text.split("\n"), program.line_spans, strict=False)
        if span is not None
    ]


@pytest.mark.parametrize("example", parameters())
def test_answer_sets(example: Example) -> None:
    assert answer_sets(example.source) == example.expected


@pytest.mark.parametrize(
    ("rule", "expected"),
    [
        ("p(a).", "p(a)."),
        ("p(X).", "p(X):-__s(X)."),
        ("q(X) :- p(X).", "q(X):-p(X)."),
        ("pt(X) :- p(X).", "pt(X):-p(X),__t(X)."),
        ("q(X) :- not p(X).", "q(X):-not p(X),__s(X)."),
        ("q(X) :- p(X), #s(X).", "q(X):-p(X)."),
        ("z :- #n(X), #m(X).", "z:-__n(X),__m(X)."),
        ("z :- not #t(X), p(X).", "z:-not __t(X),p(X)."),
        ("n(X+1) :- n(X).", "n(X+1):-n(X),X<=4."),
        ("z :- n(X), not n(X-2).", "z:-n(X),not n(X-2),X>=2."),
        ("m(X+1) :- n(X).", "m(X+1):-n(X),X>=1."),
        ("m(X*2) :- n(X).", "m(X*2):-n(X),__m(X*2)."),
        ("h(at(X,0),I+1) :- h(at(X,0),I), p(X).", "h(at(X,0),I+1):-h(at(X,0),I),p(X),I<=4."),
        ("h(at(X,Y),I) :- n(I).", "h(at(X,Y),I):-n(I),__s(X),__n(Y)."),
        ("p(X) :- h(in(X),I).", "p(X):-h(in(X),I)."),
        ("w(g(X,a)) :- p(X).", "w(g(X,a)):-p(X),X!=a."),
        ("k(k(X,Y)) :- e(X,Y).", "k(k(X,Y)):-e(X,Y),__l(k(X,Y))."),
        ("z :- p(_), not q(_).", "z:-p(_),not q(_V1),__s(_V1)."),
        ("z :- X+1 = 3.", "z:-X+1=3,__nat(X)."),
        ("{p(X)}.", "{p(X): __s(X)}."),
        ("1{p(X) : q(X)}1.", "1<={p(X): q(X)}<=1."),
        ("{p(a)} = 1.", "{p(a)}=1."),
        ("{p(X)} :- q(X).", "{p(X)}:-q(X)."),
        ("p(X) | q(X).", "p(X)|q(X):-__s(X)."),
        ("z :- #count{X : p(X)} = 1.", "z:-#count{X: p(X)}=1."),
        ("z :- p(X), #count{X : e(X,X)} = 1.", "z:-p(X),#count{_V1: e(_V1,_V1)}=1."),
        ("z :- p(X), #count{Y : not e(X,Y)} = 1.", "z:-p(X),#count{Y: not e(X,Y),__s(Y)}=1."),
        ("#minimize{I@2,a0 : n(I)}.", None),
        (":- p(X), -p(X).", ":-p(X),-p(X)."),
        ("n(1..3).", "n(1..3)."),
        ("-n(1..3).", "-n(1..3)."),
    ],
)
def test_pairs(rule: str, expected: str | None) -> None:
    if expected is None:
        with pytest.raises(sparc.SourceErrors):
            rule_lines(rule)
    else:
        assert rule_lines(rule) == [expected]


def test_a_consistency_restoring_rule() -> None:
    assert rule_lines("r : p(X) :+ q(X), not z.") == [
        "{___appl(r(X))}:-q(X),not z.",
        ":~___appl(r(X)).[1@2,r(X)]",
        "p(X):-___appl(r(X)).",
    ]


def test_labels_skip_those_in_use() -> None:
    lines = rule_lines("r_0 : p(a) :+ . p(b) :+ .")
    assert lines[0] == "{___appl(r_0)}."
    assert lines[3] == "{___appl(r_1)}."


def test_cr_rules_rank_above_every_level() -> None:
    assert ":~___appl(r).[1@8,r]" in rule_lines("r : z :+ . #minimize{X@7 : n(X)}.")


@pytest.mark.parametrize("rule", ["w(h(X)) :- p(X).", "k(k(X,X,X)) :- p(X)."])
def test_records_of_no_sort_are_refused(rule: str) -> None:
    with pytest.raises(sparc.SourceErrors, match="no sort has a record"):
        rule_lines(rule)


def test_rules_without_instance_vanish() -> None:
    assert rule_lines("w(in(X)) :- p(X). n(X) :- h(g(X,X),X).") == []


def test_only_needed_sorts_are_listed() -> None:
    program = asp("q(X) :- p(X). p(a).")
    assert "__" not in program.text


def test_line_spans_point_into_the_source() -> None:
    source = Source(
        "x.sparc", "sorts #s = {a}. predicates p(#s). rules\np(a).\n-p(X) :-\n not p(X).\n"
    )
    program = sparc.to_asp(source)
    assert [span and span.location.line for span in program.line_spans] == [2, 3, None]
    assert program.annotated().startswith(
        "% x.sparc:2\np(a).\n% x.sparc:3\n-p(X):-not p(X),__s(X).\n% sorts\n"
    )


def test_a_sort_too_large_to_list_is_refused() -> None:
    text = "sorts #n = 1..2000. #f = f(#n,#n,#n). predicates p(#f). rules p(X)."
    with pytest.raises(LimitError, match=r"#f has 8,000,000,000 elements") as caught:
        sparc.to_asp(text)
    assert caught.value.span is not None and caught.value.span.text == "#f"


def test_a_sort_too_large_to_list_costs_nothing_elsewhere() -> None:
    text = (
        "sorts #n = 1..2000. #f = f(#n,#n,#n,#n). #g = #f + #n. predicates p(#g). q(#n). rules\n"
        "p(f(1,2,3,4)). q(X) :- p(f(X,Y,Z,U)). p(f(X,X,X,X)) :- q(X). p(X) :- p(X), not p(7)."
    )
    start = time.process_time()
    assert answer_sets(text) == ("{p(f(1,1,1,1)), p(f(1,2,3,4)), q(1)}",)
    assert time.process_time() - start < 2


def fit_the_sorts(seed: int) -> None:
    from sparc.sorts.values import from_ground

    try:
        typed = sparc.check(sparc.parse(random_program(seed)))
    except sparc.SourceErrors:
        return
    for answer_set in sparc.solve(typed, models=20):
        for literal in answer_set.literals:
            sorts = typed.predicates[literal.name].sorts
            assert len(sorts) == len(literal.arguments)
            for sort, term in zip(sorts, literal.arguments, strict=True):
                assert from_ground(term) in sort.extent


def test_derived_literals_fit_the_sorts() -> None:
    """Every literal of an answer set lies in the sorts of its predicate."""
    for seed in range(40):
        fit_the_sorts(seed)


def test_translation_is_quick() -> None:
    """A program of 400 lines is parsed, checked and translated in some hundredths of a second."""
    rules = "\n".join(
        f"h(at(X,{i % 5}),I+1) :- h(at(X,{i % 5}),I), not -h(at(X,{i % 5}),I+1), p(X), n(I)."
        for i in range(400)
    )
    sparc.to_asp(SORTS + rules)
    best = min(_seconds(SORTS + rules) for _ in range(3))
    assert best < 0.5


def _seconds(text: str) -> float:
    start = time.process_time()
    sparc.to_asp(text)
    return time.process_time() - start
