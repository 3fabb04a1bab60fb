"""The page: what it holds of a room and of a run."""

from __future__ import annotations

import json
import re
from pathlib import Path

from tests.support.playing import layout_of, play, scene
from waiter_cli.pictures.html_page import PageFilm, room_document
from waiter_cli.pictures.output_files import Unfinished
from waiter_cli.room.room import build_room


def test_the_room_is_told_in_metres() -> None:
    room = build_room(layout_of("bistro"))
    told = json.loads(json.dumps(room_document(room)))
    assert told["nodes"] == {name: list(at) for name, at in room.nodes.items()}
    assert {name: len(chairs) for name, chairs in told["chairs"].items()} == {
        table.name: table.capacity for table in room.layout.tables
    }
    assert len(told["walls"]) == len(room.walls) == 6
    assert told["bar"][:2] == [9.1, 2.2]


def test_a_page_keeps_only_what_changes(tmp_path: Path) -> None:
    problem, file = scene("b3"), tmp_path / "a.html"
    page = PageFilm(build_room(problem.layout), Unfinished(str(file), "--record"), 4.0)
    seen = []

    def watch(run: object) -> None:
        page.watch(run)  # type: ignore[arg-type]
        seen[:] = [run]

    played = play(problem, watch=watch)
    for line in played.lines:
        page.event(line)
    page.finish(seen[0], played.outcome)
    found = re.search(r'(\{"title":.*\})[;\n)]', file.read_text())
    assert found is not None
    replay = json.loads(found[1])
    assert replay["status"] == "done" and len(replay["events"]) == len(played.lines)
    first, *later = replay["frames"]
    assert {"robot", "@c1", "chairs"} <= set(first[1])
    assert later and not any("chairs" in changed for _, changed, _ in later)
    assert [frame[0] for frame in replay["frames"]] == sorted(f[0] for f in replay["frames"])


def test_a_page_that_breaks_off_leaves_nothing(tmp_path: Path) -> None:
    file = Unfinished(str(tmp_path / "a.html"), "--record")
    with PageFilm(build_room(layout_of("report")), file, 4.0):
        Path(file.path).write_text("half")
    assert [*tmp_path.iterdir()] == []
