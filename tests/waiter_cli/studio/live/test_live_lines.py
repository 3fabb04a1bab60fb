"""Lines of people while several robots work: whatever is clicked, and whenever the studio is started anew."""

from __future__ import annotations

import gc
from pathlib import Path

import pytest

from tests.support.browsing import needs_studio
from tests.support.clicking import Clicks, fleet_floor
from waiter_cli.simulation.outcome import TICKS

pytestmark = needs_studio

RING = """\
name: ring
nodes: {a: [0, 0], b: [2, 0], c: [2, 2], d: [0, 2]}
edges: [[a, b], [b, c], [c, d], [d, a]]
entrance: a
tables: {t1: {capacity: 2, nodes: [c], at: [3, 3]}}
agents: {r1: a, r2: b, r3: c, r4: d}
"""


MANY = [pytest.param(range(k, k + 30), 25, marks=pytest.mark.slow) for k in (12, 42, 72)]


@pytest.mark.parametrize(
    ("seeds", "turns"),
    [(range(2), 12), pytest.param(range(2, 12), 25, marks=pytest.mark.wide), *MANY],
)
def test_clicks_by_chance(seeds: range, turns: int, tmp_path: Path) -> None:
    """Two or three robots, and the studio is ended and started anew in between."""
    for seed in seeds:
        folder = tmp_path / str(seed)
        folder.mkdir()
        with Clicks(fleet_floor(seed, 2 + seed % 2), folder, seed) as clicks:
            for _ in range(turns):
                clicks.turn()
            clicks.settle()
        gc.collect()


@pytest.fixture
def ring(tmp_path: Path) -> Clicks:
    """Four robots that go round a ring, of whom r1 is late: the others are where they were to come."""
    clicks = Clicks(RING, tmp_path)
    clicks.tell({"goal": {"at": {"r1": "b"}}})
    late = clicks.live.run.robots["r1"]  # type: ignore[attr-defined]
    while late.away((0.0, 0.0)) < 1.0:
        clicks.play(1)
        assert clicks.live.run.clock.time < 20, "the ring does not begin"
    late.stall(8.0)
    while len(clicks.executive.finished) < 3:
        clicks.play(1)
        assert late.stalled, "the others do not arrive"
    return clicks


def test_robots_go_round_a_ring_together(ring: Clicks) -> None:
    """Each enters the node that the next one leaves: none of them can begin before the others do."""
    with ring:
        ring.settle()
        assert ring.executive.state.stations() == {"r1": "b", "r2": "c", "r3": "d", "r4": "a"}


@pytest.mark.parametrize("again", [False, True])
def test_a_robot_that_stopped_in_a_ring_goes_on(ring: Clicks, again: bool) -> None:
    """Also where the studio was ended meanwhile: what it was at is not known any more then."""
    with ring:
        assert ring.tell({"observe": {"out": "r1"}})["out"] == ["r1"]
        if again:
            ring.restart()
        ring.check()
        assert ring.executive.out == ("r1",)
        ring.tell({"back": "r1"})
        ring.settle()
        assert ring.executive.state.stations() == {"r1": "b", "r2": "c", "r3": "d", "r4": "a"}


def test_a_step_fails_as_it_is_told(tmp_path: Path) -> None:
    with Clicks(fleet_floor(2, 2), tmp_path) as clicks:
        assert "r1 is at no step" in clicks.tell({"failed": {"r1": 0}})["error"]["message"]
        clicks.tell({"guests": 1})
        while not clicks.executive.moving:
            clicks.play(1)
        (action, *_) = clicks.executive.moving
        robot, step = action.arguments[0], action.step
        told = clicks.tell({"failed": {robot: step + 7}})
        assert f"{robot} is not at step {step + 7}" in told["error"]["message"]
        assert f"it is at step {step}" in told["error"]["hint"]
        assert "error" not in clicks.tell({"failed": {robot: step}, "reason": "wet floor"})
        clicks.play(5 * TICKS)
        clicks.check()
        events = [each["event"]["text"] for each in clicks.live.whole() if "event" in each]
        assert any("wet floor" in text for text in events), events
        assert all(each.step != step for each in clicks.executive.decision.plan)
        clicks.settle()


def test_a_ring_cannot_fail_for_one_alone(ring: Clicks) -> None:
    with ring:
        told = ring.tell({"failed": {"r1": ring.executive.moving[0].step}})
        assert "cannot have stayed" in told["error"]["message"]
        ring.settle()
