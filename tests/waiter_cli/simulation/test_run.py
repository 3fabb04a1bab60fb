"""Runs from end to end: the recorded scenes, broken plans, things that come in between."""

from __future__ import annotations

import json
from dataclasses import replace
from random import Random

import pytest

from tests.support.playing import SHIPPED, layout_of, play
from waiter_cli.bounds import find_bounds
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.model.timetable import clashes
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.event_log import TYPES
from waiter_cli.simulation.outcome import Rules
from waiter_cli.simulation.world import World

SCENES = {"b1": 7, "b2": 4, "b3": 1, "b4": 1}
WALK_ALONG = tuple(f"go_to(agent,n{k})" for k in range(1, 5))
WALK = ("go_to(agent,n2)", "go_to(agent,n3)", "go_to(agent,n4)", "go_to(agent,n5)")


def scene(name: str) -> Problem:
    return read_problem(None, name)[0]


@pytest.mark.parametrize("name", SCENES)
def test_the_recorded_scenes_reach_their_goals_with_every_check(name: str) -> None:
    run = play(scene(name))
    assert run.outcome.status == "done"
    assert not run.outcome.failures
    assert run.outcome.actions == SCENES[name]
    types = run.types()
    assert types[0] == "start" and types[-1] == "end"
    assert set(types) <= set(TYPES)
    assert [event["seq"] for event in run.events] == list(range(len(types)))
    assert run.of("end")[0]["status"] == "done"


def test_times_and_steps_never_go_back() -> None:
    events = play(scene("b1")).events
    assert [e["t"] for e in events] == sorted(e["t"] for e in events)
    assert [e["step"] for e in events] == sorted(e["step"] for e in events)


def test_numbers_are_given_to_a_thousandth() -> None:
    def numbers(value: object) -> list[float]:
        if isinstance(value, float):
            return [value]
        items = (
            value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
        )
        return [number for item in items for number in numbers(item)]

    found = [number for event in play(scene("b1")).events for number in numbers(event)]
    assert found and all(round(number, 3) == number for number in found)


def test_guests_sit_on_chairs_of_their_own() -> None:
    seated = play(scene("b2")).of("seated")[0]
    assert set(seated["chairs"]) == {"c2", "c3", "c4", "c5"}
    assert len(set(seated["chairs"].values())) == 4
    assert all(chair.endswith("_table2") for chair in seated["chairs"].values())


def test_two_runs_write_the_same_bytes() -> None:
    def once() -> str:
        return "".join(
            play(scene("b2"), inject=["slip:0.4", "enter:2@3"], rules=Rules(seed=5)).lines
        )

    assert once() == once()


def test_another_seed_is_another_run() -> None:
    first, second = (
        play(scene("b1"), inject=["slip:0.5"], rules=Rules(seed=seed)).lines for seed in (1, 2)
    )
    assert first != second


def test_a_long_evening_with_a_bar() -> None:
    problem = replace(scene("lunch"), prefer=())
    run = play(problem)
    assert run.outcome.status == "done", run.outcome.why
    kinds = set(run.types())
    assert {
        "picked",
        "seated",
        "bill",
        "ordered",
        "sent",
        "taken_up",
        "brought",
        "refilled",
    } <= kinds
    assert run.outcome.min_clearance is not None and run.outcome.min_clearance > 0.05


# ------------------------------------------------------------ plans made wrong by hand


def test_a_plan_that_skips_an_edge() -> None:
    run = play(scene("b1"), ("go_to(agent,n2)", "go_to(agent,n4)"), rules=Rules(on_failure="stop"))
    assert [f.check for f in run.outcome.failures] == ["edge"]
    assert run.outcome.status == "failed"
    assert "precondition_failed" in run.types()


def test_a_plan_that_seats_five_on_four_chairs() -> None:
    layout = layout_of("report")
    five = ("c1", "c2", "c3", "c4", "c5")
    problem = pose_problem(layout, None, enter=[5])
    steps = (*WALK, "pick(agent,c1)", "go_to(agent,n6)", "seat(agent,c1,table2)")
    run = play(problem, steps, rules=Rules(on_failure="stop"))
    assert len(problem.state.waiting[0]) == len(five)
    assert [f.check for f in run.outcome.failures] == ["chairs"]


