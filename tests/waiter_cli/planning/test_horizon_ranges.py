"""A domain that need not be monotone: ranges of horizons find what horizon after horizon finds."""

from __future__ import annotations

from typing import Any

import pytest

import waiter_cli
from sparc.translation.asp_program import AspProgram
from tests.support.own_domains import dirty_domain
from tests.support.sampling import mostly_slow_blocks
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.domains import Domain
from waiter_cli.planning import strategies
from waiter_cli.planning.open_horizon import with_open_horizon
from waiter_cli.planning.results import SearchResult, SearchStatus

PLAIN = dirty_domain()
RESTLESS = dirty_domain(":- #step(I), #step(I+1), not walks(I).")
EARLY = dirty_domain(":- #step(I), I >= 2, holds(currentlocation(agent, N), I), entrance(N).")
BRISK = dirty_domain(":- #step(I), #step(I+1), #step(I+2), not walks(I), not walks(I+1).")
REPORT = waiter_cli.read_layout("report")


def search(problem: Any, domain: Domain, strategy: str, **more: Any) -> SearchResult:
    return waiter_cli.plan(problem, domain=domain, strategy=strategy, **more).result


@pytest.mark.parametrize("seeds", mostly_slow_blocks(range(400), range(2)))
@pytest.mark.parametrize(
    "domain", [PLAIN, RESTLESS, EARLY, BRISK], ids=["plain", "restless", "early", "brisk"]
)
def test_ranges_find_what_horizon_after_horizon_finds(domain: Domain, seeds: range) -> None:
    for seed in seeds:
        problem = small_problem(seed)
        if not problem.contradictions:
            one, other = (
                search(problem, domain, each, max_steps=6) for each in ("binary", "linear")
            )
            assert (one.status, one.bounds) == (other.status, other.bounds), seed


def test_a_walk_without_rest_ends_where_its_horizon_does() -> None:
    """Nothing is done once the goals hold, and no step may be idle: one horizon alone has a plan."""
    for goal, steps in (("n3", 2), ("n2", 1), ("n1", 0)):
        problem = waiter_cli.pose_problem(
            REPORT, goals=[f"at: {goal}", "holds_not: isdirty(table1)"]
        )
        result = search(problem, RESTLESS, "binary")
        assert result.plan is not None and result.plan.horizon == steps


def test_a_hundred_horizons_are_refuted_in_a_few_groundings(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    goals = ["holds: isattable(ada,table1)", "holds: isattable(cleo,table1)"]
    problem = waiter_cli.pose_problem(
        REPORT, seen=["enter: [ada, ben]", "enter: [cleo]"], goals=goals
    )
    assert search(problem, PLAIN, "binary").status is SearchStatus.NO_PLAN
    monkeypatch.setattr(strategies, "PROOF_AFTER", {3: 0})
    result = search(problem, PLAIN, "binary")
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "max_steps")
    assert result.bounds == (101, None) and len(result.probes) == 8


def test_what_differs_elsewhere_has_no_open_horizon() -> None:
    def opened(text: str, longer: str) -> str | None:
        found = with_open_horizon(AspProgram(text, ""), AspProgram(longer, ""), 4)
        return None if found is None else found.program.text

    assert opened("__step(0..4).\n__num(0..4).", "__step(0..5).\n__num(0..4).") == (
        "__step(0). { __step(1..4) }. :- __step(I+1), not __step(I), I = 0..3.\n__num(0..4)."
    )
    rules = "p(I+1):-p(I),I<=3.", "p(I+1):-p(I),I<=4."
    found = opened(f"__step(0..4).\n{rules[0]}", f"__step(0..5).\n{rules[1]}")
    assert found is not None and found.endswith("\np(I+1):-p(I),I<=3,__step(I+1).")
    for here, there in (("last(4).", "last(5)."), ("p(I):-I<=3.", "p(I):-I<=5."), ("a.", "a.\nb.")):
        assert opened(f"__step(0..4).\n{here}", f"__step(0..5).\n{there}") is None
    assert opened("__step(0..4).\n__t(0..4).", "__step(0..5).\n__t(0..5).") is None
