"""Goals as what they ask for: chains of deeds, parties and their tables."""

from __future__ import annotations

from tests.support.hall import posed
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.model.state import Goal, State


def test_a_thing_in_the_hands_is_brought_before_another_is_taken() -> None:
    state = State("a", carrying=("small", "plate"), ready=frozenset({("big", "plate")}))
    needs = find_needs(posed(state, Goal("served", table="big", item="plate")))
    names = {(link.name, link.table) for chain in needs.chains for link in chain.sure}
    assert names == {("take_up", "big"), ("bring", "big"), ("bring", "small")}


def test_bills_of_a_party_that_waits_name_its_table() -> None:
    state = State("a", waiting=(("c1",),), wants_bill=frozenset({"big"}))
    needs = find_needs(posed(state, Goal("paid", party=("c1",))))
    assert [guest.tables for guest in needs.guests] == [("big",)]
    assert needs.hopeless == ()
