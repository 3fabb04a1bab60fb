"""What is to be seen in a drawing: places, walks, deeds, the plan in words, and what is pointed out."""

from __future__ import annotations

import pytest

from tests.support.rule_cases import HALL, ONE, at, plan, posed
from waiter_cli.drawing.subject import Leg, make_subject
from waiter_cli.errors import InputError
from waiter_cli.model.state import Goal

STATE = at("a", seated=ONE, wants_bill="big")
PLAYED = (
    posed(STATE, Goal("paid", table="big")),
    plan("go_to(agent,b)", "go_to(agent,d)", "give_bill(agent,big)"),
)


def test_a_layout_alone_is_empty_and_placed() -> None:
    subject = make_subject(HALL)
    assert subject.state.agent == "a" and dict(subject.state.waiters) == {"w": "c"}
    assert dict(subject.state.chairs) == {"big": 4, "small": 2} and not subject.legs
    assert "no coordinates" in subject.note and set(subject.room.nodes) == set("abcde")
    assert subject.headline == "5 nodes, 2 tables, 6 seats"


def test_a_plan_is_its_walk_and_its_deeds() -> None:
    subject = make_subject(HALL, played=PLAYED)
    assert subject.legs == (Leg(0, "a", "b"), Leg(1, "b", "d"))
    assert [(deed.step, deed.node, deed.text) for deed in subject.deeds] == [(2, "d", "bill big")]
    assert subject.listing[0] == ("0-1", "walk a → b → d") and subject.listing[1][0] == "2"
    assert subject.state == STATE


def test_a_plan_that_is_not_valid_is_drawn_as_far_as_it_goes() -> None:
    wrong = plan("go_to(agent,b)", "go_to(agent,e)", "give_bill(agent,big)")
    subject = make_subject(HALL, played=(PLAYED[0], wrong))
    assert "the plan is not valid" in subject.note and subject.legs == (Leg(0, "a", "b"),)


def test_things_are_pointed_out_by_their_names() -> None:
    subject = make_subject(HALL, highlights=["c", "big", "w", "agent", "bar", "entrance", "b-d"])
    assert subject.marked == {"c", "big", "w", "agent", "bar", "e", "b-d", "d-b"}


@pytest.mark.parametrize(
    ("name", "message", "hint"),
    [
        ("bigg", "nothing in hall is called bigg", "did you mean big"),
        ("a-c", "there is no edge a-c in hall", "there are a-b"),
        ("x-y", "there is no edge x-y in hall", "join two nodes: n1-n2"),
    ],
)
def test_what_is_not_there_cannot_be_pointed_out(name: str, message: str, hint: str) -> None:
    with pytest.raises(InputError) as caught:
        make_subject(HALL, highlights=[name, "c"])
    (fault,) = caught.value.faults
    assert fault.message == message and (fault.hint or "").startswith(hint)
