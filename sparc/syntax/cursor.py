"""The cursor of the parser: Source → tokens, the places of nodes, and faults with their mends.

:class:`Cursor` is what the parsers of terms, sorts and programs have in common.  A fault names
what was expected and what was found; :meth:`Cursor.mend` knows what people usually meant.
"""

from __future__ import annotations

import re

from sparc.errors import Edit, LimitError, NumberError, SourceError, SourceErrors, SparcSyntaxError
from sparc.source import Source, Span
from sparc.syntax.lexer import Lexemes, lexical_error, scan
from sparc.syntax.tree import (
    Identifier,
    Number,
    Variable,
)

__all__ = [
    "BINDING",
    "DIRECTIVES",
    "MAX_DEPTH",
    "MAX_FAULTS",
    "MAX_NUMBER",
    "QUANTIFIERS",
    "QUANTIFIER_MEND",
    "RELATIONS",
    "STATEMENT_STARTS",
    "Cursor",
]

MAX_DEPTH = 200
"""Terms, set expressions and conditions nest no deeper than this, an operation being a level."""

MAX_FAULTS = 100
"""Reading ends with this many faults: such a text is no program."""

MAX_NUMBER = 2**31 - 1
"""The largest integer the solver can count to."""

RELATIONS = {"=": "=", "==": "=", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
"""Each sign of comparison, and the one the tree keeps for it."""

BINDING = {"+": 1, "-": 1, "*": 2, "/": 2}
"""The operators; the greater number binds the stronger."""

DIRECTIVES = frozenset(("#const", "#maxint"))
"""The words that no sort may have as its name."""

STATEMENT_STARTS = frozenset(
    ("identifier", "variable", "number", "sort name", "#", "-", ":-", ":+", ":~", "{", "not")
)
"""The kinds of tokens that a statement begins with, right or wrong."""

QUANTIFIERS = frozenset(("forall", "exists", "all", "every", "some", "findall"))
"""The words of logic that have no counterpart among the literals."""

QUANTIFIER_MEND = (
    "there are no quantifiers: derive what breaks it, bad :- p(X), not q(X)., and write not bad"
)
"""What to do where one of them was meant."""

_MODULO = "there is no modulo operator: the remainder of X and Y is X - X/Y*Y"

# What to do about a word of another language, where it cannot stand.
_WORDS = {
    "mod": _MODULO,
    "rem": _MODULO,
    "div": 'write "/": it is the division of integers',
    "is": 'write "=" instead of "is"',
    "in": "a sort is tested by its sort atom: #s(X)",
    "if": 'write ":-" instead of "if"',
    "where": "a condition is a literal of the body, behind a comma",
    "unless": 'write "not" behind a comma',
}

_WORD_KINDS = ("identifier", "variable", "number")
_UNMARKED = ("count", "sum", "min", "max", "minimize", "maximize")
_REMAINDER = re.compile(r"[ \t]*%[ \t]*([0-9]+|[A-Z]\w*)[ \t]*(?:[<>!=)+*/,-]|\.[ \t\r]*(?:\n|\Z))")

# What to do about a word or sign that cannot stand where it was found.
_MENDS = {
    "..": "a range stands only in a sort definition and in a fact of one argument, p(1..3).; "
    "elsewhere write a variable of a sort: q(2,X) :- #s(X).",
    ";": 'terms and literals are parted by ","; ";" parts the elements of a choice or an aggregate',
    "|": 'only the atoms of a head are parted by "|"; there is no absolute value',
    "or": 'in a head write "|", in a body a rule for each; "or" stands only in the condition of '
    "a record",
    "and": 'in a body write ","; "and" stands only in the condition of a record',
    ":": 'a condition after ":" stands only inside a choice or an aggregate',
    "{": "a choice {…} stands only in a head",
    "[": "brackets stand only in a sort definition and behind a weak constraint",
    "not": '"not" stands only before a literal of a body or a condition',
    "@": '"@" stands only in #minimize and #maximize',
    ":-": 'a statement ends with "." before the next one begins',
}  # fmt: skip


class Cursor:
    """A cursor over the tokens of a source: ``at`` is the index of the next one."""

    __slots__ = (
        "at",
        "constants",
        "faults",
        "kinds",
        "reported",
        "sorts",
        "source",
        "starts",
        "texts",
    )

    def __init__(self, source: Source, lexemes: Lexemes | None = None) -> None:
        self.source = source
        self.kinds, self.texts, self.starts = lexemes or scan(source)
        self.at = 0
        self.faults: list[SourceError] = []
        self.reported = -1  # the first token of a statement that has a fault already
        self.constants: set[str] = set()
        self.sorts: set[str] = set()

    def span(self, first: int) -> Span:
        """Returns the span from the token with index ``first`` to the last one read."""
        last = self.at - 1
        return Span(self.source, self.starts[first], self.starts[last] + len(self.texts[last]))

    def token_span(self, index: int) -> Span:
        """Returns the span of one token."""
        start = self.starts[index]
        return Span(self.source, start, start + len(self.texts[index]))

    def end(self, index: int) -> int:
        """Returns the offset behind a token."""
        return self.starts[index] + len(self.texts[index])

    def found(self, index: int) -> str:
        """Returns the token as a message names it."""
        text = self.texts[index]
        if self.kinds[index] == "end":
            return "the end of the file"
        if self.kinds[index] == "section":
            return f'the section word "{text}"'
        return f'"{text}"' if len(text) <= 40 else f'"{text[:37]}…"'

    def touches_next(self, index: int) -> bool:
        """Returns whether no white space stands between a token and the next one."""
        return self.starts[index] + len(self.texts[index]) == self.starts[index + 1]

    def on_new_line(self, index: int) -> bool:
        """Returns whether a token stands on a later line than the token before it."""
        return "\n" in self.source.text[self.starts[index - 1] : self.starts[index]]

    def column(self, index: int) -> int:
        """Returns the number of characters before a token in its line."""
        start = self.starts[index]
        return start - self.source.text.rfind("\n", 0, start) - 1

    def fault(self, message: str, index: int, hint: str | None = None) -> SparcSyntaxError:
        """Returns a fault at one token."""
        return SparcSyntaxError(message, self.token_span(index), hint)

    def unexpected(
        self, expected: str, hint: str | None = None, *, may_end: bool = False
    ) -> SourceError:
        """Returns the fault that the next token is not ``expected``.

        ``hint`` replaces the usual mend.

        With ``may_end`` the dot that ends a statement is among what is expected.
        """
        at = self.at
        kind = self.kinds[at]
        start = self.starts[at]
        if kind == "bad":
            return lexical_error(self.source, start, self.texts[at])
        if self.in_block_comment(start):
            hint = 'there are no block comments: begin every line of a comment with "%"'
        elif at and _REMAINDER.match(self.source.text, self.end(at - 1)):
            hint = f'"%" begins a comment; {_MODULO}'
        ends = may_end and (
            kind in ("end", "section") or (kind in STATEMENT_STARTS and self.on_new_line(at))
        )
        if ends and at > 0:
            return self.missing_dot(f"expected {expected} before {self.found(at)}", at - 1, hint)
        if kind == "end" and at > 0:
            end = self.end(at - 1)
            span = Span(self.source, end, end)
            return SparcSyntaxError(f"expected {expected}, found {self.found(at)}", span, hint)
        message = f"expected {expected}, found {self.found(at)}"
        fault = self.fault(message, at, hint or self.mend(at))
        fault.expected = expected
        return fault

    def missing_dot(self, message: str, last: int, hint: str | None = None) -> SparcSyntaxError:
        """Returns the fault that no dot stands behind the token ``last``."""
        end = self.end(last)
        span = Span(self.source, end, end)
        fault = SparcSyntaxError(message, span, hint or 'every statement ends with "."')
        fault.edit = Edit(end, end, ".") if hint is None else None
        return fault

    def renamed(self, fault: SourceError, index: int, new: str) -> SourceError:
        """Returns a fault of which the mend is another word for the token ``index``."""
        fault.edit = Edit(self.starts[index], self.end(index), new)
        return fault

    def in_block_comment(self, offset: int) -> bool:
        """Returns whether ``%*`` stands before the place, and what looks like its ``*%`` behind it."""
        text = self.source.text
        opening = text.rfind("%*", 0, offset)
        if opening < 0:
            return False
        closing = text.find("*%", opening + 2)
        another = text.find("%*", opening + 2)
        return closing >= offset and not offset <= another < closing

    def mend(self, at: int) -> str | None:
        """Returns a mend for the token ``at``, whatever was expected there."""
        kind, text = self.kinds[at], self.texts[at]
        pair = self.texts[at - 1] + text if at and self.touches_next(at - 1) else text
        following = text + self.texts[at + 1] if self.touches_next(at) else text
        if pair in ("=<", "=>", "<>"):
            mended = {"=<": "<=", "=>": ">=", "<>": "!="}[pair]
            return f'write "{mended}" instead of "{pair}"'
        if not {pair, following}.isdisjoint(("/*", "//")):
            return 'a comment begins with "%" and ends with the line'
        if pair == "**":
            return "there is no power operator: write the product out"
        if kind == "section":
            return f'a section begins here; if "{text}" is meant as a name, no space may follow it'
        if kind == "sort name" and text in DIRECTIVES:
            return "directives come first, before the sorts"
        if kind == "identifier" and text in _WORDS:
            return _WORDS[text]
        if kind == "{" and at and self.texts[at - 1] in _UNMARKED:
            return f'write "#{self.texts[at - 1]}{{…}}", with #'
        if kind == ".." and self.kinds[at + 1] in ("end", "section", *STATEMENT_STARTS):
            if self.kinds[at + 1] == "end" or self.on_new_line(at + 1):
                return 'one dot ends a statement: write "."'
        if kind == "," and at and self.kinds[at - 1] == ".":
            return "the statement ended with the dot: leave one of the two out"
        behind_term = at and self.kinds[at - 1] in (*_WORD_KINDS, ")")
        if behind_term and kind == "not":
            return 'is a comma missing before "not"?'
        if behind_term and kind in _WORD_KINDS:
            return f'is a comma, a dot or an operator missing before "{text}"?'
        return _MENDS.get(kind)

    def expect(self, kind: str, expected: str, hint: str | None = None) -> None:
        """Reads one token of ``kind``."""
        if self.kinds[self.at] != kind:
            raise self.unexpected(expected, hint, may_end=kind == ".")
        self.at += 1

    def too_deep(self, start: int, end: int, limit: int = MAX_DEPTH) -> LimitError:
        """Returns the fault that something nests deeper than ``limit`` levels."""
        return LimitError(
            f"nested deeper than {limit} levels",
            Span(self.source, start, min(end, start + 40)),
            "name parts of it, by sorts of their own or by variables, and use the names",
        )

    def recover(self, error: SourceError, first: int) -> None:
        """Keeps a fault of the statement that begins with the token ``first``, and goes on behind it.

        The parser as a whole knows how (`sparc.syntax.parser`).
        """
        raise NotImplementedError

    def keep(self, fault: SourceError) -> None:
        """Adds a fault to those found.

        Raises :class:`SourceErrors` when there are ``MAX_FAULTS``.
        """
        self.faults.append(fault)
        if len(self.faults) == MAX_FAULTS:
            raise SourceErrors(self.faults)

    def value(self, hint: str | None = None) -> Number | Identifier:
        """``value = NUMBER | IDENTIFIER``"""
        at = self.at
        if self.kinds[at] == "number":
            self.at += 1
            return self.number(at)
        if self.kinds[at] == "identifier":
            self.at += 1
            return Identifier(self.texts[at], self.token_span(at))
        raise self.unexpected("a number or the name of a constant", hint)

    def number(self, at: int) -> Number:
        """Returns the number of the token ``at``."""
        text = self.texts[at]
        span = self.token_span(at)
        if len(text) > 10 or int(text) > MAX_NUMBER:
            raise NumberError(f"the number {text[:40]} is larger than {MAX_NUMBER}", span)
        return Number(int(text), span)

    def variable(self, expected: str, hint: str | None = None) -> Variable:
        """Returns one variable."""
        at = self.at
        self.expect("variable", expected, hint)
        return Variable(self.texts[at], self.token_span(at))
