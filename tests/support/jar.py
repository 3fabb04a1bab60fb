"""The real sparc.jar for tests that compare with it; they run where Java and the jar are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from sparc.solving.jar_translator import find_java
from waiter_cli.errors import MissingError
from waiter_cli.translators.jar_store import find_jar

__all__ = ["JAR", "JAR_MARKS", "needs_jar"]


def _jar() -> Path | None:
    try:
        return find_jar().path if find_java() else None
    except MissingError:
        return None


JAR = _jar()
JAR_MARKS = (
    pytest.mark.jar,
    pytest.mark.skipif(JAR is None, reason="needs Java and sparc.jar"),
)


def needs_jar(test):  # type: ignore[no-untyped-def]
    """Marks a test that runs the real jar."""
    for mark in JAR_MARKS:
        test = mark(test)
    return test