def test_a_plan_that_gives_the_bill_to_the_wrong_table() -> None:
    run = play(scene("b3"), ("give_bill(agent,table2)",), rules=Rules(on_failure="stop"))
    assert [f.check for f in run.outcome.failures] == ["preconditions"]


def test_a_plan_that_stops_short_of_its_goals() -> None:
    run = play(scene("b1"), WALK)
    assert [f.check for f in run.outcome.failures] == ["goals"]


def test_a_plan_whose_final_state_is_another() -> None:
    problem = scene("b3")
    predicted = replace(problem.state, wants_bill=frozenset())
    run = play(problem, ("give_bill(agent,table1)",), predicted=predicted)
    assert [f.check for f in run.outcome.failures] == ["final_state"]


def test_a_broken_plan_is_mended_unless_told_otherwise() -> None:
    run = play(scene("b1"), ("go_to(agent,n4)",))
    assert run.outcome.status == "failed"
    assert run.of("seated")
    assert run.outcome.replans == 1


# ------------------------------------------------------------ the world against what is believed


def test_two_on_one_chair_trip_a_check(monkeypatch: pytest.MonkeyPatch) -> None:
    def crowded(self: World, party: tuple[str, ...], table: str) -> None:
        self.tables[table].party = party
        self.tables[table].seats = dict.fromkeys(party, 0)

    monkeypatch.setattr(World, "_sit", crowded)
    assert "chairs" in {f.check for f in play(scene("b2")).outcome.failures}


# ------------------------------------------------------------ what comes in between

ENDINGS = {"done", "gave_up"}


def evening(name: str) -> Problem:
    layout = layout_of(name)
    seated = {
        "report": "table1",
        "report_large": "table1",
        "bistro": "table1",
        "walled_off": "table1",
    }
    text = f"state: {{seated: {{{seated[name]}: [g1]}}}}\nobserve: [enter: [g2, g3]]\n"
    return pose_problem(layout, read_scenario(text, "evening", layout))


@pytest.mark.parametrize("layout", SHIPPED)
@pytest.mark.parametrize(
    "inject",
    [
        "block",
        "block+",
        "leave:g2@4",
        "leave:g1@4",
        "enter:1@2",
        "bill:table1@3",
        "slip:0.2",
        "slip:1",
        "stall:3@2",
    ],
)
def test_each_injection_ends_in_something(layout: str, inject: str) -> None:
    problem = evening(layout)
    if inject.startswith("block"):
        near = problem.layout.neighbours()[problem.state.agent]
        inject = f"block:{problem.state.agent}-{near[0]}@0" + ("+5" if inject.endswith("+") else "")
    run = play(problem, inject=[inject])
    assert run.outcome.status in ENDINGS, run.outcome
    assert not run.outcome.failures
    if run.outcome.status == "gave_up":
        assert run.outcome.why
    said = run.of("injected")
    assert said or (inject.startswith("slip") and "action_failed" not in run.types())
    answers = {event.get("answer") for event in run.events} - {None}
    kind = inject.partition(":")[0]
    if kind in ("leave", "enter", "bill"):
        assert answers <= {"replan", "the plan stands"} and answers
    if inject == "slip:1" and said:
        assert run.outcome.status == "gave_up"


def test_a_block_is_driven_round_where_there_is_another_way() -> None:
    layout = layout_of("bistro")
    ring = next(
        (a, b) for a, b in layout.edges
        if "south1" in (a, b) and "south2" in (a, b)
    )  # fmt: skip
    text = "state: {agent: south1, waiters: {w1: window}}\ngoals: [at: south2]"
    problem = pose_problem(layout, read_scenario(text, "walk", layout))
    run = play(problem, inject=[f"block:{ring[0]}-{ring[1]}@0"])
    assert run.outcome.status == "done"
    assert run.of("blocked")[0]["answer"] == "reroute"
    assert [e["node"] for e in run.of("arrived")][-1] == "south2"


