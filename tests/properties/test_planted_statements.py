"""Programs as a teacher has them, each with one statement too many: it is found, and what stands against it.

The lines of the cause end in ``%! cause``, that of the statement too many in ``%! planted``.
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from random import Random

import pytest

import sparc
from sparc.source import Span
from tests.support.paths import ROOT

PROGRAMS = sorted((ROOT / "tests" / "sparc" / "planted").glob("*.sparc"))


def solvable(text: str, left_out: Collection[Span]) -> bool:
    """Whether a program has an answer set without some of its statements."""
    for span in left_out:
        text = text[: span.start] + " " * (span.end - span.start) + text[span.end :]
    return bool(list(sparc.solve(text, models=1)))


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_the_statement_too_many_is_in_the_cause(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    (planted,) = [number for number, line in enumerate(lines, 1) if line.endswith("%! planted")]
    marked = {number for number, line in enumerate(lines, 1) if "%!" in line}
    found = sparc.explain(text)
    assert found.consistent is False and found.complete
    (cause,) = found.causes
    assert {member.place.line for member in cause.members} == marked
    statements = {one.span.location: one.span for one in sparc.parse(text).statements}
    at = {(where.line, where.column): span for where, span in statements.items()}
    members = {(member.place.line, member.place.column) for member in cause.members}
    others = [span for where, span in at.items() if where not in members]
    assert not solvable(text, others), "the cause alone has an answer set"
    draw = Random(1)
    for member in members & at.keys():
        some = [[span for span in others if draw.random() < share] for share in [0.2, 0.5] * 20]
        assert any(solvable(text, [at[member], *out]) for out in [[], others, *some]), member
    assert any(planted == place.line for mend in found.mends for place in mend.without)
    for mend in found.mends:
        assert solvable(text, [at[place.line, place.column] for place in mend.without]), mend


def test_there_are_many() -> None:
    assert len(PROGRAMS) == 15
