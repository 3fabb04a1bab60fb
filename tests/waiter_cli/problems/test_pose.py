"""Problems: what observations change, which contradict, whole parties in goals, serving everybody."""

from __future__ import annotations

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support.small_worlds import small_problem
from waiter_cli.errors import InputError, LayoutError, Where
from waiter_cli.files.documents import state_document
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.names import fresh_customers
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem, problem_from_plan_document
from waiter_cli.rules.observations import observe

HALL = read_layout(
    """
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d]]
entrance: c
agent: b
waiters: {w1: d}
bar: [a]
tables:
  t1: {capacity: 2, nodes: [b]}
  t2: {capacity: 4, nodes: [c], chairs: 2}
  t3: {capacity: 2, nodes: [d]}
""",
    "hall.yaml",
)


def pose(text: str, **more: list[str]) -> Problem:
    return pose_problem(HALL, read_scenario(text, "s.yaml", HALL), **more)  # type: ignore[arg-type]


def after(state: str, *seen: str) -> dict[str, object]:
    """What holds after observations, less what always holds."""
    problem = pose(f"state: {state}\nobserve: [{', '.join(seen)}]\ngoals: []")
    assert problem.contradictions == ()
    document = state_document(problem.state, HALL)
    del document["chairs"]
    assert document.pop("agent") and document.pop("waiters")
    return document


@pytest.mark.parametrize(
    ("state", "seen", "expected"),
    [
        ("{}", ["{enter: [g1, g2]}"], {"waiting": [["g1", "g2"]]}),
        ("{waiting: [[g3]]}", ["{enter: [g1]}"], {"waiting": [["g3"], ["g1"]]}),
        ("{}", ["{bill: t1}"], {"wants_bill": ["t1"]}),
        (
            "{seated: {t1: [g]}, paid: [t1]}",
            ["{bill: t1}"],
            {"seated": {"t1": ["g"]}, "wants_bill": ["t1"]},
        ),
        (
            "{seated: {t1: [g]}, served: [t1]}",
            ["{order: t1}"],
            {
                "seated": {"t1": ["g"]},
                "ready_to_order": ["t1"],
                "ordered": ["t1"],
                "sent": ["t1"],
                "served": ["t1"],
            },
        ),
        (
            "{served: [t1]}",
            ["{ready: {t1: plate}}"],
            {"ordered": ["t1"], "sent": ["t1"], "ready": {"t1": "plate"}},
        ),
        ("{ordered: [t1]}", ["{ready: {t1: jug}}"], {"ordered": ["t1"], "ready": {"t1": "jug"}}),
        (
            "{}",
            ["{empty: {t1: [jug, basket], t2: jug}}"],
            {"empty": {"t1": ["basket", "jug"], "t2": "jug"}},
        ),
        ("{}", ["{free: t1}"], {}),
        ("{waiting: [[g, h], [i]]}", ["{leave: [h]}"], {"waiting": [["i"]]}),
        ("{with_agent: [g, h]}", ["{leave: [g]}"], {}),
        (
            "{seated: {t1: [g, h], t2: [i]}, wants_bill: [t1], ready_to_order: [t1], served: [t1],"
            " ready: {t1: [plate, jug]}, empty: {t1: basket}, carrying: {t1: plate}}",
            ["{leave: [h]}"],
            {"seated": {"t2": ["i"]}, "empty": {"t1": "basket"}},
        ),
        (
            "{seated: {t1: [g]}, paid: [t1], carrying: {t1: jug}}",
            ["{leave: [g]}"],
            {"carrying": {"t1": "jug"}},
        ),
        (
            "{seated: {t1: [g]}}",
            ["{leave: [g]}", "{free: t1}", "{enter: [g]}"],
            {"waiting": [["g"]]},
        ),
        (  # at the bar what is carried empty is full at once
            "{agent: a, carrying: {t1: jug}, empty: {t1: [jug, basket]}}",
            [],
            {"carrying": {"t1": "jug"}, "empty": {"t1": "basket"}},
        ),
    ],
)
def test_observations_change_the_state(
    state: str, seen: list[str], expected: dict[str, object]
) -> None:
    assert after(state, *seen) == expected


def test_where_somebody_is_seen_he_is() -> None:
    problem = pose("observe: [{at: {w1: a, agent: d}}]")
    assert (problem.state.agent, dict(problem.state.waiters)) == ("d", {"w1": "a"})
    assert problem.before_observations.agent == "b"
    assert dict(problem.state_where)["waiters.w1"] == Where("s.yaml", 1, 17)


