"""Defines what a translator is: SPARC in, a program for clingo out."""

from __future__ import annotations

from typing import Protocol

from sparc.source import Source
from sparc.translation.asp_program import AspProgram

__all__ = ["Translator"]


class Translator(Protocol):
    """Either backend: SPARC text → ASP text."""

    @property
    def name(self) -> str:
        """``native`` or ``jar``."""
        ...

    @property
    def costly(self) -> bool:
        """Returns whether a translation takes so long that one is to serve for all horizons."""
        ...

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        """Returns the clingo program; raises `sparc.SourceErrors` where the text is wrong."""
        ...
