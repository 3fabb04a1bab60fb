"""The translation of a SPARC program: clingo text, where each line came from, what is shown.

Made by `sparc.translate` and by the jar backend alike; `sparc.solvers.native` solves it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from sparc.source import Span

__all__ = ["AspProgram"]


@dataclass(frozen=True)
class AspProgram:
    """A clingo program.

    ``text`` has the rules and no ``#show``; ``show`` has the ``#show`` directives that make what
    SPARC displays visible and nothing else, so that a caller who wants to see other atoms can
    replace them.  ``line_spans`` gives for each line of ``text`` the SPARC statement it
    translates (None: sort facts and the like).  ``has_preferences``: only optimal answer sets
    count (cr-rules, weak constraints, optimization).
    """

    text: str
    show: str
    line_spans: tuple[Span | None, ...] = field(default=(), compare=False, repr=False)
    has_preferences: bool = False
