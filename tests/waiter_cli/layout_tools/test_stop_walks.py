"""Tours of today walked again on a changed floor: what a change promises."""

from __future__ import annotations

from tests.support.rule_cases import at, plan, posed
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.layout_tools.layout_changes import LayoutChange, changes
from waiter_cli.layout_tools.stop_walks import StopJudge, WalkedTour, stops_of_plan
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Goal

DETOUR = """\
nodes: {a: [0, 0], b: [0, 2], c: [2, 2], d: [2, 0], e: [4, 0], x: [9, 9]}
edges: [[a, b], [b, c], [c, d], [d, e]]
entrance: a
agent: a
tables:
  far: {capacity: 2, nodes: [e], at: [4, 1]}
  near: {capacity: 2, nodes: [b], at: [-1, 2]}
"""
LAYOUT = read_layout(DETOUR, "f.yaml")
TOUR = WalkedTour("a", frozenset(), (("table", "far"),))


def change(text: str, layout: Layout = LAYOUT) -> LayoutChange:
    return next(each for each in changes(layout, None) if each.text == text)


def promise(
    text: str, *tours: WalkedTour, unreached: bool = False
) -> tuple[int, float, int, float]:
    return StopJudge(LAYOUT, tours or (TOUR,), unreached=unreached).promise(change(text))


AS_IT_IS = LayoutChange("edge", "as it is", LAYOUT)


def test_as_it_is_the_tour_takes_its_steps_and_metres() -> None:
    assert StopJudge(LAYOUT, [TOUR]).promise(AS_IT_IS) == (0, 8.0, 4, 0.0)
    both = (TOUR, WalkedTour("e", frozenset(), (("entrance", ""), ("node", "b"))))
    assert StopJudge(LAYOUT, both).promise(AS_IT_IS) == (0, 8.0 + 10.0, 4 + 5, 0.0)


def test_a_short_cut_saves_steps_and_metres() -> None:
    assert promise("add the edge a-d") == (0, 4.0, 2, 2.0)
    assert promise("add the edge a-d") < promise("add the edge b-d")


def test_a_table_that_moves_nearer_saves_the_walk_to_it() -> None:
    assert promise("swap far and near") == (0, 2.0, 1, 0.0)


def test_who_stands_on_the_way_is_walked_round_or_ends_it() -> None:
    held = WalkedTour("a", frozenset({"c"}), TOUR.stops)
    assert StopJudge(LAYOUT, [held]).promise(AS_IT_IS) == (1, 0.0, 0, 0.0)
    assert promise("add the edge a-d", held) == (0, 4.0, 2, 2.0)


def test_a_way_where_there_was_none_comes_first_where_that_is_asked_for() -> None:
    joining = next(c for c in changes(LAYOUT, None) if c.edge is not None and "x" in c.edge)
    judge = StopJudge(LAYOUT, [TOUR], unreached=True)
    assert judge.promise(joining) < judge.promise(change("add the edge a-d"))
    assert StopJudge(LAYOUT, [TOUR]).promise(joining)[0] == 0


def test_stops_of_a_plan_are_where_it_does_something() -> None:
    done = plan(
        "pick(agent,c1)", "go_to(agent,d)", "seat(agent,c1,small)", "go_to(agent,b)",
        "go_to(agent,a)", "send_order(agent,big)", "take_up(agent,jug,big)", "bring_chairs(agent,big,4)",
    )  # fmt: skip
    problem = posed(at("e"), Goal("at", node="b"), Goal("paid", table="big"))
    assert stops_of_plan(problem, done) == (
        ("entrance", ""), ("table", "small"), ("bar", ""), ("bar", ""), ("table", "big"), ("node", "b"),
    )  # fmt: skip
