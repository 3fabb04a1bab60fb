"""Floor plans by chance: their numbers, their flaws, and what cannot be laid out."""

from __future__ import annotations

from random import Random

import pytest

from waiter_cli.errors import InputError
from waiter_cli.layout_tools.generate_floor import build_layout, find_cut, least_nodes
from waiter_cli.model.graph import reachable


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(("nodes", "tables"), [(4, 2), (12, 5), (30, 20)])
def test_a_layout_has_the_numbers_asked_for_and_all_of_it_is_reached(
    nodes: int, tables: int, seed: int
) -> None:
    made = build_layout(seed, nodes, tables)
    assert (len(made.nodes), len(made.tables)) == (nodes, tables)
    assert len(reachable(made.neighbours(), made.agent)) == nodes
    assert len({node.at for node in made.nodes}) == nodes
    assert {node for table in made.tables for node in table.nodes} <= {n.name for n in made.nodes}


def test_a_seed_makes_the_same_layout_again() -> None:
    assert build_layout(3, 12, 4, bar=True, waiters=2) == build_layout(
        3, 12, 4, bar=True, waiters=2
    )
    assert build_layout(3, 12, 4) != build_layout(4, 12, 4)


@pytest.mark.parametrize("seed", range(8))
def test_waiters_cut_off_no_table_and_no_bar(seed: int) -> None:
    made = build_layout(seed, 16, 5, bar=True, waiters=3)
    posts = {node for _, node in made.waiters}
    assert len(posts) == 3 and not posts & {made.entrance, made.agent}
    open_ = reachable(made.neighbours(), made.entrance, posts)
    assert made.bar is not None and open_.intersection(made.bar.nodes) and made.agent in open_
    assert all(open_.intersection(table.nodes) for table in made.tables)


@pytest.mark.parametrize("seed", range(8))
def test_a_blocked_aisle_parts_the_agent_from_the_door(seed: int) -> None:
    made = build_layout(seed, 16, 5, waiters=1, flaw="blocked_aisle")
    posts = {node for _, node in made.waiters}
    assert made.agent not in reachable(made.neighbours(), made.entrance, posts)
    assert made.agent in reachable(made.neighbours(), made.entrance)


def test_an_unreachable_table_stands_on_an_island() -> None:
    made = build_layout(1, 16, 5, flaw="unreachable_table")
    reached = reachable(made.neighbours(), made.entrance)
    lost = [table.name for table in made.tables if not reached.intersection(table.nodes)]
    assert lost == ["table5"] and len(made.nodes) == 16


@pytest.mark.parametrize(("tables", "nodes"), [(1, 2), (2, 2), (4, 2), (5, 3), (9, 5)])
def test_so_many_tables_take_so_many_nodes(tables: int, nodes: int) -> None:
    assert least_nodes(tables) == nodes
    assert len(build_layout(1, nodes, tables).tables) == tables
    with pytest.raises(InputError):
        build_layout(1, nodes - 1, tables)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"flaw": "no_door"}, "no such flaw of a layout: no_door"),
        ({"flaw": "blocked_aisle"}, "takes a waiter who blocks it"),
        ({"waiters": 40}, "40 waiters would stand in the way"),
    ],
)
def test_what_cannot_be_met_is_refused(more: dict[str, object], said: str) -> None:
    with pytest.raises(InputError) as caught:
        build_layout(1, 16, 5, **more)  # type: ignore[arg-type]
    assert said in str(caught.value)


def test_a_cut_is_a_node_and_what_it_cuts_off() -> None:
    path = {"a": ("b",), "b": ("a", "c"), "c": ("b",)}
    assert find_cut(Random(1), path, "a") == ("b", "c")
    ring = {"a": ("b", "c"), "b": ("a", "c"), "c": ("b", "a")}
    assert find_cut(Random(1), ring, "a") is None
