"""Events in words: every type of event that a run can have is told, and told readably."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest

from tests.support.paths import ROOT
from tests.support.playing import play
from waiter_cli.files.scenario_reader import read_scenario_file
from waiter_cli.pictures.event_text import event_in_words, tell_all
from waiter_cli.problems.from_options import read_problem
from waiter_cli.simulation.event_log import TYPES

LUNCH = str(ROOT / "examples" / "lunch.yaml")
UNTOLD = {"start", "action_start", "action_end", "left"}

EVENTS: list[tuple[dict[str, Any], str]] = [
    ({"type": "observed", "kind": "enter", "party": ["c1"]}, "c1 comes in"),
    ({"type": "observed", "kind": "enter", "party": ["a", "b", "c"]}, "a, b and c come in"),
    ({"type": "injected", "kind": "leave", "party": ["c1"]}, "c1 leaves"),
    (
        {"type": "observed", "kind": "bill", "table": "t1", "answer": "the plan stands"},
        "t1 wants its bill; the plan stands",
    ),
    ({"type": "observed", "kind": "at", "who": "w1", "node": "n3"}, "w1 is at n3"),
    (
        {"type": "observed", "kind": "ready", "table": "t1", "object": "plate", "answer": "replan"},
        "the plate for t1 is ready",
    ),
    (
        {"type": "injected", "kind": "leave", "party": ["c9"], "ignored": "c9 is not inside"},
        "c9 leaves: ignored, c9 is not inside",
    ),
    (
        {"type": "injected", "kind": "slip", "action": "go_to(agent,n2)", "robot": {"node": "n1"}},
        "slips: walk from n1 to n2",
    ),
    ({"type": "injected", "kind": "stall", "seconds": 2.5}, "stands still for 2.5 s"),
    ({"type": "injected", "kind": "block", "edge": "a-b"}, "somebody stands on a-b"),
    (
        {"type": "injected", "kind": "block", "edge": "a-b", "seconds": 8.0},
        "somebody stands on a-b for 8 s",
    ),
    ({"type": "arrived", "node": "n2"}, "arrives at n2"),
    ({"type": "arrived", "node": "n2", "detour": True}, "passes n2 on the way round"),
    ({"type": "picked", "party": ["c1"]}, "c1 follows"),
    ({"type": "seated", "party": ["c1", "c2"], "table": "t1"}, "c1 and c2 sit down at t1"),
    ({"type": "chairs", "table": "t1", "number": 6}, "t1 has 6 chairs now"),
    ({"type": "refilled", "table": "t1", "object": "jug"}, "fills the jug of t1"),
    ({"type": "clearance_low", "other": "t1", "clearance": 0.04}, "only 0.04 m to t1"),
    ({"type": "collision", "other": "t1", "depth": 0.1}, "runs into t1"),
    (
        {"type": "blocked", "edge": "a-b", "by": "stranger1", "answer": "reroute"},
        "a-b is blocked: going round it",
    ),
    ({"type": "unblocked", "edge": "a-b"}, "a-b is free again"),
    (
        {
            "type": "action_failed",
            "action": "pick(agent,c1)",
            "reason": "c1 has gone",
            "robot": {"node": "n1"},
        },
        "fails to ask c1 to follow: c1 has gone",
    ),
    ({"type": "replan", "status": "no_plan", "reason": ""}, "there is no plan"),
    (
        {"type": "end", "status": "done", "failed_checks": 0, "min_clearance": None},
        "the end: goals reached",
    ),
    (
        {
            "type": "end", "status": "gave_up", "why": "gave up: no way", "failed_checks": 0,
            "min_clearance": 0.2,
        },
        "the end: gave up: no way; never closer than 0.20 m to anything",
    ),
    (
        {
            "type": "end", "status": "failed", "why": "ran into t1", "failed_checks": 2,
            "min_clearance": -0.01,
        },
        "the end: failed: ran into t1; 2 failed checks; something was touched",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("event", "words"), EVENTS, ids=[words for _, words in EVENTS])
def test_events_in_words(event: dict[str, Any], words: str) -> None:
    assert event_in_words(event) == words


def test_whatever_happens_in_a_lunch_is_told() -> None:
    """No type is forgotten, and nothing of the machine's words is left."""
    problem, timed = read_problem(None, LUNCH)[0], read_scenario_file(LUNCH)[1].events
    inject = ["block:south2-south3@12+8", "slip:0.1", "stall:2@3", "leave:c8@80", "bill:table8@9"]
    events = [json.loads(line) for line in play(problem, inject=inject, timed=timed).lines]
    told = tell_all(events)
    assert {event["type"] for event in events} <= set(TYPES)
    assert len(told) == sum(event["type"] not in UNTOLD for event in events)
    for time, words, bad in told:
        assert time >= 0 and bad in (0, 1)
        assert not re.search(r"agent|[_{}\[\]()]|None|True|\d\.\d{3}", words), words
    again = [
        (one[1], two[1]) for one, two in zip(told, told[1:]) if two[1].startswith("plans anew:")
    ]
    assert not [pair for pair in again if pair[1].partition(": ")[2] in pair[0]]


def test_a_block_is_told_with_what_the_robot_does_about_it() -> None:
    problem = read_problem("report", None, enter=["1"])[0]
    told = tell_all(json.loads(line) for line in play(problem, inject=["block:n5-n6@0+30"]).lines)
    assert [bad for _, words, bad in told if "n5-n6 is blocked: waiting" in words] == [1]
    assert told[-1][1].startswith("the end: goals reached")
