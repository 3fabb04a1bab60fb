"""Opens a restaurant with its file and a situation for a studio. Entry point `open_files`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from sparc.lazy_dataclass import dataclass
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.model.layout import Layout
from waiter_cli.model.scenario import Scenario
from waiter_cli.pictures.html_page import room_document
from waiter_cli.room.room import Room, build_room

JOINT_SECONDS = 2.0
"""The time of a search for several robots, and that of their bounds."""
MOST_SEARCHES = 2.0
"""So many times the time of a search all those of one answer may take, since a person waits for it."""

if TYPE_CHECKING:
    from collections.abc import Callable

    from waiter_cli.serve.session import Session
    from waiter_cli.studio.live.film_reel import FilmReel
    from waiter_cli.studio.live.live_record import LiveRecord

__all__ = ["LiveEvening", "Opened", "open_files"]


class LiveEvening(Protocol):
    """The evening as actions of the page see it; `waiter_cli.studio.live.live_world.LiveWorld` is one.

    ``session`` is touched between two ticks only: by way of ``call``, which returns what a function
    returns that runs then.  The deeds of ``record`` are what happened, with the time of each:
    ``{"observe": [OBSERVATION, …]}``, ``{"block": EDGE}`` and the other lines that people send.
    ``note_saved`` hears what the layout's file holds by now.
    """

    session: Session
    reel: FilmReel
    record: LiveRecord

    def note_saved(self, text: str) -> None: ...

    def call(self, function: Callable[[], Any]) -> Any: ...


@dataclass(frozen=True)
class Opened:
    """The restaurant and the situation that the rooms of the page work on.

    ``text`` is the layout's file as it was read, ``path`` where it lies; ``scenario_name`` what was asked
    for, None for none; ``asked`` is how the layout was named on the command line.  ``live`` is the evening
    behind the room Live, ``journal`` the user's own for it.
    """

    layout: Layout
    text: str
    scenario: Scenario | None
    scenario_name: str | None
    room: Room
    planner: OnlinePlanner
    asked: str | None = None
    live: LiveEvening | None = None
    path: str = ""
    journal: str | None = None

    def room_document(self) -> dict[str, Any]:
        """Returns the room as ``page/floor.js`` draws it, and who works in it."""
        return {
            **room_document(self.room),
            "waiters": dict(self.layout.waiters),
            "robots": dict(self.layout.starts),
            "capacity": {table.name: table.capacity for table in self.layout.tables},
            "objects": list(self.layout.objects),
        }


def open_files(layout: str | None, scenario: str | None, planner: OnlinePlanner) -> Opened:
    """Returns what two names lead to; without any, the restaurant of the report.

    Raises `InputError` with every fault, one of which may be that there are no coordinates.
    """
    from dataclasses import replace

    from waiter_cli.errors import InputError
    from waiter_cli.execution.joint_requirements import require_joint_run
    from waiter_cli.file_access.locate import read_text
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.files.scenario_reader import read_scenario_file

    if "-" in (layout, scenario):
        raise InputError("a studio works on files", "name a file")
    found = None
    if layout is None and scenario is not None:
        named, found = read_scenario_file(scenario, several=True)
        layout = named.file
    file = read_text("report" if layout is None else layout, "layout")
    where = read_layout(file.text, file.shown, file)
    if scenario is not None and found is None:
        _, found = read_scenario_file(scenario, where, several=True)
    asked = "report" if layout is None else layout
    room, path = build_room(where), _resolved(file.path)
    require_joint_run(where, planner.domain)
    if where.agents:  # a person waits for it
        limit = max(JOINT_SECONDS, planner.time_limit or 0.0)
        planner = replace(planner, by_bounds=True, time_limit=limit)
    if planner.time_limit is not None:
        planner = replace(planner, seconds_in_all=MOST_SEARCHES * planner.time_limit)
    return Opened(where, file.text, found, scenario, room, planner, asked, path=path)


def _resolved(path: str | None) -> str:
    """Returns the path of a file in its real folder; the file itself may be a link, and stays one."""
    import os

    folder, name = os.path.split(os.path.abspath(path or ""))
    return os.path.join(os.path.realpath(folder), name) if path else ""
