"""Each argument of each atom fits its sort, or the fault says what does."""

from __future__ import annotations

import pytest

import sparc
from sparc.checking.arguments import ArgumentChecker, Scope, as_written, variables_into
from sparc.checking.checker import Checker
from sparc.errors import PredicateError, RuleError, SortError, SourceError
from sparc.syntax.tree import Atom, Rule, SortAtom

HEAD = """#const c = 2.
sorts
#s = {ann, ben}. #n = 1..3. #t = {dora}.
#f = f(#s,#n). #l = {k(zoe, h(7))}.
predicates
p(#s). n(#n). f(#f). l(#l). long(#s,#n).
rules
"""


def faults(rule: str) -> list[SourceError]:
    try:
        sparc.check(sparc.parse(HEAD + rule))
    except sparc.SourceErrors as found:
        return list(found.errors)
    return []


@pytest.mark.parametrize(
    ("rule", "message", "hint"),
    [
        ("q(ann).", "unknown predicate q/1", ""),
        ("lng(ann,1).", "unknown predicate lng/2", "did you mean long (declared at line 6)?"),
        ("xyzzy(ann).", "unknown predicate xyzzy/1", "declare it in the section predicates"),
        ("t(dora).", "unknown predicate t/1", "#t is a sort: write #t(…)"),
        ("appl(ann).", "unknown predicate appl/1", "built in and cannot be used"),
        ("forall(ann).", "unknown predicate forall/1", "there are no quantifiers"),
        ("p(ann,ben).", "predicate p has 1 argument, found 2", "declared at line 6 as p(#s)"),
        ("long(ann).", "predicate long has 2 arguments, found 1", "as long(#s, #n)"),
        ("p(anne).", "anne is not in sort #s (argument 1 of p)", "did you mean ann?"),
        ("p(dora).", "dora is not in sort #s", "#s (line 3) does not have it; #t does"),
        ("p(x).", "x is not in sort #s", "variables begin with a capital letter: X"),
        ("n(c+2).", "4 is not in sort #n", "#n (line 3) does not have it"),
        ("long(ann,c). long(ann,7).", "7 is not in sort #n (argument 2 of long)", ""),
        ("p(X+1) :- n(X).", "X+1 is a number, but sort #s has none", "use an element of the sort"),
        ("n(1/0).", "division by zero", ""),
        ("f(f(ann,1/0)).", "division by zero", ""),
        ("f(f(ann,9)).", "f(ann,9) is not in sort #f", "argument 2 of f is of #n (line 3)"),
        ("f(f(X)) :- p(X).", "no sort has a record f with 1 argument", "f has 2 arguments"),
        ("f(ff(X,1)) :- p(X).", "no sort has a record ff with 2", "did you mean f?"),
        ("f(f(bob,X)) :- n(X).", "bob is no element of any sort", ""),
        ("l(k(X,h(zzz))) :- p(X).", "zzz is no element of any", "it stands in k(X,h(zzz))"),
    ],
)
def test_what_does_not_fit(rule: str, message: str, hint: str) -> None:
    (fault,) = faults(rule)
    assert isinstance(fault, PredicateError)
    assert fault.message.startswith(message)
    assert hint in (fault.hint or "")


@pytest.mark.parametrize(
    "rule",
    ["p(ann).", "n(c).", "n(c*1).", "f(f(ann,c)).", "f(f(X,2)) :- p(X).", "f(f(ann,X+1)) :- n(X).",
     "l(k(X,h(7))) :- p(X).", "f(f(ann,c+7)) :- p(ann).", "n(X) :- n(X), #n(X), not #s(X)."],
)  # fmt: skip
def test_what_fits(rule: str) -> None:
    assert faults(rule) == []


