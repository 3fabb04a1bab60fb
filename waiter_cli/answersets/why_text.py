"""`sparc.Why` → lines for people, and the document of ``--json``. Entry points `why_lines`, `why_document`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from sparc.explaining.derivation import Absence, CountedElements, Derivation, FailedRule

if TYPE_CHECKING:
    from sparc.explaining.places import StatementPlace
    from sparc.explaining.why import Why

__all__ = ["why_document", "why_lines"]


def why_document(found: Why) -> dict[str, Any]:
    """Returns the document of an answer; ``holds`` is null where a limit came first."""
    document: dict[str, Any] = {
        "literal": found.literal,
        "holds": found.holds,
        "set": found.number,
    }
    if found.holds is None:
        return {**document, "limit": found.limit} if found.limit else document
    if found.because:
        document["because"] = _derivation(found.because[0])
        if found.because[1:]:
            document["further"] = [_derivation(each) for each in found.because[1:]]
    if found.because_not is not None:
        document |= _absence(found.because_not)
    return document


def _derivation(node: Derivation) -> dict[str, Any]:
    out: dict[str, Any] = {"literal": node.literal}
    if node.place is not None:
        out |= {"rule": _place(node.place), "instance": node.instance}
    if node.note:
        out["note"] = node.note
    if node.aggregates:
        out["aggregates"] = [_elements(each) for each in node.aggregates]
    if node.absent is not None:
        out["because_not"] = _absence(node.absent)["because_not"]
    out["premises"] = [_derivation(each) for each in node.premises]
    return out


def _elements(counted: CountedElements) -> dict[str, Any]:
    return {"aggregate": counted.aggregate, "elements": list(counted.elements)}


def _absence(absent: Absence) -> dict[str, Any]:
    note = {"note": absent.note} if absent.note else {}
    return {"because_not": [_failed(each) for each in absent.rules], **note}


def _failed(rule: FailedRule) -> dict[str, Any]:
    out: dict[str, Any] = {
        "rule": _place(rule.place),
        "instance": rule.instance,
        "failed": rule.failed,
    }
    if rule.note:
        out["note"] = rule.note
    if rule.counted is not None:
        out["aggregates"] = [_elements(rule.counted)]
    if isinstance(rule.then, Absence):
        out["then"] = {"literal": rule.then.literal, "holds": False, **_absence(rule.then)}
    elif isinstance(rule.then, Derivation):
        because = _derivation(rule.then)
        out["then"] = {"literal": rule.then.literal, "holds": True, "because": because}
    return out


def _place(place: StatementPlace) -> dict[str, Any]:
    return {**place.as_dict(), "sentence": place.sentence}


# ------------------------------------------------------------------ for people


def why_lines(found: Why) -> Iterator[str]:
    """Yields the answer as lines; what supports a line stands below it, indented."""
    where = "the answer set" if found.number == 1 else f"answer set {found.number}"
    if found.holds:
        yield f"{found.literal} is in {where}, because:"
        for number, root in enumerate(found.because):
            if number:
                yield ""
            yield from _derivation_lines(root, "  ")
    elif found.because_not is not None:
        yield f"{found.literal} is not in {where}."
        yield from _absence_lines(found.because_not, "  ")


def _derivation_lines(node: Derivation, margin: str) -> Iterator[str]:
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
        yield from _derivation_lines(premise, margin + "  ")


def _counted(aggregate: CountedElements) -> str:
    counted = ", ".join(f"{{{one}}}" for one in aggregate.elements) or "nothing"
    return f"{aggregate.aggregate} counts {counted}"


_WORDS = {
    "chosen": "chosen: nothing forces it, and it is consistent",
    "needed": "applied, since without it there is no answer set",
}


def _rule_lines(place: StatementPlace, instance: str, literal: str, margin: str) -> Iterator[str]:
    yield f"{margin}{place}: {place.text}"
    if place.sentence:
        yield f"{margin}  {place.sentence}"
    if instance not in (literal, place.text.removesuffix(".")):
        yield f"{margin}  as in: {instance}"


def _absence_lines(absent: Absence, margin: str) -> Iterator[str]:
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
                yield from _absence_lines(rule.then, margin + "    ")
        elif isinstance(rule.then, Derivation):
            yield f"{margin}    {rule.then.literal} is there:"
            yield from _derivation_lines(rule.then, margin + "    ")


def _failure(rule: FailedRule) -> str:
    if rule.note == "not chosen":
        return "its body holds, but this was not chosen"
    if rule.note == "not needed":
        return "its body holds, but it was not needed"
    note = f" ({rule.note})" if rule.note else ""
    return f"fails: {rule.failed}{note}"
