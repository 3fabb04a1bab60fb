"""The text of heads and bodies for clingo, with the guards that they need: class `Literals`.

One statement at a time: `Literals.index` is its number; guards gather in ``guards``, and ``derived``
has the predicates that some head derives.  `sparc.translate` builds on it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sparc.checking.number_ranges import Range, fits
from sparc.checking.typed_program import TypedProgram, variables
from sparc.errors import NumberError
from sparc.sorts.extents import Extent
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.tree import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    CrRule,
    Guard,
    Head,
    Literal,
    Naf,
    Optimize,
    Record,
    Rule,
    SortAtom,
    Term,
    Variable,
    WeakConstraint,
)
from sparc.translation.guards import Guards, NoInstance, is_anonymous

__all__ = ["Literals", "global_names"]

_MOST_TUPLES = 100_000_000  # more instances of one element fill any memory before they are added up

Element = ChoiceElement | AggregateElement


class Literals(Guards):
    """Heads, literals, aggregates and choices; ``predicates`` has the sorts of each position."""

    def __init__(self, typed: TypedProgram) -> None:
        super().__init__(typed)
        self.predicates = {
            name: tuple([sort.extent for sort in signature.sorts])
            for name, signature in typed.predicates.items()
        }
        self.derived: set[tuple[str, int, bool]] = set()
        self.index = -1
        self.element: tuple[int, Element] | None = None  # the one being written, and its number
        self._said: tuple[object, dict[str, list[Range]]] = (None, {})
        self._said_inside: tuple[object, dict[str, list[Range]]] = (None, {})

    # ------------------------------------------------------------ heads and bodies

    def head(self, head: Head) -> str:
        """Returns the text of a head; its guards go to ``guards``."""
        if type(head) is tuple:
            if len(head) == 1:
                return self.guarded(head[0], derives=True)
            return "|".join([self.guarded(atom, derives=True) for atom in head])
        assert isinstance(head, Choice)
        elements = []
        for number, element in enumerate(head.elements, 1):
            shown = self.choice_element(element, number)
            if shown is not None:
                elements.append(shown)
        return self.bounded("{" + ";".join(elements) + "}", head.left, head.right)

    def bounded(self, inner: str, left: Guard | None, right: Guard | None) -> str:
        """``left inner right``"""
        if left is not None:
            inner = f"{self.bound(left.bound)}{left.operator}{inner}"
        if right is not None:
            inner = f"{inner}{right.operator}{self.bound(right.bound)}"
        return inner

    def bound(self, term: Term) -> str:
        """Returns the bound of an aggregate; one that may leave 32 bits is no number then."""
        if type(term) is Arithmetic:
            shown, reach = self.arithmetic(term)
            return f"@bound({shown})" if reach.checked else shown
        return self.term(term)

    def body(self, body: tuple[BodyItem, ...], head: Head) -> list[str]:
        """Returns the literals of a body in their order; guards go to ``guards``.

        Positive literals and sort atoms come first: what they say about variables saves guards.
        """
        parts: list[str] = []
        later: list[tuple[int, BodyItem]] = []
        aggregates = False
        for item in body:
            if type(item) is Atom:
                parts.append(self.positive(item))
            else:
                later.append((len(parts), item))
                parts.append("")
                if type(item) is Aggregate:
                    aggregates = True
        gaps = False
        for at, item in later:
            if type(item) is SortAtom:
                parts[at] = self.literal(item)
                gaps = True
        for at, item in later:
            if type(item) is not Aggregate and type(item) is not SortAtom:
                parts[at] = self.literal(item)
                gaps = gaps or not parts[at]
        if self.typed.naturals:
            self.naturals(0)
        if aggregates:
            # What the head's guards say about variables holds in the aggregates too, but they
            # come later; an aggregate does not need them.
            names = set(global_names(head, body))
            number = 1 + (len(head.elements) if isinstance(head, Choice) else 0)
            for at, item in later:
                if isinstance(item, Aggregate):
                    parts[at] = self.aggregate(item, number, names)
                    number += len(item.elements)
                    gaps = gaps or not parts[at]
        return [part for part in parts if part] if gaps else parts

    def literal(self, item: BodyItem) -> str:
        """Returns a literal other than a positive atom; empty when a guard says it all."""
        kind = type(item)
        if kind is Naf:
            operand = item.operand  # type: ignore[union-attr]
            if type(operand) is Atom:
                return "not " + self.guarded(operand)
            assert isinstance(operand, SortAtom)
            extent = self.typed.sorts[operand.name].extent
            value = self.value(operand.arguments[0])
            if value is not None:
                if value in extent:
                    raise NoInstance
                return ""
            return f"not {self.facts.key(extent)}({self.term(operand.arguments[0])})"
        if kind is Comparison:
            assert isinstance(item, Comparison)
            left, right = self.term(item.left), self.term(item.right)
            if "@" in left + right and item.operator not in ("=", "!="):
                return f"@order({left},{right}){item.operator}0"
            return f"{left}{item.operator}{right}"
        assert isinstance(item, SortAtom)
        self.require(item.arguments[0], self.typed.sorts[item.name].extent)
        return ""

    def positive(self, atom: Atom) -> str:
        """Returns a positive atom of a body: what it says about its variables is kept in ``known``."""
        name = "-" + atom.name if atom.negated else atom.name
        if not atom.arguments:
            return name
        words = []
        known = self.known
        for term, extent in zip(atom.arguments, self.predicates[atom.name], strict=True):
            if type(term) is Variable and not self.renamed and not self.named and term.name != "_":
                word = term.name
                known[word] = (*known.get(word, ()), extent)
                words.append(word)
            else:
                words.append(self.learn(term, extent))
        return f"{name}({','.join(words)})"

    def guarded(self, atom: Atom | SortAtom, *, derives: bool = False) -> str:
        """Returns an atom whose arguments must be kept inside their sorts."""
        assert isinstance(atom, Atom)
        name = "-" + atom.name if atom.negated else atom.name
        if derives:
            self.derived.add((atom.name, len(atom.arguments), atom.negated))
        if not atom.arguments:
            return name
        require = self.require
        words = [
            require(term, extent)
            for term, extent in zip(atom.arguments, self.predicates[atom.name], strict=True)
        ]
        return f"{name}({','.join(words)})"

    def naturals(self, scope: int) -> None:
        """Guards for the variables that occur in arithmetic only."""
        for name in sorted(self.typed.naturals.get((self.index, scope), ())):
            self.require(Variable(name), self.typed.sorts["nat"].extent)

    # ------------------------------------------------------------ elements

    def choice_element(self, element: ChoiceElement, number: int) -> str | None:
        """``atom : condition``; None when it has no instance."""
        outer = self.known, self.guards
        self.known, self.guards = dict(self.known), []
        self.element = number, element
        try:
            condition = self.condition(element.condition, number)
            shown = self.guarded(element.atom, derives=True)
            condition += self.guards
        except NoInstance:
            return None
        finally:
            self.known, self.guards = outer
            self.element = None
        return f"{shown}: {','.join(condition)}" if condition else shown

    def aggregate(self, aggregate: Aggregate, number: int, names: set[str]) -> str:
        """``left #count{…} right``; without guards it is true."""
        if aggregate.left is None and aggregate.right is None:
            return ""
        written = [
            self.aggregate_element(element, number + offset, names, aggregate.function)
            for offset, element in enumerate(aggregate.elements)
        ]
        parts = [element for element in written if element is not None]
        counted = sum(most for _, _, most in parts) > MAX_NUMBER
        place = self.place(aggregate.span) if counted else 0
        elements = []
        for terms, condition, _ in parts:
            if counted:
                condition.append(self.total(place, self.group(aggregate, names), terms))
            elements.append(f"{terms}: {','.join(condition)}")
        inner = f"#{aggregate.function}{{{';'.join(elements)}}}"
        return self.bounded(inner, aggregate.left, aggregate.right)

    def aggregate_element(
        self, element: AggregateElement, number: int, names: set[str], function: str
    ) -> tuple[str, list[str], int] | None:
        """``t1,…,tk : condition`` in parts; the variables of the tuple are its own.

        With them the most that the element can add to a sum.
        """
        outer = self.known, self.guards
        self.known, self.guards = dict(self.known), []
        self.element = number, element
        for term in element.terms:
            if isinstance(term, Variable):
                if term.name in names:
                    self.renamed[term.name] = self.fresh()
                self.known.pop(term.name, None)
        try:
            self.weight(element, function)
            condition = self.condition(element.condition, number)
            shown = ",".join([self.term(term) for term in element.terms])
            condition += self.guards
            most = self.most(element.terms) if function == "sum" else 0
        except NoInstance:
            return None
        finally:
            self.known, self.guards = outer
            self.renamed = {}
            self.element = None
        return shown, condition, most

    def weight(self, element: AggregateElement, function: str) -> None:
        """Refuses a weight that is no number of clingo's."""
        value = self.value(element.terms[0]) if element.terms else None
        if function != "count" and type(value) is int and not fits(value, value):
            raise NumberError(
                f"{value} is beyond {MAX_NUMBER}, up to which #{function} can count",
                element.terms[0].span,
                "use smaller numbers, such as thousands for units",
            )

    def most(self, terms: tuple[Term, ...]) -> int:
        """Returns the most that tuples of these terms can add up to, whatever the sign."""
        if not terms:
            return 0
        value = self.value(terms[0])
        heaviest = abs(value) if type(value) is int else 0
        if isinstance(terms[0], Variable):
            heaviest = max(map(abs, self.numbers(terms[0].name)))
        tuples = 1
        for name in dict.fromkeys(term.name for term in terms if isinstance(term, Variable)):
            known = self.known.get(self.renamed.get(name, name), ())
            tuples *= min((extent.bound() for extent in known), default=_MOST_TUPLES)
        return heaviest * min(tuples, _MOST_TUPLES)

    def total(self, place: int, group: str, terms: str) -> str:
        """Returns the literal that makes the weights of a sum be added up exactly."""
        return f"@total({place},{group},({terms},0))=0"

    def group(self, aggregate: Aggregate, names: set[str]) -> str:
        """Returns the term that tells apart the sums of an aggregate, one for each
        instance of its rule.
        """
        used: dict[str, None] = {}
        for element in aggregate.elements:
            own = {term.name for term in element.terms if isinstance(term, Variable)}
            for name in global_names((), element.condition):
                if name in names and name not in own:
                    used[name] = None
        return f"({','.join(['0', '0', *used])})"

    # ------------------------------------------------------------ what is said of variables

    def said(self, name: str) -> list[Range]:
        """Returns the ranges that the atoms of the statement and of the element give
        a variable, written or not.
        """
        ranges: list[Range] = []
        if name not in self.renamed:
            if self._said[0] != self.index:
                self._said = (self.index, self._collect(self._statement_atoms(), 0))
            ranges += self._said[1].get(name, ())
        if self.element is not None:
            number, element = self.element
            if self._said_inside[0] is not element:
                atoms = list(element.condition)
                if isinstance(element, ChoiceElement):
                    atoms.append(element.atom)
                self._said_inside = (element, self._collect(atoms, number))
            ranges += self._said_inside[1].get(name, ())
        return ranges

    def computed(self, name: str) -> bool:
        """Returns whether the body has ``name = term`` and each variable of the term has its value.

        An aggregate gives its value to a variable as well.
        """
        if self.index < 0 or self.element is not None:
            return False
        for item in getattr(self.typed.program.statements[self.index], "body", ()):
            if isinstance(item, Aggregate):
                for guard in filter(None, (item.left, item.right)):
                    if guard.operator == "=" and guard.bound == Variable(name):
                        return True
            if not isinstance(item, Comparison) or item.operator != "=":
                continue
            for one, other in ((item.left, item.right), (item.right, item.left)):
                if isinstance(one, Variable) and one.name == name:
                    parts = global_names((), (Comparison(other, "=", other),))
                    if not is_anonymous(other) and all(map(self.known.get, parts)):
                        return True
        return False

    def _statement_atoms(self) -> list[BodyItem]:
        """Returns the atoms that every instance of the statement has; of a choice head none."""
        if self.index < 0:
            return []
        statement = self.typed.program.statements[self.index]
        match statement:
            case Rule() | CrRule():
                head = () if isinstance(statement.head, Choice) else statement.head
                return [*head, *statement.body]
            case WeakConstraint():
                return list(statement.body)
            case Optimize():
                return list(statement.atoms)
        return []

    def _collect(self, items: Iterable[BodyItem], scope: int) -> dict[str, list[Range]]:
        ranges: dict[str, list[Range]] = {}

        def collect(term: Term, extent: Extent) -> None:
            if isinstance(term, Variable):
                ranges.setdefault(term.name, []).append(self.ranges.of(extent) or (0, 0))
            elif isinstance(term, Record):
                boxes = self.boxes(extent, term.name, len(term.arguments))
                if boxes is not None and len(boxes) == 1:
                    for part, sort in zip(term.arguments, boxes[0].arguments, strict=True):
                        collect(part, sort.extent)
                    return
                for name in global_names((Atom("", (term,)),), ()):
                    ranges.setdefault(name, []).append(self.ranges.inside(extent) or (0, 0))

        for item in items:
            positive = not isinstance(item, Naf)
            atom = item.operand if isinstance(item, Naf) else item
            if isinstance(atom, Atom):
                for term, extent in zip(atom.arguments, self.predicates[atom.name], strict=True):
                    collect(term, extent)
            elif isinstance(atom, SortAtom) and positive:
                collect(atom.arguments[0], self.typed.sorts[atom.name].extent)
        for name in self.typed.naturals.get((self.index, scope), ()):
            ranges.setdefault(name, []).append((0, self.typed.maxint))
        return ranges

    # ------------------------------------------------------------ conditions

    def condition(self, literals: tuple[Literal, ...], number: int) -> list[str]:
        """Returns the condition of an element; its guards go to ``guards``."""
        parts = [self.positive(item) if type(item) is Atom else "" for item in literals]
        for item in literals:
            if type(item) is SortAtom:
                self.literal(item)
        for at, item in enumerate(literals):
            if type(item) is not Atom and type(item) is not SortAtom:
                parts[at] = self.literal(item)
        if self.typed.naturals:
            self.naturals(number)
        return [part for part in parts if part]


def global_names(head: Head, body: tuple[BodyItem, ...]) -> list[str]:
    """Returns the variables of a statement outside the elements of choices and
    aggregates, in order.
    """
    terms: list[Term] = []
    terms += (
        _bounds(head) if isinstance(head, Choice) else (t for atom in head for t in atom.arguments)
    )
    for item in body:
        if isinstance(item, Naf):
            item = item.operand
        if isinstance(item, Aggregate):
            terms += _bounds(item)
        else:
            terms += (item.left, item.right) if isinstance(item, Comparison) else item.arguments
    names = dict.fromkeys(each.name for each in variables(terms))
    names.pop("_", None)
    return list(names)


def _bounds(item: Choice | Aggregate) -> Iterator[Term]:
    """Yields the terms of the guards."""
    for guard in (item.left, item.right):
        if guard is not None:
            yield guard.bound
