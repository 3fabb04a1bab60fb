"""PyBullet measures what plain arithmetic does, prints nothing, and may be missing."""

from __future__ import annotations

import random
from importlib.util import find_spec

import pytest

from tests.support.playing import layout_of, play
from waiter_cli.errors import MissingError
from waiter_cli.problems.from_options import read_problem
from waiter_cli.room.room import build_room
from waiter_cli.room.shapes import Box, Disc
from waiter_cli.simulation.clearance import REACH, Geometric
from waiter_cli.simulation.open_backend import open_backend


@pytest.mark.sim
@pytest.mark.parametrize("name", ["bistro", "generated4"])
def test_clearances_agree_within_a_millimetre(name: str) -> None:
    pytest.importorskip("pybullet")
    layout = layout_of(name)
    room = build_room(layout)
    solids = [
        *room.furniture({t.name: t.capacity for t in layout.tables}),
        Disc("c1", *room.queue[0], 0.2),
        Box("askew", *room.queue[1], 0.5, 0.1, 0.7),
    ]
    exact, measured = Geometric(), open_backend("pybullet")
    exact.put(solids)
    measured.put(solids)
    rng = random.Random(3)
    x0, x1, y0, y1 = room.bounds
    near = 0
    for _ in range(1500):
        x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
        gap, _name = exact.clearance(x, y)
        if gap > -0.1:
            near += gap < REACH
            assert measured.clearance(x, y)[0] == pytest.approx(gap, abs=1e-3)
    measured.close()
    assert near > 100


@pytest.mark.sim
@pytest.mark.parametrize(
    ("scenario", "inject"), [("b1", ["block:n5-n6@12+5"]), ("b2", ["slip:0.3"])]
)
def test_both_backends_write_the_same_events(scenario: str, inject: list[str]) -> None:
    pytest.importorskip("pybullet")
    problem = read_problem(None, scenario)[0]
    first = play(problem, inject=inject)
    second = play(problem, inject=inject, backend="pybullet")
    assert first.lines[0].replace("geometric", "pybullet") == second.lines[0]
    assert first.lines[1:] == second.lines[1:]


@pytest.mark.sim
def test_nothing_of_pybullet_is_printed(capfd: pytest.CaptureFixture[str]) -> None:
    if find_spec("pybullet") is None:  # importing it here would print
        pytest.skip("PyBullet is missing")
    backend = open_backend("pybullet")
    backend.put([Box("table", 0, 0, 0.5, 0.5)])
    backend.clearance(0.9, 0.0)
    backend.close()
    assert capfd.readouterr() == ("", "")


def test_pybullet_that_is_missing_is_said_with_the_mend(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(MissingError, match=r"pip install .*(pybullet|\[sim\])|geometric"):
        open_backend("pybullet")
