"""Diagnosis: what happened unseen, of which there is as little as will do."""

from __future__ import annotations

from typing import Any

import pytest

import sparc
from tests.support.serving import Live
from waiter_cli.diagnosis.diagnose import explain, explain_observations
from waiter_cli.file_access.locate import data_folder
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Observation, State
from waiter_cli.problems.pose import pose_problem

RING = """
name: ring
nodes: [door, a, b, c, d, yard]
edges: [[door, a], [a, b], [b, c], [c, d], [d, a]]
entrance: door
agent: door
waiters: {w1: b, w2: d}
bar: [c]
tables:
  t1: {capacity: 2, nodes: [a]}
  t2: {capacity: 4, nodes: [c]}
"""


@pytest.fixture(scope="module")
def ring() -> Layout:
    return read_layout(RING, "ring.yaml")


def start(layout: Layout, **more: Any) -> State:
    from dataclasses import replace

    return replace(state_of_layout(layout)[0], **more)


def at(who: str, node: str) -> Observation:
    return Observation("at", (who, node))


def free(table: str) -> Observation:
    return Observation("free", (table,))


def order(table: str) -> Observation:
    return Observation("order", (table,))


def told(layout: Layout, state: State, *seen: Observation, step: int = 0) -> list[list[str]]:
    return [list(each.text) for each in explain(layout, state, seen, step, ())]


def test_the_program_stands_by_itself() -> None:
    with open(f"{data_folder('domains')}/restaurant/diagnosis.sparc", encoding="utf-8") as file:
        found = {
            tuple(sorted(map(str, answer.literals)))
            for answer in sparc.solve(sparc.Source("diagnosis.sparc", file.read()))
        }
    walk = ("happens(walks(w1,n2),1)", "happens(walks(w1,n3),2)")
    assert found == {
        ("happens(sits_down(c1,table2),2)", *walk),
        ("happens(comes_in(stranger,table2),2)", *walk),
    }


def test_what_fits_needs_no_explanation(ring: Layout) -> None:
    seated = start(ring, seated=(("t1", ("c1",)),))
    assert told(ring, seated, at("w1", "b"), free("t2"), order("t1")) == []


def test_a_waiter_seen_elsewhere_walked_there_by_a_shortest_way(ring: Layout) -> None:
    assert told(ring, start(ring), at("w1", "a")) == [["w1 walked from b to a"]]
    report = read_layout_file("report")
    (found,) = explain(report, state_of_layout(report)[0], [at("w1", "n3")], 5, ())
    assert found.events == ((3, "walks", ("w1", "n4")), (4, "walks", ("w1", "n3")))
    assert found.cost == 2 and dict(found.state.waiters) == {"w1": "n3"}


def test_ways_that_are_as_short_are_alternatives(ring: Layout) -> None:
    alone = start(ring, waiters=(("w1", "b"),))
    assert told(ring, alone, at("w1", "d")) == [
        ["w1 walked from b to a", "w1 walked from a to d"],
        ["w1 walked from b to c", "w1 walked from c to d"],
    ]


def test_nobody_walks_where_somebody_stands(ring: Layout) -> None:
    state = start(ring, agent="a", waiters=(("w1", "b"),))
    assert told(ring, state, at("w1", "d")) == [["w1 walked from b to c", "w1 walked from c to d"]]


def test_two_do_not_change_places(ring: Layout) -> None:
    state = start(ring, agent="c", waiters=(("w1", "a"), ("w2", "b")))
    (texts,) = told(ring, state, at("w1", "b"), at("w2", "a"))[:1]
    assert len(texts) > 2, texts


def test_somebody_on_the_node_that_was_taken_made_way(ring: Layout) -> None:
    found = told(ring, start(ring), at("w1", "d"))
    assert len(found) == 2 and all(len(texts) == 3 for texts in found)
    assert all(any(text.startswith("w2 walked from d") for text in texts) for texts in found)


def test_a_way_round_somebody_counts_against_his_making_way(ring: Layout) -> None:
    # From b to a is one step; round by c and d it would be three, past w2, who stands there.
    state = start(ring, agent="yard", waiters=(("w1", "door"), ("w2", "a")))
    found = told(ring, state, at("w1", "b"))
    assert found and all(len(texts) == 3 for texts in found)
    assert all(sum(text.startswith("w2") for text in texts) == 1 for texts in found)


def test_long_ways_are_found_among_many() -> None:
    wide, high = 12, 10
    nodes = [f"n{x}_{y}" for x in range(wide) for y in range(high)]
    edges = [f"[n{x}_{y}, n{x + 1}_{y}]" for x in range(wide - 1) for y in range(high)]
    edges += [f"[n{x}_{y}, n{x}_{y + 1}]" for x in range(wide) for y in range(high - 1)]
    text = f"""
name: square
nodes: [{", ".join(nodes)}]
edges: [{", ".join(edges)}]
entrance: n0_0
agent: n0_9
waiters: {{w1: n0_0, w2: n5_5}}
tables: {{t1: {{capacity: 2, nodes: [n3_3]}}}}
"""
    layout = read_layout(text, "square.yaml")
    found = explain(layout, state_of_layout(layout)[0], [at("w1", "n11_9")], 0, ())
    assert {each.cost for each in found} == {20} and len(found) == 5


