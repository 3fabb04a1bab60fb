"""The cases of a domain, `Case`: what holds, what happens, and what must follow.

A file of cases has a ``layout`` (inline, a built-in name or a path) and a list of ``cases``::

    cases:
      - name: walking takes the robot to the neighbouring node
        given: {state: {agent: n1}}
        when: [go_to(agent, n2)]
        then: [holds(currentlocation(agent, n2), 1)]
        never: [holds(currentlocation(agent, n1), 1)]

``given`` takes ``state``, ``observe``, ``goals``, ``before`` and ``instant_kitchen`` as a scenario
does, ``facts``: statements of SPARC, for what a scenario cannot say, and ``offer``: a plan that was
suggested to the program (its part ``offer``).  ``when`` lists what occurs at step 0, 1, …, one
action or ``nothing`` each; left out, the program is free to choose at each of ``steps`` steps (1).
``then`` holds in every answer set, ``never`` in none (a variable stands for every value), ``some``
in one at least; ``exactly: N`` counts them; ``impossible: true`` says that there is none.
``layout`` of a case wins over the file's.

Faults carry FILE:LINE:COLUMN; the literals themselves are parsed with the domain, in
`claims`.
"""

from __future__ import annotations

from dataclasses import replace

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.errors import Fault, Where
from waiter_cli.model.problem import Problem

__all__ = ["Case", "SparcText"]


@dataclass(frozen=True)
class SparcText:
    """A piece of SPARC in a file of cases: its text, the place of its first character, its line."""

    text: str
    where: Where
    excerpt: str | None = field(default=None, compare=False, repr=False)

    def fault(self, message: str, hint: str | None = None, offset: int = 0) -> Fault:
        """Returns the fault of the text, ``offset`` characters into it."""
        place = replace(self.where, column=self.where.column + max(0, offset))
        return Fault(place, message, hint, self.excerpt)


@dataclass(frozen=True)
class Case:
    """One expectation of a domain.

    ``problem`` has no goals unless the case names some (``has_goals``).  ``when`` is None where
    the program is free to choose, ``offer`` where no plan was suggested; an empty ``SparcText`` text in
    them is a step at which nothing occurs.
    """

    name: str
    where: Where
    problem: Problem
    has_goals: bool = False
    facts: tuple[SparcText, ...] = ()
    offer: tuple[SparcText, ...] | None = None
    when: tuple[SparcText, ...] | None = None
    steps: int = 1
    then: tuple[SparcText, ...] = ()
    never: tuple[SparcText, ...] = ()
    some: tuple[SparcText, ...] = ()
    exactly: int | None = None
    impossible: bool = False

    @property
    def horizon(self) -> int:
        """Returns the last step of its program: at least 1, so that what holds can go on to hold."""
        return self.steps if self.when is None else max(1, len(self.when))
