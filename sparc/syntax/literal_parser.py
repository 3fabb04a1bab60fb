"""Reads literals and bodies: tokens → atoms, comparisons, aggregates.

>>> from sparc.source import Source
>>> LiteralParser(Source("", "not -p(X), 1 <= #count{Y : q(Y)}.")).body()[0].operand
Atom(name='p', arguments=(Variable(name='X'),), negated=True)

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Rules; each method has its grammar rule.
"""

from __future__ import annotations

from sparc.errors import SourceError
from sparc.syntax.cursor import BINDING, DIRECTIVES, RELATIONS
from sparc.syntax.sort_parser import SortParser
from sparc.syntax.term_parser import TERM_STARTS
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Comparison,
    Guard,
    Literal,
    Naf,
    Number,
    SortAtom,
    Term,
)

__all__ = ["AFTER_TERM", "AGGREGATES", "FOREIGN", "OPTIMIZE", "LiteralParser"]

AFTER_TERM = frozenset(RELATIONS) | frozenset(BINDING)
AGGREGATES = {"#count": "count", "#sum": "sum", "#min": "min", "#max": "max"}
OPTIMIZE = ("#minimize", "#maximize")
_SHOWING = ("#show", "#hide")
FOREIGN = frozenset(
    ("#external", "#include", "#script", "#program", "#defined", "#project")
    + ("#heuristic", "#theory", "#import", "#times", "#avg", "#disjoint")
    + _SHOWING
)  # words of other languages; each may still name a sort


