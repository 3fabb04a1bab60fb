"""The form of a domain's program in time: which statements are about any step and the next. Class `StepForm`.

A statement is about one step where all its steps are one variable, and about a step and the next where
they are I and I+1.  What is about step 0 only is left out of programs about any step; so are constraints
of any other form, which can only let more come about.  Any other rule leaves the question open.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from sparc.syntax.tree import (
    Aggregate,
    Arithmetic,
    Atom,
    Choice,
    ChoiceElement,
    Comparison,
    Identifier,
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

if TYPE_CHECKING:
    from sparc.checking.typed_program import TypedProgram
    from sparc.source import Span

__all__ = ["OpenQuestion", "StepForm"]

_STEP = "step"


class OpenQuestion(Exception):
    """The program is not of a form of which more can be said."""


@dataclass(frozen=True)
class _Times:
    """The step terms of some atoms: variables with what is added to them, and numbers."""

    variables: tuple[tuple[str, int], ...] = ()
    numbers: tuple[int, ...] = ()


class StepForm:
    """Sorts the statements of a program: which are about any step, and which literals are carried on."""

    def __init__(self, typed: TypedProgram) -> None:
        self.typed = typed
        self.timed = {
            name
            for name, signature in typed.predicates.items()
            if signature.sorts and signature.sorts[-1].name == _STEP
        }
        if not self.timed:
            raise OpenQuestion
        self.carried: set[str] = {"holds"} & self.timed
        self.frozen: set[str] = set()
        self.about_plans: set[str] = set()  # without a step, and yet from steps: success
        self.left_out: set[Span] = set()  # constraints of time, and what is about step 0 only
        self.demands: set[Span] = set()  # constraints on predicates about the whole plan
        statements = typed.program.statements
        rules = [self.rule(each) for each in statements if not isinstance(each, RangeFact)]
        for rule in rules:
            if rule.head:
                self.classify(rule)
        for rule in rules:
            if rule.head and rule.span not in self.left_out:
                if self.names(rule) & self.about_plans:
                    raise OpenQuestion
            elif not rule.head:
                self.constraint(rule)

    def rule(self, statement: Statement) -> Rule:
        if not isinstance(statement, Rule):
            raise OpenQuestion
        return statement

    def names(self, rule: Rule) -> set[str]:
        return {atom.name for atom in _body_atoms(rule)}

    def classify(self, rule: Rule) -> None:
        """Sorts a rule with a head."""
        heads = list(_head_atoms(rule))
        head, body = self.times(heads), self.times(_body_atoms(rule))
        variables = {name for name, _ in (*head.variables, *body.variables)}
        numbers = {*head.numbers, *body.numbers}
        timed = any(atom.name in self.timed for atom in heads)
        if numbers and (variables or numbers != {0}):
            raise OpenQuestion
        if numbers:
            self.left_out.add(rule.span)
            if not timed:
                self.frozen |= {atom.name for atom in heads}
            return
        if not variables:
            return
        if len(variables) > 1 or variables & _used_otherwise(rule, self.timed):
            raise OpenQuestion
        if not timed:
            self.about_plans |= {atom.name for atom in heads}
            self.left_out.add(rule.span)
            return
        first = {offset for _, offset in head.variables}
        every = first | {offset for _, offset in body.variables}
        if len(first) != 1 or not first <= {0, 1}:
            raise OpenQuestion
        if max(every) > min(first) or max(every) - min(every) > 1:
            raise OpenQuestion
        if len(every) > 1 or first != {0}:
            self.carried |= {atom.name for atom in heads if atom.name in self.timed}

    def constraint(self, rule: Rule) -> None:
        """Sorts a constraint: those of time are left out, and so are demands on the whole plan."""
        times = self.times(_body_atoms(rule), strict=False)
        offsets = {offset for _, offset in times.variables}
        names = {name for name, _ in times.variables}
        if self.names(rule) & self.about_plans:
            self.left_out.add(rule.span)
            self.demands.add(rule.span)
        elif (
            times.numbers
            or len(names) > 1
            or names & _used_otherwise(rule, self.timed)
            or (offsets and max(offsets) - min(offsets) > 1)
        ):
            self.left_out.add(rule.span)

    def times(self, atoms: Iterable[Atom], *, strict: bool = True) -> _Times:
        """Returns the step terms of atoms; one that is none of ours leaves all open, or counts as a number."""
        variables: list[tuple[str, int]] = []
        numbers: list[int] = []
        for atom in atoms:
            if atom.name not in self.timed:
                continue
            term = atom.arguments[-1]
            match term:
                case Variable(name=name):
                    variables.append((name, 0))
                case Number(value=value):
                    numbers.append(value)
                case Arithmetic(
                    operator=sign, left=Variable(name=name), right=Number(value=value)
                ) if sign in "+-":
                    variables.append((name, value if sign == "+" else -value))
                case _:
                    if strict:
                        raise OpenQuestion
                    numbers.append(-1)
        return _Times(tuple(variables), tuple(numbers))


def _head_atoms(rule: Rule) -> Iterator[Atom]:
    if isinstance(rule.head, Choice):
        for element in rule.head.elements:
            if isinstance(element.atom, Atom):
                yield element.atom
        return
    for atom in rule.head:
        if isinstance(atom, Atom):
            yield atom


def _body_atoms(rule: Rule) -> Iterator[Atom]:
    """Yields the atoms on which a rule depends: those of its body, and of conditions in its head."""
    items: list[object] = list(rule.body)
    if isinstance(rule.head, Choice):
        items += [literal for element in rule.head.elements for literal in element.condition]
    while items:
        item = items.pop()
        if isinstance(item, Naf):
            items.append(item.operand)
        elif isinstance(item, Aggregate):
            items += [literal for element in item.elements for literal in element.condition]
        elif isinstance(item, Atom):
            yield item


def _local_steps(rule: Rule, timed: set[str]) -> set[str]:
    """Returns the variables that are steps within an aggregate or a choice, and no step of the body."""
    outer: set[str] = set()
    inner: set[str] = set()
    heads = () if isinstance(rule.head, Choice) else rule.head
    for item in (*rule.body, *heads):
        literal = item.operand if isinstance(item, Naf) else item
        if isinstance(literal, (Atom, SortAtom)) and literal.arguments:
            if literal.name in timed or literal.name == _STEP:
                outer |= _variables(literal.arguments[-1])
        elif isinstance(literal, Aggregate):
            inner |= _inner_steps(literal, timed)
    if isinstance(rule.head, Choice):
        inner |= _inner_steps(rule.head, timed)
    return inner - outer


def _inner_steps(item: Aggregate | Choice, timed: set[str]) -> set[str]:
    names: set[str] = set()
    for element in item.elements:
        literals: list[object] = list(element.condition)
        if isinstance(element, ChoiceElement):
            literals.append(element.atom)
        for literal in literals:
            atom = literal.operand if isinstance(literal, Naf) else literal
            if isinstance(atom, Atom) and atom.name in timed:
                names |= _variables(atom.arguments[-1])
    return names


def _variables(term: Term) -> set[str]:
    match term:
        case Variable(name=name):
            return {name}
        case Arithmetic(left=left, right=right):
            return _variables(left) | _variables(right)
    return set()


def _used_otherwise(rule: Rule, timed: set[str]) -> set[str]:
    """Returns the variables that stand elsewhere than as the step of an atom, or in ``#step(I)``.

    So do those that are the step of what an aggregate or a choice counts, and of nothing outside it.
    """
    names = _local_steps(rule, timed)
    todo: list[object] = [rule.head, *rule.body]
    while todo:
        item = todo.pop()
        match item:
            case Variable(name=name):
                names.add(name)
            case Atom(name=name, arguments=arguments):
                todo += arguments[:-1] if name in timed else arguments
            case SortAtom(name=name, arguments=arguments):
                todo += () if name == _STEP else arguments
            case Naf(operand=operand):
                todo.append(operand)
            case Comparison(left=left, right=right) | Arithmetic(left=left, right=right):
                todo += [left, right]
            case Record(arguments=arguments):
                todo += arguments
            case Aggregate() | Choice():
                guards = (item.left, item.right)
                todo += [guard.bound for guard in guards if guard is not None]
                for element in item.elements:
                    todo += element.condition
                    if isinstance(element, ChoiceElement):
                        todo.append(element.atom)
                    else:
                        todo += element.terms
            case tuple():
                todo += item
            case Number() | Identifier() | None:
                pass
    return names
