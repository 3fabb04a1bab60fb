"""Causes and mends of random inconsistent programs against every set of their statements."""

from __future__ import annotations

import pytest

import sparc
from sparc.explaining.explain import Inconsistency, explain
from tests.support.inconsistent_programs import brute_force, inconsistent_programs
from tests.support.sampling import mostly_wide


def compared(first: int, number: int) -> None:
    for seed, program in inconsistent_programs(first, number):
        found = explain(sparc.check(program), every=True)
        assert found.consistent is False and found.complete, seed
        causes = [members(program, cause) for cause in found.causes]
        mends = [
            frozenset(at(program, place.line) for place in mend.without) for mend in found.mends
        ]
        all_causes, all_mends = brute_force(program)
        assert set(causes) == all_causes and len(set(causes)) == len(causes), seed
        assert set(mends) == all_mends and len(set(mends)) == len(mends), seed
        assert [len(mend) for mend in mends] == sorted(len(mend) for mend in mends), seed
        independent(seed, explain(sparc.check(program)), program, set(causes))


def independent(
    seed: int, found: Inconsistency, program: sparc.Program, known: set[frozenset[int]]
) -> None:
    """Without ``every`` the causes share nothing, and nothing beside them is a cause."""
    causes = [members(program, cause) for cause in found.causes]
    together = frozenset().union(*causes)
    assert set(causes) <= known and sum(map(len, causes)) == len(together), seed
    assert all(cause & together for cause in known), seed


def members(program: sparc.Program, cause: object) -> frozenset[int]:
    return frozenset(
        at(program, member.place.line)
        for member in cause.members  # type: ignore[attr-defined]
        if not member.is_sort
    )


def at(program: sparc.Program, line: int) -> int:
    lines = [statement.span.location.line for statement in program.statements]
    return lines.index(line)


@pytest.mark.parametrize("least", mostly_wide([5, 10], 5))
def test_causes_are_those_of_brute_force(least: int) -> None:
    compared(1, least)


@pytest.mark.slow
def test_causes_are_those_of_brute_force_in_a_thousand() -> None:
    compared(1, 100)
    compared(10_000, 1000)
