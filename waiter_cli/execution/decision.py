"""The values an executive gives: `Decision`, `Diagnosis` of what was seen, `Refused`
for the impossible.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from sparc.lazy_dataclass import dataclass
from waiter_cli.execution.agenda import Pending
from waiter_cli.model.diagnosis import Diagnosis
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Reason
from waiter_cli.model.state import Goal, Observation, State

__all__ = ["Decision", "Diagnoser", "Refused"]


class Refused(Exception):
    """An event that cannot be; nothing has changed.  ``hint`` is the mend."""

    def __init__(self, message: str, hint: str | None = None, reasons: Sequence[Reason] = ()):
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.reasons = tuple(reasons)


class Diagnoser(Protocol):
    """Finds out how observations can have come about; no explanation: an empty tuple.

    ``step`` is the step of ``state``; ``trail`` has the agent's places at earlier steps.
    """

    def __call__(
        self,
        layout: Layout,
        state: State,
        seen: Sequence[Observation],
        step: int,
        trail: Sequence[tuple[int, str]],
    ) -> tuple[Diagnosis, ...]: ...


@dataclass(frozen=True)
class Decision:
    """A decision about what to do now.

    ``plan`` holds the remaining actions, a running one first, numbered through the whole run;
    ``horizon`` is the number of steps that remain, idle ones included.  ``status`` is ``plan``,
    ``no_plan`` or ``undecided``.  ``revision`` has grown whenever the plan changed, other than by
    steps being done.  ``pending`` wishes must wait; ``closed`` goals ended with their party;
    ``diagnosis`` lists explanations of what was seen last, the first of which is believed;
    ``abandoned`` is the running action that became impossible.

    With several robots ``next`` says which action each one may begin now, and ``out`` which of them stand
    still.
    """

    revision: int = 0
    plan: tuple[Action, ...] = ()
    horizon: int = 0
    minimal: bool = True
    status: str = "plan"
    reasons: tuple[Reason, ...] = ()
    limit: str | None = None
    pending: tuple[Pending, ...] = ()
    diagnosis: tuple[Diagnosis, ...] = ()
    closed: tuple[Goal, ...] = ()
    abandoned: Action | None = None
    next: tuple[tuple[str, Action], ...] | None = None
    out: tuple[str, ...] = ()
