"""The one style: what it looks like, and what it never changes."""

from __future__ import annotations

import random
import re

import pytest
from hypothesis import given, settings

from sparc.errors import SparcSyntaxError
from sparc.source import Source
from sparc.syntax.formatter import WIDTH, format_program
from sparc.syntax.lexer import tokenize
from sparc.syntax.parser import parse
from sparc.syntax.printer import print_program
from sparc.syntax.tree import Program
from tests.support.answer_corpus import examples
from tests.support.paths import ROOT
from tests.support.sparc_trees import programs

HEAD = "sorts #s = {a}. predicates p(#s). q(#s). rules\n"
FILES = [*sorted(ROOT.glob("domains/*/*.sparc")), ROOT / "tests/golden/kitchen_sink.sparc"]


def formatted(text: str) -> str:
    return format_program(Source("x", text))


def rules(text: str) -> str:
    """The rules of a program, formatted."""
    return formatted(HEAD + text).split("rules\n", 1)[1]


def comments(text: str) -> list[str]:
    return [comment.strip() for comment in re.findall(r"%[^\r\n]*", text)]


@pytest.mark.parametrize(
    ("written", "due"),
    [
        ("p( X ):-q(X),not  p(X) .", "p(X) :- q(X), not p(X).\n"),
        ("p(a).q(a).", "p(a). q(a).\n"),
        ("p(a).\n\n\n\nq(a).", "p(a).\n\nq(a).\n"),
        (":-p(X),X!=a.", ":- p(X), X != a.\n"),
        ("-p(a)|q(a):-p(a).", "-p(a) | q(a) :- p(a).\n"),
        ("p(X):-q(Y),X = Y + 1 * 2.", "p(X) :- q(Y), X = Y+1*2.\n"),
        ("1{p(X):q(X);q(a)}1:-p(a).", "1 {p(X) : q(X); q(a)} 1 :- p(a).\n"),
        ("p(X):-#count{Y,Z:p(Y),q(Z)}>=1,q(X).", "p(X) :- #count{Y, Z : p(Y), q(Z)} >= 1, q(X).\n"),
        ("r1:p(a):+q(a).", "r1: p(a) :+ q(a).\n"),
        (":~p(X).[2:1]\nq(a).", ":~ p(X). [2:1]\nq(a).\n"),
        ("#minimize{2@1,X:p(X)}.", "#minimize{2@1, X : p(X)}.\n"),
        ("p(X):-\nq(X),\n      not p(X).", "p(X) :-\n    q(X),\n    not p(X).\n"),
        ("p(a).%one\nq(a).   %   two", "p(a).  %one\nq(a).  %   two\n"),
        ("p(a) :- % why\n  % because\nq(a).", "p(a) :-  % why\n    % because\n    q(a).\n"),
    ],
)
def test_rules(written: str, due: str) -> None:
    assert rules(written) == due


def test_sections_and_sorts() -> None:
    text = "% top\n#const n=2.\nsorts\n\n#a=1..n.#b={x,f( y )}+#c\n+ g(#a(X),#a(Y)):X<Y.\n#c=[u][1..2].\npredicates p(#b).\n% says\nrules p(x).\n"
    assert formatted(text) == (
        "% top\n#const n = 2.\n\nsorts\n#a = 1..n. #b = {x, f(y)} + #c\n"
        "   + g(#a(X), #a(Y)) : X < Y.\n#c = [u][1..2].\n\npredicates\np(#b).\n\n"
        "% says\nrules\np(x).\n"
    )


def test_comments_of_neighbours_stand_in_one_column() -> None:
    assert rules("p(a).%x\nq(a) :- p(a).% y\n\nq(a). % z\n") == (
        "p(a).          % x\nq(a) :- p(a).  % y\n\nq(a).  % z\n".replace("% x", "%x")
    )


def test_long_lines_are_broken_at_commas_of_the_body() -> None:
    body = ", ".join(f"q(a_long_name_of_something_{i})" for i in range(9))
    lines = rules(f"p(a) :- {body}.").splitlines()
    assert len(lines) > 2 and all(len(line) <= WIDTH for line in lines)
    assert all(line.startswith("    q(") for line in lines[1:])


def test_an_identifier_that_is_spelt_like_a_section_opens_none() -> None:
    text = "#const rules=1.\nsorts #s={rules}. predicates p(#s). rules p(rules):-p(rules)."
    assert parse(Source("x", formatted(text))) == parse(Source("x", text))


@pytest.mark.parametrize("path", FILES, ids=lambda path: "/".join(path.parts[-2:]))
def test_files_of_ours(path) -> None:
    text = path.read_text(encoding="utf-8")
    once = formatted(text)
    assert formatted(once) == once
    assert comments(once) == comments(text)


def test_the_corpus() -> None:
    for example in examples():
        once = format_program(example.source)
        assert formatted(once) == once
        assert comments(once) == comments(example.source.text)


def scrambled(text: str, seed: int) -> str:
    """A program with other white space and comments between its tokens."""
    chance = random.Random(seed)
    between = [" ", "  ", "\n", "\n\n\n", " % note\n", "\n  % a line\n", "\t", "\r\n"]
    pieces: list[str] = []
    for token in tokenize(Source("x", text)):
        glued = token.kind == "-" or (
            token.kind == "identifier"
            and token.text
            in (
                "sorts",
                "predicates",
                "rules",
                "display",
            )
        )
        pieces.append(token.text)
        if not glued:
            pieces.append(chance.choice(between))
    return "".join(pieces)


@settings(max_examples=25, deadline=None, derandomize=True)
@given(programs)
def test_any_program_keeps_its_tree_and_its_comments(program: Program) -> None:
    text = scrambled(print_program(program), len(repr(program)))
    once = formatted(text)
    assert parse(Source("x", once)) == program
    assert comments(once) == comments(text)
    assert formatted(once) == once


@pytest.mark.slow
@settings(max_examples=3_000, deadline=None)
@given(programs)
def test_any_program_keeps_its_tree_and_its_comments_often(program: Program) -> None:
    text = scrambled(print_program(program), len(repr(program)))
    once = formatted(text)
    assert parse(Source("x", once)) == program
    assert comments(once) == comments(text)
    assert formatted(once) == once


def test_a_faulty_program_is_not_formatted() -> None:
    with pytest.raises(SparcSyntaxError):
        formatted(HEAD + "p(a")
