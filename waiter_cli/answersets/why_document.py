"""`sparc.Why` → the document of ``--json``. Entry point `why_document`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sparc.explaining.derivation import Absence, CountedElements, Derivation, FailedRule

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sparc.explaining.places import StatementPlace
    from sparc.explaining.why import Why

__all__ = ["why_document"]


def why_document(answers: Sequence[Why]) -> dict[str, Any]:
    """Returns the document of an answer, or of several: ``literals``, one of each."""
    if len(answers) > 1:
        return {"literals": [_answer(each) for each in answers]}
    return _answer(answers[0])


def _answer(found: Why) -> dict[str, Any]:
    """Returns what is told of one literal; ``holds`` is null where a limit came first."""
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
