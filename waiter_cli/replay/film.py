"""Watches a player and records what it sees. Entry point `open_film`.

Nothing of the pictures is imported before a recording or a window is asked for.
"""

from __future__ import annotations

import sys
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol

from waiter_cli.exits import Fault, InputError
from waiter_cli.situation import Where

if TYPE_CHECKING:
    from waiter_cli.replay.play import Outcome, Player
    from waiter_cli.replay.room import Room
    from waiter_cli.replay.snapshot import Snapshot

__all__ = ["Film", "Watcher", "open_film", "read_size"]

MIN_SIZE, MAX_SIZE = 160, 3840


class Watcher(Protocol):
    """Sees the player after every tick and every event as it is written."""

    def watch(self, player: Any) -> None: ...

    def event(self, line: str) -> None: ...

    def finish(self, player: Any, outcome: Any) -> str | None: ...

    def __enter__(self) -> Watcher: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None: ...


def read_size(text: str) -> tuple[int, int]:
    """Width and height, both even, from ``WxH``; raises `InputError`.

    >>> read_size("640x360")
    (640, 360)
    """
    wide, cross, high = text.lower().partition("x")
    if not cross or not wide.isdigit() or not high.isdigit():
        raise InputError(
            [Fault(Where("--size"), f"{text} is no size", "for example: --size 1260x720")]
        )
    width, height = int(wide) // 2 * 2, int(high) // 2 * 2
    if not (MIN_SIZE <= width <= MAX_SIZE and MIN_SIZE <= height <= MAX_SIZE):
        message = f"a frame has from {MIN_SIZE} to {MAX_SIZE} pixels each way, found {text}"
        raise InputError([Fault(Where("--size"), message, "for example: --size 1260x720")])
    return width, height


def open_film(
    room: Room, record: str | None, view: str | None, backend: str, fps: float, size: str,
    quality: str, *, gui: bool,
) -> Watcher:  # fmt: skip
    """What watches a run: a window, a page or a film.

    ``view`` None is 3d where PyBullet is there and not ruled out.  Raises `InputError` for an option
    that cannot be, `MissingError` where a part is missing.
    """
    width, height = read_size(size)
    if gui:
        if record is not None:
            raise InputError(
                [Fault(Where("--gui"), "a window is not recorded", "leave --record or --gui out")]
            )
        from waiter_cli.replay.window import Window

        return Window(room)
    assert record is not None
    from waiter_cli.replay.recording import kind_of, open_recorder

    if kind_of(record) == ".html":
        from waiter_cli.replay.output import Unfinished
        from waiter_cli.replay.page import PageFilm

        return PageFilm(room, Unfinished(record, "--record"), min(fps, 30.0))
    from waiter_cli.replay.lettering import require

    require()
    scene_kind = view or ("2d" if backend == "geometric" else _best_view())
    recorder = open_recorder(record, width, height, fps)
    try:
        from waiter_cli.replay.panel import Panel, panel_width

        stage = width - panel_width(width)
        scene: Any
        if scene_kind == "3d":
            from waiter_cli.replay.scene3d import Scene3D

            scene = Scene3D(room, stage, height, 2 if quality == "full" else 1)
        else:
            from waiter_cli.replay.scene2d import Scene2D

            scene = Scene2D(room, stage, height)
        return Film(scene, Panel(width, height, scene.project, scene.heads), recorder, fps, record)
    except BaseException:
        recorder.drop()
        raise


def _best_view() -> str:
    from importlib.util import find_spec

    if find_spec("pybullet") is not None:
        return "3d"
    print("waiter: PyBullet is not there; the film shows the room from above", file=sys.stderr)
    return "2d"


class Film:
    """Draws a frame whenever one is due and hands it to the recorder."""

    def __init__(self, scene: Any, panel: Any, recorder: Any, fps: float, out: str) -> None:
        self._scene, self._panel, self._recorder = scene, panel, recorder
        self._fps, self._out = fps, out
        self._frames = 0
        self._bar = Progress()
        self._kept = False

    def event(self, line: str) -> None:
        """A film shows no events."""

    def watch(self, player: Player) -> None:
        """Draws, if a frame is due; a still needs the last one only."""
        if self._out.lower().endswith(".png"):
            return
        if player.time * self._fps >= self._frames:
            self._frame(player)

    def _frame(self, player: Player) -> None:
        from waiter_cli.replay.snapshot import take

        moment = take(player)
        picture = self._picture(moment)
        while self._frames <= player.time * self._fps:
            self._recorder.write(picture)
            self._frames += 1
        self._bar.show(
            player.time, self._frames, len(player.deeds), moment.current + 1, len(moment.rows)
        )

    def _picture(self, moment: Snapshot) -> Any:
        scene = self._scene.draw(moment, self._panel.covered(moment))
        return self._panel.draw(scene, moment)

    def finish(self, player: Player, outcome: Outcome) -> str | None:
        """The last frame once more for a second, and the recording is kept."""
        from waiter_cli.replay.snapshot import take

        moment = take(player)
        picture = self._picture(moment)
        for _ in range(max(1, round(self._fps))):
            self._recorder.write(picture)
        self._bar.done()
        self._recorder.keep()
        self._kept = True
        return self._out

    def __enter__(self) -> Film:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        if not self._kept:
            self._bar.done()
            self._recorder.drop()
        self._scene.close()


class Progress:
    """A bar on stderr, where that is a terminal."""

    def __init__(self) -> None:
        self._shown = sys.stderr.isatty()
        self._last = -1
        self._width = 0
        utf = "utf" in (getattr(sys.stderr, "encoding", None) or "").lower()
        self._full, self._empty = ("█", "░") if utf else ("#", ".")

    def show(self, time: float, frames: int, deeds: int, step: int, steps: int) -> None:
        """How far the recording is."""
        if not self._shown or int(time * 4) == self._last:
            return
        self._last = int(time * 4)
        part = min(step, steps) / max(1, steps)
        done = round(24 * part)
        bar = self._full * done + self._empty * (24 - done)
        line = f"recording {bar} step {step}/{steps}  {time:6.1f} s  {frames} frames"
        self._width = max(self._width, len(line))
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()

    def done(self) -> None:
        """Takes the bar away."""
        if self._shown and self._last >= 0:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()
