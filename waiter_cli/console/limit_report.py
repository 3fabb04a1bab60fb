"""Reports a limit that ended a command before the command could report it itself.

Entry points `undecided` (the documents of the contract, and exit 4) and `guarded`, which has them
said even where no memory is left to say them.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from typing import Any

from sparc.memory_guard import STARVED

__all__ = ["UNDECIDED", "guarded", "last_words", "undecided"]

UNDECIDED = 4
_WHY = {"time": "the time limit came first", "memory": "the memory ran out"}


def _document(arguments: Sequence[str], limit: str) -> dict[str, Any]:
    """Returns the document of a command of which nothing is known but the limit that ended it."""
    words = [word for word in arguments if not word.startswith("-")]
    match words[:1]:
        case ["plan"]:
            search = {"strategy": "binary", "horizons": [], "seconds": 0.0}
            more = {"bounds": [0, None], "minimal": False, "actions": [], "limit": limit}
            return {"status": "undecided", "layout": None, **more, "search": search}
        case ["answersets"]:
            sets: dict[str, Any] = {} if "--jsonl" in arguments else {"answer_sets": []}
            return {"satisfiable": None, "complete": False, **sets, "limit": limit}
        case ["explain"]:
            lists: dict[str, Any] = {key: [] for key in ("reasons", "causes", "changes")}
            return {"status": "undecided", "limit": limit, **lists, "diagnosis": []}
    if words[:2] == ["sparc", "query"]:
        return {"status": "undecided", "answer": "undecided", "limit": limit, "bindings": []}
    if words[:2] == ["sparc", "explain"]:
        return {"status": "undecided", "complete": False, "limit": limit, "causes": [], "mends": []}
    if words[:2] == ["sparc", "why"]:
        return {"literal": None, "holds": None, "set": None, "limit": limit}
    return {"status": "undecided", "limit": limit}


def last_words(arguments: Sequence[str], limit: str) -> tuple[str, str]:
    """Returns what goes to stdout and what goes to stderr, line ends included."""
    out = ""
    if "--jsonl" in arguments or ("--json" in arguments and "serve" not in arguments):
        out = json.dumps(_document(arguments, limit)) + "\n"
    return out, f"waiter: undecided: {_WHY[limit]}\n"


def undecided(arguments: Sequence[str], limit: str) -> int:
    """Reports that a limit came first; returns exit code 4."""
    out, err = last_words(arguments, limit)
    try:
        sys.stdout.write(out)
        sys.stdout.flush()
        sys.stderr.write(err)
        sys.stderr.flush()
    except MemoryError:
        os._exit(STARVED)
    return UNDECIDED


def guarded(arguments: Sequence[str]) -> None:
    """Runs `sparc.memory_guard.guarded` with the last words of one command line."""
    from sparc.memory_guard import guarded as run

    out, err = last_words(arguments, "memory")
    run(out.encode(), err.encode(), UNDECIDED)
