"""Derivations and absences as a person reads them."""

from __future__ import annotations

import pytest

from tests.support.explained import found


def lines(literal: str, program: str) -> list[str]:
    return str(found(literal, program)).split("\n")[1:]


@pytest.mark.parametrize(
    ("literal", "program", "told"),
    [
        ("q", "predicates p(). q(). rules p.\n% When p.\nq :- p. ", [
            "  q", "      p.sparc:3: q :- p.", "        When p.", "    p", "        p.sparc:1: p."]),
        ("q(a)", "sorts #s={a}. predicates p(#s). q(#s). rules p(a).\nq(X) :- p(X), not -p(X). ", [
            "  q(a)", "      p.sparc:2: q(X) :- p(X), not -p(X).",
            "        as in: q(a) :- p(a), not -p(a)",
            "    p(a)", "        p.sparc:1: p(a).", "    not -p(a)  (no rule gives it)"]),
        ("p", "predicates p(). q(). rules\n1{p; q}1. :- q. ", [
            "  p  (chosen among what this rule allows)", "      p.sparc:2: 1{p; q}1.",
            "        as in: {p}"]),
        ("p", "predicates p(). rules\np :+ . :- not p. ", [
            "  p  (applied, since without it there is no answer set)", "      p.sparc:2: p :+ ."]),
        ("k(2)", "sorts #n=0..2. predicates p(#n). k(#n). rules p(1..2).\n"
         "k(N) :- #count{X : p(X)} = N. ", [
            "  k(2)", "      p.sparc:2: k(N) :- #count{X : p(X)} = N.",
            "        as in: k(2) :- #count{X : p(X)} = 2",
            "      #count{X : p(X)} = 2 counts {p(1)}, {p(2)}",
            "    p(1)", "        p.sparc:1: p(1..2).", "    p(2)", "        p.sparc:1: p(1..2)."]),
        ("q", "predicates p(). q(). r(). rules\nq :- not p.\np :- r. ", [
            "  q", "      p.sparc:2: q :- not p.", "    not p  (none of these rules gives it)",
            "        p.sparc:3: p :- r.", "          fails: r", "            no rule gives it"]),
    ],
    ids=["sentence", "instance", "chosen", "needed", "counted", "negation"],
)  # fmt: skip
def test_why_it_holds(literal: str, program: str, told: list[str]) -> None:
    assert lines(literal, program) == told


@pytest.mark.parametrize(
    ("literal", "program", "told"),
    [
        ("q", "predicates q(). rules ", ["  no rule gives it"]),
        ("q", "predicates p(). q(). rules\nq :- p. ", [
            "  p.sparc:2: q :- p.", "    fails: p", "      no rule gives it"]),
        ("q", "predicates p(). q(). rules p.\nq :- not p. ", [
            "  p.sparc:2: q :- not p.", "    fails: not p", "      p is there:", "      p",
            "          p.sparc:1: p."]),
        ("q", "predicates p(). q(). rules\n1{p; q}1. :- q. ", [
            "  p.sparc:2: 1{p; q}1.", "    as in: {q}",
            "    its body holds, but this was not chosen"]),
        ("p", "predicates p(). rules\np :+ . ", [
            "  p.sparc:2: p :+ .", "    its body holds, but it was not needed"]),
        ("p(3)", "sorts #n=0..3. predicates p(#n). rules\np(1..2). ", [
            "  p.sparc:2: p(1..2).", "    fails: p(3) (not in the range)"]),
        ("k", "sorts #n=0..2. predicates p(#n). k(). rules p(1).\nk :- #count{X : p(X)} > 1. ", [
            "  p.sparc:2: k :- #count{X : p(X)} > 1.", "    fails: #count{X : p(X)} > 1",
            "      #count{X : p(X)} > 1 counts {p(1)}, which comes to 1"]),
        ("k", "sorts #n=0..2. predicates p(#n). k(). rules\nk :- #count{X : p(X)} > 1. ", [
            "  p.sparc:2: k :- #count{X : p(X)} > 1.", "    fails: #count{X : p(X)} > 1",
            "      #count{X : p(X)} > 1 counts nothing, which comes to 0"]),
    ],
    ids=["nothing", "premise", "negation", "choice", "not needed", "range", "counted", "none"],
)  # fmt: skip
def test_why_it_does_not(literal: str, program: str, told: list[str]) -> None:
    assert lines(literal, program) == told
