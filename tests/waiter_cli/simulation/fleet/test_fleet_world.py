"""The world of several robots has rules of its own, for whoever acts."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.sampling import widened
from tests.support.small_worlds import fleet_problem
from waiter_cli.fleets.fleet_bounds import find_fleet_bounds
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Goal, Observation
from waiter_cli.rules.actions import holds
from waiter_cli.rules.joint_steps import begin_together
from waiter_cli.rules.validator import run
from waiter_cli.simulation.fleet.fleet_world import FleetWorld


@pytest.mark.parametrize("seeds", widened(range(40), range(120)))
def test_the_world_ends_where_the_validator_does(seeds: range) -> None:
    """Walks of one step set out together and arrive in any order; deeds are done one after the other."""
    played = 0
    for seed in seeds:
        problem = fleet_problem(seed)
        problem = replace(problem, layout=replace(problem.layout, timetable=(), key_where=()))
        bounds = find_fleet_bounds(problem)
        plan = None if bounds.impossible else bounds.plan
        if plan is None or not (verdict := run(problem, plan)).valid:
            continue
        played += 1
        world = FleetWorld(problem.layout, problem.state, problem.instant_kitchen)
        assert world.state() == begin_together(problem)
        for step, after in enumerate(verdict.states[1:]):
            actions = [action for action in plan.actions if action.step == step]
            for action in actions:
                world.hands[action.arguments[0]].walks = action.name == "go_to"
            for action in sorted(actions, key=lambda each: each.name == "go_to"):
                assert world.breach(action) is None, (seed, action)
                world.perform(action)
            assert world.state() == after, (seed, step)
            assert world.disorder() is None
            for goal in problem.goals:
                assert world.met(goal) == holds(goal, after, problem), (seed, goal)
    assert played > len(seeds) // 3


def test_nobody_enters_a_node_on_which_another_one_stays() -> None:
    problem = next(p for p in map(fleet_problem, range(50)) if len(p.state.robots) > 1)
    world = FleetWorld(problem.layout, problem.state)
    one, other = list(world.hands)[:2]
    here = next(
        node for node, near in world.near.items() if near and node not in world.staff.values()
    )
    world.hands[one].node = here
    world.hands[other].node = next(iter(world.near[here]))
    walk = Action(0, "go_to", (one, world.hands[other].node))
    wrong = world.breach(walk)
    assert wrong is not None
    world.hands[other].walks = True
    world.staff.clear()
    assert world.breach(walk) is None
    assert world.met(Goal("at", node=here, robot=one))
    assert world.suffer(Observation("at", (other, here))) == f"somebody stands on {here}"
