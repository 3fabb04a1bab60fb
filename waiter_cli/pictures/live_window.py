"""The replay in PyBullet's own window, in real time. Entry point `Window`.

PyBullet ends the whole process where it finds no display; so a child process tries first.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING

from waiter_cli.errors import MissingError
from waiter_cli.pictures.snapshot import Snapshot, take
from waiter_cli.room import figures
from waiter_cli.room.camera import frame_room
from waiter_cli.room.figures import Figure
from waiter_cli.room.room import Room
from waiter_cli.simulation.bullet import Studio, look_at, require

if TYPE_CHECKING:
    from waiter_cli.simulation.outcome import RunOutcome
    from waiter_cli.simulation.run import Run

__all__ = ["Window", "probe"]

FPS = 30.0
PROBE = "import pybullet as p, sys; sys.exit(0 if p.connect(p.GUI, options='--width=64 --height=64') >= 0 else 3)"


def probe() -> None:
    """Raises `MissingError` where no window can be opened here."""
    require()
    mend = "xvfb-run -a waiter simulate --gui … (or leave --gui out)"
    on_linux = sys.platform.startswith("linux")
    if on_linux and not os.environ.get("DISPLAY"):
        raise MissingError("there is no display (DISPLAY is not set)", mend)
    try:
        probed = subprocess.run(
            [sys.executable, "-c", PROBE], timeout=30, check=False,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise MissingError("opening a window takes more than 30 s here", mend) from None
    if probed.returncode != 0:
        raise MissingError("PyBullet cannot open a window on this display", mend)


class Window:
    """Shows a run while it goes on; simulated seconds pass like real ones."""

    def __init__(self, room: Room) -> None:
        probe()
        self._room = room
        self._studio = Studio(window=True)
        self._bodies: dict[str, tuple[Figure, tuple[int, ...]]] = {}
        self._began = 0.0
        self._due = 0.0
        x0, x1, y0, y1 = room.bounds
        add = self._studio.add
        add(
            figures.slab((x1 - x0) / 2, (y1 - y0) / 2, (0.80, 0.68, 0.53)),
            (x0 + x1) / 2,
            (y0 + y1) / 2,
            0.0,
        )
        for box in room.tables.values():
            add(figures.table(box.half_x, box.half_y), box.x, box.y, 0.0)
        for table in room.layout.tables:
            for chair in room.chairs[table.name][: table.chairs]:
                add(figures.chair(), chair.x, chair.y, chair.yaw)
        if room.bar is not None:
            add(figures.bar(room.bar.half_x, room.bar.half_y), room.bar.x, room.bar.y, 0.0)
        for wall in room.walls:
            add(figures.wall(wall.half_x, wall.half_y, wall.height), wall.x, wall.y, wall.yaw)
        names = [(name, (box.x, box.y, 0.95)) for name, box in room.tables.items()]
        names += [(name, (x + 0.1, y, 0.05)) for name, (x, y) in room.nodes.items()]
        spots = {name: (x, y, 0.01) for name, (x, y) in room.nodes.items()}
        ways = [(spots[a], spots[b]) for a, b in room.layout.edges]
        look_at(self._studio, frame_room(room, 1024, 768), names, ways)

    def event(self, line: str) -> None:
        """Events are not shown."""

    def watch(self, run: Run) -> None:
        """Moves everybody, and waits until it is time."""
        if self._began == 0.0:
            self._began = time.monotonic() - run.clock.time
        if run.clock.time < self._due:
            return
        self._due = run.clock.time + 1 / FPS
        self._show(take(run))
        ahead = run.clock.time - (time.monotonic() - self._began)
        if ahead > 0:
            time.sleep(min(ahead, 1.0))

    def _show(self, moment: Snapshot) -> None:
        wanted: dict[str, tuple[Figure, float, float, float]] = {
            each.key: (figures.robot(each.load, each.number), *each.pose) for each in moment.robots
        }
        for p in moment.people:
            figure = figures.person(p.number, p.role, p.posture, p.hand, p.stride)
            wanted["@" + p.name] = (figure, p.x, p.y, p.yaw)
        for table in self._room.layout.tables:
            for chair in self._room.chairs[table.name][
                table.chairs : dict(moment.chairs)[table.name]
            ]:
                wanted[chair.name] = (figures.chair(), chair.x, chair.y, chair.yaw)
        for name in [n for n in self._bodies if n not in wanted]:
            self._studio.remove(self._bodies.pop(name)[1])
        for name, (figure, x, y, yaw) in wanted.items():
            old = self._bodies.get(name)
            if old is not None and old[0] is figure:
                self._studio.move(old[1], x, y, yaw)
                continue
            if old is not None:
                self._studio.remove(old[1])
            self._bodies[name] = (figure, self._studio.add(figure, x, y, yaw))

    def finish(self, run: Run, outcome: RunOutcome) -> tuple[str, ...]:
        """Leaves the last picture for a second."""
        self._show(take(run))
        time.sleep(1.0)
        return ()

    def __enter__(self) -> Window:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        self._studio.close()
