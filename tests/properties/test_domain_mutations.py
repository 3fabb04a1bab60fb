"""Delete any statement of the restaurant's domain and a case says so; each of them does something."""

from __future__ import annotations

import pytest

from sparc.errors import SourceError, SourceErrors
from tests.support.domain_cases import domain
from tests.support.mutants import Mutant, mutants, weakened
from waiter_cli.domain_tests.coverage import find_coverage
from waiter_cli.domain_tests.programs import make_programs
from waiter_cli.domain_tests.verdicts import run_cases

TEMPLATE, CASES = domain("restaurant")
ALL = mutants(TEMPLATE)
SAMPLE = ALL[::56]


def notices(mutant: Mutant) -> None:
    red = [verdict for verdict in run_cases(mutant.template, CASES) if not verdict.passed]
    assert red, f"no case notices that line {mutant.line} is gone: {mutant.deleted}"
    for verdict in red:
        assert all(failure.message and failure.where.line for failure in verdict.failures)


@pytest.mark.parametrize("mutant", SAMPLE, ids=str)
def test_a_case_notices_the_deletion(mutant: Mutant) -> None:
    notices(mutant)


@pytest.mark.slow
@pytest.mark.parametrize("mutant", ALL, ids=str)
def test_a_case_notices_every_deletion(mutant: Mutant) -> None:
    notices(mutant)


@pytest.mark.slow
def test_a_case_notices_every_condition_that_is_dropped() -> None:
    """All but the sort atoms that SPARC asks for, so that a variable has a sort."""
    survivors = []
    for mutant in weakened(TEMPLATE):
        try:
            verdicts = run_cases(mutant.template, CASES)
        except (SourceError, SourceErrors):
            continue
        if all(verdict.passed for verdict in verdicts):
            survivors.append(str(mutant))
    assert [one for one in survivors if "#step(I) of " not in one] == []


@pytest.mark.wide
def test_every_statement_fires_in_some_case() -> None:
    statements = find_coverage(TEMPLATE, make_programs(TEMPLATE, CASES))
    idle = [f"{one.place[0]}: {one.text}" for one in statements if not one.fired]
    assert idle == []
    assert [one.place[0] for one in statements] == [mutant.line for mutant in ALL]


def test_every_statement_is_explained() -> None:
    statements = find_coverage(TEMPLATE, make_programs(TEMPLATE, CASES[:1]))
    assert [one.text for one in statements if not one.sentence.strip(". ")] == []
