"""Sorts in clingo's words: what is listed here, and what clingo lists."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.typed_program import TypedProgram
from sparc.errors import LimitError
from sparc.sorts.extents import Records
from sparc.syntax.cursor import MAX_NUMBER
from sparc.translation import sort_facts
from sparc.translation.sort_facts import SortFacts, conjunction, interval

BASE = "#s = {a,b}. #n = 0..5. #one = {x}. #mix = {3,x}."


def typed(sorts: str, before: str = "") -> TypedProgram:
    return sparc.check(sparc.parse(f"{before} sorts {BASE} {sorts} predicates rules "))


@pytest.mark.parametrize(
    ("definition", "lines"),
    [
        ("2..4", ["__z(2..4)."]),
        ("#n", ["__n(0..5).", "__z(X):-__n(X)."]),
        ("{b,a}", ["__z(b;a)."]),
        ("{b}", ["__z(b)."]),
        ("a..c", ["__z(a;b;c)."]),
        ("[k][1..2]", ["__z(k1;k2)."]),
        ("#n - {2}", ["__z(0;1;3;4;5)."]),
        ("#n * {1,9}", ["__z(1)."]),
        ("#s + #n + {z}", ["__z(a;b).", "__z(0..5).", "__z(z)."]),
        ("#s - {a,b} + {c}", ["__z(c)."]),
        ("f(#s,#n)", ["__z(f(X1,X2)):-__s(X1),__n(X2).", "__n(0..5).", "__s(a;b)."]),
        ("f(#n(X),#n(Y)) : X < Y", ["__z(f(X1,X2)):-__n(X1),__n(X2),X1<X2.", "__n(0..5)."]),
        ("f(#n(X),#n(Y)) : not(X < Y)", ["__z(f(X1,X2)):-__n(X1),__n(X2),X1>=X2.", "__n(0..5)."]),
        ("f(#n(X),#n(Y)) : not(X < Y or X = Y)",
         ["__z(f(X1,X2)):-__n(X1),__n(X2),X1>=X2,X1!=X2.", "__n(0..5)."]),
        ("f(#n(X),#n(Y)) : not(X < Y and X = Y)",
         ["__z(f(X1,X2)):-__n(X1),__n(X2),X1>=X2.", "__z(f(X1,X2)):-__n(X1),__n(X2),X1!=X2.",
          "__n(0..5)."]),
        ("f(#one,#n(X),#mix(Y)) : X < Y", ["__z(f(x,0,3);f(x,1,3);f(x,2,3))."]),
    ],
)  # fmt: skip
def test_definitions(definition: str, lines: list[str]) -> None:
    program = typed(f"#z = {definition}.")
    facts = SortFacts(program)
    assert facts.named_key(program.sorts["z"]) == "__z"
    assert facts.definitions() == lines
    assert facts.definitions() == [line for line in lines if line.startswith("__z(X):-__n(X)")]


def test_a_large_difference_is_left_to_clingo(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sort_facts, "_LISTED_HERE", 5)
    program = typed("#d = #n - #s. #i = #n * {7,1,2,3,4,5,6}.")
    facts = SortFacts(program)
    facts.key(program.sorts["d"].extent)
    assert facts.definitions() == ["__d(X):-__n(X),not __s(X).", "__s(a;b).", "__n(0..5)."]
    facts.key(program.sorts["i"].extent)
    assert facts.definitions() == ["__i(X):-__n(X),___1(X).", "___1(7;1;2;3;4;5;6)."]


def test_each_sort_is_defined_once() -> None:
    program = typed("#u = #s + #n.")
    facts = SortFacts(program)
    for _ in range(2):
        for name in ("s", "u"):
            assert facts.key(program.sorts[name].extent) == f"__{name}"
    assert facts.definitions() == ["__u(X):-__s(X).", "__u(0..5).", "__s(a;b)."]


def test_many_elements_become_facts_of_their_own() -> None:
    program = typed("#w = [k][1..501].")
    facts = SortFacts(program)
    facts.key(program.sorts["w"].extent)
    (line,) = facts.definitions()
    assert line.startswith("__w(k1).__w(k2).") and line.count("__w(") == 501


def test_what_is_too_large_is_refused_at_its_definition() -> None:
    program = typed("#big = 1..9000000.", "#maxint = 9000000.")
    facts = SortFacts(program)
    facts.key(program.sorts["big"].extent)
    with pytest.raises(LimitError, match="sort #big has 9,000,000 elements") as caught:
        facts.definitions()
    assert caught.value.span is not None and caught.value.span.text == "#big"


@pytest.mark.parametrize(
    ("condition", "tests"),
    [
        ("", []),
        (": X < Y", [(0, "<", 1)]),
        (": not(X != Y) and Y >= X", [(0, "=", 1), (1, ">=", 0)]),
        (": X < Y or Y < X", None),
    ],
)
def test_a_condition_as_comparisons(
    condition: str, tests: list[tuple[int, str, int]] | None
) -> None:
    box = typed(f"#z = f(#n(X),#n(Y)) {condition}.").sorts["z"].extent
    assert isinstance(box, Records) and conjunction(box) == tests


@pytest.mark.parametrize(
    ("one", "other", "compared"),
    [
        ("#n", "#n", True), ("#s", "a..c", True), ("#n", "#s", False), ("#mix", "#n", False),
        ("#n", "[1..2][1..2]", True), ("#s", "[k][1..2]", True), ("#n", "#n - {1}", True),
        ("#n", "#n + {7}", True), ("#mix", "#mix", False), ("#s", "#mix * #one", False),
    ],
)  # fmt: skip
def test_clingo_compares_elements_of_one_kind_alone(one: str, other: str, compared: bool) -> None:
    """Numbers come before identifiers for clingo; in a condition neither comes before the other."""
    box = typed(f"#l = {one}. #r = {other}. #z = f(#l(X),#r(Y)) : X != Y or X < Y.").sorts["z"]
    assert isinstance(box.extent, Records)
    facts = SortFacts(typed(""))
    facts.key(box.extent)
    assert any(":-" in line for line in facts.definitions()) is compared


def test_counting_ends_at_the_greatest_number() -> None:
    assert interval(1, 3) == "1..3"
    assert interval(0, MAX_NUMBER - 1) == f"0..{MAX_NUMBER - 1}"
    assert interval(5, MAX_NUMBER) == f"5..{MAX_NUMBER - 1};{MAX_NUMBER}"
