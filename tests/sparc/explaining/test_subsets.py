"""Questions about the programs between some statements and the whole."""

from __future__ import annotations

import pytest

from sparc.explaining.subsets import SubsetOracle, Undecided
from sparc.translation.asp_program import AspProgram

# Statement 0 forbids what statement 1 gives; statement 2 forbids what 1 and 3 give together.
TEXT = "{on(0..3)}. a:-on(1). b:-on(3). :-on(0),a. :-on(2),a,b."


def oracle(text: str = TEXT, **options: object) -> SubsetOracle:
    return SubsetOracle(AspProgram(text, "#show."), "on", **options)  # type: ignore[arg-type]


def keys(*numbers: int) -> list[tuple[int]]:
    return [(number,) for number in numbers]


def test_the_switches_are_the_atoms_of_a_predicate() -> None:
    assert set(oracle().switches) == set(keys(0, 1, 2, 3))
    assert oracle("a.").switches == ()
    assert set(oracle("{on(1,x)}. {on(2)}.").switches) == {(2,), oracle("{on(1,x)}.").switches[0]}


@pytest.mark.parametrize(
    ("on", "conflict"),
    [([0, 1], [0, 1]), ([0, 1, 2, 3], None), ([1, 2, 3], [1, 2, 3]), ([0, 2, 3], ()), ([], ())],
)
def test_a_conflict_is_some_of_those_asked_for(
    on: list[int], conflict: list[int] | tuple[()] | None
) -> None:
    asked = oracle()
    found = asked.conflict(keys(*on))
    if conflict == ():
        assert found is None and asked.last_on >= set(keys(*on))
        return
    assert found is not None and found <= set(keys(*on))
    if conflict:
        assert found == set(keys(*conflict))
    assert asked.conflict(found) is not None


def test_atoms_that_are_off_may_be_the_switches() -> None:
    asked = oracle("{on(0..1)}. a:-not on(0). b:-not on(1). :-a,b.", when_on=False)
    assert asked.conflict(keys(0)) is None and asked.last_on == set(keys(0))
    assert asked.conflict(keys(0, 1)) == set(keys(0, 1))


def test_an_answer_set_within_so_many_conflicts() -> None:
    asked = oracle()
    assert asked.has_answer_set(keys(1, 3), 1000)
    assert {"a", "b"} <= set(map(str, asked.last_symbols))
    assert not asked.has_answer_set(keys(0, 1), 1000)
    assert asked.has_answer_set(keys(7), 1000)  # what is no switch is nothing to ask for


def test_the_most_that_can_be_on() -> None:
    asked = oracle(TEXT + " #maximize{1,N:on(N)}.")
    most = asked.most_on()
    assert most == set(keys(0, 2, 3))
    asked.add(":-on(0),on(2).")
    assert len(asked.most_on() or ()) == 2
    asked.add(":-not on(0). :-not on(1).")
    assert asked.most_on() is None


def test_time_that_is_up_is_no_answer() -> None:
    with pytest.raises(Undecided):
        oracle(deadline=0.0)
    asked = oracle()
    asked.deadline = 0.0
    for question in (
        lambda: asked.conflict(keys(0)),
        lambda: asked.most_on(),
        lambda: asked.has_answer_set(keys(0), 10),
    ):
        with pytest.raises(Undecided):
            question()
