"""What the parser accepts and refuses, and the trees it makes."""

from __future__ import annotations

import inspect
import re
import sys
from pathlib import Path

import pytest

import sparc.syntax.parser
from sparc.errors import LimitError, SourceError, SourceErrors, SparcSyntaxError
from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.tree import (
    Aggregate,
    And,
    Arithmetic,
    Atom,
    Choice,
    ChoiceElement,
    Comparison,
    ConditionTest,
    CrRule,
    DisplaySort,
    Guard,
    Identifier,
    IdentifierList,
    IdentifierRange,
    Naf,
    Not,
    Number,
    NumericRange,
    Optimize,
    Or,
    Program,
    RangeFact,
    Record,
    RecordSort,
    Rule,
    SetExpression,
    SortAtom,
    SortName,
    Statement,
    Term,
    TermSet,
    Variable,
    WeakConstraint,
)
from tests.support.cases import Case, case_parameters, check_case

GRAMMAR = Path(sparc.__file__).with_name("grammar.txt")
X, Y = Variable("X"), Variable("Y")
A, B = Identifier("a"), Identifier("b")


def program(text: str) -> Program:
    return parse(Source("test.sparc", text))


def rules(text: str, constants: str = "#const n = 3. ") -> tuple[Statement, ...]:
    return program(f"{constants}predicates p(). rules\n{text}").statements


def rule(text: str) -> Rule:
    (statement,) = rules(text)
    assert isinstance(statement, Rule)
    return statement


def sort(text: str, constants: str = "#const n = 3. #const m = 4. ") -> object:
    return program(f"{constants}sorts #s = {text}. predicates rules ").sorts[0].expression


def faults(source: Source) -> list[SourceError]:
    try:
        parse(source)
    except SourceErrors as found:
        return list(found.errors)
    except SourceError as error:
        return [error]
    return []


@pytest.mark.parametrize("case", case_parameters("syntax_*.sparc"))
def test_cases(case: Case) -> None:
    check_case(case, faults)


class TestTerms:
    @pytest.mark.parametrize(
        ("text", "tree"),
        [
            ("X", X),
            ("_", Variable("_")),
            ("7", Number(7)),
            ("a", A),
            ("f(a,X)", Record("f", (A, X))),
            ("f (g(a) , 1)", Record("f", (Record("g", (A,)), Number(1)))),
            ("X+1", Arithmetic("+", X, Number(1))),
            ("X-n", Arithmetic("-", X, Identifier("n"))),
            ("X-Y-1", Arithmetic("-", Arithmetic("-", X, Y), Number(1))),
            ("X/Y*2", Arithmetic("*", Arithmetic("/", X, Y), Number(2))),
            ("X+Y*2", Arithmetic("+", X, Arithmetic("*", Y, Number(2)))),
            ("X*Y+2", Arithmetic("+", Arithmetic("*", X, Y), Number(2))),
            ("X*(Y+2)", Arithmetic("*", X, Arithmetic("+", Y, Number(2)))),
            ("X-(Y-1)", Arithmetic("-", X, Arithmetic("-", Y, Number(1)))),
            ("((X))", X),
            ("f(X+1,(Y))", Record("f", (Arithmetic("+", X, Number(1)), Y))),
        ],
        ids=str,
    )
    def test_trees(self, text: str, tree: Term) -> None:
        assert rule(f"p({text}).").head == (Atom("p", (tree,)),)
        assert rule(f":- 0 = {text}.").body == (Comparison(Number(0), "=", tree),)

    def test_places(self) -> None:
        (atom,) = rule("p :- q(f(X), (X+1) * 2).").body
        assert isinstance(atom, Atom)
        assert atom.span.text == "q(f(X), (X+1) * 2)"
        assert atom.name_span.text == "q"
        assert [term.span.text for term in atom.arguments] == ["f(X)", "(X+1) * 2"]
        assert str(atom.arguments[1].span.location) == "test.sparc:2:14"


class TestSorts:
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
    def test_plain(self, text: str, tree: object) -> None:
        assert sort(text) == tree

    def test_constants_count_from_where_they_are_defined(self) -> None:
        assert isinstance(sort("n..m", "#const n = 1. "), IdentifierRange)

    def test_strength(self) -> None:
        a, b, c = SortName("a"), SortName("b"), SortName("c")
        assert sort("#a-#b+#c") == SetExpression("+", SetExpression("-", a, b), c)
        assert sort("#a-(#b+#c)") == SetExpression("-", a, SetExpression("+", b, c))
        assert sort("#a-#b*#c") == SetExpression("-", a, SetExpression("*", b, c))
        assert sort("#a*#b*#c") == SetExpression("*", SetExpression("*", a, b), c)
        assert sort("(#a-#b)*#c") == SetExpression("*", SetExpression("-", a, b), c)

    def test_a_condition_reaches_up_to_an_operator_of_sets(self) -> None:
        tree = sort("f(#t(X),#t(Y)):X!=Y + g(#t)")
        assert isinstance(tree, SetExpression)
        assert tree.operator == "+"
        assert isinstance(tree.left, RecordSort)
        assert tree.left.condition == ConditionTest(X, "!=", Y)

    def test_conditions(self) -> None:
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

    def test_concatenation(self) -> None:
        tree = sort("[b][a,b][1..3][a..b][#t]")
        assert tree.parts == (  # type: ignore[attr-defined]
            IdentifierList((B,)),
            IdentifierList((A, B)),
            NumericRange(Number(1), Number(3)),
            IdentifierRange(A, B),
            SortName("t"),
        )


