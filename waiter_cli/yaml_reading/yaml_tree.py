"""YAML text → a tree of nodes with places; nothing is typed yet. Entry point `compose`.

The tree keeps what the file says: every scalar as its text (`no` is the text "no", `12:30` is
"12:30"), so that whoever reads a node decides what it has to be.  What could surprise or harm is
refused with its place: tags, anchors and aliases, a key given twice, several documents, text that
is too large or nested too deeply.  The parser is fed event by event and never recurses.

>>> document = compose("nodes: [no, on]", "cafe.yaml")
>>> document.root.entries[0][1].items[1].text
'on'
>>> str(document.root.entries[0][1].where)
'cafe.yaml:1:8'
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple, TypeAlias

from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.yaml_reading.yaml_faults import (
    MAX_DEPTH,
    MAX_KEY,
    explain,
    forbidden,
    lines_of,
    place_of,
)

__all__ = [
    "Document",
    "Listing",
    "MAX_CHARACTERS",
    "Mapping",
    "Node",
    "Scalar",
    "Unreadable",
    "compose",
    "node_from_value",
    "one_line",
]

MAX_CHARACTERS = 1 << 20
MAX_NODES = 200_000


class Scalar(NamedTuple):
    """A single value as its text; ``plain`` is false where it stood in quotes or as a block."""

    text: str
    plain: bool
    where: Where

    @property
    def is_nothing(self) -> bool:
        """Returns whether this is YAML's way of leaving a value out."""
        return self.plain and self.text in ("", "~", "null", "Null", "NULL")


class Listing(NamedTuple):
    """A sequence of nodes."""

    items: tuple[Node, ...]
    where: Where


class Mapping(NamedTuple):
    """Keys with their values in the order of the file; no key occurs twice."""

    entries: tuple[tuple[Scalar, Node], ...]
    where: Where


class Unreadable(NamedTuple):
    """Something that was refused; its fault is in the document already."""

    where: Where


Node: TypeAlias = Scalar | Listing | Mapping | Unreadable


class Document(NamedTuple):
    """A file's tree; ``root`` is None where the file says nothing.

    ``faults`` holds what was refused on the way, for the reader to report with its own.
    """

    name: str
    lines: tuple[str, ...]
    root: Node | None
    faults: tuple[Fault, ...]

    def excerpt(self, where: Where | None) -> str | None:
        """Returns the line of the file at that place, None where there is none to show."""
        if where is None or where.name != self.name or not self.lines:
            return None
        index = max(where.line, 1) - 1
        return self.lines[index] if index < len(self.lines) else None


class _Frame:
    """A collection that is being read: what it holds so far, and the key that waits for a value."""

    __slots__ = ("items", "key", "keys", "where")

    def __init__(self, where: Where, is_mapping: bool) -> None:
        self.where = where
        self.items: list[Any] = []
        self.keys: dict[str, Where] | None = {} if is_mapping else None
        self.key: Node | None = None


def compose(text: str, name: str, fixed: Where | None = None) -> Document:
    """Returns the tree of one YAML document, JSON included.

    ``fixed`` is the place given to every node instead of its line and column: a value from the
    command line.  Raises `LayoutError` with one fault where the text is no YAML at all, or larger
    or deeper than `MAX_CHARACTERS` and `MAX_DEPTH`.
    """
    composer = _Composer(text, name, fixed)
    return composer.run()


