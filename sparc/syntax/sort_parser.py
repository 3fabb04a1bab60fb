"""Reads sort definitions: tokens → SortExpression, of any kind of the manual.

>>> from sparc.source import Source
>>> SortParser(Source("", "#a - #b - #c.")).sort_expression().right
SortName(name='c')

:class:`SortParser` keeps its own stack where set expressions and conditions nest.  Long unions
and intersections become balanced trees, so that thousands of operands stay shallow.

Follows the SPARC manual, Sort definitions.
"""

from __future__ import annotations

from typing import NamedTuple

from sparc.errors import SourceError
from sparc.source import Span
from sparc.syntax.cursor import BINDING, DIRECTIVES, MAX_DEPTH, RELATIONS
from sparc.syntax.term_parser import TERM_STARTS, TermParser
from sparc.syntax.tree import (
    And,
    Concatenation,
    Condition,
    ConditionTest,
    Identifier,
    IdentifierList,
    IdentifierRange,
    Not,
    NumericRange,
    Or,
    RecordSort,
    RecordSortArgument,
    SetExpression,
    SortDefinition,
    SortExpression,
    SortName,
    Term,
    TermSet,
)

__all__ = ["LEFT_DEEP_OPERANDS", "SortParser"]

LEFT_DEEP_OPERANDS = 64
"""Longer unions and intersections become a balanced tree; the order of operands stays."""

# Each parenthesis in a record's condition may bring an "or", an "and" and a "not" with it.
_MAX_PARENTHESES = MAX_DEPTH // 6


class _SetOperand(NamedTuple):
    """A set expression on the way to a larger one."""

    node: SortExpression
    start: int
    end: int
    depth: int


_NO_NEGATIVE = "there are no negative numbers in a range"


