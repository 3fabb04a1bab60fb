"""Numbers of options, read by one parser. Entry point `read_strictly`.

Typer takes what Python takes: ``nan``, ``inf``, ``1_000``, digits of other scripts.  A limit that is
no number is no limit, so every numeric option of every command reads as `sparc.numerals` does.
"""

from __future__ import annotations

import copy
from typing import Any

from sparc.numerals import MOST, decimal, whole

__all__ = ["read_strictly"]

_KINDS = {
    "int": (whole, "a whole number"),
    "int range": (whole, "a whole number"),
    "float": (decimal, "a number"),
    "float range": (decimal, "a number"),
}


def read_strictly(command: Any) -> Any:
    """Returns the command, whose numeric options, and its commands', take decimal digits alone."""
    for inner in getattr(command, "commands", {}).values():
        read_strictly(inner)
    for parameter in command.params:
        kind = _KINDS.get(parameter.type.name)
        if kind is not None:
            parameter.type = _strict(parameter.type, *kind)
        elif hasattr(parameter.type, "choices"):
            parameter.type = _telling(parameter.type)
    return command


def _telling(quiet: Any) -> Any:
    """Returns a choice as ``quiet`` whose errors carry ``wrong_choice``: the value and the choices."""
    from typer import BadParameter

    telling = copy.copy(quiet)

    def convert(value: Any, parameter: Any, context: Any) -> Any:
        try:
            return quiet.convert(value, parameter, context)
        except BadParameter as error:
            choices = tuple(str(getattr(each, "value", each)) for each in quiet.choices)
            error.__dict__["wrong_choice"] = (str(value), choices)
            raise

    telling.convert = convert
    return telling


def _strict(loose: Any, read: Any, what: str) -> Any:
    """Returns a type as ``loose``, with its bounds, that reads text with ``read``."""
    strict = copy.copy(loose)

    def convert(value: Any, parameter: Any, context: Any) -> Any:
        number = read(value) if isinstance(value, str) else value
        if number is None:
            size = f" up to {MOST}" if isinstance(value, str) and value.strip().isdigit() else ""
            shown = value if len(value) <= 40 else value[:40] + "…"
            strict.fail(f"{shown!r} is not {what}{size}.", parameter, context)
        return loose.convert(number, parameter, context)

    strict.convert = convert
    return strict