class _Composer:
    def __init__(self, text: str, name: str, fixed: Where | None) -> None:
        self.text = text.removeprefix("\ufeff")
        self.name = name
        self.fixed = fixed
        self.faults: list[Fault] = []
        self.lines: tuple[str, ...] | None = None
        self.root: Node | None = None
        self.stack: list[_Frame] = []
        self.nodes = 0

    def run(self) -> Document:
        if len(self.text) > MAX_CHARACTERS:
            raise LayoutError(
                [
                    Fault(
                        self.fixed or Where(self.name, 1, 1),
                        f"the text has {len(self.text)} characters, at most {MAX_CHARACTERS} are read",
                        "is this the right file?",
                    )
                ]
            )
        trouble = forbidden(self.text)
        if trouble is not None:
            line, column = place_of(self.text, trouble.at)
            self._stop(self._place(line, column), trouble.message, trouble.hint)
        self._read_events()
        return Document(self.name, self._split(), self.root, tuple(self.faults))

    def _read_events(self) -> None:
        from yaml import YAMLError, events

        documents = 0
        try:
            for event in _events(self.text):
                kind = type(event)
                if kind is events.ScalarEvent:
                    where = self._refuse_extras(event)
                    plain = event.style is None or event.style == ""
                    self._add(Scalar(event.value, plain, where))
                elif kind is events.MappingStartEvent or kind is events.SequenceStartEvent:
                    where = self._refuse_extras(event)
                    if len(self.stack) >= MAX_DEPTH:
                        self._stop(where, f"nested more than {MAX_DEPTH} deep")
                    self.stack.append(_Frame(where, kind is events.MappingStartEvent))
                elif kind is events.MappingEndEvent:
                    frame = self.stack.pop()
                    self._add(Mapping(tuple(frame.items), frame.where))
                elif kind is events.SequenceEndEvent:
                    frame = self.stack.pop()
                    self._add(Listing(tuple(frame.items), frame.where))
                elif kind is events.AliasEvent:
                    where = self._where(event.start_mark)
                    self._fault(
                        where, f"alias *{event.anchor} is not read here", "write the value out"
                    )
                    self._add(Unreadable(where))
                elif kind is events.DocumentStartEvent:
                    documents += 1
                    if documents > 1:
                        where = self._where(event.start_mark)
                        self._fault(where, "a second document begins here", "keep one in a file")
                        return
        except YAMLError as error:
            self._explain(error)

    def _explain(self, error: Any) -> None:
        """Raises the fault at the place where the parser stopped; its words are not used."""
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        begun = getattr(error, "context_mark", None)
        line, column = (mark.line, mark.column) if mark else (0, 0)
        line, column, trouble = explain(self.text, line, column, begun.line if begun else None)
        where = self._place(line, column)
        if self.faults and self.faults[-1].where == where:  # told while it was read
            raise LayoutError(self.faults)
        self._stop(where, trouble.message, trouble.hint)

    def _where(self, mark: Any) -> Where:
        return self._place(mark.line, mark.column)

    def _place(self, line: int, column: int) -> Where:
        return self.fixed or Where(self.name, line + 1, column + 1)

    def _refuse_extras(self, event: Any) -> Where:
        where = self._where(event.start_mark)
        if event.anchor is not None:
            self._fault(where, f"anchor &{event.anchor} is not read here", "leave it out")
        if event.tag is not None:
            self._fault(where, f"tag {event.tag} is not read here", "leave it out")
        return where

    def _add(self, node: Node) -> None:
        self.nodes += 1
        if self.nodes > MAX_NODES:
            self._stop(node.where, f"more than {MAX_NODES} values")
        if not self.stack:
            self.root = node
            return
        frame = self.stack[-1]
        if frame.keys is None:
            frame.items.append(node)
        elif frame.key is None:
            frame.key = self._checked_key(node, frame.keys)
        else:
            if isinstance(frame.key, Scalar):
                frame.items.append((frame.key, node))
            frame.key = None

    def _checked_key(self, node: Node, known: dict[str, Where]) -> Node:
        """Returns the key, or `Unreadable` (its entry is dropped) where it is none
        or was given before.
        """
        if isinstance(node, Scalar) and len(node.text) > MAX_KEY:
            message = f"a name of {len(node.text)} characters, at most {MAX_KEY} are read"
            self._fault(node.where, message, "give it a shorter one")
        elif isinstance(node, Scalar):
            first = known.setdefault(node.text, node.where)
            if first is node.where:
                return node
            place = f" at line {first.line}" if first.line else ""
            self._fault(node.where, f"duplicate key {node.text}", f"it is given already{place}")
        elif not isinstance(node, Unreadable):
            self._fault(node.where, "a key must be a name", "put quotes around braces in text")
        return Unreadable(node.where)

    def _fault(self, where: Where, message: str, hint: str | None = None) -> None:
        lines = self._split()
        index = max(where.line, 1) - 1
        excerpt = lines[index] if index < len(lines) else None
        self.faults.append(Fault(where, one_line(message), hint, excerpt))

    def _stop(self, where: Where, message: str, hint: str | None = None) -> None:
        """Ends the reading: the text cannot be understood from here on."""
        self._fault(where, message, hint)
        raise LayoutError(self.faults)

    def _split(self) -> tuple[str, ...]:
        if self.lines is None:
            self.lines = lines_of(self.text)
        return self.lines


def one_line(text: str, limit: int = 240) -> str:
    """Returns a piece of a file fit for a message: printable, on one line, not too long."""
    shown = "".join(c if c.isprintable() else "?" for c in text[: limit + 1])
    return shown if len(text) <= limit else shown[:limit] + "…"


def _events(text: str) -> Iterator[Any]:
    """Yields the parser's events; by libyaml where PyYAML was built with it (ten times faster)."""
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return yaml.parse(text, Loader=loader)


def node_from_value(value: object, where: Where, depth: int = 0) -> Node:
    """Returns the tree of a value that JSON knows (from a parsed line), every node at ``where``.

    Raises `LayoutError` where it is nested more than `MAX_DEPTH` deep.
    """
    if depth > MAX_DEPTH:
        raise LayoutError([Fault(where, f"nested more than {MAX_DEPTH} deep")])
    match value:
        case dict():
            entries = (
                (Scalar(str(key), False, where), node_from_value(item, where, depth + 1))
                for key, item in value.items()
            )
            return Mapping(tuple(entries), where)
        case list() | tuple():
            items = (node_from_value(item, where, depth + 1) for item in value)
            return Listing(tuple(items), where)
        case str():
            return Scalar(value, False, where)
        case bool():
            return Scalar("true" if value else "false", True, where)
        case None:
            return Scalar("null", True, where)
    return Scalar(str(value), True, where)
