"""The settings and results of a run: `Rules`, `RunOutcome` and the small values of a run.

`told`, `sentence`, `words` and `differences` say observations, actions and states in events and words.
"""

from __future__ import annotations

import dataclasses
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.files.documents import wish_document
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Observation, State

if TYPE_CHECKING:
    from waiter_cli.evenings.injections import Injection
    from waiter_cli.execution.agenda import Pending

__all__ = [
    "EVENT_OF", "TICKS", "BlockedEdge", "CheckFailure", "ShownAction", "Happening", "RunOutcome", "Rules", "RunEnded",
    "differences", "pending_document", "sentence", "told", "words",
]  # fmt: skip

TICKS = 60
"""Ticks in a simulated second."""
WORDS = {
    "pick": "follow me, please!",
    "seat": "here is your table",
    "give_bill": "your bill, please",
    "take_order": "what will it be?",
    "send_order": "an order for {table}!",
    "take_up": "the {item} for {table}",
    "bring": "the {item}, enjoy!",
    "refill": "I'll fill your {item}",
    "bring_chairs": "more chairs for {table}",
}
EVENT_OF = {
    "go_to": "arrived", "pick": "picked", "seat": "seated", "give_bill": "bill",
    "take_order": "ordered", "send_order": "sent", "take_up": "taken_up", "bring": "brought",
    "refill": "refilled", "bring_chairs": "chairs",
}  # fmt: skip


@dataclass(frozen=True)
class Rules:
    """The settings of a run: ``on_failure`` is stop, wait or replan.

    ``drive`` kinematic or physics.

    ``max_steps`` is what each plan is held to, for the words only.
    """

    speed: float = 0.8
    seed: int = 0
    drive: str = "kinematic"
    on_failure: str = "replan"
    max_steps: int | None = None


@dataclass(frozen=True)
class CheckFailure:
    """A check that failed: its name, the sentence, and when."""

    check: str
    reason: str
    time: float
    step: int


@dataclass(frozen=True)
class RunOutcome:
    """The outcome of a run; ``status`` is ``done``, ``failed`` or ``gave_up`` (``why`` says more).

    ``limit`` is the one that came first, where that is why it gave up.  ``figures`` say what the
    evening was like (`waiter_cli.evenings.measures`), where guests came by chance.  ``robots`` says of each
    of several its ``actions``, ``failed_actions``, ``metres`` and the share of time for which it was ``idle``.
    """

    status: str
    why: str | None
    seconds: float
    steps: int
    actions: int
    failed_actions: int
    replans: int
    events: int
    min_clearance: float | None
    nearest: str | None
    failures: tuple[CheckFailure, ...]
    final_state: State
    pending: tuple[dict[str, Any], ...] = ()
    backend: str = ""
    limit: str | None = None
    figures: dict[str, float | None] | None = None
    robots: dict[str, dict[str, float]] | None = None


@dataclasses.dataclass
class BlockedEdge:
    """Somebody who stands in the middle of an edge from ``time`` to ``until``."""

    edge: tuple[str, str]
    name: str
    time: float
    until: float | None
    standing: bool = False
    told: bool = False


@dataclass(frozen=True)
class Happening:
    """Something that comes by itself at a time: an event of the scenario, or an injection."""

    time: float
    order: int
    seen: tuple[Observation, ...] = ()
    injection: Injection | None = None


class RunEnded(Exception):
    """The run ends here."""

    def __init__(self, status: str, why: str, limit: str | None = None) -> None:
        super().__init__(why)
        self.status = status
        self.why = why
        self.limit = limit


@dataclasses.dataclass
class ShownAction:
    """An action as the side panel shows it: ``state`` is done, failed or now."""

    step: int
    text: str
    state: str


def pending_document(wish: Pending) -> dict[str, Any]:
    """Returns a wish that must wait, as events and summaries list it."""
    reasons = [reason.message for reason in wish.reasons]
    return wish_document(wish.goal, wish.then, reasons)


def differences(real: State, believed: State) -> str:
    """Returns the keys in which two states differ, with both values; empty when they are equal."""
    told = []
    for key in (field_.name for field_ in fields(State)):
        a, b = getattr(real, key), getattr(believed, key)
        if a != b:
            told.append(f"{key} is {_plain(a)}, not {_plain(b)}")
    return "; ".join(told)


def _plain(value: Any) -> str:
    if isinstance(value, frozenset):
        return str(sorted(value))
    return str(value)


def told(seen: Observation) -> dict[str, Any]:
    """Returns an observation as an event has it."""
    first, *rest = seen.arguments
    if seen.kind in ("enter", "leave"):
        return {"kind": seen.kind, "party": list(seen.arguments)}
    if seen.kind == "obs":
        return {"kind": "obs", "what": first}
    if seen.kind == "at":
        return {"kind": "at", "who": first, "node": rest[0]}
    return {"kind": seen.kind, "table": first, **({"object": rest[0]} if rest else {})}


def sentence(seen: Observation) -> str:
    first, *rest = seen.arguments
    match seen.kind:
        case "enter":
            return f"a party of {len(seen.arguments)} came in"
        case "leave":
            return f"the party of {first} left"
        case "bill":
            return f"{first} wants its bill"
        case "order":
            return f"{first} is ready to order"
        case "ready":
            return f"the {rest[0]} for {first} is ready"
        case "empty":
            return f"the {rest[0]} of {first} is empty"
        case "at":
            return f"{first} is at {rest[0]}"
        case "obs":
            return f"{first} was seen"
    return f"{first} is free"


def words(action: Action) -> str:
    """Returns the robot's words while it acts."""
    names = action.arguments[1:]
    item = names[0] if action.name in ("take_up", "bring", "refill") else ""
    table = names[0] if action.name == "bring_chairs" else names[-1]
    return WORDS[action.name].format(item=item, table=table)
