"""Reads a SPARC program: Source → Program, with :func:`parse`.

The parser is written by hand, one method a grammar rule, under the rule's name in
``grammar.txt``.  It stops at the first fault.  Where input may nest (terms, set expressions,
conditions of records) it keeps its own stack instead of calling itself, and no tree it returns is
deeper than ``MAX_DEPTH``: whoever walks a tree may recurse.

>>> program = parse(Source("x.sparc", "predicates\\np().\\nrules\\np :- not -p.\\n"))
>>> program.statements[0].body[0].operand
Atom(name='p', arguments=(), negated=True)

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), Syntax; section by section in the order
directives, sorts, predicates, rules, display.
"""

from __future__ import annotations

from typing import NamedTuple

from sparc.errors import LimitError, SourceError, SparcSyntaxError
from sparc.lexer import SECTION_WORDS, lexical_error, scan
from sparc.source import Source, Span
from sparc.syntax import (
    Aggregate,
    AggregateElement,
    And,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    Concatenation,
    Condition,
    ConditionTest,
    ConstDirective,
    CrRule,
    DisplayItem,
    DisplaySort,
    Guard,
    Head,
    Identifier,
    IdentifierList,
    IdentifierRange,
    Literal,
    MaxintDirective,
    Naf,
    Not,
    Number,
    NumericRange,
    Optimize,
    Or,
    PredicateDeclaration,
    Program,
    RangeFact,
    Record,
    RecordSort,
    RecordSortArgument,
    Rule,
    SetExpression,
    SortAtom,
    SortDefinition,
    SortExpression,
    SortName,
    Statement,
    Term,
    TermSet,
    Variable,
    WeakConstraint,
)

__all__ = ["LEFT_DEEP_OPERANDS", "MAX_DEPTH", "MAX_NUMBER", "parse"]

MAX_DEPTH = 200
"""Terms, set expressions and conditions nest no deeper than this, an operation being a level."""

MAX_NUMBER = 2**31 - 1
"""The largest integer the solver can count to."""

LEFT_DEEP_OPERANDS = 64
"""Longer unions and intersections become a balanced tree; the order of operands stays."""

# Each parenthesis in a record's condition may bring an "or", an "and" and a "not" with it.
_MAX_PARENTHESES = MAX_DEPTH // 6

