"""One answer set: its literals, the instances that hold in it, and values of forms."""

from __future__ import annotations

import pytest

import sparc
from sparc.answer_sets import Ground, GroundLiteral, GroundTerm
from sparc.explaining.answer_model import literal_of, nth_model, term_value
from sparc.explaining.instances import instance_text
from sparc.explaining.subsets import Undecided
from sparc.syntax.tree import Atom, Rule
from tests.support.explained import model_of

HEAD = """#const n = 2.
sorts
#s = {a,b}. #n = 0..4. #f = f(#s,#n).
predicates
p(#s). q(#s). r(#n). w(#f). t(). u().
rules
"""


def literal(text: str) -> GroundLiteral:
    name, _, inner = text.lstrip("-").partition("(")
    words = inner.rstrip(")").split(",") if inner else []
    values = tuple(int(word) if word.isdigit() else GroundTerm(word) for word in words)
    return GroundLiteral(name, values, text.startswith("-"))


@pytest.mark.parametrize(
    ("asked", "instances"),
    [
        ("p(a)", ["p(a)"]),
        ("p(b)", []),
        ("r(0)", ["r(0..1)", "r(0) :- t"]),
        ("r(1)", ["r(0..1)", "r(1) :- r(0)"]),
        ("r(4)", ["r(4) :- r(3)"]),
        ("t", ["t :- not u"]),
        ("u", []),
        ("-q(b)", ["-q(b) :- not p(b)"]),
        ("q(a)", ["{q(a)} :- p(a)"]),
    ],
)
def test_the_instances_that_give_a_literal(asked: str, instances: list[str]) -> None:
    rules = (
        "p(a). r(0..1). r(0) :- t. r(N+1) :- r(N). t :- not u. -q(X) :- not p(X). 1{q(X)}1 :- p(X)."
    )
    model = model_of(HEAD + rules)
    found = model.instances(literal(asked))
    assert [instance_text(one.form.statement, one.binding) for one in found] == instances
    assert model.instances(literal(asked)) == found
    assert (literal(asked) in model.literals) is bool(instances)


def test_which_statements_have_a_literal_in_their_heads() -> None:
    rules = "p(a) | -q(b). {q(X); p(X)} :- t. r(1..2). :- t. t :+ . #minimize{X : r(X)}."
    model = model_of(HEAD + rules)
    assert [model.givers(name, negated) for name, negated in
            (("p", False), ("q", True), ("q", False), ("r", False), ("t", False), ("u", False))
            ] == [[0, 1], [0], [1], [2], [4], []]  # fmt: skip
    assert model.head_names() == {"p", "-q", "q", "r", "t"}


def test_answer_sets_are_counted_as_they_are_shown() -> None:
    def sets(rules: str) -> list[set[str]]:
        typed = sparc.check(sparc.parse(HEAD + rules))
        found = []
        while (atoms := nth_model(typed, len(found) + 1, None)[0]) is not None:
            found.append({str(atom) for atom in atoms if str(atom)[0] != "_"})
        assert nth_model(typed, len(found) + 1, None) == (None, len(found))
        return found

    assert sorted(map(sorted, sets("t | u. p(a)."))) == [["p(a)", "t"], ["p(a)", "u"]]
    assert sets("{t}. {u}. #minimize{1 : t}. #maximize{1 : u}.") == [{"u"}]
    assert len(sets("{t}. {u}. display t.")) == 2
    assert sets("t. -t.") == []


def test_time_that_is_up_is_no_answer() -> None:
    typed = sparc.check(sparc.parse(HEAD + "t | u."))
    with pytest.raises(Undecided):
        nth_model(typed, 1, 0.0)


def test_where_literals_hold_together() -> None:
    model = model_of(HEAD + "p(a). r(0..2). q(X) :- p(X), r(N), N > 1.")
    (_, _, statement) = model.typed.program.statements
    assert isinstance(statement, Rule)
    assert model.solutions(2, statement.body) == [{"X": GroundTerm("a"), "N": 2}]
    assert len(model.solutions(2, statement.body[:2])) == 3
    assert model.solutions(2, ()) == [{}]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("X", 3), ("a", GroundTerm("a")), ("X+1", 4), ("f(a,X)", GroundTerm("f", (GroundTerm("a"), 3))),
        ("Y", None), ("f(Y,X)", None), ("X/0", None),
    ],
)  # fmt: skip
def test_values_of_terms(text: str, value: Ground | None) -> None:
    (statement,) = sparc.parse(f"predicates p(). rules p({text}). ").statements
    (atom,) = statement.head  # type: ignore[union-attr, misc]
    assert isinstance(atom, Atom)
    assert term_value(atom.arguments[0], {"X": 3}) == value
    expected = None if value is None else GroundLiteral("p", (value,))
    assert literal_of(atom, {"X": 3}) == expected
