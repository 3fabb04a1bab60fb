"""Every state that a program of one step can come to: a ring of places, walked round."""

from __future__ import annotations

import pytest

from waiter_cli.planning.reached_states import StepPrograms, can_reach_goals
from waiter_cli.planning.step_form import OpenQuestion

STEP = ["p(Y,1) :- p(X,0), next(X,Y).", "next(0,1). next(1,2). next(2,0).", "#defined p/2."]


def ring(*goals: str, frozen: str = "", more: str = "") -> StepPrograms:
    """Three places in a ring, from the first on; a goal is a body such as ``p(2,1)``."""
    asked = [f"reached({k},1) :- {goal}." for k, goal in enumerate(goals, 1)]
    whole = ", ".join(f"reached({k},1)" for k, _ in enumerate(goals, 1))
    later = [*STEP, *asked, f"goal(1) :- {whole}.", more]
    names = dict.fromkeys(frozen.split(), 0)
    literals = [*(f"p({k})" for k in range(4)), *names]
    return StepPrograms(["p(0,0).", *later], later, {"p": 1}, names, literals)


def test_a_goal_that_is_reached_is_no_proof() -> None:
    assert can_reach_goals(ring("p(2,1)"), 10, None) is None
    assert can_reach_goals(ring("p(0,1)"), 10, None) is None, "only once round"


def test_a_place_beside_the_ring_is_never_reached() -> None:
    assert can_reach_goals(ring("p(3,1)"), 10, None) == frozenset()


def test_goals_that_are_reached_one_by_one_but_never_together_are_told() -> None:
    assert can_reach_goals(ring("p(1,1)", "p(2,1)"), 10, None) == {1, 2}
    assert can_reach_goals(ring("p(1,1)", "p(3,1)"), 10, None) == {1}


def test_what_is_frozen_is_part_of_every_state() -> None:
    """Once chosen at the first step, for good."""
    programs = ring("p(2,1), open", frozen="open")
    assert can_reach_goals(programs, 10, None) == frozenset()
    opened = StepPrograms(
        [*programs.first, "open."],
        programs.later,
        programs.carried,
        programs.frozen,
        programs.literals,
    )
    assert can_reach_goals(opened, 10, None) is None


def test_choices_lead_to_more_states() -> None:
    stay = ring("p(1,1), p(0,1)", more="{ p(X,1) } :- p(X,0).")
    assert can_reach_goals(stay, 10, None) is None, "who may stay is at two places"


@pytest.mark.parametrize(("most", "proved"), [(3, True), (2, False)])
def test_too_many_states_leave_the_question_open(most: int, proved: bool) -> None:
    if proved:
        assert can_reach_goals(ring("p(3,1)"), most, None) == frozenset()
    else:
        with pytest.raises(OpenQuestion):
            can_reach_goals(ring("p(3,1)"), most, None)
