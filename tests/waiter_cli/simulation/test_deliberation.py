"""What a run tells its controller, and what comes of it where the two do not agree."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.playing import Builder
from tests.waiter_cli.simulation.test_body import Told
from waiter_cli.execution.plan_follower import thinking
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation
from waiter_cli.problems.from_options import read_problem
from waiter_cli.simulation.body import OngoingAction
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.outcome import BlockedEdge, RunEnded
from waiter_cli.simulation.world import World


class Reports(Told):
    """Keeps what failed, too."""

    def __init__(self) -> None:
        super().__init__()
        self.wrong: list[str] = []

    def fail(self, wrong: Any) -> None:
        self.wrong.append(wrong.check)


def parts(name: str = "b1") -> tuple[Deliberation, World, OngoingAction, Reports, Problem]:
    problem = read_problem(None, name)[0]
    world = World(problem.layout, problem.state)
    ongoing, reports = OngoingAction(), Reports()
    reporter: Any = reports
    mind = thinking(problem, Builder())
    return (
        Deliberation(mind, problem.layout, world, ongoing, reporter),
        world,
        ongoing,
        reports,
        problem,
    )


def test_a_world_that_is_otherwise_ends_the_run() -> None:
    deliberation, world, _, reports, _ = parts()
    deliberation.compare()
    world.robot = next(iter(world.near[world.robot]))
    with pytest.raises(RunEnded, match="not as predicted: agent is"):
        deliberation.compare()
    assert reports.wrong == ["effects"]


def test_what_is_not_believed_ends_the_run() -> None:
    deliberation, _, _, reports, _ = parts()
    with pytest.raises(RunEnded):
        deliberation.done(7)
    assert reports.wrong == ["effects"]


def test_a_changed_plan_is_told_once() -> None:
    deliberation, world, _, reports, _ = parts()
    revision = deliberation.mind.decision.revision
    deliberation.tell(revision, "nothing")
    seen = Observation("leave", ("c1",))
    assert world.suffer(seen) is None
    deliberation.observe([seen])
    deliberation.tell(revision, "the party of c1 left")
    deliberation.tell(deliberation.mind.decision.revision, "nothing")
    assert [kind for kind, _ in reports.said] == ["replan"] and deliberation.replans == 1


def test_edges_are_avoided_from_the_failure_on_until_they_are_open_again() -> None:
    deliberation, _, ongoing, _reports, problem = parts()
    first = deliberation.mind.decision.plan[0]
    ongoing.action = first
    (here, there) = (problem.state.agent, first.arguments[1])
    assert not deliberation.avoid({frozenset((here, there))})  # the only way there
    spare = {frozenset(("n4", "n7")), frozenset(("n6", "n7"))}
    spare &= {frozenset(edge) for edge in problem.layout.edges}
    assert spare and deliberation.avoid(spare)
    assert deliberation.mind.decision.plan[0] == first  # not yet
    deliberation.mind.started(first.step)
    deliberation.failed(first.step, "blocked")
    assert deliberation.mind.layout.edges == tuple(  # type: ignore[attr-defined]
        edge for edge in problem.layout.edges if frozenset(edge) not in spare
    )
    standing = [BlockedEdge(("n4", "n7"), "s", 0.0, None, True, True)]
    deliberation.reopen(standing)
    deliberation.reopen([])
    assert deliberation.mind.layout.edges == problem.layout.edges  # type: ignore[attr-defined]
