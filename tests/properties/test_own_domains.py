"""Domains of one's own from plan to film: housekeeping, a library trolley, a ward, blocks."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_slow
from waiter_cli.pictures.event_text import event_in_words

DOMAINS = ROOT / "tests" / "support" / "domains"
SITUATIONS = {
    "trolley": """
layout: report
state: {agent: n5, fluents: ['onshelf(atlas, table1)', atdesk(novel)]}
observe: [{obs: returned(atlas)}]
goals: [{holds: 'onshelf(atlas, table2)'}, {holds: 'onshelf(novel, table1)'}]
events: [{time: 5, obs: returned(poems)}]
""",
    "ward": """
layout: bistro
state: {fluents: ['lies(ada, table1)', 'lies(ben, table2)', 'needs(ben, pills)']}
observe: [{obs: 'calls(ada, drops)'}]
goals: [{holds: well(ada)}, {holds: well(ben)}]
""",
    "blocks": """
layout: report
state: {fluents: ['on(a, floor)', 'on(b, a)', 'on(c, b)']}
goals: [{holds: 'on(a, b)'}, {holds: 'on(b, c)'}]
""",
}


ALL = [*SITUATIONS, "housekeeping"]


@pytest.fixture
def options(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[str, ...]:
    """A scenario and its domain on a command line."""
    if request.param == "housekeeping":
        scenario = ROOT / "domains" / "housekeeping" / "scenario.yaml"
        return ("--scenario", str(scenario), "--domain", "housekeeping")
    scenario = tmp_path / "s.yaml"
    scenario.write_text(SITUATIONS[request.param])
    return ("--scenario", str(scenario), "--domain", str(DOMAINS / f"{request.param}.sparc"))


@pytest.mark.wide
@pytest.mark.parametrize("options", mostly_slow(ALL, "trolley", "blocks"), indirect=True)
def test_plan_validate_simulate_and_draw(options: tuple[str, ...], tmp_path: Path) -> None:
    made = waiter("plan", *options, "--json")
    plan = json.loads(made.out)
    assert (plan["status"], plan["validated"], plan["minimal"]) == ("plan", "domain", True)
    file = tmp_path / "plan.json"
    file.write_text(made.out)
    assert waiter("validate", str(file)).code == 0
    events = tmp_path / "events.jsonl"
    ran = waiter("simulate", *options, "--events", str(events), "--backend", "geometric", "--json")
    outcome = json.loads(ran.out)
    assert (ran.code, outcome["status"], outcome["failed_checks"]) == (0, "done", [])
    assert outcome["actions"] == len(plan["actions"])
    assert outcome["final_state"].get("fluents", []) != plan["initial_state"].get("fluents", [])
    played = waiter("simulate", "--plan", str(file), "--backend", "geometric", "--json")
    assert (played.code, json.loads(played.out)["status"]) == (0, "done")
    assert waiter("layout", "draw", "--plan", str(file)).code == 0


@pytest.mark.wide
@pytest.mark.parametrize("options", mostly_slow(ALL, "housekeeping", "blocks"), indirect=True)
def test_serve_and_its_replay(options: tuple[str, ...], tmp_path: Path) -> None:
    """Every step is reported done; the journal says the same again."""
    steps = json.loads(waiter("plan", *options, "--json").out)["horizon"]
    lines = "".join(f'{{"done": {step}}}\n' for step in range(steps)) + '{"ask": "state"}\n'
    journal = str(tmp_path / "journal")
    more = ("--journal", journal, "--time-limit", "20")
    ran = waiter("serve", *options, *more, stdin=lines)
    answers = [json.loads(line) for line in ran.out.splitlines()]
    assert not [each for each in answers if "error" in each]
    assert answers[-2]["plan"] == []
    replayed = waiter("serve", "--replay", journal, *options[2:])
    assert (replayed.code, replayed.err) == (0, "")


def test_a_table_is_wiped_and_said_so(tmp_path: Path) -> None:
    scenario = ROOT / "domains" / "housekeeping" / "scenario.yaml"
    events = tmp_path / "events.jsonl"
    waiter("simulate", "--scenario", str(scenario), "--domain", "housekeeping",
           "--events", str(events), "--backend", "geometric")  # fmt: skip
    told = [json.loads(line) for line in events.read_text().splitlines()]
    (wiped,) = [each for each in told if each["type"] == "acted"]
    assert (wiped["action"], wiped["text"]) == ("clean(agent,table2)", "wiping table2")
    began = next(e for e in told if e["type"] == "action_start" and e["action"] == wiped["action"])
    assert 4.0 <= wiped["t"] - began["t"] < 7.0
    assert told[-2]["kind"] == "obs" or any(e.get("kind") == "obs" for e in told)


WIPED = "wipe table2"  # what domains/housekeeping declares of clean(agent,table2)


def test_an_action_has_its_own_words_wherever_a_person_sees_it(tmp_path: Path) -> None:
    """Plans, drawings, answers of a live run, events, and their text in a film."""
    scenario = ROOT / "domains" / "housekeeping" / "scenario.yaml"
    options = ("--scenario", str(scenario), "--domain", "housekeeping")
    file, picture, events = (tmp_path / name for name in ("p.json", "p.svg", "e.jsonl"))
    file.write_text(waiter("plan", *options, "--json").out)
    drawn = waiter("layout", "draw", "--plan", str(file))
    assert WIPED in drawn.out and "clean(" not in drawn.out
    assert waiter("layout", "draw", "--plan", str(file), "-o", str(picture)).code == 0
    assert WIPED in picture.read_text() and "clean" not in picture.read_text()
    told = waiter("serve", *options, "--time-limit", "20", stdin='{"ask": "why"}\n').out
    steps = json.loads(told.splitlines()[-1])["why"]["steps"]
    assert WIPED in [each["text"] for each in steps]
    waiter("simulate", *options, "--events", str(events), "--backend", "geometric",
           "--inject", "slip:1", "--on-failure", "stop")  # fmt: skip
    slipped = [json.loads(line) for line in events.read_text().splitlines()]
    failed = next(each for each in slipped if each["type"] == "action_failed")
    assert failed["text"] and "(" not in failed["text"]
    assert failed["text"] in str(event_in_words(failed))
