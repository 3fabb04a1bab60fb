"""Shows how a search went: its stages, progress and diagnoses."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from waiter_cli.console.output import say
from waiter_cli.console.progress import alive
from waiter_cli.console.styling import styled

if TYPE_CHECKING:
    from waiter_cli.model.diagnosis import Diagnosis
    from waiter_cli.planning.search_results import SearchStage

__all__ = ["print_diagnoses", "print_stages", "searching"]


def print_stages(stages: Iterable[SearchStage]) -> None:
    """Prints on stderr each stage of a search with its result and its time, for ``-v``."""
    for stage in stages:
        head = f"{stage.name:>10}  {stage.seconds * 1000:8.1f} ms  "
        say(f"{head}{stage.outcome}", sys.stderr, len(head.lstrip()))


def print_diagnoses(diagnoses: Sequence[Diagnosis]) -> None:
    """Prints explanations of surprising observations."""
    if diagnoses:
        say(styled("What was observed is a surprise; it may have come about so:", "bold"))
        for diagnosis in diagnoses:
            say(f"  {'; '.join(diagnosis.text)}")


@contextmanager
def searching() -> Iterator[Callable[[SearchStage], None]]:
    """Shows the progress of a search, like `alive`, with its stages."""
    with alive("searching") as note:
        yield lambda stage: note(f"{stage.name}: {stage.outcome}")
