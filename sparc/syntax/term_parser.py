"""Reads terms: tokens → Term (variables, numbers, identifiers, records, arithmetic).

>>> from sparc.source import Source
>>> TermParser(Source("", "f(2)*3 = X")).term()
Traceback (most recent call last):
sparc.errors.SparcSyntaxError: arithmetic needs a number, a variable or a constant, found "f(2)"
>>> TermParser(Source("", "1+X*Y = Z")).term().operator
'+'

:class:`TermParser` never calls itself, however deep a term nests; what is nested deeper than
``MAX_DEPTH`` is refused, so that whoever walks a term may recurse.
"""

from __future__ import annotations

from typing import NamedTuple

from sparc.errors import SourceError, SparcSyntaxError
from sparc.source import Span
from sparc.syntax.cursor import BINDING, MAX_DEPTH, Cursor
from sparc.syntax.tree import (
    Arithmetic,
    Identifier,
    Record,
    Term,
    Variable,
)

__all__ = ["TERM_STARTS", "Operand", "TermParser"]

TERM_STARTS = frozenset(("variable", "number", "identifier", "("))
"""The kinds of tokens that a term may begin with."""


class Operand(NamedTuple):
    """A term on the way to a larger one: where it stands, parentheses included, how deep it is."""

    node: Term
    start: int
    end: int
    depth: int


