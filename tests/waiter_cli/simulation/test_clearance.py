"""Both backends say the same; the physics drive arrives; clearances are what they are."""

from __future__ import annotations

import pytest

from waiter_cli.room.shapes import Box, Disc
from waiter_cli.simulation.clearance import REACH, Geometric


def test_clearance_is_measured_from_the_hull() -> None:
    backend = Geometric()
    backend.put([Box("table", 0, 0, 0.5, 0.5), Disc("c1", 3, 0, 0.2)])
    assert backend.clearance(0.9, 0.0) == (pytest.approx(0.15), "table")
    assert backend.clearance(2.4, 0.0) == (pytest.approx(0.15), "c1")
    assert backend.clearance(0.6, 0.0)[0] == pytest.approx(-0.15)
    assert backend.clearance(0.0, 9.0) == (REACH, None)
    backend.put([Disc("c1", 3, 0, 0.2)])
    assert backend.clearance(0.9, 0.0) == (REACH, None)
