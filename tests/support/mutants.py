"""A domain with one statement, or one condition of one, deleted: what its cases must notice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from sparc.source import Source, Span
from sparc.syntax.parser import parse
from sparc.syntax.tree import Rule, Statement

__all__ = ["Mutant", "mutants", "weakened"]


@dataclass(frozen=True)
class Mutant:
    """A template without one of its statements, or without one of its conditions."""

    line: int
    deleted: str
    template: Source

    def __str__(self) -> str:
        return f"{self.line}: {self.deleted}"


def mutants(template: Source) -> list[Mutant]:
    """One mutant for each statement outside the slots, in order; lines keep their numbers."""
    return [_without(template, statement.span, "") for statement in _statements(template)]


def weakened(template: Source) -> list[Mutant]:
    """One mutant for each condition of a statement, in order; some are no SPARC any more."""
    found = []
    for statement in _statements(template):
        if not isinstance(statement, Rule) or len(statement.body) < 2:
            continue
        head = statement.span.text.split(":-")[0]
        for dropped in statement.body:
            kept = [item.span.text for item in statement.body if item is not dropped]
            mutant = _without(template, statement.span, f"{head}:- {', '.join(kept)}.")
            found.append(replace(mutant, deleted=f"{dropped.span.text} of {mutant.deleted}"))
    return found


def _statements(template: Source) -> Iterator[Statement]:
    slots: set[int] = set()
    inside = False
    for number, line in enumerate(template.text.split("\n"), 1):
        inside = inside or line.strip().startswith("%{")
        if inside:
            slots.add(number)
        inside = inside and line.strip() != "%}"
    for statement in parse(template).statements:
        if statement.span.location.line not in slots:
            yield statement


def _without(template: Source, span: Span, instead: str) -> Mutant:
    """The template with other text, or none, in the place of a statement."""
    text = template.text
    assert span.text.endswith("."), span.text
    ends = "\n" * (span.text.count("\n") - instead.count("\n"))
    changed = text[: span.start] + instead + ends + text[span.end :]
    deleted = " ".join(span.text.split())
    return Mutant(span.location.line, deleted, Source(template.name, changed))
