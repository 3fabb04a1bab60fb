"""A small family as a SPARC program, and the translators to try it with."""

from __future__ import annotations

import pytest

from tests.support.jar import JAR_MARKS

__all__ = ["FAMILY", "both"]

FAMILY = """sorts
#person = {ann, bob, eve}.
#year = 1..3.
predicates
parent(#person, #person).
old(#person).
born(#person, #year).
rules
parent(ann, bob).   % ann is first
parent(bob,
       eve).
old(X) | -old(X) :- parent(X, eve).
-old(eve).
born(X, Y+1) :- parent(Z, X), born(Z, Y).
born(ann, 1).
"""


both = pytest.mark.parametrize("translator", ["native", pytest.param("jar", marks=JAR_MARKS)])
