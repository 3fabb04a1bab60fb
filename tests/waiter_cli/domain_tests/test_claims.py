"""Literals of cases, checked against the declarations: each slip is a fault at its character."""

from __future__ import annotations

import pytest

import sparc
from tests.support.rule_cases import START, posed
from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.domain_tests.claims import Claims, ClaimsReader
from waiter_cli.errors import Fault, Where

PROGRAM = """\
#const last = 2.
sorts
#step = 0..last.
#node = {kitchen, door}.
#action = go(#node).
#fluent = at(#node).
predicates
occurs(#action, #step).
holds(#fluent, #step).
rules
holds(at(door), 0).
"""


def read(**texts: tuple[str, ...]) -> tuple[Claims, list[Fault]]:
    said = {
        key: tuple(
            SparcText(text, Where("mine.yaml", line, 10)) for line, text in enumerate(each, 1)
        )
        for key, each in texts.items()
    }
    faults: list[Fault] = []
    reader = ClaimsReader(sparc.check(sparc.parse(PROGRAM)), faults)
    case = Case("a case", Where("mine.yaml", 1, 1), posed(START), **said)  # type: ignore[arg-type]
    return reader.claims(case), faults


def test_literals_are_read_and_actions_have_their_step() -> None:
    claims, faults = read(
        when=("go(door)", "", "go(kitchen)."), then=("holds(at(door), 1)",),
        never=("-holds(at(N), last)",), some=("holds(at(kitchen), 2)",),
    )  # fmt: skip
    assert faults == []
    assert [None if atom is None else str(atom.arguments[-1].value) for atom in claims.when] == [  # type: ignore[union-attr]
        "0", None, "2",
    ]  # fmt: skip
    assert (len(claims.then), len(claims.never), len(claims.some)) == (1, 1, 1)
    assert claims.never[0].negated and not claims.then[0].negated


@pytest.mark.parametrize(
    ("texts", "column", "hint"),
    [
        ({"when": ("go(dor)",)}, 10, "did you mean door?"),
        ({"when": ("gos(door)",)}, 10, "did you mean go?"),
        ({"then": ("holds(at(kitchn), 1)",)}, 10, "did you mean kitchen?"),
        ({"then": ("hold(at(door), 1)",)}, 10, "did you mean holds"),
        ({"some": ("holds(at(door), 9)",)}, 10, None),
        ({"then": ("holds(at(door) 1)",)}, 25, None),
        ({"then": ("holds(at(N), 1)",)}, 10, "a variable may stand under never only"),
        ({"some": ("holds(at(N), 1)",)}, 10, "a variable may stand under never only"),
    ],
)
def test_a_slip_is_a_fault_at_its_place(
    texts: dict[str, tuple[str, ...]], column: int, hint: str | None
) -> None:
    claims, (fault,) = read(**texts)
    assert claims.then == claims.some == ()
    assert fault.where is not None and (fault.where.line, fault.where.column) == (1, column)
    assert hint is None or hint in (fault.hint or "")


def test_a_variable_may_stand_where_nothing_is_allowed() -> None:
    claims, faults = read(never=("holds(at(N), 1)",))
    assert not faults and len(claims.never) == 1


def test_every_slip_is_told() -> None:
    _, faults = read(then=("holds(at(dor), 1)", "holds(at(door), 1)", "hold(at(door), 1)"))
    assert [fault.where.line for fault in faults if fault.where] == [1, 3]