def test_a_block_that_goes_away_is_waited_for() -> None:
    run = play(scene("b1"), inject=["block:n5-n6@0+20"])
    assert run.outcome.status == "done"
    assert run.of("blocked")[0]["answer"] == "wait"
    assert run.of("unblocked")


def test_a_block_that_stays_ends_in_giving_up() -> None:
    run = play(scene("b1"), inject=["block:n5-n6@0"])
    assert run.outcome.status == "gave_up"
    assert "n5-n6" in (run.outcome.why or "")


def test_a_block_that_another_table_helps_past_is_replanned() -> None:
    problem = scene("b2")
    free = replace(problem.state, waiters=(("w1", "n0"),), agent="n4", seated=())
    problem = replace(
        problem,
        state=free,
        before_observations=free,
        goals=(Goal("seated", party=free.waiting[0]),),
    )
    steps = ("go_to(agent,n5)", "pick(agent,c2)", "go_to(agent,n6)", "seat(agent,c2,table2)")
    run = play(problem, steps, inject=["block:n5-n6@0"])
    assert run.of("blocked")[0]["answer"] == "replan"
    assert run.outcome.status == "done"
    assert [e["node"] for e in run.of("arrived")][-1] == "n7"


def test_stop_on_failure_stops() -> None:
    run = play(scene("b1"), inject=["slip:1"], rules=Rules(on_failure="stop"))
    assert run.outcome.status == "failed"
    assert run.outcome.failed_actions == 1
    assert not run.outcome.failures


def test_who_leaves_while_being_led_is_not_seated() -> None:
    run = play(scene("b1"), inject=["leave:c1@21"])
    assert not run.of("seated")
    assert run.of("action_failed")
    assert run.outcome.status == "done"


def test_events_of_a_scenario_happen_in_their_time() -> None:
    timed = (TimedEvent(5.0, (Observation("bill", ("table1",)),)),)
    problem = replace(scene("b3"), goals=(), everybody=True)
    run = play(problem, timed=timed)
    assert run.outcome.status == "done"
    assert [e["t"] for e in run.of("observed") if "at_start" not in e] == [5.0]
    assert len(run.of("bill")) == 2


def test_news_that_cannot_be_true_is_said_and_ignored() -> None:
    timed = (TimedEvent(1.0, (Observation("leave", ("nobody",)),)),)
    run = play(scene("b1"), timed=timed)
    assert run.of("observed")[-1]["ignored"] == "nobody is not inside"
    assert run.outcome.status == "done"


def test_colleagues_keep_their_timetable() -> None:
    problem = scene("b1")
    layout = replace(problem.layout, timetable=(("w1", 2, "n4"), ("w1", 3, "n7")))
    run = play(replace(problem, layout=layout))
    assert run.outcome.status == "done", run.outcome


def corridor(spacing: float, due: dict[int, str]) -> Problem:
    """Five nodes in a row, a colleague beside the last, the robot on its way along them all."""
    nodes = {f"n{k}": [spacing * k, 0] for k in range(5)} | {"side": [spacing * 4, spacing]}
    edges = [[f"n{k}", f"n{k + 1}"] for k in range(4)] + [["n4", "side"]]
    layout = {
        "nodes": nodes, "edges": edges, "entrance": "n0", "agent": "n0",
        "tables": {"table1": {"capacity": 2, "nodes": ["n0"], "at": [0, -3]}},
        "waiters": {"anna": "side"}, "timetable": {"anna": due},
    }  # fmt: skip
    read = read_layout(json.dumps(layout), "corridor.yaml")
    return pose_problem(read, None, goals=["at: n4"])


@pytest.mark.parametrize("spacing", [0.7, 0.8, 1.0, 2.0])
def test_a_colleague_follows_the_robot_from_node_to_node(spacing: float) -> None:
    due = {step: f"n{step - 1}" for step in (1, 2, 3, 4)}
    run = play(corridor(spacing, due))
    assert run.outcome.status == "done", run.outcome
    assert run.outcome.actions == 4
    assert dict(run.outcome.final_state.waiters) == {"anna": "n3"}
    assert run.outcome.min_clearance is None or run.outcome.min_clearance >= 0.05


