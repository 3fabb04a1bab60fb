"""Places for nodes without any: as far apart as their paths are long, upright, and always the same."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import dist

import pytest

from tests.support.rule_cases import HALL
from waiter_cli.model.graph import distances
from waiter_cli.room.coordinates import EDGE, place, spread


def joined(*edges: str) -> dict[str, list[str]]:
    """The neighbours of nodes of one letter each, by the edges between them."""
    near: dict[str, list[str]] = {}
    for a, b in edges:
        near.setdefault(a, []).append(b)
        near.setdefault(b, []).append(a)
    return near


@pytest.mark.parametrize(
    "near",
    [joined("ab", "bc", "cd"), joined("ab", "bc", "cd", "da"), joined("ab", "ac", "ad")],
    ids=["path", "ring", "star"],
)
def test_an_edge_is_about_as_long_as_it_should_be(near: dict[str, list[str]]) -> None:
    places = spread(near)
    for a, others in near.items():
        for b in others:
            assert 0.6 * EDGE <= dist(places[a], places[b]) <= 1.4 * EDGE
    for a, b in combinations(near, 2):
        assert dist(places[a], places[b]) <= 1.2 * EDGE * distances(near, a)[b]
        assert dist(places[a], places[b]) >= 0.5 * EDGE, "no two nodes in one place"


def test_a_path_runs_along_an_axis() -> None:
    places = spread(joined("ab", "bc", "cd")).values()
    narrow, wide = sorted(max(c) - min(c) for c in zip(*places))
    assert narrow < EDGE / 2 and abs(wide - 3 * EDGE) < 0.3


def test_parts_that_no_edge_joins_stand_apart() -> None:
    places = spread(joined("ab", "cd"))
    assert all(dist(places[a], places[b]) > EDGE for a in "ab" for b in "cd")


def test_places_begin_at_the_origin_and_are_the_same_each_time() -> None:
    near = joined("ab", "bc", "cd", "da", "ce")
    places = spread(near)
    assert min(x for x, _ in places.values()) == min(y for _, y in places.values()) == 0.0
    assert spread(near) == places
    assert spread({}) == {} and spread({"a": []}) == {"a": (0.0, 0.0)}


def test_every_node_and_table_has_a_place_and_the_tables_stand_apart() -> None:
    placed = place(HALL)
    assert all(node.at is not None for node in placed.nodes)
    centres = [table.at for table in placed.tables]
    assert None not in centres and dist(*centres) > 0.5  # type: ignore[arg-type]
    assert [table.name for table in placed.tables] == [table.name for table in HALL.tables]


def test_a_table_that_has_a_place_keeps_it() -> None:
    first = replace(HALL.tables[0], at=(40.0, 2.0))
    placed = place(replace(HALL, tables=(first, *HALL.tables[1:])))
    assert placed.tables[0].at == (40.0, 2.0)
