"""Plans for several robots as orders of precedence."""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.execution.precedence import order_of
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.state import State

RING = """
name: ring
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, a], [c, d]]
entrance: d
tables: {t1: {capacity: 2, nodes: [a, b]}, t2: {capacity: 2, nodes: [c]}}
agents: {r1: a, r2: b, r3: c}
bar: [d]
"""


def ring() -> tuple[Layout, State]:
    layout = read_layout(RING, "ring.yaml")
    return layout, state_of_layout(layout)[0]


def actions(*texts: str) -> list[Action]:
    """``0 go_to(r1,b)`` and the like."""
    found = []
    for text in texts:
        step, _, term = text.partition(" ")
        name, _, rest = term.removesuffix(")").partition("(")
        found.append(Action(int(step), name, tuple(rest.split(","))))
    return found


def test_who_comes_waits_for_who_leaves() -> None:
    layout, state = ring()
    leaves, comes, on = actions("0 go_to(r3,d)", "0 go_to(r2,c)", "1 go_to(r1,b)")
    order = order_of([comes, leaves, on], state, layout)
    assert order.waits == {leaves: frozenset(), comes: {leaves}, on: {comes}}
    assert order.ready() == (leaves,) and order.ready([leaves]) == ()
    assert [action.step for action in order.levelled().actions] == [0, 0, 0]


def test_a_ring_sets_out_together() -> None:
    layout, state = ring()
    walks = actions("2 go_to(r1,b)", "2 go_to(r2,c)", "2 go_to(r3,a)")
    order = order_of(walks, state, layout)
    assert [set(order.groups[walk]) for walk in walks] == [set(walks)] * 3
    assert order.ready() == tuple(walks)
    assert order_of(walks, state, layout, walks[:1]).ready(walks[:1]) == tuple(walks[1:])


def test_deeds_at_one_table_keep_their_order_and_others_do_not_wait() -> None:
    layout, state = ring()
    state = replace(state, seated=(("t1", ("c1",)),))
    bill, order_taken, other = actions(
        "0 give_bill(r1,t1)", "1 take_order(r2,t1)", "5 take_order(r3,t2)"
    )
    order = order_of([bill, order_taken, other], state, layout)
    assert order.ready() == (bill, other)
    assert order.waits[order_taken] == {bill}
    assert [(a.step, a.arguments[0]) for a in order.levelled().actions] == [
        (0, "r1"), (0, "r3"), (1, "r2"),
    ]  # fmt: skip
    together = [replace(action, step=0) for action in (bill, order_taken)]
    both = order_of(together, state, layout)
    assert both.groups[together[0]] == tuple(together) and both.ready() == tuple(together)


def test_deeds_with_one_party_keep_their_order() -> None:
    layout, state = ring()
    state = replace(state, waiting=(("c1", "c2"),))
    first, then = actions("0 pick(r1,c1)", "3 seat(r2,c2,t2)")
    assert order_of([then, first], state, layout).waits[then] == {first}


def test_what_runs_comes_first_whatever_its_step() -> None:
    layout, state = ring()
    runs, new = actions("7 go_to(r3,d)", "3 go_to(r2,c)")
    order = order_of([new, runs], state, layout, [runs])
    assert order.waits[new] == {runs} and order.ready([runs]) == ()


def test_nothing_is_an_empty_plan() -> None:
    assert order_of([], ring()[1], ring()[0]).levelled() == Plan((), 0)
