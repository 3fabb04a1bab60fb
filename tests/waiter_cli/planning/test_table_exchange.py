"""Other tables, and another order of parties, for a plan as long."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from tests.support.rule_cases import at, plan, posed
from waiter_cli.model.layout import Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal
from waiter_cli.planning.draft_plan import Draft, Slots
from waiter_cli.planning.table_exchange import exchanges, smaller_tables, wider_exchanges
from waiter_cli.rules.validator import run

WAITING = at("e", waiting=(("c1",), ("c2",)))
TWO = posed(WAITING, Goal("seated", party=("c1",)), Goal("seated", party=("c2",)))
FIRST_LAST = (
    "pick(agent,c2)", "go_to(agent,d)", "seat(agent,c2,small)", "go_to(agent,e)",
    "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,big)",
)  # fmt: skip


def told(
    problem: Problem,
    texts: tuple[str, ...],
    change: Callable[[Draft], Iterator[tuple[Slots, bool]]],
) -> list[tuple[str, ...]]:
    """The plans that a change yields, each of which is legal where it is said to be sure."""
    draft = Draft(problem, plan(*texts), (), 10_000)
    found = []
    for slots, sure in change(draft):
        row = tuple("" if each is None else each.text for each in slots)
        assert len(row) == len(texts)
        assert run(problem, plan(*row)).valid or not sure
        found.append(row)
    return found


def test_a_party_goes_to_a_smaller_table_that_is_free_at_the_same_place() -> None:
    one = posed(at("e", waiting=(("c1",),)), Goal("seated", party=("c1",)))
    texts = ("pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,big)")
    assert told(one, texts, smaller_tables)[0] == (*texts[:2], "seat(agent,c1,small)")


def test_no_table_is_smaller_than_the_smallest_or_taken() -> None:
    one = posed(at("e", waiting=(("c1",),)), Goal("seated", party=("c1",)))
    assert (
        told(one, ("pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,small)"), smaller_tables)
        == []
    )
    assert told(TWO, FIRST_LAST, smaller_tables) == [], "the small one has c2"


def test_a_smaller_table_may_lie_elsewhere_on_the_way() -> None:
    """The nook is passed on the way to the big table at b."""
    nook = Table("nook", 1, ("d",), None, (0.8, 0.8), 1)
    big, small = posed(WAITING).layout.tables
    layout = replace(posed(WAITING).layout, tables=(replace(big, nodes=("b",)), small, nook))
    state = replace(at("e", waiting=(("c1",),)), chairs=(("big", 4), ("nook", 1), ("small", 2)))
    problem = posed(state, Goal("seated", party=("c1",)), Goal("at", node="b"), layout=layout)
    texts = ("pick(agent,c1)", "go_to(agent,d)", "go_to(agent,b)", "seat(agent,c1,big)")
    assert told(problem, texts, smaller_tables)[0] == (
        "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,nook)", "go_to(agent,b)",
    )  # fmt: skip


def test_who_came_first_changes_places_with_who_was_fetched_first() -> None:
    (turned,) = told(TWO, FIRST_LAST, exchanges)
    assert turned == (
        "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,small)", "go_to(agent,e)",
        "pick(agent,c2)", "go_to(agent,d)", "seat(agent,c2,big)",
    )  # fmt: skip


def test_whoever_keeps_a_table_is_only_fetched_in_another_order() -> None:
    found = told(TWO, FIRST_LAST, wider_exchanges)
    assert (
        "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,big)", "go_to(agent,e)",
        "pick(agent,c2)", "go_to(agent,d)", "seat(agent,c2,small)",
    ) in found  # fmt: skip


def test_who_is_in_order_is_left_there() -> None:
    in_order = tuple(
        text.replace("c1", "x").replace("c2", "c1").replace("x", "c2") for text in FIRST_LAST
    )
    assert told(TWO, in_order, exchanges) == [] and told(TWO, in_order, wider_exchanges) == []


def test_parties_without_room_are_not_exchanged() -> None:
    large = at("e", waiting=(("c1", "c3", "c4"), ("c2",)))
    problem = posed(large, Goal("seated", party=("c1", "c3", "c4")), Goal("seated", party=("c2",)))
    assert told(problem, FIRST_LAST, exchanges) == []
