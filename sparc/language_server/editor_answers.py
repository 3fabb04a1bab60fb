"""Answers an editor about a place: hover, completion, symbols, renaming, fixes. No protocol here.

Each function takes a `Document` and offsets into its text, and returns plain values.
"""

from __future__ import annotations

from itertools import islice
from typing import NamedTuple

from sparc.language_server.argument_sorts import sort_at
from sparc.language_server.document import Document, Finding
from sparc.language_server.symbols import WORDS_WITH_HASH, Occurrence
from sparc.sorts.extents import Sort
from sparc.sorts.values import text as value_text
from sparc.spelling import nearest
from sparc.syntax.lexer import SECTION_WORDS

__all__ = [
    "TOKEN_KINDS",
    "Fix",
    "Proposal",
    "complete",
    "declared",
    "fixes",
    "hover",
    "marked",
    "refusal_of_name",
]

SHOWN_ELEMENTS = 12
MOST_VALUES = 200
TOKEN_KINDS = ("sort", "predicate", "constant", "variable", "label", "value")

# What people write who know another language, and what SPARC has for it.
_FOREIGN = {
    "<-": ":-", "<=": ":-", ":=": ":-", "\u2190": ":-", ": -": ":-", "is": "=",
    ":\u2013": ":-", ":\u2014": ":-", ":\u2212": ":-",
    "\\+": "not", "\\=": "!=", "\u2260": "!=", "\u2264": "<=", "\u2265": ">=", "&": ",",
    "&&": ",", "\u2227": ",", "\u2228": "|", "\u2013": "-", "\u2014": "-", "\u2212": "-",
    "\u00d7": "*", "\u2026": "..",
}  # fmt: skip
_FOREIGN_PAIRS = {"=<": "<=", "=>": ">=", "<>": "!="}
"""Comparisons of other languages, at whose second sign the fault is found."""


class Proposal(NamedTuple):
    """Something that can be written at a place; ``kind`` as of an `Occurrence`, or ``keyword``."""

    text: str
    kind: str
    detail: str


class Fix(NamedTuple):
    """A change that mends a fault: ``new`` in place of the stretch of the text."""

    title: str
    start: int
    end: int
    new: str


def hover(document: Document, offset: int) -> str | None:
    """Returns the meaning of a name, in Markdown; None where no name stands."""
    one = document.at(offset)
    if one is None:
        return None
    place = document.definition(one)
    sentence = document.sentence(place.start) if place is not None and place.defines else None
    meaning = _meaning(document, one)
    parts = [f"```sparc\n{meaning}\n```" if meaning else "", sentence or ""]
    return "\n\n".join(part for part in parts if part) or None


def _meaning(document: Document, one: Occurrence) -> str | None:
    declared = document.declared
    if one.kind == "sort" and one.name in declared.sorts:
        return f"#{one.name} = {_extent(declared.sorts[one.name])}"
    if one.kind == "predicate" and one.name in declared.predicates:
        return f"{declared.predicates[one.name]}."
    if one.kind == "constant" and one.name in declared.constants:
        return f"#const {one.name} = {declared.constants[one.name]}."
    if one.kind == "variable":
        sorts = _sorts_of(document, one)
        return f"{one.name} : {' * '.join(f'#{sort}' for sort in sorts)}" if sorts else None
    if one.kind == "value":
        homes = [name for name, sort in declared.sorts.items() if one.name in sort.extent]
        return f"{one.name} in {', '.join(f'#{name}' for name in homes[:6])}" if homes else None
    return None


def _extent(sort: Sort) -> str:
    """Returns the first elements of a sort, and how many there are."""
    first = [value_text(value) for value in islice(iter(sort.extent), SHOWN_ELEMENTS + 1)]
    if len(first) <= SHOWN_ELEMENTS:
        return "{" + ", ".join(first) + "}"
    return "{" + ", ".join(first[:SHOWN_ELEMENTS]) + f", …}}  % {sort.bound():,} at most"


def _sorts_of(document: Document, one: Occurrence) -> list[str]:
    """Returns the sorts of the arguments in which a variable stands by itself, each once."""
    sorts: dict[str, None] = {}
    for each in document.same(one):
        alone = document.text[each.end :].lstrip()[:1] in (",", ")")
        sort = sort_at(document, each.start) if alone else None
        if sort is not None:
            sorts[sort.name] = None
    return list(sorts)


