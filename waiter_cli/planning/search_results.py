"""The values of a search: its input (`SearchOptions`, `Domain`) and its result (`SearchResult`)."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass, field
from waiter_cli.model.plan import Plan
from waiter_cli.model.problem import Reason

if TYPE_CHECKING:
    from waiter_cli.bounds import Bounds

__all__ = [
    "InvalidPlanError",
    "NoPlanError",
    "Probe",
    "SearchOptions",
    "SearchResult",
    "SearchStage",
    "SearchStatus",
]


class SearchStatus(Enum):
    """The outcome of a search: four results that never stand for each other."""

    PLAN = "plan"
    NO_PLAN = "no_plan"
    CONTRADICTION = "contradiction"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Probe:
    """One horizon that was tried: ``result`` is ``sat``, ``unsat`` or ``unknown``."""

    horizon: int
    result: str
    seconds: float


@dataclass(frozen=True)
class SearchStage:
    """One stage of the work, for ``-v``: what came out, and the seconds it took."""

    name: str
    outcome: str
    seconds: float


@dataclass(frozen=True)
class SearchOptions:
    """Options of a search; ``max_steps`` and ``time_limit`` (seconds) None: as long as it takes.

    ``use_bounds`` False leaves the module of bounds and hints out altogether; ``effort`` is what
    is spent on them where they do not meet at once (1: a quarter of a second, 10: two seconds).
    ``listener`` is told of each stage as it ends.  ``known`` are bounds that were found before.
    ``choose`` False takes any plan of the least length, whatever is preferred.
    """

    strategy: str = "binary"
    max_steps: int | None = None
    time_limit: float | None = None
    use_bounds: bool = True
    effort: int = 10
    listener: Callable[[SearchStage], None] | None = None
    known: Bounds | None = None
    choose: bool = True


@dataclass(frozen=True)
class SearchResult:
    """The result of a search.

    ``bounds`` are proved: no plan is shorter than the first, one of the second's length exists
    (None: not known).  ``proof`` says what shows the plan minimal: ``unsat`` (the next smaller
    horizon was refuted by solving) or ``bound`` (no plan can be shorter, by an admissible bound).
    ``limit`` says what stopped an undecided search: ``time``, ``memory`` or ``max_steps``;
    ``max_steps`` is the most steps that a plan might have had, where there was such a bound.
    ``ties`` says how preferences chose among the plans of this length, None where there were none:
    ``proved`` (no other is better), ``budget`` (what choosing may cost ended first; the best one
    seen stands) or ``limit`` (as much, by the time limit or want of memory).
    ``lacking`` is a package that is not installed, and would have brought the bounds together.
    """

    status: SearchStatus
    bounds: tuple[int, int | None]
    strategy: str
    plan: Plan | None = None
    minimal: bool = False
    proof: str | None = None
    limit: str | None = None
    reasons: tuple[Reason, ...] = ()
    probes: tuple[Probe, ...] = ()
    seconds: float = 0.0
    stages: tuple[SearchStage, ...] = field(default=(), compare=False)
    max_steps: int | None = None
    ties: str | None = None
    lacking: str = ""

    def least_horizon(self) -> int:
        """Returns the least number of steps of a plan; raises `NoPlanError` where that is not known."""
        undecided = self.status is SearchStatus.UNDECIDED and not self.minimal
        if self.plan is None or undecided:
            raise NoPlanError(self)
        return self.plan.horizon


class NoPlanError(Exception):
    """A minimal plan was needed and there is none, or none was found in time; ``result`` says which."""

    def __init__(self, result: SearchResult) -> None:
        super().__init__(f"there is no minimal plan: {result.status.value}")
        self.result = result


class InvalidPlanError(Exception):
    """A plan that the program allows and its check refuses: a defect of ours."""
