"""What must happen to a plate or a jug before a wish about it holds."""

from __future__ import annotations

import pytest

from tests.support.hall import posed
from waiter_cli.bounds.service_chains import course, marks_of, wish
from waiter_cli.model.state import State


@pytest.mark.parametrize(
    ("state", "kind", "item", "instant", "names"),
    [
        (State("a", ready_to_order=frozenset({"big"})), "ordered", "plate", False, ["take_order"]),
        (
            State("a", ready_to_order=frozenset({"big"})),
            "served",
            "plate",
            True,
            ["take_order", "send_order", "take_up", "bring"],
        ),
        (State("a", ready_to_order=frozenset({"big"})), "served", "plate", False, None),
        (State("a", carrying=("big", "plate")), "served", "plate", False, ["bring"]),
        (
            State("a", empty=frozenset({("big", "jug")})),
            "filled",
            "jug",
            False,
            ["refill", "fill", "bring"],
        ),
        (
            State("a", ready=frozenset({("big", "jug")})),
            "served",
            "jug",
            False,
            ["take_up", "bring"],
        ),
        (State("a", empty=frozenset({("big", "basket")})), "filled", "basket", False, None),
        (State("a"), "filled", "jug", False, []),
    ],
)
def test_course(state: State, kind: str, item: str, instant: bool, names: list[str] | None) -> None:
    problem = posed(state, instant=instant)
    found = course(problem, marks_of(state, "big", item), "big", item, wish(kind, item, True))
    if names is None:
        assert found is None
    else:
        assert found is not None
        sure, links = found
        assert [link.name for link in links] == names
        assert sure == links


def test_only_what_occurs_on_every_way_is_certain() -> None:
    """An empty jug that also stands ready at the bar may be taken up there or at the table."""
    thing = frozenset({("big", "jug")})
    state = State("a", ready=thing, empty=thing)
    found = course(
        posed(state), marks_of(state, "big", "jug"), "big", "jug", wish("filled", "jug", True)
    )
    assert found is not None
    assert [link.name for link in found[1]] == ["take_up", "bring"]
    assert [link.name for link in found[0]] == ["bring"]
