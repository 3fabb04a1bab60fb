"""Several robots in one simulated room, each at its own pace."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import waiter_cli
from tests.support.fleet_rooms import AISLE, HALL, LUNCH, RING, SCENES, SWAP, TURN, calm, play
from tests.support.sampling import mostly_wide
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.fleet import fleet_bodies


def deeds(events: list[dict[str, Any]], kind: str) -> list[tuple[str, str]]:
    return [(e["robot"]["name"], e["action"]) for e in events if e["type"] == kind]


def test_two_robots_change_places_in_an_aisle_with_one_bay() -> None:
    outcome, events = play(AISLE, SWAP)
    assert (outcome.status, outcome.failures, outcome.actions) == ("done", (), 10)
    assert outcome.final_state.stations() == {"r1": "e", "r2": "a"}
    assert outcome.robots is not None
    assert sorted(each["metres"] for each in outcome.robots.values()) == [4.8, 7.2]
    assert set(events[0]["robots"]) == {"r1", "r2"} and "robot" not in events[0]
    # both are on their way at one time
    begun = [e["t"] for e in events if e["type"] == "action_start"]
    assert begun[:2] == [0.0, 0.0]


def test_four_robots_go_round_a_ring_together() -> None:
    outcome, events = play(RING, TURN)
    assert (outcome.status, outcome.failures) == ("done", ())
    assert {e["t"] for e in events if e["type"] == "action_start"} == {0.0}
    assert outcome.final_state.stations() == {"r1": "b", "r2": "c", "r3": "d", "r4": "a"}


@pytest.mark.wide
def test_one_who_slips_in_a_ring_is_not_run_into() -> None:
    for seed in range(3):
        outcome, _ = play(RING, TURN, "slip:0.4", seed=seed)
        assert outcome.failures == (), (seed, outcome.failures)
        assert outcome.status in ("done", "gave_up")


def test_guests_follow_whoever_leads_them_and_work_is_shared() -> None:
    outcome, events = play(HALL, LUNCH)
    assert (outcome.status, outcome.failures) == ("done", ())
    assert {party for _, party in outcome.final_state.seated} == {("c1", "c2"), ("c3",), ("c9",)}
    assert "table3" in outcome.final_state.sent and not outcome.final_state.empty
    assert {name for name, _ in deeds(events, "action_end")} == {"r1", "r2"}


@pytest.mark.parametrize(("layout", "scenario"), [(AISLE, SWAP), (HALL, LUNCH)])
@pytest.mark.parametrize("seed", mostly_wide(range(2), 1))
def test_delays_failures_stops_and_blocks_end_well(layout: str, scenario: str, seed: int) -> None:
    """Nobody touches anybody, nobody waits for ever, nobody is lost."""
    calm(layout, scenario, seed)


@pytest.mark.slow
@pytest.mark.parametrize(("layout", "scenario"), SCENES)
def test_many_delays_failures_stops_and_blocks_end_well(layout: str, scenario: str) -> None:
    for seed in range(300):
        calm(layout, scenario, seed)


def test_a_robot_that_stops_for_good_is_in_the_way_and_the_end_says_so() -> None:
    outcome, events = play(AISLE, SWAP, "out:r2@1")
    assert outcome.status == "gave_up" and outcome.why is not None and "r2" in outcome.why
    assert outcome.failures == ()
    assert ("r2", "go_to(r2,d)") in deeds(events, "action_failed")


def test_a_robot_that_stops_and_goes_on_returns_to_its_node_first() -> None:
    outcome, events = play(AISLE, SWAP, "out:r2@1+5")
    assert (outcome.status, outcome.failures) == ("done", ())
    (back,) = [e for e in events if e["type"] == "injected" and e["kind"] == "back"]
    assert back["robot"]["node"] == "e" and back["robot"]["x"] == 4.8 and back["t"] > 6.0


def test_stalling_one_keeps_the_others_going_and_all_keeps_all() -> None:
    times = [
        play(AISLE, SWAP, *injected)[0].seconds
        for injected in ((), ("stall:r1:5@0",), ("stall:5@0",))
    ]
    assert times[0] < times[1] and abs(times[2] - times[0] - 5.0) < 0.2


def test_a_path_that_is_blocked_is_planned_without_until_it_is_free() -> None:
    outcome, events = play(AISLE, SWAP, "block:c-d@0+9")
    assert (outcome.status, outcome.failures) == ("done", ())
    assert [e["type"] for e in events if e["type"] in ("blocked", "unblocked")] == [
        "blocked", "unblocked",
    ]  # fmt: skip
    stopped, _ = play(AISLE, SWAP, "block:c-d@0+9", on_failure="stop")
    assert stopped.status == "failed"
    waited, _ = play(AISLE, SWAP, "block:c-d@0+9", on_failure="wait")
    assert (waited.status, waited.failed_actions) == ("done", 0)


def test_robots_wait_where_they_would_come_too_near(monkeypatch: pytest.MonkeyPatch) -> None:
    """A bay in which nobody has room to be passed is in nobody's rules; without care, one is run into."""
    narrow = AISLE.replace("bay: [2.4, 1.2]", "bay: [2.4, 0.45]")
    outcome, _ = play(narrow, SWAP)
    assert outcome.status == "gave_up" and "is in the way" in str(outcome.why)
    assert outcome.failures == () and (outcome.min_clearance or 0.0) > 0.07
    monkeypatch.setattr(fleet_bodies, "KEEP", -1.0)
    outcome, events = play(narrow, SWAP)
    assert {each.check for each in outcome.failures} == {"clearance"}
    (hit,) = {(e["robot"]["name"], e["other"]) for e in events if e["type"] == "collision"}
    assert set(hit) == {"r1", "r2"} and outcome.min_clearance == pytest.approx(-0.05, abs=5e-3)


