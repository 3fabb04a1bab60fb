"""A program of one horizon → one for all horizons up to it. Entry point `with_open_horizon`.

The program for horizon H differs from that for H+1 in the facts of its steps, and in the bounds by which a
step and the next are both steps.  With a choice in place of those facts, and the next step asked for
beside those bounds, each choice of the last step is the program of that horizon, no more and no less;
whatever else a domain says of its steps need not be monotone.  A program that differs elsewhere too
is not of this form.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass

if TYPE_CHECKING:
    import clingo

    from sparc.translation.asp_program import AspProgram

__all__ = ["OpenHorizon", "with_open_horizon"]

_BOUND = re.compile(r"([A-Z_]\w*)<=(-?\d+)")


@dataclass(frozen=True)
class OpenHorizon:
    """A program whose last step is chosen; ``step`` is the name of the predicate that says so."""

    program: AspProgram
    step: str

    def reached(self, step: int) -> clingo.Symbol:
        """Returns the atom that a step belongs to the plan."""
        import clingo

        return clingo.Function(self.step, [clingo.Number(step)])


def with_open_horizon(program: AspProgram, longer: AspProgram, horizon: int) -> OpenHorizon | None:
    """Returns the program for every horizon up to ``horizon``; None where it is not of the form.

    ``program`` is that for ``horizon``, ``longer`` that for one step more.
    """
    lines, others = program.text.split("\n"), longer.text.split("\n")
    if len(lines) != len(others):
        return None
    facts = re.compile(rf"(\w+)\(0\.\.{horizon}\)\.")
    changed = [line for line, other in zip(lines, others) if line != other]
    names = [found[1] for line in changed if (found := facts.fullmatch(line))]
    if len(names) != 1:
        return None
    step = names[0]
    opened = []
    for line, other in zip(lines, others):
        if line == f"{step}(0..{horizon})." and other == f"{step}(0..{horizon + 1}).":
            chained = f":- {step}(I+1), not {step}(I), I = 0..{horizon - 1}."
            line = f"{step}(0). {{ {step}(1..{horizon}) }}. {chained}"
        elif line != other:
            bounded = _bounded(line, other, horizon, step)
            if bounded is None:
                return None
            line = bounded
        opened.append(line)
    return OpenHorizon(replace(program, text="\n".join(opened)), step)


def _bounded(line: str, other: str, horizon: int, step: str) -> str | None:
    """Returns a line whose bounds on steps ask for the last of them; None where more differs."""
    if _BOUND.sub("", line) != _BOUND.sub("", other):
        return None
    pieces, end = [], 0
    for here, there in zip(_BOUND.finditer(line), _BOUND.finditer(other), strict=True):
        pieces.append(line[end : here.end()])
        end = here.end()
        if here[0] == there[0]:
            continue
        if here[1] != there[1] or int(there[2]) != int(here[2]) + 1:
            return None
        pieces.append(f",{step}({here[1]}+{horizon - int(here[2])})")
    return "".join([*pieces, line[end:]])
