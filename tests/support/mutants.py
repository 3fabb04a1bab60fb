"""A domain with one statement deleted, for each of its statements: what its cases must notice."""

from __future__ import annotations

from dataclasses import dataclass

from sparc.parser import parse
from sparc.source import Source

__all__ = ["Mutant", "mutants"]


@dataclass(frozen=True)
class Mutant:
    """A template without one of its statements."""

    line: int
    deleted: str
    template: Source

    def __str__(self) -> str:
        return f"{self.line}: {self.deleted}"


def mutants(template: Source) -> list[Mutant]:
    """One mutant for each statement outside the slots, in order; lines keep their numbers."""
    slots: set[int] = set()
    inside = False
    for number, line in enumerate(template.text.split("\n"), 1):
        inside = inside or line.strip().startswith("%{")
        if inside:
            slots.add(number)
        inside = inside and line.strip() != "%}"
    found = []
    text = template.text
    for statement in parse(template).statements:
        span = statement.span
        if span.location.line in slots:
            continue
        blank = "".join("\n" if character == "\n" else " " for character in span.text)
        assert span.text.endswith("."), span.text
        without = Source(template.name, text[: span.start] + blank + text[span.end :])
        found.append(Mutant(span.location.line, " ".join(span.text.split()), without))
    return found
