"""JSON documents: one shape for a place, an action and a wish, whichever command prints it."""

from __future__ import annotations

import pytest

from waiter_cli.errors import Fault, Where
from waiter_cli.files.documents import (
    action_document,
    fault_document,
    message_document,
    order_document,
    place_document,
    reason_document,
    wish_document,
)
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Reason
from waiter_cli.model.state import Goal

PAID, THERE = Goal("paid", table="table1"), Goal("at", node="n1")


@pytest.mark.parametrize(
    ("where", "place"),
    [
        (None, (None, None, None)),
        (Where("a.yaml", 3, 7), ("a.yaml", 3, 7)),
        (Where("--enter"), ("--enter", None, None)),
    ],
)
def test_a_place_has_three_keys(where: Where | None, place: tuple[object, ...]) -> None:
    document = place_document(where)
    assert tuple(document.items()) == tuple(zip(("file", "line", "column"), place, strict=True))
    assert message_document("m", where) == {"message": "m", **document}
    assert fault_document(Fault(where, "m", "h")) == {"message": "m", **document, "hint": "h"}


def test_a_reason_of_a_line_that_was_heard_has_no_file() -> None:
    assert reason_document(Reason("m", Where("<line>", 1, 1)))["file"] is None
    assert reason_document(Reason("m", Where("a.yaml", 1, 1)))["file"] == "a.yaml"


def test_numbers_in_actions_are_numbers() -> None:
    action = Action(2, "bring_chairs", ("agent", "table1", "4"))
    assert action_document(action)["args"] == ["agent", "table1", 4]


def test_wishes_and_their_order() -> None:
    assert wish_document(PAID, None, ["r"]) == {"goal": {"paid": "table1"}, "reasons": ["r"]}
    assert wish_document(PAID, THERE, [])["before"] == [{"paid": "table1"}, {"at": "n1"}]
    assert order_document([(PAID, THERE)]) == [[{"paid": "table1"}, {"at": "n1"}]]
