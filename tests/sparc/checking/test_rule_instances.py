"""What an instance of a rule asks for, and whether the sorts have one."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking import rule_instances
from sparc.checking.rule_instances import Demands, Impossible, InstanceSearch, terms_of, value_of
from sparc.checking.typed_program import TypedProgram
from sparc.sorts.values import Value
from sparc.syntax.printer import print_term
from sparc.syntax.tree import RangeFact, Rule

HEAD = """#const c = 9.
sorts
#a = 1..3. #b = 7..9. #s = {x,y}. #f = f(#s,#a). #g = g(#a(X),#a(Y)) : X < Y. #big = 0..1999. #u = #f + {k(7)}.
predicates
p(#a). q(#b). r(#s). f(#f). g(#g). u(#u). big(#big,#big). z().
rules
"""


def search(rules: str) -> tuple[InstanceSearch, TypedProgram]:
    typed = sparc.check(sparc.parse(HEAD + rules))
    return InstanceSearch(typed), typed


def why_not(rule: str) -> str | None:
    found, typed = search(rule)
    found.naturals = set().union(*typed.naturals.values())
    (statement,) = typed.program.statements
    assert isinstance(statement, Rule)
    reason = found.impossible(statement.head, statement.body)
    return None if reason is None else str(reason)


@pytest.mark.parametrize(
    ("rule", "reason"),
    [
        ("p(X) :- q(X).", "X would have to be in #b and in #a, which share no element"),
        ("z :- p(X), not q(X).", "X would have to be in #b and in #a, which share no element"),
        ("z :- p(X), not #a(X).", "no values of X in their sorts pass"),
        ("z :- p(X), X > 3.", "no values of X in their sorts pass"),
        ("z :- p(X), p(Y), X < Y, Y < X.", "no values of X, Y in their sorts pass"),
        ("z :- 1 = 2.", "its comparisons are false"),
        ("z :- p(X), X/0 = 1.", "no values of X"),
        ("z :- p(X+c).", "no values of X"),
        ("z :- p(X), X = x.", "no values of X"),
        ("f(f(X,Y)) :- r(Y).", "Y would have to be in"),
        ("z :- u(k(X)), q(Y), X = Y.", None),
        ("z :- f(k(X)), q(X).", "#f has no record k with 1 argument"),
        ("g(g(X,Y)) :- p(X), p(Y), Y <= X.", "no values of X, Y in their sorts pass"),
        ("z :- f(f(X,3)), r(X).", None),
        ("z :- p(X), p(Y), X != Y, Y > 2.", None),
        ("z :- p(_), q(_).", None),
        ("z :- big(X,Y), X*Y = 3, X > Y.", None),
        ("z :- X+1 = 3.", None),
        ("z :- X+1 = 0.", "no values of X"),
        ("{p(X) : q(X)}.", None),  # of a choice the body alone counts
    ],
)
def test_why_a_rule_has_no_instance(rule: str, reason: str | None) -> None:
    found = why_not(rule)
    assert found is None if reason is None else found is not None and reason in found


def test_what_is_too_much_to_try_is_taken_for_good(monkeypatch: pytest.MonkeyPatch) -> None:
    rule = "z :- p(X), p(Y), X < Y, Y < X."
    assert why_not(rule) is not None
    monkeypatch.setattr(rule_instances, "_BUDGET", 3)
    assert why_not(rule) is None
    monkeypatch.undo()
    monkeypatch.setattr(rule_instances, "_MOST_VARIABLES", 1)
    assert why_not(rule) is None


def test_what_a_literal_demands() -> None:
    found, typed = search("z :- p(X), f(f(Y,2)), not r(Z), X > 1, g(g(X,W)).")
    (statement,) = typed.program.statements
    assert isinstance(statement, Rule)
    demands = Demands()
    for item in statement.body:
        found.demand(item, demands)
    assert {name: [sort.name for sort in sorts] for name, sorts in demands.domains.items()} == {
        "X": ["a", "a"], "Y": ["s"], "Z": ["s"], "W": ["a"],
    }  # fmt: skip
    assert [set(names) for names, _ in demands.tests] == [{"X"}, {"X", "W"}]
    greater, ordered = (run for _, run in demands.tests)
    assert greater({"X": 2}) and not greater({"X": 1})
    assert ordered({"X": 1, "W": 2}) and not ordered({"X": 2, "W": 2})


def test_a_ground_argument_outside_its_sort_is_impossible() -> None:
    found, typed = search("z :- f(f(x,1)).")
    (statement,) = typed.program.statements
    assert isinstance(statement, Rule)
    (atom,) = statement.body
    with pytest.raises(Impossible, match=r"f\(x,1\) is not in #a") as caught:
        found.belongs(atom.arguments[0], typed.sorts["a"], Demands(), atom.span)  # type: ignore[union-attr]
    assert caught.value.span is not None and caught.value.span.text == "f(x,1)"


def test_elements_without_an_instance() -> None:
    rule = "{p(X) : q(X); p(1)} :- p(Y), #count{Z : r(Z), Z = x; W : p(W), W > 5} > 0."
    found, typed = search(rule)
    (statement,) = typed.program.statements
    assert isinstance(statement, Rule)
    told = list(found.empty_parts(statement, statement.head, statement.body))
    assert [str(one.span and one.span.text) for one in told] == ["p(X) : q(X)", "W : p(W), W > 5"]
    assert all(one.message.startswith("this element has no instance: ") for one in told)


def test_names_that_no_sort_has() -> None:
    rule = "z :- r(X), X != zoo, c = 9, #count{Y : r(Y), Y = ape} > 0."
    found, typed = search(rule)
    (statement,) = typed.program.statements
    assert isinstance(statement, Rule)
    assert [one.message for one in found.unknown_names(statement.body)] == [
        "zoo is no element of any sort, so this always holds",
        "ape is no element of any sort, so this never holds",
    ]


@pytest.mark.parametrize(
    ("fact", "told"),
    [("p(3..1).", ["the range 3..1 ends before it begins, so this fact says nothing"]),
     ("p(1..1).", []), ("q(c..9).", [])],
)  # fmt: skip
def test_a_range_turned_round(fact: str, told: list[str]) -> None:
    found, typed = search(fact)
    (statement,) = typed.program.statements
    assert isinstance(statement, RangeFact)
    assert [one.message for one in found.empty_range(statement)] == told


def test_the_terms_of_a_rule() -> None:
    rule = "{p(A) : q(B), C < 1} :- r(D), not r(E), F = 2, #count{G,H : p(I)} = J, r(J), r(H), p(C), p(F)."
    (statement,) = sparc.parse(HEAD + rule).statements
    assert isinstance(statement, Rule)
    shown = [print_term(term) for term in terms_of(statement.head, statement.body)]
    assert shown == ["A", "B", "C", "1", "D", "E", "F", "2", "G", "H", "I", "J", "H", "C", "F"]


@pytest.mark.parametrize(
    ("text", "value"),
    [("X", 5), ("Y", None), ("f(X,a)", ("f", 5, "a")), ("f(Y)", None), ("X*2-c", 1), ("X/0", None),
     ("X+W", None)],
)  # fmt: skip
def test_values_in_an_assignment(text: str, value: Value | None) -> None:
    _, typed = search(f"z :- p(X), p(Y), r(W), 0 = {text}.")
    (statement,) = typed.program.statements
    comparison = statement.body[-1]  # type: ignore[union-attr]
    assert value_of(comparison.right, {"X": 5, "W": "x"}, typed.constants) == value  # type: ignore[union-attr]
