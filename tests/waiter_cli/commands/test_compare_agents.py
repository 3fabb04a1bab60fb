"""``waiter compare LAYOUT --agents``: one restaurant with more and more robots."""

from __future__ import annotations

from pathlib import Path

import pytest

import waiter_cli
from tests.support.cli import waiter
from waiter_cli.commands.compare_agents import read_numbers
from waiter_cli.errors import InputError
from waiter_cli.fleets.enlarge import with_robots


def test_more_robots_take_no_more_steps() -> None:
    document = waiter("compare", "report", "--agents", "1..3", "--scenario", "b1", "--json").json()
    assert (document["status"], document["agents"]) == ("compared", [1, 2, 3])
    (row,) = document["scenarios"]
    assert [one["steps"] for one in row["results"]] == [7, 6, 5]
    assert all(one["minimal"] for one in row["results"])
    shown = waiter("compare", "report", "--agents", "1..2", "--scenario", "b1").out
    assert [line.split()[:3] for line in shown.splitlines()[2:4]] == [
        ["b1", "1", "7"],
        ["b1", "2", "6"],
    ]


def test_robots_start_beside_the_first_and_have_nothing() -> None:
    problem = waiter_cli.pose_problem(*waiter_cli.read_scenario("b1"))
    assert with_robots(problem, 1) is problem
    three = with_robots(problem, 3)
    assert three.layout.agents == (("r1", "n1"), ("r2", "n2"), ("r3", "n3"))
    assert three.state.parties() == problem.state.parties()
    with pytest.raises(InputError, match="there is no place for 9 robots"):
        with_robots(problem, 9)


@pytest.mark.parametrize("text", ["0", "3..1", "1..11", "two", "", "1..", "-1"])
def test_numbers_that_are_none(text: str) -> None:
    with pytest.raises(InputError, match="numbers of robots from 1 to 10"):
        read_numbers(text)


def test_numbers() -> None:
    assert list(read_numbers("2")) == [2] and list(read_numbers("1..4")) == [1, 2, 3, 4]


def test_what_is_asked_for_has_to_be_one_thing(tmp_path: Path) -> None:
    assert waiter("compare", "report", "--scenario", "b1").code == 2
    both = waiter("compare", "report", "report", "--agents", "2", "--scenario", "b1")
    assert both.code == 2 and "not both B and --agents" in both.err
    layout = tmp_path / "pair.yaml"
    layout.write_text(
        "nodes: [a, b]\nedges: [[a, b]]\nentrance: a\ntables: {}\nagents: {r1: a, r2: b}\n"
    )
    ran = waiter("compare", str(layout), "--agents", "2", "--scenario", "b1")
    assert ran.code == 2 and "pair.yaml:5:9: error: several robots" in ran.err
