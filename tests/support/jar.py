"""The real sparc.jar for tests that compare with it; they run where Java and the jar are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from sparc.solving.jar_translator import find_java
from waiter_cli.errors import MissingError
from waiter_cli.translators.jar_store import find_jar

__all__ = ["JAR", "JAR_MARKS", "needs_jar"]


def _jar() -> Path | None:
    try:
        return find_jar().path if find_java() else None
    except MissingError:
        return None


JAR = _jar()
JAR_MARKS = (
    pytest.mark.jar,
    pytest.mark.skipif(JAR is None, reason="needs Java and sparc.jar"),
)


def needs_jar(test):  # type: ignore[no-untyped-def]
    """Marks a test that runs the real jar."""
    for mark in JAR_MARKS:
        test = mark(test)
    return test


FAMILY = """sorts
#person = {ann, bob}.
#year = 1..2.
predicates
knows(#person, #person).
born(#person, #year).
happy().
rules
% a comment with . and :+ inside
knows(ann, bob).
born(P, 1) | born(P, 2).  happy :- knows(X, Y),
   born(X, N), born(Y, N).
rest: -happy :+ knows(ann, ann).
knows(Y, X) :- knows(X, Y).
"""
FAMILY_ASP = """
knows(ann,bob).
born(P_G,1)|born(P_G,2):-person(P_G).
happy:-knows(X_G,Y_G),born(X_G,N_G),born(Y_G,N_G),person(X_G),person(Y_G),year(N_G).
appl(rest)|-appl(rest):-knows(ann,ann).
:~appl(rest),knows(ann,ann). [1@2,rest]
-happy:-knows(ann,ann),appl(rest).
knows(Y_G,X_G):-knows(X_G,Y_G),person(Y_G),person(X_G).
person(ann).
person(bob).
year(1).
year(2).
happy_:-happy.
happy__:--happy.
knows_(X1,X2):-knows(X1,X2).
knows__(X1,X2):--knows(X1,X2).
born_(X1,X2):-born(X1,X2).
born__(X1,X2):--born(X1,X2).
% happy_ happy__ knows_ knows__ born_ born__
"""
