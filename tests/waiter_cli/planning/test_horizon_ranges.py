"""A domain that need not be monotone: ranges of horizons find what horizon after horizon finds."""

from __future__ import annotations

from typing import Any

import pytest

import waiter_cli
from tests.support.own_domains import dirty_domain
from tests.support.sampling import mostly_slow_blocks
from tests.support.small_worlds import small_problem
from waiter_cli.encoding.domains import Domain
from waiter_cli.planning import strategies
from waiter_cli.planning.search_results import SearchResult, SearchStatus

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


@pytest.mark.wide
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
