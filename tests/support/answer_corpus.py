"""Small programs in files, each with its answer sets.

A file holds programs parted by lines ``%---``.  The first line of each is its title; a line
``%= {p(a), -q}`` is an answer set, ``%= inconsistent`` says that there is none, and ``%~ …`` that
sparc.jar gives something else, and why.
"""

from __future__ import annotations

from dataclasses import dataclass

import pytest

import sparc
from sparc.source import Source
from tests.support.paths import ROOT

__all__ = ["Example", "answer_sets", "as_text", "examples", "parameters"]

FOLDER = ROOT / "tests" / "sparc" / "answers"


@dataclass(frozen=True)
class Example:
    """One program; ``expected`` are its answer sets as text, sorted."""

    title: str
    source: Source
    expected: tuple[str, ...]
    jar_differs: str | None


def examples() -> list[Example]:
    """All programs of the corpus, in the order of the files."""
    found = []
    for path in sorted(FOLDER.glob("*.sparc")):
        line = 1
        for block in path.read_text(encoding="utf-8").split("%---\n"):
            lines = block.splitlines()
            expected = [text[3:] for text in lines if text.startswith("%= ")]
            notes = [text[3:] for text in lines if text.startswith("%~ ")]
            found.append(
                Example(
                    f"{path.stem}: {lines[0][2:]}",
                    Source(path.name, block, line),
                    () if expected == ["inconsistent"] else tuple(sorted(expected)),
                    notes[0] if notes else None,
                )
            )
            line += len(lines) + 1
    return found


def parameters() -> list[object]:
    """The corpus as parameters with readable ids."""
    return [pytest.param(example, id=example.title) for example in examples()]


def as_text(answer_set: sparc.AnswerSet) -> str:
    """An answer set as the corpus writes it."""
    return "{" + ", ".join(sorted(map(str, answer_set.literals))) + "}"


def answer_sets(program: Source | str, **options: object) -> tuple[str, ...]:
    """All answer sets of a program as text, sorted."""
    return tuple(sorted(map(as_text, sparc.solve(program, **options))))  # type: ignore[arg-type]
