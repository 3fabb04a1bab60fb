"""Refuses what the jar's translation cannot compute: `refuse_overflow` finds results
beyond 32 bits.

The jar writes arithmetic as it stands, and clingo cuts results to 32 bits.  Our own translation of
the same program counts exactly; where it meets a result that does not fit, the jar's would go
wrong.
"""

from __future__ import annotations

import time

from sparc.errors import NumberError, SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.cursor import MAX_NUMBER

__all__ = ["refuse_overflow"]


def refuse_overflow(source: Source, *, time_limit: float | None = None) -> None:
    """Raises `NumberError`, with its place, when some instance of ``source`` leaves 32 bits.

    Programs that only the jar takes pass.  Raises `TimeoutError` when ``time_limit`` (seconds) is
    over first.
    """
    from sparc.checking.checker import check
    from sparc.syntax.parser import parse
    from sparc.translation.translator import translate

    deadline = None if time_limit is None else time.monotonic() + time_limit
    try:
        program = translate(check(parse(source)))
    except NumberError:
        raise
    except (SourceError, SourceErrors):
        return
    if not program.places:
        return
    from sparc.solving.clingo_solver import Grounding
    from sparc.solving.clingo_threads import Abandoned

    grounding = Grounding(program)
    try:
        grounding.ground(deadline)
    except Abandoned:
        raise TimeoutError from None
    overflow = grounding.overflow
    if overflow is not None:
        raise NumberError(
            f"{overflow.instance} is {overflow.value}, beyond {MAX_NUMBER}, to which clingo counts",
            grounding.place(overflow),
            "use smaller numbers, or the native translator (--translator native), which counts"
            " exactly",
        )