@pytest.mark.parametrize(
    ("text", "reason", "column"),
    [
        (
            "state: {seated: {t1: [g]}}\nobserve: [{enter: [h, g]}]",
            "g enters, but is inside already: at t1",
            19,
        ),
        ("state: {with_agent: [g]}\nobserve: [{enter: [g]}]", "with the robot", 19),
        ("state: {}\nobserve: [{enter: [g]}, {enter: [g]}]", "waiting at the entrance", 33),
        ("state: {}\nobserve: [{leave: [g]}]", "g leaves, but is not inside", 20),
        ("state: {}\nobserve: [{order: t1}]", "t1 is ready to order, but nobody sits there", 19),
        (
            "state: {seated: {t1: [g]}}\nobserve: [{free: t1}]",
            "t1 is seen free, but g should sit there",
            18,
        ),
        (
            "state: {carrying: {t1: jug}}\nobserve: [{empty: {t1: jug}}]",
            "the jug of t1 is seen empty there, but the robot carries it",
            24,
        ),
        ("state: {}\nobserve: [{at: {w1: b}}]", "w1 and the agent cannot both stand on b", 17),
        ("state: {}\nobserve: [{at: {agent: d}}]", "w1 and the agent cannot both stand on d", 17),
        ("state: {waiters: {w2: a}}\nobserve: [{at: {w2: d}}]", "w2 and w1 cannot both stand", 17),
    ],
)
def test_an_observation_that_cannot_be_is_a_contradiction(
    text: str, reason: str, column: int
) -> None:
    (found,) = pose(text + "\ngoals: []").contradictions
    assert reason in found.message
    assert found.where == Where("s.yaml", 2, column)


def test_two_who_change_places_in_what_is_seen_contradict_nothing() -> None:
    problem = pose("observe: [{at: {w1: b}}, {at: {agent: d}}]")
    assert problem.contradictions == ()


TIMED = """
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d]]
entrance: a
agent: a
tables: {}
waiters: {w1: b, w2: c}
"""


@pytest.mark.parametrize(
    ("timetable", "seen", "reason"),
    [
        ("{w1: {0: b}}", "{w1: d}", "w1 is seen at d, but the timetable has him on b"),
        (
            "{w1: {3: d}}",
            "{w2: d}",
            "w1 and w2 would both stand on d at step 3, says the timetable",
        ),
    ],
)
def test_a_waiter_seen_against_the_timetable_is_a_contradiction(
    timetable: str, seen: str, reason: str
) -> None:
    timed = read_layout(f"{TIMED}timetable: {timetable}", "timed.yaml")
    scenario = read_scenario(f"observe: [{{at: {seen}}}]", "s.yaml", timed)
    (found,) = pose_problem(timed, scenario).contradictions
    assert (found.message, found.where) == (reason, Where("s.yaml", 1, 17))


# -- goals ----------------------------------------------------------------------------------


def test_parties_in_goals_are_whole_parties() -> None:
    problem = pose(
        "state: {seated: {t1: [g, h]}, waiting: [[i, j]]}\n"
        "goals: [{seated: [j]}, {paid: h}, {serve: j}, {seated: {party: j, table: t2}}]\n"
        "before: [[{paid: h}, {seated: j}]]"
    )
    assert problem.goals == (
        Goal("seated", party=("i", "j")),
        Goal("paid", party=("g", "h")),
        Goal("serve", party=("i", "j")),
        Goal("seated", party=("i", "j"), table="t2"),
    )
    assert problem.before == ((Goal("paid", party=("g", "h")), Goal("seated", party=("i", "j"))),)
    assert not problem.everybody


@pytest.mark.parametrize(
    ("goal", "message"),
    [
        (
            "seated: [g, i]",
            "s.yaml:2:19: g and i belong to two parties; give a goal for each party",
        ),
        ("seated: [k]", "s.yaml:2:19: unknown customer k; known: g, h, i, j"),
        ("paid: t4", "s.yaml:2:17: unknown table or customer t4; known: t1, t2, t3, g, h, i, j"),
        ("serve: [z]", "unknown customer z"),
        ("seated: table2", "unknown customer table2; known: g, h, i, j"),
    ],
)
def test_goals_on_nobody_are_faults(goal: str, message: str) -> None:
    with pytest.raises(LayoutError) as raised:
        pose(f"state: {{seated: {{t1: [g, h]}}, waiting: [[i, j]]}}\ngoals: [{{ {goal} }}]")
    assert message in str(raised.value)


