"""The values of a study: its factors, and the runs that they take.

Entry point `runs_of`: `Study` → `StudyRun`s, one for each evening of each combination.  The order
is evening by evening, so that a study that was stopped has compared like with like.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from typing import Any

from sparc.lazy_dataclass import dataclass

__all__ = [
    "BACKEND",
    "RunLimits",
    "RunResult",
    "Study",
    "StudyLayout",
    "StudyRun",
    "digest_of",
    "runs_of",
]

BACKEND = "geometric"
"""What measures clearances in a study; it is there on every machine."""


@dataclass(frozen=True)
class StudyLayout:
    """A layout as it is played: ``text`` is YAML, ``label`` what the study calls it.

    ``agents`` is the number of robots where the study varies it, else None.  ``file`` is shown in messages.
    """

    label: str
    text: str
    file: str
    agents: int | None = None


@dataclass(frozen=True)
class Study:
    """A study, valid by construction.

    ``layouts`` has an entry for each layout and number of robots.  ``scenario`` is shown in messages
    and replayed, ``scenario_text`` is YAML.  ``speeds`` are in metres a second; ``seeds`` are those of the evenings.
    ``varied`` names what the study varies of ``layout agents speed``.
    """

    name: str
    file: str
    layouts: tuple[StudyLayout, ...]
    speeds: tuple[float, ...]
    scenario: str
    scenario_text: str
    seeds: tuple[int, ...]
    varied: tuple[str, ...]

    @property
    def size(self) -> int:
        """Returns the number of runs."""
        return len(self.layouts) * len(self.speeds) * len(self.seeds)


@dataclass(frozen=True)
class StudyRun:
    """One evening in one combination; ``number`` counts from 1 through the study."""

    key: str
    number: int
    layout: StudyLayout
    speed: float
    scenario: str
    scenario_text: str
    seed: int
    version: str


@dataclass(frozen=True)
class RunLimits:
    """The limits of one run: ``seconds`` that pass, ``memory`` in bytes (None: no limit)."""

    seconds: float | None = None
    memory: int | None = None


@dataclass(frozen=True)
class RunResult:
    """The result of a run: ``status`` is ``done``, ``failed`` or ``limit``, with ``reason``.

    ``figures`` are those of `waiter_cli.evenings.measures`; ``seconds`` is processor time.
    """

    key: str
    status: str
    reason: str | None = None
    figures: dict[str, Any] | None = None
    seconds: float = 0.0


def digest_of(text: str) -> str:
    """Returns the SHA-256 of a text, in hexadecimal digits."""
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def runs_of(study: Study, version: str) -> Iterator[StudyRun]:
    """Yields the runs of a study.

    A run's key is a digest of what decides how it ends: the text of its layout and of its scenario,
    its options, and the ``version`` of the program.
    """
    digests = [digest_of(layout.text) for layout in study.layouts]
    scenario = digest_of(study.scenario_text)
    number = 0
    for seed in study.seeds:
        for layout, digest in zip(study.layouts, digests):
            for speed in study.speeds:
                number += 1
                options = {
                    "agents": layout.agents,
                    "backend": BACKEND,
                    "seed": seed,
                    "speed": speed,
                }
                told = json.dumps([digest, scenario, options, version], sort_keys=True)
                yield StudyRun(
                    digest_of(told), number, layout, speed, study.scenario, study.scenario_text,
                    seed, version,
                )  # fmt: skip
