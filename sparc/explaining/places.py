"""A statement as a person finds it: its place, its text, and the sentence above it.

Entry point `place_of`: `Span` → `StatementPlace`.

>>> from sparc.source import Source
>>> source = Source("p.sparc", "rules\\n% Birds\\n% fly.\\nflies(X) :-  % mostly\\n  bird(X).\\n")
>>> place = place_of(Span(source, 22, 54))
>>> place.line, place.text, place.sentence
(4, 'flies(X) :- bird(X).', 'Birds fly.')
"""

from __future__ import annotations

import re

from sparc.lazy_dataclass import dataclass
from sparc.source import Span

__all__ = ["StatementPlace", "place_of"]


@dataclass(frozen=True)
class StatementPlace:
    """The place of a statement (1-based), its text on one line, the comment above it or None."""

    file: str
    line: int
    column: int
    text: str
    sentence: str | None

    def __str__(self) -> str:
        return f"{self.file}:{self.line}"

    def as_dict(self) -> dict[str, str | int]:
        """Returns the place and the text, as JSON has them; the sentence is apart."""
        return {"file": self.file, "line": self.line, "column": self.column, "text": self.text}


def place_of(span: Span) -> StatementPlace:
    """Returns the place of the statement that ``span`` covers."""
    location = span.location
    return StatementPlace(
        location.name, location.line, location.column, _on_one_line(span.text), _sentence(span)
    )


def _on_one_line(text: str) -> str:
    """Returns the text without comments and line ends.

    SPARC has no strings in which a ``%`` could stand.
    """
    return " ".join(word for line in text.split("\n") for word in line.partition("%")[0].split())


def _sentence(span: Span) -> str | None:
    """Returns the comment that stands directly above the statement, or above its group.

    A group are lines that begin alike, such as the rules of one predicate, with nothing between them.
    """
    source = span.source
    lines = source.text.split("\n")
    at = source.line_index(span.start) - 1
    opening = _OPENING.match(span.text)
    while at >= 0 and opening is not None:
        above = _OPENING.match(lines[at])
        if above is None or above[1] != opening[1]:
            break
        at -= 1
    words: list[str] = []
    while at >= 0 and lines[at].lstrip().startswith("%"):
        said = lines[at].strip().lstrip("%").strip()
        if said.startswith("--") or lines[at].lstrip().startswith(("%{", "%}", "%?", "%.")):
            break
        words.append(said)
        at -= 1
    return " ".join(" ".join(reversed(words)).split()) or None


_OPENING = re.compile(r"\s*-?([a-z]\w*|:-)")
