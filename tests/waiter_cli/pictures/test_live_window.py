"""The window: what is in it before anything moves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.fleet_rooms import AISLE, SWAP
from tests.support.playing import layout_of
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.pictures import live_window as window
from waiter_cli.room import figures
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


class FakeStudio(NoStudio):
    """Knows what was put in, where it was moved, and what was taken out."""

    def __init__(self, *, window: bool) -> None:
        super().__init__(window=window)
        self.bodies: dict[int, tuple[Any, float, float]] = {}

    def add(self, figure: Any, x: float = 0.0, y: float = 0.0, yaw: float = 0.0) -> tuple[int, ...]:
        self.bodies[len(self.bodies)] = (figure, x, y)
        return (len(self.bodies) - 1,)

    def move(self, body: tuple[int, ...], x: float, y: float, yaw: float) -> None:
        self.bodies[body[0]] = (self.bodies[body[0]][0], x, y)

    def remove(self, body: tuple[int, ...]) -> None:
        self.bodies[body[0]] = (None, 0.0, 0.0)

    def close(self) -> None:
        """Stays as it is."""


def test_a_window_moves_each_of_several_robots_in_its_colour(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[FakeStudio] = []

    def studio(*, window: bool) -> FakeStudio:
        opened.append(FakeStudio(window=window))
        return opened[0]

    monkeypatch.setattr(window, "probe", lambda: None)
    monkeypatch.setattr(window, "Studio", studio)
    monkeypatch.setattr(window, "look_at", lambda *_: None)
    monkeypatch.setattr(window.time, "sleep", lambda _: None)
    (tmp_path / "aisle.yaml").write_text(AISLE)
    swap = tmp_path / "swap.yaml"
    swap.write_text(f"layout: aisle.yaml\n{SWAP}")
    ran = waiter("simulate", "--scenario", str(swap), "--gui", "--backend", "geometric")
    assert (ran.code, "all checks passed" in ran.out) == (0, True)
    (shown,) = opened
    room = build_room(read_layout(AISLE, "aisle.yaml"))
    for number, node in enumerate("ea"):  # r1 and r2 have changed places
        there = [
            (x, y)
            for figure, x, y in shown.bodies.values()
            if figure is figures.robot(None, number)
        ]
        assert there == [room.nodes[node]]
