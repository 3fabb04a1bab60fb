"""One program in clingo: grounded, extended, searched, and what is known at the end."""

from __future__ import annotations

import time

import clingo
import pytest

from sparc.answer_sets import GroundLiteral, GroundTerm
from sparc.errors import NumberError, RefusedProgramError, SolverError
from sparc.solving.clingo_solver import Grounding, Satisfiability, ground_literal
from sparc.solving.clingo_threads import Abandoned
from sparc.source import Source, Span
from sparc.translation.asp_program import AspProgram

CHOICE = AspProgram("1{p(1..3)}1.", "#show p/1.")
HARD = AspProgram(
    "1{in(P,H) : H=1..9}1:-P=1..10. :-in(P,H),in(Q,H),P<Q.", "#show."
)  # ten pigeons, nine holes


def grounded(program: AspProgram, **options: object) -> Grounding:
    grounding = Grounding(program, **options)  # type: ignore[arg-type]
    grounding.ground()
    return grounding


def shown(grounding: Grounding, **options: object) -> list[str]:
    models = grounding.models(**options)  # type: ignore[arg-type]
    return sorted(" ".join(sorted(map(str, m.symbols(shown=True)))) for m in models)


def test_models_and_what_is_known_then() -> None:
    grounding = grounded(CHOICE)
    assert shown(grounding) == ["p(1)", "p(2)", "p(3)"]
    outcome = grounding.outcome
    assert (outcome.satisfiability, outcome.models) == (Satisfiability.SATISFIABLE, 3)
    assert outcome.exhausted and outcome.seconds >= 0


def test_a_limit_leaves_it_open_whether_there_are_more() -> None:
    grounding = grounded(CHOICE)
    assert len(shown(grounding, limit=2)) == 2 and not grounding.outcome.exhausted
    assert len(shown(grounding)) == 3 and grounding.outcome.exhausted  # the limit is of one search


def test_assumptions_and_the_core_of_those_that_leave_nothing() -> None:
    grounding = grounded(AspProgram("{a;b;c}. :-a,b.", "#show a/0. #show b/0. #show c/0."))
    a, b, c = (grounding.control.symbolic_atoms[clingo.Function(n)].literal for n in "abc")  # type: ignore[union-attr]
    assert shown(grounding, assumptions=[a, -c]) == ["a"]
    assert shown(grounding, assumptions=[(clingo.Function("b"), True), -c]) == ["b"]
    assert shown(grounding, assumptions=[c, a, b]) == []
    assert grounding.outcome.satisfiability is Satisfiability.UNSATISFIABLE
    assert {a, b} <= set(grounding.core) <= {a, b, c}


def test_preferences_are_kept_or_left_aside() -> None:
    program = AspProgram("{p(1..2)}. :~p(X).[1@1,X]", "#show p/1.", has_preferences=True)
    grounding = grounded(program)
    *_, best = grounding.models(optimize=True)
    assert list(best.cost) == [0]
    assert len(shown(grounding, optimize=False)) == 4


def test_a_search_ends_at_its_conflicts_and_at_its_deadline() -> None:
    grounding = grounded(HARD)
    assert shown(grounding, conflicts=10) == []
    assert grounding.outcome.satisfiability is Satisfiability.UNKNOWN
    start = time.monotonic()
    assert shown(grounding, deadline=start + 0.05) == []
    assert grounding.outcome.satisfiability is Satisfiability.UNKNOWN
    assert not grounding.outcome.exhausted and time.monotonic() - start < 5


def test_a_search_may_be_left_and_another_begun() -> None:
    grounding = grounded(CHOICE)
    models = grounding.models()
    next(models)
    models.close()  # type: ignore[attr-defined]
    assert len(shown(grounding)) == 3


def test_what_is_asked_too_early() -> None:
    with pytest.raises(SolverError, match="no search has ended yet"):
        grounded(CHOICE).outcome  # noqa: B018


def test_grounding_ends_at_its_deadline() -> None:
    with pytest.raises(Abandoned):
        Grounding(CHOICE).ground(time.monotonic())


def test_rules_are_added_later() -> None:
    grounding = grounded(CHOICE)
    grounding.extend(":-p(1).")
    grounding.extend("q(X):-p(X). #show q/1.")
    assert shown(grounding) == ["p(2) q(2)", "p(3) q(3)"]


def test_what_is_shown_and_what_is_added() -> None:
    assert shown(grounded(CHOICE, show="#show q/1.", extra="q(X):-p(X),X>2.")) == ["", "", "q(3)"]
    assert shown(grounded(CHOICE, options=["-n", "1"]), limit=0) == ["p(1)", "p(2)", "p(3)"]


def test_a_text_that_clingo_refuses_is_told_in_its_words() -> None:
    with pytest.raises(RefusedProgramError, match="syntax error"):
        grounded(AspProgram("p(.", "#show."))
    grounding = grounded(CHOICE)
    with pytest.raises(RefusedProgramError, match="unsafe"):
        grounding.extend("q(X).")


def test_no_answer_set_of_a_disjunction_is_lost() -> None:
    program = AspProgram("a|na. b|nb. na. ok:-not not a. ok:-not not b. :-not ok.", "#show ok/0.")
    assert shown(grounded(program)) == ["ok"]


def test_the_place_of_what_does_not_fit() -> None:
    place = Span(Source("x", "X*X"), 0, 3)
    program = AspProgram("p(65536). q(@times(0,X,X)):-p(X).", "#show q/1.", places=(place,))
    grounding = grounded(program)
    assert grounding.overflow is not None and grounding.overflow.value == 2**32
    assert grounding.place(grounding.overflow) is place
    other = grounded(AspProgram(program.text, program.show))
    assert other.overflow is not None and other.place(other.overflow) is None


def test_a_sum_that_may_not_fit_is_refused() -> None:
    place = Span(Source("x", "#sum"), 0, 4)
    text = "w(1..2). :-#sum{2000000000,X:w(X),@total(0,(0,0),(2000000000,X,0))=0}>3."
    with pytest.raises(NumberError, match="can add up to 4000000000") as caught:
        grounded(AspProgram(text, "#show.", places=(place,)))
    assert caught.value.span is place


def test_symbols_become_literals() -> None:
    symbol = clingo.parse_term("-p(f(a,-3),7)")
    nested = GroundTerm("f", (GroundTerm("a"), -3))
    assert ground_literal(symbol) == GroundLiteral("p", (nested, 7), True)
    assert ground_literal(clingo.parse_term("q")) == GroundLiteral("q")


def test_answer_sets_have_what_is_shown_and_their_cost() -> None:
    program = AspProgram("p. q. :~p.[3@1]", "#show q/0.", has_preferences=True)
    (found,) = grounded(program).answer_sets()
    assert (found.literals, found.cost) == (frozenset({GroundLiteral("q")}), (3,))
