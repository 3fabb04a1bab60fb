"""The words of the protocol: the kinds of lines of the live loop, and of questions."""

from __future__ import annotations

__all__ = ["ASKS", "EVENTS"]

EVENTS = (
    "observe", "done", "failed", "started", "back", "goal", "drop", "block", "clear", "ask",
)  # fmt: skip
"""The keys of which each line has one."""
ASKS = ("state", "plan", "why", "stats")
"""The values of ``ask``."""