def test_faults_of_goals_in_files_and_options_come_together() -> None:
    with pytest.raises(LayoutError) as raised:
        pose("goals: [{paid: k}]", goals=["seated: [z]", "paid: ["], bills=["t9"], enter=["x"])
    assert len(raised.value.faults) == 5


def test_a_goal_that_is_given_again_is_one_goal() -> None:
    problem = pose(
        "state: {seated: {t1: [g, h]}, waiting: [[i]]}\ngoals: [{paid: t1}, {paid: h}]",
        goals=["seated: [i]", "seated: i", "paid: t1"],
    )
    assert [goal.kind for goal in problem.goals] == ["paid", "paid", "seated"]


def test_a_contradiction_excuses_the_customers_it_names() -> None:
    problem = pose("state: {waiting: [[g]]}\nobserve: [{enter: [g, h]}]\ngoals: [{seated: [h]}]")
    assert len(problem.contradictions) == 1


def test_everybody_is_served_where_goals_are_left_out() -> None:
    problem = pose(
        "state: {with_agent: [g], waiting: [[h, i], [j]], seated: {t1: [k]}, ready_to_order: [t1],"
        " ordered: [t3], ready: {t3: jug}, carrying: {t2: plate}, empty: {t1: [jug, basket]}}\n"
        "observe: [{enter: [l]}, {bill: t2}]"
    )
    assert problem.everybody
    assert problem.goals == (
        Goal("seated", party=("g",)),
        Goal("seated", party=("h", "i")),
        Goal("seated", party=("j",)),
        Goal("seated", party=("l",)),
        Goal("paid", table="t2"),
        Goal("sent", table="t1"),
        Goal("sent", table="t3"),
        Goal("served", table="t3", item="jug"),
        Goal("served", table="t2", item="plate"),
        Goal("filled", table="t1", item="jug"),
        Goal("filled", table="t1", item="basket"),
    )
    assert problem.goals[3].where == Where("s.yaml", 2, 19)
    assert problem.goals[4].where == Where("s.yaml", 2, 32)


def test_an_instant_kitchen_lets_everybody_eat() -> None:
    problem = pose("state: {ordered: [t1]}\ninstant_kitchen: true")
    assert problem.goals == (Goal("served", table="t1"),)
    carried = pose("state: {carrying: {t1: jug}, empty: {t1: jug}}")
    assert carried.goals == (Goal("filled", table="t1", item="jug"),)


def test_nothing_to_do_is_no_goal() -> None:
    assert pose("state: {}").goals == ()
    assert pose_problem(HALL).everybody


# -- the command line -----------------------------------------------------------------------


def test_the_command_line_adds_to_the_scenario() -> None:
    problem = pose(
        "state: {waiting: [[c1], [c3]]}\nevents: [{time: 3, enter: [c4]}]",
        enter=["2", "1"],
        bills=["t1"],
    )
    assert problem.state.waiting == (("c1",), ("c3",), ("c2", "c5"), ("c6",))
    assert problem.state.wants_bill == {"t1"}
    assert dict(problem.state_where)["wants_bill.t1"] == Where("--bill")


def test_goals_of_the_command_line_come_besides_those_of_the_scenario() -> None:
    problem = pose("goals: [{at: a}]", enter=["1"], goals=["seated: [c1]", "{paid: t1}"])
    assert [goal.kind for goal in problem.goals] == ["at", "seated", "paid"]
    assert pose("state: {}", goals=["at: a"]).everybody is False


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"enter": ["0"]}, "--enter: a party has from 1 to 1000 guests, found 0"),
        ({"enter": ["-1"]}, "--enter: a party has from 1 to 1000 guests, found -1"),
        ({"enter": ["four"]}, "found four; for example: --enter 4"),
        ({"enter": ["999999999999"]}, "--enter: a party has"),
        ({"bills": ["tt1"]}, "--bill: unknown table tt1; did you mean t1?"),
        ({"goals": [""]}, "--goal: an empty goal"),
        ({"goals": ["paid t1"]}, "--goal: a goal must be a mapping (kind: what), found paid t1"),
        ({"goals": ["paid: t9: x"]}, "--goal: a colon that fits no key here"),
        ({"goals": ["ordered: [t1"]}, "--goal: the list that opens here is not closed"),
        ({"goals": ["seated: c9"]}, "--goal: unknown customer c9; nobody is inside"),
    ],
)
def test_faults_of_options_name_the_option(option: dict[str, list[str]], message: str) -> None:
    with pytest.raises(LayoutError) as raised:
        pose_problem(HALL, None, **option)  # type: ignore[arg-type]
    assert message in str(raised.value)


