"""Chains as one machine: its states, what is done on reaching a node, and where it goes on."""

from __future__ import annotations

from tests.support.hall import posed
from waiter_cli.bounds.chain_automaton import Course, Machine, build_machine
from waiter_cli.bounds.distances import WalkDistances
from waiter_cli.bounds.insertion import Builder, Clock
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.seating import Seating
from waiter_cli.bounds.service_chains import Link
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

TAKE, BRING, BILL = Link("take_up", "t"), Link("bring", "t"), Link("give_bill", "u")


def course(task: int, *links: tuple[Link, int], **more: object) -> Course:
    only = tuple(link for link, _ in links)
    nodes = tuple((node,) for _, node in links)
    return Course(task, only, tuple(range(len(links))), nodes, **more)  # type: ignore[arg-type]


def machine_of(problem: Problem, most: int = 1000) -> Machine:
    floor = WalkDistances(problem, ())
    seating = Seating(problem, find_needs(problem), floor)
    return build_machine(Builder(seating, Clock(1000, None)), most)


def test_a_state_tells_how_far_each_course_is() -> None:
    machine = Machine([course(0, (TAKE, 1), (BRING, 2)), course(1, (BILL, 2))])
    assert (machine.size, machine.done) == (6, 5)
    assert [machine.progress(state) for state in (0, 1, 3, 5)] == [[0, 0], [1, 0], [0, 1], [2, 1]]
    assert machine.arrive(0, 1) == (1,)  # taken up
    assert machine.arrive(1, 2) == (5,)  # brought, and the bill given on the way
    assert machine.targets(0) == (1, 2) and machine.targets(1) == (2,)


def test_one_pair_of_hands_carries_one_thing() -> None:
    two = Machine([course(k, (TAKE, 1), (BRING, 2 + k)) for k in range(2)])
    assert two.choosy and two.count == 8  # of nine, but that both are carried
    assert sorted(map(tuple, map(two.progress, two.arrive(0, 1)))) == [(0, 0), (0, 1), (1, 0)]
    assert two.free([0, 2]) and not two.free([1, 0])
    assert two.targets(1) == (2,)  # with full hands only to where it is brought


def test_a_course_may_have_to_wait_for_others() -> None:
    machine = Machine([course(0, (BILL, 1)), course(1, (Link("send_order"), 1), after=(0,))])
    assert machine.waits([0, 0], machine.courses[1]) and not machine.waits(
        [1, 0], machine.courses[1]
    )
    assert machine.targets(0) == (1,)
    assert machine.progress(machine.arrive(0, 1)[0]) == [1, 1]


def test_all_orders_are_sent_by_one_visit_of_the_bar() -> None:
    seated = (("big", ("c1",)), ("small", ("c2",)))
    state = State("a", seated=seated, ready_to_order=frozenset({"big", "small"}))
    goals = (Goal("sent", table="big"), Goal("sent", table="small"))
    machine = machine_of(posed(state, *goals))
    assert [[link.name for link in each.links] for each in machine.courses] == [
        ["take_order"],
        ["take_order"],
        ["send_order"],
    ]
    assert machine.courses[-1].after == (0, 1)
    assert len(machine.courses[-1].also) == 2


def test_no_more_chains_are_taken_than_so_many_states_can_tell_apart() -> None:
    state = State(
        "a", wants_bill=frozenset({"big", "small"}), seated=(("big", ("c1",)), ("small", ("c2",)))
    )
    goals = (Goal("paid", table="big"), Goal("paid", table="small"))
    assert len(machine_of(posed(state, *goals)).courses) == 2
    assert len(machine_of(posed(state, *goals), most=3).courses) == 1
