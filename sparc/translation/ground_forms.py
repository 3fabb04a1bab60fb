"""Rules that list the ground instances of a program's rules, given its answer set: class `GroundForms`.

Where the atoms of an answer set are facts, the bodies that hold in it are found by grounding alone:

    p(X) :- q(X,_).          ___f0(X,_V1):-q(X,_V1).
    {p(X) : q(X)} :- t.      ___f1(X):-t,q(X),__s(X).

Each `RuleForm` says what such an instance derives, and from which literals.
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.checking.typed_program import TypedProgram
from sparc.lazy_dataclass import dataclass
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
    Identifier,
    Literal,
    Naf,
    Number,
    RangeFact,
    Record,
    Rule,
    SortAtom,
    Statement,
    Term,
    Variable,
)
from sparc.translation.guards import NoInstance
from sparc.translation.literals import Literals, global_names
from sparc.translation.sort_facts import interval
from sparc.translation.translator import APPLIED, rule_labels

__all__ = ["AggregateForm", "GroundForms", "RuleForm", "only_element"]


@dataclass(frozen=True)
class AggregateForm:
    """An element of an aggregate: which instances of its condition hold.

    The arguments of ``predicate`` are ``names``: those of the rule, then the element's own.
    """

    predicate: str
    names: tuple[str, ...]
    aggregate: Aggregate
    condition: tuple[Literal, ...]


@dataclass(frozen=True)
class RuleForm:
    """The form of one rule, or one element of a choice: ``predicate(names)`` where its body holds.

    ``statement`` has a name for each anonymous variable and a number for each constant, and of a
    choice this element only.  ``kind``
    is ``rule``, ``choice``, ``disjunction`` or ``cr``.
    """

    index: int
    kind: str
    statement: Statement
    heads: tuple[Atom, ...]
    body: tuple[BodyItem, ...]
    predicate: str
    names: tuple[str, ...]
    aggregates: tuple[AggregateForm, ...] = ()


class GroundForms(Literals):
    """The forms of the rules of a typed program, and their text for clingo."""

    def __init__(self, typed: TypedProgram) -> None:
        super().__init__(typed)
        self.lines: list[str] = []
        self._labels = rule_labels(typed.program)

    def taken_lines(self) -> str:
        """Returns the rules written since this was asked last, and the sorts that they need."""
        text = "\n".join([*self.lines, *self.facts.definitions()])
        self.lines = []
        return text

    def forms(self, index: int) -> list[RuleForm]:
        """Returns the forms of a statement; none of a constraint, and where it has no instance."""
        statement = self.typed.program.statements[index]
        self.begin()
        self.index = index
        try:
            if isinstance(statement, RangeFact):
                return [self._range(statement)]
            if isinstance(statement, Rule | CrRule) and statement.head:
                return self._rule(statement)
        except NoInstance:
            pass
        return []

    def _range(self, fact: RangeFact) -> RuleForm:
        atom = Atom(fact.name, (Variable("N"),), fact.negated)
        low, high = self.number(fact.low), self.number(fact.high)
        predicate = f"___f{self.index}"
        self.lines.append(f"{predicate}(N):-N=({interval(low, high)}).")
        return RuleForm(self.index, "rule", fact, (atom,), (), predicate, ("N",))

    def _rule(self, rule: Rule | CrRule) -> list[RuleForm]:
        named = self.named_rule(self.index)
        head, body = named.head, named.body
        parts = self.body(body, head)
        predicate = f"___f{self.index}"
        outer = tuple(global_names(head, body))
        if isinstance(rule, CrRule):
            label = self._labels[self.index]
            parts.append(f"{APPLIED}({_call(label, outer)})")
        if isinstance(head, Choice):
            return self._choice(rule, named, head, parts, outer)
        kind = "cr" if isinstance(rule, CrRule) else "disjunction" if len(head) > 1 else "rule"
        for atom in head:
            self.guarded(atom)
        parts += self.guards
        self.lines.append(f"{_call(predicate, outer)}:-{','.join(parts)}." if parts else
                          f"{_call(predicate, outer)}.")  # fmt: skip
        aggregates = self._aggregates(body, _call(predicate, outer), outer, 1)
        heads = tuple(atom for atom in head if isinstance(atom, Atom))
        return [RuleForm(self.index, kind, named, heads, body, predicate, outer, aggregates)]

    def _choice(
        self,
        rule: Rule | CrRule,
        named: Rule | CrRule,
        head: Choice,
        parts: list[str],
        outer: tuple[str, ...],
    ) -> list[RuleForm]:
        forms = []
        kind = "cr" if isinstance(rule, CrRule) else "choice"
        base = parts + self.guards
        whole = _call(f"___b{self.index}", outer)  # the body without any element
        self.lines.append(f"{whole}:-{','.join(base)}." if base else f"{whole}.")
        aggregates = self._aggregates(named.body, whole, outer, 1 + len(head.elements))
        for number, element in enumerate(head.elements, 1):
            shown = self.choice_element(element, number)
            if shown is None or not isinstance(element.atom, Atom):
                continue
            condition = shown.partition(": ")[2]
            predicate = f"___f{self.index}_{number}"
            inner = global_names((element.atom,), element.condition)
            names = tuple(dict.fromkeys((*outer, *inner)))
            body = [*base, condition] if condition else base
            call = _call(predicate, names)
            self.lines.append(f"{call}:-{','.join(body)}." if body else f"{call}.")
            items = (*named.body, *element.condition)
            forms.append(
                RuleForm(
                    self.index,
                    kind,
                    only_element(named, element),
                    (element.atom,),
                    items,
                    predicate,
                    names,
                    aggregates,
                )
            )
        return forms

    def _aggregates(
        self, body: Iterable[BodyItem], whole: str, outer: tuple[str, ...], number: int
    ) -> tuple[AggregateForm, ...]:
        """Returns the forms of all elements of aggregates where ``whole`` holds.

        ``number`` is the first one's.
        """
        forms = []
        for at, item in enumerate(body):
            if not isinstance(item, Aggregate):
                continue
            for element in item.elements:
                written = None
                if item.left is not None or item.right is not None:
                    written = self.aggregate_element(element, number, set(outer), item.function)
                number += 1
                if written is None:
                    continue
                own = (Atom("", element.terms),)
                names = tuple(dict.fromkeys((*outer, *global_names(own, element.condition))))
                predicate = f"___a{self.index}_{at}_{number}"
                self.lines.append(f"{_call(predicate, names)}:-{','.join([whole, *written[1]])}.")
                forms.append(AggregateForm(predicate, names, item, element.condition))
        return tuple(forms)

    def condition_of(
        self, index: int, items: tuple[BodyItem, ...], predicate: str
    ) -> tuple[str, ...] | None:
        """Writes a rule that lists where some literals of a statement hold together.

        The arguments of ``predicate`` are the names that are returned; None where there is no instance.
        """
        self.begin()
        self.index = index
        try:
            parts = self.body(items, ())
        except NoInstance:
            return None
        names = tuple(global_names((), items))
        parts = parts + self.guards
        call = _call(predicate, names)
        self.lines.append(f"{call}:-{','.join(parts)}." if parts else f"{call}.")
        return names

    # ------------------------------------------------------------ names for what has none

    def named_rule(self, index: int) -> Rule | CrRule:
        """Returns the rule with names for anonymous variables, and numbers for constants.

        The variables of an aggregate's tuple get names of their own.
        """
        rule = self.typed.program.statements[index]
        assert isinstance(rule, Rule | CrRule)
        self.fresh_names = 0
        self.named = True
        try:
            body = tuple(self.with_names(self._item(item)) for item in rule.body)
            head: Head
            if isinstance(rule.head, Choice):
                head = self._choice_head(rule.head)
            else:
                head = tuple(self.with_names(self._atom(atom)) for atom in rule.head)  # type: ignore[misc]
        finally:
            self.named = False
        outer = set(global_names(head, body))
        body = tuple(
            self._own(item, outer) if isinstance(item, Aggregate) else item for item in body
        )
        if isinstance(rule, CrRule):
            return CrRule(rule.label, head, body, rule.span)
        return Rule(head, body, rule.span)

    def _choice_head(self, head: Choice) -> Choice:
        elements = tuple(
            ChoiceElement(
                self.with_names(self._atom(each.atom)),  # type: ignore[arg-type]
                tuple(self.with_names(self._item(item)) for item in each.condition),  # type: ignore[misc]
                each.span,
            )
            for each in head.elements
        )
        return Choice(elements, self._guard(head.left), self._guard(head.right), head.span)

    def _own(self, item: Aggregate, outer: set[str]) -> Aggregate:
        elements = []
        for element in item.elements:
            clash = {
                term.name
                for term in element.terms
                if isinstance(term, Variable) and term.name in outer
            }
            taken = outer.union(global_names((Atom("", element.terms),), element.condition))
            renaming: dict[str, Term] = {name: Variable(_own_name(name, taken)) for name in clash}
            elements.append(
                AggregateElement(
                    tuple(_replaced(term, renaming) for term in element.terms),
                    tuple(_replaced_item(each, renaming) for each in element.condition),  # type: ignore[misc]
                    element.span,
                )
            )
        return Aggregate(item.function, tuple(elements), item.left, item.right, item.span)

    def _item(self, item: BodyItem) -> BodyItem:
        return _replaced_item(item, self._numbers())

    def _atom(self, atom: Atom | SortAtom) -> Atom | SortAtom:
        return _replaced_item(atom, self._numbers())  # type: ignore[return-value]

    def _guard(self, guard: Guard | None) -> Guard | None:
        return _replaced_guard(guard, self._numbers())

    def _numbers(self) -> dict[str, Term]:
        return {name: Number(value) for name, value in self.constants.items()}


def only_element(rule: Rule | CrRule, element: ChoiceElement) -> Rule | CrRule:
    """Returns the rule with one element of its choice, and without bounds."""
    head = Choice((element,), None, None)
    if isinstance(rule, CrRule):
        return CrRule(rule.label, head, rule.body, rule.span)
    return Rule(head, rule.body, rule.span)


def _own_name(name: str, taken: set[str]) -> str:
    """Returns a name like ``name`` that no variable of the rule has."""
    own = f"{name}_own"
    while own in taken:
        own += "_own"
    return own


def _call(predicate: str, names: Iterable[str]) -> str:
    arguments = ",".join(names)
    return f"{predicate}({arguments})" if arguments else predicate


def _replaced(term: Term, by: dict[str, Term]) -> Term:
    """Returns the term with others for some variables and constants; these have different names."""
    match term:
        case Variable(name) | Identifier(name):
            return by.get(name, term)
        case Record(name, arguments):
            return Record(name, tuple(_replaced(each, by) for each in arguments), term.span)
        case Arithmetic(operator, left, right):
            return Arithmetic(operator, _replaced(left, by), _replaced(right, by), term.span)
    return term


def _replaced_guard(guard: Guard | None, by: dict[str, Term]) -> Guard | None:
    return None if guard is None else Guard(guard.operator, _replaced(guard.bound, by), guard.span)


def _replaced_item(item: BodyItem, by: dict[str, Term]) -> BodyItem:
    match item:
        case Naf(operand):
            return Naf(_replaced_item(operand, by), item.span)  # type: ignore[arg-type]
        case Comparison(left, operator, right):
            return Comparison(_replaced(left, by), operator, _replaced(right, by), item.span)
        case Aggregate(function, elements, left_guard, right_guard):
            return Aggregate(
                function,
                tuple(
                    AggregateElement(
                        tuple(_replaced(term, by) for term in each.terms),
                        tuple(_replaced_item(one, by) for one in each.condition),  # type: ignore[misc]
                        each.span,
                    )
                    for each in elements
                ),
                _replaced_guard(left_guard, by),
                _replaced_guard(right_guard, by),
                item.span,
            )
    arguments = tuple(_replaced(term, by) for term in item.arguments)
    return type(item)(item.name, arguments, item.negated, item.span, item.name_span)
