"""Products are made one combination at a time, and searches end."""

from __future__ import annotations

from itertools import islice, product

import pytest

from sparc.errors import LimitError
from sparc.sorts import lazy_values
from sparc.sorts.extents import Interval, Listed
from sparc.sorts.lazy_values import COUNTED, kept, lazy_product, limited, size_product


@pytest.mark.parametrize("held", [0, 4, 100_000])
def test_every_combination_in_order(held: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lazy_values, "_HELD", held)
    factors = [Listed(["b", "a"]), Interval(1, 3), Interval(0, 1)]
    assert list(lazy_product(factors)) == list(product("ba", (1, 2, 3), (0, 1)))
    assert list(lazy_product([*factors, Listed([])])) == []
    assert list(lazy_product(factors[:1])) == [("b",), ("a",)]


def test_nothing_is_held_of_what_is_large() -> None:
    huge = Interval(1, 10**12)
    assert list(islice(lazy_product([huge, huge]), 2)) == [(1, 1), (1, 2)]
    assert size_product([10**12, 10**12]) == COUNTED and size_product([3, 4]) == 12


def test_searches_are_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lazy_values, "_SEARCHED", 3)
    assert list(kept(iter(range(8)), lambda n: n % 4 == 3)) == [3, 7]  # three misses in a row
    with pytest.raises(LimitError, match="of 3 candidates in a row none belongs"):
        list(kept(iter(range(8)), lambda n: n == 0))
    assert list(limited(iter("abc"))) == ["a", "b", "c"]
    with pytest.raises(LimitError, match="more than 3 elements"):
        list(limited(iter("abcd")))