class LiteralParser(SortParser):
    """Reads what the bodies of rules are made of."""

    __slots__ = ()

    def body(self) -> tuple[BodyItem, ...]:
        """``body = body_item {"," body_item}``"""
        if self.kinds[self.at] == ".":
            raise self.unexpected("a literal", "write the body, or leave the connective out")
        items: list[BodyItem] = [self.body_item(True)]
        while self.kinds[self.at] == ",":
            self.at += 1
            items.append(self.body_item(True))
        return tuple(items)

    def literals(self) -> tuple[Literal, ...]:
        """``literals = body_item {"," body_item}``

        The condition of an element: no aggregate.
        """
        items: list[Literal] = []
        while not items or self.kinds[self.at] == ",":
            if items:
                self.at += 1
            item = self.body_item(False)
            assert not isinstance(item, Aggregate)
            items.append(item)
        return tuple(items)

    def body_item(self, aggregates: bool) -> BodyItem:
        """``body_item = atom | negated | sort_atom | naf | comparison | aggregate``

        An aggregate only where ``aggregates`` are allowed.
        """
        at = self.at
        kind = self.kinds[at]
        if kind == "identifier":
            following = self.kinds[at + 1]
            if following == "(":
                self.at += 1
                arguments = self.arguments()
                if self.kinds[self.at] in AFTER_TERM:
                    return self.comparison(aggregates, at)
                return Atom(self.texts[at], arguments, False, self.span(at), self.token_span(at))
            if following in AFTER_TERM:
                return self.comparison(aggregates, at)
            return self.atom()
        if kind == "not":
            return self.naf()
        if kind == "sort name":
            if self.texts[at] in AGGREGATES and self.kinds[at + 1] == "{":
                return self.aggregate(None, at, aggregates)
            return self.sort_atom(False)
        if kind == "-":
            item = self.negated()
            if self.kinds[self.at] in AFTER_TERM:
                self.at = at
                raise self.no_term(False)
            return item
        if kind in TERM_STARTS:
            return self.comparison(aggregates, at)
        hint = None
        if kind == "#":
            hint = "write a sort name without space after #"
        elif kind == "." and self.kinds[at - 1] == ",":
            hint = "leave out the comma before the dot"
        elif kind == "," and self.kinds[at - 1] == ",":
            hint = "one comma parts two literals"
        raise self.unexpected("a literal", hint)

    def atom(self) -> Atom:
        """``atom = IDENTIFIER [arguments]``

        An atom without ``-``.
        """
        at = self.at
        name = self.texts[at]
        if self.kinds[at] != "identifier":
            raise self.unexpected("an atom")
        self.at += 1
        arguments: tuple[Term, ...] = ()
        if self.kinds[self.at] == "(":
            arguments = self.arguments()
        return Atom(name, arguments, False, self.span(at), self.token_span(at))

    def negated(self) -> Atom | SortAtom:
        """``negated = "-" atom | "-" sort_atom``

        The ``-`` touches what it negates.
        """
        at = self.at
        following = self.kinds[at + 1]
        if following not in ("identifier", "sort name"):
            if following in ("number", "variable", "("):
                raise self.no_term(False)
            if following == "-":
                raise self.unexpected("an atom", '"-" stands once: "- -p" is p')
            self.at += 1
            raise self.unexpected('an atom after "-"')
        if not self.touches_next(at):
            word = self.texts[at + 1]
            raise self.unexpected("an atom", f'write "-{word}" without a space after "-"')
        self.at += 1
        if following == "sort name":
            return self.sort_atom(True)
        atom = self.atom()
        return Atom(atom.name, atom.arguments, True, self.span(at), atom.name_span)

    def sort_atom(self, negated: bool) -> SortAtom:
        """``sort_atom = SORT [arguments]``

        The checker wants one argument.
        """
        at = self.at
        text = self.texts[at]
        self.refuse_foreign("a literal")
        self.at += 1
        arguments: tuple[Term, ...] = ()
        if self.kinds[self.at] == "(":
            arguments = self.arguments()
        elif text in AGGREGATES and self.kinds[self.at] != "{":
            raise self.unexpected(f'"{{" after {text}')
        span = self.span(at - 1 if negated else at)
        return SortAtom(text[1:], arguments, negated, span, self.token_span(at))

    def refuse_foreign(self, expected: str) -> None:
        """Raises when the next token is a directive, or a word of another language."""
        word = self.texts[self.at]
        if word in DIRECTIVES:
            raise self.unexpected(expected)
        if word in self.sorts:
            return
        if word in OPTIMIZE:
            raise self.unexpected(expected, f"{word}{{…}}. is a statement of its own")
        if word in _SHOWING:
            hint = "what is shown goes into the section display, behind the rules"
            raise self.unexpected(expected, hint)
        if word in FOREIGN:
            raise self.unexpected(expected, f"SPARC has no {word}")

    def naf(self) -> Naf:
        """``naf = "not" (atom | negated | sort_atom)``"""
        at = self.at
        self.at += 1
        kind = self.kinds[self.at]
        if self.touches_next(at):
            if kind == "(":
                raise self.fault(
                    'expected white space after "not", found "("',
                    self.at,
                    "write not p(X), without parentheses around the atom",
                )
            if kind != "bad":
                word = self.texts[self.at]
                if kind == "-" and self.touches_next(self.at):
                    word += self.texts[self.at + 1]
                raise self.fault(
                    f'expected white space after "not", found {self.found(self.at)}',
                    self.at,
                    f"write not {word}",
                )
        operand: Atom | SortAtom
        hint = None
        if kind == "identifier":
            operand = self.atom()
        elif kind == "-":
            operand = self.negated()
        elif kind == "sort name" and self.kinds[self.at + 1] != "{":
            operand = self.sort_atom(False)
        else:
            if kind == "not":
                hint = '"not" stands once before an atom: there is no double negation'
            elif kind == "sort name":
                hint = "an aggregate cannot be negated: turn its comparison round"
            elif kind in TERM_STARTS:
                hint = "a comparison cannot be negated: turn it round, < into >= and so on"
            raise self.unexpected('an atom after "not"', hint)
        if self.kinds[self.at] in AFTER_TERM:
            raise self.unexpected(
                '"," or the end of the body',
                "a comparison cannot be negated: turn it round, < into >= and so on",
            )
        return Naf(operand, self.span(at))

    def comparison(self, aggregates: bool, first: int) -> Comparison | Aggregate:
        """``comparison = term relation term``

        Or an aggregate with a guard on the left.
        """
        self.at = first
        left = self.compound_term(False)
        relation = RELATIONS.get(self.kinds[self.at])
        if relation is None:
            hint = None
            if self.texts[self.at] in AGGREGATES:
                hint = "a guard needs a comparison: write 1 <= #count{…}"
            elif self.kinds[self.at] == "{":
                hint = "a choice {…} stands only in a head; to count in a body use #count"
            raise self.unexpected('a comparison such as "=" or "<"', hint)
        operator_at = self.at
        self.at += 1
        if self.texts[self.at] in AGGREGATES and self.kinds[self.at + 1] == "{":
            guard = Guard(relation, left, self.span(first))
            return self.aggregate(guard, first, aggregates)
        right = self.compound_term(False)
        if self.kinds[self.at] in RELATIONS:
            raise self.unexpected(
                '"," or the end of the body',
                "a comparison has two sides: write X < Y, Y < Z instead of X < Y < Z",
            )
        if relation not in ("=", "!=") and (
            (isinstance(left, (Number, Arithmetic)) and self.is_symbolic(right))
            or (isinstance(right, (Number, Arithmetic)) and self.is_symbolic(left))
        ):
            raise self.fault(
                f'"{self.texts[operator_at]}" compares a number with a symbolic term',
                operator_at,
                'between these only "=" and "!=" are allowed',
            )
        return Comparison(left, relation, right, self.span(first))

    def aggregate(self, left: Guard | None, first: int, allowed: bool) -> Aggregate:
        """``aggregate = [term relation] ("#count" | "#sum" | "#min" | "#max") "{"
        aggregate_element {";" aggregate_element} "}" [relation term]``

        The guard on the left, if any, has been read.
        """
        if not allowed:
            raise self.unexpected(
                "a literal", "an aggregate stands only in a body, not in a condition"
            )
        function = AGGREGATES[self.texts[self.at]]
        self.at += 1
        elements: list[AggregateElement] = []
        while not elements or self.kinds[self.at] == ";":
            self.at += 1
            elements.append(self.aggregate_element())
        self.expect("}", '",", ";" or "}"')
        right = None
        at = self.at
        relation = RELATIONS.get(self.kinds[at])
        if relation is not None:
            self.at += 1
            right = Guard(relation, self.compound_term(False), self.span(at))
        elif self.kinds[at] in TERM_STARTS:
            raise self.unexpected(
                'a comparison, "," or "."',
                "a guard needs a comparison: #count{…} <= 2",
                may_end=True,
            )
        return Aggregate(function, tuple(elements), left, right, self.span(first))

    def aggregate_element(self) -> AggregateElement:
        """``aggregate_element = term {"," term} ":" literals``"""
        first = self.at
        terms = [self.compound_term(False)]
        while self.kinds[self.at] == ",":
            self.at += 1
            terms.append(self.compound_term(False))
        hint = self.touching_negation()
        if self.kinds[self.at] in ("}", ";"):
            hint = "each element has a condition: X : p(X)"
        self.expect(":", '"," or ":"', hint)
        condition = self.literals()
        return AggregateElement(tuple(terms), condition, self.span(first))

    def touching_negation(self) -> str | None:
        """Returns a mend for ``:-`` where ``:`` and an atom with ``-`` are meant."""
        return 'part ":" and "-": write ": -p"' if self.kinds[self.at] == ":-" else None

    def negation_apart(self, at: int) -> SourceError:
        """Returns the fault that ``-`` does not touch the name behind it."""
        word = self.texts[at + 1]
        return self.unexpected("an atom", f'write "-{word}" without a space after "-"')
