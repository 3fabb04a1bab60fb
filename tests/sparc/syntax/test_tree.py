"""The tree: compared by meaning, shown without places, never changed."""

from __future__ import annotations

import pytest

from sparc.source import Source, Span
from sparc.syntax import tree
from sparc.syntax.tree import (
    Atom,
    CrRule,
    DisplayItem,
    Number,
    Optimize,
    Program,
    Rule,
    Variable,
)

PLACE = Span(Source("x", "p(X)"), 0, 4)
X = Variable("X")


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (Atom("p", (X,)), Atom("p", (Variable("X", PLACE),), False, PLACE, PLACE)),
        (Rule((), ()), Rule((), (), PLACE)),
        (CrRule("r", (), ()), CrRule("r", (), (), PLACE, PLACE)),
        (Program((), (), (), (), None), Program((), (), (), (), None, Source("x", "rules"))),
    ],
    ids=["atom", "rule", "label", "program"],
)
def test_places_make_no_difference(one: object, other: object) -> None:
    assert one == other and hash(one) == hash(other) and repr(one) == repr(other)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (Atom("p", ()), Atom("p", (), negated=True)),
        (Variable("X"), Variable("Y")),
        (CrRule("r", (), ()), CrRule(None, (), ())),
        (DisplayItem("p", None), DisplayItem("p", ())),
        (Optimize(False, (X, X), X, ()), Optimize(False, (X, X), X, (), priority_index=1)),
        (Program((), (), (), (), None), Program((), (), (), (), ())),
    ],
    ids=["sign", "name", "label", "arguments", "priority", "display"],
)
def test_what_makes_a_difference(one: object, other: object) -> None:
    assert one != other


def test_a_node_is_never_changed() -> None:
    with pytest.raises(AttributeError):
        Number(3).value = 4  # type: ignore[misc]


def test_a_program_shows_the_text_that_was_read() -> None:
    text = "predicates p(). rules p."
    assert str(Program((), (), (), (), None, Source("x", text))) == text
    made = Program((), (), (), (Rule((Atom("p", ()),), ()),), None)
    assert "Atom(name='p', arguments=(), negated=False)" in str(made)
    assert "p &lt; q" in Program((), (), (), (), None, Source("x", "p < q"))._repr_html_()


def test_every_node_is_public_and_knows_its_place() -> None:
    nodes = {name: each for name, each in vars(tree).items() if isinstance(each, type)}
    own = {name for name, each in nodes.items() if each.__module__ == tree.__name__}
    assert own <= set(tree.__all__)
    for name in own - {"Program"}:
        assert "span" in nodes[name].__annotations__, name
