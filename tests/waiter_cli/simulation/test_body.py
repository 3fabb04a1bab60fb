"""The clock, and the body that moves by it, alone and with somebody in its way."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.playing import layout_of
from waiter_cli.model.plan import Action
from waiter_cli.room.motion import gesture, way
from waiter_cli.room.room import build_room
from waiter_cli.simulation.blocks import STOP_SHORT, Blocks
from waiter_cli.simulation.body import Body, OngoingAction, Shown, SimulatedClock, pose_at
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.outcome import TICKS

ROOM = build_room(layout_of("report"))
N4, N7 = ROOM.nodes["n4"], ROOM.nodes["n7"]


class Told:
    """Keeps what a part says."""

    def __init__(self) -> None:
        self.said: list[tuple[str, dict[str, Any]]] = []

    def say(self, kind: str, /, **details: Any) -> None:
        self.said.append((kind, details))


def parts() -> tuple[SimulatedClock, Body, OngoingAction, Shown]:
    clock, ongoing, shown = SimulatedClock(), OngoingAction(), Shown()
    body = Body((*N4, 0.0), clock, lambda here, target, dt: target, ongoing, shown)
    return clock, body, ongoing, shown


def test_what_is_due_can_be_held_back_and_what_passes_cannot() -> None:
    clock, calls = SimulatedClock(), []
    clock.passing = [lambda: calls.append("passing")]
    clock.due = [lambda: calls.append("due")]
    clock.tick()
    clock.tick(due=False)
    assert calls == ["passing", "due", "passing"]
    assert clock.time == pytest.approx(2 / TICKS)
    clock.skip_to(90)
    clock.skip_to(10)
    assert clock.ticks == 90 and len(calls) == 3


def test_a_robot_looks_along_the_first_edge_of_its_node() -> None:
    x, y, yaw = pose_at(ROOM, "n7")
    assert (x, y) == N7
    first = ROOM.nodes[ROOM.near["n7"][0]]
    assert (first[0] < x) == (abs(yaw) > 1.6)


def test_a_way_is_driven_to_its_end() -> None:
    clock, body, _, _ = parts()
    for move in way(body.pose, N7, 0.8):
        assert body.play(move) is None
    assert body.away(N7) < 1e-6
    assert clock.time > ROOM.length("n4", "n7") / 0.8


def test_a_stall_delays_a_move_and_says_so() -> None:
    clock, body, _, shown = parts()
    banners = set()
    clock.passing = [lambda: banners.add(shown.banner)]
    body.stall(2.0)
    body.stall(1.0)  # ends within the first
    assert body.play(gesture(body.pose, 1.0)) is None
    assert clock.time == pytest.approx(3.0, abs=2 / TICKS)
    assert body.paused == 2 * TICKS
    assert banners == {"stalled", ""} and shown.banner == ""


def test_a_move_ends_once_its_action_is_abandoned() -> None:
    clock, body, ongoing, _ = parts()
    ongoing.action = Action(0, "go_to", ("agent", "n7"))
    clock.due = [lambda: setattr(ongoing, "abandoned", clock.ticks == 5)]
    assert body.play(gesture(body.pose, 1.0)) == "it has become impossible"
    assert clock.ticks == 5


def blocked(seconds: float | None) -> tuple[SimulatedClock, Body, Blocks, Told]:
    clock, body, _, _ = parts()
    told: Any = Told()
    blocks = Blocks(ROOM, Crowd(ROOM), clock, body, told)
    blocks.add(("n4", "n7"), seconds)
    return clock, body, blocks, told


def test_a_stranger_stands_ahead_until_he_goes() -> None:
    clock, body, blocks, told = blocked(4.0)
    opened: list[float] = []
    clock.passing = [lambda: blocks.update(lambda: opened.append(clock.time))]
    (drive,) = [m for m in way(body.pose, N7, 0.8) if m.kind == "drive"]
    found = body.play(drive, lambda: blocks.ahead("n4", "n7"))
    assert found is blocks.on("n7", "n4") is not None
    middle = ((N4[0] + N7[0]) / 2, (N4[1] + N7[1]) / 2)
    assert STOP_SHORT - 0.02 < body.away(middle) < STOP_SHORT
    assert blocks.ahead("n7", "n4") is None  # he stands behind whoever turns round
    body.hold(5.0)
    assert blocks.on("n4", "n7") is None and opened == [pytest.approx(4.0)]
    assert told.said == [("unblocked", {"edge": "n4-n7"})]


def test_nobody_comes_to_stand_where_the_robot_is() -> None:
    _clock, body, blocks, _told = blocked(None)
    body.put(((N4[0] + N7[0]) / 2, N4[1]))
    blocks.update(lambda: None)
    assert not blocks.standing()
    body.put(N7)
    blocks.update(lambda: None)
    assert [block.edge for block in blocks.standing()] == [("n4", "n7")]
