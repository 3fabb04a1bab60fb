"""An action as a person writes it: forms that are taken, and the mends of those that are not."""

from __future__ import annotations

import pytest

from tests.support.own_domains import dirty_domain
from tests.support.planning import scenario
from tests.support.rule_cases import LED, ONE, at, posed
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import InputError
from waiter_cli.explanation.foil_reader import read_foil
from waiter_cli.model.problem import Problem

HOUSE = find_domain("restaurant")
HALL = posed(at("b", seated=ONE, waiting=(("c7", "c8"),), with_agent=LED))


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("seat(agent,c7,small)", "seat(agent,c7,small)"),
        ("seat(c7, small)", "seat(agent,c7,small)"),
        ("  seat ( agent , c8 , small ) . ", "seat(agent,c7,small)"),
        ("pick(c8)", "pick(agent,c7)"),
        ("give_bill(big)", "give_bill(agent,big)"),
        ("bring_chairs(agent,big,4)", "bring_chairs(agent,big,4)"),
        ("take_up(jug, big)", "take_up(agent,jug,big)"),
    ],
)
def test_a_foil_is_read_as_people_write_it(text: str, action: str) -> None:
    found = read_foil(text, HALL, HOUSE)
    assert (found.text, found.step) == (action, 0)


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("seat", "'seat' is no action", "write it as seat(agent,c2,table1)"),
        ("sit(agent,c7,small)", "unknown action sit", None),
        ("give_bil(big)", "unknown action give_bil", "did you mean give_bill?"),
        ("seat(agent,c7)", "seat has other arguments", "write seat(agent,CUSTOMER,TABLE)"),
        ("go_to(agent,n7)", "unknown node n7", "known are a, b, c, d, e"),
        ("seat(agent,c9,small)", "unknown customer c9", None),
        ("seat(agent,c7,smal)", "unknown table smal", "did you mean small?"),
        ("bring(agent,soup,big)", "unknown object soup", "known are plate, jug, basket"),
        ("bring_chairs(agent,big,two)", "two is no number of chairs", "write a whole number"),
        ("bring_chairs(agent,big,-2)", "-2 is no number of chairs", "write a whole number"),
        ("go_to(robby,a)", "unknown robot robby", None),
    ],
)
def test_what_is_no_action_is_refused_with_a_mend(
    text: str, message: str, hint: str | None
) -> None:
    with pytest.raises(InputError) as caught:
        read_foil(text, HALL, HOUSE)
    (fault,) = caught.value.faults
    assert (fault.message, str(fault.where)) == (message, "--why-not")
    assert fault.hint and (hint is None or fault.hint == hint)


def fleet() -> Problem:
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.problems.pose import pose_problem

    text = "nodes: [a, b]\nedges: [[a, b]]\nentrance: a\ntables: {}\nagents: {r1: a, r2: b}\n"
    return pose_problem(read_layout(text, "two.yaml"), goals=["at: a"])


def test_of_several_robots_one_is_named() -> None:
    assert read_foil("go_to(r2, a)", fleet(), HOUSE).text == "go_to(r2,a)"
    with pytest.raises(InputError) as caught:
        read_foil("go_to(a)", fleet(), HOUSE)
    assert caught.value.faults[0].hint == "write go_to(ROBOT,NODE)"


@pytest.mark.parametrize("text", ["go_to(agent,n3)", " go_to( agent, n3 ). "])
def test_a_domain_of_ones_own_says_what_an_action_is(text: str) -> None:
    assert read_foil(text, scenario("b1"), dirty_domain()).text == "go_to(agent,n3)"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("go_to(agent,n33)", "did you mean go_to(agent,n3)?"),
        ("fly", "its actions are go_to, "),
        ("go_to(agent,n3) % or not", "did you mean"),
        ("go_to(agent,n3),0) :- true(a", ""),
    ],
)
def test_nothing_else_is_one(text: str, hint: str) -> None:
    with pytest.raises(InputError) as caught:
        read_foil(text, scenario("b1"), dirty_domain())
    (fault,) = caught.value.faults
    assert fault.message == f"{text} is no action of dirty.sparc"
    assert (fault.hint or "").startswith(hint) and fault.hint
