"""Tells how predicates bear on whether there is a plan: `Program` → `PredicateSigns`.

An atom of a constraint restricts, the condition of a choice among actions frees, and ``not`` turns the
sign round; a rule hands the signs of its head on to its body.  Fluents and actions bear on a plan
both ways, and so does what stands in an aggregate, in a disjunction or in a choice of anything else.
That the goals hold frees; what is done after they have held does not count.

>>> from sparc import parse
>>> program = parse('''predicates occurs(#a). possible(#a). shut(#a). late().
... rules {occurs(A) : possible(A)} 1. possible(A) :- #a(A), not shut(A). :- late. ''')
>>> signs = PredicateSigns(program)
>>> signs.only(FREES, ("possible", False)), signs.only(RESTRICTS, ("shut", False))
(True, True)
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, TypeAlias

from sparc.syntax.tree import (
    Aggregate,
    Atom,
    BodyItem,
    Choice,
    CrRule,
    Head,
    Naf,
    Optimize,
    Program,
    RangeFact,
    Rule,
    Statement,
)

__all__ = ["FREES", "RESTRICTS", "PredicateSigns", "SignedName", "heads_of", "literals_of"]

SignedName: TypeAlias = tuple[str, bool]
"""The name of a predicate, and whether it is negated strongly."""

FREES, RESTRICTS, _BOTH = 1, -1, 0


class _Use(NamedTuple):
    """More of a literal means more (or less) of a head; None is the existence of a plan itself."""

    literal: SignedName
    sign: int
    head: SignedName | None


class PredicateSigns:
    """The signs of each literal of a program, and the literals that are ``offered`` as actions.

    ``wishes`` are the names of predicates that the goals are made of.
    """

    def __init__(self, program: Program) -> None:
        self.offered: set[SignedName] = set()
        uses = [use for each in program.statements for use in self._uses(each)]
        uses += _contraries(program)
        self.wishes = {"required"} | _leading_to("reached", uses)
        self._signs: dict[SignedName, set[int]] = defaultdict(set)
        changed = True
        while changed:
            changed = False
            for literal, sign, head in uses:
                found = {sign * each for each in self._of(head)}
                changed |= not found <= self._signs[literal]
                self._signs[literal] |= found

    def only(self, sign: int, literal: SignedName) -> bool:
        """Returns whether a literal bears on a plan, and with this sign alone."""
        return literal[0] != "goal" and self._of(literal) == {sign}

    def _of(self, literal: SignedName | None) -> set[int]:
        if literal is None or literal[0] == "goal":
            return {FREES}
        if literal[0] == "holds" or literal == ("occurs", False):
            return {_BOTH}
        return self._signs[literal]

    def _uses(self, statement: Statement) -> Iterator[_Use]:
        """Yields what a statement depends on, and what it reaches."""
        match statement:
            case Rule(head=Choice() as choice, body=body):
                yield from self._of_choice(choice, body)
            case Rule(head=head, body=body):
                yield from _of_rule(heads_of(head), body)
            case CrRule(head=head, body=body):
                yield from _both([*heads_of(head), *(name for name, _ in literals_of(body))])
            case Optimize(atoms=atoms):
                yield from _both(name for name, _ in literals_of(atoms))
            case RangeFact():
                pass
            case _:
                yield from _both(name for name, _ in literals_of(statement.body))

    def _of_choice(self, choice: Choice, body: Sequence[BodyItem]) -> Iterator[_Use]:
        conditions = [each for element in choice.elements for each in element.condition]
        if set(heads_of(choice)) != {("occurs", False)}:
            yield from _both(
                [*heads_of(choice), *(n for n, _ in literals_of([*conditions, *body]))]
            )
            return
        for literal, sign in literals_of(conditions):
            yield _Use(literal, sign, None)
            if sign == FREES:
                self.offered.add(literal)
        at_most = choice.left is None and (choice.right is None or choice.right.operator[0] == "<")
        for literal, sign in literals_of(body):
            yield _Use(literal, sign if at_most else _BOTH, None)


def heads_of(head: Head) -> list[SignedName]:
    """Returns the literals that a head may give."""
    atoms = [each.atom for each in head.elements] if isinstance(head, Choice) else head
    return [(atom.name, atom.negated) for atom in atoms if isinstance(atom, Atom)]


def literals_of(items: Iterable[object]) -> Iterator[tuple[SignedName, int]]:
    """Yields the literals of a body, with the sign with which more of them lets it hold."""
    for item in items:
        match item:
            case Atom(name=name, negated=negated):
                yield (name, negated), FREES
            case Naf(operand=Atom(name=name, negated=negated)):
                yield (name, negated), RESTRICTS
            case Aggregate(elements=elements):
                for element in elements:
                    yield from ((name, _BOTH) for name, _ in literals_of(element.condition))


def _of_rule(heads: list[SignedName], body: Sequence[BodyItem]) -> Iterator[_Use]:
    if len(heads) > 1:
        yield from _both(heads)
    for literal, sign in literals_of(body):
        if not heads:
            yield _Use(literal, -sign, None)
        for head in heads:
            yield _Use(literal, sign, head)


def _both(literals: Iterable[SignedName]) -> Iterator[_Use]:
    return (_Use(literal, _BOTH, None) for literal in literals)


def _contraries(program: Program) -> list[_Use]:
    """Returns that of two contrary literals that rules give each restricts: never do both hold."""
    given = {
        head
        for each in program.statements
        if isinstance(each, Rule)
        for head in heads_of(each.head)
    }
    return [
        _Use(literal, RESTRICTS, None) for literal in given if (literal[0], not literal[1]) in given
    ]


def _leading_to(name: str, uses: Sequence[_Use]) -> set[str]:
    """Returns the predicates of which one of that name is made, it among them; fluents are no part."""
    names = {name}
    size = 0
    while size < len(names):
        size = len(names)
        below = {use.literal[0] for use in uses if use.head is not None and use.head[0] in names}
        names |= below - {"holds", "occurs"}
    return names
