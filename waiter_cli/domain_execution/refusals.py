"""Says why a domain has no state after an action, or several. Entry points `forbidden`, `left_open`.

The reasons are those of `sparc explain` and `sparc why`: the program of the one step, with the action
demanded, has no answer set because of a few of its statements; or no rule makes the action possible.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sparc.source import Source
from waiter_cli.domain_execution.step_program import given_lines, one_step_problem
from waiter_cli.encoding.facts import ProgramLine
from waiter_cli.encoding.own_words import unknown_term
from waiter_cli.encoding.slots import SLOTS, parts_of
from waiter_cli.encoding.template import fill_pieces, read_template
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem

if TYPE_CHECKING:
    from sparc.explaining.derivation import Absence, FailedRule
    from sparc.explaining.places import StatementPlace

__all__ = ["forbidden", "left_open"]

TIME_LIMIT = 5.0  # seconds for a reason
_MOST = 3  # rules that are named


def forbidden(template: Source, problem: Problem, actions: Sequence[Action], horizon: int) -> str:
    """Returns why no answer set has these actions done at once, in the situation of a problem."""
    import sparc
    from sparc.explaining.explain import explain

    what = " and ".join(action.text for action in actions) or (
        "waiting" if horizon else "the start"
    )
    free = sparc.check(sparc.parse(_program(template, problem, horizon, [])))
    for action in actions:
        unknown = unknown_term(free, "occurs", action.text)
        if unknown is not None:
            message, hint = unknown
            return f"{action.text}: {message}" + (f" ({hint})" if hint else "")
    demands = [f":- not occurs({action.text}, 0)." for action in actions]
    if horizon:
        done = " ; ".join(f"A != {action.text}" for action in actions)
        demands += [
            ":- occurs(A, 0)." if not actions else f":- occurs(A, 0), {done.replace(' ; ', ', ')}."
        ]
    whole = sparc.check(sparc.parse(_program(template, problem, horizon, demands)))
    found = explain(whole, time_limit=TIME_LIMIT, most=1)
    places = [member.place for cause in found.causes for member in cause.members]
    rules = [place for place in places if _is_rule_of(place, template)]
    constraints = [place for place in rules if place.text.startswith(":-")]
    if not constraints and actions:
        reason = _not_possible(free, actions, template)
        if reason is not None:
            return f"{what}: {reason}"
    denials = [place for place in rules if place.text.startswith("-occurs")]
    named = "; ".join(map(_told, (denials or constraints or rules)[:_MOST]))
    return f"{what}: forbidden by {named}" if named else f"{what}: the domain has no such step"


def left_open(
    held: Sequence[frozenset[str]], what: str, template: Source, problem: Problem, horizon: int
) -> str:
    """Returns what two answer sets of one step differ in, and the rule that lets them."""
    one, two = held[0], held[1]
    differ = sorted(one ^ two)[:4]
    first = differ[0]
    with_it = "with" if first in one else "without"
    other = "without" if with_it == "with" else "with"
    more = f", and {', '.join(differ[1:])} with it" if len(differ) > 1 else ""
    rule = _choosing(_program(template, problem, horizon, []), differ)
    opened = "" if rule is None else f"; left open by {_told(rule)}: say which, under a condition"
    return (
        f"{what}: the domain leaves open what comes of it: one answer set is {with_it} {first}, "
        f"another {other} it{more}{opened}"
    )


def _choosing(program: Source, fluents: Sequence[str]) -> StatementPlace | None:
    """Returns the first rule whose head offers several things, one of them of these fluents."""
    import sparc
    from sparc.explaining.places import place_of
    from sparc.syntax.tree import Atom, Choice, Identifier, Record, Rule

    names = {fluent.partition("(")[0] for fluent in fluents}
    for rule in sparc.parse(program).statements:
        if not isinstance(rule, Rule):
            continue
        offers_several = isinstance(rule.head, Choice) or len(rule.head) > 1
        heads = (
            [element.atom for element in rule.head.elements]
            if isinstance(rule.head, Choice)
            else rule.head
        )
        for atom in heads if offers_several else ():
            first = atom.arguments[0] if isinstance(atom, Atom) and atom.arguments else None
            if isinstance(first, Record | Identifier) and first.name in names:
                return place_of(rule.span)
    return None


def _program(template: Source, problem: Problem, horizon: int, demands: Sequence[str]) -> Source:
    posed = one_step_problem(problem)
    dummy = [ProgramLine("required(0)."), ProgramLine(f"reached(0, {horizon}).")]
    dummy += map(ProgramLine, demands)
    situation = given_lines(template, posed, start=True)
    placed: list[str] = []

    def lines_of(name: str) -> list[ProgramLine]:
        if name in ("state", "guest_state"):
            placed.append(name)
            return [*situation, *dummy]
        if name in ("observations", "goals", "guest_goals", "timetable"):
            return []
        return SLOTS[name](posed, horizon)

    have = parts_of(posed) | {"choice"}
    return fill_pieces(template.name, read_template(template), lines_of, have)


def _is_rule_of(place: StatementPlace, template: Source) -> bool:
    """Returns whether a statement is one of the template's own, and not what it was filled with."""
    lines = template.text.split("\n")
    index = place.line - template.first_line
    if place.file != template.name or not 0 <= index < len(lines):
        return False
    return lines[index].lstrip().startswith(place.text[:12].split("(")[0].strip() or place.text)


def _told(place: StatementPlace) -> str:
    sentence = f" ({place.sentence.rstrip('.')})" if place.sentence else ""
    return f"{place}: {place.text}{sentence}"


def _not_possible(program: object, actions: Sequence[Action], template: Source) -> str | None:
    """Returns the first condition that an action lacks, and the rule that has it."""
    import sparc
    from sparc.checking.typed_program import TypedProgram

    assert isinstance(program, TypedProgram)
    for action in actions:
        found = sparc.why(program, f"occurs({action.text}, 0)", time_limit=TIME_LIMIT)
        if found.because_not is None:
            continue
        if found.because_not.note and not found.because_not.rules:
            return found.because_not.note
        failed = _condition(found.because_not, template)
        if failed is not None and failed.failed != f"occurs({action.text},0)":
            return f"{failed.failed} does not hold, needed by {_told(failed.place)}"
    return None


def _condition(absence: Absence, template: Source) -> FailedRule | None:
    """Returns the rule of the domain that would make an action possible, and what fails in it."""
    from sparc.explaining.derivation import Absence as Missing

    failed_rule = None
    at: Absence | None = absence
    while at is not None and at.rules:
        rule = at.rules[0]
        if rule.failed and _is_rule_of(rule.place, template):
            failed_rule = rule
            if not rule.failed.startswith(("possible(", "offered(")):
                break
        at = rule.then if isinstance(rule.then, Missing) else None
    return failed_rule
