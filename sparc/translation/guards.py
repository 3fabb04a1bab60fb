"""The guards of one statement: the atoms that keep its variables inside their sorts.

`Guards.learn` notes what a literal says about its variables, `Guards.require` asks that a term
lie in a sort: it adds a guard where that is not known, and takes records apart where the sort
allows.  `sparc.translate` builds on it.
"""

from __future__ import annotations

from sparc.checking.number_ranges import FUNCTIONS, Linear, Range, Ranges, Reach, combine
from sparc.checking.typed_program import TypedProgram, Undefined, evaluate, is_ground
from sparc.sorts.extents import MAX_LISTED, Extent, Interval, Records
from sparc.sorts.set_operations import is_subset
from sparc.sorts.values import Value
from sparc.sorts.values import text as value_text
from sparc.source import Span
from sparc.syntax.tree import (
    Arithmetic,
    Atom,
    BodyItem,
    Comparison,
    Identifier,
    Naf,
    Number,
    Record,
    SortAtom,
    Term,
    Variable,
)
from sparc.translation.sort_facts import SortFacts, conjunction

__all__ = ["Guards", "NoInstance", "is_anonymous"]


class NoInstance(Exception):
    """The statement or element has no ground instance under the sorts."""


class Guards:
    """The variables of one statement at a time, and the guards that they need.

    ``known`` has the sorts in which a variable lies by what other literals say; ``guards`` the
    text of the guards so far; ``renamed`` other names for the variables of an element.
    """

    def __init__(self, typed: TypedProgram) -> None:
        self.typed = typed
        self.constants = typed.constants
        self.facts = SortFacts(typed)
        self.known: dict[str, tuple[Extent, ...]] = {}
        self.guards: list[str] = []
        self.renamed: dict[str, str] = {}
        self.fresh_names = 0
        self.named = False  # anonymous variables get names everywhere, to be counted
        self._boxes: dict[tuple[int, str, int], tuple[Records, ...] | None] = {}
        self._subsets: dict[tuple[int, int], bool] = {}
        self._conditions: dict[int, list[tuple[int, str, int]] | None] = {}
        self.ranges = Ranges(sort.extent for sort in typed.sorts.values())
        self.places: list[Span | None] = []  # of the arithmetic that exact functions work out

    def begin(self) -> None:
        """Forgets the variables of the statement before."""
        self.known = {}
        self.guards = []
        self.fresh_names = 0

    def learn(self, term: Term, extent: Extent | None) -> str:
        """Returns the text of an argument that lies in ``extent`` (None: in some sort) already."""
        kind = type(term)
        if kind is Variable:
            name = term.name  # type: ignore[union-attr]
            if name == "_":
                return self.fresh() if self.named else "_"
            if self.renamed:
                name = self.renamed.get(name, name)
            if extent is not None:
                self.known[name] = (*self.known.get(name, ()), extent)
            return name
        if isinstance(term, Record):
            boxes = None
            if extent is not None:
                boxes = self.boxes(extent, term.name, len(term.arguments))
                if boxes == ():
                    raise NoInstance
            extents: list[Extent | None] = [None] * len(term.arguments)
            if boxes is not None and len(boxes) == 1:
                extents = [sort.extent for sort in boxes[0].arguments]
            words = [self.learn(t, e) for t, e in zip(term.arguments, extents, strict=True)]
            return f"{term.name}({','.join(words)})"
        return self.term(term)

    def require(self, term: Term, extent: Extent) -> str:
        """Returns the text of an argument; guards that keep it in ``extent`` go to ``guards``.

        Raises `NoInstance` when it cannot be in it.
        """
        kind = type(term)
        if kind is Variable:
            name = term.name  # type: ignore[union-attr]
            if name == "_":
                name = self.fresh()
            elif self.renamed:
                name = self.renamed.get(name, name)
            known = self.known.get(name, ())
            for given in known:
                if given is extent:
                    return name
            for given in known:
                if self.within(given, extent):
                    return name
            if is_long(extent) and (known or self.computed(name)):
                self.compare(name, extent)
            else:
                self.guards.append(f"{self.facts.key(extent)}({name})")
            self.known[name] = (*known, extent)
            return name
        if kind is Identifier:
            name = term.name  # type: ignore[union-attr]
            value: Value = self.constants.get(name, name)
            if value not in extent:
                raise NoInstance
            return str(value)
        if kind is Number:
            if term.value not in extent:  # type: ignore[union-attr]
                raise NoInstance
            return str(term.value)  # type: ignore[union-attr]
        if isinstance(term, Record):
            return self.require_record(term, extent)
        assert isinstance(term, Arithmetic)
        return self.require_arithmetic(term, extent)

    def require_record(self, term: Record, extent: Extent) -> str:
        """Returns a record: by the sorts of its arguments where that says the same,
        else as a whole.
        """
        boxes = self.boxes(extent, term.name, len(term.arguments))
        if boxes == ():
            raise NoInstance
        if boxes is not None and len(boxes) == 1:
            box = boxes[0]
            tests = self.tests(box)
            if tests is not None:
                words = [
                    self.require(part, sort.extent)
                    for part, sort in zip(term.arguments, box.arguments, strict=True)
                ]
                for left, operator, right in tests:
                    self.guard(f"{words[left]}{operator}{words[right]}")
                return f"{term.name}({','.join(words)})"
        value = self.value(term)
        if value is not None:
            if value not in extent:
                raise NoInstance
            return value_text(value)
        shown = self.term(term)
        self.guard(f"{self.facts.key(extent)}({shown})")
        return shown

    def require_arithmetic(self, term: Arithmetic, extent: Extent) -> str:
        """Returns arithmetic, with two comparisons where it only shifts a number of a known range."""
        value = self.value(term)
        if value is not None:
            if value not in extent:
                raise NoInstance
            return value_text(value)
        left, right = term.left, term.right
        if (
            isinstance(extent, Interval)
            and term.operator in "+-"
            and isinstance(left, Variable)
            and isinstance(right, Number | Identifier)
            and left.name != "_"
        ):
            offset = self.value(right)
            name = self.renamed.get(left.name, left.name)
            ranges = [e for e in self.known.get(name, ()) if isinstance(e, Interval)]
            if ranges and isinstance(offset, int):
                if term.operator == "-":
                    offset = -offset
                low, high = max(e.low for e in ranges), min(e.high for e in ranges)
                if low + offset > extent.high or high + offset < extent.low:
                    raise NoInstance
                if high + offset > extent.high:
                    self.guard(f"{name}<={extent.high - offset}")
                if low + offset < extent.low:
                    self.guard(f"{name}>={extent.low - offset}")
                return f"{name}{term.operator}{self.term(right)}"
        if not extent.has_number():
            raise NoInstance
        shown = self.term(term)
        if is_long(extent):
            self.compare(shown, extent)
        else:
            self.guard(f"{self.facts.key(extent)}({shown})")
        return shown

    def compare(self, shown: str, extent: Extent) -> None:
        """Guards that keep a number in a range too long to be listed.

        From ``N<=2147483647`` itself clingo would take the numbers that N can be, one by one.
        """
        assert isinstance(extent, Interval)
        self.guard(f"@order({shown},{extent.low})>=0")
        self.guard(f"@order({shown},{extent.high})<=0")

    def guard(self, shown: str) -> None:
        """Adds a guard, unless it is there."""
        if shown not in self.guards:
            self.guards.append(shown)

    def term(self, term: Term) -> str:
        """Returns the text of a term as it stands; anonymous variables get names."""
        kind = type(term)
        if kind is Variable:
            name = term.name  # type: ignore[union-attr]
            if name == "_":
                return self.fresh()
            return self.renamed.get(name, name) if self.renamed else name
        if kind is Identifier:
            name = term.name  # type: ignore[union-attr]
            return str(self.constants.get(name, name))
        if kind is Number:
            return str(term.value)  # type: ignore[union-attr]
        if isinstance(term, Record):
            return f"{term.name}({','.join([self.term(part) for part in term.arguments])})"
        assert isinstance(term, Arithmetic)
        return self.arithmetic(term)[0]

    def arithmetic(self, term: Arithmetic) -> tuple[str, Reach]:
        """Returns the text of an operation and what it can come to.

        An operation that may leave 32 bits is a function that counts exactly.
        """
        (left, first), (right, second) = self.operand(term.left), self.operand(term.right)
        reach = combine(term.operator, first, second)
        if reach.checked:
            arguments = f"{self.place(term.span)},{left},{right}"
            return f"@{FUNCTIONS[term.operator]}({arguments})", reach
        left = f"({left})" if type(term.left) is Arithmetic else left
        right = f"({right})" if type(term.right) is Arithmetic else right
        return f"{left}{term.operator}{right}", reach

    def operand(self, term: Term) -> tuple[str, Reach]:
        """Returns a term inside arithmetic; an anonymous variable there is a number of ``#nat``."""
        if type(term) is Arithmetic:
            return self.arithmetic(term)
        if type(term) is Variable:
            if term.name == "_":
                extent = self.typed.sorts["nat"].extent
                name = self.require(term, extent)
                return name, Reach(*(self.ranges.of(extent) or (0, 0)), Linear(name))
            shown = self.term(term)
            return shown, Reach(*self.numbers(term.name), Linear(shown))
        value = self.value(term)
        number = value if type(value) is int else 0  # anything else has no value in arithmetic
        return self.term(term), Reach(number, number)

    def numbers(self, name: str) -> Range:
        """Returns the numbers that a variable can be in an instance, by all that the
        statement says.
        """
        low, high = self.ranges.widest()
        for extent in self.known.get(self.renamed.get(name, name), ()):
            found = self.ranges.of(extent) or (0, 0)  # without a number there is no instance
            low, high = max(low, found[0]), min(high, found[1])
        for found in self.said(name):
            low, high = max(low, found[0]), min(high, found[1])
        return (low, max(low, high))

    def said(self, name: str) -> list[Range]:
        """Ranges of a variable from literals that are not written yet."""
        return []

    def computed(self, name: str) -> bool:
        """Returns whether a comparison gives the variable its value, from variables
        that have theirs.
        """
        return False

    def place(self, span: Span | None) -> int:
        """Returns the index under which exact functions know a place."""
        self.places.append(span)
        return len(self.places) - 1

    def with_names(self, item: BodyItem) -> BodyItem:
        """Returns the literal with a name for each anonymous variable."""
        if isinstance(item, Atom | SortAtom):
            if not any(map(is_anonymous, item.arguments)):
                return item
            arguments = tuple(self.named_term(term) for term in item.arguments)
            return type(item)(item.name, arguments, item.negated, item.span, item.name_span)
        if isinstance(item, Naf):
            return Naf(self.with_names(item.operand), item.span)  # type: ignore[arg-type]
        if isinstance(item, Comparison):
            left, right = self.named_term(item.left), self.named_term(item.right)
            return Comparison(left, item.operator, right, item.span)
        return item

    def named_term(self, term: Term, counted: bool = False) -> Term:
        """Returns the term with a name for each anonymous variable; ``counted``: inside arithmetic."""
        if isinstance(term, Variable) and term.name == "_":
            name = self.fresh()
            if counted:
                self.require(Variable(name), self.typed.sorts["nat"].extent)
            return Variable(name, term.span)
        if isinstance(term, Record):
            return Record(term.name, tuple(self.named_term(t) for t in term.arguments), term.span)
        if isinstance(term, Arithmetic):
            left, right = self.named_term(term.left, True), self.named_term(term.right, True)
            return Arithmetic(term.operator, left, right, term.span)
        return term

    # ------------------------------------------------------------ small questions

    def fresh(self) -> str:
        """Returns a variable that no SPARC text can have."""
        self.fresh_names += 1
        return f"_V{self.fresh_names}"

    def number(self, term: Term) -> int:
        """Returns the value of a number or constant."""
        value = self.value(term)
        assert isinstance(value, int)
        return value

    def value(self, term: Term) -> Value | None:
        """Returns the value of a ground term, None when it has variables."""
        try:
            return evaluate(term, self.constants) if is_ground(term) else None
        except Undefined:
            raise NoInstance from None

    def within(self, small: Extent, large: Extent) -> bool:
        """Returns whether one sort is provably part of another."""
        key = (id(small), id(large))
        answer = self._subsets.get(key)
        if answer is None:
            answer = is_subset(small, large, self._subsets)
        return answer

    def boxes(self, extent: Extent, name: str, arity: int) -> tuple[Records, ...] | None:
        """`Extent.boxes`, remembered."""
        key = (id(extent), name, arity)
        if key not in self._boxes:
            self._boxes[key] = extent.boxes(name, arity)
        return self._boxes[key]

    def tests(self, box: Records) -> list[tuple[int, str, int]] | None:
        """`conjunction`, remembered."""
        key = id(box)
        if key not in self._conditions:
            self._conditions[key] = conjunction(box)
        return self._conditions[key]


def is_long(extent: Extent) -> bool:
    """Returns whether the extent is a range that is too long to be listed."""
    return isinstance(extent, Interval) and extent.bound() > MAX_LISTED


def is_anonymous(term: Term) -> bool:
    """Returns whether an anonymous variable occurs in a term."""
    if isinstance(term, Variable):
        return term.name == "_"
    if isinstance(term, Record):
        return any(map(is_anonymous, term.arguments))
    if isinstance(term, Arithmetic):
        return is_anonymous(term.left) or is_anonymous(term.right)
    return False