def test_both_backends_say_the_same() -> None:
    pytest.importorskip("pybullet")
    runs = [
        play(HALL, LUNCH, "slip:0.1", seed=3, backend=name) for name in ("geometric", "pybullet")
    ]
    (one, first), (other, second) = runs
    assert first[1:] == second[1:]
    assert one.min_clearance == pytest.approx(other.min_clearance, abs=1e-3)


@pytest.mark.parametrize(
    ("injected", "message"),
    [
        ("out:r3@2", "unknown robot r3"),
        ("stall:r3:2@2", "unknown robot r3"),
        ("out:r1@x", "no number"),
    ],
)
def test_injections_name_robots_that_there_are(injected: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        play(AISLE, SWAP, injected)


@pytest.mark.sim
def test_several_robots_drive_by_physics() -> None:
    pytest.importorskip("pybullet")
    where = read_layout(AISLE, "layout.yaml")
    problem = pose_problem(where, read_scenario(SWAP, "scenario.yaml", where))
    exact = waiter_cli.simulate(problem, backend="pybullet")
    driven = waiter_cli.simulate(problem, drive="physics", backend="pybullet")
    for run in (exact, driven):
        assert (run.status, run.failures) == ("done", ())
    assert driven.seconds != exact.seconds


@pytest.mark.sim
def test_robots_that_drive_by_physics_push_each_other() -> None:
    pytest.importorskip("pybullet")
    from waiter_cli.simulation.open_backend import open_backend

    backend = open_backend("pybullet", "physics", ("r1", "r2"))
    first, second = backend.steering("r1"), backend.steering("r2")
    second((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), 1 / 60)
    pose = (0.0, 0.0, 0.0)
    for tick in range(150):
        pose = first(pose, (min(1.0, tick / 100), 0.0, 0.0), 1 / 60)
    backend.close()
    assert pose[0] < 0.6  # held up by the hull of the other one


def test_several_robots_with_a_timetable_are_refused() -> None:
    timed = AISLE + "waiters: {w1: bay}\ntimetable: {w1: {2: d}}\n"
    with pytest.raises(InputError, match="timetable"):
        play(timed, SWAP)


def test_a_plan_made_before_is_followed() -> None:
    where = read_layout(AISLE, "layout.yaml")
    problem = pose_problem(where, read_scenario(SWAP, "scenario.yaml", where))
    answer = waiter_cli.plan(problem)
    outcome = waiter_cli.simulate(problem, plan=answer.plan, backend="geometric")
    assert answer.plan is not None
    assert (outcome.status, outcome.actions) == ("done", len(answer.plan.actions))
    assert outcome.final_state.stations() == {"r1": "e", "r2": "a"}


def test_pictures_show_each_robot_by_its_name_and_whose_each_step_is(tmp_path: Path) -> None:
    where = read_layout(AISLE, "layout.yaml")
    problem = pose_problem(where, read_scenario(SWAP, "scenario.yaml", where))
    page = tmp_path / "swap.html"
    waiter_cli.simulate(problem, backend="geometric", record=str(page))
    text = page.read_text(encoding="utf-8")
    replay, _ = json.JSONDecoder().raw_decode(text[text.index('{"title":') :])
    first = replay["frames"][0][1]
    assert [key for key in first if key.startswith("robot")] == ["robot r1", "robot r2"]
    assert (first["robot r1"], first["robot r2"][4]) == ([0, 0, 0, "", 0], 1)
    rows = {words for frame in replay["frames"] for words, _ in frame[1].get("rows", ())}
    assert {"r1: walk from a to b", "r2: walk from e to d"} <= rows
    assert any(words.startswith("r1: arrives at ") for _, words, _ in replay["told"])
