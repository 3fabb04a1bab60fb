"""A case as a value: its last step, and faults at their characters."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.support.rule_cases import START, posed
from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.errors import Where

HERE = Where("mine.yaml", 3, 7)
SAID = SparcText("go_to(agent,n2)", HERE, "   | go_to(agent,n2)")
CASE = Case("it walks", HERE, posed(START))


def test_a_fault_stands_where_the_text_goes_wrong() -> None:
    fault = SAID.fault("no such node", "n1", 12)
    assert str(fault.where) == "mine.yaml:3:19"
    assert (fault.message, fault.hint, fault.excerpt) == ("no such node", "n1", SAID.excerpt)
    assert SAID.fault("x", offset=-5).where == HERE, "never before the text"


@pytest.mark.parametrize(
    ("changes", "horizon"),
    [
        ({}, 1), ({"steps": 4}, 4), ({"when": ()}, 1), ({"when": (SAID,)}, 1),
        ({"when": (SAID, SAID, SAID)}, 3), ({"when": (SAID,), "steps": 5}, 1),
    ],
)  # fmt: skip
def test_a_program_has_a_step_to_hold_in(changes: dict[str, object], horizon: int) -> None:
    assert replace(CASE, **changes).horizon == horizon  # type: ignore[arg-type]
