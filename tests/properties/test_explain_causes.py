"""No innocent is blamed: what causes are, held against exhaustive search in impossible problems.

With the causes of one conflict alone, all others taken away, there is no plan; with one of them less
there is.  Where there is a single conflict, each cause is necessary in the problem as it was given.
Each change that is said to help gives a plan of that length.
"""

from __future__ import annotations

import gc
from collections import Counter

import pytest

from tests.support.cli import waiter
from tests.support.exhaustive import shortest
from tests.support.goal_pairs import pair_problem
from waiter_cli.encoding.domains import find_domain
from waiter_cli.explanation.causes_and_changes import causes_of, without
from waiter_cli.explanation.explain import explain
from waiter_cli.model.problem import Problem
from waiter_cli.planning.search_results import SearchOptions, SearchStatus
from waiter_cli.translators.native import NativeTranslator

FEW = range(36)
MANY = (0, *range(1_000, 4_000, 100))


def has_plan(problem: Problem) -> bool:
    return shortest(problem).length is not None


def judge(problem: Problem) -> int:
    """How many conflicts are told, all of them rightly."""
    found = explain(problem, NativeTranslator(), find_domain("restaurant"), SearchOptions())
    assert found.result.status is SearchStatus.NO_PLAN
    assert found.conflicts
    candidates = list(causes_of(problem))
    for causes in found.conflicts:
        names = {cause.message for cause in causes}
        others = [cause for cause in candidates if cause.message not in names]
        assert not has_plan(without(problem, others)), names
        for cause in candidates:
            if cause.message in names:
                assert has_plan(without(problem, [*others, cause])), cause.message
                if len(found.conflicts) == 1:
                    assert has_plan(without(problem, [cause])), cause.message
    for helped in found.helped:
        assert shortest(helped.change.problem).length == helped.horizon, helped.change.message
    return len(found.conflicts)


def judge_all(seeds: range) -> Counter[int]:
    told: Counter[int] = Counter()
    for seed in seeds:
        gc.collect()  # groundings that nobody needs are large, and do not count as many objects
        problem = pair_problem(seed)
        if len(problem.goals) + len(problem.before) > 1 and not has_plan(problem):
            try:
                told[judge(problem)] += 1
            except AssertionError as wrong:
                raise AssertionError(f"pair_problem({seed}): {wrong}") from wrong
    return told


def test_causes_are_necessary_and_suffice() -> None:
    told = judge_all(FEW)
    assert told.total() >= 15 and told[1] and told.total() > told[1]


@pytest.mark.slow
@pytest.mark.parametrize("first", MANY)
def test_causes_are_necessary_and_suffice_in_hundreds_of_problems(first: int) -> None:
    assert judge_all(range(first, first + 100)).total() > 20


def test_a_wish_that_could_be_met_is_not_to_blame(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "two.yaml"
    path.write_text(
        "layout: bistro\nstate:\n  seated: {table1: [a], table2: [b]}\n  ordered: [table1]\n"
        "  wants_bill: [table2]\ngoals:\n  - served: table1\n  - paid: table2\n"
    )
    document = waiter("explain", "-s", path, "--json").json()
    assert [cause["message"] for cause in document["causes"]] == ["served table1 is wanted"]
    assert len(document["conflicts"]) == 1
    assert "paid table2 is wanted" not in waiter("explain", "-s", path).out


def test_conflicts_that_have_nothing_in_common_are_told_apart(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "two.yaml"
    path.write_text(
        "layout: report\nstate:\n  seated: {table1: [a]}\n  waiting: [[b, c, d, e, f]]\n"
        "goals:\n  - paid: table1\n  - seated: [b, c, d, e, f]\n"
    )
    document = waiter("explain", "-s", path, "--json").json()
    told = [{cause["message"] for cause in causes} for causes in document["conflicts"]]
    assert {"paid table1 is wanted"} in told and len(told) >= 2
    assert "one of each must change" in waiter("explain", "-s", path).out
