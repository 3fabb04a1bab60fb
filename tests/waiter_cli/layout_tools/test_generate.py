"""Generated restaurants are valid, roomy, connected, reproducible; evenings are as was asked."""

from __future__ import annotations

from math import hypot

import pytest

from tests.support.exhaustive import shortest
from tests.support.planning import length, search
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import (
    SIZES,
    UNSOLVABLE,
    generate_instance,
    generate_layout,
    generate_scenario,
)
from waiter_cli.layout_tools.generate_floor import FLAWS, build_layout, least_nodes
from waiter_cli.model.graph import reachable
from waiter_cli.model.layout import Layout, Point
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem

ROBOT = 0.25
CHAIR, CHAIR_AT = 0.4, 0.75

SHAPES = [(2, 1), (3, 5), (8, 3), (12, 20), (20, 8), (50, 20), (120, 50), (300, 140)]
shapes = pytest.mark.parametrize(("nodes", "tables"), SHAPES, ids=lambda n: str(n))


def boxes(layout: Layout) -> list[tuple[str, Point, Point]]:
    """Tables with their chairs, and the bar, as upright boxes (name, lower corner, upper)."""
    out = []
    for table in layout.tables:
        assert table.at is not None
        (x, y), (w, h) = table.at, table.size
        out.append((table.name, (x - CHAIR_AT - CHAIR / 2, y - h / 2), (x + 0.95, y + h / 2)))
        assert w / 2 < CHAIR_AT
    if layout.bar is not None and layout.bar.corners is not None:
        out.append(("bar", *layout.bar.corners))
    return out


def distance(a: Point, b: Point, low: Point, high: Point) -> float:
    """From the segment a–b, which runs along an axis, to a box."""
    assert a[0] == b[0] or a[1] == b[1]
    gaps = [max(low[i] - max(a[i], b[i]), 0.0, min(a[i], b[i]) - high[i]) for i in (0, 1)]
    return hypot(*gaps)


@shapes
def test_a_written_layout_is_read_back_as_it_was_built(nodes: int, tables: int) -> None:
    for seed in range(5):
        bar = seed % 2 == 1
        built = build_layout(seed, nodes, tables, bar=bar, handsome=True)
        assert (len(built.nodes), len(built.tables)) == (nodes, tables)
        text = generate_layout(seed, nodes, tables, bar=bar)
        read = read_layout(text, "made.yaml")
        for field in ("nodes", "edges", "entrance", "tables", "agent", "waiters", "bar", "objects"):
            assert getattr(read, field) == getattr(built, field), field


