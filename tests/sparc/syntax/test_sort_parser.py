"""Sort expressions: their trees, the strength of their signs, and how far they nest."""

from __future__ import annotations

import inspect
import sys

import pytest

from sparc.errors import LimitError, SparcSyntaxError
from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.tree import (
    And,
    ConditionTest,
    Identifier,
    IdentifierList,
    IdentifierRange,
    Not,
    Number,
    NumericRange,
    Or,
    Record,
    RecordSort,
    SetExpression,
    SortName,
    TermSet,
    Variable,
)
from tests.support.sparc_texts import marked, sort

X, Y = Variable("X"), Variable("Y")
A, B = Identifier("a"), Identifier("b")


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("1..3", NumericRange(Number(1), Number(3))),
        ("n .. m", NumericRange(Identifier("n"), Identifier("m"))),
        ("1..z", NumericRange(Number(1), Identifier("z"))),
        ("a..b", IdentifierRange(A, B)),
        ("a..n", IdentifierRange(A, Identifier("n"))),
        ("{}", TermSet(())),
        ("{a, f(b,7)}", TermSet((A, Record("f", (B, Number(7)))))),
    ],
    ids=str,
)
def test_plain(text: str, tree: object) -> None:
    assert sort(text) == tree


def test_constants_count_from_where_they_are_defined() -> None:
    assert isinstance(sort("n..m", "#const n = 1. "), IdentifierRange)


def test_strength() -> None:
    a, b, c = SortName("a"), SortName("b"), SortName("c")
    assert sort("#a-#b+#c") == SetExpression("+", SetExpression("-", a, b), c)
    assert sort("#a-(#b+#c)") == SetExpression("-", a, SetExpression("+", b, c))
    assert sort("#a-#b*#c") == SetExpression("-", a, SetExpression("*", b, c))
    assert sort("#a*#b*#c") == SetExpression("*", SetExpression("*", a, b), c)
    assert sort("(#a-#b)*#c") == SetExpression("*", SetExpression("-", a, b), c)


def test_a_condition_reaches_up_to_an_operator_of_sets() -> None:
    tree = sort("f(#t(X),#t(Y)):X!=Y + g(#t)")
    assert isinstance(tree, SetExpression)
    assert tree.operator == "+"
    assert isinstance(tree.left, RecordSort)
    assert tree.left.condition == ConditionTest(X, "!=", Y)


def test_conditions() -> None:
    equal, less = ConditionTest(X, "=", Y), ConditionTest(X, "<", Y)

    def condition(text: str) -> object:
        tree = sort(f"f(#t(X),#t(Y)) : {text}")
        assert isinstance(tree, RecordSort)
        return tree.condition

    assert condition("X==Y or X<Y and X=Y") == Or((equal, And((less, equal))))
    assert condition("(X=Y or X<Y) and X=Y") == And((Or((equal, less)), equal))
    assert condition("not (X=Y)") == condition("not(X=Y)") == Not(equal)
    assert condition("not(X=Y or X<Y) and X<Y") == And((Not(Or((equal, less))), less))
    assert condition("X=Y and X<Y and X=Y") == And((equal, less, equal))
    assert condition("((X=Y))") == equal


def test_concatenation() -> None:
    tree = sort("[b][a,b][1..3][a..b][#t]")
    assert tree.parts == (  # type: ignore[attr-defined]
        IdentifierList((B,)),
        IdentifierList((A, B)),
        NumericRange(Number(1), Number(3)),
        IdentifierRange(A, B),
        SortName("t"),
    )


@pytest.mark.parametrize(
    "text",
    [
        "(" * 20_000 + "#a" + ")" * 20_000,
        "#a" + "-#a" * 20_000,
        "#a" + "+(#a" * 20_000 + ")" * 20_000,
        "#a" + "+#a-#a" * 20_000,
        "f(#a(X)) : " + "(" * 20_000 + "X = X" + ")" * 20_000,
        "f(#a(X)) : " + "not(" * 20_000 + "X = X" + ")" * 20_000,
        "{" + "f(" * 20_000 + "a" + ")" * 20_000 + "}",
    ],
    ids=["parentheses", "differences", "unions", "mixed", "condition", "not", "record"],
)
def test_how_deep_they_nest(text: str) -> None:
    with pytest.raises(LimitError, match="nested deeper than"):
        sort(text)


