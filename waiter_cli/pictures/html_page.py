"""The replay as one self-contained page: play, pause, step, speed and a scrubber, without any server.

Entry point `PageFilm`.  The page holds the room, the event log and who was where when; modules
that the studio's page has, too, draw it (`page_bundle`).  Positions are in centimetres, and only what changed is kept.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any

from waiter_cli.pictures.event_text import tell_all
from waiter_cli.pictures.moments import Change, MomentDiffer
from waiter_cli.pictures.output_files import Unfinished
from waiter_cli.pictures.page_bundle import bundled_script, bundled_style
from waiter_cli.pictures.snapshot import Snapshot, take
from waiter_cli.room.room import PERSON, ROBOT, Room
from waiter_cli.room.shapes import Box

if TYPE_CHECKING:
    from waiter_cli.simulation.outcome import RunOutcome
    from waiter_cli.simulation.run import Run

__all__ = ["PageFilm", "replay_page", "room_document"]

MARK, SCRIPT_MARK, STYLE_MARK = "/*REPLAY*/null", "/*MODULES*/", "/*FLOOR*/"


class PageFilm:
    """Collects what moves, ``fps`` times a second, and writes the page at the end."""

    def __init__(self, room: Room, file: Unfinished, fps: float) -> None:
        self._room, self._file, self._fps = room, file, fps
        self._count = 0
        self._events: list[str] = []
        self._frames: list[Change] = []
        self._differ = MomentDiffer()
        self._kept = False

    def event(self, line: str) -> None:
        """Events go into the page as they are."""
        self._events.append(line.rstrip("\n"))

    def watch(self, run: Run) -> None:
        """Notes what changed, if a frame is due."""
        if run.clock.time * self._fps < self._count:
            return
        self._count = int(run.clock.time * self._fps) + 1
        self._note(take(run))

    def _note(self, moment: Snapshot) -> None:
        change = self._differ.change(moment)
        if change is not None:
            self._frames.append(change)

    def finish(self, run: Run, outcome: RunOutcome) -> tuple[str, ...]:
        """Writes the page."""
        self._note(take(run))
        events = [json.loads(line) for line in self._events]
        page = replay_page(
            run.shown.title, outcome.status, outcome.why, run.clock.time, room_document(self._room),
            self._frames, events,
        )  # fmt: skip
        with open(self._file.path, "w", encoding="utf-8") as out:
            out.write(page)
        self._file.keep()
        self._kept = True
        return (self._file.named,)

    def __enter__(self) -> PageFilm:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        if not self._kept:
            self._file.drop()


def replay_page(
    title: str, status: str, why: str | None, seconds: float, room: dict[str, Any],
    frames: Sequence[Change], events: Sequence[dict[str, Any]],
) -> str:  # fmt: skip
    """Returns the text of a page that replays ``frames`` and lists ``events``."""
    replay = {
        "title": title,
        "status": status,
        "why": why,
        "seconds": round(seconds, 3),
        "room": room,
        "frames": frames,
        "events": events,
        "told": tell_all(events),
    }
    text = json.dumps(replay, ensure_ascii=True, separators=(",", ":")).replace("<", "\\u003c")
    template = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page.html")
    with open(template, encoding="utf-8") as file:
        page = file.read().replace(STYLE_MARK, bundled_style())
    return page.replace(SCRIPT_MARK, bundled_script()).replace(MARK, text)


def room_document(room: Room) -> dict[str, Any]:
    """Returns the room as the page's script wants it, in metres."""

    def box(b: Box) -> list[float]:
        return [round(v, 3) for v in (b.x, b.y, b.half_x, b.half_y, b.yaw)]

    return {
        "layout": room.layout.name,
        "bounds": list(room.bounds),
        "nodes": {name: list(at) for name, at in room.nodes.items()},
        "edges": [list(edge) for edge in room.layout.edges],
        "arrows": [[list(place) for place in room.arrow(*e)] for e in sorted(room.layout.one_way)],
        "entrance": room.layout.entrance,
        "door": list(room.door),
        "waiting": [list(place) for place in room.queue[:8]],
        "tables": {name: box(b) for name, b in room.tables.items()},
        "chairs": {
            name: [[round(v, 3) for v in (c.x, c.y, c.yaw)] for c in places]
            for name, places in room.chairs.items()
        },
        "bar": box(room.bar) if room.bar is not None else None,
        "walls": [box(b) for b in room.walls],
        "robot": ROBOT,
        "person": PERSON,
    }