@pytest.mark.parametrize("name", [f"generated{k}" for k in range(1, 6)])
def test_generated_rooms_are_played_without_a_collision(name: str) -> None:
    problem = pose_problem(layout_of(name), None, enter=[2, 1])
    run = play(problem)
    assert run.outcome.status == "done", run.outcome.why
    assert run.outcome.min_clearance is None or run.outcome.min_clearance >= 0.05


def moving(layout: Layout, chance: Random) -> Layout:
    """The layout with colleagues who go about, never two on one node, and home again at step 15."""
    nodes = [node.name for node in layout.nodes]
    posts = dict(layout.waiters)
    while True:
        due = {(who, chance.randint(1, 14)): chance.choice(nodes) for who in [*posts] * 4}
        due |= {(who, 15): home for who, home in posts.items()}
        timetable = tuple((who, step, node) for (who, step), node in sorted(due.items()))
        if not clashes(posts, timetable):
            return replace(layout, timetable=timetable)


@pytest.mark.parametrize("seed", range(8))
def test_colleagues_on_the_move_are_never_run_into(seed: int) -> None:
    chance = Random(seed)
    layout = moving(layout_of(f"generated{chance.choice((1, 2, 4, 5))}"), chance)
    problem = pose_problem(layout, None, enter=[2, 1])
    run = play(problem)
    assert not run.outcome.failures
    assert run.outcome.status == "done", run.outcome.why
    slipping = play(problem, inject=[f"slip:{chance.choice((0.2, 0.4))}"])
    assert not slipping.outcome.failures
    assert slipping.outcome.status == "done", slipping.outcome.why


def test_a_colleague_who_is_held_up_comes_once_the_robot_is_gone() -> None:
    """The robot slips on the node that anna is due on; whoever follows her is held up, too."""
    problem = corridor(1.0, {1: "n0"})
    layout = replace(
        problem.layout,
        waiters=(("anna", "side"), ("bob", "n4")),
        timetable=(*problem.layout.timetable, ("bob", 1, "side")),
    )
    start = replace(problem.state, waiters=layout.waiters)
    problem = replace(problem, layout=layout, state=start, before_observations=start)
    for planned in (None, WALK_ALONG):
        run = play(problem, planned, inject=["slip:0.6"])
        assert run.events[-1]["status"] == "done" and not run.outcome.failures
        assert run.of("action_failed")[0]["step"] == 0
        assert dict(run.outcome.final_state.waiters) == {"anna": "n0", "bob": "side"}


def test_an_order_that_was_kept_stays_kept_when_a_plan_is_given_up() -> None:
    """The first of two goals is reached by the plan, the second by another one after a failure."""
    text = "state: {seated: {table1: [c1], table2: [c2]}, wants_bill: [table1, table2]}\n"
    text += "goals: [{at: n1}]\nbefore: [[{paid: table1}, {paid: table2}]]"
    layout = read_layout_file("report")
    problem = pose_problem(layout, read_scenario(text, "bills", layout))
    plan = find_bounds(problem).plan
    assert plan is not None
    for seed in range(12):
        run = play(problem, plan, inject=["slip:0.3"], rules=Rules(seed=seed))
        assert run.outcome.status == "done", (seed, run.outcome.why)
        bills = [event["table"] for event in run.of("bill")]
        assert bills == ["table1", "table2"]


def test_news_while_nothing_is_to_be_done() -> None:
    """What is seen in an idle step can change what is to be done at that step."""
    problem = corridor(1.0, {1: "n1", 9: "side"})
    timed = (TimedEvent(6.0, (Observation("at", ("anna", "side")),)),)
    run = play(problem, timed=timed)
    assert run.outcome.status == "done" and not run.outcome.failures
    assert run.outcome.seconds < play(problem).outcome.seconds


def test_the_log_is_json_that_reads_back() -> None:
    for line in play(scene("b4")).lines:
        assert json.loads(line)["schema"] == "waiter.sim/1"
        assert line.endswith("}\n") and "\n" not in line[:-1]


def test_the_world_starts_as_the_state_says() -> None:
    for name in ("b2", "b4", "lunch"):
        problem = scene(name)
        state: State = World(problem.layout, problem.state, problem.instant_kitchen).state()
        assert state == problem.state
