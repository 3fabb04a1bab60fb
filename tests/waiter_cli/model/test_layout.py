"""A layout's questions: which nodes an edge leads to, what a name stands for, what it is in a line."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import HALL
from waiter_cli.errors import Where
from waiter_cli.model import layout as module
from waiter_cli.model.layout import Layout, Node, show_layouts_by

ONE_WAY = replace(HALL, one_way=frozenset({("e", "d")}))


def test_neighbours_are_in_the_order_of_the_edges() -> None:
    assert HALL.neighbours() == {
        "a": ("b",), "b": ("a", "c", "d"), "c": ("b",), "d": ("b", "e"), "e": ("d",)
    }  # fmt: skip


def test_a_path_one_way_leads_one_way_and_joins_both() -> None:
    assert ONE_WAY.neighbours()["d"] == ("b",) and ONE_WAY.neighbours()["e"] == ("d",)
    assert ONE_WAY.joined() == HALL.neighbours()
    assert ONE_WAY.leads("e", "d") and not ONE_WAY.leads("d", "e")
    assert HALL.leads("d", "e") and not HALL.leads("a", "c")


def test_a_path_that_is_listed_twice_counts_once() -> None:
    twice = replace(HALL, edges=(*HALL.edges, ("b", "a")))
    assert twice.neighbours() == HALL.neighbours()


def test_names_stand_for_nodes_and_tables() -> None:
    assert HALL.node("c") == Node("c") and HALL.table("small").capacity == 2
    with pytest.raises(KeyError):
        HALL.node("small")
    with pytest.raises(KeyError):
        HALL.table("c")


def test_places_in_files_do_not_tell_layouts_apart() -> None:
    moved = replace(HALL, key_where=(("name", Where("x.yaml", 3, 1)),))
    assert moved == HALL and replace(HALL, name="other") != HALL


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, "hall: 5 nodes, 4 paths, 2 tables for 6 guests, 1 robot, other staff: w, a bar"),
        (
            {"waiters": (), "bar": None, "agents": (("r1", "a"), ("r2", "b"))},
            "hall: 5 nodes, 4 paths, 2 tables for 6 guests, 2 robots",
        ),
    ],
    ids=["one robot", "two robots"],
)
def test_a_layout_is_told_in_one_line(changes: dict[str, object], said: str) -> None:
    assert str(replace(HALL, **changes)) == said  # type: ignore[arg-type]


def test_a_notebook_shows_what_the_drawer_makes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_drawer", None)
    assert HALL._repr_svg_() is None

    def drawer(layout: Layout) -> str:
        return f"<svg>{layout.name}</svg>"

    show_layouts_by(drawer)
    assert HALL._repr_svg_() == "<svg>hall</svg>"
