"""The knowledge at each step of a plan: its answer set, each literal with the sentences of its rules.

Entry point `find_knowledge`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from sparc.lazy_dataclass import dataclass

if TYPE_CHECKING:
    from sparc.answer_sets import Ground, GroundLiteral
    from sparc.sorts.extents import Extent
    from sparc.source import Source
    from sparc.syntax.tree import Atom, Term
    from waiter_cli.answersets.timeline import Timeline
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.model.plan import Plan
    from waiter_cli.model.problem import Problem
    from waiter_cli.translators.base import Translator

__all__ = ["Knowledge", "find_knowledge"]

SECONDS = 8.0


class GivingRule(NamedTuple):
    """A head, the sorts that variables of it must be of, and the sentence above the rule."""

    head: Atom
    guards: tuple[tuple[str, Extent], ...]
    sentence: str


@dataclass(frozen=True)
class Knowledge:
    """An answer set in the order of time, and the rules that may give its literals.

    ``rules`` are those of the program that a sentence of the domain explains.
    """

    literals: tuple[GroundLiteral, ...]
    timeline: Timeline
    rules: tuple[GivingRule, ...]

    def at(self, step: int) -> list[dict[str, Any]]:
        """Returns the literals of a step: ``text``, ``negative``, ``sentences`` and ``change``.

        ``change`` is ``new`` where it did not hold the step before, ``same`` where it did, and ``gone`` for
        what held then and does not now; at step 0 all is the same.
        """
        here = {self._bare(each): each for each in self.literals if self._step(each) == step}
        before = {self._bare(each): each for each in self.literals if self._step(each) == step - 1}
        rows = [
            self._row(each, "same" if step == 0 or bare in before else "new")
            for bare, each in here.items()
        ]
        ended = [each for bare, each in before.items() if bare not in here]
        return rows + [self._row(each, "gone") for each in ended if each.name == "holds"]

    def _step(self, literal: GroundLiteral) -> int | None:
        return self.timeline.step(literal)

    def _bare(self, literal: GroundLiteral) -> tuple[Any, ...]:
        return literal.name, literal.negated, literal.arguments[:-1]

    def _row(self, literal: GroundLiteral, change: str) -> dict[str, Any]:
        sentences = dict.fromkeys(rule.sentence for rule in self.rules if _fits(rule, literal))
        return {
            "text": str(literal),
            "negative": literal.negated,
            "change": change,
            "sentences": list(sentences) if change != "gone" else [],
        }


def find_knowledge(
    problem: Problem, plan: Plan, domain: Domain, translator: Translator
) -> Knowledge:
    """Returns what is known in the answer set in which exactly this plan is carried out."""
    from waiter_cli.answersets.enumerate import AnswerListing, prepare
    from waiter_cli.answersets.timeline import Filter
    from waiter_cli.domain_execution.domain_rules import believed
    from waiter_cli.encoding.domains import domain_for
    from waiter_cli.encoding.template import fill_template

    template = domain_for(problem, domain).template
    source = fill_template(template, believed(problem, domain), plan.horizon)
    program, timeline = prepare(source, translator, time_limit=SECONDS)
    done = "".join(f":- not occurs({action.text},{action.step}).\n" for action in plan.actions)
    program = replace(program, text=f"{program.text}\n{done}")
    answer = next(iter(AnswerListing(program, timeline, Filter(), limit=1)), None)
    literals = timeline.sort(answer.literals) if answer is not None else ()
    return Knowledge(literals, timeline, tuple(_rules(source, template)))


def _rules(source: Source, template: Source) -> Iterator[GivingRule]:
    """Yields the rules of a program, with the sentences above them in the domain."""
    import sparc
    from sparc.syntax.tree import Atom, Rule, SortAtom, Variable
    from waiter_cli.domain_tests.sentences import read_blocks, sentence_at

    blocks = read_blocks(template.text)
    program = sparc.parse(source)
    sorts = sparc.check(program).sorts
    for statement in program.statements:
        if not isinstance(statement, Rule):
            continue
        said = sentence_at(blocks, statement.span.location.line)
        guards = tuple(
            (item.arguments[0].name, sorts[item.name].extent)
            for item in statement.body
            if isinstance(item, SortAtom) and isinstance(item.arguments[0], Variable)
            if item.name in sorts and not item.negated
        )
        heads = statement.head
        for head in heads if isinstance(heads, tuple) else [each.atom for each in heads.elements]:
            if isinstance(head, Atom) and said:
                yield GivingRule(head, guards, said)


def _fits(rule: GivingRule, literal: GroundLiteral) -> bool:
    """Returns whether a rule may give a literal: by its head, and the sorts that it asks for."""
    head = rule.head
    bound: dict[str, Ground] = {}
    if (head.name, head.negated) != (literal.name, literal.negated):
        return False
    if len(head.arguments) != len(literal.arguments):
        return False
    if not all(_matches(*pair, bound) for pair in zip(head.arguments, literal.arguments)):
        return False
    return all(name not in bound or _value(bound[name]) in sort for name, sort in rule.guards)


def _matches(pattern: Term, value: Ground, bound: dict[str, Ground]) -> bool:
    from sparc.syntax.tree import Arithmetic, Identifier, Number, Record, Variable

    if isinstance(pattern, Variable):
        return pattern.name == "_" or bound.setdefault(pattern.name, value) == value
    if isinstance(pattern, Number):
        return pattern.value == value
    if isinstance(pattern, Identifier):
        return str(value) == pattern.name
    if isinstance(pattern, Record):
        if isinstance(value, int) or value.name != pattern.name:
            return False
        pairs = zip(pattern.arguments, value.arguments)
        same = len(pattern.arguments) == len(value.arguments)
        return same and all(_matches(a, b, bound) for a, b in pairs)
    if isinstance(pattern, Arithmetic) and isinstance(pattern.right, Number):  # a later step
        return not isinstance(value, int) or pattern.operator != "+" or value >= pattern.right.value
    return True


def _value(term: Ground) -> Any:
    """Returns a ground term as extents have it."""
    if isinstance(term, int):
        return term
    return (term.name, *map(_value, term.arguments)) if term.arguments else term.name
