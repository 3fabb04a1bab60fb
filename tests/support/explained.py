"""A small program about birds, and what is said of its literals: `found`, `step`, `absence`."""

from __future__ import annotations

import sparc
from sparc.explaining.absence import Absence
from sparc.explaining.answer_model import AnswerModel, nth_model
from sparc.explaining.derivation import Derivation
from sparc.explaining.why import Why

__all__ = ["BIRDS", "absence", "found", "model_of", "step"]

BIRDS = """sorts
#s = {sam, tweety}.
#n = 0..5.
#f = on(#s).
predicates
bird(#s). penguin(#s). flies(#s). c(#s). n(#n). next(#n). k(#n). big(). odd(). d(#s). h(#f,#n). x(). y().
rules
bird(tweety). bird(sam).
penguin(sam).

% Birds fly.
flies(X) :- bird(X), not penguin(X).
-flies(X) :- penguin(X).

n(0..2).
next(N+1) :- next(N).
next(0).
1{c(X) : bird(X)}1.
k(N) :- #count{X : bird(X)} = N.
big :- k(N), N > 3.
d(X) | -d(X) :- bird(X).
h(on(X), N+1) :- h(on(X), N).
h(on(sam), 3) :- bird(_).
x :- y.
y :- x.
"""


def found(literal: str, program: str = BIRDS, **options: int) -> Why:
    return sparc.why(sparc.Source("p.sparc", program), literal, **options)


def step(literal: str, program: str = BIRDS) -> Derivation:
    why = found(literal, program)
    assert why.holds
    return why.because[0]


def absence(literal: str, program: str = BIRDS) -> Absence:
    why = found(literal, program)
    assert why.holds is False and why.because_not is not None
    return why.because_not


def model_of(program: str, number: int = 1) -> AnswerModel:
    """The ``number``-th answer set of a program."""
    typed = sparc.check(sparc.parse(sparc.Source("p.sparc", program)))
    atoms, _ = nth_model(typed, number, None)
    assert atoms is not None
    return AnswerModel(typed, atoms, None)
