"""What a line of the live loop that was misunderstood may have meant."""

from __future__ import annotations

from typing import Any

import pytest

from waiter_cli.serve.line_hints import meant
from waiter_cli.serve.line_kinds import ASKS, EVENTS


def is_understood(line: dict[str, Any]) -> bool:
    return len(set(line) & set(EVENTS)) == 1


@pytest.mark.parametrize(
    ("found", "line"),
    [
        ({"event": "clear", "path": ["n1", "n2"]}, {"clear": ["n1", "n2"]}),
        ({"type": "block", "edge": ["n1", "n2"]}, {"block": ["n1", "n2"]}),
        ({"cmd": "finished", "step": 4}, {"done": 4}),
        ({"enter": ["c1"]}, {"observe": {"enter": ["c1"]}}),
        ({"paid": "table1"}, {"goal": {"paid": "table1"}}),
        ("{'done': 4}", {"done": 4}),
        ("ask state", {"ask": "state"}),
    ],
)
def test_what_is_wrapped_otherwise_is_understood(found: object, line: dict[str, Any]) -> None:
    assert meant(found, is_understood) == line


@pytest.mark.parametrize("found", [None, True, [], {}, "", "\0", "x" * 3000, {"bill": {"a": []}}])
def test_nothing_is_made_up(found: object) -> None:
    assert meant(found, lambda line: False) in (None, {"observe": found})


def test_every_question_is_guessed_from_its_word() -> None:
    assert [meant(word, is_understood) for word in ASKS] == [{"ask": word} for word in ASKS]
