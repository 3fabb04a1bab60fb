"""Nodes of a YAML tree → typed values, every fault collected with its place. Entry point `NodeReader`.

Each method takes a node and says in ``what`` how the value is called in messages ("capacity of
table1").  It returns the value, or None after noting a fault; so a file is read to its end and
all that is wrong with it is reported at once, by `NodeReader.finish`.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from sparc.numerals import decimal
from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.model.wording import counted
from waiter_cli.spelling import did_you_mean, suggest
from waiter_cli.yaml_reading.yaml_tree import (
    Document,
    Listing,
    Mapping,
    Node,
    Scalar,
    Unreadable,
    one_line,
)

__all__ = [
    "NAME_RULE",
    "POINT_FORM",
    "RESERVED",
    "NodeReader",
    "describe",
    "is_empty",
    "is_identifier",
]

NAME_RULE = "names begin with a small letter and go on with letters, digits and _"
RESERVED = frozenset({"or", "and", "not", "agent"})
_MAX_FAULTS = 200
MAX_METRES = 10_000_000
"""UTM coordinates, in metres too, have northings up to 10,000,000."""
POINT_FORM = "write two numbers in brackets, such as [1.5, 2]"
_TRUE = frozenset({"true", "yes", "on"})
_FALSE = frozenset({"false", "no", "off"})


def is_identifier(text: str) -> bool:
    """Returns whether a name has the form ``[a-z][A-Za-z0-9_]*``.

    >>> [is_identifier(name) for name in ("n0_1", "a", "N1", "table 1", "1a", "")]
    [True, True, False, False, False, False]
    """
    return text.isascii() and text[:1].isalpha() and text[0].islower() and _letters(text).isalnum()


def _letters(text: str) -> str:
    return text.replace("_", "a")


class NodeReader:
    """Reads the nodes of one document and keeps its faults."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.faults: list[Fault] = list(document.faults)

    def fault(self, where: Where, message: str, hint: str | None = None) -> None:
        """Adds a fault; ``hint`` is the mend."""
        self.faults.append(Fault(where, one_line(message), hint, self.document.excerpt(where)))

    def finish(self) -> None:
        """Raises `LayoutError` with every fault in the order of the file, if there is one."""
        if not self.faults:
            return
        faults = sorted(
            dict.fromkeys(self.faults),
            key=lambda fault: (fault.where or Where(""), fault.message),
        )
        if len(faults) > _MAX_FAULTS:
            rest = len(faults) - _MAX_FAULTS
            faults = [*faults[:_MAX_FAULTS], Fault(None, f"and {rest} more faults")]
        raise LayoutError(faults)

    def hint(self, name: str, known: Iterable[str], kind: str = "") -> str | None:
        """Returns `did_you_mean`, or None once there are so many faults that nobody reads it."""
        return did_you_mean(name, known, kind) if len(self.faults) < _MAX_FAULTS else None

    # -- what a node is ---------------------------------------------------------------------

    def wrong(self, node: Node, what: str, expected: str, hint: str | None = None) -> None:
        """Adds the fault that a node is not of the type that is expected."""
        if not isinstance(node, Unreadable):
            said = f"{what} must be {expected}, found {describe(node)}"
            self.fault(node.where, said, hint)

    def mapping(
        self, node: Node, what: str, keys: Sequence[str] | None = None
    ) -> dict[str, Node] | None:
        """Returns the values by key.  With ``keys``, others are faults; an empty value has no keys."""
        entries = self.entries(node, what)
        if entries is None:
            return None
        if keys is None:
            return {key.text: value for key, value in entries}
        out: dict[str, Node] = {}
        for key, value in entries:
            if key.text in keys:
                out[key.text] = value
            else:
                self.unknown_key(key, what, keys)
        return out

    def unknown_key(self, key: Scalar, what: str, keys: Sequence[str]) -> None:
        """Adds the fault that a key means nothing here."""
        hint = self.hint(key.text, keys)
        if key.text == "<<":
            hint = "keys are not merged here; write them out"
        self.fault(key.where, f"unknown key {_short(key.text)} in {what}", hint)

    def lacks(self, node: Node, key: str, keys: Sequence[str]) -> bool:
        """Returns whether a mapping is without a key, misspelt ones (their fault is
        noted) not counted.  Nor does what is no mapping, which is a fault already.
        """
        if not isinstance(node, Mapping) and not (isinstance(node, Scalar) and node.is_nothing):
            return False
        entries = node.entries if isinstance(node, Mapping) else ()
        given = [name.text for name, _ in entries]
        if key in given:
            return False
        return len(self.faults) >= _MAX_FAULTS or not any(
            suggest(name, keys) == key for name in given if name not in keys
        )

    def entries(self, node: Node, what: str) -> tuple[tuple[Scalar, Node], ...] | None:
        """Returns the keys with their places, and the values, in the order of the file."""
        if isinstance(node, Mapping):
            return node.entries
        if isinstance(node, Scalar) and node.is_nothing:
            return ()
        self.wrong(node, what, "a mapping (key: value)", _as_mapping(node))
        return None

    def items(self, node: Node, what: str, hint: str | None = None) -> tuple[Node, ...] | None:
        """Returns the items of a list; an empty value has none."""
        if isinstance(node, Listing):
            return node.items
        if isinstance(node, Scalar) and node.is_nothing:
            return ()
        if hint is None and isinstance(node, Scalar) and is_identifier(node.text):
            hint = f"write [{node.text}]"
        self.wrong(node, what, "a list", hint or "write [one, another], or a line with - for each")
        return None

    # -- scalars ----------------------------------------------------------------------------

    def text(self, node: Node, what: str) -> str | None:
        """Returns a text that is not empty and holds no line end."""
        if isinstance(node, Scalar) and node.text.strip() and node.text.isprintable():
            return node.text
        self.wrong(node, what, "a text on one line")
        return None

    def name(self, node: Node, what: str) -> str | None:
        """Returns a legal name: an identifier that is not reserved."""
        if not isinstance(node, Scalar) or not node.text:
            self.wrong(node, what, "a name")
            return None
        name = node.text
        if not is_identifier(name):
            self.fault(node.where, f"{_short(name)} is no name for {what}", _name_hint(name))
            return None
        if name in RESERVED:
            self.fault(node.where, f"{name} is a reserved word, no name for {what}", "rename it")
            return None
        return name

    def known(self, node: Node, what: str, kind: str, names: Collection[str]) -> str | None:
        """Returns a name of that ``kind`` ("node") that is one of ``names``."""
        if not isinstance(node, Scalar) or not node.text:
            form = "write one name, without brackets" if isinstance(node, Listing) else None
            self.wrong(node, what, f"the name of a {kind}", form)
            return None
        if node.text in names:
            return node.text
        hint = self.hint(node.text, names, kind)
        self.fault(node.where, f"unknown {kind} {_short(node.text)}", hint)
        return None

    def integer(self, node: Node, what: str, least: int, most: int) -> int | None:
        """Returns a whole number from ``least`` to ``most``."""
        expected = f"a whole number from {least} to {most}"
        if isinstance(node, Scalar) and node.plain and _is_digits(node.text.lstrip("+-")):
            digits = node.text.lstrip("+-")
            if len(node.text) - len(digits) <= 1 and len(digits) <= 18:
                value = int(node.text)
                if least <= value <= most:
                    return value
            found = _short(node.text)
            self.fault(node.where, f"{what} must be {expected}, found {found}", "choose another")
            return None
        self.wrong(node, what, expected, "write digits alone, such as 4")
        return None

    def number(self, node: Node, what: str, least: float = -MAX_METRES) -> float | None:
        """Returns a finite number from ``least`` up; sizes and places are in metres."""
        if isinstance(node, Scalar) and node.plain:
            value = decimal(node.text)
            if value is not None and least <= value <= MAX_METRES:
                return value
            if value is not None and value > least:
                self.wrong(node, what, f"at most {MAX_METRES}", "in metres, this is the limit")
                return None
            if value is not None and least == -MAX_METRES:
                self.wrong(node, what, f"at least {-MAX_METRES}", "in metres, this is the limit")
                return None
        low = f" from {least:g}" if least > -MAX_METRES else ""
        form = "write a number without quotes, such as 2.5"
        self.wrong(node, what, f"a finite number{low}", form)
        return None

    def boolean(self, node: Node, what: str) -> bool | None:
        """Returns a truth value."""
        if isinstance(node, Scalar) and node.plain:
            word = node.text.lower()
            if word in _TRUE or word in _FALSE:
                return word in _TRUE
        self.wrong(node, what, "true or false")
        return None

    # -- small collections ------------------------------------------------------------------

    def point(
        self, node: Node, what: str, expected: str = "a place [x, y] in metres"
    ) -> tuple[float, float] | None:
        """Returns a place, or two lengths: ``[x, y]`` in metres."""
        items = node.items if isinstance(node, Listing) else ()
        if len(items) != 2:
            self.wrong(node, what, expected, POINT_FORM)
            return None
        x = self.number(items[0], f"x of {what}")
        y = self.number(items[1], f"y of {what}")
        return None if x is None or y is None else (x, y)

    def known_names(
        self, node: Node, what: str, kind: str, names: Collection[str]
    ) -> tuple[tuple[str, Where], ...]:
        """Returns a list of names that exist, each once, with their places.

        What is wrong is left out.
        """
        places: dict[str, Where] = {}
        for item in self.items(node, what) or ():
            name = self.known(item, what, kind, names)
            if name is None:
                continue
            if name in places:
                self.fault(item.where, f"{what}: {name} is listed twice", "leave one out")
            else:
                places[name] = item.where
        return tuple(places.items())


