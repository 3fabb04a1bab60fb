"""Names found in tokens are those that the tree has."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings

from sparc.language_server.symbols import index
from sparc.source import Source
from sparc.syntax.lexer import scan
from sparc.syntax.parser import parse
from sparc.syntax.printer import print_program
from sparc.syntax.tree import (
    Atom,
    DisplayItem,
    PredicateDeclaration,
    Program,
    RangeFact,
)
from tests.support.answer_corpus import examples
from tests.support.paths import ROOT
from tests.support.sparc_trees import programs


def nodes(value: Any) -> list[Any]:
    if isinstance(value, tuple):
        return [node for part in value for node in nodes(part)]
    names = getattr(type(value), "__match_args__", ())
    if not names or not type(value).__module__.startswith("sparc.syntax"):
        return []
    return [value, *(n for name in names for n in nodes(getattr(value, name)))]


def predicates_of(program: Program) -> set[tuple[int, str]]:
    kinds = (Atom, PredicateDeclaration, RangeFact, DisplayItem)
    return {(n.name_span.start, n.name) for n in nodes(program) if isinstance(n, kinds)}


def found(text: str, kind: str) -> set[tuple[int, str]]:
    return {(each.start, each.name) for each in index(scan(Source("x", text))) if each.kind == kind}


@settings(max_examples=25, deadline=None, derandomize=True)
@given(programs)
def test_predicates_are_those_of_the_tree(program: Program) -> None:
    text = print_program(program)
    read = parse(Source("x", text))
    due = {(place, name) for place, name in predicates_of(read)}
    assert found(text, "predicate") == due


@pytest.mark.slow
@settings(max_examples=1_000, deadline=None)
@given(programs)
def test_predicates_are_those_of_the_tree_often(program: Program) -> None:
    text = print_program(program)
    assert found(text, "predicate") == predicates_of(parse(Source("x", text)))


@pytest.mark.parametrize(
    "path",
    [*sorted(ROOT.glob("domains/*/*.sparc")), ROOT / "tests/golden/kitchen_sink.sparc"],
    ids=lambda path: "/".join(path.parts[-2:]),
)
def test_predicates_of_files(path) -> None:
    text = path.read_text(encoding="utf-8")
    assert found(text, "predicate") == predicates_of(parse(Source("x", text)))


def test_predicates_of_the_corpus() -> None:
    for example in examples():
        text = example.source.text
        assert found(text, "predicate") == predicates_of(parse(Source("x", text)))


def test_sorts_and_variables() -> None:
    text = "#const n=2. sorts #s=1..n. predicates p(#s). rules p(X) :- #s(X), X<n. p(X)."
    assert found(text, "sort") == {(19, "s"), (41, "s"), (60, "s")}
    variables = [each for each in index(scan(Source("x", text))) if each.kind == "variable"]
    assert len({each.statement for each in variables}) == 2
    assert [each.defines for each in index(scan(Source("x", text))) if each.kind == "constant"] == [
        True, False, False,
    ]  # fmt: skip
