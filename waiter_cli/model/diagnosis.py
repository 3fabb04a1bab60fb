"""A story of unseen events that explains what was observed."""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.state import State

__all__ = ["Diagnosis"]


@dataclass(frozen=True)
class Diagnosis:
    """Events that nobody reported and that explain what was seen, best first by ``cost``.

    ``events`` are triples (step, name, arguments), by step; ``text`` says them in words, one each.
    ``state`` is what is to be believed then.
    """

    events: tuple[tuple[int, str, tuple[str, ...]], ...]
    text: tuple[str, ...]
    cost: int
    state: State