def test_fresh_customers_skip_every_name_in_use() -> None:
    layout = read_layout(
        "nodes: [c1, b]\nedges: [[c1, b]]\nentrance: b\nagent: c1\n"
        "tables: {c2: {capacity: 2, nodes: [b]}}\nwaiters: {c3: b}",
        "odd.yaml",
    )
    assert pose_problem(layout, None, enter=[2]).state.waiting == (("c4", "c5"),)
    names = fresh_customers([])
    assert [next(names) for _ in range(2)] == ["c1", "c2"]


def test_a_problem_needs_a_layout() -> None:
    with pytest.raises(InputError, match="give --layout"):
        read_problem(None, None)
    with pytest.raises(InputError, match="cannot both come from standard input"):
        read_problem("-", "-")


# -- JSON and back --------------------------------------------------------------------------


def plan_text(problem: Problem) -> str:
    """The parts of a plan document that a problem is read from."""
    return json.dumps(
        {
            "status": "plan",
            "initial_state": state_document(problem.state, problem.layout),
            "goals": [goal.as_dict() for goal in problem.goals],
            "before": [[a.as_dict(), b.as_dict()] for a, b in problem.before],
            "instant_kitchen": problem.instant_kitchen,
        }
    )


def comes_back(seed: int) -> None:
    problem = small_problem(seed)
    back = problem_from_plan_document(plan_text(problem), "plan.json", problem.layout)
    settled, _ = observe(problem.state, (), problem.layout)
    assert state_document(back.state, back.layout) == state_document(settled, problem.layout)
    assert [goal.as_dict() for goal in back.goals] == [goal.as_dict() for goal in problem.goals]
    assert back.instant_kitchen == problem.instant_kitchen


def test_a_problem_comes_back_from_its_plan_document() -> None:
    for seed in range(150):
        comes_back(seed)


def test_a_plan_document_with_faults_says_where() -> None:
    text = '{\n "initial_state": {"agent": "z", "waiting": [["g"], ["g"]]},\n "goals": [{"paid": "x"}]}'
    with pytest.raises(LayoutError) as raised:
        problem_from_plan_document(text, "plan.json", HALL)
    assert [str(fault.where) for fault in raised.value.faults] == [
        "plan.json:2:29",
        "plan.json:2:54",
    ]
    with pytest.raises(LayoutError, match=r"plan.json:3:21: unknown table or customer x"):
        problem_from_plan_document(
            text.replace('"z"', '"a"').replace(', ["g"]', ""), "plan.json", HALL
        )


@pytest.mark.parametrize("text", ["", "[]", "{}", "null", '{"initial_state": []}', '{"goals": 3}'])
def test_what_is_no_plan_document_is_a_fault(text: str) -> None:
    with pytest.raises(LayoutError, match=r"plan.json:1:1"):
        problem_from_plan_document(text, "plan.json", HALL)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.sampled_from(["enter", "leave", "bill", "order", "ready", "empty", "free"]), max_size=8
    ),
    st.randoms(),
)
def test_whatever_is_seen_the_state_stays_possible(kinds: list[str], rng: object) -> None:
    choose = rng.choice  # type: ignore[attr-defined]
    values = {
        "enter": lambda: f"[{choose('ghijk')}]",
        "leave": lambda: f"[{choose('ghijk')}]",
        "ready": lambda: f"{{{choose(['t1', 't2'])}: {choose(['plate', 'jug'])}}}",
        "empty": lambda: f"{{{choose(['t1', 't2'])}: {choose(['basket', 'jug'])}}}",
    }
    seen = [f"{{{kind}: {values.get(kind, lambda: choose(['t1', 't2']))()}}}" for kind in kinds]
    problem = pose(
        "state: {seated: {t1: [g, h], t2: [i]}, waiting: [[j]], carrying: {t1: jug}, paid: [t1]}\n"
        f"observe: [{', '.join(seen)}]\ngoals: []"
    )
    again = json.dumps({"initial_state": state_document(problem.state, HALL), "goals": []})
    assert problem_from_plan_document(again, "plan.json", HALL).state == problem.state
