"""Sums up the runs of a study by combination: rows → `Combination`s.

Entry points `combinations`, and `common_runs` for what is set side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.evenings.measures import FIGURES
from waiter_cli.study.store import Row

__all__ = ["Combination", "combinations", "common_runs"]


@dataclass(frozen=True)
class Combination:
    """A layout, a number of robots (None where the study does not vary it) and a speed, with its runs.

    ``means`` are over the evenings that are ``done``, by figure; None where no evening has one.
    """

    layout: str
    agents: int | None
    speed: float
    done: int
    failed: int
    limit: int
    means: dict[str, float | None]

    def document(self) -> dict[str, Any]:
        """Returns it as JSON has it."""
        return {
            "layout": self.layout, "agents": self.agents, "speed": self.speed, "done": self.done,
            "failed": self.failed, "limit": self.limit, "means": self.means,
        }  # fmt: skip


def combinations(rows: Sequence[Row]) -> list[Combination]:
    """Returns the combinations of the runs, in the order of the study."""
    groups: dict[tuple[str, int | None, float], list[Row]] = {}
    for row in rows:
        groups.setdefault((row["layout"], row["agents"], row["speed"]), []).append(row)
    found = []
    for (layout, agents, speed), group in groups.items():
        statuses = [row["status"] for row in group]
        done = [row for row in group if row["status"] == "done"]
        means = {name: _mean([row[name] for row in done]) for name in FIGURES}
        failed, limit = statuses.count("failed"), statuses.count("limit")
        found.append(Combination(layout, agents, speed, len(done), failed, limit, means))
    return found


def common_runs(rows: Sequence[Row]) -> list[Row]:
    """Returns the runs that are done of the evenings on which all combinations have one.

    Otherwise a combination whose busiest evenings took too long would look better than it is.
    Combinations with no run that is done do not count; where no evening is common to the others, all
    runs that are done are returned.
    """
    done = [row for row in rows if row["status"] == "done"]
    played: dict[Any, set[tuple[Any, ...]]] = {}
    for row in done:
        played.setdefault(row["seed"], set()).add((row["layout"], row["agents"], row["speed"]))
    all_of_them = set().union(*played.values())
    common = {seed for seed, there in played.items() if there == all_of_them}
    return [row for row in done if row["seed"] in common] or done


def _mean(values: Sequence[Any]) -> float | None:
    known = [value for value in values if isinstance(value, (int, float))]
    return round(sum(known) / len(known), 4) if known else None
