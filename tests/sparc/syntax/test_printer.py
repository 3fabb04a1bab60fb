"""Trees as text: what is printed reads back as the same tree."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.printer import print_program, print_statement, print_term
from sparc.syntax.sort_parser import LEFT_DEEP_OPERANDS
from sparc.syntax.tree import (
    Arithmetic,
    Program,
    SetExpression,
    SortDefinition,
    SortExpression,
    SortName,
    Term,
    Variable,
)
from tests.support.sparc_trees import programs, sort_expressions, terms


def reread(text: str) -> Program:
    return parse(Source("printed", text))


@settings(max_examples=50, deadline=None, derandomize=True)
@given(programs)
def test_reading_what_is_printed_gives_the_same_tree(program: Program) -> None:
    text = print_program(program)
    assert reread(text) == program
    assert print_program(reread(text)) == text


@pytest.mark.slow
@settings(max_examples=2_000, deadline=None)
@given(programs)
def test_reading_what_is_printed_gives_the_same_tree_often(program: Program) -> None:
    assert reread(print_program(program)) == program


@settings(max_examples=30, deadline=None, derandomize=True)
@given(sort_expressions, terms)
def test_parts_are_printed_without_marks(expression: SortExpression, term: Term) -> None:
    printed = print_statement(SortDefinition("s", expression))
    assert printed.startswith("#s = ") and printed.endswith(".")
    assert "\0" not in printed + print_term(term)
    assert " " not in print_term(term)


@pytest.mark.parametrize("count", [2, 64, 65, 66, 128, 129, 300, 1000])
@pytest.mark.parametrize("operator", ["+", "*"])
def test_long_chains_keep_their_shape(operator: str, count: int) -> None:
    text = operator.join(f"#s{i}" for i in range(count))
    program = reread(f"sorts #t = {text}. predicates rules ")
    assert reread(print_program(program)) == program


@settings(max_examples=15, deadline=None, derandomize=True)
@given(st.lists(st.sampled_from("+-*"), min_size=100, max_size=150))
def test_deep_chains_keep_their_shape(operators: list[str]) -> None:
    tree: SortExpression = SortName("s")
    for operator in operators:
        tree = SetExpression(operator, tree, SortName("t"))
    program = Program((), (SortDefinition("s", tree),), (), (), None)
    assert reread(print_program(program)) == program


def test_left_deep_union_longer_than_the_parser_makes() -> None:
    tree: SortExpression = SortName("s")
    for _ in range(2 * LEFT_DEEP_OPERANDS + 7):
        tree = SetExpression("+", tree, SortName("s"))
    program = Program((), (SortDefinition("s", tree),), (), (), None)
    assert reread(print_program(program)) == program


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("X+(1+2)", "X+(1+2)"),
        ("(X+1)+2", "X+1+2"),
        ("X - (n*2)", "X-n*2"),
        ("f( a ,(X/2)/3, X/(2*3))", "f(a,X/2/3,X/(2*3))"),
    ],
)
def test_terms(text: str, printed: str) -> None:
    program = reread(f"#const n = 1. predicates rules p({text}).")
    head = program.statements[0].head  # type: ignore[union-attr]
    assert print_term(head[0].arguments[0]) == printed  # type: ignore[index,union-attr]


WRITTEN = """#const n = 3.
#maxint = 100.

sorts
#a = 1..n.
#b = {a, f(b,7)}.
#c = (#a - #b) * #b + g(#a(X), #b) : not(X = Y) and (X < Y or X > Y).
#d = [b][1..3][a,c].

predicates
p(#a, #b).
rules(#a).
q().

rules
p(1,a).
p(X+1,a) | -q :- p(X,a), not -q, X != n, #b(a).
-rules(1..n).
rules:- q.
1 <= {p(X,Y) : rules(X), not q; q} < n :- q.
r : q :+ .
:+ q.
:~ q, p(X,Y). [X:]
#minimize{X@2,Y : p(X,Y)}.
:- 1 < #count{X,a : p(X,a); Y : q} <= n, #sum{X : p(X,a)} = X.

display
p.
-q.
p(1,X).
#a.
#b(f(X,Y)).
"""


def test_canonical_text_stays() -> None:
    assert print_program(reread(WRITTEN)) == WRITTEN


def test_empty_sections() -> None:
    assert print_program(reread("sorts predicates rules display")) == (
        "predicates\n\nrules\n\ndisplay\n"
    )


def test_statement_of_each_section() -> None:
    program = reread(WRITTEN)
    lines = WRITTEN.split("\n")
    for items in (
        program.directives,
        program.sorts,
        program.predicates,
        program.statements,
        program.display or (),
    ):
        for item in items:
            assert print_statement(item) in lines


def test_arithmetic_deeper_than_text_can_be_is_still_printed() -> None:
    term: Term = Variable("X")
    for _ in range(150):
        term = Arithmetic("-", Variable("Y"), term)
    assert print_term(term).count("(") == 149
