"""Derivations and absences as lines for people. Entry points `derivation_lines`, `absence_lines`."""

from __future__ import annotations

from collections.abc import Iterator

from sparc.explaining.derivation import Absence, CountedElements, Derivation, FailedRule
from sparc.explaining.places import StatementPlace

__all__ = ["absence_lines", "derivation_lines"]


def derivation_lines(node: Derivation, margin: str) -> Iterator[str]:
    """Yields a derivation; what supports a line stands below it, indented."""
    note = f"  ({_WORDS.get(node.note, node.note)})" if node.note else ""
    yield f"{margin}{node.literal}{note}"
    if node.place is not None and (node.premises or node.aggregates or node.note):
        yield from _rule_lines(node.place, str(node.instance), node.literal, margin + "    ")
    elif node.place is not None:
        yield f"{margin}    {node.place}: {node.place.text}"
    for each in node.aggregates:
        yield f"{margin}    {_counted(each)}"
    if node.absent is not None:
        yield from _failed_rules(node.absent, margin + "    ")
    for premise in node.premises:
        yield from derivation_lines(premise, margin + "  ")


def _counted(aggregate: CountedElements) -> str:
    counted = ", ".join(f"{{{one}}}" for one in aggregate.elements) or "nothing"
    value = "" if aggregate.value is None else f", which comes to {aggregate.value}"
    return f"{aggregate.aggregate} counts {counted}{value}"


_WORDS = {
    "chosen": "chosen among what this rule allows",
    "needed": "applied, since without it there is no answer set",
}


def _rule_lines(place: StatementPlace, instance: str, literal: str, margin: str) -> Iterator[str]:
    yield f"{margin}{place}: {place.text}"
    if place.sentence:
        yield f"{margin}  {place.sentence}"
    if instance not in (literal, place.text.removesuffix(".")):
        yield f"{margin}  as in: {instance}"


def absence_lines(absent: Absence, margin: str) -> Iterator[str]:
    """Yields why a literal is not there: the rules that could give it, each with what fails."""
    if absent.note:
        yield f"{margin}{absent.note}"
    yield from _failed_rules(absent, margin)


def _failed_rules(absent: Absence, margin: str) -> Iterator[str]:
    for rule in absent.rules:
        yield from _rule_lines(rule.place, rule.instance, absent.literal, margin)
        yield f"{margin}  {_failure(rule)}"
        if rule.counted is not None:
            yield f"{margin}    {_counted(rule.counted)}"
        if isinstance(rule.then, Absence):
            if rule.then.rules or rule.then.note:
                yield from absence_lines(rule.then, margin + "    ")
        elif isinstance(rule.then, Derivation):
            yield f"{margin}    {rule.then.literal} is there:"
            yield from derivation_lines(rule.then, margin + "    ")


def _failure(rule: FailedRule) -> str:
    if rule.note == "not chosen":
        return "its body holds, but this was not chosen"
    if rule.note == "not needed":
        return "its body holds, but it was not needed"
    note = f" ({rule.note})" if rule.note else ""
    return f"fails: {rule.failed}{note}"