@pytest.mark.parametrize(
    ("rule", "kind", "message"),
    [
        (":- p(X), -#s(X).", RuleError, "-#s has no meaning"),
        (":- p(X), #s(X,X).", RuleError, "sort atom #s needs one argument, found 2"),
        (":- p(X), #s.", RuleError, "sort atom #s needs one argument, found 0"),
        (":- p(X), #zz(X).", SortError, "unknown sort #zz"),
        (":- #s(dora).", SortError, "dora is not in sort #s"),
        (":- #n(1/0).", RuleError, "division by zero"),
        ("#s(ann).", RuleError, "sort atom #s cannot stand in a head"),
        ("#p(ann).", RuleError, "sort atom #p cannot stand in a head"),
    ],
)
def test_sort_atoms(rule: str, kind: type[SourceError], message: str) -> None:
    fault = faults(rule)[0]
    assert type(fault) is kind and fault.message.startswith(message)


def parsed(rule: str) -> tuple[ArgumentChecker, tuple[Atom, ...]]:
    program = sparc.parse(HEAD + rule)
    checker = Checker(program)
    checker.open()
    (statement,) = program.statements
    assert isinstance(statement, Rule)
    return checker, tuple(item for item in statement.body if isinstance(item, Atom))


def test_where_variables_occur() -> None:
    checker, atoms = parsed(":- p(A), f(f(B,C+1)), n(D*2), p(_), f(f(_,E)).")
    scope = Scope()
    for atom in atoms:
        checker.atom(atom, scope)
    assert (scope.bound, scope.counted, scope.bare) == ({"A", "B", "E"}, {"C", "D"}, set())
    assert not scope.anonymous and not checker.errors


def test_the_sides_of_a_comparison_bind_nothing() -> None:
    checker, (atom,) = parsed(":- f(f(A,B+1)).")
    scope = Scope()
    for term in atom.arguments:
        checker.side(term, scope)
    assert (scope.bound, scope.counted, scope.bare) == (set(), {"B"}, {"A"})
    names: set[str] = set()
    variables_into(atom.arguments[0], names)
    assert names == {"A", "B"}


def test_a_sort_atom_under_not_binds_nothing() -> None:
    checker, _ = parsed(":- p(ann).")
    (statement,) = sparc.parse(HEAD + ":- #s(X), p(X).").statements
    (atom, _) = statement.body  # type: ignore[union-attr]
    assert isinstance(atom, SortAtom)
    for binds in (True, False):
        scope = Scope()
        checker.sort_atom(atom, scope, binds=binds)
        assert (scope.bound, scope.bare) == (({"X"}, set()) if binds else (set(), {"X"}))


def test_a_long_term_is_cut() -> None:
    checker, (atom,) = parsed(":- f(f(" + "a" * 80 + ",\n  1)).")
    shown = as_written(atom.arguments[0])
    assert len(shown) == 58 and shown.endswith("…") and "\n" not in shown
    checker.atom(atom, Scope())
    assert "…" in checker.errors[0].message


def test_a_fault_of_a_sort_is_told_once() -> None:
    """What a faulty sort would have is not known, so nothing is said of its elements."""
    text = "sorts #s = {ann} + #zz. predicates p(#s). q(). rules p(x). q :- p(f(y,X)), p(X)."
    with pytest.raises(sparc.SourceErrors) as caught:
        sparc.check(sparc.parse(text))
    assert [error.message for error in caught.value.errors] == ["unknown sort #zz"]


def test_a_sort_that_cannot_be_looked_through_is_a_fault_at_a_place() -> None:
    strings = "#s = [a..z][a..z][a..z][a..z]. #u = #s + {1}. #d = #u - {aaaa}. #e = {1,2}."
    text = f"sorts {strings} predicates p(#d). rules p(X+1) :- #e(X)."
    with pytest.raises(sparc.SourceErrors) as caught:
        sparc.check(sparc.parse(text))
    (error,) = caught.value.errors
    assert "more than 300,000 elements" in error.message
    assert error.span is not None and error.span.text == "p(X+1) :- #e(X)."
