"""Indexes names: the tokens of a program → its occurrences of names. Entry point `index`.

Works on tokens, so that a program with faults has its names, too: that is how it looks while it is
being written.

>>> from sparc.source import Source
>>> from sparc.syntax.lexer import scan
>>> found = index(scan(Source("x", "predicates p(#s). rules p(X) :- not p(X).")))
>>> [(each.kind, each.name, each.defines) for each in found][:3]
[('predicate', 'p', True), ('sort', 's', False), ('predicate', 'p', False)]
"""

from __future__ import annotations

from typing import NamedTuple

from sparc.syntax.lexer import Lexemes

__all__ = ["WORDS_WITH_HASH", "Occurrence", "index"]

WORDS_WITH_HASH = ("const", "maxint", "count", "sum", "min", "max", "minimize", "maximize")
_AGGREGATES = ("#count", "#sum", "#min", "#max", "#minimize", "#maximize")
_RELATIONS = ("=", "==", "!=", "<", "<=", ">", ">=")
_ENDS_A_TERM = (*_RELATIONS, "+", "-", "*", "/", "..")
_BEFORE_A_LITERAL = ("section", ".", ":-", ":+", ":~", ",", ";", "|", "or", "not", "-", "{", ":")


class Occurrence(NamedTuple):
    """One name at one place.

    ``kind`` is ``sort`` (its name without the ``#``), ``predicate``, ``constant`` (of a
    ``#const``), ``variable``, ``label`` or ``value`` (a symbolic constant or a record).
    ``statement`` counts the statements of the text; a variable means the same inside one of them.
    """

    kind: str
    name: str
    start: int
    end: int
    defines: bool
    statement: int


class _Scanner:
    """Walks over the tokens of a text once."""

    def __init__(self, lexemes: Lexemes) -> None:
        self.kinds, self.texts, self.starts = lexemes
        self.found: list[Occurrence] = []
        self.section = ""
        self.statement = 0
        self.first = 0  # the token that the statement begins with
        self.brackets: list[str] = []  # "(", "[", "{" and "a": an aggregate before its colon
        self.constants: set[str] = set()

    def run(self) -> list[Occurrence]:
        for i, kind in enumerate(self.kinds):
            if kind == "end":
                break
            if kind == "section":
                self.section = self.texts[i]
                self._new_statement(i + 1)
            elif kind == ".":
                self._new_statement(i + 1)
            elif kind in ("(", "["):
                self.brackets.append(kind)
            elif kind == "{":
                self.brackets.append("a" if self.texts[i - 1] in _AGGREGATES and i else "{")
            elif kind in (")", "]", "}"):
                if self.brackets:
                    self.brackets.pop()
                if kind == "]" and self.section == "rules":  # the weight of a weak constraint
                    self._new_statement(i + 1)
            elif kind == ":" and self.brackets[-1:] == ["a"]:
                self.brackets[-1] = "{"
            elif kind == ";" and self.brackets[-1:] == ["{"]:
                if "a" in self.brackets or self._opened_by_aggregate(i):
                    self.brackets[-1] = "a"
            elif kind in ("identifier", "variable", "sort name"):
                self._name(i, kind)
        return self.found

    def _opened_by_aggregate(self, i: int) -> bool:
        """Returns whether the innermost open brace before the token ``i`` follows a
        word like ``#sum``.
        """
        depth = 0
        for j in range(i - 1, self.first - 1, -1):
            depth += (self.kinds[j] == "}") - (self.kinds[j] == "{")
            if depth < 0:
                return j > 0 and self.texts[j - 1] in _AGGREGATES
        return False

    def _new_statement(self, first: int) -> None:
        self.statement += 1
        self.first = first
        self.brackets.clear()

    def _name(self, i: int, kind: str) -> None:
        text, start = self.texts[i], self.starts[i]
        end = start + len(text)
        if kind == "sort name":
            if text[1:] not in WORDS_WITH_HASH:
                defines = self.section == "sorts" and i == self.first
                self._add("sort", text[1:], start + 1, end, defines)
            return
        if kind == "variable":
            if text != "_":
                self._add("variable", text, start, end, False)
            return
        before = self.texts[i - 1] if i else ""
        if before == "#const":
            self.constants.add(text)
            self._add("constant", text, start, end, True)
        elif self.section == "predicates" or self.section == "display":
            at_start = i == self.first or (i == self.first + 1 and before == "-")
            if at_start:
                self._add("predicate", text, start, end, self.section == "predicates")
            else:
                self._value(text, start, end)
        elif self.section == "rules" and self._is_literal(i):
            label = i == self.first and self.kinds[i + 1] == ":"
            self._add("label" if label else "predicate", text, start, end, label)
        else:
            self._value(text, start, end)

    def _is_literal(self, i: int) -> bool:
        """Returns whether an identifier of a rule is a predicate and not a term."""
        if self.brackets and self.brackets[-1] != "{":
            return False
        before = self.kinds[i - 1] if i else "section"
        if before == "-" and i - 1 != self.first and self.kinds[i - 2] not in _BEFORE_A_LITERAL:
            return False  # a difference
        if before not in _BEFORE_A_LITERAL and i != self.first:
            return False
        after = self.kinds[self._behind_arguments(i)]
        return after not in _ENDS_A_TERM

    def _behind_arguments(self, i: int) -> int:
        """Returns the token behind ``name`` or ``name(…)``."""
        j = i + 1
        if self.kinds[j] != "(":
            return j
        depth = 0
        while self.kinds[j] != "end":
            depth += (self.kinds[j] == "(") - (self.kinds[j] == ")")
            j += 1
            if depth == 0:
                return j
            if self.kinds[j] in (".", ":-"):
                return j
        return j

    def _value(self, text: str, start: int, end: int) -> None:
        kind = "constant" if text in self.constants else "value"
        self._add(kind, text, start, end, False)

    def _add(self, kind: str, name: str, start: int, end: int, defines: bool) -> None:
        self.found.append(Occurrence(kind, name, start, end, defines, self.statement))


def index(lexemes: Lexemes) -> tuple[Occurrence, ...]:
    """Returns all names of a text in their order; sections and keywords are none."""
    return tuple(_Scanner(lexemes).run())
