"""The order of literals, the filters, and what tells answer sets apart."""

from __future__ import annotations

import random
import re

import pytest

from sparc.answer_sets import AnswerSet, Ground, GroundLiteral, GroundTerm
from waiter_cli.answersets.timeline import (
    Filter,
    Order,
    Timeline,
    differences,
    read_patterns,
    read_steps,
)
from waiter_cli.errors import InputError


def term(text: str) -> Ground:
    """The ground term that ``text`` writes."""
    if text.isdecimal():
        return int(text)
    name, _, rest = text.partition("(")
    return GroundTerm(name, arguments(rest[:-1]) if rest else ())


def arguments(text: str) -> tuple[Ground, ...]:
    parts, depth, start = [], 0, 0
    for at, sign in enumerate(text + ","):
        depth += {"(": 1, ")": -1}.get(sign, 0)
        if sign == "," and depth == 0:
            parts.append(term(text[start:at]))
            start = at + 1
    return tuple(parts)


def literal(text: str) -> GroundLiteral:
    name, _, rest = text.removeprefix("-").partition("(")
    return GroundLiteral(name, arguments(rest[:-1]) if rest else (), text.startswith("-"))


def answer_set(*texts: str) -> AnswerSet:
    return AnswerSet(frozenset(map(literal, texts)))


def test_some_programs_have_no_steps() -> None:
    pairs = {"p": ("node",), "edge": ("node", "t"), "size": ("nat",)}
    assert not Timeline({}).has_steps
    assert not Timeline({"p": ("nat",), "edge": ("node", "nat")}).has_steps
    assert Timeline(pairs).has_steps
    assert not Timeline(pairs, order=Order(flat=True)).has_steps
    assert not Timeline(pairs, numbers=frozenset({"nat"})).has_steps
    assert Timeline(pairs, numbers=frozenset({"t"})).has_steps
    assert Timeline({"holds": ("fluent", "step")}, numbers=frozenset({"step"})).has_steps


SIGNATURES = {
    "holds": ("fluent", "step"),
    "occurs": ("action", "step"),
    "obs": ("fluent", "bool", "step"),
    "goal": ("step",),
    "edge": ("node", "node"),
    "count": ("node", "nat"),
    "p": ("node",),
    "z": (),
}


@pytest.mark.parametrize(
    ("signatures", "ordered"),
    [
        pytest.param(
            SIGNATURES,
            ["-p(b)", "holds(f(a),0)"],
            id="without a step first",
        ),
        pytest.param(
            SIGNATURES,
            [
                "count(a,2)",
                "count(a,10)",
                "edge(a,b)",
                "edge(b,a)",
                "p(9)",
                "p(10)",
                "p(a)",
                "-p(a)",
                "p(b)",
                "z",
                "obs(f(a),true,0)",
                "occurs(b,0)",
                "-occurs(c,0)",
                "holds(f(a),0)",
                "goal(0)",
                "holds(f(2),2)",
                "holds(f(10),2)",
                "holds(f(a),2)",
                "-holds(f(a),2)",
                "holds(f(a,b),2)",
                "holds(g,2)",
                "goal(10)",
            ],
            id="kinds inside a step, numbers as numbers",
        ),
        pytest.param(
            {"at": ("robot", "place", "time"), "size": ("nat",), "age": ("a", "years")},
            ["age(a,1)", "size(3)", "size(20)", "at(r,x,0)", "at(r,y,11)"],
            id="a sort called time where nothing holds or occurs",
        ),
        pytest.param(
            {"holds": ("fluent",), "at": ("a", "t")},
            ["at(a,0)", "at(b,1)", "holds(x)"][2:] + ["at(a,0)", "at(b,1)"],
            id="holds without steps",
        ),
    ],
)
def test_order(signatures: dict[str, tuple[str, ...]], ordered: list[str]) -> None:
    shuffled = list(map(literal, ordered))
    random.Random(7).shuffle(shuffled)
    assert [str(each) for each in Timeline(signatures).sort(shuffled)] == ordered


def test_an_alias_of_the_step_sort_is_that_sort() -> None:
    signatures = {"holds": ("fluent", "step"), "goal": ("moment",), "size": ("nat",)}
    line = Timeline(signatures, {"moment": "time", "time": "step"})
    assert line.step(literal("goal(3)")) == 3
    assert line.step(literal("size(3)")) is None
    assert (
        Timeline(signatures, {"moment": "time", "time": "moment"}).step(literal("goal(3)")) is None
    )


