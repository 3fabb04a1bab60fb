"""Rounds of cuts in the middle of the best solutions and at corners: the same bounds, in fewer rounds."""

from __future__ import annotations

import pytest

from waiter_cli.bounds import Bounds, find_bounds
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.flow_bounds import make_closing
from waiter_cli.flow_bounds.exact_bound import UNIT, rounded
from waiter_cli.flow_bounds.layer_builder import build_layers
from waiter_cli.flow_bounds.modes import FlowRow
from waiter_cli.flow_bounds.programme import CORNER, INSIDE, THROUGH, Programme
from waiter_cli.flow_bounds.relaxation import FlowRelaxation
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.problems.pose import pose_problem

pytest.importorskip("highspy")

SEED, LENGTH = 4, 177


def fresh() -> tuple[FlowRelaxation, int]:
    """The programme of an evening with bar, 50 nodes; what walks cost in its shortest plan."""
    layout_text, scenario = generate_instance(SEED, "L", bar=True)
    layout = read_layout(layout_text, "layout.yaml")
    problem = pose_problem(layout, read_scenario(scenario, "evening.yaml", layout))
    closing = make_closing(problem, Bounds(0, find_bounds(problem).plan, None))
    assert closing is not None
    relaxation = FlowRelaxation(build_layers(closing.jobs, closing.floor), LENGTH)
    return relaxation, LENGTH - closing.jobs.deeds


@pytest.mark.wide
def test_the_middle_proves_what_corners_prove_in_fewer_rounds(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ways: list[str] = []
    solve = Programme.solve

    def counted(self: Programme, deadline: float | None = None, way: str = CORNER) -> bool | None:
        ways.append(way)
        return solve(self, deadline, way)

    monkeypatch.setattr(Programme, "solve", counted)
    relaxation, enough = fresh()
    relaxation.solve(enough)
    assert relaxation.refuted and relaxation.bound == enough
    corners = len(ways)
    ways.clear()
    relaxation, enough = fresh()
    relaxation.approach(enough)
    assert relaxation.refuted and relaxation.bound == enough
    assert set(ways) == {INSIDE} and len(ways) < 0.7 * corners


@pytest.mark.wide
def test_what_the_middle_leaves_open_ends_at_a_corner() -> None:
    """With a plan that is one step longer, nothing is refuted, and the solution is one of few arcs."""
    relaxation, enough = fresh()
    inside, _ = fresh()
    relaxation.approach(enough + 1)
    assert not relaxation.refuted and relaxation.bound == enough
    inside.solve(enough + 1, way=INSIDE)
    used = [int((each.programme.values > 1e-6).sum()) for each in (relaxation, inside)]
    assert used[0] < used[1]


def test_every_way_leads_to_a_solution_of_the_same_cost() -> None:
    programme = fresh()[0].programme
    found = []
    for way in (INSIDE, THROUGH, CORNER):
        assert programme.solve(None, way)
        found.append(programme.value)
    assert found == pytest.approx([found[0]] * 3)


def test_high_prices_are_not_cut_off() -> None:
    """The middle has prices of 38,000 where columns were left out."""
    row = FlowRow(0, 0, ((0, 1), (1, -1)))
    assert rounded([row, row], [40_000.0, -40_000.0]) == [40_000 * UNIT, -40_000 * UNIT]
