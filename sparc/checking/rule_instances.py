"""Searches the sorts for an instance of a rule: the demands on its variables, and values that meet them.

Entry point `InstanceSearch`.  The sorts alone are looked at, within a budget; a rule on which it runs
out is taken for a good one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import islice

from sparc.checking.typed_program import (
    TypedProgram,
    Undefined,
    apply_operator,
    has_arithmetic,
    is_ground,
    variables,
)
from sparc.errors import LimitError, SparcWarning
from sparc.sorts.extents import Records, Sort, every
from sparc.sorts.set_operations import Intersection
from sparc.sorts.values import Value
from sparc.source import Span
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    Head,
    Identifier,
    Naf,
    Number,
    RangeFact,
    Record,
    SortAtom,
    Statement,
    Term,
    Variable,
)

__all__ = ["Demands", "Impossible", "InstanceSearch", "terms_of", "value_of"]

_BUDGET = 20_000  # assignments tried for one rule
_MOST_VARIABLES = 40
_OUTCOMES = {"=": ", so this never holds", "!=": ", so this always holds"}

Environment = dict[str, Value]


def terms_of(head: Head, body: Iterable[BodyItem]) -> Iterator[Term]:
    """Yields the arguments of all atoms and comparisons of a rule."""
    for item in (*(head.elements if isinstance(head, Choice) else head), *body):
        if isinstance(item, ChoiceElement):
            yield from terms_of((item.atom,), item.condition)
        elif isinstance(item, Aggregate):
            for element in item.elements:
                yield from element.terms
                yield from terms_of((), element.condition)
        elif isinstance(item, Comparison):
            yield item.left
            yield item.right
        else:
            atom = item.operand if isinstance(item, Naf) else item
            yield from atom.arguments


@dataclass
class Demands:
    """The conditions on an instance: a sort for each variable, and tests over several."""

    domains: dict[str, list[Sort]] = field(default_factory=dict)
    tests: list[tuple[frozenset[str], Callable[[Environment], bool]]] = field(default_factory=list)


class Impossible(Exception):
    """No instance can fulfil the demands; the message says why."""

    def __init__(self, message: str, span: Span | None, hint: str | None = None) -> None:
        super().__init__(message)
        self.span = span
        self.hint = hint


class InstanceSearch:
    def __init__(self, typed: TypedProgram) -> None:
        self.typed = typed
        self.constants = typed.constants
        self.naturals: set[str] = set()
        self._listed: dict[tuple[int, ...], list[Value] | None] = {}
        self._boxes: dict[tuple[str, str, int], tuple[Records, ...] | None] = {}

    def empty_range(self, fact: RangeFact) -> Iterator[SparcWarning]:
        """Yields a range that ends before it begins."""
        low, high = value_of(fact.low, {}, self.constants), value_of(fact.high, {}, self.constants)
        if isinstance(low, int) and isinstance(high, int) and low > high:
            yield SparcWarning(
                f"the range {low}..{high} ends before it begins, so this fact says nothing",
                fact.high.span,
                f"write {high}..{low}, or leave the fact out",
            )

    def unknown_names(self, body: Iterable[BodyItem]) -> Iterator[SparcWarning]:
        """Comparisons with an identifier that no sort has."""
        for item in body:
            if isinstance(item, Aggregate):
                for element in item.elements:
                    yield from self.unknown_names(element.condition)
            if not isinstance(item, Comparison):
                continue
            for term in (item.left, item.right):
                if not isinstance(term, Identifier) or term.name in self.constants:
                    continue
                if not any(term.name in sort.extent for sort in every(self.typed.sorts)):
                    yield SparcWarning(
                        f"{term.name} is no element of any sort" + _OUTCOMES.get(item.operator, ""),
                        term.span,
                        "compare with an element of a sort, or define a constant",
                    )

    def empty_parts(
        self, statement: Statement, head: Head, body: tuple[BodyItem, ...]
    ) -> Iterator[SparcWarning]:
        """Yields the rule, or elements in it, that have no instance."""
        wrong = self.impossible(head, body)
        if wrong is not None:
            yield SparcWarning(
                f"this rule has no instance: {wrong}", wrong.span or statement.span, wrong.hint
            )
            return
        elements: list[ChoiceElement | AggregateElement] = []
        if isinstance(head, Choice):
            elements += head.elements
        for item in body:
            if isinstance(item, Aggregate):
                elements += item.elements
        if not elements:
            return
        outside = terms_of(
            () if isinstance(head, Choice) else head,
            [item for item in body if not isinstance(item, Aggregate)],
        )
        outer = {each.name for each in variables(outside)}
        for element in elements:
            atoms = () if isinstance(head, Choice) else head
            if isinstance(element, ChoiceElement):
                atoms = (element.atom,)
            elif any(isinstance(term, Variable) and term.name in outer for term in element.terms):
                continue  # these variables have two meanings in the rule
            wrong = self.impossible(atoms, (*body, *element.condition))
            if wrong is not None:
                yield SparcWarning(
                    f"this element has no instance: {wrong}",
                    wrong.span or element.span,
                    wrong.hint,
                )

    def impossible(self, head: Head, body: Iterable[BodyItem]) -> Impossible | None:
        """Returns why there is no instance; None when there is one, or the search was given up."""
        demands = Demands()
        try:
            for item in (*(() if isinstance(head, Choice) else head), *body):
                self.demand(item, demands)
            self.look(demands)
        except Impossible as reason:
            return reason
        except LimitError:
            return None
        return None

    def demand(self, item: Atom | SortAtom | BodyItem, demands: Demands) -> None:
        """Adds what one literal asks for."""
        positive = True
        if isinstance(item, Naf):
            positive = isinstance(item.operand, Atom)
            item = item.operand
        if isinstance(item, Atom):
            for term, sort in zip(
                item.arguments, self.typed.predicates[item.name].sorts, strict=True
            ):
                self.belongs(term, sort, demands, item.span)
        elif isinstance(item, SortAtom):
            (term,) = item.arguments
            sort = self.typed.sorts[item.name]
            if positive:
                self.belongs(term, sort, demands, item.span)
            else:
                self.test(demands, (term,), lambda values: values[0] not in sort.extent)
        elif isinstance(item, Comparison):
            operator = item.operator
            self.test(
                demands,
                (item.left, item.right),
                lambda values: _compare(values[0], operator, values[1]),
            )

    def belongs(self, term: Term, sort: Sort, demands: Demands, span: Span) -> None:
        """``term`` must lie in ``sort``."""
        if isinstance(term, Variable):
            if term.name != "_":
                demands.domains.setdefault(term.name, []).append(sort)
            return
        if isinstance(term, Record) and not is_ground(term):
            boxes = self.boxes(sort, term.name, len(term.arguments))
            if boxes == ():
                raise Impossible(
                    f"#{sort.name} has no record {term.name} with {len(term.arguments)}"
                    f" argument{'s' * (len(term.arguments) != 1)}",
                    term.span or span,
                )
            if boxes is not None and len(boxes) == 1:
                for part, inner in zip(term.arguments, boxes[0].arguments, strict=True):
                    self.belongs(part, inner, demands, span)
                if boxes[0].condition is None:
                    return
        if is_ground(term) and not has_arithmetic(term) and not isinstance(term, Arithmetic):
            value = value_of(term, {}, self.constants)
            if value is not None and value not in sort.extent:
                raise Impossible(f"{_shown(term)} is not in #{sort.name}", term.span or span)
            return
        self.test(demands, (term,), lambda values: values[0] in sort.extent)

    def boxes(self, sort: Sort, name: str, arity: int) -> tuple[Records, ...] | None:
        """Returns the records of that name in a sort, looked up once."""
        extent = sort.extent
        key = (sort.name, name, arity)
        if key not in self._boxes:
            self._boxes[key] = extent.boxes(name, arity)
        return self._boxes[key]

    def test(
        self,
        demands: Demands,
        terms: tuple[Term, ...],
        holds: Callable[[list[Value]], bool],
    ) -> None:
        """Adds a test over the values of some terms; arithmetic without a value fails it."""
        names = {each.name for each in variables(terms)}
        if "_" in names:
            return
        constants = self.constants

        def run(environment: Environment) -> bool:
            values: list[Value] = []
            for term in terms:
                value = value_of(term, environment, constants)
                if value is None:
                    return False
                values.append(value)
            return holds(values)

        demands.tests.append((frozenset(names), run))

    def look(self, demands: Demands) -> None:
        """Raises `Impossible` when some variables that belong together have no values."""
        nat = self.typed.sorts["nat"]
        tested = set().union(*(names for names, _ in demands.tests))
        for name in (tested - demands.domains.keys()) & self.naturals:
            demands.domains[name] = [nat]
        budget = [_BUDGET]
        candidates: dict[str, list[Value] | None] = {}
        for name, sorts in demands.domains.items():
            candidates[name] = self.candidates(name, sorts, name in tested)
        for names in _components(demands):
            tests = [(needed, run) for needed, run in demands.tests if needed <= names]
            if not tests or len(names) > _MOST_VARIABLES:
                continue
            order = sorted(names, key=lambda name: len(candidates.get(name) or ()))
            if any(candidates.get(name) is None for name in order):
                continue  # a large sort, or a variable inside a record that only clingo knows
            if not _solvable(order, candidates, tests, budget):
                who = ", ".join(sorted(names))
                raise Impossible(
                    f"no values of {who} in their sorts pass its comparisons and arithmetic"
                    if names
                    else "its comparisons are false",
                    None,
                )

    def candidates(self, name: str, sorts: list[Sort], needed: bool) -> list[Value] | None:
        """Returns the values of a variable, the first and the last one in front: nearly any test
        is passed by one of them.  None when they are too many to look at.
        """
        if not needed and len({sort.name for sort in sorts}) == 1:
            return []
        distinct = list({id(sort.extent): sort for sort in sorts}.values())
        extent = distinct[0].extent
        for sort in distinct[1:]:
            extent = Intersection(extent, sort.extent)
        if len(distinct) > 1 and extent.is_empty():
            shared = " and in ".join(
                "#" + sort.name for sort in sorted(distinct, key=lambda sort: sort.name)[::-1]
            )
            raise Impossible(f"{name} would have to be in {shared}, which share no element", None)
        if not needed:
            return []
        key = tuple(sorted(id(sort.extent) for sort in distinct))
        if key not in self._listed:
            many = extent.bound() > _BUDGET
            values = [] if many else list(islice(extent, _BUDGET))
            self._listed[key] = None if many else [*values[:1], *values[1:][-1:], *values[1:-1]]
        return self._listed[key]


def _components(demands: Demands) -> list[set[str]]:
    """Returns the variables in groups that tests tie together; a test without variables is a group."""
    groups: list[set[str]] = []
    for names, _ in demands.tests:
        touching = [group for group in groups if group & names]
        merged = set(names).union(*touching)
        groups = [group for group in groups if group not in touching]
        groups.append(merged)
    return groups


def _solvable(
    order: list[str],
    candidates: Mapping[str, list[Value] | None],
    tests: list[tuple[frozenset[str], Callable[[Environment], bool]]],
    budget: list[int],
) -> bool:
    """Returns whether some values pass all tests; True also when the budget runs out."""
    position = {name: index for index, name in enumerate(order)}
    due: list[list[Callable[[Environment], bool]]] = [[] for _ in order]
    environment: Environment = {}
    for names, run in tests:
        if names:
            due[max(position[name] for name in names)].append(run)
        elif not run(environment):
            return False

    def extend(depth: int) -> bool:
        if depth == len(order):
            return True
        for value in candidates[order[depth]] or ():
            budget[0] -= 1
            if budget[0] < 0:
                return True
            environment[order[depth]] = value
            if all(run(environment) for run in due[depth]) and extend(depth + 1):
                return True
        return False

    return extend(0)


def value_of(term: Term, environment: Environment, constants: Mapping[str, int]) -> Value | None:
    """Returns the value of a term, None when its arithmetic has none."""
    if isinstance(term, Variable):
        return environment.get(term.name)
    if isinstance(term, Number):
        return term.value
    if isinstance(term, Identifier):
        return constants.get(term.name, term.name)
    if isinstance(term, Record):
        values: list[Value] = [term.name]
        for part in term.arguments:
            value = value_of(part, environment, constants)
            if value is None:
                return None
            values.append(value)
        return tuple(values)
    left = value_of(term.left, environment, constants)
    right = value_of(term.right, environment, constants)
    if type(left) is not int or type(right) is not int:
        return None
    try:
        return apply_operator(term.operator, left, right, term.span)
    except Undefined:
        return None


def _compare(left: Value, operator: str, right: Value) -> bool:
    """Returns the result of a comparison by clingo's order: numbers before
    identifiers before records.
    """
    if operator in ("=", "!="):
        return (left == right) == (operator == "=")
    first, second = _rank(left), _rank(right)
    if operator in ("<", "<="):
        return first < second or (operator == "<=" and first == second)
    return first > second or (operator == ">=" and first == second)


def _rank(value: Value) -> tuple[object, ...]:
    if type(value) is int:
        return (0, value)
    if type(value) is tuple:
        return (len(value), str(value[0]), *map(_rank, value[1:]))
    return (1, str(value))


def _shown(term: Term) -> str:
    return " ".join(term.span.text.split()) if term.span is not None else "a term"
