"""The cheap dataclasses mean what the standard ones mean."""

from __future__ import annotations

import copy
import dataclasses
import pickle

import pytest

from sparc import lazy_dataclass as values

DEFAULT = ("a",)


def define(dataclass, field):
    @dataclass(frozen=True, order=True)
    class Value:
        x: int
        y: tuple = ()
        z: str = field(default="z", compare=False, repr=False)
        w: list = field(default_factory=list, compare=False)

        def total(self) -> int:
            return self.x + len(self.y)

    return Value


Ours = define(values.dataclass, values.field)
Theirs = define(dataclasses.dataclass, dataclasses.field)


@dataclasses.dataclass(frozen=True)
class Made:
    arguments: tuple
    named: dict


CASES = [Made((1,), {}), Made((1, (2,)), {}), Made((1,), {"z": "other"}), Made((2,), {"y": (1, 2)})]


@pytest.mark.parametrize("case", CASES)
def test_repr_is_the_same(case: Made) -> None:
    ours, theirs = Ours(*case.arguments, **case.named), Theirs(*case.arguments, **case.named)
    assert repr(ours) == repr(theirs)


@pytest.mark.parametrize("a", CASES)
@pytest.mark.parametrize("b", CASES)
def test_equality_order_and_hash_are_the_same(a: Made, b: Made) -> None:
    ours = [Ours(*case.arguments, **case.named) for case in (a, b)]
    theirs = [Theirs(*case.arguments, **case.named) for case in (a, b)]
    assert (ours[0] == ours[1]) == (theirs[0] == theirs[1])
    assert (ours[0] < ours[1]) == (theirs[0] < theirs[1])
    assert (hash(ours[0]) == hash(ours[1])) == (hash(theirs[0]) == hash(theirs[1]))


def test_it_is_frozen() -> None:
    value = Ours(1)
    with pytest.raises(dataclasses.FrozenInstanceError):
        value.x = 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        del value.x


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(TypeError):
        Ours()
    with pytest.raises(TypeError):
        Ours(1, nosuch=2)


def test_the_standard_tools_work() -> None:
    assert [f.name for f in dataclasses.fields(Ours)] == ["x", "y", "z", "w"]
    value = dataclasses.replace(Ours(1), y=(3,))
    assert (value.x, value.y) == (1, (3,))
    assert dataclasses.is_dataclass(value)
    match value:
        case Ours(x, y):
            assert (x, y) == (1, (3,))


def test_factories_make_a_new_value_each_time() -> None:
    assert Ours(1).w is not Ours(1).w


def test_another_class_is_not_equal() -> None:
    assert Ours(1) != Theirs(1)


def test_it_can_be_copied_and_pickled() -> None:
    from sparc.answer_sets import GroundTerm

    term = GroundTerm("f", (1, GroundTerm("a")))
    assert copy.deepcopy(term) == term
    assert pickle.loads(pickle.dumps(term)) == term


def test_equal_trees_hash_alike() -> None:
    from sparc.syntax.tree import Record, Variable

    assert len({Record("f", (Variable("X"),)), Record("f", (Variable("X"),))}) == 1
