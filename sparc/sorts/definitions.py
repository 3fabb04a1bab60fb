"""Evaluates the sort definitions of a program: SortDefinition → Sort, with `SortTable`.

Arrow: `SortExpression` → `Extent`, by `SortTable.define` one definition at a time; every fault is
a `SortError` at its place.  A sort whose definition is faulty is known but has no extent, so that
one mistake is reported once.

>>> from sparc.source import Source
>>> from sparc.syntax.parser import parse
>>> program = parse(Source("x", "sorts #a = 1..3. #b = #a - {2}. predicates rules "))
>>> table = SortTable({}, 2000)
>>> for definition in program.sorts:
...     table.define(definition)
>>> list(table.sorts["b"].extent)
[1, 3]

Follows the SPARC manual (Balai, Gelfond, Zhang 2013), "Sort definitions", forms 1 to 6.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

from sparc.errors import LimitError, SortError, SourceError
from sparc.sorts.extents import (
    MAX_DEPTH,
    MAX_LISTED,
    Extent,
    IdentifierInterval,
    Interval,
    Listed,
    Records,
    Sort,
    Strings,
)
from sparc.sorts.set_operations import Difference, Intersection, Union
from sparc.sorts.values import Value, is_identifier, text
from sparc.source import Span
from sparc.spelling import nearest
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import (
    And,
    Concatenation,
    Condition,
    ConditionTest,
    Identifier,
    IdentifierList,
    IdentifierRange,
    Not,
    Number,
    NumericRange,
    Record,
    RecordSort,
    SetExpression,
    SortDefinition,
    SortExpression,
    SortName,
    Term,
    TermSet,
)

__all__ = ["BUILT_IN", "SortTable"]

BUILT_IN = "nat"
"""The sort of the numbers from 0 to ``#maxint``."""