@shapes
def test_everything_can_be_reached_past_the_waiters(nodes: int, tables: int) -> None:
    for seed in range(10):
        waiters = min(3, (nodes - tables) // 4)
        layout = build_layout(
            seed, nodes, tables, bar=True, waiters=max(0, waiters), handsome=seed % 2 > 0
        )
        open_ = reachable(layout.neighbours(), layout.agent, [n for _, n in layout.waiters])
        assert layout.entrance in open_ and layout.agent not in dict(layout.waiters).values()
        assert all(set(table.nodes) & open_ for table in layout.tables)
        assert layout.bar is not None and set(layout.bar.nodes) & open_


@pytest.mark.parametrize("size", SIZES)
def test_edges_keep_clear_of_furniture_and_furniture_of_each_other(size: str) -> None:
    for seed in range(6 if size != "XL" else 2):
        s = SIZES[size]
        text = (
            generate_instance(seed, size, bar=True)[0]
            if seed % 2
            else generate_layout(seed, s.nodes, s.tables, bar=True)
        )
        layout = read_layout(text, "made.yaml")
        place = {node.name: node.at for node in layout.nodes}
        assert len(set(place.values())) == len(place)
        furniture = boxes(layout)
        for a, b in layout.edges:
            start, end = place[a], place[b]
            assert start is not None and end is not None
            for name, low, high in furniture:
                assert distance(start, end, low, high) >= ROBOT + 0.04, (seed, a, b, name)
        for k, (name, low, high) in enumerate(furniture):
            for other, low2, high2 in furniture[k + 1 :]:
                apart = any(low[i] > high2[i] or low2[i] > high[i] for i in (0, 1))
                assert apart, (seed, name, other)


@pytest.mark.parametrize(("nodes", "tables"), [(17, 6), (29, 10), (60, 12), (120, 50)])
def test_a_room_that_is_asked_for_fits_a_picture(nodes: int, tables: int) -> None:
    for seed in range(5):
        layout = read_layout(generate_layout(seed, nodes, tables), "made.yaml")
        xs, ys = zip(*(node.at for node in layout.nodes if node.at))
        assert 0.8 < (max(xs) - min(xs)) / (max(ys) - min(ys) + 3.4) < 3.2, seed


def test_the_same_seed_makes_the_same_text_and_others_make_others() -> None:
    texts = [generate_instance(seed, "M") for seed in range(10)]
    assert texts == [generate_instance(seed, "M") for seed in range(10)]
    assert len(set(texts)) == 10


def test_what_cannot_be_laid_out_is_refused_with_the_number_that_can() -> None:
    with pytest.raises(InputError, match="50 tables take 25 nodes or more"):
        build_layout(1, 10, 50)
    assert len(build_layout(1, least_nodes(50), 50).tables) == 50
    with pytest.raises(InputError, match="would stand in the way"):
        build_layout(1, 4, 3, waiters=4)
    with pytest.raises(InputError, match="no such flaw"):
        build_layout(1, 8, 3, flaw="haunted")
    with pytest.raises(InputError, match="no such reason"):
        generate_scenario(1, build_layout(1, 8, 3), 1, unsolvable="haunted")
    with pytest.raises(InputError, match="7 parties would take 7 tables, and only 3"):
        generate_scenario(1, build_layout(1, 8, 3), 7)


@pytest.mark.parametrize("flaw", FLAWS)
def test_flaws_are_there(flaw: str) -> None:
    for seed in range(10):
        layout = build_layout(seed, 20, 8, waiters=1, flaw=flaw)
        open_ = reachable(layout.neighbours(), layout.agent, [n for _, n in layout.waiters])
        lost = [table for table in layout.tables if not set(table.nodes) & open_]
        if flaw == "unreachable_table":
            assert len(lost) == 1 and layout.entrance in open_
        else:
            assert layout.entrance not in open_
            assert layout.entrance in reachable(layout.neighbours(), layout.agent, ())


def test_coordinates_may_be_left_out() -> None:
    layout = build_layout(3, 8, 3)
    bare = Layout(
        **{field: getattr(layout, field) for field in ("name", "edges", "entrance", "agent")},
        nodes=tuple(type(node)(node.name) for node in layout.nodes),
        tables=layout.tables,
    )
    assert read_layout(write_layout(bare), "made.yaml").nodes == bare.nodes


def test_every_reason_to_be_unsolvable_can_be_had_in_every_size() -> None:
    for size in SIZES:
        for seed in range(3):
            for reason in UNSOLVABLE:
                layout, scenario = generate_instance(seed, size, unsolvable=reason)
                assert scenario.startswith(f"# unsolvable: {reason}\n")
                read_layout(layout, "made.yaml")


def posed(seed: int, size: str, *, bar: bool, unsolvable: str | None) -> Problem:
    """A generated instance, read back from its two files."""
    text, evening = generate_instance(seed, size, bar=bar, unsolvable=unsolvable)
    layout = read_layout(text, "layout.yaml")
    problem = pose_problem(layout, read_scenario(evening, "evening.yaml", layout))
    assert not problem.contradictions
    return problem


@pytest.mark.parametrize("bar", [False, True], ids=["simple", "bar"])
def test_small_evenings_are_planned_as_shortly_as_they_can_be(bar: bool) -> None:
    for seed in range(2):
        problem = posed(seed, "S", bar=bar, unsolvable=None)
        assert problem.everybody and problem.goals
        assert length(search(problem)) == shortest(problem).length


@pytest.mark.parametrize("reason", UNSOLVABLE)
def test_evenings_that_cannot_be_are_refused(reason: str) -> None:
    for seed, bar in ((0, False), (1, True)):
        assert shortest(posed(seed, "S", bar=False, unsolvable=reason)).length is None
        for size in ("S", "M"):
            assert length(search(posed(seed, size, bar=bar, unsolvable=reason))) is None


def test_large_evenings_have_the_numbers_asked_for() -> None:
    for size, asked in SIZES.items():
        for seed in range(5):
            problem = posed(seed, size, bar=False, unsolvable=None)
            assert len(problem.layout.nodes) == asked.nodes
            assert len(problem.layout.tables) == asked.tables
            assert len(problem.layout.waiters) == asked.waiters
            assert len(problem.state.waiting) == asked.parties
            low, high = asked.customers or (1, 1000)
            assert low <= sum(map(len, problem.state.parties())) <= high
