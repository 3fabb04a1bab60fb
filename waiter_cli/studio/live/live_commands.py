"""Lines of the studio's own, beside those of ``waiter serve``. Entry point `read_command`.

===============================  ==============================================================
``{"play": true}``               goes on; ``false`` holds everything where it is
``{"step": 1}``                  goes on for one step of the plan, then holds
``{"speed": 4}``                 four times as fast as the clock on the wall
``{"guests": 4}``                a party of four comes in, named as nobody was before
``{"seat": {"party", "table"}}`` that party is to sit at that table; then everybody is served again
===============================  ==============================================================
"""

from __future__ import annotations

import json
from typing import Any

from waiter_cli.serve.protocol import MAX_LINE
from waiter_cli.studio.live.pace import FASTEST, SLOWEST

__all__ = ["COMMANDS", "BadCommand", "read_command"]

COMMANDS = ("play", "step", "speed", "guests", "seat")
MOST_STEPS = 1000
MOST_GUESTS = 50


class BadCommand(Exception):
    """A line that cannot be obeyed."""

    def __init__(self, message: str, hint: str | None = None, id: object = None) -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.id = {} if id is None else {"id": id}


def read_command(data: bytes) -> dict[str, Any] | None:
    """Returns the object of a line of our own, None for any other; raises `BadCommand`."""
    if len(data) > MAX_LINE:
        return None
    try:
        found = json.loads(data)
    except (ValueError, RecursionError):
        return None
    if not isinstance(found, dict) or not any(key in COMMANDS for key in found):
        return None
    id = found.get("id")
    kinds = [key for key in found if key != "id"]
    if len(kinds) != 1:
        raise BadCommand(f"{' and '.join(kinds)[:80]} in one line", "one of them a line", id)
    (kind,) = kinds
    wrong = _fault(kind, found[kind])
    if wrong is not None:
        raise BadCommand(wrong, None, id)
    return found


def _fault(kind: str, value: object) -> str | None:
    """Returns what is wrong with the value of a command."""
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    match kind:
        case "play" if not isinstance(value, bool):
            return "play takes true or false"
        case "step" if not (number and isinstance(value, int) and 1 <= value <= MOST_STEPS):
            return f"step takes a number of steps, up to {MOST_STEPS}"
        case "guests" if not (number and isinstance(value, int) and 1 <= value <= MOST_GUESTS):
            return f"guests takes a number of guests, up to {MOST_GUESTS}"
        case "speed" if not (number and SLOWEST <= float(str(value)) <= FASTEST):
            return f"speed takes a number from {SLOWEST:g} to {FASTEST:g}"
        case "seat":
            keys = {"party", "table"}
            if not isinstance(value, dict) or set(value) != keys:
                return "seat takes a party and a table"
            if not all(isinstance(each, str) for each in value.values()):
                return "seat takes the names of a party and a table"
    return None
