"""Translates SPARC with the translator of `sparc`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from sparc.source import Source
    from sparc.translation.asp_program import AspProgram

__all__ = ["NativeTranslator"]


@dataclass(frozen=True)
class NativeTranslator:
    """SPARC → ASP by `sparc` itself."""

    name: str = "native"
    costly: bool = False

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        """Returns the clingo program; raises `sparc.errors.SourceError` or ``SourceErrors``."""
        from sparc.checking.checker import check
        from sparc.syntax.parser import parse
        from sparc.translation.translator import translate

        return translate(check(parse(source)))
