"""A state's questions, with one robot and with several; goals in the shape of files."""

from __future__ import annotations

from typing import Any

import pytest

from waiter_cli.errors import Where
from waiter_cli.model.state import Goal, Observation, Robot, State

SEATED = (("t1", ("c1", "c2")),)
ALONE = State(
    "n1", seated=SEATED, waiting=(("c5",),), with_agent=("c3", "c4"), ordered=frozenset({"t1"}),
    carrying=("t2", "jug"),
)  # fmt: skip
FIRST = Robot("r1", "n1", leads=("c3", "c4"), orders=frozenset({"t1"}))
SECOND = Robot("r2", "n2", carries=("t2", "jug"), orders=frozenset({"t3"}))
FLEET = State("", seated=SEATED, waiting=(("c5",),), robots=(FIRST, SECOND))


@pytest.mark.parametrize("state", [ALONE, FLEET], ids=["one", "several"])
def test_parties_are_those_who_sit_then_follow_then_wait(state: State) -> None:
    assert state.parties() == (("c1", "c2"), ("c3", "c4"), ("c5",))
    assert state.led() == (("c3", "c4"),)
    assert state.party_of("c4") == ("c3", "c4") and state.party_of("c9") is None
    assert state.table_of("c2") == "t1" and state.table_of("c3") is None
    assert state.carried() == {("t2", "jug")}


def test_nobody_is_led_where_nobody_follows() -> None:
    assert State("n1").led() == () and State("n1").carried() == frozenset()
    assert State("", robots=(SECOND,)).led() == ()


def test_orders_of_all_robots_are_held() -> None:
    assert ALONE.held_orders() == {"t1"}
    assert FLEET.held_orders() == {"t1", "t3"}


def test_one_robot_is_called_agent() -> None:
    assert ALONE.stations() == {"agent": "n1"}
    assert ALONE.crew() == (Robot("agent", "n1", ("c3", "c4"), ("t2", "jug"), frozenset({"t1"})),)
    assert ALONE.robot("agent") is None, "it is none of several"


def test_several_robots_have_their_names() -> None:
    assert FLEET.stations() == {"r1": "n1", "r2": "n2"}
    assert FLEET.crew() == (FIRST, SECOND)
    assert FLEET.robot("r2") == SECOND and FLEET.robot("r3") is None


@pytest.mark.parametrize(
    ("goal", "shape"),
    [
        (Goal("seated", party=("c1", "c2")), {"seated": ["c1", "c2"]}),
        (Goal("seated", party=("c1",), table="t1"), {"seated": {"party": "c1", "table": "t1"}}),
        (Goal("paid", party=("c1", "c2")), {"paid": "c1"}),
        (Goal("paid", table="t1"), {"paid": "t1"}),
        (Goal("at", node="n1"), {"at": "n1"}),
        (Goal("at", node="n1", robot="r2"), {"at": {"r2": "n1"}}),
        (Goal("served", table="t1"), {"served": "t1"}),
        (Goal("filled", table="t1", item="jug"), {"filled": {"t1": "jug"}}),
        (Goal("chairs", table="t1", number=4), {"chairs": {"t1": 4}}),
        (Goal("serve", party=("c1", "c2")), {"serve": "c1"}),
        (Goal("holds_not", fluent="dirty(t1)"), {"holds_not": "dirty(t1)"}),
        (Goal("ordered", table="t1"), {"ordered": "t1"}),
    ],
    ids=lambda value: value.kind if isinstance(value, Goal) else "",
)
def test_a_goal_has_the_shape_of_files(goal: Goal, shape: dict[str, Any]) -> None:
    assert goal.as_dict() == shape


def test_places_in_files_tell_nothing_apart() -> None:
    here, there = Where("a.yaml", 1, 1), Where("b.yaml", 2, 2)
    assert Goal("at", node="n1", where=here) == Goal("at", node="n1", where=there)
    assert Observation("bill", ("t1",), here) == Observation("bill", ("t1",), there)