def test_where_no_way_leads_he_was_off_the_floor(ring: Layout) -> None:
    assert told(ring, start(ring), at("w1", "yard")) == [
        ["w1 went off the floor and came back at yard"]
    ]


def test_the_robot_was_brought_where_it_is_seen(ring: Layout) -> None:
    (found,) = explain(ring, start(ring), [at("agent", "c")], 0, ())
    assert found.text == ("the robot was brought from door to c",) and found.state.agent == "c"


def test_the_way_of_the_robot_is_minded() -> None:
    corridor = RING.replace("[d, a]]", "[d, yard]]").replace(", w2: d", "")
    layout = read_layout(corridor, "corridor.yaml")
    state = start(layout, agent="b", waiters=(("w1", "door"),))
    # The robot came from d by way of c: the waiter cannot have passed it.
    trail = ((0, "d"), (1, "c"))
    (found,) = explain(layout, state, [at("w1", "d")], 2, trail)[:1]
    assert found.events[0][1] == "is_elsewhere"


def test_a_table_seen_free_was_left(ring: Layout) -> None:
    state = start(ring, seated=(("t1", ("c1", "c2")),), paid=frozenset({"t1"}))
    (found,) = explain(ring, state, [free("t1")], 4, ())
    assert found.text == ("the party of c1 (2) left t1",) and found.events[0][0] == 3
    assert found.state.seated == () and found.state.paid == frozenset()


def test_somebody_at_a_free_table_waited_or_came_in(ring: Layout) -> None:
    state = start(ring, waiting=(("c1",), ("b1", "b2", "b3")))
    found = explain(ring, state, [order("t1")], 0, ())
    assert [each.text for each in found] == [
        ("c1 sat down at t1 without being led there",),
        ("somebody came in and sat down at t1, called stranger1 here",),
    ], "the party of three does not fit"
    first, second = (each.state for each in found)
    assert first.table_of("c1") == "t1" and first.ready_to_order == {"t1"}
    assert second.table_of("stranger1") == "t1" and len(second.waiting) == 2


def test_a_party_that_changed_its_table_is_one_event(ring: Layout) -> None:
    state = start(ring, seated=(("t1", ("c1",)),), paid=frozenset({"t1"}))
    found = explain(ring, state, [free("t1"), order("t2")], 0, ())
    assert found[0].text == ("c1 changed from t1 to t2",) and found[0].cost == 1
    assert found[0].state.seated == (("t2", ("c1",)),) and found[0].state.paid == {"t2"}


def test_several_surprises_are_explained_together(ring: Layout) -> None:
    state = start(ring, seated=(("t1", ("c1",)),))
    (found,) = told(ring, state, at("w1", "a"), free("t1"))
    assert sorted(found) == ["c1 left t1", "w1 walked from b to a"]


@pytest.mark.parametrize(
    "seen",
    [
        [Observation("enter", ("c1",))],
        [Observation("leave", ("nobody",))],
        [at("w1", "door")],
        [at("w1", "a"), at("w2", "a")],
        [at("w1", "a"), at("w1", "c")],
        [free("t2"), order("t2")],
        [at("w9", "a")],
    ],
    ids=["inside", "not inside", "the robot's node", "two on one", "at two", "both", "unknown"],
)
def test_some_things_cannot_be_explained(ring: Layout, seen: list[Observation]) -> None:
    assert told(ring, start(ring, waiting=(("c1",),)), *seen) == []


def test_the_observations_of_a_problem_are_explained_by_what_came_before(ring: Layout) -> None:
    text = "state: {seated: {t1: [c1]}}\nobserve: [{at: {w1: a}}, {free: t1}]"
    problem = pose_problem(ring, read_scenario(text, "s.yaml", ring))
    assert problem.contradictions
    (found,) = explain_observations(problem)
    assert [step for step, _, _ in found.events] == [-1, -1]


def test_a_run_believes_the_best_explanation_and_plans_from_it(ring: Layout) -> None:
    live = Live(ring)
    answer = live.seen({"enter": ["c1"]}, {"at": {"w1": "c"}})
    assert answer["diagnosis"] == [
        {
            "cost": 1,
            "events": [
                {"step": -1, "name": "walks", "args": ["w1", "c"], "text": "w1 walked from b to c"}
            ],
        }
    ]
    live.work(answer)
    assert "diagnosis" not in live.tell({"ask": "plan"})
    answer = live.seen({"free": "t1"})
    assert answer["diagnosis"][0]["events"][0]["text"] == "c1 left t1"
    assert "seated" not in live.state()
    assert live.tell({"ask": "why"})["why"]["diagnosis"] == answer["diagnosis"]


def test_an_arrival_is_no_surprise(ring: Layout) -> None:
    live = Live(ring)
    live.tell({"goal": {"at": "a"}})
    live.tell({"started": 0})
    answer = live.seen({"at": {"agent": "a"}})
    assert "diagnosis" not in answer and answer["horizon"] == 1
    assert live.tell({"done": 0})["horizon"] == 0
    answer = live.seen({"at": {"agent": "c"}})
    assert answer["diagnosis"][0]["events"][0]["text"] == "the robot was brought from a to c"


def test_what_cannot_be_explained_is_told_and_not_believed(ring: Layout) -> None:
    live = Live(ring)
    before = live.state()
    answer = live.seen({"at": {"w1": "door"}}, {"enter": ["c1"]})
    assert "cannot both stand on door" in answer["error"]["message"]
    assert live.state() == before
