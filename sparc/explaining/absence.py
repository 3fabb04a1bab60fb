"""Explains why a literal is not in an answer set: `AnswerModel`, literal →
`Absence`, with `explain_absence`.

Every rule whose head matches is tried: of its instances the nearest is shown, the one in which
most of the body holds, and the first premise that fails there.  That is followed down in turn, to
what is absent because nothing gives it, or to what is there and should not be.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from sparc.answer_sets import Ground, GroundLiteral
from sparc.explaining.answer_model import AnswerModel, literal_of, term_value
from sparc.explaining.derivation import Absence, CountedElements, Derivation, FailedRule, derive
from sparc.explaining.instances import ground_item, instance_text, tree_term
from sparc.explaining.matching import match_atom
from sparc.explaining.places import StatementPlace, place_of
from sparc.explaining.remarks import value_of
from sparc.spelling import nearest
from sparc.syntax.tree import (
    Aggregate,
    Atom,
    BodyItem,
    Choice,
    Comparison,
    CrRule,
    Naf,
    RangeFact,
    Record,
    Rule,
    SortAtom,
)
from sparc.translation.ground_forms import only_element

__all__ = ["explain_absence", "explain_absent_form", "open_negation"]

_MOST_FOLLOWED = 25  # absent literals that are followed down
_DEEPEST = 12
_DEEPEST_NEGATION = 1  # below a `not p` of a derivation


def explain_absence(model: AnswerModel, literal: GroundLiteral, deepest: int = _DEEPEST) -> Absence:
    """Returns why ``literal`` is not in the answer set."""
    return _Tracer(model, deepest).absence(literal, 0)


def explain_absent_form(model: AnswerModel, atom: Atom) -> Absence:
    """Returns why no literal of the form of ``atom``, such as ``q(a,X)``, is in the answer set."""
    return _Tracer(model, _DEEPEST).absent_form(atom, 0)


def open_negation(model: AnswerModel) -> Callable[[GroundLiteral], Absence | None]:
    """Returns what tells why ``p`` is absent where ``not p`` is a premise; each literal is told once.

    None for a literal that was told, and for what no rule can give.
    """
    tracer = _Tracer(model, _DEEPEST_NEGATION)

    def opened(literal: GroundLiteral) -> Absence | None:
        if literal in tracer.seen or len(tracer.seen) >= _MOST_FOLLOWED:
            return None
        absent = tracer.absence(literal, 0)
        return absent if absent.rules else None

    return opened


class _Tracer:
    def __init__(self, model: AnswerModel, deepest: int) -> None:
        self.model = model
        self.deepest = deepest
        self.seen: set[GroundLiteral] = set()
        self.seen_forms: set[str] = set()

    def absence(self, literal: GroundLiteral, depth: int) -> Absence:
        """Returns the rules that could give the literal, each with what fails."""
        shown = str(literal)
        if not _fits(self.model, literal.name, literal.arguments):
            return Absence(shown, note="its sort forbids it")
        if literal in self.seen:
            return Absence(shown, note="shown above")
        if depth > self.deepest or len(self.seen) >= _MOST_FOLLOWED:
            return Absence(shown, note="not followed further")
        self.seen.add(literal)
        rules = [
            failed
            for index in self.model.givers(literal.name, literal.negated)
            for failed in self.failures(index, _atom_of(literal), depth)
        ]
        return Absence(shown, tuple(rules), self.note(literal, bool(rules)))

    def absent_form(self, atom: Atom, depth: int) -> Absence:
        """Returns why there is no literal of a form, such as ``q(a,X)``."""
        shown = instance_text(Rule((), (atom,)), {})
        if not _fits(self.model, atom.name, [term_value(term, {}) for term in atom.arguments]):
            return Absence(shown, note="its sort forbids it")
        if shown in self.seen_forms:
            return Absence(shown, note="shown above")
        if depth > self.deepest or len(self.seen) + len(self.seen_forms) >= _MOST_FOLLOWED:
            return Absence(shown, note="not followed further")
        self.seen_forms.add(shown)
        rules = [
            failed
            for index in self.model.givers(atom.name, atom.negated)
            for failed in self.failures(index, atom, depth)
        ]
        return Absence(shown, tuple(rules), "" if rules else "no rule gives it")

    def note(self, literal: GroundLiteral, has_rules: bool) -> str:
        """Returns a note to add to the rules."""
        contrary = GroundLiteral(literal.name, literal.arguments, not literal.negated)
        if contrary in self.model.literals:
            return f"{contrary} is in the answer set"
        if has_rules:
            return ""
        same = {
            str(each)
            for each in self.model.literals
            if (each.name, each.negated) == (literal.name, literal.negated)
        }
        near = nearest(str(literal), sorted(same))
        if near is None and not self.model.givers(literal.name, literal.negated):
            near = nearest(literal.name, sorted(self.model.head_names() - {literal.name}))
        return f"no rule gives it; did you mean {near}?" if near else "no rule gives it"

    def failures(self, index: int, wanted: Atom, depth: int) -> list[FailedRule]:
        """Returns the failures of a statement, one for each of its heads that matches."""
        statement = self.model.typed.program.statements[index]
        place = place_of(statement.span)
        literal = instance_text(Rule((), (wanted,)), {})
        if isinstance(statement, RangeFact):
            return [FailedRule(place, place.text.removesuffix("."), literal, "not in the range")]
        named = self.model.named_rule(index)
        failures = []
        for atom, condition, rule in _heads(named):
            binding = match_atom(atom, wanted)
            if binding is not None:
                values, extra = binding
                items = _in_order((*extra, *named.body, *condition), values)
                failures.append(self.failure(index, rule, place, literal, values, items, depth))
        return failures

    def failure(
        self,
        index: int,
        rule: Rule | CrRule,
        place: StatementPlace,
        literal: str,
        values: Mapping[str, Ground | Record],
        items: list[BodyItem],
        depth: int,
    ) -> FailedRule:
        """Returns the nearest instance of a rule and what fails in it."""
        nearest_values: Mapping[str, Ground] = {}
        at = 0
        while at < len(items):
            solutions = self.model.solutions(index, tuple(items[: at + 1]))
            if not solutions:
                break
            nearest_values = solutions[0]
            at += 1
        whole = {**values, **nearest_values}
        instance = instance_text(rule, whole)
        if at == len(items):
            return FailedRule(place, instance, literal, _not_given(rule))
        item = ground_item(items[at], whole)
        note, then = self.follow(item, depth)
        counted = self.counted(index, item) if isinstance(item, Aggregate) else None
        failed = instance_text(Rule((), (item,)), {})
        return FailedRule(place, instance, failed, note, then, counted)

    def counted(self, index: int, aggregate: Aggregate) -> CountedElements:
        """Returns the elements of an aggregate that hold, and what they come to."""
        texts: dict[str, None] = {}
        tuples: set[tuple[Ground | None, ...]] = set()
        for element in aggregate.elements:
            for values in self.model.solutions(index, element.condition):
                texts[instance_text(Rule((), element.condition), values)] = None
                tuples.add(tuple(term_value(term, values) for term in element.terms))
        shown = instance_text(Rule((), (aggregate,)), {})
        return CountedElements(shown, tuple(texts), _value(aggregate.function, tuples))

    def follow(self, item: BodyItem, depth: int) -> tuple[str, Absence | Derivation | None]:
        """Returns why a premise fails."""
        if isinstance(item, Atom):
            literal = literal_of(item, {})
            if literal is None:
                return "", self.absent_form(item, depth + 1)
            return "", self.absence(literal, depth + 1)
        if isinstance(item, Naf) and isinstance(item.operand, Atom):
            literal = literal_of(item.operand, {})
            if literal is None:
                return "", None
            if literal in self.model.literals:
                return "", derive(self.model, literal)[0]
            return f"{literal} is outside its sort", None
        if isinstance(item, SortAtom | Naf):
            return "outside the sort", None
        return "", None


def _not_given(rule: Rule | CrRule) -> str:
    """Returns why a rule whose body holds does not give a literal that its head matches."""
    if isinstance(rule, CrRule):
        return "not needed"
    if isinstance(rule.head, Choice) or len(rule.head) > 1:
        return "not chosen"
    return "its head is another literal, or outside its sort"


def _atom_of(literal: GroundLiteral) -> Atom:
    """Returns a literal as an atom of the tree."""
    return Atom(literal.name, tuple(map(tree_term, literal.arguments)), literal.negated)


def _heads(rule: Rule | CrRule) -> list[tuple[Atom, tuple[BodyItem, ...], Rule | CrRule]]:
    """Returns the atoms of a head, each with the condition of its element, and the
    rule as it is shown.
    """
    if isinstance(rule.head, Choice):
        return [
            (each.atom, each.condition, only_element(rule, each))
            for each in rule.head.elements
            if isinstance(each.atom, Atom)
        ]
    return [(atom, (), rule) for atom in rule.head if isinstance(atom, Atom)]


def _in_order(items: tuple[BodyItem, ...], values: Mapping[str, Ground | Record]) -> list[BodyItem]:
    """Returns the literals with values, those first that give values to others."""
    kinds: dict[type, int] = {Atom: 0, SortAtom: 1, Naf: 2, Comparison: 3, Aggregate: 4}
    return sorted((ground_item(item, values) for item in items), key=lambda item: kinds[type(item)])


def _fits(model: AnswerModel, name: str, arguments: Sequence[Ground | None]) -> bool:
    """Returns whether arguments are of the sorts of a predicate, as far as they have values."""
    signature = model.typed.predicates.get(name)
    return signature is not None and all(
        value is None or value_of(value) in sort.extent
        for value, sort in zip(arguments, signature.sorts, strict=True)
    )


def _value(function: str, tuples: Collection[tuple[Ground | None, ...]]) -> int | None:
    """Returns the value of an aggregate over different tuples; None where it is no number, or not known."""
    if any(None in each for each in tuples):
        return None
    if function == "count":
        return len(tuples)
    weights = [each[0] for each in tuples]
    numbers = [weight for weight in weights if isinstance(weight, int)]
    if function == "sum":
        return sum(numbers)  # what is no number adds nothing
    if not numbers or len(numbers) < len(weights):
        return None
    return min(numbers) if function == "min" else max(numbers)