class TermParser(Cursor):
    """Reads terms, with a stack of its own for the records and parentheses that are open."""

    __slots__ = ()

    def term(self, ground: bool = False) -> Term:
        """``term = simple_term {("+" | "-" | "*" | "/") simple_term}``

        A ``ground`` term has neither variables nor operators.
        """
        at = self.at
        kind = self.kinds[at]
        following = self.kinds[at + 1]
        if following in (",", ")"):  # by far the most terms are a single word
            if kind == "variable" and not ground:
                self.at += 1
                start = self.starts[at]
                text = self.texts[at]
                return Variable(text, Span(self.source, start, start + len(text)))
            if kind == "identifier":
                self.at += 1
                start = self.starts[at]
                text = self.texts[at]
                return Identifier(text, Span(self.source, start, start + len(text)))
        return self.compound_term(ground)

    def compound_term(self, ground: bool) -> Term:
        """Returns any term, with a stack of its own for the records and parentheses that are open."""
        kinds = self.kinds
        stack: list[tuple[int, bool, list[Operand], list[Operand], list[str]]] = []
        opened, is_record = -1, False
        arguments: list[Operand] = []
        operands: list[Operand] = []
        operators: list[str] = []
        while True:
            kind = kinds[self.at]
            record = kind == "identifier" and kinds[self.at + 1] == "("
            if record or kind == "(":
                stack.append((opened, is_record, arguments, operands, operators))
                if len(stack) > MAX_DEPTH:
                    start = self.starts[self.at]
                    raise self.too_deep(start, start + 1)
                opened, is_record = self.at, record
                arguments, operands, operators = [], [], []
                self.at += 2 if record else 1
                if not record and ground:
                    self.at -= 1
                    raise self.unexpected(
                        "a ground term", "elements of a set are written without parentheses"
                    )
                continue
            operands.append(self.simple_term(ground))
            while True:  # behind an operand
                kind = kinds[self.at]
                if kind in BINDING:
                    self.check_number(operands[-1], ground)
                    while operators and BINDING[operators[-1]] >= BINDING[kind]:
                        self.apply(operators, operands)
                    operators.append(kind)
                    break
                while operators:
                    self.apply(operators, operands)
                whole = operands[0]
                if not stack:
                    return whole.node
                if is_record:
                    arguments.append(whole)
                    if kind == ",":
                        operands = []
                        break
                if kind != ")":
                    expected = '"," or ")"' if is_record else '")"'
                    raise self.unexpected(expected, self.pool_hint(is_record))
                self.at += 1
                closed = self.close(opened, arguments if is_record else [whole], is_record)
                opened, is_record, arguments, operands, operators = stack.pop()
                operands.append(closed)
            self.at += 1

    def pool_hint(self, is_record: bool) -> str | None:
        """Returns a hint about a ``,`` or ``;`` between parentheses."""
        if self.kinds[self.at] == "," and not is_record:
            return "there are no tuples: give the record a name, f(…)"
        if self.kinds[self.at] == ";":
            return "there are no pools: write a rule or literal for each term"
        return None

    def simple_term(self, ground: bool) -> Operand:
        """``simple_term = VARIABLE | NUMBER | IDENTIFIER [arguments] | "(" term ")"``

        Here without arguments and parentheses, which :meth:`compound_term` reads.
        """
        at = self.at
        kind = self.kinds[at]
        start = self.starts[at]
        end = start + len(self.texts[at])
        node: Term
        if kind == "variable" and not ground:
            node = Variable(self.texts[at], Span(self.source, start, end))
        elif kind == "identifier":
            node = Identifier(self.texts[at], Span(self.source, start, end))
        elif kind == "number":
            node = self.number(at)
        else:
            raise self.no_term(ground)
        self.at += 1
        return Operand(node, start, end, 1)

    def no_term(self, ground: bool) -> SourceError:
        """Returns the fault that no term stands where one must."""
        at = self.at
        kind, following = self.kinds[at], self.texts[at + 1]
        hint = None
        if kind == "-":
            if ground:
                hint = "there are no negative numbers in a set"
            elif following in self.constants or self.kinds[at + 1] != "identifier":
                what = following if self.kinds[at + 1] in ("number", "identifier") else "X"
                hint = f"there is no unary minus: write 0-{what}"
            else:
                hint = 'there is no unary minus; "-" negates only an atom'
        elif kind == ")" and self.texts[at - 1] == "(" and self.kinds[at - 2] == "identifier":
            hint = f"without arguments write {self.texts[at - 2]}"
        elif kind == "variable":
            hint = "the elements of a set have no variables; a record sort f(#s) has all instances"
        elif kind in ("sort name", "#") and ground:
            hint = (
                "a set has single elements: unite it with a sort, #s + {a}, or with records, f(#s)"
            )
        elif kind in ("sort name", "#"):
            hint = "a sort is no term: use a variable and the sort atom #s(X)"
        elif kind == "not":
            hint = '"not" is a reserved word and cannot be a term'
        elif kind in ("and", "or"):
            hint = f'"{kind}" is a reserved word and cannot be a term'
        elif kind in (")", "}") and self.kinds[at - 1] == ",":
            hint = f'leave out the comma before "{kind}"'
        return self.unexpected("a ground term" if ground else "a term", hint)

    def is_symbolic(self, term: Term) -> bool:
        """Returns whether a term is a record or an identifier that is no constant."""
        if isinstance(term, Identifier):
            return term.name not in self.constants
        return isinstance(term, Record)

    def check_number(self, operand: Operand, ground: bool) -> None:
        """Raises unless the operand may stand in arithmetic."""
        if ground:
            raise self.unexpected('"," or "}"', "there is no arithmetic in a set: work it out")
        if self.is_symbolic(operand.node):
            self.raise_symbolic(operand, "arithmetic needs a number, a variable or a constant")

    def raise_symbolic(self, operand: Operand, need: str, hint: str | None = None) -> None:
        """Raises the fault that a record or identifier stands for a number."""
        node = operand.node
        span = Span(self.source, operand.start, operand.end)
        found = f'"{span.text}"' if len(span.text) <= 40 else "a record"
        if isinstance(node, Identifier) and hint is None:
            hint = f"if {node.name} is meant as a number, begin the program with "
            hint += f"#const {node.name} = 3. or the like"
        raise SparcSyntaxError(f"{need}, found {found}", span, hint)

    def apply(self, operators: list[str], operands: list[Operand]) -> None:
        """Joins the last two operands by the last operator."""
        right = operands.pop()
        left = operands.pop()
        if self.is_symbolic(right.node):
            self.raise_symbolic(right, "arithmetic needs a number, a variable or a constant")
        depth = max(left.depth, right.depth) + 1
        if depth > MAX_DEPTH:
            raise self.too_deep(left.start, right.end)
        span = Span(self.source, left.start, right.end)
        node = Arithmetic(operators.pop(), left.node, right.node, span)
        operands.append(Operand(node, left.start, right.end, depth))

    def close(self, opened: int, inner: list[Operand], is_record: bool) -> Operand:
        """Returns the record or parenthesis that began at the token ``opened``."""
        span = self.span(opened)
        if is_record:
            depth = max(operand.depth for operand in inner) + 1
            if depth > MAX_DEPTH:
                raise self.too_deep(span.start, span.end)
            arguments = tuple([operand.node for operand in inner])
            node: Term = Record(self.texts[opened], arguments, span)
            return Operand(node, span.start, span.end, depth)
        whole = inner[0]
        if self.is_symbolic(whole.node):
            self.raise_symbolic(
                whole, "parentheses enclose arithmetic", "leave the parentheses out"
            )
        return Operand(whole.node, span.start, span.end, whole.depth)

    def arguments(self) -> tuple[Term, ...]:
        """``arguments = "(" term {"," term} ")"``

        The next token is the parenthesis.
        """
        self.at += 1
        terms = [self.term()]
        while self.kinds[self.at] == ",":
            self.at += 1
            terms.append(self.term())
        if self.kinds[self.at] != ")":
            raise self.unexpected('"," or ")"', self.pool_hint(True))
        self.at += 1
        return tuple(terms)
