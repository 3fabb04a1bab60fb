"""What a picture shows at one moment."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from waiter_cli.encoding.domains import find_domain
from waiter_cli.model.plan import Action
from waiter_cli.model.state import State
from waiter_cli.pictures.snapshot import _rows
from waiter_cli.simulation.body import Shown
from waiter_cli.simulation.outcome import ShownAction


def test_the_list_says_actions_in_the_words_of_a_plan() -> None:
    """Step by step as `waiter plan` has them, whatever of it is done."""
    start = State(agent="n1", waiting=(("c2", "c3"),))
    deeds = ["go_to(agent,n5)", "pick(agent,c2)", "go_to(agent,n6)", "go_to(agent,n6)"]
    states = ["done", "done", "failed", "now"]
    left = (Action(3, "go_to", ("agent", "n6")), Action(4, "seat", ("agent", "c2", "table1")),
            Action(5, "go_to", ("agent", "n7")))  # fmt: skip
    shown = [ShownAction(k, text, state) for k, (text, state) in enumerate(zip(deeds, states))]
    run: Any = SimpleNamespace(
        problem=SimpleNamespace(state=start),
        world=SimpleNamespace(party_of=lambda guest: None),
        mind=SimpleNamespace(decision=SimpleNamespace(plan=left)),
        timed=(),
        domain=None,
        shown=Shown(deeds=shown),
        acting=lambda: left[:1],
    )
    assert [tuple(row) for row in _rows(run)] == [
        ("walk from n1 to n5", "done"),
        ("ask the party of c2 (2) to follow", "done"),
        ("walk from n5 to n6", "failed"),
        ("walk from n5 to n6", "now"),
        ("seat the party of c2 (2) at table1", "next"),
        ("walk from n6 to n7", "next"),
    ]


def test_the_list_says_what_a_domain_declares() -> None:
    action = Action(0, "clean", ("agent", "table2"))
    run: Any = SimpleNamespace(
        problem=SimpleNamespace(state=State("n6")),
        mind=SimpleNamespace(decision=SimpleNamespace(plan=(action,))),
        domain=find_domain("housekeeping"),
        shown=Shown(deeds=[]),
        acting=lambda: (),
    )
    assert [tuple(row) for row in _rows(run)] == [("wipe table2", "next")]
