"""A decision in words."""

from __future__ import annotations

from dataclasses import replace

from tests.support.serving import Live, thinker
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.studio.live.live_view import proof_of


def test_a_makeshift_plan_that_is_done_leaves_nothing_to_be_done() -> None:
    """That it was not proved minimal is said while it is carried out, and no longer."""
    live = Live(read_layout_file("report"))
    live.seen({"enter": ["c1"]})
    executive, planner = live.session.executive, thinker(0.4)
    told = "0 steps. Nothing is to be done."
    for step in range(7):
        late = replace(executive.decision, status="undecided", limit="time", minimal=False)
        executive.decision = late
        assert proof_of(executive, planner).endswith(
            "Not proved minimal: the time limit came first."
        )
        live.tell({"done": step})
        executive = live.session.executive
    executive.decision = replace(executive.decision, status="undecided", limit="time")
    assert proof_of(executive, planner) == told
    live.seen({"enter": ["c2"]})
    executive = live.session.executive
    executive.decision = replace(
        executive.decision, status="undecided", limit="time", horizon=0, plan=()
    )
    assert "the time limit came first" in proof_of(executive, planner)


def test_what_must_wait_is_told_after_what_is_under_way() -> None:
    live, planner = Live(read_layout_file("report")), thinker(0.4)
    live.seen({"enter": ["c1"]})
    for step in range(6):
        live.tell({"done": step})
    live.tell({"started": 6})
    live.seen({"enter": [f"d{k}" for k in range(9)]})
    told = proof_of(live.session.executive, planner)
    assert told.startswith("1 step. Then there is no plan: a party of 9")
    live.tell({"done": 6})
    assert proof_of(live.session.executive, planner).startswith(
        "0 steps. There is no plan: a party"
    )
