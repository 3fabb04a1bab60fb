"""The robot drives along edges: how long it takes, where it slips back, what stands ahead."""

from __future__ import annotations

import pytest

from tests.support.playing import corridor, play
from waiter_cli.simulation.outcome import Rules


def test_who_drives_faster_is_there_sooner() -> None:
    slow, fast = (play(corridor(2.0, {}), rules=Rules(speed=v)).outcome for v in (0.4, 0.8))
    assert slow.status == fast.status == "done"
    assert slow.seconds > 1.5 * fast.seconds


def test_each_edge_ends_on_its_node() -> None:
    run = play(corridor(1.0, {}))
    places = [(event["node"], event["robot"]["x"]) for event in run.of("arrived")]
    assert places == [("n1", 1.0), ("n2", 2.0), ("n3", 3.0), ("n4", 4.0)]


def test_who_slips_stands_where_he_was() -> None:
    run = play(corridor(1.0, {}), inject=["slip:1"], rules=Rules(on_failure="stop"))
    failed = run.of("action_failed")[0]
    assert failed["robot"]["x"] == pytest.approx(0.0) and failed["robot"]["node"] == "n0"
