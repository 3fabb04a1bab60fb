"""The parts of the bounds: matchings, floors, courses of orders and jugs, tours."""

from __future__ import annotations

from itertools import combinations, permutations
from random import Random

import pytest

from waiter_cli.bounds.distances import FAR, WalkDistances, standing
from waiter_cli.bounds.matching import cheapest, cover
from waiter_cli.bounds.required_tasks import find_needs
from waiter_cli.bounds.seating import Seating, TableChoice
from waiter_cli.bounds.service_chains import course, marks_of, wish
from waiter_cli.model.layout import Bar, Layout, Node, Table
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State

LAYOUT = Layout(
    name="hall",
    nodes=tuple(map(Node, "abcde")),
    edges=(("a", "b"), ("b", "c"), ("c", "d"), ("b", "d"), ("d", "e")),
    entrance="e",
    tables=(
        Table("big", 4, ("c", "a"), None, (0.8, 0.8), 4),
        Table("small", 2, ("d",), None, (0.8, 0.8), 2),
    ),
    agent="a",
    bar=Bar(("b",)),
    objects=("plate", "jug"),
)


def posed(state: State, *goals: Goal, instant: bool = False) -> Problem:
    return Problem(LAYOUT, state, (), state, goals, instant_kitchen=instant)


# ---------------------------------------------------------------- matchings


def judge_matching(seed: int) -> None:
    rng = Random(seed)
    rows, columns = rng.randint(1, 4), rng.randint(4, 6)
    costs = [[rng.choice((FAR, *range(9))) for _ in range(columns)] for _ in range(rows)]
    ways = [
        (sum(costs[row][column] for row, column in enumerate(chosen)), chosen)
        for chosen in permutations(range(columns), rows)
    ]
    least = min(ways)[0]
    found = cheapest(costs, FAR)
    if least >= FAR:
        assert found is None
        return
    assert found is not None and found.cost == least
    assert len(set(found.column)) == rows
    for total, chosen in ways:
        if total < FAR:
            slack = sum(found.slack(row, column) for row, column in enumerate(chosen))
            assert total >= found.cost + slack >= found.cost


def test_cheapest_matching_is_the_least_of_all_and_its_prices_prove_it() -> None:
    for seed in range(60):
        judge_matching(seed)


def judge_cover(seed: int) -> None:
    rng = Random(seed)
    rows = [rng.sample(range(4), rng.randint(0, 3)) for _ in range(rng.randint(1, 5))]

    def fits(group: tuple[int, ...]) -> bool:
        return any(
            all(column in rows[row] for row, column in zip(group, chosen))
            for chosen in permutations(range(4), len(group))
        )

    found, stuck = cover(rows)
    everyone = tuple(range(len(rows)))
    assert all(column in rows[row] for row, column in found.items())
    assert len(found) == max(
        size for size in range(len(rows) + 1) if any(map(fits, combinations(everyone, size)))
    )
    assert bool(stuck) != fits(everyone)
    if stuck:
        assert not fits(stuck)
        assert all(fits(tuple(row for row in stuck if row != one)) for one in stuck)


def test_cover_is_largest_and_blames_a_smallest_group() -> None:
    for seed in range(60):
        judge_cover(seed)


# ---------------------------------------------------------------- floors


def test_ways_lead_around_those_who_stand() -> None:
    problem = posed(State("a"))
    free, shut = WalkDistances(problem, ()), WalkDistances(problem, ["b"])
    a, b, e = (free.number[name] for name in "abe")
    assert free.row(a)[e] == 3
    assert [free.names[node] for node in free.path(a, e)] == ["b", "d", "e"]
    assert shut.row(a)[e] == FAR
    assert shut.row(b)[e] == 2  # from where one stands one may leave
    assert shut.bar == () and shut.nodes_of == {"big": (a,), "small": ()}


