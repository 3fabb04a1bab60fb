"""The small sections: directives, declarations and the display."""

from __future__ import annotations

import pytest

from sparc.source import Source
from sparc.syntax.tree import (
    ConstDirective,
    DisplayItem,
    DisplaySort,
    Identifier,
    MaxintDirective,
    Number,
    PredicateDeclaration,
    SortName,
    Variable,
)
from tests.support.sparc_texts import faults, marked, program

X = Variable("X")


def test_display() -> None:
    assert program("predicates rules ").display is None
    assert program("predicates rules display").display == ()
    shown = program("predicates rules display #s. #s(X).").display
    assert shown == (DisplaySort("s", None), DisplaySort("s", X))


@pytest.mark.parametrize(
    ("before", "place", "mend"),
    [
        ("#const = 3.", "=", ""),
        ("#const N = 3.", "N", ""),
        ("#const n = -3.", "-", "there are no negative numbers: write 0-n"),
        ("#const n = 1+2.", "+", "a directive takes a plain number"),
        ("#maxint = 3", "", 'every statement ends with "."'),
        ("const n = 3.", "const", "write #const"),
    ],
)
def test_what_is_no_directive(before: str, place: str, mend: str) -> None:
    found, hint = marked(f"{before} predicates p(). rules p.")
    assert found == place and mend in hint


@pytest.mark.parametrize(
    ("declaration", "place", "mend"),
    [
        ("p.", ".", "a predicate without arguments is declared p()."),
        ("p(s).", "s", "sort names begin with #: write #s"),
        ("p(#s(X)).", "(", "the arguments of a predicate are plain sort names"),
        ("p(#s #s).", "#s", ""),
        ("P().", "P", "begin with a lower-case letter: p"),
        ("p()", "", 'every statement ends with "."'),
    ],
)
def test_what_is_no_declaration(declaration: str, place: str, mend: str) -> None:
    found, hint = marked(f"sorts #s = {{a}}. predicates {declaration} rules ")
    assert found == place and mend in hint


@pytest.mark.parametrize(
    ("item", "place", "mend"),
    [
        ("p, p.", ",", 'each item ends with "."'),
        ("p/1.", "/", "write p. to show all of it"),
        ("not p.", "not", "write -p to show the negative literals"),
        ("-#s.", "#s", "a sort has no negation"),
        ("- p.", "-", 'write "-p" without a space'),
        ("#s(X,Y).", "#s(X,Y)", "write #s. or #s(X)."),
        ("#show.", "#show", "goes into the section display"),
        ("p :- p.", "p", "rules stand before the section display (line 1)"),
    ],
)
def test_what_is_not_displayed(item: str, place: str, mend: str) -> None:
    found, hint = marked(f"predicates p(). rules p. display {item}")
    assert found == place and mend in hint


def test_directives_and_declarations() -> None:
    tree = program("#const n = 3. #maxint = n. predicates p(# s, #t). q(). rules ")
    assert tree.directives == (
        ConstDirective("n", Number(3)),
        MaxintDirective(Identifier("n")),
    )
    assert tree.predicates == (
        PredicateDeclaration("p", (SortName("s"), SortName("t"))),
        PredicateDeclaration("q", ()),
    )


def test_items_of_the_display() -> None:
    assert program("predicates rules display p. -p(X,a).").display == (
        DisplayItem("p", None),
        DisplayItem("p", (X, Identifier("a")), True),
    )


def test_a_rule_among_the_items_has_its_own_faults_too() -> None:
    found = faults(Source("x", "predicates p(). rules p. display\np :- p.\np(X :- p.\nq."))
    assert [str(fault.span.location) for fault in found if fault.span] == ["x:2:1", "x:3:5"]


@pytest.mark.parametrize(
    ("text", "place", "mend"),
    [
        ("predicates p(). q(). p :- q. p.", "2:1", '"rules" before this'),
        ("predicates p(). rule\np.", "1:17", 'did you mean "rules"?'),
        ("predicates p(). display p.", "1:17", ""),
        ("predicates p(). rule. p.", "1:21", "is declared rule()"),
        ("predicates p(). rules. p.", "1:17", "white space must follow"),
        ("predicates p(#s). p(a). rules p.", "1:21", "write #a"),
        ("predicates p(#s). p(a).", "1:19", '"rules" before this'),
    ],
)
def test_where_the_declarations_end(text: str, place: str, mend: str) -> None:
    fault = faults(Source("x", text.replace(" p :-", "\np :-")))[0]
    assert fault.span and str(fault.span.location) == f"x:{place}" and mend in (fault.hint or "")