def _as_mapping(node: Node) -> str:
    """Returns how a mapping is written; what is nearly one already is written out."""
    key, colon, value = node.text.partition(":") if isinstance(node, Scalar) else ("", "", "")
    if colon and is_identifier(key) and value:
        return f"put a blank after the colon: {_short(f'{key}: {value}')}"
    return "write key: value"


def is_empty(node: Node) -> bool:
    """Returns whether a node is an empty list or mapping, or nothing at all."""
    match node:
        case Listing(items=items):
            return not items
        case Mapping(entries=entries):
            return not entries
    return isinstance(node, Scalar) and node.is_nothing


def describe(node: Node) -> str:
    """Returns a node's kind in the words of messages."""
    match node:
        case Listing():
            items = counted(len(node.items), "item")
            return f"a list of {items}" if node.items else "an empty list"
        case Mapping():
            return "a mapping" if node.entries else "an empty mapping"
        case Scalar() if node.is_nothing:
            return "nothing"
        case Scalar(text=text, plain=plain):
            return _short(text) if plain else f'the text "{_short(text)}"'
    return "something unreadable"


def _short(text: str) -> str:
    return one_line(text, 40)


def _name_hint(name: str) -> str:
    mended = "".join(c if c.isascii() and _letters(c).isalnum() else "_" for c in name[:40])
    mended = mended.strip("_")
    mended = mended[:1].lower() + mended[1:]
    if is_identifier(mended) and mended not in RESERVED:
        return f"{NAME_RULE}: {mended}"
    return NAME_RULE


def _is_digits(text: str) -> bool:
    return text.isascii() and text.isdigit()
