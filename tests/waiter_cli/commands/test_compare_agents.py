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


PAIR = """
name: pair
nodes: {a: [0, 0], b: [1, 0], c: [2, 0], d: [1, 1], e: [3, 0]}
edges: [[a, b], [b, c], [b, d], [c, e]]
entrance: a
tables: {t1: {capacity: 2, nodes: [c]}, t2: {capacity: 2, nodes: [d]}}
agents: {r2: b, zoe: c}
"""


def test_a_layout_with_robots_keeps_the_first_and_gets_more(tmp_path: Path) -> None:
    layout, noon = tmp_path / "pair.yaml", tmp_path / "noon.yaml"
    layout.write_text(PAIR)
    noon.write_text("name: noon\nobserve: [{enter: [c1]}, {enter: [c2]}]\n")
    ran = waiter("compare", str(layout), "--agents", "1..3", "--scenario", str(noon), "--json")
    (row,) = ran.json()["scenarios"]
    steps = [one["steps"] for one in row["results"]]
    assert steps == sorted(steps, reverse=True) and steps[0] > steps[1]
    read = waiter_cli.read_layout(str(layout))
    problem = waiter_cli.pose_problem(*waiter_cli.read_scenario(str(noon), read))
    assert with_robots(problem, 2) is problem
    assert with_robots(problem, 1).layout.agents == (("r2", "b"),)
    more = with_robots(problem, 4).layout.agents
    assert more[:2] == (("r2", "b"), ("zoe", "c"))
    assert [name for name, _ in more[2:]] == ["r1", "r3"]
    assert {node for _, node in more} == {"a", "b", "c", "d"}


@pytest.mark.parametrize(
    ("scenario", "why"),
    [
        ("goals: [{at: {zoe: e}}]", "2:15: error: zoe is wanted at e"),
        ("state: {agents: {zoe: e}, with_agent: {zoe: [c1]}}\ngoals: [{seated: [c1]}]", "something to do"),
    ],
)  # fmt: skip
def test_a_robot_that_is_needed_is_not_left_out(tmp_path: Path, scenario: str, why: str) -> None:
    layout, noon = tmp_path / "pair.yaml", tmp_path / "noon.yaml"
    layout.write_text(PAIR)
    noon.write_text(f"name: noon\n{scenario}\n")
    ran = waiter("compare", str(layout), "--agents", "1..2", "--scenario", str(noon))
    assert ran.code == 2 and why in ran.err and "compare with more robots" in ran.err


def test_two_layouts_with_several_robots_are_compared_in_steps(tmp_path: Path) -> None:
    pair, alone, noon = (tmp_path / f"{name}.yaml" for name in ("pair", "alone", "noon"))
    pair.write_text(PAIR)
    alone.write_text(PAIR.replace("agents: {r2: b, zoe: c}", "agent: b"))
    noon.write_text("name: noon\nobserve: [{enter: [c1]}, {enter: [c2]}]\n")
    given = ("compare", str(alone), str(pair), "--scenario", str(noon))
    document = waiter(*given, "--json").json()
    assert document["difference"]["steps"] < 0
    assert document["totals"][1]["waiting_unit"] == "steps"
    assert waiter(*given).code == 0
