"""Terms of a domain of one's own, in scenarios, goals and lines: YAML nodes → canonical text.

Entry points `read_term`, `read_terms`, `read_facts`, `whole_terms`.  Only their form is looked at
here: whether a domain has such a fluent is asked where it is known (`waiter_cli.encoding.own_words`).
"""

from __future__ import annotations

import re

from waiter_cli.errors import Where
from waiter_cli.model.state import Fact
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Listing, Mapping, Node, Scalar

__all__ = ["OWN_GOALS", "plain_term", "read_facts", "read_term", "read_terms", "whole_terms"]

OWN_GOALS = ("holds", "holds_not")
_KEYS = (*OWN_GOALS, "obs")
_TOKEN = r"\s*([a-z][A-Za-z0-9_]*|0|[1-9][0-9]*|[(),])"
_LONGEST = 400
_DEEPEST = 12


def read_term(reader: NodeReader, node: Node, what: str, example: str) -> str | None:
    """Returns a ground term without white space, such as ``on(b1,b2)``; None after noting a fault."""
    if not isinstance(node, Scalar) or node.is_nothing:
        reader.wrong(node, what, "a term of SPARC", f"for example: {example}")
        return None
    term = plain_term(node.text)
    if term is None:
        hint = f"for example: {example}; no variables, no blanks in names"
        if _depth(node.text) > 0:
            hint = f"a bracket stays open; put the term in quotes: '{example}'"
        reader.fault(node.where, f"{node.text[:60]} is no term for {what}", hint)
    return term


def plain_term(text: str) -> str | None:
    """Returns a ground term without white space; None where the text is none.

    >>> plain_term(" on( b1, n(2) ) "), plain_term("on(B)"), plain_term("on(b1")
    ('on(b1,n(2))', None, None)
    """
    if len(text) > _LONGEST:
        return None
    tokens = re.findall(_TOKEN, text)
    joined = "".join(tokens)
    if joined != "".join(text.split()) or re.search(r"[A-Za-z0-9_]\s+[A-Za-z0-9_]", text.strip()):
        return None
    end = _term(tokens, 0, 0)
    named = bool(tokens) and tokens[0][0].isalpha()
    return joined if named and end == len(tokens) else None


def _term(tokens: list[str], at: int, depth: int) -> int:
    """Returns the index behind the term that begins at a token; -1 where none does."""
    if at >= len(tokens) or tokens[at] in "()," or depth > _DEEPEST:
        return -1
    name, at = tokens[at], at + 1
    if not name[0].isalpha() or at >= len(tokens) or tokens[at] != "(":
        return at
    while tokens[at] in "(,":
        at = _term(tokens, at + 1, depth + 1)
        if not 0 <= at < len(tokens):
            return -1
    return at + 1 if tokens[at] == ")" else -1


def read_terms(
    reader: NodeReader, node: Node, what: str, example: str
) -> tuple[tuple[str, Where], ...]:
    """Returns the terms of a list, each once, with their places."""
    terms: dict[str, Where] = {}
    for item in _pieces(reader, node, what, f"write [{example}]"):
        term = read_term(reader, item, what, example)
        if term in terms:
            reader.fault(item.where, f"{what}: {term} is listed twice", "leave one out")
        elif term is not None:
            terms[term] = item.where
    return tuple(terms.items())


def read_facts(reader: NodeReader, node: Node) -> tuple[Fact, ...]:
    """Returns literals of SPARC that are facts of the program."""
    facts: list[Fact] = []
    example = "holds(isdirty(table1), 0)"
    for item in _pieces(reader, node, "facts", f"write ['{example}']"):
        if not isinstance(item, Scalar) or item.is_nothing:
            reader.wrong(item, "a fact", "a literal of SPARC", f"for example: '{example}'")
            continue
        text = item.text.strip().removesuffix(".").strip()
        sign = "-" if text.startswith("-") else ""
        term = plain_term(text.removeprefix("-").strip())
        if term is None:
            hint = f"for example: '{example}'; rules belong into the domain"
            reader.fault(item.where, f"{item.text[:60]} is no fact", hint)
        else:
            facts.append(Fact(sign + term, item.where))
    return tuple(dict.fromkeys(facts))


def whole_terms(node: Mapping) -> Mapping:
    """Returns a mapping whose terms are whole: YAML cuts ``{holds: on(a, b)}`` at the comma."""
    if not any(key.text in _KEYS for key, _ in node.entries):
        return node
    entries: list[tuple[Scalar, Node]] = []
    for key, value in node.entries:
        last = entries[-1] if entries else None
        nothing = isinstance(value, Scalar) and value.is_nothing
        if last is not None and nothing and last[0].text in _KEYS and _is_open(last[1]):
            entries[-1] = (last[0], _joined(last[1], key))
        else:
            entries.append((key, value))
    return Mapping(tuple(entries), node.where)


def _pieces(reader: NodeReader, node: Node, what: str, hint: str) -> tuple[Node, ...]:
    """Returns the items of a list, those together again that a comma in brackets has parted."""
    if isinstance(node, Scalar) and not node.is_nothing:
        node = Listing((node,), node.where)
    pieces: list[Node] = []
    for item in reader.items(node, what, hint) or ():
        if pieces and _is_open(pieces[-1]) and isinstance(item, Scalar):
            pieces[-1] = _joined(pieces[-1], item)
        else:
            pieces.append(item)
    return tuple(pieces)


def _is_open(node: Node) -> bool:
    return isinstance(node, Scalar) and node.plain and _depth(node.text) > 0


def _joined(first: Node, then: Scalar) -> Scalar:
    assert isinstance(first, Scalar)
    return Scalar(f"{first.text}, {then.text}", first.plain, first.where)


def _depth(text: str) -> int:
    return text.count("(") - text.count(")")
