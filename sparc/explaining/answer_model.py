"""One answer set, and the ground instances of rules that hold in it: class `AnswerModel`.

Entry point `nth_model`.  The atoms of the answer set are facts in a grounding of their own; what is asked is
grounded on top, a rule at a time, when it is needed first.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sparc.answer_sets import Ground, GroundLiteral, GroundTerm
from sparc.checking.typed_program import TypedProgram
from sparc.explaining.instances import Binding
from sparc.explaining.subsets import Undecided
from sparc.lazy_dataclass import dataclass
from sparc.solving.clingo_solver import Grounding, Satisfiability, ground_literal
from sparc.solving.clingo_threads import Abandoned
from sparc.syntax.tree import (
    Atom,
    BodyItem,
    Choice,
    CrRule,
    Identifier,
    Number,
    RangeFact,
    Record,
    Rule,
    Term,
)
from sparc.translation.asp_program import AspProgram
from sparc.translation.ground_forms import GroundForms, RuleForm
from sparc.translation.translator import APPLIED, translate

__all__ = ["AnswerModel", "RuleInstance", "literal_of", "nth_model", "term_value"]


@dataclass(frozen=True)
class RuleInstance:
    """A ground instance whose body holds."""

    form: RuleForm
    binding: Binding


def nth_model(
    typed: TypedProgram, number: int, deadline: float | None
) -> tuple[list[Any] | None, int]:
    """Returns all atoms of the ``number``-th answer set, from 1 on, and how many
    there are up to it.

    The order, and what counts as the same, is that of `sparc.solve`.  None where there are fewer.
    Raises `Undecided` at the deadline.
    """
    program = translate(typed)
    options = []
    if program.has_preferences:
        options.append("--opt-mode=optN")
    elif program.has_display:
        options.append("--project=show")
    grounding = Grounding(program, options=options)
    try:
        grounding.ground(deadline)
    except Abandoned:
        raise Undecided from None
    seen: set[frozenset[Any]] = set()
    models = grounding.models(deadline=deadline)
    for model in models:
        if program.has_preferences and model.cost and not model.optimality_proven:
            continue
        shown = frozenset(model.symbols(shown=True))
        if shown in seen:
            continue
        seen.add(shown)
        if len(seen) == number:
            atoms = list(model.symbols(atoms=True))
            models.close()  # type: ignore[attr-defined]
            return atoms, number
    if not grounding.outcome.exhausted and (
        grounding.outcome.satisfiability is not Satisfiability.UNSATISFIABLE
    ):
        raise Undecided
    return None, len(seen)


class AnswerModel:
    """An answer set, given by all its atoms."""

    def __init__(self, typed: TypedProgram, atoms: Iterable[Any], deadline: float | None) -> None:
        self.typed = typed
        self.deadline = deadline
        names = typed.predicates
        kept = [atom for atom in atoms if atom.name in names or atom.name == APPLIED]
        self.literals = frozenset(ground_literal(atom) for atom in kept if atom.name in names)
        facts = AspProgram("\n".join([f"{atom}." for atom in kept]), "#show.")
        self._grounding = Grounding(facts)
        self._extend(None)
        self._writer = GroundForms(typed)
        self._givers: dict[tuple[str, bool], list[int]] = {}
        for index, statement in enumerate(typed.program.statements):
            for key in dict.fromkeys(_head_keys(statement)):
                self._givers.setdefault(key, []).append(index)
        self._instances: dict[tuple[str, bool], dict[GroundLiteral, list[RuleInstance]]] = {}
        self._forms: dict[int, list[RuleForm]] = {}
        self._bindings: dict[str, list[dict[str, Ground]]] = {}
        self._asked = 0

    def givers(self, name: str, negated: bool) -> list[int]:
        """Returns the statements that have such a literal in their heads."""
        return self._givers.get((name, negated), [])

    def head_names(self) -> set[str]:
        """Returns the predicates that some head gives, with their sign."""
        return {f"{'-' if negated else ''}{name}" for name, negated in self._givers}

    def instances(self, literal: GroundLiteral) -> list[RuleInstance]:
        """Returns the instances whose body holds and that have ``literal`` in their heads."""
        key = (literal.name, literal.negated)
        if key not in self._instances:
            self._instances[key] = self._load(key)
        return self._instances[key].get(literal, [])

    def _load(self, key: tuple[str, bool]) -> dict[GroundLiteral, list[RuleInstance]]:
        forms = [form for index in self.givers(*key) for form in self._forms_of(index)]
        self._extend(self._writer.taken_lines())
        found: dict[GroundLiteral, list[RuleInstance]] = {}
        for form in forms:
            heads = [atom for atom in form.heads if (atom.name, atom.negated) == key]
            for binding in self.bindings(form.predicate, form.names):
                instance = RuleInstance(form, binding)
                for atom in heads:
                    literal = literal_of(atom, binding)
                    if literal is not None:
                        found.setdefault(literal, []).append(instance)
        return found

    def _forms_of(self, index: int) -> list[RuleForm]:
        if index not in self._forms:
            self._forms[index] = self._writer.forms(index)
        return self._forms[index]

    def bindings(self, predicate: str, names: tuple[str, ...]) -> list[dict[str, Ground]]:
        """Returns the values of ``names`` with which an auxiliary predicate holds,
        in the order of terms.
        """
        if predicate not in self._bindings:
            atoms = self._grounding.control.symbolic_atoms.by_signature(predicate, len(names))
            values = sorted(atom.symbol.arguments for atom in atoms)
            self._bindings[predicate] = [
                dict(zip(names, map(_value, arguments), strict=True)) for arguments in values
            ]
        return self._bindings[predicate]

    def solutions(self, index: int, items: tuple[BodyItem, ...]) -> list[dict[str, Ground]]:
        """Returns values with which these literals of a statement hold together."""
        self._asked += 1
        predicate = f"___q{self._asked}"
        names = self._writer.condition_of(index, items, predicate)
        if names is None:
            return []
        self._extend(self._writer.taken_lines())
        return self.bindings(predicate, names)

    def named_rule(self, index: int) -> Rule | CrRule:
        """Returns a rule with names for all its variables; see `GroundForms.named_rule`."""
        return self._writer.named_rule(index)

    def _extend(self, text: str | None) -> None:
        try:
            if text is None:
                self._grounding.ground(self.deadline)
            elif text:
                self._grounding.extend(text, self.deadline)
        except Abandoned:
            raise Undecided from None


def _value(symbol: Any) -> Ground:
    from clingo import SymbolType

    if symbol.type is SymbolType.Number:
        return int(symbol.number)
    return GroundTerm(symbol.name, tuple(_value(argument) for argument in symbol.arguments))


def _head_keys(statement: object) -> list[tuple[str, bool]]:
    if isinstance(statement, RangeFact):
        return [(statement.name, statement.negated)]
    if isinstance(statement, Rule | CrRule):
        head = statement.head
        atoms = [each.atom for each in head.elements] if isinstance(head, Choice) else list(head)
        return [(atom.name, atom.negated) for atom in atoms]
    return []


def literal_of(atom: Atom, binding: Binding) -> GroundLiteral | None:
    """Returns the ground literal that an atom is under a binding; None where it has no value."""
    values = []
    for term in atom.arguments:
        value = term_value(term, binding)
        if value is None:
            return None
        values.append(value)
    return GroundLiteral(atom.name, tuple(values), atom.negated)


def term_value(term: Term, binding: Binding) -> Ground | None:
    """Returns the value of a term under a binding; None where it has none."""
    from sparc.explaining.instances import ground_term

    ground = ground_term(term, binding)
    if isinstance(ground, Number):
        return ground.value
    if isinstance(ground, Identifier):
        return GroundTerm(ground.name)
    if isinstance(ground, Record):
        values = [term_value(each, binding) for each in ground.arguments]
        if None in values:
            return None
        return GroundTerm(ground.name, tuple(values))  # type: ignore[arg-type]
    return None
