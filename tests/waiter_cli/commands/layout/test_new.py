"""``waiter layout new``: valid files, the same for the same seed; questions on a terminal."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.terminal import Terminal
from waiter_cli.commands.layout.new import Flaw, Unsolvable
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario_file
from waiter_cli.layout_tools.generate import UNSOLVABLE
from waiter_cli.layout_tools.generate_floor import FLAWS


def test_the_choices_are_those_of_the_generator() -> None:
    assert [kind.value for kind in Unsolvable] == list(UNSOLVABLE)
    assert [kind.value for kind in Flaw] == list(FLAWS)


@pytest.mark.parametrize(
    ("flags", "nodes", "tables", "waiters", "bar"),
    [
        ("--tables 5 --nodes 12 --seed 1", 12, 5, 0, False),
        ("--tables 1 --nodes 2", 2, 1, 0, False),
        ("--tables 8 --nodes 30 --bar --waiters 2", 30, 8, 2, True),
        ("--tables 9", 22, 9, 0, False),
        ("--bar", 14, 6, 0, True),
        ("--tables 3 --nodes 9 --flaw unreachable_table", 9, 3, 0, False),
        ("--tables 4 --nodes 20 --flaw blocked_aisle", 20, 4, 1, False),
    ],
)
def test_the_layout_is_valid_and_as_large_as_asked(
    flags: str, nodes: int, tables: int, waiters: int, bar: bool
) -> None:
    ran = waiter("layout", "new", *flags.split())
    assert (ran.code, ran.err) == (0, "")
    layout = read_layout(ran.out, "new.yaml")
    assert (len(layout.nodes), len(layout.tables)) == (nodes, tables)
    assert len(layout.waiters) == waiters
    assert (layout.bar is not None) is bar


def test_the_same_seed_makes_the_same_file_and_the_file_says_which(tmp_path: Path) -> None:
    flags = ("--tables", "4", "--nodes", "11")
    first = waiter("layout", "new", *flags)
    seed = first.out.split("seed ")[1].split("\n")[0]
    assert waiter("layout", "new", *flags, "--seed", seed).out == first.out
    other = waiter("layout", "new", *flags, "--seed", str(int(seed) + 1)).out
    assert other != first.out
    target = tmp_path / "corner-cafe.yaml"
    ran = waiter("layout", "new", *flags, "--seed", seed, "-o", str(target))
    assert (ran.code, ran.out) == (0, "")
    assert target.read_text() == first.out.replace("name: generated", "name: corner_cafe")


def test_a_file_that_is_there_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "mine.yaml"
    target.write_text("precious")
    ran = waiter("layout", "new", "--tables", "2", "-o", str(target))
    assert ran.code == 2
    assert "--force" in ran.err
    assert target.read_text() == "precious"
    assert waiter("layout", "new", "--tables", "2", "-o", str(target), "--force").code == 0
    assert target.read_text().startswith("# 5 nodes")


def test_a_scenario_names_its_layout_from_where_it_lies(tmp_path: Path) -> None:
    (tmp_path / "lay outs").mkdir()
    layout, evening = tmp_path / "lay outs" / "a.yaml", tmp_path / "evenings.yaml"
    assert (
        waiter("layout", "new", "--tables", "6", "--seed", "2", "--bar", "-o", str(layout)).code
        == 0
    )
    flags = [
        "--scenario",
        "--parties",
        "2",
        "--bills",
        "1",
        "--orders",
        "1",
        "--refills",
        "1",
        "--seed",
        "5",
    ]
    ran = waiter("layout", "new", *flags, "--layout", str(layout), "-o", str(evening))
    assert ran.code == 0
    read, scenario = read_scenario_file(str(evening))
    assert read.name == "a"
    assert scenario.name == "evenings"
    kinds = sorted(seen.kind for seen in scenario.observe)
    assert kinds.count("bill") == kinds.count("order") == kinds.count("empty") == 1
    assert kinds.count("enter") + len(scenario.state.waiting) == 2


def test_an_evening_in_a_built_in_restaurant_can_be_planned(tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    flags = ("--scenario", "--layout", "report", "--parties", "1", "--bills", "1", "--seed", "4")
    path.write_text(waiter("layout", "new", *flags).out)
    ran = waiter("plan", "--scenario", str(path), "--json")
    assert ran.code == 0
    assert ran.json()["layout"] == "report"


def test_an_unsolvable_evening_has_no_plan(tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    flags = ("--scenario", "--layout", "report", "--parties", "1", "--unsolvable", "too_big")
    path.write_text(waiter("layout", "new", *flags).out)
    assert waiter("plan", "--scenario", str(path), "--json").code == 3


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        ("--tables 9 --nodes 3", "9 tables cannot be laid out with 3 nodes"),
        ("--tables 0", "--tables"),
        (
            "--parties 3",
            "--parties is for a scenario, and this makes a layout\n  hint: add --scenario",
        ),
        ("--parties 3", "add --scenario and --layout LAYOUT"),
        (
            "--layout report --bills 1 --orders 0",
            "--layout, --bills and --orders are for a scenario",
        ),
        ("--scenario", "give --layout LAYOUT"),
        ("--scenario --tables 3", "--tables is for a layout"),
        ("--scenario --layout report --tables 3 --bar", "--tables and --bar are for a layout"),
        ("--scenario --layout report --tables 3", "make the layout first"),
        (
            "--scenario --layout report --parties 2 --bills 1",
            "2 parties and 1 bill would take 3 tables",
        ),
        ("--tables x", "'x' is not a whole number."),
        ("--name 3x", "'3x' is no name for a layout\n  hint: names begin with a small letter"),
        ("--scenario --layout report --orders 1", "take a bar"),
        ("--scenario --layout report --parties 9", "ask for fewer"),
        ("--scenario --layout nowhere", "there is no layout nowhere"),
        ("--scenario --layout -", "standard input"),
        ("--tables 3 --name Café", "is no name for a layout"),
        ("--tables 2 --nodes 4 --waiters 9", "stand in the way"),
    ],
)
def test_what_cannot_be_made_is_a_fault(flags: str, message: str) -> None:
    ran = waiter("layout", "new", *flags.split())
    assert ran.code == 2
    assert ran.out == ""
    assert message in ran.err


def test_on_a_terminal_it_asks(tmp_path: Path) -> None:
    answers = [
        ("Name of", "no good"), ("Name of", "corner"), ("Tables", "0"), ("Tables", "4"),
        ("Places", ""), ("Other waiters", "1"), ("A bar", "y"), ("Seed", "7"), ("File", ""),
    ]  # fmt: skip
    with Terminal("layout", "new", cwd=tmp_path) as terminal:
        for question, answer in answers:
            terminal.expect(question)
            terminal.type(answer)
        assert terminal.end() == 0
    layout = read_layout((tmp_path / "corner.yaml").read_text(), "corner.yaml")
    assert (layout.name, len(layout.tables), len(layout.waiters)) == ("corner", 4, 1)
    assert layout.bar is not None
