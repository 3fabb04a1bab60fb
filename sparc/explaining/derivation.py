"""Derives a literal of an answer set: `AnswerModel`, literal → `Derivation`, with `derive`.

The smallest derivation, as a tree: of all ways to get a literal from facts the one with the fewest
steps (Knuth 1977, a generalization of Dijkstra's algorithm).  So no literal rests on itself.
Shared parts are shown once, and what lies deeper than a page can show is continued in `Derivation`s
of its own.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator

from sparc.answer_sets import GroundLiteral
from sparc.explaining.answer_model import AnswerModel, RuleInstance, literal_of
from sparc.explaining.instances import Binding, ground_item, instance_text
from sparc.explaining.places import StatementPlace, place_of
from sparc.lazy_dataclass import dataclass
from sparc.syntax.tree import Aggregate, Atom, BodyItem, Naf, Rule

__all__ = ["Absence", "CountedElements", "Derivation", "FailedRule", "derive"]

_DEEPEST = 40  # levels of one tree


@dataclass(frozen=True)
class CountedElements:
    """An aggregate, and the instances of its elements that counted.

    ``value`` is the number to which they come, where the aggregate fails and it is one.
    """

    aggregate: str
    elements: tuple[str, ...]
    value: int | None = None


@dataclass(frozen=True)
class Derivation:
    """A literal, the rule and instance that give it, and its premises.

    ``note`` is ``chosen``, ``needed`` (a consistency-restoring rule), ``shown above``, ``continued below``
    or empty; of ``not p`` ``no rule gives it``, ``none of these rules gives it`` or ``shown above``.
    ``absent`` says of ``not p`` which rules could give ``p``, and what fails in each; None where there
    are none, or where that was said before.
    """

    literal: str
    place: StatementPlace | None = None
    instance: str | None = None
    premises: tuple[Derivation, ...] = ()
    note: str = ""
    aggregates: tuple[CountedElements, ...] = ()
    absent: Absence | None = None


@dataclass(frozen=True)
class FailedRule:
    """A rule that could give the literal, its nearest instance, and the premise that fails in it.

    ``note`` says what is not said by ``failed``: ``not chosen``, ``not needed``, or that a sort forbids it.
    ``then`` is why the premise fails, where that was followed; of an aggregate ``counted`` has the elements
    that hold.
    """

    place: StatementPlace
    instance: str
    failed: str
    note: str = ""
    then: Absence | Derivation | None = None
    counted: CountedElements | None = None


@dataclass(frozen=True)
class Absence:
    """A literal that is not in the answer set, or a form of literals of which none is.

    ``note`` says why no rule is listed, or of the literal's contrary.
    """

    literal: str
    rules: tuple[FailedRule, ...] = ()
    note: str = ""


@dataclass(frozen=True)
class _Step:
    """An instance with what it rests on."""

    instance: RuleInstance
    positive: tuple[GroundLiteral, ...]
    negative: tuple[GroundLiteral, ...]
    counted: tuple[CountedElements, ...]


def derive(
    model: AnswerModel,
    literal: GroundLiteral,
    opened: Callable[[GroundLiteral], Absence | None] = lambda _: None,
) -> tuple[Derivation, ...]:
    """Returns the derivation of a literal of the answer set.

    Then those of what lies too deep in it.  ``opened`` tells of ``not p`` why ``p`` is absent.
    """
    best: dict[GroundLiteral, _Step] = {}
    for lenient in (0, 1, 2):
        best = _cheapest(model, literal, lenient)
        if literal in best:
            break
    return tuple(_Trees(model, best, opened).of(literal))


# ------------------------------------------------------------------ the smallest


def _steps(model: AnswerModel, literal: GroundLiteral, lenient: int) -> Iterator[_Step]:
    """Yields the instances that give a literal.

    At first none of a disjunction of which another literal holds as well, and what an aggregate
    counts comes before it; ``lenient`` 1 takes the first back (of literals that need one another
    such a disjunction is the only ground), 2 the second (an aggregate that counts what it gives).
    """
    for instance in model.instances(literal):
        form, binding = instance.form, instance.binding
        if form.kind == "disjunction" and lenient < 1:
            others = [literal_of(atom, binding) for atom in form.heads]
            if any(other != literal and other in model.literals for other in others):
                continue
        positive: list[GroundLiteral] = []
        negative: list[GroundLiteral] = []
        counted: list[CountedElements] = []
        for item in form.body:
            if isinstance(item, Aggregate):
                elements, atoms = _counted(model, instance, item)
                counted.append(elements)
                if lenient < 2:
                    positive += atoms
                continue
            atom = item.operand if isinstance(item, Naf) else item
            if isinstance(atom, Atom):
                ground = literal_of(atom, binding)
                if ground is not None:
                    (negative if isinstance(item, Naf) else positive).append(ground)
        yield _Step(
            instance,
            tuple(dict.fromkeys(positive)),
            tuple(dict.fromkeys(negative)),
            tuple(counted),
        )


def _counted(
    model: AnswerModel, instance: RuleInstance, aggregate: Aggregate
) -> tuple[CountedElements, list[GroundLiteral]]:
    """Returns the elements of an aggregate that hold in an instance, and their positive literals."""
    texts: dict[str, None] = {}
    atoms: list[GroundLiteral] = []
    for form in instance.form.aggregates:
        if form.aggregate is not aggregate:
            continue
        for values in model.bindings(form.predicate, form.names):
            if any(values.get(name, value) != value for name, value in instance.binding.items()):
                continue
            texts[_text(form.condition, values)] = None
            for item in form.condition:
                if isinstance(item, Atom):
                    literal = literal_of(item, values)
                    if literal is not None:
                        atoms.append(literal)
    shown = _text((ground_item(aggregate, instance.binding),), {})
    return CountedElements(shown, tuple(texts)), atoms


def _text(items: tuple[BodyItem, ...], values: Binding) -> str:
    return instance_text(Rule((), items), values)


def _cheapest(
    model: AnswerModel, target: GroundLiteral, lenient: int
) -> dict[GroundLiteral, _Step]:
    """For each literal below ``target`` the step that begins its smallest derivation."""
    waiting: dict[GroundLiteral, list[tuple[GroundLiteral, _Step, list[int]]]] = {}
    ready: list[tuple[int, int, GroundLiteral, _Step]] = []
    number = 0
    todo, seen = [target], {target}
    while todo:
        literal = todo.pop()
        for step in _steps(model, literal, lenient):
            number += 1
            state = [len(step.positive), number, 1]  # premises left, number, cost
            if not step.positive:
                heapq.heappush(ready, (1, number, literal, step))
            for premise in step.positive:
                waiting.setdefault(premise, []).append((literal, step, state))
                if premise not in seen:
                    seen.add(premise)
                    todo.append(premise)
    best: dict[GroundLiteral, _Step] = {}
    while ready:
        cost, _, literal, step = heapq.heappop(ready)
        if literal in best:
            continue
        best[literal] = step
        if literal == target:
            break
        for above, user, state in waiting.get(literal, ()):
            state[0] -= 1
            state[2] += cost
            if state[0] == 0:
                heapq.heappush(ready, (state[2], state[1], above, user))
    return best


# ------------------------------------------------------------------ as trees


class _Trees:
    """The derivations of a literal and of all that it stands on, from the ``best`` steps."""

    def __init__(
        self,
        model: AnswerModel,
        best: dict[GroundLiteral, _Step],
        opened: Callable[[GroundLiteral], Absence | None],
    ) -> None:
        self.statements = model.typed.program.statements
        self.best = best
        self.opened = opened
        self.shown: set[GroundLiteral] = set()
        self.told: set[GroundLiteral] = set()  # of which it is said why they are not there
        self.queued: dict[GroundLiteral, None] = {}

    def of(self, target: GroundLiteral) -> Iterator[Derivation]:
        """Yields the derivation, and those of what was too deep to stand in one before."""
        roots = [target]
        while roots:
            for root in roots:
                if root not in self.shown:
                    yield self._tree(root, 0)
            roots, self.queued = list(self.queued), {}

    def _tree(self, literal: GroundLiteral, depth: int) -> Derivation:
        if literal in self.shown:
            return Derivation(str(literal), note="shown above")
        step = self.best.get(literal)
        if step is None:
            return Derivation(str(literal))
        if depth == _DEEPEST and step.positive:
            self.queued[literal] = None
            return Derivation(str(literal), note="continued below")
        self.shown.add(literal)
        form = step.instance.form
        premises = [self._tree(premise, depth + 1) for premise in step.positive]
        premises += map(self._negation, step.negative)
        return Derivation(
            str(literal),
            place_of(self.statements[form.index].span),
            _instance(step.instance, literal),
            tuple(premises),
            _NOTES.get(form.kind, ""),
            step.counted,
        )

    def _negation(self, literal: GroundLiteral) -> Derivation:
        if literal in self.told:
            return Derivation(f"not {literal}", note="shown above")
        absent = self.opened(literal)
        if absent is None:
            return Derivation(f"not {literal}", note="no rule gives it")
        self.told.add(literal)
        return Derivation(f"not {literal}", note="none of these rules gives it", absent=absent)


_NOTES = {"choice": "chosen", "disjunction": "chosen", "cr": "needed"}


def _instance(instance: RuleInstance, literal: GroundLiteral) -> str:
    """Returns the instance in words; of an element of a choice the element with the body."""
    form = instance.form
    if form.kind == "rule" and not isinstance(form.statement, Rule):
        return str(literal)
    return instance_text(form.statement, instance.binding)
