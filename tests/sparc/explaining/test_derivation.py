"""Why literals hold: the smallest derivation, its notes, and what an aggregate counted."""

from __future__ import annotations

import pytest

from tests.support.explained import found, step


def test_a_rule_with_its_place_sentence_instance_and_premises() -> None:
    node = step("flies(tweety)")
    assert node.place is not None
    assert (node.place.file, node.place.line, node.place.sentence) == ("p.sparc", 12, "Birds fly.")
    assert node.instance == "flies(tweety) :- bird(tweety), not penguin(tweety)"
    assert [(each.literal, each.note) for each in node.premises] == [
        ("bird(tweety)", ""),
        ("not penguin(tweety)", "no rule gives it"),
    ]


def test_not_p_is_opened_in_place_once() -> None:
    program = (
        "predicates a(). b(). c(). d(). e(). f(). "
        "rules e. b :- e, c. b :- e, not e. d :- not b. f :- not b. a :- d, f. "
    )
    d, f = step("a", program).premises
    absent = d.premises[0].absent
    assert absent is not None
    assert d.premises[0].note == "none of these rules gives it"
    assert [(each.instance, each.failed) for each in absent.rules] == [
        ("b :- e, c", "c"),
        ("b :- e, not e", "not e"),
    ]
    assert (f.premises[0].absent, f.premises[0].note) == (None, "shown above")
    (alone,) = step("d", "predicates b(). d(). rules d :- not b. ").premises
    assert (alone.absent, alone.note) == (None, "no rule gives it")


def test_the_smallest_derivation() -> None:
    program = (
        "predicates a(). b(). c(). d(). e(). "
        "rules d. c :- d. e :- c. b :- e. a :- b. a :- c, d. a :- a. "
    )
    assert step("a", program).instance == "a :- c, d"


def test_what_is_shared_is_shown_once() -> None:
    program = "predicates a(). b(). c(). d(). e(). rules e. d :- e. b :- d. c :- d. a :- b, c. "
    nodes = [step("a", program)]
    seen = []
    while nodes:
        node = nodes.pop()
        seen.append((node.literal, node.note))
        nodes.extend(node.premises)
    assert sorted(seen) == [
        ("a", ""), ("b", ""), ("c", ""), ("d", ""), ("d", "shown above"), ("e", ""),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("program", "note", "instance"),
    [
        ("1{p; q}1. :- q.", "chosen", "{p}"),
        ("p | q. :- q.", "chosen", "p | q"),
        ("r : p :+ . :- not p.", "needed", "r : p"),
        ("p :+ . :- not p.", "needed", "p"),
        ("{p} :+ . :- not p.", "needed", "{p}"),
    ],
)
def test_what_nothing_forces(program: str, note: str, instance: str) -> None:
    node = step("p", f"predicates p(). q(). rules {program} ")
    assert (node.note, node.instance) == (note, instance)


def test_aggregates_show_what_counted() -> None:
    node = step("k(2)")
    (counted,) = node.aggregates
    assert counted.aggregate == "#count{X : bird(X)} = 2"
    assert counted.elements == ("bird(sam)", "bird(tweety)")
    assert {each.literal for each in node.premises} == {"bird(sam)", "bird(tweety)"}


def test_the_variables_of_a_tuple_are_its_own() -> None:
    program = (
        "sorts #n = 0..9. predicates p(#n). t(#n). rules p(1). p(4). "
        "t(S) :- p(X), #sum{X : p(X)} = S. "
    )
    (counted,) = step("t(5)", program).aggregates
    assert counted.elements == ("p(1)", "p(4)")


def test_an_aggregate_over_what_it_gives() -> None:
    program = (
        "sorts #n = 0..2. predicates p(#n). rules p(0). p(1) :- #count{X : p(X)} >= 1. "
        "p(2) :- #count{X : p(X)} >= 2. "
    )
    assert step("p(1)", program).aggregates and step("p(2)", program).aggregates


def test_literals_that_need_one_another() -> None:
    program = "predicates a(). b(). rules a | b. a :- b. b :- a. "
    assert found("a", program).holds and found("b", program).holds


def test_deep_derivations_are_continued() -> None:
    program = "#maxint = 1500. sorts #n = 0..1500. predicates p(#n). rules p(0). p(N+1) :- p(N). "
    why = found("p(1500)", program)
    nodes = list(why.because)
    literals = set()
    while nodes:
        node = nodes.pop()
        if node.place is not None:
            assert node.literal not in literals
            literals.add(node.literal)
        nodes.extend(node.premises)
    assert literals == {f"p({n})" for n in range(1501)}
