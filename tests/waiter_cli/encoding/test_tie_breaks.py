"""Ties among minimal plans: every preference chooses, none costs a step."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.planning import length, search
from tests.support.sampling import mostly_slow
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.tie_breaks import chosen_preferences
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchStatus
from waiter_cli.problems.pose import pose_problem

# Two ways of two steps lead from the door to each table, and one of them is a detour in metres.
LAYOUT = """
name: ties
nodes: {door: [0, 0], short: [1, 0], long: [0, 9], far: [2, 0], side: [1, 1]}
edges: [[door, short], [short, far], [door, long], [long, far], [short, side]]
entrance: door
tables:
  big: {capacity: 6, nodes: [far]}
  mid: {capacity: 4, nodes: [far]}
  small: {capacity: 2, nodes: [far]}
agent: door
"""


def problem(*enter: int, prefer: tuple[str, ...] = ()) -> Problem:
    posed = pose_problem(read_layout(LAYOUT, "ties.yaml"), None, enter=enter)
    return replace(posed, prefer=prefer)


def actions(posed: Problem, **options: object) -> list[str]:
    result = search(posed, **options)  # type: ignore[arg-type]
    assert result.plan is not None and result.minimal
    return [action.text for action in result.plan.actions]


def test_the_shortest_walk_in_metres() -> None:
    done = actions(problem(2, prefer=("shortest_walk",)))
    assert "go_to(agent,short)" in done and "go_to(agent,long)" not in done


def test_the_smallest_table_that_fits() -> None:
    assert actions(problem(2, prefer=("smallest_table",)))[-1] == "seat(agent,c1,small)"
    assert actions(problem(3, prefer=("smallest_table",)))[-1] == "seat(agent,c1,mid)"


def test_who_came_first_is_picked_first() -> None:
    for sizes in ((2, 4), (4, 2)):
        done = actions(problem(*sizes, prefer=("longest_waiting",)))
        picks = [text for text in done if text.startswith("pick")]
        assert picks[0] == "pick(agent,c1)"


@pytest.mark.parametrize("strategy", ["binary", "gallop", "linear", "minimize"])
def test_several_in_their_order(strategy: str) -> None:
    prefer = ("longest_waiting", "smallest_table", "shortest_walk")
    done = actions(problem(2, 3, prefer=prefer), strategy=strategy)
    assert done[0] == "pick(agent,c1)"
    assert "seat(agent,c1,small)" in done and "seat(agent,c3,mid)" in done
    assert not any("long" in text for text in done)


def test_unasked_a_small_restaurant_gives_the_smallest_table() -> None:
    assert chosen_preferences(problem(2)) == ("smallest_table",)
    assert chosen_preferences(problem(2, prefer=("shortest_walk",))) == ("shortest_walk",)


@pytest.mark.parametrize("seed", mostly_slow(range(16), *range(4)))
def test_ties_never_cost_a_step(seed: int) -> None:
    posed = replace(small_problem(seed), prefer=())
    plain = search(posed, use_bounds=False)
    if plain.status is not SearchStatus.PLAN:
        return
    tied = replace(posed, prefer=("shortest_walk", "smallest_table", "longest_waiting"))
    assert length(search(tied)) == length(plain)
