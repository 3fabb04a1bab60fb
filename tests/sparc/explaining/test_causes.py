"""Causes are minimal, mends are least, and none is left out."""

from __future__ import annotations

import pytest

from sparc.explaining.causes import all_causes, independent_causes, mends, shrink
from sparc.explaining.subsets import SubsetOracle
from sparc.explaining.switches import ON
from sparc.translation.asp_program import AspProgram


def oracle(size: int, *forbidden: tuple[int, ...], most: bool = False) -> SubsetOracle:
    """A program of ``size`` statements; those of a tuple leave no answer set together."""
    lines = [f"{{{ON}(0..{size - 1})}}."]
    lines += [f":-{','.join(f'{ON}({n})' for n in each)}." if each else ":-." for each in forbidden]
    if most:
        lines.append(f"#maximize{{1,N:{ON}(N)}}.")
    return SubsetOracle(AspProgram("\n".join(lines), "#show."), ON)


def numbers(sets: object) -> list[list[int]]:
    return sorted(sorted(key[0] for key in each) for each in sets)  # type: ignore[attr-defined]


CASES = [
    (4, [(0, 1)], [[0, 1]], [[0], [1]]),
    (4, [(0,)], [[0]], [[0]]),
    (5, [(0, 1), (2, 3, 4)], [[0, 1], [2, 3, 4]],
     [[0, 2], [0, 3], [0, 4], [1, 2], [1, 3], [1, 4]]),
    (4, [(0, 1), (1, 2), (0, 2)], [[0, 1], [0, 2], [1, 2]], [[0, 1], [0, 2], [1, 2]]),
    (4, [(0, 1, 2), (0,)], [[0]], [[0]]),
    (3, [], [], [[]]),
]  # fmt: skip


@pytest.mark.parametrize(("size", "forbidden", "causes", "least"), CASES)
def test_every_cause_and_every_mend(
    size: int, forbidden: list[tuple[int, ...]], causes: list[list[int]], least: list[list[int]]
) -> None:
    assert numbers(all_causes(oracle(size, *forbidden))) == causes
    found = list(mends(oracle(size, *forbidden, most=True)))
    assert numbers(found) == least
    assert [len(each) for each in found] == sorted(len(each) for each in found)


def test_what_is_known_is_not_told_again() -> None:
    known = [frozenset({(0,), (1,)})]
    assert numbers(all_causes(oracle(4, (0, 1), (1, 2)), known)) == [[1, 2]]


@pytest.mark.parametrize(
    ("forbidden", "told"),
    [([(0, 1), (2, 3)], [[0, 1], [2, 3]]), ([(0, 1), (1, 2)], None), ([], [])],
)
def test_causes_that_share_nothing(
    forbidden: list[tuple[int, ...]], told: list[list[int]] | None
) -> None:
    found = numbers(independent_causes(oracle(5, *forbidden)))
    if told is None:  # the two share statement 1: one of them is told
        assert found in ([[0, 1]], [[1, 2]])
    else:
        assert found == told


def test_a_conflict_shrinks_to_a_cause() -> None:
    asked = oracle(6, (1, 3), (2, 4, 5))
    assert shrink(asked, frozenset(asked.switches)) in ({(1,), (3,)}, {(2,), (4,), (5,)})
    assert shrink(asked, frozenset({(0,), (2,), (4,), (5,)})) == {(2,), (4,), (5,)}


def test_what_never_has_an_answer_set_has_a_cause_without_members() -> None:
    empty = oracle(2, ())
    assert shrink(empty, frozenset(empty.switches)) == frozenset()
    assert list(independent_causes(empty)) == [frozenset()]
    assert list(all_causes(oracle(2, ()))) == [frozenset()]
    assert list(mends(oracle(2, (), most=True))) == []
