"""Ways for one robot after the other, in space and time: stops → `Trail`. Entry point `SpaceTime.travel`.

Prioritized planning (Erdmann and Lozano-Pérez, 1987): who goes later keeps clear of the trails of those
before, of colleagues, and in the end stands where nobody comes any more.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from sparc.lazy_dataclass import dataclass
from waiter_cli.fleets.jobs import Stage
from waiter_cli.model.problem import Problem

__all__ = ["SpaceTime", "Trail"]


@dataclass(frozen=True)
class Trail:
    """The node of a robot at every step; ``done`` says which stage it does at which step.

    It stays where it is at the last step.  ``finished`` is the step at which all is done.
    """

    nodes: tuple[str, ...]
    done: tuple[tuple[int, Stage], ...]
    finished: int

    def at(self, step: int) -> str:
        """Returns the node at a step."""
        return self.nodes[min(step, len(self.nodes) - 1)]


class SpaceTime:
    """The floor and who is where when; trails that were found are kept clear of."""

    def __init__(self, problem: Problem, most: int, deadline: float | None = None) -> None:
        self.deadline = deadline
        self.near = problem.layout.neighbours()
        self.most = most
        self.trails: list[Trail] = []
        posts = dict(problem.state.waiters)
        self.last = max((step for _, step, _ in problem.layout.timetable), default=0)
        self.staff: list[frozenset[str]] = []
        for step in range(self.last + 1):
            posts |= {who: to for who, at, to in problem.layout.timetable if at == step}
            self.staff.append(frozenset(posts.values()))

    def travel(
        self,
        start: str,
        stages: Sequence[Stage],
        end: str | None,
        waiting: Sequence[str] = (),
        late: int = 0,
    ) -> Trail | None:
        """Returns the quickest trail from ``start`` through all stages to ``end`` (None: anywhere).

        None where there is none of at most so many steps as were given.  It ends where nobody comes
        from then on, and keeps off the nodes of robots that are ``waiting`` for their turn at first.
        It does nothing but walk before step ``late``.
        """
        count = len(stages)
        places = [frozenset(stage.nodes) for stage in stages]
        layer: dict[tuple[str, int], tuple[str, int] | None] = {(start, 0): None}
        layers = [layer]
        settled = max([self.last, *(len(trail.nodes) for trail in self.trails)])
        for step in range(self.most + 1):
            layer = layers[-1]
            if self.deadline is not None and time.monotonic() > self.deadline:
                return None
            self._pass(layer, stages, places)
            done = [key for key in layer if key[1] == count and (end is None or key[0] == end)]
            if done:
                for key in done:
                    if self._stays(key[0], step, settled):
                        return self._trail(layers, key, stages, end is not None)
            now, then = self._taken(step), self._taken(step + 1)
            if step < 2:  # others have not gone yet
                then |= dict.fromkeys(waiting, -1)
            staff = self.staff[min(step, self.last)]
            fresh: dict[tuple[str, int], tuple[str, int] | None] = {}
            for key in layer:
                node, stage = key
                if node not in then:
                    fresh.setdefault((node, stage), key)
                    if (
                        stage < count
                        and step >= late
                        and stages[stage].name
                        and node in places[stage]
                    ):
                        fresh.setdefault((node, stage + 1), key)
                for other in self.near[node]:
                    if (
                        other not in then
                        and other not in staff
                        and not self._swaps(node, other, step, now)
                    ):
                        fresh.setdefault((other, stage), key)
            if not fresh:
                return None
            layers.append(fresh)
        return None

    def _pass(
        self,
        layer: dict[tuple[str, int], tuple[str, int] | None],
        stages: Sequence[Stage],
        places: Sequence[frozenset[str]],
    ) -> None:
        """Adds to a layer where a stage is passed by being there."""
        for key in list(layer):
            node, stage = key
            while stage < len(stages) and not stages[stage].name and node in places[stage]:
                stage += 1
                layer.setdefault((node, stage), layer[key])

    def _taken(self, step: int) -> dict[str, int]:
        """Returns where colleagues (-1) and earlier robots stand at a step."""
        steps = dict.fromkeys(self.staff[min(step, self.last)], -1)
        steps |= {trail.at(step): k for k, trail in enumerate(self.trails)}
        return steps

    def _swaps(self, here: str, there: str, step: int, now: dict[str, int]) -> bool:
        other = now.get(there, -1)
        return other >= 0 and self.trails[other].at(step + 1) == here

    def _stays(self, node: str, step: int, settled: int) -> bool:
        """Returns whether nobody comes to a node from a step on."""
        return all(node not in self._taken(later) for later in range(step, settled + 1))

    def _trail(
        self,
        layers: Sequence[dict[tuple[str, int], tuple[str, int] | None]],
        key: tuple[str, int],
        stages: Sequence[Stage],
        ends: bool,
    ) -> Trail:
        nodes, done, finished = [key[0]], [], 0
        if ends:
            finished = len(layers) - 1
        for step in range(len(layers) - 2, -1, -1):
            before = layers[step + 1][key]
            assert before is not None
            for stage in range(before[1], key[1]):
                if stages[stage].name:
                    done.append((step, stages[stage]))
                    finished = max(finished, step + 1)
                else:
                    finished = max(finished, step + 1)
            nodes.append(before[0])
            key = before
        return Trail(tuple(reversed(nodes)), tuple(reversed(done)), finished)