@pytest.mark.parametrize(
    ("sort", "order", "step"),
    [
        *((sort, Order(), 33) for sort in ("step", "time", "timestep", "moment", "t")),
        *((sort, Order(), None) for sort in ("years", "nat", "steps", "n")),
        ("years", Order("years"), 33),
        ("years", Order("day"), 33),
        ("day", Order("years"), 33),
        ("time", Order("years"), None),
        ("time", Order(flat=True), None),
    ],
)
def test_a_number_is_a_step_where_its_sort_is_time(
    sort: str, order: Order, step: int | None
) -> None:
    line = Timeline({"age": ("person", sort), "old": (sort,)}, {"day": "years"}, order=order)
    assert line.step(literal("age(a,33)")) == step
    assert line.step(literal("old(33)")) == step
    named = Timeline({"holds": ("f", "n"), "age": ("person", sort)}, order=order)
    assert named.step(literal("holds(f,3)")) == (None if order != Order() else 3)


def test_groups() -> None:
    line = Timeline(SIGNATURES)
    given = map(literal, ["holds(f,2)", "p(a)", "occurs(go,0)", "holds(f,0)", "z"])
    assert [(group.step, list(map(str, group.literals))) for group in line.groups(given)] == [
        (None, ["p(a)", "z"]),
        (0, ["occurs(go,0)", "holds(f,0)"]),
        (2, ["holds(f,2)"]),
    ]
    assert list(line.groups([])) == []


LITERALS = ["p(a)", "-p(b)", "occurs(go(n1),0)", "holds(at(n1),1)", "-holds(at(n2),3)", "goal(3)"]


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ({}, LITERALS),
        ({"negative": False}, ["p(a)", "occurs(go(n1),0)", "holds(at(n1),1)", "goal(3)"]),
        ({"patterns": read_patterns(["n1"])}, ["occurs(go(n1),0)", "holds(at(n1),1)"]),
        ({"patterns": read_patterns(["go", "^p"])}, ["p(a)", "occurs(go(n1),0)", "goal(3)"]),
        ({"patterns": read_patterns(["n", "p"]), "invert": True}, ["goal(3)"]),
        ({"patterns": read_patterns(["AT"])}, []),
        (
            {"patterns": read_patterns(["AT"], ignore_case=True)},
            ["holds(at(n1),1)", "-holds(at(n2),3)"],
        ),
        ({"steps": (1, 3)}, ["holds(at(n1),1)", "-holds(at(n2),3)", "goal(3)"]),
        ({"steps": (None, 0)}, ["occurs(go(n1),0)"]),
        ({"steps": (2, None)}, ["-holds(at(n2),3)", "goal(3)"]),
        ({"only": frozenset({"goal", "p"})}, ["p(a)", "-p(b)", "goal(3)"]),
        ({"only": frozenset({"holds"}), "steps": (3, 3)}, ["-holds(at(n2),3)"]),
    ],
)
def test_filters(given: dict[str, object], kept: list[str]) -> None:
    chosen = Filter(**given)  # type: ignore[arg-type]
    line = Timeline(SIGNATURES)
    literals = answer_set(*LITERALS).literals
    shown = {each for each in literals if chosen.keeps(each, line.step(each))}
    assert shown == answer_set(*kept).literals
    assert bool(chosen) == (kept != LITERALS)


def test_matches_for_the_highlight() -> None:
    chosen = Filter(patterns=(re.compile("at"), re.compile(r"t\(n."), re.compile("x*")))
    assert chosen.matches("holds(at(n1),at)") == [(6, 11), (13, 15)]
    assert Filter(patterns=(re.compile("at"),), invert=True).matches("at") == []


@pytest.mark.parametrize(
    ("text", "ends"),
    [("2..5", (2, 5)), ("2..", (2, None)), ("..5", (None, 5)), ("4", (4, 4)), ("0..0", (0, 0))],
)
def test_steps(text: str, ends: tuple[int | None, int | None]) -> None:
    assert read_steps(text) == ends


@pytest.mark.parametrize("text", ["", "..", "5..2", "a..b", "1...2", "-1", "1-2", "2,3"])
def test_steps_that_are_none(text: str) -> None:
    with pytest.raises(InputError, match="--steps"):
        read_steps(text)


def test_a_pattern_that_is_none() -> None:
    with pytest.raises(InputError, match=r"--grep '\('"):
        read_patterns(["a", "("])


def test_differences() -> None:
    common, own = differences([answer_set("p(a)", "z"), answer_set("p(b)", "z"), answer_set("z")])
    assert common == {literal("z")}
    assert own == ({literal("p(a)")}, {literal("p(b)")}, frozenset())
    assert differences([]) == (frozenset(), ())