_RELATIONS = {"=": "=", "==": "=", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_BINDING = {"+": 1, "-": 1, "*": 2, "/": 2}
_AGGREGATES = {"#count": "count", "#sum": "sum", "#min": "min", "#max": "max"}
_TERM_STARTS = frozenset(("variable", "number", "identifier", "("))
_AFTER_TERM = frozenset(_RELATIONS) | frozenset(_BINDING)
_STATEMENT_STARTS = frozenset(
    ("identifier", "variable", "number", "sort name", "#", "-", ":-", ":+", ":~", "{", "not")
)
_DIRECTIVES = frozenset(("#const", "#maxint"))
_OPTIMIZE = ("#minimize", "#maximize")
_FOREIGN = frozenset(
    ("#external", "#include", "#script", "#program", "#defined", "#project")
    + ("#heuristic", "#theory", "#import", "#times", "#avg", "#disjoint")
)  # words of other languages; each may still name a sort

# What to do about a word or sign that cannot stand where it was found.
_MENDS = {
    "..": "a range stands only in a sort definition and in a fact such as p(1..3).",
    ";": 'terms and literals are parted by ","; ";" parts the elements of a choice or an aggregate',
    "|": 'only the atoms of a head are parted by "|"; there is no absolute value',
    "or": 'in a head write "|"; "or" stands only in the condition of a record',
    "and": 'in a body write ","; "and" stands only in the condition of a record',
    ":": 'a condition after ":" stands only inside a choice or an aggregate',
    "{": "a choice {…} stands only in a head",
    "[": "brackets stand only in a sort definition and behind a weak constraint",
    "not": '"not" stands only before a literal of a body or a condition',
    "@": '"@" stands only in #minimize and #maximize',
    ":-": 'a statement ends with "." before the next one begins',
}  # fmt: skip


def parse(source: Source) -> Program:
    """The tree of the program ``source``.

    Raises :class:`SparcSyntaxError` at the first fault, or :class:`LimitError` for a program
    that is too large, nested too deeply, or has a number beyond ``MAX_NUMBER``.
    """
    return _Parser(source).program()


class _Operand(NamedTuple):
    """A term on the way to a larger one: where it stands, parentheses included, how deep it is."""

    node: Term
    start: int
    end: int
    depth: int


class _SetOperand(NamedTuple):
    """A set expression on the way to a larger one."""

    node: SortExpression
    start: int
    end: int
    depth: int


class _Parser:
    """One pass over the tokens; ``at`` is the index of the next one."""

    __slots__ = ("at", "constants", "kinds", "sorts", "source", "starts", "texts")

    def __init__(self, source: Source) -> None:
        self.source = source
        self.kinds, self.texts, self.starts = scan(source)
        self.at = 0
        self.constants: set[str] = set()
        self.sorts: set[str] = set()

    # ------------------------------------------------------------ places and faults

    def span(self, first: int) -> Span:
        """The span from the token with index ``first`` to the last one read."""
        last = self.at - 1
        return Span(self.source, self.starts[first], self.starts[last] + len(self.texts[last]))

    def token_span(self, index: int) -> Span:
        """The span of one token."""
        start = self.starts[index]
        return Span(self.source, start, start + len(self.texts[index]))

    def found(self, index: int) -> str:
        """The token as a message names it."""
        text = self.texts[index]
        if self.kinds[index] == "end":
            return "the end of the file"
        if self.kinds[index] == "section":
            return f'the section word "{text}"'
        return f'"{text}"' if len(text) <= 40 else f'"{text[:37]}…"'

    def touches_next(self, index: int) -> bool:
        """Whether no white space stands between a token and the next one."""
        return self.starts[index] + len(self.texts[index]) == self.starts[index + 1]

    def on_new_line(self, index: int) -> bool:
        """Whether a token stands on a later line than the token before it."""
        return "\n" in self.source.text[self.starts[index - 1] : self.starts[index]]

    def fault(self, message: str, index: int, hint: str | None = None) -> SparcSyntaxError:
        """A fault at one token."""
        return SparcSyntaxError(message, self.token_span(index), hint)

    def unexpected(self, expected: str, hint: str | None = None) -> SourceError:
        """The fault that the next token is not ``expected``; ``hint`` replaces the usual mend."""
        at = self.at
        kind = self.kinds[at]
        start = self.starts[at]
        if kind == "bad":
            return lexical_error(self.source, start, self.texts[at])
        comment = self.source.text.rfind("%*", 0, start)
        if comment >= 0:
            close = self.source.text.find("*%", comment + 2)
            if close >= start:
                hint = 'there are no block comments: begin every line of a comment with "%"'
        ends = '"."' in expected and (
            kind in ("end", "section") or (kind in _STATEMENT_STARTS and self.on_new_line(at))
        )
        if ends and at > 0:
            end = self.starts[at - 1] + len(self.texts[at - 1])
            return SparcSyntaxError(
                f"expected {expected} before {self.found(at)}",
                Span(self.source, end, end),
                hint or 'every statement ends with "."',
            )
        if kind == "end" and at > 0:
            end = self.starts[at - 1] + len(self.texts[at - 1])
            span = Span(self.source, end, end)
            return SparcSyntaxError(f"expected {expected}, found {self.found(at)}", span, hint)
        return self.fault(f"expected {expected}, found {self.found(at)}", at, hint or self.mend(at))

    def mend(self, at: int) -> str | None:
        """What may help about the token ``at``, whatever was expected there."""
        kind, text = self.kinds[at], self.texts[at]
        pair = self.texts[at - 1] + text if at and self.touches_next(at - 1) else text
        if pair in ("=<", "=>", "<>"):
            mended = {"=<": "<=", "=>": ">=", "<>": "!="}[pair]
            return f'write "{mended}" instead of "{pair}"'
        if pair in ("/*", "//"):
            return 'a comment begins with "%" and ends with the line'
        if pair == "**":
            return "there is no power operator: write the product out"
        if kind == "section":
            return f'a section begins here; if "{text}" is meant as a name, no space may follow it'
        if kind == "sort name" and text in _DIRECTIVES:
            return "directives come first, before the sorts"
        return _MENDS.get(kind)

    def expect(self, kind: str, expected: str, hint: str | None = None) -> None:
        """Reads one token of ``kind``."""
        if self.kinds[self.at] != kind:
            raise self.unexpected(expected, hint)
        self.at += 1

    def too_deep(self, start: int, end: int, limit: int = MAX_DEPTH) -> LimitError:
        """The fault that something nests deeper than ``limit`` levels."""
        return LimitError(
            f"nested deeper than {limit} levels",
            Span(self.source, start, min(end, start + 40)),
            "name parts of it, by sorts of their own or by variables, and use the names",
        )

    # ------------------------------------------------------------ program and sections

    def program(self) -> Program:
        """``program = {directive} [sorts] predicates rules [display] end``"""
        directives = self.directives()
        sorts: tuple[SortDefinition, ...] = ()
        if self.kinds[self.at] == "section" and self.texts[self.at] == "sorts":
            self.at += 1
            sorts = self.sort_definitions()
            self.section("predicates", 'a sort definition or the section word "predicates"')
        else:
            self.section("predicates", 'the section word "sorts" or "predicates"')
        predicates = self.predicate_declarations()
        self.section("rules", 'a predicate declaration or the section word "rules"')
        statements = self.statements()
        display = None
        if self.kinds[self.at] == "section" and self.texts[self.at] == "display":
            self.at += 1
            display = self.display()
        if self.kinds[self.at] != "end":
            where = "an item to display" if display is not None else "a rule"
            raise self.misplaced(f"{where} or the end of the file")
        return Program(directives, sorts, predicates, statements, display, self.source)

    def section(self, word: str, expected: str) -> None:
        """Reads the section word ``word``."""
        if self.kinds[self.at] != "section" or self.texts[self.at] != word:
            raise self.misplaced(expected)
        self.at += 1

    def misplaced(self, expected: str) -> SourceError:
        """The fault that neither a statement nor the right section word follows."""
        kind, text = self.kinds[self.at], self.texts[self.at]
        hint = None
        if kind in ("section", "end"):
            hint = (
                "the sections are sorts, predicates, rules and display, in this order; "
                "predicates and rules must be there, though they may be empty"
            )
        elif text in _DIRECTIVES:
            hint = "directives come first, before the sorts"
        elif text in SECTION_WORDS:
            hint = f'white space must follow the section word "{text}"'
        elif kind == "sort name":
            hint = "sorts are defined in the first section, behind the word sorts"
        elif kind in ("identifier", "variable"):
            import difflib  # only for the message: it costs time to load

            near = difflib.get_close_matches(text.lower(), SECTION_WORDS, 1)
            hint = f'did you mean "{near[0]}"?' if near else None
        return self.unexpected(expected, hint)

    def directives(self) -> tuple[ConstDirective | MaxintDirective, ...]:
        """``directive = "#const" identifier "=" value "." | "#maxint" "=" value "."``"""
        found: list[ConstDirective | MaxintDirective] = []
        while (word := self.texts[self.at]) in _DIRECTIVES:
            first = self.at
            self.at += 1
            name = ""
            if word == "#const":
                name = self.texts[self.at]
                self.expect("identifier", "the name of a constant (a lower-case identifier)")
                self.constants.add(name)
            self.expect("=", '"="')
            hint = None
            if self.kinds[self.at] == "-":
                hint = "there are no negative numbers: write 0-n where the constant is used"
            value = self.value(hint)
            if self.kinds[self.at] in _BINDING:
                raise self.unexpected('"."', "a directive takes a plain number: work it out")
            self.expect(".", '"."')
            if word == "#const":
                span = self.span(first)
                found.append(ConstDirective(name, value, span, self.token_span(first + 1)))
            else:
                found.append(MaxintDirective(value, self.span(first)))
        return tuple(found)

    def value(self, hint: str | None = None) -> Number | Identifier:
        """``value = number | identifier``"""
        at = self.at
        if self.kinds[at] == "number":
            self.at += 1
            return self.number(at)
        if self.kinds[at] == "identifier":
            self.at += 1
            return Identifier(self.texts[at], self.token_span(at))
        raise self.unexpected("a number or the name of a constant", hint)

    def number(self, at: int) -> Number:
        """The number of the token ``at``."""
        text = self.texts[at]
        span = self.token_span(at)
        if len(text) > 10 or int(text) > MAX_NUMBER:
            raise LimitError(f"the number {text[:40]} is larger than {MAX_NUMBER}", span)
        return Number(int(text), span)

    # ------------------------------------------------------------ sorts

    def sort_definitions(self) -> tuple[SortDefinition, ...]:
        """``sort_definition = sort_name "=" sort_expression "."``"""
        found: list[SortDefinition] = []
        while self.kinds[self.at] in ("sort name", "#"):
            first = self.at
            name = self.sort_name()
            self.sorts.add("#" + name.name)
            hint = None
            if self.texts[self.at] == "(":
                hint = "a sort has no arguments where it is defined"
            self.expect("=", '"="', hint)
            expression = self.sort_expression()
            if self.kinds[self.at] != ".":
                raise self.after_expression(expression)
            self.at += 1
            found.append(SortDefinition(name.name, expression, self.span(first), name.span))
        return tuple(found)

    def after_expression(self, expression: SortExpression) -> SourceError:
        """The fault that a sort expression goes on where it cannot."""
        kind = self.kinds[self.at]
        if isinstance(expression, (NumericRange, IdentifierRange, Concatenation)):
            hint = None
            if kind in _BINDING:
                hint = f'"{self.texts[self.at]}" works on sort names, sets and records: '
                hint += "give this expression a sort of its own and use its name"
            return self.unexpected('"."', hint)
        hint = "only a record has a condition" if kind == ":" else None
        if kind == "/":
            hint = "sorts have union +, difference - and intersection *"
        return self.unexpected('"+", "-", "*" or "."', hint)

    def sort_name(self) -> SortName:
        """``sort_name = "#" identifier``; in the first two sections space may stand between."""
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
            raise self.unexpected("a sort name such as #s", hint)
        if text in _DIRECTIVES:
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
                hint = f"a sort with one element is written {{{self.texts[self.at]}}}"
                raise self.unexpected("a sort expression", hint)
        if kind == "[":
            return self.concatenation()
        return self.set_expression()

    def range(self) -> NumericRange | IdentifierRange:
        """``range = value ".." value``"""
        first = self.at
        low = self.value()
        self.expect("..", '".."')
        hint = "there are no negative numbers in a range" if self.kinds[self.at] == "-" else None
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
        """``part = range | sort_name | identifier {"," identifier}``"""
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
        """``set_expression = product {("+" | "-") product}``,
        ``product = set_operand {"*" set_operand}``,
        ``set_operand = sort_name | term_set | record_sort | "(" set_expression ")"``
        """
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
        """A set operand other than a parenthesised set expression."""
        first = self.at
        kind = self.kinds[first]
        node: SortExpression
        depth = 1
        if kind in ("sort name", "#"):
            node = self.sort_name()
            if self.kinds[self.at] == "(":
                raise self.unexpected(
                    '"+", "-", "*" or "."', "a sort takes a variable only inside a record"
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
                hint = f"a set with one element is written {{{text}}}"
            raise self.unexpected('a sort name, a set {…}, a record or "("', hint)
        end = self.starts[self.at - 1] + len(self.texts[self.at - 1])
        return _SetOperand(node, self.starts[first], end, depth)

    def combine(self, operators: list[str], operands: list[_SetOperand]) -> _SetOperand:
        """The operands put together: products first, then sums from left to right."""
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
        """Two operands joined."""
        depth = max(left.depth, right.depth) + 1
        if depth > MAX_DEPTH:
            raise self.too_deep(left.start, right.end)
        span = Span(self.source, left.start, right.end)
        node = SetExpression(operator, left.node, right.node, span)
        return _SetOperand(node, left.start, right.end, depth)

    def term_set(self) -> TermSet:
        """``term_set = "{" [ground_term {"," ground_term}] "}"``"""
        first = self.at
        self.at += 1
        terms: list[Term] = []
        if self.kinds[self.at] != "}":
            terms.append(self.term(ground=True))
            while self.kinds[self.at] == ",":
                self.at += 1
                terms.append(self.term(ground=True))
        hint = None
        if self.kinds[self.at] in _TERM_STARTS:
            hint = "part the elements of a set by commas"
        elif self.kinds[self.at] == "..":
            hint = "a range is no element: define a sort by it and use union, #r + {a}"
        self.expect("}", '"," or "}"', hint)
        return TermSet(tuple(terms), self.span(first))

    def record_sort(self) -> RecordSort:
        """``record_sort = identifier "(" record_argument {"," record_argument} ")"
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
        """``record_argument = sort_name ["(" variable ")"]``"""
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

    def variable(self, expected: str, hint: str | None = None) -> Variable:
        """One variable."""
        at = self.at
        self.expect("variable", expected, hint)
        return Variable(self.texts[at], self.token_span(at))

    def condition(self) -> Condition:
        """``condition = conjunction {"or" conjunction}``,
        ``conjunction = condition_test {"and" condition_test}``,
        ``condition_test = variable relation variable | ["not"] "(" condition ")"``
        """
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
        """Conditions joined by ``and``."""
        if len(operands) == 1:
            return operands[0]
        return And(tuple(operands), operands[0].span.to(operands[-1].span))

    def condition_hint(self) -> str | None:
        """What may help in the condition of a record."""
        kind = self.kinds[self.at]
        if kind == ",":
            return 'conditions are joined by "and" or "or", not by a comma'
        if kind in ("number", "identifier") or kind in _BINDING:
            return "a record's condition compares two variables; constants go into the sorts"
        return None

    def condition_test(self) -> ConditionTest:
        """``variable relation variable``"""
        first = self.at
        left = self.variable("a variable, not(…) or a parenthesis", self.condition_hint())
        relation = _RELATIONS.get(self.kinds[self.at])
        if relation is None:
            raise self.unexpected('a comparison such as "!="', self.condition_hint())
        self.at += 1
        right = self.variable("a variable", self.condition_hint())
        return ConditionTest(left, relation, right, self.span(first))

    # ------------------------------------------------------------ predicates

    def predicate_declarations(self) -> tuple[PredicateDeclaration, ...]:
        """``predicate_declaration = identifier "(" [sort_name {"," sort_name}] ")" "."``"""
        found: list[PredicateDeclaration] = []
        while self.kinds[self.at] == "identifier":
            first = self.at
            name = self.texts[first]
            if self.kinds[first + 1] != "(" and name in SECTION_WORDS:
                raise self.misplaced("a predicate declaration")
            self.at += 1
            hint = None
            if self.kinds[self.at] == ".":
                hint = f"a predicate without arguments is declared {name}()."
            self.expect("(", '"("', hint)
            sorts: list[SortName] = []
            if self.kinds[self.at] != ")":
                sorts.append(self.sort_name())
                while self.kinds[self.at] == ",":
                    self.at += 1
                    sorts.append(self.sort_name())
            hint = None
            if self.kinds[self.at] == "(":
                hint = "the arguments of a predicate are plain sort names"
            self.expect(")", '"," or ")"' if sorts else 'a sort name or ")"', hint)
            self.expect(".", '"."')
            span = self.span(first)
            found.append(PredicateDeclaration(name, tuple(sorts), span, self.token_span(first)))
        return tuple(found)

    # ------------------------------------------------------------ terms

    def term(self, ground: bool = False) -> Term:
        """``term = product_term {("+" | "-") product_term}``,
        ``product_term = simple_term {("*" | "/") simple_term}``,
        ``simple_term = variable | number | identifier ["(" term {"," term} ")"] | "(" term ")"``

        A ``ground`` term has neither variables nor arithmetic.
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
        """Any term, with a stack of its own for the records and parentheses that are open."""
        kinds = self.kinds
        stack: list[tuple[int, bool, list[_Operand], list[_Operand], list[str]]] = []
        opened, is_record = -1, False
        arguments: list[_Operand] = []
        operands: list[_Operand] = []
        operators: list[str] = []
        while True:
            kind = kinds[self.at]
            record = kind == "identifier" and kinds[self.at + 1] == "("
            if record or kind == "(":
                stack.append((opened, is_record, arguments, operands, operators))
                if len(stack) > MAX_DEPTH:
                    start = self.starts[self.at - len(stack)]
                    raise self.too_deep(start, self.starts[self.at])
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
                if kind in _BINDING:
                    self.check_number(operands[-1], ground)
                    while operators and _BINDING[operators[-1]] >= _BINDING[kind]:
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
        """What may help at a ``,`` or ``;`` between parentheses."""
        if self.kinds[self.at] == "," and not is_record:
            return "there are no tuples: give the record a name, f(…)"
        if self.kinds[self.at] == ";":
            return "there are no pools: write a rule or literal for each term"
        return None

    def simple_term(self, ground: bool) -> _Operand:
        """A variable, a number or an identifier."""
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
        return _Operand(node, start, end, 1)

    def no_term(self, ground: bool) -> SourceError:
        """The fault that no term stands where one must."""
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
        elif kind in ("sort name", "#"):
            hint = "a sort is no term: use a variable and the sort atom #s(X)"
        elif kind == "not":
            hint = '"not" is a reserved word and cannot be a term'
        elif kind in ("and", "or"):
            hint = f'"{kind}" is a reserved word and cannot be a term'
        return self.unexpected("a ground term" if ground else "a term", hint)

    def is_symbolic(self, term: Term) -> bool:
        """Whether a term is a record or an identifier that is no constant."""
        if isinstance(term, Identifier):
            return term.name not in self.constants
        return isinstance(term, Record)

    def check_number(self, operand: _Operand, ground: bool) -> None:
        """Raises unless the operand may stand in arithmetic."""
        if ground:
            raise self.unexpected('"," or "}"', "there is no arithmetic in a set: work it out")
        if self.is_symbolic(operand.node):
            self.raise_symbolic(operand, "arithmetic needs a number, a variable or a constant")

    def raise_symbolic(self, operand: _Operand, need: str) -> None:
        """Raises the fault that a record or identifier stands for a number."""
        node = operand.node
        span = Span(self.source, operand.start, operand.end)
        if isinstance(node, Identifier):
            hint = f'if {node.name} is a number, define it at the top: "#const {node.name} = ….",'
            raise SparcSyntaxError(f'{need}, found "{node.name}"', span, hint[:-1])
        name = node.name if isinstance(node, Record) else ""
        raise SparcSyntaxError(f"{need}, found the record {name}(…)", span)

    def apply(self, operators: list[str], operands: list[_Operand]) -> None:
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
        operands.append(_Operand(node, left.start, right.end, depth))

    def close(self, opened: int, inner: list[_Operand], is_record: bool) -> _Operand:
        """The record or parenthesis that began at the token ``opened``."""
        span = self.span(opened)
        if is_record:
            depth = max(operand.depth for operand in inner) + 1
            if depth > MAX_DEPTH:
                raise self.too_deep(span.start, span.end)
            arguments = tuple([operand.node for operand in inner])
            node: Term = Record(self.texts[opened], arguments, span)
            return _Operand(node, span.start, span.end, depth)
        whole = inner[0]
        if self.is_symbolic(whole.node):
            self.raise_symbolic(whole, "parentheses enclose arithmetic")
        return _Operand(whole.node, span.start, span.end, whole.depth)

    def arguments(self) -> tuple[Term, ...]:
        """``arguments = "(" term {"," term} ")"``; the next token is the parenthesis."""
        self.at += 1
        found = [self.term()]
        while self.kinds[self.at] == ",":
            self.at += 1
            found.append(self.term())
        if self.kinds[self.at] != ")":
            raise self.unexpected('"," or ")"', self.pool_hint(True))
        self.at += 1
        return tuple(found)

    # ------------------------------------------------------------ literals and bodies

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
        """``literals = literal {"," literal}``: the condition of an element."""
        items: list[Literal] = []
        while not items or self.kinds[self.at] == ",":
            if items:
                self.at += 1
            item = self.body_item(False)
            assert not isinstance(item, Aggregate)
            items.append(item)
        return tuple(items)

    def body_item(self, aggregates: bool) -> BodyItem:
        """``body_item = literal | aggregate``,
        ``literal = ["not"] (atom | sort_atom) | comparison``
        """
        at = self.at
        kind = self.kinds[at]
        if kind == "identifier":
            following = self.kinds[at + 1]
            if following == "(":
                self.at += 1
                arguments = self.arguments()
                if self.kinds[self.at] in _AFTER_TERM:
                    return self.comparison(aggregates, at)
                return Atom(self.texts[at], arguments, False, self.span(at), self.token_span(at))
            if following in _AFTER_TERM:
                return self.comparison(aggregates, at)
            return self.atom()
        if kind == "not":
            return self.naf()
        if kind == "sort name":
            if self.texts[at] in _AGGREGATES and self.kinds[at + 1] == "{":
                return self.aggregate(None, at, aggregates)
            return self.sort_atom(False)
        if kind == "-":
            item = self.negated()
            if self.kinds[self.at] in _AFTER_TERM:
                self.at = at
                raise self.no_term(False)
            return item
        if kind in _TERM_STARTS:
            return self.comparison(aggregates, at)
        hint = None
        if kind == "#":
            hint = "write a sort name without space after #"
        elif kind == "." and self.kinds[at - 1] == ",":
            hint = "leave out the comma before the dot"
        raise self.unexpected("a literal", hint)

    def atom(self) -> Atom:
        """``atom = ["-"] identifier [arguments]``; here without the sign."""
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
        """An atom or sort atom behind ``-``, which must touch it."""
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
        """``sort_atom = "#" identifier [arguments]``; the checker wants one argument."""
        at = self.at
        text = self.texts[at]
        self.refuse_foreign("a literal")
        self.at += 1
        arguments: tuple[Term, ...] = ()
        if self.kinds[self.at] == "(":
            arguments = self.arguments()
        elif text in _AGGREGATES and self.kinds[self.at] != "{":
            raise self.unexpected(f'"{{" after {text}')
        span = self.span(at - 1 if negated else at)
        return SortAtom(text[1:], arguments, negated, span, self.token_span(at))

    def refuse_foreign(self, expected: str) -> None:
        """Raises when the next token is a directive, or a word of another language."""
        word = self.texts[self.at]
        if word in _DIRECTIVES:
            raise self.unexpected(expected)
        if word in self.sorts:
            return
        if word in _OPTIMIZE:
            raise self.unexpected(expected, f"{word}{{…}}. is a statement of its own")
        if word in ("#show", "#hide"):
            hint = "what is shown goes into the section display, behind the rules"
            raise self.unexpected(expected, hint)
        if word in _FOREIGN:
            raise self.unexpected(expected, f"SPARC has no {word}")

    def naf(self) -> Naf:
        """``"not" (atom | sort_atom)``"""
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
                raise self.fault(
                    f'expected white space after "not", found {self.found(self.at)}',
                    self.at,
                    f"write not {self.texts[self.at]}",
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
            elif kind in _TERM_STARTS:
                hint = "a comparison cannot be negated: turn it round, < into >= and so on"
            raise self.unexpected('an atom after "not"', hint)
        if self.kinds[self.at] in _AFTER_TERM:
            raise self.unexpected(
                '"," or the end of the body',
                "a comparison cannot be negated: turn it round, < into >= and so on",
            )
        return Naf(operand, self.span(at))

    def comparison(self, aggregates: bool, first: int) -> Comparison | Aggregate:
        """``comparison = term relation term``, or an aggregate with a guard on the left."""
        self.at = first
        left = self.compound_term(False)
        relation = _RELATIONS.get(self.kinds[self.at])
        if relation is None:
            hint = None
            if self.texts[self.at] in _AGGREGATES:
                hint = "a guard needs a comparison: write 1 <= #count{…}"
            elif self.kinds[self.at] == "{":
                hint = "a choice {…} stands only in a head; to count in a body use #count"
            raise self.unexpected('a comparison such as "=" or "<"', hint)
        operator_at = self.at
        self.at += 1
        if self.texts[self.at] in _AGGREGATES and self.kinds[self.at + 1] == "{":
            guard = Guard(relation, left, self.span(first))
            return self.aggregate(guard, first, aggregates)
        right = self.compound_term(False)
        if self.kinds[self.at] in _RELATIONS:
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
        """``aggregate = [term relation] function "{" aggregate_element
        {";" aggregate_element} "}" [relation term]``
        """
        if not allowed:
            raise self.unexpected(
                "a literal", "an aggregate stands only in a body, not in a condition"
            )
        function = _AGGREGATES[self.texts[self.at]]
        self.at += 1
        elements: list[AggregateElement] = []
        while not elements or self.kinds[self.at] == ";":
            self.at += 1
            elements.append(self.aggregate_element())
        self.expect("}", '",", ";" or "}"')
        right = None
        at = self.at
        relation = _RELATIONS.get(self.kinds[at])
        if relation is not None:
            self.at += 1
            right = Guard(relation, self.compound_term(False), self.span(at))
        elif self.kinds[at] in _TERM_STARTS:
            raise self.unexpected(
                'a comparison, "," or "."', "a guard needs a comparison: #count{…} <= 2"
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
        """What to do about ``:-`` where ``:`` and an atom with ``-`` are meant."""
        return 'part ":" and "-": write ": -p"' if self.kinds[self.at] == ":-" else None

    # ------------------------------------------------------------ heads and statements

    def statements(self) -> tuple[Statement, ...]:
        """``rules = {statement}``"""
        found: list[Statement] = []
        kinds = self.kinds
        while kinds[self.at] not in ("end", "section"):
            found.append(self.statement())
        return tuple(found)

    def statement(self) -> Statement:
        """``statement = weak_constraint | optimize | range_fact | cr_rule | rule``"""
        at = self.at
        kind = self.kinds[at]
        text = self.texts[at]
        if kind == ":~":
            return self.weak_constraint()
        if text in _OPTIMIZE and (self.kinds[at + 1] == "{" or text not in self.sorts):
            return self.optimize()
        name = at + 1 if kind == "-" else at
        if (
            self.kinds[name + 3] == ".."
            and self.kinds[name + 1] == "("
            and self.kinds[name] == "identifier"
        ):
            return self.range_fact()
        label = None
        if kind == "identifier" and self.kinds[at + 1] == ":":
            label = text
            self.at += 2
        return self.rule(at, label)

    def rule(self, first: int, label: str | None) -> Rule | CrRule:
        """``rule = head [":-" body] "." | ":-" body "."``,
        ``cr_rule = [identifier ":"] head ":+" [body] "." | ":+" body "."``
        """
        head: Head = ()
        if label is not None or self.kinds[self.at] not in (":-", ":+"):
            head = self.head()
        kind = self.kinds[self.at]
        body: tuple[BodyItem, ...] = ()
        if kind == ":+" or (kind == ":-" and label is None):
            self.at += 1
            if kind == ":-" or not head or self.kinds[self.at] != ".":
                body = self.body()
            self.end_of_body()
            if kind == ":-":
                return Rule(head, body, self.span(first))
            label_span = self.token_span(first)
            return CrRule(label, head, body, self.span(first), label_span)
        if label is not None:
            raise self.unexpected(
                '":+"', "only a consistency-restoring rule has a label: r : head :+ body."
            )
        if kind != ".":
            raise self.after_head(head)
        self.at += 1
        return Rule(head, (), self.span(first))

    def end_of_body(self) -> None:
        """Reads the dot behind a body."""
        hint = None
        if self.kinds[self.at] == "(":
            hint = "a parenthesis stands only in arithmetic and behind a name"
        self.expect(".", '"," or "."', hint)

    def after_head(self, head: Head) -> SourceError:
        """The fault that a head goes on where it cannot."""
        kind, text = self.kinds[self.at], self.texts[self.at]
        expected, hint = '"|", ":-", ":+" or "."', None
        if isinstance(head, Choice):
            expected = '":-", ":+" or "."'
            if kind == "|":
                hint = "a choice cannot stand in a disjunction"
            elif kind in (",", ";"):
                hint = "a rule has one choice: write a rule for each"
        elif kind in (",", ";", "or") or (text == "v" and not self.on_new_line(self.at)):
            hint = 'the atoms of a disjunction are parted by "|"; '
            hint += "for several conclusions write a rule for each"
        elif kind in _AFTER_TERM:
            hint = "a comparison cannot be a head; to forbid its opposite write a constraint :- …"
        elif kind == ":":
            hint = "a label has no arguments; a condition stands only inside a choice"
        elif kind == "{":
            hint = "the bound of a choice is a number, a constant, a variable or arithmetic"
        return self.unexpected(expected, hint)

    def head(self) -> Head:
        """``head = choice | head_atom {"|" head_atom}``"""
        at = self.at
        kind = self.kinds[at]
        if kind == "{":
            return self.choice()
        if kind in ("variable", "number", "("):
            return self.choice()
        if kind == "identifier":
            following = self.kinds[at + 1]
            if following == "{" or following in _AFTER_TERM:
                return self.choice()
        atoms = [self.head_atom()]
        while self.kinds[self.at] == "|":
            self.at += 1
            atoms.append(self.head_atom())
        return tuple(atoms)

    def head_atom(self) -> Atom | SortAtom:
        """``head_atom = atom | sort_atom``; the checker refuses the sort atom."""
        at = self.at
        kind, text = self.kinds[at], self.texts[at]
        if kind == "identifier":
            return self.atom()
        if kind == "-":
            return self.negated()
        if kind == "sort name" and not (text in _AGGREGATES and self.kinds[at + 1] == "{"):
            self.refuse_foreign("a rule")
            return self.sort_atom(False)
        hint = None
        if kind == "sort name":
            hint = "an aggregate stands only in a body"
        elif kind == "not":
            hint = '"not" cannot stand in a head: move the literal into the body'
        elif kind == "{" and self.kinds[at - 1] == "|":
            hint = "a choice cannot stand in a disjunction"
        elif kind == "[":
            hint = "the weight of a weak constraint follows its dot: :~ body. [w:l]"
        elif kind == "#":
            hint = "write the name without space after #"
        raise self.unexpected("the head of a rule" if hint is None else "an atom", hint)

    def choice(self) -> Choice:
        """``choice = [term [relation]] "{" choice_element {";" choice_element} "}"
        [[relation] term]``; a bound without a relation means ``<=``
        """
        first = self.at
        left = None
        if self.kinds[first] != "{":
            bound = self.bound()
            relation = _RELATIONS.get(self.kinds[self.at])
            if relation is not None:
                self.at += 1
            if self.kinds[self.at] != "{":
                raise self.unexpected(
                    '"{" of a choice',
                    "a rule begins with an atom, a choice, or :-"
                    if relation is None
                    else "a comparison cannot be a head; write a constraint, :- X >= Y",
                )
            left = Guard(relation or "<=", bound, self.span(first))
        elements: list[ChoiceElement] = []
        while not elements or self.kinds[self.at] == ";":
            self.at += 1
            elements.append(self.choice_element())
        mend = self.touching_negation()
        if self.kinds[self.at] in (",", "|"):
            mend = 'part the elements of a choice by ";"'
        expected = '",", ";" or "}"' if elements[-1].condition else '":", ";" or "}"'
        self.expect("}", expected, mend)
        right = None
        at = self.at
        kind = self.kinds[at]
        relation = _RELATIONS.get(kind)
        if relation is not None:
            self.at += 1
            right = Guard(relation, self.bound(), self.span(at))
        elif kind in _TERM_STARTS:
            if kind == "identifier" and self.texts[at] not in self.constants:
                raise self.unexpected('a bound, ":-", ":+" or "."')
            right = Guard("<=", self.bound(), self.span(at))
        return Choice(tuple(elements), left, right, self.span(first))

    def bound(self) -> Term:
        """A term that may bound a choice."""
        first = self.at
        term = self.compound_term(False)
        if self.is_symbolic(term):
            span = self.span(first)
            self.raise_symbolic(
                _Operand(term, span.start, span.end, 1),
                "the bound of a choice is a number, a constant, a variable or arithmetic",
            )
        return term

    def choice_element(self) -> ChoiceElement:
        """``choice_element = head_atom [":" literals]``"""
        first = self.at
        if self.kinds[first] == "}":
            raise self.unexpected("an atom", "a choice has an element at least")
        atom = self.head_atom()
        condition: tuple[Literal, ...] = ()
        if self.kinds[self.at] == ":":
            self.at += 1
            condition = self.literals()
        return ChoiceElement(atom, condition, self.span(first))

    def range_fact(self) -> RangeFact:
        """``range_fact = ["-"] identifier "(" value ".." value ")" "."``"""
        first = self.at
        negated = self.kinds[first] == "-"
        if negated:
            if not self.touches_next(first):
                raise self.negation_apart(first)
            self.at += 1
        name = self.at
        self.at += 2
        low = self.value()
        self.at += 1
        hint = "there are no negative numbers in a range" if self.kinds[self.at] == "-" else None
        high = self.value(hint)
        if self.kinds[self.at] in _BINDING:
            hint = "the ends of a range are numbers or constants: work it out"
        elif self.kinds[self.at] == ",":
            hint = "only a predicate with one argument may have a range"
        self.expect(")", '")"', hint)
        hint = None
        if self.kinds[self.at] in (":-", ":+", "|", ","):
            hint = "a range stands only in a fact p(m..n). of its own; in a rule use a sort"
        self.expect(".", '"."', hint)
        text, span = self.texts[name], self.span(first)
        return RangeFact(text, low, high, negated, span, self.token_span(name))

    def negation_apart(self, at: int) -> SourceError:
        """The fault that ``-`` does not touch the name behind it."""
        word = self.texts[at + 1]
        return self.unexpected("an atom", f'write "-{word}" without a space after "-"')

    def weak_constraint(self) -> WeakConstraint:
        """``weak_constraint = ":~" body "." ["[" ([weight] ":" [level] | weight) "]"]``"""
        first = self.at
        self.at += 1
        body = self.body()
        self.end_of_body()
        weight = level = None
        if self.kinds[self.at] == "[":
            opened = self.at
            self.at += 1
            if self.kinds[self.at] not in (":", "]"):
                weight = self.parameter()
            if self.kinds[self.at] == ":":
                self.at += 1
                if self.kinds[self.at] != "]":
                    level = self.parameter()
            hint = None
            if self.kinds[self.at] == "@":
                hint = "weight and level are parted by a colon: [w:l]"
            elif self.kinds[self.at] in _BINDING:
                hint = "weight and level are single numbers, constants or variables"
            self.expect("]", '":" or "]"' if level is None else '"]"', hint)
            if weight is None and level is None:
                raise self.fault(
                    "expected a weight or a level between the brackets", opened, "write [1:1]"
                )
            if self.kinds[self.at] == ".":
                raise self.unexpected(
                    "the next rule", "the dot stands before the brackets: :~ body. [w:l]"
                )
        return WeakConstraint(body, weight, level, self.span(first))

    def parameter(self) -> Variable | Number | Identifier:
        """``parameter = variable | number | identifier``"""
        at = self.at
        if self.kinds[at] == "variable":
            return self.variable("a variable")
        if self.kinds[at] in ("number", "identifier") and self.kinds[at + 1] != "(":
            return self.value()
        hint = "there is no unary minus" if self.kinds[at] == "-" else None
        raise self.unexpected("a number, a constant or a variable", hint)

    def optimize(self) -> Optimize:
        """``optimize = ("#minimize" | "#maximize") "{" optimize_parameter
        {"," optimize_parameter} ":" atom {"," atom} "}" "."``,
        ``optimize_parameter = parameter ["@" value]``
        """
        first = self.at
        word = self.texts[first]
        self.at += 1
        if self.kinds[self.at] != "{":
            raise self.unexpected(f'"{{" after {word}')
        parameters: list[Term] = []
        priority, priority_index = None, 0
        while not parameters or self.kinds[self.at] == ",":
            self.at += 1
            if self.kinds[self.at] == ":":
                raise self.unexpected("a number, a constant or a variable")
            parameters.append(self.parameter())
            if self.kinds[self.at] == "@":
                if priority is not None:
                    raise self.unexpected('"," or ":"', "only one parameter has a priority")
                self.at += 1
                priority, priority_index = self.value(), len(parameters) - 1
        hint = self.touching_negation()
        if self.kinds[self.at] in _BINDING:
            hint = f"a parameter of {word} is a single number, constant or variable"
        elif self.kinds[self.at] in ("}", ";"):
            hint = f"the atoms that are counted follow a colon: {word}{{X : cost(X)}}."
        self.expect(":", '",", "@" or ":"', hint)
        atoms: list[Atom] = []
        while not atoms or self.kinds[self.at] == ",":
            if atoms:
                self.at += 1
            atoms.append(self.optimized_atom(word))
        hint = None
        if self.kinds[self.at] == ";":
            hint = f"{word} has one element: write a statement for each"
        elif self.kinds[self.at] in _AFTER_TERM:
            hint = f"there are no comparisons in {word}: define an atom by a rule"
        self.expect("}", '"," or "}"', hint)
        hint = None
        if self.kinds[self.at] == ":-":
            hint = f"{word} has no body: put the atoms behind the colon inside the braces"
        self.expect(".", '"."', hint)
        return Optimize(
            word == "#maximize",
            tuple(parameters),
            priority,
            tuple(atoms),
            self.span(first),
            priority_index,
        )

    def optimized_atom(self, word: str) -> Atom:
        """An atom inside ``#minimize`` or ``#maximize``."""
        kind = self.kinds[self.at]
        if kind == "identifier":
            return self.atom()
        if kind == "-" and self.kinds[self.at + 1] != "sort name":
            atom = self.negated()
            assert isinstance(atom, Atom)
            return atom
        raise self.unexpected(
            "an atom", f"{word} takes atoms only: define one by a rule and count it here"
        )

    # ------------------------------------------------------------ display

    def display(self) -> tuple[DisplayItem | DisplaySort, ...]:
        """``display_item = (["-"] identifier [arguments] | "#" identifier ["(" term ")"]) "."``"""
        found: list[DisplayItem | DisplaySort] = []
        while self.kinds[self.at] not in ("end", "section"):
            first = self.at
            kind = self.kinds[first]
            negated = kind == "-"
            if negated:
                if self.kinds[first + 1] == "identifier" and not self.touches_next(first):
                    raise self.negation_apart(first)
                self.at += 1
                kind = self.kinds[self.at]
            name = self.at
            is_sort = kind == "sort name" and not negated
            if kind != "identifier" and not is_sort:
                raise self.not_displayed(negated)
            text = self.texts[name]
            if is_sort:
                self.refuse_foreign("an item to display")
            self.at += 1
            arguments = self.arguments() if self.kinds[self.at] == "(" else None
            if is_sort and arguments is not None and len(arguments) != 1:
                raise SparcSyntaxError(
                    f"a sort has one argument, found {len(arguments)}",
                    self.span(name),
                    f"write {text}. or {text}(X).",
                )
            hint = None
            if self.kinds[self.at] == ",":
                hint = 'each item ends with "."'
            elif self.kinds[self.at] in ("/", ":-"):
                hint = f"write {text}. to show all of it"
            self.expect(".", '"."' if arguments is not None else '"(" or "."', hint)
            span, name_span = self.span(first), self.token_span(name)
            if is_sort:
                argument = arguments[0] if arguments else None
                found.append(DisplaySort(text[1:], argument, span, name_span))
            else:
                found.append(DisplayItem(text, arguments, negated, span, name_span))
        return tuple(found)

    def not_displayed(self, negated: bool) -> SourceError:
        """The fault that something cannot be displayed."""
        hint = None
        if negated and self.kinds[self.at] == "sort name":
            hint = "a sort has no negation"
        elif self.kinds[self.at] == "not":
            hint = "write -p to show the negative literals"
        elif self.kinds[self.at] == ":-":
            hint = "rules stand before the section display"
        return self.unexpected("a predicate or a sort to display", hint)