class TestStatements:
    def test_literals(self) -> None:
        q = Atom("q", ())
        assert rule("q :- -q, not q, not -q, #s(X), not #s(X), -#s(X), #s.").body == (
            Atom("q", (), True),
            Naf(q),
            Naf(Atom("q", (), True)),
            SortAtom("s", (X,)),
            Naf(SortAtom("s", (X,))),
            SortAtom("s", (X,), True),
            SortAtom("s", ()),
        )

    @pytest.mark.parametrize(
        ("text", "left", "right"),
        [
            ("{q}.", None, None),
            ("1{q}2.", Guard("<=", Number(1)), Guard("<=", Number(2))),
            ("n{q}n.", Guard("<=", Identifier("n")), Guard("<=", Identifier("n"))),
            ("{q} = 1.", None, Guard("=", Number(1))),
            ("1{q} == 1.", Guard("<=", Number(1)), Guard("=", Number(1))),
            ("X < {q} X*2.", Guard("<", X), Guard("<=", Arithmetic("*", X, Number(2)))),
        ],
    )
    def test_bounds(self, text: str, left: Guard | None, right: Guard | None) -> None:
        element = ChoiceElement(Atom("q", ()), ())
        assert rule(text).head == Choice((element,), left, right)

    def test_aggregates(self) -> None:
        (item,) = rule("q :- 1 < #count {X,f(a) : q, not q; Y : #s(Y)} == X.").body
        assert isinstance(item, Aggregate)
        assert item.function == "count"
        assert item.left == Guard("<", Number(1))
        assert item.right == Guard("=", X)
        assert [element.terms for element in item.elements] == [(X, Record("f", (A,))), (Y,)]

    def test_other_statements(self) -> None:
        q, s = Atom("q", ()), Atom("s", (X,))
        assert rules("p(1..n). -p(n..2).") == (
            RangeFact("p", Number(1), Identifier("n")),
            RangeFact("p", Identifier("n"), Number(2), True),
        )
        assert rules("lab : q :+ s(X). q | s(X) :+ . :+ q.") == (
            CrRule("lab", (q,), (s,)),
            CrRule(None, (q, s), ()),
            CrRule(None, (), (q,)),
        )
        assert rules(":~ q. :~ q. [1:] :~ q. [:X] :~ q. [n:2]") == (
            WeakConstraint((q,), None, None),
            WeakConstraint((q,), Number(1), None),
            WeakConstraint((q,), None, X),
            WeakConstraint((q,), Identifier("n"), Number(2)),
        )
        assert rules("#minimize{X:s(X)}. #maximize{1,X@n:q,s(X)}.") == (
            Optimize(False, (X,), None, (s,)),
            Optimize(True, (Number(1), X), Identifier("n"), (q, s), priority_index=1),
        )

    def test_display(self) -> None:
        assert program("predicates rules ").display is None
        assert program("predicates rules display").display == ()
        shown = program("predicates rules display #s. #s(X).").display
        assert shown == (DisplaySort("s", None), DisplaySort("s", X))

    def test_places_of_statements(self) -> None:
        text = "q :- p.\n  lab : q\n :+ . {q} 1. :~ q. [1:2] p(1..2)."
        found = [statement.span.text for statement in rules(text)]
        assert found == ["q :- p.", "lab : q\n :+ .", "{q} 1.", ":~ q. [1:2]", "p(1..2)."]


