"""Which cases of a parametrized test run by default; the rest is marked slow."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

__all__ = ["mostly_slow"]


def mostly_slow(cases: Iterable[Any], *default: Any) -> list[Any]:
    """All cases; those that are not among ``default`` run with ``-m slow`` only.

    Raises `ValueError` when a case is to run by default and is none.
    """
    listed = list(cases)
    unknown = [case for case in default if case not in listed]
    if unknown:
        raise ValueError(f"no such case: {unknown}")
    return [
        case if case in default else pytest.param(case, marks=pytest.mark.slow) for case in listed
    ]