class SortTable:
    """The sorts of a program by name, filled in the order of the text.

    ``faulty`` are the names whose definition was refused; ``errors`` says why, in the order of
    the text.  ``asked`` is what all sorts note in that they were looked into.
    """

    def __init__(self, constants: Mapping[str, int], maxint: int) -> None:
        self.constants = constants
        self.asked: set[str] = set()
        self.sorts: dict[str, Sort] = {
            BUILT_IN: Sort(BUILT_IN, Interval(0, maxint), None, self.asked)
        }
        self.faulty: set[str] = set()
        self.errors: list[SourceError] = []
        self.later: dict[str, Span] = {}

    def define_all(self, definitions: tuple[SortDefinition, ...]) -> None:
        """Defines all sorts, one after the other."""
        self.later = {definition.name: definition.name_span for definition in definitions}
        for definition in definitions:
            self.define(definition)

    def define(self, definition: SortDefinition) -> None:
        """Adds one sort; faults go to ``errors``."""
        name = definition.name
        place = definition.name_span
        if name == BUILT_IN:
            self.errors.append(SortError("#nat is built in and cannot be defined", place,
                                         "give the sort another name, or set #maxint"))  # fmt: skip
            return
        known = self.sorts.get(name)
        if known is not None or name in self.faulty:
            self.errors.append(SortError(f"sort #{name} is defined twice", place,
                                         _first_at(known)))  # fmt: skip
            return
        found = len(self.errors)
        try:
            extent = self._extent(definition.expression)
        except SourceError as error:
            error.span = error.span or place
            self.errors.append(error)
            extent = None
        if extent is None or len(self.errors) > found:
            self.faulty.add(name)
            return
        try:
            self._measure(extent, name, definition)
        except SourceError as error:
            self.faulty.add(name)
            self.errors.append(error)
            return
        self.sorts[name] = Sort(name, extent, place, self.asked)

    def _measure(self, extent: Extent, name: str, definition: SortDefinition) -> None:
        """Refuses a sort that is empty, or built on others too deeply."""
        if extent.depth > MAX_DEPTH:
            raise LimitError(
                f"sort #{name} is built on other sorts more than {MAX_DEPTH} levels deep",
                definition.name_span,
                "list the elements of some of them in sets",
            )
        try:
            empty = extent.is_empty()
        except LimitError as error:
            raise LimitError(f"sort #{name}: {error.message}", definition.name_span) from None
        if empty:
            raise SortError(
                f"sort #{name} is empty", definition.name_span, "a sort needs at least one element"
            )

    def named(self, name: str, span: Span) -> Sort | None:
        """Returns the sort with this name.

        None (and an error, unless one was given) when there is none.
        """
        sort = self.sorts.get(name)
        self.asked.add(name)
        if sort is None and name not in self.faulty:
            later = self.later.get(name)
            if later is not None and later.start > span.start:
                hint: str | None = (
                    f"#{name} is defined at line {later.location.line}:"
                    " define it above the place where it is used"
                )
            else:
                hint = self.hint(name)
            self.errors.append(SortError(f"unknown sort #{name}", span, hint))
        return sort

    def hint(self, name: str) -> str | None:
        """Returns the sort that may have been meant."""
        near = nearest(name, [*self.sorts, *self.faulty])
        if near is None:
            return "define it in the section sorts" if not self.sorts.get(name) else None
        span = self.sorts[near].span if near in self.sorts else None
        return f"did you mean #{near}" + (
            f" (declared at line {span.location.line})?" if span is not None else "?"
        )

    # -------------------------------------------------------------- one method per form

    def _extent(self, expression: SortExpression) -> Extent | None:
        """Returns the extent of an expression, None when a part of it has none."""
        match expression:
            case SortName():
                sort = self.named(expression.name, expression.span)
                return None if sort is None else sort.extent
            case NumericRange():
                return self._numeric_range(expression)
            case IdentifierRange():
                return self._substituted(_identifier_range(expression))
            case TermSet():
                return Listed([self._element(term) for term in expression.terms])
            case RecordSort():
                return self._record(expression)
            case SetExpression():
                return self._set_expression(expression)
            case Concatenation():
                return self._concatenation(expression)

    def _numeric_range(self, expression: NumericRange) -> Extent:
        """Form 1: ``low..high`` with ``low <= high``."""
        low, high = self.number(expression.low), self.number(expression.high)
        if low > high:
            raise SortError(
                f"the range {low}..{high} ends before it begins",
                expression.high.span,
                f"write {high}..{low}",
            )
        return Interval(low, high)

    def number(self, term: Number | Identifier) -> int:
        """Returns the value of a bound; raises `SortError` when its constant is unknown."""
        if isinstance(term, Number):
            return term.value
        value = self.constants.get(term.name)
        if value is None:
            near = nearest(term.name, self.constants)
            raise SortError(
                f"unknown constant {term.name}",
                term.span,
                f"did you mean {near}?" if near else f"define it: #const {term.name} = 3.",
            )
        return value

    def _substituted(self, extent: Extent) -> Extent:
        """Returns the extent with each name of a constant replaced by its value."""
        if not any(name in extent for name in self.constants):
            return extent
        return Listed(
            self.constants.get(value, value) if type(value) is str else value
            for value in islice(extent, MAX_LISTED)
        )

    def _element(self, term: Term) -> Value:
        """Form 3: a ground term of a set, its constants replaced by their values."""
        match term:
            case Number(value):
                return value
            case Identifier(name):
                if name == "not":
                    raise SortError("not is a reserved word, no element of a sort", term.span)
                return self.constants.get(name, name)
            case Record(name, arguments):
                return (name, *map(self._element, arguments))
            case _:
                raise SortError(
                    "the elements of a set are ground terms without arithmetic", term.span
                )

    def _record(self, expression: RecordSort) -> Extent | None:
        """Form 4: ``f(#s(X),#t(Y)) : condition``."""
        sorts: list[Sort] = []
        places: dict[str, int] = {}
        complete = True
        for index, argument in enumerate(expression.arguments):
            sort = self.named(argument.sort.name, argument.sort.span)
            if sort is None:
                complete = False
            else:
                sorts.append(sort)
            variable = argument.variable
            if variable is None:
                continue
            if variable.name in places:
                raise SortError(
                    f"variable {variable.name} stands twice in the record {expression.name}",
                    variable.span,
                    "give each argument a variable of its own and compare them: X = Y",
                )
            places[variable.name] = index
        if expression.condition is not None:
            _check_condition(
                expression.condition, expression.name, places, sorts if complete else []
            )
        if not complete:
            return None
        return Records(expression.name, tuple(sorts), expression.condition, tuple(places.items()))

    def _set_expression(self, expression: SetExpression) -> Extent | None:
        """Form 6: union, difference and intersection."""
        left, right = self._extent(expression.left), self._extent(expression.right)
        if left is None or right is None:
            return None
        if expression.operator == "-":
            return Difference(left, right)
        if expression.operator == "*":
            return Intersection(left, right)
        # A union in the making is spread out, a named one stays one part.
        if isinstance(expression.left, SetExpression) and isinstance(left, Union):
            return Union((*left.parts, right))
        return Union((left, right))

    def _concatenation(self, expression: Concatenation) -> Extent | None:
        """Form 5: ``[b][1..3]``; every string must be an identifier or a number."""
        parts: list[Extent] = []
        for part in expression.parts:
            extent: Extent | None
            match part:
                case SortName():
                    extent = self._extent(part)
                    if extent is None:
                        return None
                    if not extent.basic:
                        raise SortError(
                            f"sort #{part.name} has records, which cannot be joined to strings",
                            part.span,
                            "use a sort of identifiers or numbers",
                        )
                case IdentifierList(names):
                    extent = Listed([self._part_name(name) for name in names])
                case NumericRange():
                    extent = self._numeric_range(part)
                case IdentifierRange():
                    extent = _identifier_range(part)
            parts.append(extent)
        if len(parts) == 1:
            return self._substituted(parts[0])
        whole = Strings(tuple(parts))
        _check_strings(whole, expression)
        return self._substituted(whole)

    def _part_name(self, name: Identifier) -> str:
        if name.name == "not":
            raise SortError("not is a reserved word, no element of a sort", name.span)
        return name.name


