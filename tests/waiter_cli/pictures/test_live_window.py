"""The window: what is in it before anything moves."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.playing import layout_of
from waiter_cli.pictures import live_window as window
from waiter_cli.room.room import build_room
from waiter_cli.simulation import bullet


class NoStudio:
    def __init__(self, *, window: bool) -> None:
        assert window

    def add(self, *figure: Any) -> tuple[int, ...]:
        return ()


def test_a_window_names_tables_and_nodes_and_shows_the_ways(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seen: list[Any] = []
    monkeypatch.setattr(window, "probe", lambda: None)
    monkeypatch.setattr(window, "Studio", NoStudio)
    monkeypatch.setattr(window, "look_at", lambda studio, camera, *rest: seen.extend(rest))
    room = build_room(layout_of("report"))
    window.Window(room)
    names, ways = seen
    assert {name for name, _ in names} == {*room.tables, *room.nodes}
    assert len(ways) == len(room.layout.edges)
    assert {at[:2] for way in ways for at in way} <= set(room.nodes.values())


def test_a_window_draws_once_it_is_furnished(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is put into a window that draws takes a frame each."""
    called: list[tuple[str, Any]] = []

    class Recorder:
        GUI = 1

        def __getattr__(self, name: str) -> Any:
            if name.startswith("COV_"):
                return name

            def call(*given: Any, **_: Any) -> int:
                called.append((name, given))
                return 0

            return call

    monkeypatch.setattr(bullet, "require", Recorder)
    monkeypatch.setattr(bullet, "hush", lambda: None)
    monkeypatch.setattr(window, "probe", lambda: None)
    window.Window(build_room(layout_of("report")))
    switched = [k for k, (_, given) in enumerate(called) if given[:1] == ("COV_ENABLE_RENDERING",)]
    assert [called[k][1][1] for k in switched] == [0, 1]
    busy = {name for name, _ in called[switched[0] : switched[1]]}
    assert {"createMultiBody", "addUserDebugText", "addUserDebugLine"} <= busy
    assert not {name for name, _ in called[: switched[0]]} & {"createMultiBody"}
