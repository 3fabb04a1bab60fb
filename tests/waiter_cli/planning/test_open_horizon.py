"""One program for all horizons up to one: what is opened, and what is not of the form."""

from __future__ import annotations

import clingo
import pytest

from sparc.translation.asp_program import AspProgram
from waiter_cli.planning.open_horizon import OpenHorizon, with_open_horizon

OPENED = "__step(0). { __step(1..4) }. :- __step(I+1), not __step(I), I = 0..3."


def opened(text: str, longer: str) -> OpenHorizon | None:
    return with_open_horizon(AspProgram(text, ""), AspProgram(longer, ""), 4)


def opened_beside(line: str, other: str) -> list[str] | None:
    """The lines of a program with one more line beside the fact of its steps."""
    found = opened(f"__step(0..4).\n{line}", f"__step(0..5).\n{other}")
    return None if found is None else found.program.text.split("\n")


def test_the_last_step_becomes_a_choice_and_what_is_equal_stays() -> None:
    assert opened_beside("__num(0..4).", "__num(0..4).") == [OPENED, "__num(0..4)."]


def test_a_bound_asks_for_the_last_step_of_what_it_bounds() -> None:
    rules = ("p(I+1):-p(I),I<=3.", "p(I+1):-p(I),I<=4.")
    assert opened_beside(*rules) == [OPENED, "p(I+1):-p(I),I<=3,__step(I+1)."]
    two = ("p:-I<=4,J<=2,I<=9.", "p:-I<=5,J<=3,I<=9.")
    assert opened_beside(*two) == [OPENED, "p:-I<=4,__step(I+0),J<=2,__step(J+2),I<=9."]


@pytest.mark.parametrize(
    ("line", "other"),
    [
        ("last(4).", "last(5)."), ("p(I):-I<=3.", "p(I):-I<=5."), ("a.", "a.\nb."),
        ("__t(0..4).", "__t(0..5)."), ("p(I):-I<=3.", "p(J):-J<=4."), ("p(I):-I<=3.", "q(I):-I<=4."),
    ],
)  # fmt: skip
def test_what_differs_elsewhere_has_no_open_horizon(line: str, other: str) -> None:
    assert opened_beside(line, other) is None


def test_programs_without_steps_have_none() -> None:
    assert opened("a.", "a.") is None


def test_each_choice_is_the_program_of_that_horizon() -> None:
    """Exactly the answer sets that the programs for 0 to 4 have, one horizon after the other."""

    def program(horizon: int) -> str:
        return f"step(0..{horizon}).\nq(I) :- p(I), I<={horizon - 1}.\n{{ p(I) }} :- step(I)."

    found = opened(program(4), program(5))
    assert found is not None
    for horizon in range(5):
        assert _sets(found, horizon) == _plain(program(horizon))


def _plain(text: str) -> set[frozenset[str]]:
    return _solved(text, [])


def _sets(found: OpenHorizon, horizon: int) -> set[frozenset[str]]:
    told = [(found.reached(step), step <= horizon) for step in range(1, 5)]
    return _solved(found.program.text, told)


def _solved(text: str, told: list[tuple[clingo.Symbol, bool]]) -> set[frozenset[str]]:
    control = clingo.Control(["0", "--warn=none"])
    control.add("base", [], text)
    control.ground([("base", [])])
    sets: set[frozenset[str]] = set()
    with control.solve(assumptions=told, yield_=True) as handle:
        sets.update(frozenset(map(str, model.symbols(atoms=True))) for model in handle)
    return sets