def _first_at(sort: Sort | None) -> str | None:
    if sort is None or sort.span is None:
        return None
    return f"the first definition is at line {sort.span.location.line}"


def _check_condition(
    condition: Condition, record: str, places: Mapping[str, int], sorts: list[Sort]
) -> None:
    """Checks that variables are the record's, and that only elements of basic sorts are ordered."""
    if isinstance(condition, Not):
        _check_condition(condition.operand, record, places, sorts)
    elif isinstance(condition, ConditionTest):
        for variable in (condition.left, condition.right):
            if variable.name not in places:
                raise SortError(
                    f"the condition of the record {record} has an unknown variable {variable.name}",
                    variable.span,
                    f"give it to an argument: #s({variable.name})",
                )
            if condition.operator in ("=", "!=") or not sorts:
                continue
            sort = sorts[places[variable.name]]
            if not sort.extent.basic:
                raise SortError(
                    f"{condition.operator} cannot compare elements of #{sort.name}: it has records",
                    condition.span,
                    "records can be compared by = and != only",
                )
    elif isinstance(condition, And):
        for operand in condition.operands:
            _check_condition(operand, record, places, sorts)
    else:
        for operand in condition.operands:
            _check_condition(operand, record, places, sorts)


def _identifier_range(expression: IdentifierRange) -> Extent:
    """Form 2: ``first..last``, two identifiers of one length, in order.

    The last character counts up; at ``z`` it starts again at ``a`` and the one before it counts.
    """
    first, last = expression.first.name, expression.last.name
    if len(first) != len(last):
        longer = "longer" if len(first) > len(last) else "shorter"
        raise SortError(
            f"the range {first}..{last} has ends of different length",
            expression.first.span,
            f"{first} is {longer} than {last}: unite two ranges, each with ends of one length",
        )
    if first > last:
        raise SortError(
            f"the range {first}..{last} ends before it begins",
            expression.first.span,
            f"write {last}..{first}",
        )
    if first.isalpha() and last.isalpha() and first.islower() and last.islower():
        return IdentifierInterval(first, last)
    words = [first]
    word = first
    while word != last:
        kept = word.rstrip("z")
        word = kept and kept[:-1] + chr(ord(kept[-1]) + 1) + "a" * (len(word) - len(kept))
        if not is_identifier(word) or word > last or len(words) > MAX_LISTED:
            raise SortError(
                f"counting up from {first} does not lead to {last}",
                expression.span,
                f"after {words[-1]} comes no identifier: write the elements as a set {{…}}",
            )
        words.append(word)
    return Listed(word for word in words if word != "not")


def _check_strings(whole: Strings, expression: Concatenation) -> None:
    """Refuses strings that are neither identifier nor number."""
    first, rest = whole.parts[0], whole.parts[1:]
    if "not" in whole:
        raise SortError("not is a reserved word, no element of a sort", expression.span)
    if not first.has_number():
        return
    for part in rest:
        other = None
        if not isinstance(part, Interval):
            values = islice(part, MAX_LISTED)
            other = next((value for value in values if type(value) is not int), None)
        if other is not None:
            number = next(value for value in first if type(value) is int)
            raise SortError(
                f'"{number}{text(other)}…" is neither an identifier nor a number'
                if len(rest) > 1
                else f'"{number}{text(other)}" is neither an identifier nor a number',
                expression.span,
                "begin the string with a letter",
            )
    if 0 in first:
        raise SortError(
            "a number of several digits cannot begin with 0", expression.span, "begin it with 1..9"
        )
    digits = sum(len(str(_largest(part))) for part in whole.parts)
    if digits >= len(str(MAX_NUMBER)):
        raise LimitError(f"numbers beyond {MAX_NUMBER} cannot be handled", expression.span)


def _largest(part: Extent) -> int:
    if isinstance(part, Interval):
        return part.high
    return max(value for value in part if type(value) is int)