@pytest.mark.parametrize("operator", ["+", "*"])
@pytest.mark.parametrize("count", [64, 65, 1000, 10_000])
def test_long_unions_stay_shallow(operator: str, count: int) -> None:
    names = [f"s{i}" for i in range(count)]
    tree = sort(operator.join("#" + name for name in names))

    def leaves(node: object) -> list[str]:
        if isinstance(node, SetExpression):
            assert node.operator == operator
            return leaves(node.left) + leaves(node.right)
        assert isinstance(node, SortName)
        return [node.name]

    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + 150)
    try:
        assert leaves(tree) == names
    finally:
        sys.setrecursionlimit(limit)


def test_the_mend_of_a_sort() -> None:
    with pytest.raises(SparcSyntaxError) as info:
        parse(Source("x", "sorts #s = {b} + a. predicates rules "))
    assert info.value.hint == "a set is written in braces: {a}, {a, b}"


@pytest.mark.parametrize(
    ("expression", "place", "mend"),
    [
        ("{a b}", "b", "part the elements of a set by commas"),
        ("{1..3}", "..", "a range is no element"),
        ("[1]", "1", "a single number is written 1..1"),
        ("[{a}]", "{", "without braces: [a,b]"),
        ("1", "1", "a sort with one element is written {1}"),
        ("a", "a", "a sort with one element is written {a}"),
        ("1..-3", "-", "there are no negative numbers in a range"),
        ("1..3 + #a", "+", "give this expression a sort of its own"),
        ("[a][b] - #c", "-", "give this expression a sort of its own"),
        ("#a + [b]", "[", "give a range or a concatenation a sort of its own"),
        ("#a + 1..2", "1", "give a range or a concatenation a sort of its own"),
        ("#a + b", "b", "a set is written in braces: {b}"),
        ("#a / #b", "/", "union +, difference - and intersection *"),
        ("#a(X)", "(", "a sort takes a variable only inside a record"),
        ("#const", "#const", "directives come first"),
        ("{a} : X = Y", ":", "only a record has a condition"),
        ("f()", ")", "for the identifier write {f}"),
        ("f(a)", "a", "write #a, or a ground record in a set {f(…)}"),
        ("f(1..2)", "1", "give this one a sort of its own"),
        ("f(#a(X)) : X < 3", "3", "compares two variables; constants go into the sorts"),
        ("f(#a(X)) : (X < X+1)", "+", "compares two variables; constants go into the sorts"),
        ("f(#a(X)) : X < X, X = X", ",", 'joined by "and" or "or", not by a comma'),
        ("f(#a(X)) : (X < X, X = X)", ",", 'joined by "and" or "or", not by a comma'),
        ("f(#a(X)) : not X = X", "X", "write not(X = Y)"),
        ("f(#a(X)) : (X = X", ".", 'close the bracket: ")"'),
    ],
)
def test_what_is_no_sort_expression(expression: str, place: str, mend: str) -> None:
    found, hint = marked(f"sorts #s = {expression}. predicates rules ")
    assert found == place and mend in hint


@pytest.mark.parametrize(
    ("definition", "place", "mend"),
    [
        ("s = {a}", "s", "sort names begin with #: write #s"),
        ("#s(X) = {a}", "(", "a sort has no arguments where it is defined"),
        ("# = {a}", "=", ""),
        ("#s {a}", "{", '"=" behind the name: #s = …'),
        ("# s 1..3", "1", '"=" behind the name: #s = …'),
    ],
)
def test_what_is_no_definition(definition: str, place: str, mend: str) -> None:
    found, hint = marked(f"sorts {definition}. predicates rules ")
    assert found == place and mend in hint


def test_white_space_may_follow_the_sign_of_a_sort() -> None:
    assert sort("# a + {b}") == sort("#a + {b}")
