"""Which cases of a parametrized test run by default; the rest is marked wide or slow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import pytest

__all__ = ["mostly_slow", "mostly_slow_blocks", "mostly_wide", "widened"]


def mostly_slow(cases: Iterable[Any], *default: Any) -> list[Any]:
    """All cases; those that are not among ``default`` run with ``-m slow`` only.

    Raises `ValueError` when a case is to run by default and is none.
    """
    return _mostly(pytest.mark.slow, list(cases), default)


def mostly_wide(cases: Iterable[Any], *default: Any) -> list[Any]:
    """All cases; those that are not among ``default`` run with ``-m wide``, before a release.

    Raises `ValueError` when a case is to run by default and is none.
    """
    return _mostly(pytest.mark.wide, list(cases), default)


def mostly_slow_blocks(seeds: range, default: range, size: int = 100) -> list[Any]:
    """Two or more ranges of seeds: ``default``, and all ``seeds`` in slow blocks of ``size``."""
    blocks = (seeds[k : k + size] for k in range(0, len(seeds), size))
    return [
        pytest.param(default, id=_named(default)),
        *(
            pytest.param(block, id=f"{_named(block)} of all", marks=pytest.mark.slow)
            for block in blocks
        ),
    ]


def widened(few: Sequence[int], more: Sequence[int]) -> list[Any]:
    """Two sets of seeds: ``few`` by default, and ``more`` where it is wide."""
    return [
        pytest.param(few, id=_named(few)),
        pytest.param(more, id=_named(more), marks=pytest.mark.wide),
    ]


def _mostly(mark: pytest.MarkDecorator, cases: list[Any], default: tuple[Any, ...]) -> list[Any]:
    unknown = [case for case in default if case not in cases]
    if unknown:
        raise ValueError(f"no such case: {unknown}")
    return [case if case in default else pytest.param(case, marks=mark) for case in cases]


def _named(seeds: Sequence[int]) -> str:
    return f"{seeds[0]} to {seeds[-1]}"
