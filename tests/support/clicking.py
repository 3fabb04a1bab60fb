"""Evenings of the studio without a page, a clock and a thread; people click by chance. Class `Clicks`."""

from __future__ import annotations

import json
import re
from pathlib import Path
from random import Random
from typing import Any

from tests.support.serving import thinker
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.simulation.outcome import TICKS
from waiter_cli.studio.begin import begin_evening
from waiter_cli.studio.live.live_world import Ask, LiveWorld
from waiter_cli.studio.live.pace import Pace
from waiter_cli.studio.opened import open_files

__all__ = ["Clicks", "fleet_floor"]


class _AtOnce(Pace):
    """No tick waits for the clock on the wall."""

    def wait(self, ticks: int) -> float:
        return 0.0


def fleet_floor(seed: int, robots: int) -> str:
    """A generated layout with so many robots on it."""
    rng = Random(f"floor {seed}")
    nodes = rng.randint(7, 11)
    text = generate_layout(
        seed, nodes, nodes // 3, bar=rng.random() < 0.6, waiters=rng.randint(0, 1)
    )
    (line,) = re.findall(r"(?m)^agent: .*$", text)
    taken = {line.split()[1], *re.findall(r"w\d+: (n\d+)", text)}
    free = [name for name in re.findall(r"(?m)^  (n\d+):", text) if name not in taken]
    starts = [line.split()[1], *rng.sample(free, robots - 1)]
    told = ", ".join(f"r{k}: {node}" for k, node in enumerate(starts, 1))
    return text.replace(line, f"agents: {{{told}}}")


class Clicks:
    """An evening with several robots; `check` raises `AssertionError` where something is amiss."""

    live: LiveWorld

    def __init__(self, layout: str, folder: Path, seed: int = 0) -> None:
        self.rng = Random(f"clicks {seed}")
        self._path, self._journal = folder / "floor.yaml", folder / "evening.journal"
        self._path.write_text(layout, encoding="utf-8")
        self._count = 0
        self.rings = 0
        self._open()

    def _open(self) -> None:
        opened = open_files(str(self._path), None, thinker(0.4))
        evening = begin_evening(opened, str(self._journal), 0, 60.0, lambda told: None)
        self.live = evening.__enter__()
        self.end = evening.__exit__
        self.live.pace.__class__ = _AtOnce
        self.live.take_up()

    def __enter__(self) -> Clicks:
        return self

    def __exit__(self, *_: object) -> None:
        self.end(None, None, None)

    @property
    def executive(self) -> FleetExecutive:
        found = self.live.session.executive
        assert isinstance(found, FleetExecutive)
        return found

    def restart(self) -> None:
        """Ends the studio, and goes on from its journal."""
        self.end(None, None, None)
        self._open()

    def play(self, ticks: int) -> None:
        """Lets time pass."""
        run = self.live.run
        end, turns = run.clock.ticks + ticks, 0
        while run.clock.ticks < end:
            self.live.turn()
            turns += 1
            assert turns < ticks + 50, "time stands still"
            self.rings += bool(self.executive.finished)

    def tell(self, line: dict[str, Any]) -> dict[str, Any]:
        """The answer to a line."""
        self._count += 1
        told: list[str] = []
        self.live.ask(
            Ask(1, self._count, json.dumps(line).encode(), lambda text, _: told.append(text))
        )
        self.live.turn()
        return dict(json.loads(told[0]))

    def turn(self) -> None:
        """Something by chance: a click, some time, or the studio is started anew."""
        chance = self.rng.random()
        if chance < 0.08:
            self.restart()
        elif chance < 0.55:
            self.tell(self._line())
        else:
            self.play(self.rng.randint(1, 12 * TICKS))
        self.check()

    def _line(self) -> dict[str, Any]:
        rng, executive = self.rng, self.executive
        state, layout = executive.state, self.live.opened.layout
        nodes = [node.name for node in layout.nodes]
        robots = [name for name, _ in layout.agents]
        lines: list[dict[str, Any]] = [{"guests": rng.randint(1, 4)} for _ in range(3)]
        lines += [{"observe": {"out": rng.choice(robots)}}, {"block": rng.choice(layout.edges)}]
        lines += [{"back": name} for name in executive.out for _ in range(2)]
        lines += [{"clear": edge} for edge in executive.shut for _ in range(2)]
        lines += [{"failed": {a.arguments[0]: a.step}} for a in executive.moving]
        lines += [{"observe": {"bill": table}} for table, _ in state.seated]
        lines += [{"observe": {"order": table}} for table, _ in state.seated]
        lines += [{"observe": {"leave": [party[0]]}} for party in state.parties()]
        lines += [{"observe": {"at": {who: rng.choice(nodes)}}} for who, _ in state.waiters]
        lines += [
            {"seat": {"party": party[0], "table": rng.choice(layout.tables).name}}
            for party in state.waiting
        ]
        return rng.choice(lines)

    def check(self) -> None:
        """Nothing ran into anything; belief, world and bodies agree where nobody is on the way."""
        run, executive = self.live.run, self.executive
        faults = [wrong.reason for wrong in run._reporter.failures]
        assert not faults, faults
        assert executive.objection() is None, executive.objection()
        if run.at_rest and not executive.finished:
            assert run.world.state() == executive.state
        stations = executive.state.stations()
        over = {action.arguments[0] for action in executive.finished}
        for name, robot in run.robots.items():  # type: ignore[attr-defined]
            if robot.job is None and not robot.out and name not in over:
                assert robot.away(run.room.nodes[stations[name]]) < 0.05, (name, robot.pose)

    def settle(self) -> None:
        """Everybody is back and every path clear: then robots work until nothing is left to be done."""
        for _ in range(3):
            for name in self.executive.out:
                self.tell({"back": name})
            for edge in self.executive.shut:
                self.tell({"clear": list(edge)})
            self.play(40 * TICKS)
        for _ in range(60):
            if not self.executive.decision.horizon and not self.executive.moving:
                break
            self.play(10 * TICKS)
            self.check()
        left = self.executive
        assert not (left.out or left.moving or left.finished), (left.moving, left.finished)
        assert not left.decision.horizon, left.decision
