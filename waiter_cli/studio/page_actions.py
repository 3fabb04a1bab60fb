"""Actions of the page by POST: ``/do/NAME`` with a JSON object, answered by one. Entry point `ACTIONS`.

To add one, write a function ``(studio, given) -> answer`` and put it in `ACTIONS` under its name.
It runs in a thread of its own, so it may take its time; what is shared with the evening is reached by
way of ``opened.live.call``, which runs a function between two ticks.  A `BadRequest` becomes status 400 with
``{"error": {"message", "hint"}}``; so does an `InputError`, with its faults.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from waiter_cli.studio.layout_actions import LAYOUT_ACTIONS
from waiter_cli.studio.page_requests import BadRequest
from waiter_cli.studio.why_actions import WHY_ACTIONS

if TYPE_CHECKING:
    from waiter_cli.studio.opened import Opened

__all__ = ["ACTIONS", "Action"]

Action = Callable[["Opened", dict[str, Any]], dict[str, Any]]


def _show_room(opened: Opened, given: dict[str, Any]) -> dict[str, Any]:
    """Answers ``/do/room``: what stands in the room, as ``page/floor.js`` draws it."""
    return opened.room_document()


def _show_past(opened: Opened, given: dict[str, Any]) -> dict[str, Any]:
    """Answers ``/do/past``: the changes of the evening about a time, the first one a whole moment."""
    time = given.get("time")
    if not isinstance(time, (int, float)) or isinstance(time, bool):
        raise BadRequest("time must be a number of seconds")
    assert opened.live is not None
    reel = opened.live.reel
    return {"changes": reel.since(float(time)), "begin": reel.begin, "end": reel.end}


ACTIONS: dict[str, Action] = {
    "room": _show_room,
    "past": _show_past,
    **LAYOUT_ACTIONS,
    **WHY_ACTIONS,
}
