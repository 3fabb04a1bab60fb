"""Contraries are told where they are what leaves no answer set."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import sparc
from sparc.answer_sets import Ground, GroundTerm
from sparc.explaining.remarks import contraries, value_of
from sparc.explaining.subsets import Undecided
from sparc.explaining.switches import switched
from sparc.sorts.values import Value
from tests.support.inconsistent import SORTS

A = GroundTerm("a")
Instances = Mapping[int, list[dict[str, Ground]]]


def told(rules: str, instances: Instances, deadline: float | None = None) -> list[tuple[str, str]]:
    typed = sparc.check(sparc.parse(SORTS + rules))
    return contraries(typed, switched(typed), instances, deadline)


@pytest.mark.parametrize(
    ("rules", "instances", "pairs"),
    [
        ("p(a). -p(a).", {0: [{}], 1: [{}]}, [("p(a)", "-p(a)")]),
        ("p(a). -p(X) :- p(X).", {0: [{}], 1: [{"X": A}]}, [("p(a)", "-p(a)")]),
        ("p(a). -p(b).", {0: [{}], 1: [{}]}, []),
        ("p(a). -p(a). :- p(a).", {0: [{}], 1: [{}], 2: [{}]}, []),  # the law alone is not it
        ("r(2). -r(1+1).", {0: [{}], 1: [{}]}, [("r(2)", "-r(2)")]),
        ("{p(a)}. -p(a).", {0: [{}], 1: [{}]}, []),  # chosen, so never contrary
        ("p(a).", {0: []}, []),
    ],
    ids=["facts", "a rule", "others", "a constraint too", "numbers", "a choice", "nothing"],
)
def test_pairs(rules: str, instances: Instances, pairs: list[tuple[str, str]]) -> None:
    assert told(rules, instances) == pairs


def test_time_that_is_up_is_no_answer() -> None:
    with pytest.raises(Undecided):
        told("p(a). -p(a).", {0: [{}], 1: [{}]}, 0.0)


@pytest.mark.parametrize(
    ("term", "value"), [(3, 3), (A, "a"), (GroundTerm("f", (A, GroundTerm("g", (1,)))), ("f", "a", ("g", 1)))]
)  # fmt: skip
def test_values_as_the_sorts_know_them(term: Ground, value: Value) -> None:
    assert value_of(term) == value
