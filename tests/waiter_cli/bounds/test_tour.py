"""Tours: tasks put in where they cost least, with one pair of hands and one party led at a time."""

from __future__ import annotations

from tests.support.hall import posed
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.service_chains import Link
from waiter_cli.bounds.tour import Task, Tour
from waiter_cli.model.state import State

FLOOR = WalkDistances(posed(State("a")), ())
A, B, C, D, E = (FLOOR.number[name] for name in "abcde")


def tour(end: int | None = None) -> Tour:
    return Tour(FLOOR, A, end)


def visit(number: int, *nodes: int) -> Task:
    return Task(number, (Link("visit"),), [dict.fromkeys(nodes, "")])


def carry(number: int, table: int) -> Task:
    links = (Link("take_up", "t", "plate"), Link("bring", "t", "plate"))
    return Task(number, links, [{B: ""}, {table: ""}])


def test_a_stop_is_put_where_it_costs_least() -> None:
    made = tour()
    assert made.insert(visit(0, D)) == 2
    assert made.insert(visit(1, B)) == 0  # on the way
    assert [stop.node for stop in made.stops] == [B, D]
    assert made.insert(visit(2, C)) == 1  # b, c, d are as far as b, d and one more
    assert made.walk() == 3


def test_the_way_to_the_end_counts() -> None:
    made = tour(end=A)
    assert made.insert(visit(0, D)) == 4
    assert made.walk() == 4


def test_hands_carry_one_thing_at_a_time() -> None:
    made = tour()
    assert made.insert(carry(0, C)) is not None and made.insert(carry(1, D)) is not None
    held: set[int] = set()
    for stop in made.stops:
        if stop.link.name == "take_up":
            assert not held
            held.add(stop.task)
        else:
            held.remove(stop.task)


def test_hands_that_are_full_from_the_start_are_emptied_first() -> None:
    full = Task(0, (Link("bring", "t", "jug"),), [{D: ""}])
    assert full.hold == [True, False]
    made = tour()
    made.insert(full)
    made.insert(carry(1, C))
    assert [stop.task for stop in made.stops] == [0, 1, 1]


def test_a_task_is_taken_out_again() -> None:
    made = tour()
    made.insert(visit(0, D))
    made.insert(visit(1, C))
    made.remove(0)
    assert [stop.task for stop in made.stops] == [1] and set(made.tasks) == {1}


def test_settling_chooses_among_the_nodes_of_all_stops_together() -> None:
    made = tour()
    made.insert(visit(0, A, C))
    assert [stop.node for stop in made.stops] == [A]
    made.insert(visit(1, D))
    made.end = C
    made.stops = sorted(made.stops, key=lambda stop: -stop.task)  # first d, then a or c
    assert made.settle() == made.walk() == 3
    assert [stop.node for stop in made.stops] == [D, C]


def test_what_may_be_done_only_after_another_task_comes_after_it() -> None:
    made = tour()
    made.orders = [(0, 1, 0)]  # the first link of task 1 after the last of task 0
    made.insert(visit(0, D))
    made.insert(visit(1, B))
    assert [stop.task for stop in made.stops] == [0, 1]
