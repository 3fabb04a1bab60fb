"""A surprise: what was believed, and what was observed all the same."""

from __future__ import annotations

from collections.abc import Iterator

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.graph import distances
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Observation, State

__all__ = ["Surprise"]


@dataclass(frozen=True)
class Surprise:
    """The observations to explain: who was seen where, and which tables were seen free or taken."""

    layout: Layout
    state: State
    seen: tuple[Observation, ...]
    step: int
    trail: tuple[tuple[int, str], ...]
    at: tuple[tuple[str, str], ...]
    free: tuple[str, ...]
    taken: tuple[str, ...]
    strangers: tuple[tuple[str, str], ...]
    """For each taken table the name of somebody who may have come in."""

    def staff(self) -> dict[str, str]:
        """Returns the believed place of each waiter."""
        return {"agent": self.state.agent, **dict(self.state.waiters)}

    def least(self) -> int:
        """Returns a number of events that no explanation falls short of."""
        believed, near = self.staff(), self.layout.joined()
        count = max(len(self.free), len(self.taken))
        for who, node in self.at:
            if who == "agent":
                count += believed[who] != node
            else:
                count += distances(near, believed[who]).get(node, 1)
        return count

    def suspicions(self) -> Iterator[tuple[frozenset[str], bool]]:
        """Yields who may have walked, and whether people may have been off the floor.

        Likeliest first.
        """
        believed, seen = self.staff(), dict(self.at)
        shut = set(seen.values())
        concerned = {who for who, node in believed.items() if seen.get(who, node) != node}
        concerned |= {who for who, node in believed.items() if node in shut and who not in seen}
        concerned.discard("agent")
        everybody = set(believed) - {"agent"}
        yield frozenset(concerned), False
        if concerned < everybody:
            yield frozenset(everybody), False
        if seen:
            yield frozenset(everybody), True