def complete(document: Document, offset: int) -> tuple[Proposal, ...]:
    """Returns completions at an offset, the nearest things first."""
    line = document.text[document.text.rfind("\n", 0, offset) + 1 : offset]
    if "%" in line:
        return ()
    start = offset
    while start > 0 and (document.text[start - 1].isalnum() or document.text[start - 1] in "_#"):
        start -= 1
    word = document.text[start:offset]
    if word.startswith("#"):
        return tuple(each for each in _hashed(document) if each.text.startswith(word))
    proposals = [*_values(document, start), *_predicates(document), *_variables(document, start)]
    proposals += [Proposal(word, "keyword", "") for word in ("not", *SECTION_WORDS)]
    each_once = {each.text: each for each in reversed(proposals)}
    return tuple(each for each in reversed(each_once.values()) if each.text.startswith(word))


def _hashed(document: Document) -> list[Proposal]:
    sorts = dict.fromkeys(each.name for each in document.names if each.kind == "sort")
    known = document.declared.sorts
    detail = {name: _extent(known[name]) for name in sorts if name in known}
    proposals = [Proposal(f"#{name}", "sort", detail.get(name, "")) for name in sorts]
    return proposals + [Proposal(f"#{word}", "keyword", "") for word in WORDS_WITH_HASH]


def _values(document: Document, offset: int) -> list[Proposal]:
    """Returns the elements of the sort of the argument that is being written."""
    sort = sort_at(document, offset)
    if sort is None:
        return []
    values = islice(iter(sort.extent), MOST_VALUES)
    return [Proposal(value_text(value), "value", f"#{sort.name}") for value in values]


def _predicates(document: Document) -> list[Proposal]:
    names = dict.fromkeys(
        each.name for each in document.names if each.kind == "predicate" and each.defines
    )
    known = document.declared.predicates
    return [Proposal(name, "predicate", str(known.get(name, ""))) for name in names]


def _variables(document: Document, offset: int) -> list[Proposal]:
    here = next((e.statement for e in reversed(document.names) if e.start < offset), -1)
    names = {
        each.name: None
        for each in document.names
        if each.kind == "variable" and each.statement == here and each.end < offset
    }
    return [Proposal(name, "variable", "") for name in names]


def declared(document: Document) -> tuple[Occurrence, ...]:
    """Returns the declarations of the program: constants, sorts, predicates and labels."""
    return tuple(each for each in document.names if each.defines)


def marked(document: Document) -> tuple[Occurrence, ...]:
    """Returns the names to be coloured, in the order of the text."""
    return document.names


def refusal_of_name(document: Document, one: Occurrence, name: str) -> str | None:
    """Returns why a thing cannot be called ``name``; None where it can.

    It must be the same kind of word, no reserved one, and the name of nothing else of its kind.
    """
    upper = one.kind == "variable"
    plain = name.isascii() and name.replace("_", "a").isalnum()
    if not plain or not (name[0].isupper() if upper else name[0].islower()):
        return (
            f"{name} is no name of a {one.kind}: letters, digits and _, from"
            f" {'a capital' if upper else 'a small'} letter on"
        )
    reserved = ("not", "and", "or", *SECTION_WORDS)
    if name in reserved or (one.kind == "sort" and name in WORDS_WITH_HASH):
        return f"{name} is a word of the language: take another name"
    if name != one.name and document.has(one, name):
        where = " in this rule" if upper else ""
        return f"there is a {one.kind} {name}{where} already, and the two would become one: take another name"
    return None


def fixes(document: Document, finding: Finding) -> tuple[Fix, ...]:
    """Returns the changes that mend a fault: a sign of another language, a name that is misspelt."""
    if finding.edit is not None:
        start, end, new = finding.edit
        verb = "Write" if end > start else "Insert"
        return (Fix(f"{verb} {new.strip()}", start, end, new),)
    written = document.text[finding.start : finding.end]
    if finding.severity == "error" and written in _FOREIGN:
        new = _FOREIGN[written]
        return (Fix(f"Write {new}", finding.start, finding.end, new),)
    pair = document.text[max(0, finding.start - 1) : finding.end]
    if finding.severity == "error" and pair in _FOREIGN_PAIRS:
        new = _FOREIGN_PAIRS[pair]
        return (Fix(f"Write {new}", finding.start - 1, finding.end, new),)
    one = next(
        (e for e in document.names if finding.start <= e.start and e.end <= finding.end), None
    )
    if one is None or finding.severity == "warning":
        return ()
    known = {each.name for each in document.names if each.kind == one.kind and each.defines}
    if one.kind not in ("sort", "predicate") or one.name in known:
        return ()
    near = nearest(one.name, sorted(known))
    return (Fix(f"Write {near}", one.start, one.end, near),) if near is not None else ()
