"""The text of heads and bodies for clingo, with the guards that they need: class `Literals`.

One statement at a time: `Literals.index` is its number; guards gather in ``guards``, and ``derived``
has the predicates that some head derives.  `sparc.translate` builds on it.
"""

from __future__ import annotations

from sparc.guards import Guards, NoInstance
from sparc.syntax import (
    Aggregate,
    AggregateElement,
    Arithmetic,
    Atom,
    BodyItem,
    Choice,
    ChoiceElement,
    Comparison,
    Guard,
    Head,
    Literal,
    Naf,
    Record,
    SortAtom,
    Term,
    Variable,
)
from sparc.typed import TypedProgram

__all__ = ["Literals", "global_names"]


class Literals(Guards):
    """Heads, literals, aggregates and choices; ``predicates`` has the sorts of each position."""

    def __init__(self, typed: TypedProgram) -> None:
        super().__init__(typed)
        self.predicates = {
            name: tuple([sort.extent for sort in signature.sorts])
            for name, signature in typed.predicates.items()
        }
        self.derived: set[tuple[str, int, bool]] = set()
        self.index = 0

    # ------------------------------------------------------------ heads and bodies

    def head(self, head: Head) -> str:
        """The text of a head; its guards go to ``guards``."""
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
            inner = f"{self.term(left.bound)}{left.operator}{inner}"
        if right is not None:
            inner = f"{inner}{right.operator}{self.term(right.bound)}"
        return inner

    def body(self, body: tuple[BodyItem, ...], head: Head) -> list[str]:
        """The literals of a body in their order; guards go to ``guards``.

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
        """A literal other than a positive atom; empty when a guard says it all."""
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
            return f"{self.term(item.left)}{item.operator}{self.term(item.right)}"
        assert isinstance(item, SortAtom)
        self.require(item.arguments[0], self.typed.sorts[item.name].extent)
        return ""

    def positive(self, atom: Atom) -> str:
        """A positive atom of a body: what it says about its variables is kept in ``known``."""
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
        """An atom whose arguments must be kept inside their sorts."""
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
        try:
            condition = self.condition(element.condition, number)
            shown = self.guarded(element.atom, derives=True)
            condition += self.guards
        except NoInstance:
            return None
        finally:
            self.known, self.guards = outer
        return f"{shown}: {','.join(condition)}" if condition else shown

    def aggregate(self, aggregate: Aggregate, number: int, names: set[str]) -> str:
        """``left #count{…} right``; without guards it is true."""
        if aggregate.left is None and aggregate.right is None:
            return ""
        elements = []
        for offset, element in enumerate(aggregate.elements):
            shown = self.aggregate_element(element, number + offset, names)
            if shown is not None:
                elements.append(shown)
        inner = f"#{aggregate.function}{{{';'.join(elements)}}}"
        return self.bounded(inner, aggregate.left, aggregate.right)

    def aggregate_element(
        self, element: AggregateElement, number: int, names: set[str]
    ) -> str | None:
        """``t1,…,tk : condition``; the variables of the tuple are its own."""
        outer = self.known, self.guards
        self.known, self.guards = dict(self.known), []
        for term in element.terms:
            if isinstance(term, Variable):
                if term.name in names:
                    self.renamed[term.name] = self.fresh()
                self.known.pop(term.name, None)
        try:
            condition = self.condition(element.condition, number)
            shown = ",".join([self.term(term) for term in element.terms])
            condition += self.guards
        except NoInstance:
            return None
        finally:
            self.known, self.guards = outer
            self.renamed = {}
        return f"{shown}: {','.join(condition)}"

    def condition(self, literals: tuple[Literal, ...], number: int) -> list[str]:
        """The condition of an element; its guards go to ``guards``."""
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
    """The variables of a statement outside the elements of choices and aggregates, in order."""
    names: dict[str, None] = {}

    def collect(term: Term) -> None:
        if isinstance(term, Variable):
            if term.name != "_":
                names[term.name] = None
        elif isinstance(term, Record):
            for part in term.arguments:
                collect(part)
        elif isinstance(term, Arithmetic):
            collect(term.left)
            collect(term.right)

    def bounds(left: Guard | None, right: Guard | None) -> None:
        for guard in (left, right):
            if guard is not None:
                collect(guard.bound)

    if isinstance(head, Choice):
        bounds(head.left, head.right)
    else:
        for atom in head:
            for term in atom.arguments:
                collect(term)
    for item in body:
        if isinstance(item, Naf):
            item = item.operand
        if isinstance(item, Atom | SortAtom):
            for term in item.arguments:
                collect(term)
        elif isinstance(item, Comparison):
            collect(item.left)
            collect(item.right)
        elif isinstance(item, Aggregate):
            bounds(item.left, item.right)
    return list(names)