class TestLimits:
    """Whatever nests is refused before Python's own limit is met, with a place and a mend."""

    @pytest.mark.parametrize(
        "text",
        [
            "p(" + "f(" * 20_000 + "a" + ")" * 20_000 + ").",
            "p(" + "(" * 20_000 + "X" + ")" * 20_000 + ").",
            "p(" + "f(" * 20_000,
            "p(X" + "+1" * 20_000 + ").",
            "p(" + "1-(" * 20_000 + "X" + ")" * 20_000 + ").",
            "p(" + "1*(f(" * 20_000,
            "q :- X = " + "(" * 20_000 + "X.",
        ],
        ids=["records", "parentheses", "open", "sum", "nested sums", "mixed", "comparison"],
    )
    def test_terms(self, text: str) -> None:
        with pytest.raises(LimitError, match="nested deeper than 200 levels") as info:
            rules(text)
        assert info.value.span is not None
        assert info.value.span.location.line == 2

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
    def test_sorts(self, text: str) -> None:
        with pytest.raises(LimitError, match="nested deeper than"):
            sort(text)

    @pytest.mark.parametrize("operator", ["+", "*"])
    @pytest.mark.parametrize("count", [64, 65, 1000, 10_000])
    def test_long_unions_stay_shallow(self, operator: str, count: int) -> None:
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

    def test_what_lies_within_the_limit(self) -> None:
        depth = 190
        assert rules("p(" + "f(" * depth + "a" + ")" * depth + ").")
        assert rules("p(X" + "+1" * depth + ").")
        assert sort("#a" + "-#a" * depth)
        assert sort("f(#a(X)) : " + "not(" * 30 + "X = X" + ")" * 30)

    def test_long_flat_programs(self) -> None:
        assert len(rules("p(a). " * 3000)) == 3000
        assert len(rule("p :- " + "q, " * 3000 + "q.").body) == 3001
        assert len(rule("p | " * 3000 + "p.").head) == 3001  # type: ignore[arg-type]

    def test_numbers(self) -> None:
        assert rules("p(2147483647).")
        with pytest.raises(LimitError, match="larger than 2147483647"):
            rules("p(2147483648).")
        with pytest.raises(LimitError, match="larger than 2147483647"):
            rules("p(" + "9" * 20_000 + ").")


class TestPlaces:
    """Faults point at what a person must change."""

    @pytest.mark.parametrize(
        ("text", "hint"),
        [
            ("q :- - -p.", '"-" stands once: "- -p" is p'),
            ("q :- not .", None),
            ("q :- not'p'.", "write an identifier, such as main_hall"),
            ("q :- not X < 3.", "a comparison cannot be negated"),
            ("q :- p (a) (b).", "a parenthesis stands only in arithmetic and behind a name"),
            ("{p} {q}.", "a rule has one choice; does the one before end with a dot?"),
            ("{p} q.", None),
            ("p(X) < 3.", "a comparison cannot be a head"),
            (":~ p. [-1:1]", "there is no unary minus"),
            (":~ p. [(1):1]", None),
            ("#minimize{X : p(X) < 3}.", "there are no comparisons in #minimize"),
            ("#const n = 3.", "directives come first, before the sorts"),
            ("p. display :- p.", "rules stand before the section display"),
            ("p. display not p.", "write -p to show the negative literals"),
        ],
    )
    def test_the_mend(self, text: str, hint: str | None) -> None:
        with pytest.raises(SparcSyntaxError) as info:
            parse(Source("x", f"predicates p(). rules\n{text}"))
        found = info.value.hint
        assert found is None if hint is None else found is not None and found.startswith(hint)

    def test_the_mend_of_a_sort(self) -> None:
        with pytest.raises(SparcSyntaxError) as info:
            parse(Source("x", "sorts #s = {b} + a. predicates rules "))
        assert info.value.hint == "a set is written in braces: {a}, {a, b}"

    @pytest.mark.parametrize(
        ("text", "place", "covered"),
        [
            ("q :- not not p.", "1:10", "not"),
            ("q :- p(a)\nq.", "1:10", ""),
            ("q :- p(", "1:8", ""),
            ("q :-\n\tp(X;Y).", "2:5", ";"),
            ("q :- p('a').", "1:8", "'"),
        ],
    )
    def test_place(self, text: str, place: str, covered: str) -> None:
        head = "predicates p(). rules\n"
        with pytest.raises(SparcSyntaxError) as info:
            parse(Source("x", head + text, first_line=0))
        assert info.value.span is not None
        assert str(info.value.span.location) == f"x:{place}"
        assert info.value.span.text == covered

    def test_the_first_fault_counts(self) -> None:
        with pytest.raises(SparcSyntaxError) as info:
            rules("p :- q;\np :- 'a'.")
        assert info.value.span is not None
        assert info.value.span.location.line == 2


class TestGrammar:
    """``grammar.txt`` and the parser tell the same."""

    RULES = {
        name: " ".join(text.split())
        for name, text in re.findall(
            r"^(\w+) +=(.*(?:\n {4,}.*)*)", GRAMMAR.read_text(encoding="utf-8"), re.M
        )
    }
    SYNTAX = {name: text for name, text in RULES.items() if name.islower()}

    def test_every_name_is_explained(self) -> None:
        for name, text in self.SYNTAX.items():
            used = set(re.findall(r"\w+", re.sub(r'"[^"]*"', "", text)))
            assert used <= set(self.RULES), name

    def test_every_rule_is_read_by_a_method(self) -> None:
        parts = {"relation", "weight", "display_item"}  # of the rules that use them
        for name in parts:
            assert any(re.search(rf"\b{name}\b", text) for text in self.SYNTAX.values())
        for name in self.SYNTAX.keys() - parts:
            method = getattr(sparc.syntax.parser.ProgramParser, name)
            assert f"{name} = {self.SYNTAX[name]}" in " ".join(method.__doc__.split())
