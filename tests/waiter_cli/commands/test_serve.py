"""`waiter serve` up to its first line; what comes of lines is in ``serve/test_session``."""

from __future__ import annotations

import pytest

from tests.support.cli import waiter
from waiter_cli.execution.online_planner import OnlinePlanner


def test_what_a_search_needs_is_there_before_the_first_decision(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    called: list[str] = []
    plan, warm_up = OnlinePlanner.plan, OnlinePlanner.warm_up
    monkeypatch.setattr(OnlinePlanner, "plan", lambda *given: called.append("plan") or plan(*given))
    monkeypatch.setattr(
        OnlinePlanner, "warm_up", lambda *given: called.append("warm_up") or warm_up(*given)
    )
    ran = waiter("serve", "--scenario", "b1", stdin='{"ask": "plan"}\n')
    assert ran.code == 0 and '"name": "go_to"' in ran.out
    assert called == ["warm_up", "plan"]
