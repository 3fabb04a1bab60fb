"""What an executive says: `Decision`, `Explanation` of what was seen, `Refused` for what cannot be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from sparc.values import dataclass
from waiter_cli.agenda import Pending
from waiter_cli.layout import Layout
from waiter_cli.plan import Action
from waiter_cli.problem import Reason
from waiter_cli.situation import Goal, Observation, State

__all__ = ["Decision", "Explainer", "Explanation", "Refused"]


class Refused(Exception):
    """An event that cannot be; nothing has changed.  ``hint`` is the mend."""

    def __init__(self, message: str, hint: str | None = None, reasons: Sequence[Reason] = ()):
        super().__init__(message)
        self.message = message
        self.hint = hint
        self.reasons = tuple(reasons)


@dataclass(frozen=True, slots=True)
class Explanation:
    """Events that nobody reported and that explain what was seen, best first by ``cost``.

    ``events`` are triples (step, name, arguments), by step; ``text`` says them in words, one each.
    ``state`` is what is to be believed then.
    """

    events: tuple[tuple[int, str, tuple[str, ...]], ...]
    text: tuple[str, ...]
    cost: int
    state: State


class Explainer(Protocol):
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
    ) -> tuple[Explanation, ...]: ...


@dataclass(frozen=True, slots=True)
class Decision:
    """What is to be done now.

    ``plan`` holds the remaining actions, a running one first, numbered through the whole run;
    ``horizon`` is the number of steps that remain, idle ones included.  ``status`` is ``plan``,
    ``no_plan`` or ``undecided``.  ``revision`` has grown whenever the plan changed, other than by
    steps being done.  ``pending`` wishes must wait; ``closed`` goals ended with their party;
    ``diagnosis`` lists explanations of what was seen last, the first of which is believed;
    ``abandoned`` is the running action that became impossible.
    """

    revision: int = 0
    plan: tuple[Action, ...] = ()
    horizon: int = 0
    minimal: bool = True
    status: str = "plan"
    reasons: tuple[Reason, ...] = ()
    limit: str | None = None
    pending: tuple[Pending, ...] = ()
    diagnosis: tuple[Explanation, ...] = ()
    closed: tuple[Goal, ...] = ()
    abandoned: Action | None = None
