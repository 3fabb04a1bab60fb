"""Which ground instances of the statements of a cause take part in it."""

from __future__ import annotations

import pytest

import sparc
from sparc.answer_sets import GroundTerm
from sparc.explaining.active_instances import (
    SHOWN_INSTANCES,
    active_instances,
    global_variables,
    shown_instances,
)
from sparc.explaining.switches import switched
from tests.support.inconsistent import SORTS


def test_the_instances_raise_at_the_deadline() -> None:
    from sparc.explaining.active_instances import active_instances
    from sparc.explaining.subsets import Undecided
    from sparc.explaining.switches import switched

    typed = sparc.check(sparc.parse(SORTS + "p(a). -p(a). "))
    with pytest.raises(Undecided):
        active_instances(typed, switched(typed), [0, 1], 0.0)


def instances(rules: str, cause: list[int]) -> dict[int, list[str]]:
    typed = sparc.check(sparc.parse(SORTS + rules))
    found = active_instances(typed, switched(typed), cause, None)
    return {index: shown_instances(typed, index, each) for index, each in found.items()}


@pytest.mark.parametrize(
    ("rules", "cause", "told"),
    [
        ("p(a). p(b). q(X) :- p(X). :- q(a).", [0, 2, 3],
         {0: ["p(a)"], 2: ["q(a) :- p(a)"], 3: ["q(a)"]}),
        ("r(0..2). :- r(N), N > 1.", [0, 1], {0: ["r(0..2)"], 1: ["r(2), 2 > 1"]}),
        ("p(a) | p(b). q(a). :- p(X), q(a).", [0, 1, 2],
         {0: ["p(a) | p(b)"], 1: ["q(a)"], 2: ["p(a), q(a)", "p(b), q(a)"]}),
        ("p(a). t. :- p(a). :- t.", [1, 3], {1: ["t"], 3: ["t"]}),
        ("p(a). :- t.", [0, 1], {}),
    ],
    ids=["one of two", "a range", "each of a disjunction", "another cause", "no cause"],
)  # fmt: skip
def test_what_takes_part(rules: str, cause: list[int], told: dict[int, list[str]]) -> None:
    assert instances(rules, cause) == told


def test_so_many_are_shown_each_once() -> None:
    typed = sparc.check(sparc.parse(SORTS + "r(N) :- r(M), N = M."))
    values = [{"N": n, "M": 0} for n in (3, 1, 1, 0, 2)]
    assert SHOWN_INSTANCES == 3
    assert shown_instances(typed, 0, values) == [
        "r(3) :- r(0), 3 = 0", "r(1) :- r(0), 1 = 0", "r(0) :- r(0), 0 = 0",
    ]  # fmt: skip


def test_the_variables_that_tell_instances_apart() -> None:
    rules = "q(X) :- p(X), #count{Y : q(Y)} > 0. r(1..2). :~ t. [1:1]"
    typed = sparc.check(sparc.parse(SORTS + rules))
    assert [global_variables(typed, n) for n in range(3)] == [["X"], [], []]


def test_values_are_in_order() -> None:
    typed = sparc.check(sparc.parse(SORTS + "p(b). p(a). r(2). r(1). :- p(X), r(N)."))
    found = active_instances(typed, switched(typed), [0, 2, 4], None)
    ((one,),) = [found[4]]
    assert one == {"X": GroundTerm("b"), "N": 2}
