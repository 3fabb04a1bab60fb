"""Heads of rules against literals and forms of literals."""

from __future__ import annotations

import pytest

import sparc
from sparc.answer_sets import Ground, GroundTerm
from sparc.explaining.instances import tree_term
from sparc.explaining.matching import match_atom
from sparc.syntax.printer import print_term
from sparc.syntax.tree import Atom, Record


def atom(text: str) -> Atom:
    (statement,) = sparc.parse(f"predicates p(). rules {text}. ").statements
    (only,) = statement.head  # type: ignore[union-attr, misc]
    assert isinstance(only, Atom)
    return only


def shown(value: Ground | Record) -> str:
    return print_term(tree_term(value))


@pytest.mark.parametrize(
    ("head", "wanted", "values", "equations"),
    [
        ("p", "p", {}, []),
        ("p(X)", "p(a)", {"X": "a"}, []),
        ("p(X,X)", "p(a,a)", {"X": "a"}, []),
        ("p(X,X)", "p(a,b)", None, []),
        ("p(a)", "p(b)", None, []),
        ("p(a)", "-p(a)", None, []),
        ("p(a)", "q(a)", None, []),
        ("p(a)", "p(a,a)", None, []),
        ("p(f(X,1))", "p(f(g(b),1))", {"X": "g(b)"}, []),
        ("p(f(X,1))", "p(f(X,2))", None, []),
        ("p(f(X))", "p(g(a))", None, []),
        ("p(f(X))", "p(f(a,b))", None, []),
        ("p(f(X))", "p(a)", None, []),
        ("p(X+1)", "p(4)", {"X": "3"}, []),
        ("p(X-2)", "p(4)", {"X": "6"}, []),
        ("p(X*2)", "p(4)", {}, ["X*2"]),
        ("p(1+X)", "p(4)", {}, ["1+X"]),
        ("p(X+1,X)", "p(4,3)", {"X": "3"}, ["X+1"]),
        ("p(X+1)", "p(a)", None, []),
        ("p(X)", "p(Y)", {}, []),
        ("p(X)", "p(f(Y,a,Y))", {"X": "f(_V900,a,_V900)"}, []),
        ("p(f(X))", "p(Y)", {}, []),
        ("p(X+1)", "p(Y)", {}, []),
        ("p(X,X)", "p(f(Y),f(a))", None, []),
    ],
)
def test_a_head_and_what_is_wanted(
    head: str, wanted: str, values: dict[str, str] | None, equations: list[str]
) -> None:
    found = match_atom(atom(head), atom(wanted))
    if values is None:
        assert found is None
        return
    assert found is not None
    assert {name: shown(value) for name, value in found[0].items()} == values
    assert [print_term(each.left) for each in found[1]] == equations
    assert all(each.operator == "=" for each in found[1])


def test_a_value_is_a_term_of_the_solver() -> None:
    found = match_atom(atom("p(X,Y)"), atom("p(f(1),2)"))
    assert found is not None and found[0] == {"X": GroundTerm("f", (1,)), "Y": 2}
