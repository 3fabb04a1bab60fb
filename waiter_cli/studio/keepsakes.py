"""The evening to take along: scenario, plan, replay page, journal. Entry point `KEEPSAKES`.

Each is downloaded by the browser; the studio writes no file for it.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.files.documents import goals_document, state_document
from waiter_cli.model.problem import Problem
from waiter_cli.pictures.html_page import replay_page, room_document
from waiter_cli.studio.opened import LiveEvening, Opened
from waiter_cli.studio.page_requests import BadRequest

__all__ = ["KEEPSAKES", "Keepsake"]


@dataclass(frozen=True)
class Keepsake:
    """One thing to take along: its media type, and what makes its text."""

    media: str
    make: Callable[[Opened, LiveEvening], str]


def _scenario(opened: Opened, live: LiveEvening) -> str:
    """Returns the evening as a scenario: how it began, and what happened when."""
    record = live.record
    begin, deeds, goals = live.call(
        lambda: (record.begin_state, list(record.deeds), record.begin_goals)
    )
    lines = [
        "# An evening in the studio: how it began, and what people did, in simulated seconds.",
        "name: evening",
        f"layout: {json.dumps(_layout_name(opened))}",
        "",
        f"state: {_flow(state_document(begin, opened.layout))}",
    ]
    if goals:
        lines += ["goals:", *(f"  - {_flow(goal)}" for goal in goals_document(goals))]
    told, others = [], []
    for time, deed in deeds:
        when = round(time, 3)
        if "observe" in deed:
            told += [f"  - {_flow({'time': when, **one})}" for one in deed["observe"]]
        else:
            others.append(f"# at {when} s: {_flow(deed)}")
    if told:
        lines += ["events:", *told]
    if others:
        lines += ["", "# What a scenario has no words for:", *others]
    return "\n".join(lines) + "\n"


def _layout_name(opened: Opened) -> str:
    """Returns how a scenario names the layout: a file by its whole path, since it may lie anywhere."""
    origin = opened.layout.origin
    if opened.asked is not None and not Path(opened.asked).exists():
        return opened.asked
    return opened.layout.name if origin is None else str(Path(opened.layout.file).resolve())


def _flow(value: Any) -> str:
    """Returns a value in YAML's flow style."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return value if isinstance(value, str) else json.dumps(value)


def _plan(opened: Opened, live: LiveEvening) -> str:
    """Returns the plan of this moment as ``waiter plan --json`` tells it."""
    from waiter_cli.planning.planner import find_plan
    from waiter_cli.planning.search_results import SearchOptions

    problem: Problem | None = live.call(lambda: live.session.executive.planned)
    if problem is None:
        raise BadRequest("there is no plan to keep", "let something be wanted first")
    planner = opened.planner
    answer = find_plan(problem, planner.translator, planner.domain, SearchOptions(time_limit=10.0))
    return json.dumps(answer.document(), indent=2, ensure_ascii=False) + "\n"


def _replay(opened: Opened, live: LiveEvening) -> str:
    """Returns a page that replays what is still known of the evening."""
    frames = live.reel.all()
    if not frames:
        raise BadRequest("nothing has happened yet", "let the evening begin")
    begin = frames[0][0]
    moved = [[round(time - begin, 3), *rest] for time, *rest in frames]
    events = [
        {**event, "t": round(event["t"] - begin, 3)}
        for event in live.reel.events()
        if event["t"] >= begin
    ]
    seconds = live.reel.end - begin
    title = opened.scenario_name or opened.layout.name
    return replay_page(title, "evening", None, seconds, room_document(opened.room), moved, events)


def _journal(opened: Opened, live: LiveEvening) -> str:
    """Returns the journal as it is now: ``waiter serve --replay`` reads it."""

    def read() -> str:
        journal = live.session.journal
        assert journal is not None
        return Path(journal.path).read_text(encoding="utf-8")

    found: str = live.call(read)
    return found


KEEPSAKES = {
    "scenario.yaml": Keepsake("application/yaml; charset=utf-8", _scenario),
    "plan.json": Keepsake("application/json; charset=utf-8", _plan),
    "replay.html": Keepsake("text/html; charset=utf-8", _replay),
    "evening.journal": Keepsake("application/x-ndjson; charset=utf-8", _journal),
}
