"""YAML text → `Case` values: what holds, what happens, what must follow. Entry points
`read_cases`, `read_case_folder`.

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
`domain_claims`.
"""

from __future__ import annotations

import os
from dataclasses import replace

from sparc.values import dataclass, field
from waiter_cli.exits import Fault, InputError, LayoutError
from waiter_cli.problem import Problem
from waiter_cli.resources import is_stream, read_text
from waiter_cli.situation import Where

__all__ = ["Case", "Said", "read_case_folder", "read_cases"]


@dataclass(frozen=True, slots=True)
class Said:
    """A piece of SPARC in a file of cases: its text, the place of its first character, its line."""

    text: str
    where: Where
    excerpt: str | None = field(default=None, compare=False, repr=False)

    def fault(self, message: str, hint: str | None = None, offset: int = 0) -> Fault:
        """What is wrong with it, ``offset`` characters into it."""
        place = replace(self.where, column=self.where.column + max(0, offset))
        return Fault(place, message, hint, self.excerpt)


@dataclass(frozen=True)
class Case:
    """One expectation of a domain.

    ``problem`` has no goals unless the case names some (``has_goals``).  ``when`` is None where
    the program is free to choose, ``offer`` where no plan was suggested; an empty ``Said`` text in
    them is a step at which nothing occurs.
    """

    name: str
    where: Where
    problem: Problem
    has_goals: bool = False
    facts: tuple[Said, ...] = ()
    offer: tuple[Said, ...] | None = None
    when: tuple[Said, ...] | None = None
    steps: int = 1
    then: tuple[Said, ...] = ()
    never: tuple[Said, ...] = ()
    some: tuple[Said, ...] = ()
    exactly: int | None = None
    impossible: bool = False

    @property
    def horizon(self) -> int:
        """The last step of its program: at least 1, so that what holds can go on to hold."""
        return self.steps if self.when is None else max(1, len(self.when))


def read_case_folder(folder: str) -> tuple[Case, ...]:
    """The cases of every YAML file in a folder, files by name, cases in their order.

    Raises `LayoutError` with every fault of every file, and where there is no such file.
    """
    try:
        names = sorted(n for n in os.listdir(folder) if n.endswith((".yaml", ".yml")))
        names = [n for n in names if not is_stream(os.path.join(folder, n))]
    except OSError:
        names = []
    if not names:
        hint = "write some: NAME.yaml in a folder cases/ beside the domain"
        raise LayoutError([Fault(Where(folder), "there are no cases", hint)])
    cases: list[Case] = []
    faults: list[Fault] = []
    for name in names:
        file = read_text(os.path.join(folder, name), "case file")
        try:
            cases.extend(read_cases(file.text, file.shown, folder))
        except InputError as error:
            faults.extend(error.faults)
    if faults:
        raise LayoutError(faults)
    return tuple(cases)


def read_cases(text: str, name: str, folder: str | None = None) -> tuple[Case, ...]:
    """The cases of one file; a layout's path starts from ``folder``.

    Raises `LayoutError` with every fault that was found.
    """
    from waiter_cli.domain_case_reader import read

    return read(text, name, folder)
