"""What goes wrong in a run, as a command line says it."""

from __future__ import annotations

import pytest

from tests.support.playing import layout_of
from waiter_cli.errors import InputError
from waiter_cli.evenings.injections import read_injection

LAYOUT = layout_of("report")


@pytest.mark.parametrize(
    ("text", "kind", "time", "subject", "amount"),
    [
        ("block:n5-n6@12+8", "block", 12.0, ("n5", "n6"), 8.0),
        ("block:n6-n5@0", "block", 0.0, ("n6", "n5"), None),
        ("leave:c1@3.5", "leave", 3.5, ("c1",), None),
        ("enter:4@1", "enter", 1.0, ("4",), None),
        ("bill:table1@2", "bill", 2.0, ("table1",), None),
        ("slip:0.25", "slip", 0.0, (), 0.25),
        ("stall:5@4", "stall", 4.0, (), 5.0),
    ],
)
def test_injections_are_read(text, kind, time, subject, amount) -> None:  # type: ignore[no-untyped-def]
    found = read_injection(text, LAYOUT)
    assert (found.kind, found.time, found.subject, found.amount) == (kind, time, subject, amount)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("flood:n1@2", "no such injection: flood"),
        ("slip", "no such injection: slip|slip"),
        ("slip:1.5", "between 0 and 1"),
        ("slip:nan", "no number"),
        ("block:n1-n6@2", "no edge n1-n6"),
        ("block:n5-n6", "what or when"),
        ("bill:table9@2", "unknown table table9; did you mean table2"),
        ("enter:0@2", "from 1 to 1000"),
        ("leave:c1@soon", "no number"),
        ("stall:-1@2", "no number"),
    ],
)
def test_injections_that_make_no_sense(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_injection(text, LAYOUT)
