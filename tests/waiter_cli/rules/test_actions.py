"""The rules of one step, sentence by sentence, in the hall of `tests/support/rule_cases.py`."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL, JUG, LED, ONE, PLATE, START, act, at, posed
from waiter_cli.model.state import Goal
from waiter_cli.rules.actions import Illegal, apply, begin, holds, idle, legal_actions

POSSIBLE = {
    "go along an edge": ("go_to(agent,b)", START, at("b")),
    "go against the edge as written": (
        "go_to(agent,e)",
        at("d"),
        at("e"),
    ),
    "pick by any member": (
        "pick(agent,c2)",
        at("e", waiting=(LED, ("c3",))),
        at("e", waiting=(("c3",),), with_agent=LED),
    ),
    "seat by any member": (
        "seat(agent,c2,small)",
        at("d", with_agent=LED),
        at("d", seated=(("small", LED),)),
    ),
    "seat from the other node of a table": (
        "seat(agent,c1,big)",
        at("b", with_agent=LED),
        at("b", seated=(("big", LED),)),
    ),
    "give a bill": (
        "give_bill(agent,big)",
        at("d", seated=ONE, wants_bill="big"),
        at("d", seated=ONE, paid="big"),
    ),
    "take an order": (
        "take_order(agent,big)",
        at("d", seated=ONE, ready_to_order="big", sent="big small", served="big"),
        at("d", seated=ONE, ordered="big", sent="small"),
    ),
    "send an order": (
        "send_order(agent,big)",
        at("a", seated=ONE, ordered="big"),
        at("a", seated=ONE, sent="big"),
    ),
    "take up a plate": (
        "take_up(agent,plate,big)",
        at("a", ready=PLATE, sent="big"),
        at("a", carrying=("big", "plate"), sent="big"),
    ),
    "a jug taken up is full, and so is the one it replaces": (
        "take_up(agent,jug,big)",
        at("a", ready=JUG, empty=JUG),
        at("a", carrying=("big", "jug")),
    ),
    "bring a plate": (
        "bring(agent,plate,big)",
        at("d", carrying=("big", "plate"), sent="big"),
        at("d", sent="big", served="big"),
    ),
    "bring to a table that is free": (
        "bring(agent,jug,big)",
        at("d", carrying=("big", "jug")),
        at("d"),
    ),
    "a jug taken for refilling is still empty": (
        "refill(agent,jug,big)",
        at("d", empty=JUG),
        at("d", empty=JUG, carrying=("big", "jug")),
    ),
    "an empty jug is full once at the bar": (
        "go_to(agent,a)",
        at("b", empty=JUG, carrying=("big", "jug")),
        at("a", carrying=("big", "jug")),
    ),
    "another empty jug stays empty at the bar": (
        "go_to(agent,a)",
        at("b", empty=frozenset({("small", "jug")}), carrying=("big", "jug")),
        at("a", empty=frozenset({("small", "jug")}), carrying=("big", "jug")),
    ),
    "bring chairs": (
        "bring_chairs(agent,big,3)",
        at("d", chairs=(("big", 1), ("small", 2))),
        at("d", chairs=(("big", 3), ("small", 2))),
    ),
}


@pytest.mark.parametrize("case", POSSIBLE)
def test_a_possible_action_changes_what_it_says_and_nothing_else(case: str) -> None:
    text, before, after = POSSIBLE[case]
    problem = posed(before)
    assert apply(problem, before, act(text), 0) == after
    listed = [action.text for action in legal_actions(problem, before, 0)]
    assert text.replace("c2", "c1") in listed


IMPOSSIBLE = {
    "go where no edge leads": ("go_to(agent,d)", START, "d is no neighbour of a"),
    "stay by going": ("go_to(agent,a)", START, "a is no neighbour of a"),
    "go onto a waiter": ("go_to(agent,c)", at("b"), "w stands on c"),
    "go nowhere": ("go_to(agent,z)", START, "there is no node z"),
    "pick elsewhere": (
        "pick(agent,c1)",
        at("d", waiting=(LED,)),
        "the agent is at d, not at the entrance e",
    ),
    "pick nobody": ("pick(agent,c9)", at("e"), "nobody inside is called c9"),
    "pick who sits": (
        "pick(agent,c1)",
        at("e", seated=ONE),
        "the party of c1 does not wait at the entrance",
    ),
    "pick a second party": (
        "pick(agent,c3)",
        at("e", waiting=(("c3",),), with_agent=LED),
        "the party of c1 already follows the agent",
    ),
    "pick without a free table": (
        "pick(agent,c3)",
        at("e", waiting=(("c3",),), seated=(*ONE, ("small", ("c2",)))),
        "no table is free",
    ),
    "seat who waits": (
        "seat(agent,c1,big)",
        at("d", waiting=(LED,)),
        "the party of c1 does not follow the agent",
    ),
    "seat from afar": (
        "seat(agent,c1,small)",
        at("b", with_agent=LED),
        "small is reached from d, the agent is at b",
    ),
    "seat at a taken table": (
        "seat(agent,c2,big)",
        at("d", with_agent=("c2",), seated=ONE),
        "big is not free: the party of c1 sits there",
    ),
    "seat too many": (
        "seat(agent,c1,small)",
        at("d", with_agent=("c1", "c2", "c3")),
        "small is for 2, the party of c1 has 3",
    ),
    "seat without chairs": (
        "seat(agent,c1,big)",
        at("d", with_agent=LED, chairs=(("big", 1), ("small", 2))),
        "big has 1 chairs, the party of c1 has 2",
    ),
    "bill that is not wanted": (
        "give_bill(agent,big)",
        at("d", seated=ONE),
        "big does not want its bill",
    ),
    "bill at a free table": (
        "give_bill(agent,big)",
        at("d", wants_bill="big"),
        "nobody sits at big",
    ),
    "bill from afar": (
        "give_bill(agent,big)",
        at("e", seated=ONE, wants_bill="big"),
        "big is reached from b or d, the agent is at e",
    ),
    "order that is not ready": (
        "take_order(agent,big)",
        at("d", seated=ONE),
        "big is not ready to order",
    ),
    "order of a free table": (
        "take_order(agent,big)",
        at("d", ready_to_order="big"),
        "nobody sits at big",
    ),
    "order from afar": (
        "take_order(agent,big)",
        at("a", seated=ONE, ready_to_order="big"),
        "big is reached from b or d, the agent is at a",
    ),
    "send what was not taken": (
        "send_order(agent,big)",
        at("a", seated=ONE, sent="big"),
        "the agent holds no order of big",
    ),
    "send from afar": (
        "send_order(agent,big)",
        at("b", ordered="big"),
        "the bar is at a, the agent is at b",
    ),
    "take up what is not ready": (
        "take_up(agent,jug,big)",
        at("a", ready=PLATE),
        "no jug for big is ready",
    ),
    "take up with full hands": (
        "take_up(agent,plate,big)",
        at("a", ready=PLATE, carrying=("small", "jug")),
        "the agent carries the jug for small",
    ),
    "take up from afar": (
        "take_up(agent,plate,big)",
        at("b", ready=PLATE),
        "the bar is at a, the agent is at b",
    ),
    "bring to another table": (
        "bring(agent,plate,small)",
        at("d", carrying=("big", "plate")),
        "the agent does not carry the plate for small",
    ),
    "bring from afar": (
        "bring(agent,plate,big)",
        at("a", carrying=("big", "plate")),
        "big is reached from b or d, the agent is at a",
    ),
    "bring an empty jug": (
        "bring(agent,jug,big)",
        at("d", carrying=("big", "jug"), empty=JUG),
        "the jug for big is empty",
    ),
    "refill a full jug": ("refill(agent,jug,big)", at("d"), "the jug of big is not empty"),
    "refill with full hands": (
        "refill(agent,jug,big)",
        at("d", empty=JUG, carrying=("small", "plate")),
        "the agent carries the plate for small",
    ),
    "refill a plate": (
        "refill(agent,plate,big)",
        at("d", empty=JUG),
        "there is no refillable plate",
    ),
    "refill from afar": (
        "refill(agent,jug,big)",
        at("e", empty=JUG),
        "big is reached from b or d, the agent is at e",
    ),
    "fewer chairs": (
        "bring_chairs(agent,big,1)",
        at("d", chairs=(("big", 2), ("small", 2))),
        "big is for 4 and has 2 chairs",
    ),
    "chairs beyond the capacity": (
        "bring_chairs(agent,big,5)",
        at("d", chairs=(("big", 2), ("small", 2))),
        "big is for 4 and has 2 chairs",
    ),
    "chairs where none is missing": (
        "bring_chairs(agent,big,4)",
        at("d"),
        "every table has all its chairs from the start",
    ),
    "chairs from afar": (
        "bring_chairs(agent,small,2)",
        at("b", chairs=(("big", 4), ("small", 1))),
        "small is reached from d, the agent is at b",
    ),
    "chairs that are no number": (
        "bring_chairs(agent,big,many)",
        at("d"),
        "there is no number many",
    ),
    "an unknown table": ("give_bill(agent,table9)", START, "there is no table table9"),
    "an unknown object": ("take_up(agent,spoon,big)", START, "there is no object spoon"),
    "an unknown action": ("fly(agent,b)", START, "there is no action fly"),
    "an argument too few": (
        "seat(agent,c1)",
        START,
        "the form of this action is seat(agent,CUSTOMER,TABLE)",
    ),
    "someone else": (
        "go_to(w,b)",
        START,
        "the form of this action is go_to(agent,NODE)",
    ),
}


@pytest.mark.parametrize("case", IMPOSSIBLE)
def test_an_impossible_action_says_why(case: str) -> None:
    text, state, reason = IMPOSSIBLE[case]
    with pytest.raises(Illegal) as caught:
        apply(posed(state), state, act(text), 0)
    assert caught.value.reason == f"{text}: {reason}"
    assert text not in [action.text for action in legal_actions(posed(state), state, 0)]


def test_the_instant_kitchen_has_the_plate_ready_at_once() -> None:
    state = at("a", ordered="big")
    problem = posed(state, instant_kitchen=True)
    assert apply(problem, state, act("send_order(agent,big)"), 0).ready == PLATE
    jugs = posed(state, instant_kitchen=True, layout=replace(HALL, objects=("jug",)))
    assert apply(jugs, state, act("send_order(agent,big)"), 0).ready == frozenset()


def test_without_a_bar_nothing_is_ordered() -> None:
    state = at("d", seated=ONE, ready_to_order="big")
    bare = posed(state, layout=replace(HALL, bar=None, objects=()))
    with pytest.raises(Illegal, match="this layout has no bar"):
        apply(bare, state, act("take_order(agent,big)"), 0)
    assert {a.name for a in legal_actions(bare, state, 0)} == {"go_to"}


def test_an_empty_jug_in_hand_at_the_bar_is_full_from_the_start() -> None:
    state = at("a", empty=JUG, carrying=("big", "jug"))
    assert begin(posed(state)).empty == frozenset()


# w goes from c to b at step 2
WALKS = replace(HALL, timetable=(("w", 2, "b"),))


def test_a_timetable_moves_waiters_and_closes_the_nodes_they_come_to() -> None:
    problem = posed(START, layout=WALKS)
    second = idle(problem, START, 0)
    assert second == START
    assert idle(problem, second, 1).waiters == (("w", "b"),)
    assert apply(problem, START, act("go_to(agent,b)"), 0).agent == "b"
    with pytest.raises(Illegal, match=r"go_to\(agent,b\): w stands on b at step 2"):
        apply(problem, START, act("go_to(agent,b)"), 1)
    with pytest.raises(Illegal, match="waiting: w stands on b at step 2"):
        idle(problem, at("b"), 1)
    with pytest.raises(Illegal, match="w stands on c"):  # no changing places
        apply(problem, at("b"), act("go_to(agent,c)"), 1)
    with pytest.raises(Illegal, match=r"give_bill\(agent,big\): w stands on b"):
        stays = at("b", seated=ONE, wants_bill="big")
        apply(problem, stays, act("give_bill(agent,big)"), 1)


GOALS = {
    "seated": (Goal("seated", party=LED), at("a", seated=(("big", LED),)), True),
    "seated, led": (Goal("seated", party=LED), at("a", with_agent=LED), False),
    "seated there": (Goal("seated", LED, table="big"), at("a", seated=(("big", LED),)), True),
    "seated elsewhere": (
        Goal("seated", LED, table="small"),
        at("a", seated=(("big", LED),)),
        False,
    ),
    "paid": (Goal("paid", table="big"), at("a", seated=ONE, paid="big"), True),
    "paid, free again": (Goal("paid", table="big"), at("a", paid="big"), False),
    "paid, wanted anew": (
        Goal("paid", table="big"),
        at("a", seated=ONE, paid="big", wants_bill="big"),
        False,
    ),
    "paid by nobody": (Goal("paid", table="big"), at("a", seated=ONE), False),
    "paid by a party": (Goal("paid", party=("c1",)), at("a", seated=ONE, paid="big"), True),
    "paid by a party that waits": (
        Goal("paid", party=("c1",)),
        at("a", waiting=(("c1",),), paid="big"),
        False,
    ),
    "at": (Goal("at", node="b"), at("b"), True),
    "not at": (Goal("at", node="b"), at("a"), False),
    "ordered, taken": (Goal("ordered", table="big"), at("a", ordered="big"), True),
    "ordered, sent": (Goal("ordered", table="big"), at("a", sent="big"), True),
    "ordered, not yet": (Goal("ordered", table="big"), at("a", ready_to_order="big"), False),
    "sent": (Goal("sent", table="big"), at("a", sent="big"), True),
    "sent, held": (Goal("sent", table="big"), at("a", ordered="big"), False),
    "served": (Goal("served", table="big"), at("a", sent="big", served="big"), True),
    "served, ready": (
        Goal("served", table="big"),
        at("a", served="big", ready=PLATE),
        False,
    ),
    "served, ordered again": (
        Goal("served", table="big"),
        at("a", served="big", ordered="big"),
        False,
    ),
    "plate served, carried": (
        Goal("served", table="big", item="plate"),
        at("a", served="big", carrying=("big", "plate")),
        False,
    ),
    "plate served": (Goal("served", table="big", item="plate"), at("a", served="big"), True),
    "plate never brought": (Goal("served", table="big", item="plate"), at("a"), False),
    "jug served": (Goal("served", table="big", item="jug"), at("a"), True),
    "jug served, empty": (Goal("served", table="big", item="jug"), at("a", empty=JUG), False),
    "jug served, ready": (Goal("served", table="big", item="jug"), at("a", ready=JUG), False),
    "filled": (Goal("filled", table="big", item="jug"), at("a"), True),
    "filled, empty": (Goal("filled", table="big", item="jug"), at("a", empty=JUG), False),
    "filled, on its way": (
        Goal("filled", table="big", item="jug"),
        at("a", carrying=("big", "jug")),
        False,
    ),
    "chairs": (Goal("chairs", table="big", number=4), START, True),
    "too few chairs": (Goal("chairs", table="big", number=5), START, False),
    "visit": (Goal("serve", party=("c1",)), at("a", seated=ONE), True),
    "visit, waiting": (Goal("serve", party=("c1",)), at("a", waiting=(("c1",),)), False),
    "visit, bill": (Goal("serve", party=("c1",)), at("a", seated=ONE, wants_bill="big"), False),
    "visit, order": (
        Goal("serve", party=("c1",)),
        at("a", seated=ONE, ready_to_order="big"),
        False,
    ),
    "visit, order held": (Goal("serve", party=("c1",)), at("a", seated=ONE, ordered="big"), False),
    "visit, order sent": (Goal("serve", party=("c1",)), at("a", seated=ONE, sent="big"), True),
    "visit, plate ready": (Goal("serve", party=("c1",)), at("a", seated=ONE, ready=PLATE), False),
    "visit, plate carried": (
        Goal("serve", party=("c1",)),
        at("a", seated=ONE, carrying=("big", "plate")),
        False,
    ),
    "visit, jug empty": (Goal("serve", party=("c1",)), at("a", seated=ONE, empty=JUG), False),
    "visit, jug of another table": (
        Goal("serve", party=("c1",)),
        at("a", seated=ONE, empty=frozenset({("small", "jug")})),
        True,
    ),
}


@pytest.mark.parametrize("case", GOALS)
def test_goals(case: str) -> None:
    goal, state, expected = GOALS[case]
    assert holds(goal, state, posed(state)) is expected


def test_legal_actions_are_of_the_step_that_is_asked_for() -> None:
    busy = at("e", waiting=(LED,), chairs=(("big", 1), ("small", 2)))
    for state in (busy, at("d", with_agent=LED), at("b", seated=ONE, wants_bill="big", empty=JUG),
                  at("a", seated=ONE, ready=PLATE), at("d", chairs=(("big", 1), ("small", 2)))):  # fmt: skip
        found = legal_actions(posed(state), state, 3)
        assert found and {action.step for action in found} == {3}
    brought = {a.text for a in found if a.name == "bring_chairs"}
    assert brought == {f"bring_chairs(agent,big,{number})" for number in (2, 3, 4)}
