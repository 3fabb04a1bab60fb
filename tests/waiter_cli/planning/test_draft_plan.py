"""A plan that is being changed: which deeds clash, what it is worth, where hands are free."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import JUG, LED, ONE, act, at, plan, posed
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal
from waiter_cli.planning.draft_plan import Draft, clash, is_deed

WAITING = at("e", waiting=(("c1",), ("c2", "c3")))
TWO = posed(WAITING, Goal("seated", party=("c1",)), Goal("seated", party=("c2", "c3")))
BOTH = (
    "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,small)", "go_to(agent,e)",
    "pick(agent,c2)", "go_to(agent,d)", "seat(agent,c2,big)",
)  # fmt: skip


def draft(problem: Problem, made: Plan, *prefer: str, careful: bool = False) -> Draft:
    return Draft(problem, made, prefer, 10_000, careful=careful)


def slots_of(*texts: str) -> list[Action | None]:
    return [act(text, step) if text else None for step, text in enumerate(texts)]


def test_walking_is_no_deed() -> None:
    assert is_deed(act("pick(agent,c1)"))
    assert not is_deed(act("go_to(agent,b)")) and not is_deed(None)


@pytest.mark.parametrize(
    ("deed", "other", "matters"),
    [
        ("pick(agent,c1)", "pick(agent,c2)", True),
        ("pick(agent,c1)", "give_bill(agent,big)", False),
        ("seat(agent,c1,big)", "bring_chairs(agent,big,4)", True),
        ("seat(agent,c1,big)", "bring_chairs(agent,small,4)", False),
        ("give_bill(agent,big)", "seat(agent,c1,big)", True),
        ("take_order(agent,big)", "send_order(agent,big)", True),
        ("take_order(agent,big)", "send_order(agent,small)", False),
        ("take_order(agent,big)", "bring(agent,plate,big)", True),
        ("take_order(agent,big)", "bring(agent,jug,big)", False),
        ("take_up(agent,jug,big)", "bring(agent,jug,small)", True),
    ],
)
def test_the_order_of_two_deeds_matters_where_they_share_something(
    deed: str, other: str, matters: bool
) -> None:
    assert clash(act(deed), act(other), instant=False) is matters
    assert clash(act(other), act(deed), instant=False) is matters


def test_an_instant_kitchen_makes_the_plate_where_the_order_is_sent() -> None:
    sent, taken = act("send_order(agent,big)"), act("take_up(agent,plate,big)")
    assert clash(sent, taken, instant=True) and not clash(sent, taken, instant=False)


def test_what_is_looked_after_otherwise_can_be_left_out() -> None:
    up, down = act("take_up(agent,jug,big)"), act("bring(agent,plate,small)")
    assert clash(up, down, instant=False)
    assert not clash(up, down, instant=False, leaving_out="hands")


def test_the_robot_is_where_its_walks_led_it() -> None:
    made = draft(TWO, plan(*BOTH))
    assert made.where == ["e", "e", "d", "d", "e", "e", "d", "d"]
    assert made.plan() == plan(*BOTH)


@pytest.mark.parametrize(
    ("deed", "nodes"),
    [
        ("pick(agent,c1)", {"e"}), ("send_order(agent,big)", {"a"}),
        ("take_up(agent,jug,big)", {"a"}), ("bring_chairs(agent,big,4)", {"b", "d"}),
        ("give_bill(agent,small)", {"d"}),
    ],
)  # fmt: skip
def test_a_deed_has_its_places(deed: str, nodes: set[str]) -> None:
    assert draft(TWO, plan(*BOTH)).places(act(deed)) == nodes


def test_fewer_seats_then_who_came_first_then_sooner_is_better() -> None:
    made = draft(TWO, plan(*BOTH))
    larger = slots_of(*BOTH[:2], "seat(agent,c1,big)", *BOTH[3:])
    assert made.worth(larger) > made.best
    turned = [text.replace("c1", "x").replace("c2", "c1").replace("x", "c2") for text in BOTH]
    assert made.worth(slots_of(*turned)) > made.best
    assert made.worth(slots_of("", *BOTH[:6])) != made.best


def test_what_is_preferred_comes_before_all_that() -> None:
    placed = replace(
        TWO.layout,
        nodes=tuple(replace(n, at=(3.0 * k, 0.0)) for k, n in enumerate(TWO.layout.nodes)),
    )
    problem = replace(TWO, layout=placed)
    assert draft(problem, plan(*BOTH), "shortest_walk").best[0] == (9000,)
    assert draft(problem, plan(*BOTH), "smallest_table").best[0] == (6,)
    assert draft(problem, plan(*BOTH), "longest_waiting").best[0] == (0, 4)
    assert draft(problem, plan(*BOTH), "earliest").best[0] == (2 + 2 + 2 + 1 + 1 + 1 + 1,)


def test_only_what_is_better_is_taken() -> None:
    late = plan("", "give_bill(agent,big)")
    problem = posed(at("b", seated=ONE, wants_bill="big"), Goal("paid", table="big"))
    made = draft(problem, late)
    assert not made.take(slots_of("", "give_bill(agent,big)"), sure=True)
    assert not made.take(slots_of("give_bill(agent,small)", ""), sure=False), "it is not legal"
    assert not made.take(slots_of("give_bill(agent,big)", ""), sure=False), "it would be shorter"
    assert made.plan() == late and made.careful, "an idle step needs to be executed"


def test_a_party_may_sit_where_nothing_depends_on_it() -> None:
    made = draft(TWO, plan(*BOTH))
    assert made.may_sit("c1", "small") and made.may_sit("c1", "big")
    bill = posed(WAITING, Goal("seated", party=("c1",)), Goal("paid", table="small"))
    assert not draft(bill, plan(*BOTH)).may_sit("c1", "small")
    served = posed(WAITING, Goal("serve", party=("c1",)))
    assert not draft(served, plan(*BOTH)).may_sit("c1", "big")


@pytest.mark.parametrize(
    ("state", "texts", "kind", "spells"),
    [
        (WAITING, BOTH, "lead", [(0, 0), (3, 4), (7, 7)]),
        (WAITING, BOTH, "hands", [(0, 7)]),
        (at("e", with_agent=LED), BOTH[1:], "lead", [(2, 3), (6, 6)]),
        (at("a", carrying=JUG), ("go_to(agent,b)", "bring(agent,jug,big)"), "hands", [(2, 2)]),
    ],
    ids=["lead", "hands", "led already", "carried already"],
)
def test_free_spells(
    state: object, texts: tuple[str, ...], kind: str, spells: list[tuple[int, int]]
) -> None:
    made = draft(posed(WAITING), plan(*BOTH))
    made.problem = posed(state)  # type: ignore[arg-type]
    assert made.free_spells(slots_of(*texts), kind) == spells


def test_what_is_brought_is_full_after_it_was_at_the_bar() -> None:
    texts = ("refill(agent,jug,big)", "go_to(agent,a)", "go_to(agent,b)", "bring(agent,jug,big)")
    state = at("b", seated=ONE, empty=frozenset({("big", "jug")}))
    made = draft(posed(state, Goal("filled", table="big", item="jug")), plan(*texts))
    assert made.filled_from(made.slots, made.where, 3) == 2
    assert made.filled_from(made.slots, made.where, 0) == 0
    taken = slots_of("take_up(agent,jug,big)", "go_to(agent,b)", "bring(agent,jug,big)")
    assert made.filled_from(taken, ["a", "a", "b", "b"], 2) == 1
