"""Planning as tests ask for it: a problem and a few words, a result."""

from __future__ import annotations

from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchOptions, SearchResult
from waiter_cli.planning.strategies import find_minimal_plan
from waiter_cli.problems.from_options import read_problem
from waiter_cli.translators.base import Translator
from waiter_cli.translators.native import NativeTranslator

__all__ = ["SCENES", "length", "scenario", "search"]

# The recorded scenes of the report and their true minima.
SCENES = {"b1": 7, "b2": 4, "b3": 1, "b4": 1}


def scenario(name: str) -> Problem:
    """The problem of a shipped scenario."""
    return read_problem(None, name)[0]


def search(
    problem: Problem,
    strategy: str = "binary",
    *,
    domain: str = "restaurant",
    translator: Translator | None = None,
    use_bounds: bool = True,
    max_steps: int | None = None,
    time_limit: float | None = None,
) -> SearchResult:
    """The result of one search."""
    options = SearchOptions(strategy, max_steps, time_limit, use_bounds)
    return find_minimal_plan(
        problem, translator or NativeTranslator(), find_domain(domain), options
    )


def length(result: SearchResult) -> int | None:
    """The length of a plan that was proved minimal; None where none exists."""
    if result.plan is None:
        assert result.status.value == "no_plan"
        return None
    assert result.minimal
    return result.plan.horizon
