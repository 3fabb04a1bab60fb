"""The price of seating each party at each table."""

from __future__ import annotations

from tests.support.hall import posed
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.model.state import Goal, State


def test_seating_pays_for_the_way_and_for_chairs() -> None:
    state = State("a", waiting=(("c1", "c2"),), chairs=(("big", 4), ("small", 1)))
    problem = posed(state, Goal("seated", party=("c1", "c2")))
    seating = Seating(problem, find_needs(problem), WalkDistances(problem, ()))
    assert seating.costs == [[4, 3]]  # e to c and back; e to d and back, and a chair
    free, bound = seating.solve(TableChoice()), seating.solve(TableChoice(must=frozenset({"big"})))
    assert free is not None and bound is not None
    assert (free.cost, bound.cost) == (3, 4)
    assert free.slack(0, 0) == 1
    assert seating.solve(TableChoice(never=frozenset({"big", "small"}))) is None