def test_who_moves_is_told_from_who_stays() -> None:
    layout = Layout(
        **{
            name: getattr(LAYOUT, name) for name in ("name", "nodes", "edges", "entrance", "tables")
        },
        agent="a",
        waiters=(("v", "c"), ("w", "d")),
        timetable=(("v", 0, "b"), ("w", 3, "e"), ("w", 5, "c")),
    )
    state = State("a", waiters=layout.waiters)
    staff = standing(Problem(layout, state, (), state, ()))
    assert staff.now == {"v": "b", "w": "d"}
    assert staff.fixed == {"v": "b"}
    assert staff.after == {"v": "b", "w": "c"}
    assert staff.last == 5


# ---------------------------------------------------------------- orders and jugs


@pytest.mark.parametrize(
    ("state", "kind", "item", "instant", "names"),
    [
        (State("a", ready_to_order=frozenset({"big"})), "ordered", "plate", False, ["take_order"]),
        (
            State("a", ready_to_order=frozenset({"big"})),
            "served",
            "plate",
            True,
            ["take_order", "send_order", "take_up", "bring"],
        ),
        (State("a", ready_to_order=frozenset({"big"})), "served", "plate", False, None),
        (State("a", carrying=("big", "plate")), "served", "plate", False, ["bring"]),
        (
            State("a", empty=frozenset({("big", "jug")})),
            "filled",
            "jug",
            False,
            ["refill", "fill", "bring"],
        ),
        (
            State("a", ready=frozenset({("big", "jug")})),
            "served",
            "jug",
            False,
            ["take_up", "bring"],
        ),
        (State("a", empty=frozenset({("big", "basket")})), "filled", "basket", False, None),
        (State("a"), "filled", "jug", False, []),
    ],
)
def test_course(state: State, kind: str, item: str, instant: bool, names: list[str] | None) -> None:
    problem = posed(state, instant=instant)
    found = course(problem, marks_of(state, "big", item), "big", item, wish(kind, item, True))
    if names is None:
        assert found is None
    else:
        assert found is not None
        sure, links = found
        assert [link.name for link in links] == names
        assert sure == links


def test_only_what_occurs_on_every_way_is_certain() -> None:
    """An empty jug that also stands ready at the bar may be taken up there or at the table."""
    thing = frozenset({("big", "jug")})
    state = State("a", ready=thing, empty=thing)
    found = course(
        posed(state), marks_of(state, "big", "jug"), "big", "jug", wish("filled", "jug", True)
    )
    assert found is not None
    assert [link.name for link in found[1]] == ["take_up", "bring"]
    assert [link.name for link in found[0]] == ["bring"]


# ---------------------------------------------------------------- needs and seating


def test_a_thing_in_the_hands_is_brought_before_another_is_taken() -> None:
    state = State("a", carrying=("small", "plate"), ready=frozenset({("big", "plate")}))
    needs = find_needs(posed(state, Goal("served", table="big", item="plate")))
    names = {(link.name, link.table) for chain in needs.chains for link in chain.sure}
    assert names == {("take_up", "big"), ("bring", "big"), ("bring", "small")}


def test_bills_of_a_party_that_waits_name_its_table() -> None:
    state = State("a", waiting=(("c1",),), wants_bill=frozenset({"big"}))
    needs = find_needs(posed(state, Goal("paid", party=("c1",))))
    assert [guest.tables for guest in needs.guests] == [("big",)]
    assert needs.hopeless == ()


def test_seating_pays_for_the_way_and_for_chairs() -> None:
    state = State("a", waiting=(("c1", "c2"),), chairs=(("big", 4), ("small", 1)))
    problem = posed(state, Goal("seated", party=("c1", "c2")))
    seating = Seating(problem, find_needs(problem), WalkDistances(problem, ()))
    assert seating.costs == [[4, 3]]  # e to c and back; e to d and back, and a chair
    free, bound = seating.solve(TableChoice()), seating.solve(TableChoice(must=frozenset({"big"})))
    assert free is not None and bound is not None
    assert (free.cost, bound.cost) == (3, 4)
    assert free.slack(0, 0) == 1
    assert seating.solve(TableChoice(never=frozenset({"big", "small"}))) is None