class SortParser(TermParser):
    """Reads the section ``sorts``."""

    __slots__ = ()

    def sort_definitions(self) -> tuple[SortDefinition, ...]:
        """``sort_definitions = {sort_name "=" sort_expression "."}``"""
        definitions: list[SortDefinition] = []
        while self.kinds[self.at] in ("sort name", "#") or self.strange_sort():
            first = self.at
            try:
                definitions.append(self.sort_definition())
            except SourceError as error:
                self.recover(error, first)
        return tuple(definitions)

    def strange_sort(self) -> bool:
        """Returns whether a name that no sort may have is defined here."""
        return self.kinds[self.at] == "bad" and self.texts[self.at][0] == "#"

    def sort_definition(self) -> SortDefinition:
        """Returns one of the :meth:`sort_definitions`."""
        first = self.at
        name = self.sort_name()
        self.sorts.add("#" + name.name)
        hint = None
        if self.texts[self.at] == "(":
            hint = "a sort has no arguments where it is defined"
        elif self.kinds[self.at] in (":", "=="):
            hint = f'write "=": #{name.name} = …'
        elif self.kinds[self.at] in ("{", "[", "number"):
            hint = f'a definition has "=" behind the name: #{name.name} = …'
        self.expect("=", '"="', hint)
        expression = self.sort_expression()
        if self.kinds[self.at] != ".":
            raise self.after_expression(expression)
        self.at += 1
        return SortDefinition(name.name, expression, self.span(first), name.span)

    def after_expression(self, expression: SortExpression) -> SourceError:
        """Returns the fault that a sort expression goes on where it cannot."""
        kind = self.kinds[self.at]
        if isinstance(expression, (NumericRange, IdentifierRange, Concatenation)):
            hint = None
            if (
                isinstance(expression, NumericRange)
                and kind in BINDING
                and self.kinds[self.at + 1] in ("number", "identifier")
            ):
                hint = "the ends of a range are numbers or constants, without arithmetic"
            elif kind in BINDING:
                hint = f'"{self.texts[self.at]}" works on sort names, sets and records: '
                hint += "give this expression a sort of its own and use its name"
            return self.unexpected('"."', hint, may_end=True)
        hint = "only a record has a condition" if kind == ":" else None
        if kind in ("/", "|"):
            hint = "sorts have union +, difference - and intersection *"
        if isinstance(expression, RecordSort) and expression.condition is not None:
            hint = hint or self.condition_hint()
        elif isinstance(expression, RecordSort) and kind == "identifier":
            hint = 'a condition stands behind ":", such as f(#s(X),#s(Y)) : X != Y'
        return self.unexpected('"+", "-", "*" or "."', hint, may_end=True)

    def sort_name(self) -> SortName:
        """``sort_name = SORT | "#" IDENTIFIER``

        In the first two sections white space may follow ``#``.
        """
        at = self.at
        text = self.texts[at]
        if self.kinds[at] == "#":
            if self.kinds[at + 1] != "identifier":
                self.at += 1
                raise self.unexpected('the name of a sort after "#"')
            text = "#" + self.texts[at + 1]
            self.at += 1
        elif self.kinds[at] != "sort name":
            hint = None
            if self.kinds[at] == "identifier":
                hint = f"sort names begin with #: write #{text}"
            elif self.kinds[at] in ("variable", "number", "{"):
                hint = "a sort stands here by its name: define one, and write #s"
            elif text == ")" and self.kinds[at - 1] == ",":
                hint = "leave out the comma before the bracket"
            raise self.unexpected("a sort name such as #s", hint)
        if text in DIRECTIVES:
            self.at = at
            raise self.unexpected("the name of a sort")
        self.at += 1
        return SortName(text[1:], self.span(at))

    def sort_expression(self) -> SortExpression:
        """``sort_expression = range | concatenation | set_expression``"""
        kind = self.kinds[self.at]
        if kind in ("number", "identifier"):
            following = self.kinds[self.at + 1]
            if following == "..":
                return self.range()
            if kind == "number" or following != "(":
                hint = self.element_hint(following)
                raise self.unexpected("a sort expression", hint)
        if kind == "[":
            return self.concatenation()
        return self.set_expression()

    def element_hint(self, following: str) -> str:
        """Returns the mend for an element in the place of a sort, by the kind of what comes next."""
        text, number = self.texts[self.at], self.kinds[self.at] == "number"
        if number and following in ("-", "identifier"):
            return "a range has two dots: 1..5"
        if following in (",", "|"):
            return f"a set is written in braces, its elements parted by commas: {{{text}, …}}"
        return f"a sort with one element is written {{{text}}}"

    def range(self) -> NumericRange | IdentifierRange:
        """``range = value ".." value``"""
        first = self.at
        low = self.value()
        self.expect("..", '".."')
        hint = None
        if self.kinds[self.at] == "-":
            hint = _NO_NEGATIVE
        elif self.kinds[self.at] in (".", ".."):
            hint = f"two dots stand between the ends of a range: {self.texts[self.at - 2]}..9"
        high = self.value(hint)
        span = self.span(first)
        if isinstance(low, Identifier) and isinstance(high, Identifier):
            known = low.name in self.constants and high.name in self.constants
            if not known:
                return IdentifierRange(low, high, span)
        return NumericRange(low, high, span)

    def concatenation(self) -> Concatenation:
        """``concatenation = "[" part "]" {"[" part "]"}``"""
        first = self.at
        parts = []
        while self.kinds[self.at] == "[":
            self.at += 1
            parts.append(self.part())
            self.expect("]", '"]"')
        return Concatenation(tuple(parts), self.span(first))

    def part(self) -> NumericRange | IdentifierRange | IdentifierList | SortName:
        """``part = range | sort_name | IDENTIFIER {"," IDENTIFIER}``"""
        first = self.at
        kind = self.kinds[first]
        if kind in ("sort name", "#"):
            return self.sort_name()
        if kind in ("number", "identifier") and self.kinds[first + 1] == "..":
            return self.range()
        names = []
        while True:
            at = self.at
            if self.kinds[at] != "identifier":
                text = self.texts[at]
                hint = None
                if self.kinds[at] == "number":
                    hint = f"a single number is written {text}..{text}"
                elif text == "{":
                    hint = "write the identifiers without braces: [a,b]"
                raise self.unexpected("a range, a sort name or identifiers", hint)
            names.append(Identifier(self.texts[at], self.token_span(at)))
            self.at += 1
            if self.kinds[self.at] != ",":
                return IdentifierList(tuple(names), self.span(first))
            self.at += 1

    def set_expression(self) -> SortExpression:
        """``set_expression = set_operand {("+" | "-" | "*") set_operand}``"""
        stack: list[tuple[int, list[str], list[_SetOperand]]] = []
        operators: list[str] = []
        operands: list[_SetOperand] = []
        while True:
            if self.kinds[self.at] == "(":
                stack.append((self.starts[self.at], operators, operands))
                if len(stack) > MAX_DEPTH:
                    raise self.too_deep(stack[0][0], self.starts[self.at])
                operators, operands = [], []
                self.at += 1
                continue
            operands.append(self.set_operand())
            while self.kinds[self.at] not in ("+", "-", "*"):
                whole = self.combine(operators, operands)
                if not stack:
                    return whole.node
                self.expect(")", '"+", "-", "*" or ")"')
                start, operators, operands = stack.pop()
                end = self.starts[self.at - 1] + 1
                operands.append(_SetOperand(whole.node, start, end, whole.depth))
            operators.append(self.kinds[self.at])
            self.at += 1

    def set_operand(self) -> _SetOperand:
        """``set_operand = sort_name | term_set | record_sort | "(" set_expression ")"``

        Here without the parentheses, which :meth:`set_expression` reads.
        """
        first = self.at
        kind = self.kinds[first]
        node: SortExpression
        depth = 1
        if kind in ("sort name", "#"):
            node = self.sort_name()
            if self.kinds[self.at] == "(":
                raise self.unexpected(
                    '"+", "-", "*" or "."',
                    "a sort takes a variable only inside a record",
                    may_end=True,
                )
        elif kind == "{":
            node = self.term_set()
        elif kind == "identifier" and self.kinds[first + 1] == "(":
            node = self.record_sort()
        else:
            text, hint = self.texts[first], None
            if kind == "[" or self.kinds[first + 1] == "..":
                hint = "give a range or a concatenation a sort of its own and use its name"
            elif kind in ("identifier", "number"):
                hint = f"a set is written in braces: {{{text}}}, {{a, b}}"
            elif kind == "-" and self.kinds[first + 1] == "number":
                hint = _NO_NEGATIVE
            raise self.unexpected('a sort name, a set {…}, a record or "("', hint)
        end = self.starts[self.at - 1] + len(self.texts[self.at - 1])
        return _SetOperand(node, self.starts[first], end, depth)

    def combine(self, operators: list[str], operands: list[_SetOperand]) -> _SetOperand:
        """Returns the operands put together: products first, then sums from left to right."""
        if not operators:
            return operands[0]
        factors = [operands[0]]
        terms: list[_SetOperand] = []
        signs: list[str] = []
        for operator, operand in zip(operators, operands[1:]):
            if operator == "*":
                factors.append(operand)
            else:
                terms.append(self.chain("*", factors))
                signs.append(operator)
                factors = [operand]
        terms.append(self.chain("*", factors))
        summands = [terms[0]]
        for sign, term in zip(signs, terms[1:]):
            if sign == "+":
                summands.append(term)
            else:
                summands = [self.join("-", self.chain("+", summands), term)]
        return self.chain("+", summands)

    def chain(self, operator: str, operands: list[_SetOperand]) -> _SetOperand:
        """Operands joined by one associative operator: left-deep when few, balanced when many."""
        if len(operands) > LEFT_DEEP_OPERANDS:
            middle = len(operands) // 2
            left = self.chain(operator, operands[:middle])
            return self.join(operator, left, self.chain(operator, operands[middle:]))
        whole = operands[0]
        for operand in operands[1:]:
            whole = self.join(operator, whole, operand)
        return whole

    def join(self, operator: str, left: _SetOperand, right: _SetOperand) -> _SetOperand:
        """Returns two operands joined."""
        depth = max(left.depth, right.depth) + 1
        if depth > MAX_DEPTH:
            raise self.too_deep(left.start, right.end)
        span = Span(self.source, left.start, right.end)
        node = SetExpression(operator, left.node, right.node, span)
        return _SetOperand(node, left.start, right.end, depth)

    def term_set(self) -> TermSet:
        """``term_set = "{" [term {"," term}] "}"``"""
        first = self.at
        self.at += 1
        terms: list[Term] = []
        if self.kinds[self.at] != "}":
            terms.append(self.term(ground=True))
            while self.kinds[self.at] == ",":
                self.at += 1
                terms.append(self.term(ground=True))
        hint = None
        if self.kinds[self.at] in TERM_STARTS:
            hint = "part the elements of a set by commas"
        elif self.kinds[self.at] == "..":
            hint = "a range is no element: define a sort by it and use union, #r + {a}"
        self.expect("}", '"," or "}"', hint)
        return TermSet(tuple(terms), self.span(first))

    def record_sort(self) -> RecordSort:
        """``record_sort = IDENTIFIER "(" record_argument {"," record_argument} ")"
        [":" condition]``
        """
        first = self.at
        name = self.texts[first]
        self.at += 1
        arguments: list[RecordSortArgument] = []
        while not arguments or self.kinds[self.at] == ",":
            self.at += 1
            arguments.append(self.record_argument(name))
        self.expect(")", '"," or ")"')
        condition = None
        if self.kinds[self.at] == ":":
            self.at += 1
            condition = self.condition()
        return RecordSort(name, tuple(arguments), condition, self.span(first))

    def record_argument(self, record: str) -> RecordSortArgument:
        """``record_argument = sort_name ["(" VARIABLE ")"]``"""
        first = self.at
        kind = self.kinds[first]
        if kind not in ("sort name", "#"):
            hint = "the arguments of a record are sort names: give this one a sort of its own"
            if kind == ")" and self.kinds[first - 1] == "(":
                hint = f"a record has an argument at least; for the identifier write {{{record}}}"
            elif kind == "identifier" and self.kinds[first + 1] in (")", ","):
                hint = f"write #{self.texts[first]}, or a ground record in a set {{{record}(…)}}"
            raise self.unexpected("a sort name such as #s", hint)
        sort = self.sort_name()
        variable = None
        if self.kinds[self.at] == "(":
            self.at += 1
            variable = self.variable("a variable")
            self.expect(")", '")"')
        return RecordSortArgument(sort, variable, self.span(first))

    def condition(self) -> Condition:
        """``condition = conjunction {"or" conjunction}``"""
        stack: list[tuple[int, bool, list[Condition], list[Condition]]] = []
        disjuncts: list[Condition] = []
        conjuncts: list[Condition] = []
        while True:
            negated = self.kinds[self.at] == "not"
            if negated or self.kinds[self.at] == "(":
                stack.append((self.at, negated, disjuncts, conjuncts))
                if len(stack) > _MAX_PARENTHESES:
                    start = self.starts[stack[0][0]]
                    raise self.too_deep(start, self.starts[self.at], _MAX_PARENTHESES)
                disjuncts, conjuncts = [], []
                if negated:
                    self.at += 1
                self.expect("(", '"(" after "not"', "write not(X = Y)")
                continue
            conjuncts.append(self.condition_test())
            while True:
                kind = self.kinds[self.at]
                if kind == "and":
                    break
                disjuncts.append(self.conjunction(conjuncts))
                if kind == "or":
                    conjuncts = []
                    break
                whole = disjuncts[0]
                if len(disjuncts) > 1:
                    span = disjuncts[0].span.to(disjuncts[-1].span)
                    whole = Or(tuple(disjuncts), span)
                if not stack:
                    return whole
                if kind != ")":
                    raise self.unexpected('"and", "or" or ")"', self.condition_hint())
                self.at += 1
                first, negated, disjuncts, conjuncts = stack.pop()
                conjuncts.append(Not(whole, self.span(first)) if negated else whole)
            self.at += 1

    def conjunction(self, operands: list[Condition]) -> Condition:
        """``conjunction = condition_test {"and" condition_test}``

        The condition made of ``operands``.
        """
        if len(operands) == 1:
            return operands[0]
        return And(tuple(operands), operands[0].span.to(operands[-1].span))

    def condition_hint(self) -> str | None:
        """Returns a hint about the condition of a record."""
        kind = self.kinds[self.at]
        if kind == ",":
            return 'conditions are joined by "and" or "or", not by a comma'
        if kind in ("number", "identifier") or kind in BINDING:
            return "a record's condition compares two variables; constants go into the sorts"
        return None

    def condition_test(self) -> ConditionTest:
        """``condition_test = VARIABLE relation VARIABLE | ["not"] "(" condition ")"``

        Here without the parentheses, which :meth:`condition` reads.
        """
        first = self.at
        left = self.variable("a variable, not(…) or a parenthesis", self.condition_hint())
        relation = RELATIONS.get(self.kinds[self.at])
        if relation is None:
            raise self.unexpected('a comparison such as "!="', self.condition_hint())
        self.at += 1
        right = self.variable("a variable", self.condition_hint())
        return ConditionTest(left, relation, right, self.span(first))
