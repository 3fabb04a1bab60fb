"""What a search finds: when its horizon is the least, and what is raised where it is not known."""

from __future__ import annotations

import pytest

from waiter_cli.model.plan import Plan
from waiter_cli.planning.search_results import (
    NoPlanError,
    SearchOptions,
    SearchResult,
    SearchStage,
    SearchStatus,
)

PLAN = Plan((), 3)


def found(status: SearchStatus, plan: Plan | None = None, **more: object) -> SearchResult:
    return SearchResult(status, (3, 3), "binary", plan, **more)  # type: ignore[arg-type]


def test_a_plan_has_its_horizon() -> None:
    assert found(SearchStatus.PLAN, PLAN, minimal=True).least_horizon() == 3


def test_a_plan_that_is_minimal_counts_whatever_else_was_left_open() -> None:
    assert found(SearchStatus.UNDECIDED, PLAN, minimal=True).least_horizon() == 3


@pytest.mark.parametrize(
    "result",
    [
        found(SearchStatus.NO_PLAN), found(SearchStatus.CONTRADICTION),
        found(SearchStatus.UNDECIDED), found(SearchStatus.UNDECIDED, PLAN),
    ],
    ids=["no plan", "contradiction", "undecided", "undecided with a plan"],
)  # fmt: skip
def test_what_is_not_known_is_raised_with_what_was_found(result: SearchResult) -> None:
    with pytest.raises(NoPlanError, match=result.status.value) as caught:
        result.least_horizon()
    assert caught.value.result is result


def test_the_stages_of_a_search_do_not_tell_results_apart() -> None:
    timed = found(SearchStatus.PLAN, PLAN, stages=(SearchStage("search", "plan", 0.1),))
    assert timed == found(SearchStatus.PLAN, PLAN)


def test_a_search_without_options_takes_as_long_as_it_takes() -> None:
    options = SearchOptions()
    assert (options.max_steps, options.time_limit) == (None, None)
    assert options.strategy == "binary" and options.use_bounds
