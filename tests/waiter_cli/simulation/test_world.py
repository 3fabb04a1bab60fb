"""The simulated world: where it starts and what it does not let pass."""

from __future__ import annotations

import pytest

from tests.support.playing import play, scene
from waiter_cli.model.state import State
from waiter_cli.simulation.world import World


def test_two_on_one_chair_trip_a_check(monkeypatch: pytest.MonkeyPatch) -> None:
    def crowded(self: World, party: tuple[str, ...], table: str) -> None:
        self.tables[table].party = party
        self.tables[table].seats = dict.fromkeys(party, 0)

    monkeypatch.setattr(World, "_sit", crowded)
    assert "chairs" in {f.check for f in play(scene("b2")).outcome.failures}


def test_the_world_starts_as_the_state_says() -> None:
    for name in ("b2", "b4", "lunch"):
        problem = scene(name)
        state: State = World(problem.layout, problem.state, problem.instant_kitchen).state()
        assert state == problem.state
