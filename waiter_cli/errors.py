"""Exit codes, and the exceptions that lead to them; `boundary` is where they become text.

The codes are those of the contract: 0 done, 1 our own defect, 2 wrong input, 3 proved (no plan,
inconsistent, invalid), 4 undecided (a limit came first), 5 something is missing here.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

from sparc.lazy_dataclass import dataclass

__all__ = ["Exit", "Fault", "InputError", "LayoutError", "MissingError", "ReplayError", "Where"]


class Exit(IntEnum):
    """The exit status of `waiter`."""

    OK = 0
    INTERNAL = 1
    INPUT = 2
    PROVED = 3
    UNDECIDED = 4
    MISSING = 5
    INTERRUPTED = 130
    TERMINATED = 143


@dataclass(frozen=True, order=True)
class Fault:
    """One thing wrong with an input: where, what, and the mend.

    ``excerpt`` is the line of the file, when there is one to show under the message.
    """

    where: Where | None
    message: str
    hint: str | None = None
    excerpt: str | None = None

    def __str__(self) -> str:
        head = f"{self.where}: {self.message}" if self.where else self.message
        return f"{head}; {self.hint}" if self.hint else head


class InputError(Exception):
    """The user's input is wrong; has every fault that was found, in order (exit 2)."""

    def __init__(self, faults: Sequence[Fault] | str, hint: str | None = None) -> None:
        if isinstance(faults, str):
            faults = [Fault(None, faults, hint)]
        self.faults: tuple[Fault, ...] = tuple(faults)
        super().__init__("\n".join(map(str, self.faults)))


class LayoutError(InputError):
    """A layout or scenario file that is wrong."""


class ReplayError(InputError):
    """A plan file that cannot be replayed as it stands."""


class MissingError(Exception):
    """The environment lacks something; ``mend`` is the command that gets it (exit 5)."""

    def __init__(self, message: str, mend: str) -> None:
        super().__init__(f"{message}; {mend}")
        self.message = message
        self.mend = mend


@dataclass(frozen=True, order=True)
class Where:
    """A place in a file of the user's: ``name:line:column`` (from 1); line 0 = on the command line."""

    name: str
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        return f"{self.name}:{self.line}:{self.column}" if self.line else self.name
