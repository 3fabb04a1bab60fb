"""What the parser accepts and refuses, and the trees it makes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import sparc.syntax.parser
from sparc.errors import SparcSyntaxError
from sparc.source import Source
from sparc.syntax.parser import parse
from tests.support.cases import Case, case_parameters, check_case
from tests.support.sparc_texts import faults, rule, rules, sort

GRAMMAR = Path(sparc.__file__).with_name("grammar.txt")


@pytest.mark.parametrize("case", case_parameters("syntax_*.sparc"))
def test_cases(case: Case) -> None:
    check_case(case, faults)


class TestLimits:
    """Whatever nests is refused before Python's own limit is met, with a place and a mend."""

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
