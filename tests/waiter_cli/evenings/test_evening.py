"""How guests behave: what they do after what was done for them, and when they have had enough."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import pytest

from waiter_cli.evenings.evening import Evening
from waiter_cli.model.guest_model import GuestModel, Span
from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.state import Observation, State

LAYOUT = Layout(
    name="hall",
    nodes=(Node("a"), Node("b")),
    edges=(("a", "b"),),
    entrance="a",
    tables=(Table("t1", 4, ("b",), None, (0.8, 0.8), 4),),
    agent="a",
    bar=Bar(("a",)),
    objects=("plate", "jug"),
)
EMPTY = State(agent="a")


def minutes(number: float) -> Span:
    return Span("uniform", number, number)


MODEL = GuestModel(
    10.0,
    at=((1.0, 2),),
    order_after=minutes(2),
    cook=minutes(5),
    eat=minutes(20),
    bill_after=minutes(1),
    patience=12.0,
    patience_served=30.0,
)
PARTY = ("c1", "c2")
SEATED = replace(EMPTY, seated=(("t1", PARTY),))


def evening(model: GuestModel = MODEL, layout: Layout = LAYOUT, **options: bool) -> Evening:
    return Evening(model, 1, layout, (f"c{k}" for k in count(1)), **options)


def shown(guests: Evening, minute: float) -> list[tuple[str, tuple[str, ...]]]:
    return [(seen.kind, seen.arguments) for seen in guests.due(60.0 * minute)]


def test_a_whole_visit() -> None:
    guests = evening()
    assert guests.next_time == 60.0
    assert shown(guests, 0.9) == []
    assert shown(guests, 1) == [("enter", PARTY)]
    guests.look(replace(EMPTY, waiting=(PARTY,)), 60.0)
    guests.look(replace(EMPTY, with_agent=PARTY), 90.0)
    guests.look(SEATED, 120.0)
    assert shown(guests, 3.9) == [] and shown(guests, 4) == [("order", ("t1",))]
    taken = replace(SEATED, ordered=frozenset({"t1"}))
    guests.look(taken, 300.0)
    sent = replace(SEATED, sent=frozenset({"t1"}))
    guests.look(sent, 360.0)
    assert shown(guests, 10.9) == [] and shown(guests, 11) == [("ready", ("t1", "plate"))]
    served = replace(sent, served=frozenset({"t1"}))
    guests.look(served, 720.0)
    assert shown(guests, 32.9) == [] and shown(guests, 33) == [("bill", ("t1",))]
    guests.look(replace(served, paid=frozenset({"t1"})), 2000.0)
    assert shown(guests, 33.4) == [("leave", ("c1",))]
    (stay,) = guests.stays
    assert (stay.picked, stay.seated, stay.taken, stay.sent) == (90.0, 120.0, 300.0, 360.0)
    assert (stay.served, stay.calls, stay.paid) == (720.0, 1980.0, 2000.0)
    assert (stay.table, stay.lost, guests.next_time) == ("t1", None, None)


def test_without_a_bar_they_eat_without_having_ordered() -> None:
    guests = evening(layout=replace(LAYOUT, bar=None, objects=()))
    shown(guests, 1)
    guests.look(SEATED, 120.0)
    assert shown(guests, 22.9) == [] and shown(guests, 23) == [("bill", ("t1",))]


def test_a_kitchen_that_cooks_at_once_is_not_waited_for() -> None:
    guests = evening(instant_kitchen=True)
    shown(guests, 1)
    guests.look(SEATED, 120.0)
    shown(guests, 4)
    guests.look(replace(SEATED, sent=frozenset({"t1"})), 250.0)
    assert shown(guests, 20) == []


def test_whoever_gets_no_table_leaves() -> None:
    guests = evening()
    shown(guests, 1)
    guests.look(replace(EMPTY, waiting=(PARTY,)), 60.0)
    assert shown(guests, 12.9) == [] and shown(guests, 13) == [("leave", ("c1",))]
    assert (guests.stays[0].lost, guests.next_time) == ("unseated", None)


def test_whoever_is_led_to_a_table_follows() -> None:
    guests = evening()
    shown(guests, 1)
    guests.look(replace(EMPTY, with_agent=PARTY), 60.0)
    assert shown(guests, 20) == [] and guests.stays[0].lost is None


def test_whoever_gets_no_plate_leaves() -> None:
    guests = evening()
    shown(guests, 1)
    guests.look(SEATED, 120.0)
    shown(guests, 4)
    assert shown(guests, 33.9) == [] and shown(guests, 34) == [("leave", ("c1",))]
    assert guests.stays[0].lost == "unserved"


@pytest.mark.parametrize(
    ("state", "emptied"),
    [
        (SEATED, True),
        (replace(SEATED, empty=frozenset({("t1", "jug")})), False),
        (replace(SEATED, carrying=("t1", "jug")), False),
    ],
)
def test_a_jug_is_emptied_where_it_is_full(state: State, emptied: bool) -> None:
    guests = evening(replace(MODEL, refills=30.0, patience=None, patience_served=None))
    shown(guests, 1)
    guests.look(state, 60.0)
    kinds = {kind for kind, _ in shown(guests, 60)}
    assert ("empty" in kinds) == emptied


def test_whoever_was_taken_away_does_nothing_more() -> None:
    guests = evening(replace(MODEL, refills=30.0))
    shown(guests, 1)
    guests.look(SEATED, 60.0)
    guests.look(EMPTY, 90.0)
    assert guests.next_time is None and shown(guests, 600) == []
    assert guests.stays[0].left == 90.0


def test_observations_are_made_one_at_a_time() -> None:
    guests = evening(replace(MODEL, at=((1.0, 1), (1.0, 2))))
    coming = guests.due(60.0)
    assert next(coming) == Observation("enter", ("c1",))
    assert next(coming) == Observation("enter", ("c2", "c3"))
