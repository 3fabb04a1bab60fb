"""Text with an address: the place of each character in the file that a person edits.

A :class:`Source` is a program's text together with, for every line, the file and line it came
from.  Programs that were put together from a template and a layout keep pointing at those files.
A :class:`Span` is a stretch of a source; a :class:`Location` is what an error message prints.

>>> source = Source("blocks.sparc", "sorts\\n#s = {a}.\\n")
>>> str(source.location(6))
'blocks.sparc:2:1'
"""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property

from sparc.lazy_dataclass import dataclass, field

__all__ = ["Location", "Origin", "Source", "Span"]


@dataclass(frozen=True)
class Location:
    """A place in a file; lines and columns count from 1, columns in characters."""

    name: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.name}:{self.line}:{self.column}"


@dataclass(frozen=True)
class Origin:
    """The origin of one line of a generated program.

    ``text`` is that line as the file has it and ``column`` the place in it (1-based).  A line
    copied from a template unchanged has ``verbatim`` set: its columns are the file's columns.
    """

    name: str
    line: int
    column: int = 1
    text: str = ""
    verbatim: bool = False


@dataclass(frozen=True)
class Source:
    """A program's text under a name; ``first_line`` is the number of its first line.

    ``origins`` is empty, or has one entry for each line of ``text`` (None: the line is our own).
    """

    name: str
    text: str
    first_line: int = 1
    origins: tuple[Origin | None, ...] = field(default=(), compare=False, repr=False)

    @cached_property
    def line_starts(self) -> tuple[int, ...]:
        """Returns the offset at which each line starts."""
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return tuple(starts)

    def line_index(self, offset: int) -> int:
        """Returns the index (from 0) of the line that holds the character at ``offset``."""
        return bisect_right(self.line_starts, offset) - 1

    def origin(self, offset: int) -> Origin | None:
        """Returns the origin of the line of ``offset``, None when it is this source's own."""
        index = self.line_index(offset)
        return self.origins[index] if index < len(self.origins) else None

    def location(self, offset: int) -> Location:
        """Returns the place a person can edit that the character at ``offset`` came from."""
        index = self.line_index(offset)
        column = offset - self.line_starts[index] + 1
        origin = self.origins[index] if index < len(self.origins) else None
        if origin is None:
            return Location(self.name, self.first_line + index, column)
        return Location(origin.name, origin.line, column if origin.verbatim else origin.column)

    def line_text(self, offset: int) -> str:
        """Returns the line of ``offset`` as this source has it, without its line end."""
        index = self.line_index(offset)
        starts = self.line_starts
        end = starts[index + 1] - 1 if index + 1 < len(starts) else len(self.text)
        return self.text[starts[index] : end].rstrip("\r")


@dataclass(frozen=True)
class Span:
    """The stretch ``[start, end)`` of a source."""

    source: Source = field(repr=False)
    start: int
    end: int

    @property
    def location(self) -> Location:
        """Returns the place of the first character, in the file a person edits."""
        return self.source.location(self.start)

    @property
    def text(self) -> str:
        """Returns the characters covered."""
        return self.source.text[self.start : self.end]

    def to(self, other: Span) -> Span:
        """Returns the span from the start of this one to the end of ``other``."""
        return Span(self.source, self.start, other.end)
