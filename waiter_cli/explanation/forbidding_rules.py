"""Finds the rules of a domain that only forbid, and those that say when an action is possible.

Entry points `forbidding_rules`, `permitting_rules`, `without_rules`.  Without a rule that only
forbids, whatever was a plan still is one; so it is where an action is possible whatever its rule
asks for.  Which rules are such is read off `PredicateSigns`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.encoding.slots import parts_of
from waiter_cli.encoding.template import TemplatePart, TemplatePiece, TemplateSlot, read_template
from waiter_cli.errors import Where

if TYPE_CHECKING:
    from sparc.explaining.places import StatementPlace
    from sparc.syntax.tree import Rule
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.explanation.predicate_signs import PredicateSigns
    from waiter_cli.model.problem import Problem

__all__ = ["DomainRule", "forbidding_rules", "permitting_rules", "without_rules"]


@dataclass(frozen=True)
class DomainRule:
    """A statement of a domain; without ``[start, end)`` of the template's text it is relaxed.

    ``instead`` is what stands there then.
    """

    place: StatementPlace
    start: int
    end: int
    instead: str = ""

    @property
    def where(self) -> Where:
        """Returns where the statement begins."""
        return Where(self.place.file, self.place.line, self.place.column)

    @property
    def text(self) -> str:
        """Returns the statement, with the sentence above it."""
        sentence = f" ({self.place.sentence.rstrip('.')})" if self.place.sentence else ""
        return f"{self.place.text}{sentence}"


def without_rules(domain: Domain, rules: Iterable[DomainRule]) -> Domain:
    """Returns the domain with these rules relaxed, every other line where it was."""
    text = domain.template.text
    for rule in rules:
        blank = "".join(c if c == "\n" else " " for c in text[rule.start : rule.end])
        text = text[: rule.start] + rule.instead + blank[len(rule.instead) :] + text[rule.end :]
    return replace(domain, template=replace(domain.template, text=text))


def forbidding_rules(problem: Problem, domain: Domain) -> tuple[DomainRule, ...]:
    """Returns the constraints of a domain, and its rules and facts that can only forbid."""
    from sparc.explaining.places import place_of
    from waiter_cli.explanation.predicate_signs import RESTRICTS, heads_of

    rules, signs = _read(problem, domain)
    return tuple(
        DomainRule(place_of(rule.span), rule.span.start, rule.span.end)
        for rule in rules
        if isinstance(rule.head, tuple) and not _is_about_wishes(rule, signs)
        if all(signs.only(RESTRICTS, head) for head in heads_of(rule.head))
    )


def permitting_rules(problem: Problem, domain: Domain) -> tuple[DomainRule, ...]:
    """Returns the rules that say when an action is possible; each is relaxed to: always."""
    from sparc.explaining.places import place_of
    from waiter_cli.explanation.predicate_signs import FREES, heads_of

    rules, signs = _read(problem, domain)
    found = []
    for rule in rules:
        if not isinstance(rule.head, tuple) or not rule.body:
            continue
        heads = heads_of(rule.head)
        if len(heads) == 1 and heads[0] in signs.offered and signs.only(FREES, heads[0]):
            end = rule.head[0].span.end
            found.append(DomainRule(place_of(rule.span), end, rule.span.end, "."))
    return tuple(found)


def _read(problem: Problem, domain: Domain) -> tuple[list[Rule], PredicateSigns]:
    """Returns the rules of a domain's own text that this problem keeps, and the signs in that text."""
    from sparc.errors import SourceError, SourceErrors
    from sparc.syntax.parser import parse
    from sparc.syntax.tree import Program, Rule
    from waiter_cli.explanation.predicate_signs import PredicateSigns

    template = domain.template
    try:
        program = parse(template)
    except (SourceError, SourceErrors):  # a template that is no program as it stands
        program = Program((), (), (), (), None)
    kept = set(_kept_lines(read_template(template), parts_of(problem) | {"choice"}))
    rules = []
    for each in program.statements:
        first = each.span.location.line
        lines = range(first, first + each.span.text.count("\n") + 1)
        if isinstance(each, Rule) and kept.issuperset(lines):
            rules.append(each)
    return rules, PredicateSigns(program)


def _kept_lines(pieces: Sequence[TemplatePiece], have: Iterable[str]) -> Iterator[int]:
    """Yields the numbers of the lines of a template that stand in a problem's program as they are."""
    for piece in pieces:
        if isinstance(piece, TemplatePart):
            yield from _kept_lines(piece.pieces, have) if piece.name in have else ()
        elif not isinstance(piece, TemplateSlot):
            yield piece[0]


def _is_about_wishes(rule: Rule, signs: PredicateSigns) -> bool:
    """Returns whether a rule says that what is wanted has to hold: that is the wish's own doing."""
    from waiter_cli.explanation.predicate_signs import heads_of, literals_of

    names = {name for name, _ in heads_of(rule.head)}
    bodies = {name for (name, _), _ in literals_of(rule.body)}
    return bool(names & signs.wishes or bodies & {"required", "reached", "success"})
