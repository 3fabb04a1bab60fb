"""Small programs in files, each with the faults it must have written where they are.

A file of cases holds programs parted by lines that begin with ``%---`` (what follows on such a
line is the case's title).  A line with a fault ends in ``%! "text"``, text being a part of the
message or of the hint; two faults are written ``%! "one" %! "two"``.  A missing fault and an
unexpected one both fail.  A program without such marks must have no fault.

Text before the first ``%---`` stands in front of every program of the file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

from sparc.errors import SourceError
from sparc.source import Source
from tests.support.paths import ROOT

CASES = ROOT / "tests" / "sparc" / "cases"


@dataclass(frozen=True)
class Case:
    """One program, and its faults as pairs of line (in the file) and text."""

    title: str
    source: Source
    expected: tuple[tuple[int, str], ...]


def read_cases(path: Path) -> list[Case]:
    """The cases of a file, in order; the lines of their sources are the lines of the file."""
    lines = path.read_text(encoding="utf-8").split("\n")
    bars = [index for index, line in enumerate(lines) if line.startswith("%---")]
    preamble = lines[: bars[0]]
    cases = []
    for bar, end in zip(bars, [*bars[1:], len(lines)]):
        first = bar + 1  # the index of the program's first line
        body = lines[first:end]
        text = "\n".join(preamble + body)
        source = Source(path.name, text, first_line=first + 1 - len(preamble))
        expected = tuple(
            (first + 1 + index, mark.strip().removeprefix('"').removesuffix('"'))
            for index, line in enumerate(body)
            for mark in line.split("%!")[1:]
        )
        title = lines[bar].removeprefix("%---").strip() or f"line {bar + 1}"
        cases.append(Case(title, source, expected))
    return cases


def case_parameters(pattern: str) -> list[object]:
    """The cases of all files that match ``pattern``, as parameters with readable ids."""
    return [
        pytest.param(case, id=f"{path.stem}: {case.title}")
        for path in sorted(CASES.glob(pattern))
        for case in read_cases(path)
    ]


def check_case(case: Case, faults: Callable[[Source], Iterable[SourceError]]) -> None:
    """Asserts that ``faults`` finds in the case's source what is written there, and no more."""
    left = list(case.expected)
    surplus = []
    for error in faults(case.source):
        assert error.span is not None, f"a fault without a place: {error.message}"
        line = error.span.location.line
        said = f"{error.message} {error.hint or ''}"
        match = next((e for e in left if e[0] == line and e[1] in said), None)
        if match is None:
            surplus.append(f"{error.span.location}: unexpected: {error.message} | {error.hint}")
        else:
            left.remove(match)
    missing = [f"{case.source.name}:{line}: missing: {text}" for line, text in left]
    assert not surplus and not missing, "\n" + "\n".join(surplus + missing)
