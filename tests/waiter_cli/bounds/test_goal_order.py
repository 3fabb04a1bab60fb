"""Orders of goals that cannot be kept, each with its reason."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.hall import posed
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.goal_order import order_reasons
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.model.state import Goal, State

AT_E, AT_B = Goal("at", node="e"), Goal("at", node="b")
SEATED = Goal("seated", party=("c1",))
ORDERED, SENT = Goal("ordered", table="big"), Goal("sent", table="big")
CHAIRS = [Goal("chairs", table="small", number=number) for number in (1, 2)]
HUNGRY = State("a", seated=(("big", ("c1",)),), ready_to_order=frozenset({"big"}))
CHAIRLESS = State("a", chairs=(("big", 4), ("small", 0)))


def told(state: State, *pairs: tuple[Goal, Goal]) -> list[str]:
    goals = tuple(dict.fromkeys(goal for pair in pairs for goal in pair))
    problem = replace(posed(state, *goals), before=pairs)
    floor = WalkDistances(problem, ())
    return [reason.message for reason in order_reasons(problem, find_needs(problem), floor)]


@pytest.mark.parametrize(
    ("state", "early", "late", "reason"),
    [
        (State("a"), AT_E, AT_B, "every way there leads over b"),
        (HUNGRY, SENT, ORDERED, "the first includes the second"),
        (CHAIRLESS, CHAIRS[1], CHAIRS[0], "the first includes the second"),
        (State("a"), AT_B, AT_E, None),
        (HUNGRY, ORDERED, SENT, None),
        (CHAIRLESS, CHAIRS[0], CHAIRS[1], None),
    ],
    ids=["on the way", "an order", "chairs", "another way", "as orders go", "more chairs"],
)
def test_what_cannot_come_first(state: State, early: Goal, late: Goal, reason: str | None) -> None:
    found = told(state, (early, late))
    if reason is None:
        assert found == []
    else:
        (message,) = found
        assert " cannot come before " in message and message.endswith(f": {reason}")


def test_a_circle_is_told_once() -> None:
    (message,) = told(State("a"), (AT_E, AT_B), (AT_B, AT_E))
    assert message.startswith("the order goes in a circle: ")


def test_what_holds_already_comes_after_nothing() -> None:
    (message,) = told(State("b"), (AT_E, AT_B))
    assert message.endswith("holds already, so nothing can come before it")


def test_what_follows_from_two_pairs_is_looked_at() -> None:
    at_c = Goal("at", node="c")
    found = told(State("a"), (AT_E, at_c), (at_c, AT_B))
    assert any(message.endswith("every way there leads over b") for message in found)


def test_who_is_led_sits_before_others_are_fetched() -> None:
    state = State("e", with_agent=("c1",), waiting=(("c2",),))
    (message,) = told(state, (Goal("seated", party=("c2",)), SEATED))
    assert message.endswith("the party of c1 follows the agent and must be seated first")
