"""Faulty files whose faults are marked in place.

A file of cases holds small YAML texts, each under a line ``### title``.  A line with a fault ends
in ``#! words``, where the words occur in the fault's text (message and hint); several faults of one
line are several marks.  `differences` compares marks with the faults that were reported: a fault
that is missing and one that is not marked both count.  Keys that a case does not have are added
below it from a set of good ones, unless it has a line ``#- key``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from tests.support.paths import ROOT
from waiter_cli.errors import Fault

CASES = ROOT / "tests" / "waiter_cli" / "cases"


@dataclass(frozen=True)
class Case:
    """A text under its title."""

    title: str
    text: str

    def marks(self) -> list[tuple[int, str]]:
        """Line and words of every mark."""
        found = []
        for number, line in enumerate(self.text.split("\n"), start=1):
            for words in line.split("#!")[1:]:
                found.append((number, words.strip()))
        return found


def read_cases(file: str, good: Mapping[str, str]) -> list[Case]:
    """The cases of a file, completed with the good keys that they leave out."""
    found = []
    for block in (CASES / file).read_text(encoding="utf-8").split("### ")[1:]:
        title, _, body = block.partition("\n")
        lines = body.rstrip("\n").split("\n")
        given = {line.split(":")[0].strip("\"'") for line in lines}
        given |= {line.removeprefix("#- ") for line in lines if line.startswith("#- ")}
        lines += [text for key, text in good.items() if key not in given]
        found.append(Case(title.strip(), "\n".join(lines) + "\n"))
    return found


def differences(case: Case, faults: Iterable[Fault]) -> list[str]:
    """What was marked and not reported, and what was reported and not marked."""
    open_marks = case.marks()
    out = []
    for fault in faults:
        line = fault.where.line if fault.where else 0
        match = next((m for m in open_marks if m[0] == line and m[1] in str(fault)), None)
        if match is None:
            out.append(f"not marked: {fault}")
        else:
            open_marks.remove(match)
    return out + [f"not reported: line {line}: {words}" for line, words in open_marks]
