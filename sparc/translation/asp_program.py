"""The translation of a SPARC program: clingo text, where each line came from, what is shown.

Made by `sparc.translate` and by the jar backend alike; `sparc.solving.clingo_solver` solves it.
"""

from __future__ import annotations

from itertools import zip_longest

from sparc.lazy_dataclass import dataclass, field
from sparc.source import Span

__all__ = ["AspProgram"]


@dataclass(frozen=True)
class AspProgram:
    """A clingo program.

    ``text`` has the rules and no ``#show``; ``show`` has the ``#show`` directives that make what
    SPARC displays visible and nothing else, so that a caller who wants to see other atoms can
    replace them.  ``line_spans`` gives for each line of ``text`` the SPARC statement it
    translates (None: sort facts and the like).  ``has_preferences``: only optimal answer sets
    count (cr-rules, weak constraints, optimization).  ``has_display``: some literals are hidden, so
    different answer sets may look the same.  ``places`` are those of the arithmetic that is left to
    exact functions (`sparc.solving.exact_arithmetic`), which name them by their index.
    """

    text: str
    show: str
    line_spans: tuple[Span | None, ...] = field(default=(), compare=False, repr=False)
    has_preferences: bool = False
    has_display: bool = False
    places: tuple[Span | None, ...] = field(default=(), compare=False, repr=False)

    def __str__(self) -> str:
        """Returns the program for clingo, with what it shows."""
        return f"{self.text}\n{self.show}"

    def annotated(self) -> str:
        """Returns the whole program, with ``% FILE:LINE`` above what each SPARC statement became."""
        lines: list[str] = []
        before: Span | None = None
        for line, span in zip_longest(self.text.split("\n"), self.line_spans):
            if span is not None and span is not before:
                place = span.location
                lines.append(f"% {place.name}:{place.line}")
            elif span is None and before is not None:
                lines.append("% sorts")
            lines.append(line or "")
            before = span
        return "\n".join([*lines, self.show, *self.script()])

    def script(self) -> list[str]:
        """Returns the lines that make a file of the program complete where it needs
        exact functions.

        A clingo that was built with Python runs such a file, where `sparc` is installed.
        """
        if not self.places and "@order(" not in self.text:
            return []
        return ["#script (python)", "from sparc.solving.exact_arithmetic import *", "#end."]
