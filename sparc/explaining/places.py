"""A statement as a person finds it: its place, its text, and the sentence above it.

Entry point `place_of`: `Span` → `StatementPlace`.

>>> from sparc.source import Source
>>> source = Source("p.sparc", "rules\\n% Birds\\n% fly.\\nflies(X) :-  % mostly\\n  bird(X).\\n")
>>> place = place_of(Span(source, 22, 54))
>>> place.line, place.text, place.sentence
(4, 'flies(X) :- bird(X).', 'Birds fly.')
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from sparc.source import Span

__all__ = ["StatementPlace", "place_of"]


@dataclass(frozen=True, slots=True)
class StatementPlace:
    """Where a statement stands (1-based), its text on one line, the comment above it or None."""

    file: str
    line: int
    column: int
    text: str
    sentence: str | None

    def __str__(self) -> str:
        return f"{self.file}:{self.line}"


def place_of(span: Span) -> StatementPlace:
    """The place of the statement that ``span`` covers."""
    location = span.location
    return StatementPlace(
        location.name, location.line, location.column, _on_one_line(span.text), _sentence(span)
    )


def _on_one_line(text: str) -> str:
    """The text without comments and line ends; SPARC has no strings in which a ``%`` could stand."""
    return " ".join(word for line in text.split("\n") for word in line.partition("%")[0].split())


def _sentence(span: Span) -> str | None:
    """The comment that stands directly above the statement, or above the group it stands in.

    A group are lines without an empty line or a comment of their own between them.
    """
    source = span.source
    lines = source.text.split("\n")
    at = source.line_index(span.start) - 1
    while at >= 0 and _is_statement(lines[at]):
        at -= 1
    words: list[str] = []
    while at >= 0 and lines[at].lstrip().startswith("%"):
        said = lines[at].strip().lstrip("%").strip()
        if said.startswith("--") or lines[at].lstrip().startswith(("%{", "%}", "%?", "%.")):
            break
        words.append(said)
        at -= 1
    return " ".join(" ".join(reversed(words)).split()) or None


def _is_statement(line: str) -> bool:
    bare = line.strip()
    words = bare.partition("%")[0].split()
    return bool(words) and words[0] not in ("sorts", "predicates", "rules", "display")
