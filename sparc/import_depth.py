"""Detects a signal within an import, where no exception may be raised.

Entry point `imports_around`.
"""

from __future__ import annotations

from types import FrameType

__all__ = ["imports_around"]

_IMPORT_SYSTEM = ("<frozen importlib._bootstrap>", "<frozen importlib._bootstrap_external>")


def imports_around(frame: FrameType | None) -> int:
    """Returns the frames of the import system among ``frame`` and its callers.

    0 outside of every import.

    An exception there leaves locks taken and modules half made, which is found much later: as a
    `KeyError` of importlib's own, or as a codec that is unknown.  Nothing is imported or opened
    here, so a signal handler may ask.
    """
    count = 0
    while frame is not None:
        if frame.f_code.co_filename in _IMPORT_SYSTEM:
            count += 1
        frame = frame.f_back
    return count
