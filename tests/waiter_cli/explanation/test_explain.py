"""Explanations: true reasons, necessary causes, changes that help, foils and their price."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.planning import scenario, search
from tests.support.sampling import mostly_wide
from tests.support.small_worlds import small_problem
from waiter_cli.bounds import find_bounds
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import InputError
from waiter_cli.explanation.explain import explain, explain_foil
from waiter_cli.explanation.foil_conflict import find_conflict
from waiter_cli.explanation.foil_reader import read_foil
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import generate_instance
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.planning import strategies
from waiter_cli.planning.search_results import SearchOptions, SearchStatus
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.translators.native import NativeTranslator

IMPOSSIBLE = ["too_big", "blocked_aisle", "unwanted_bill"]


def explained(name: str):
    return explain(scenario(name), NativeTranslator(), find_domain("restaurant"), SearchOptions())


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_each_change_that_is_proposed_helps(name: str) -> None:
    found = explained(name)
    assert found.reasons and found.helped
    for helped in found.helped:
        result = search(helped.change.problem, "gallop", use_bounds=False)
        assert result.plan is not None and result.plan.horizon == helped.horizon


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_each_cause_is_in_the_users_files(name: str) -> None:
    found = explained(name)
    assert found.causes
    for cause in found.causes:
        assert cause.where is not None and cause.where.name.endswith(".yaml")
        assert cause.where.line > 0


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_each_cause_is_necessary(name: str) -> None:
    """Taking away one cause of the set leaves a problem with a plan."""
    for cause in explained(name).causes:
        rest = cause.drop(scenario(name))
        assert search(rest, use_bounds=False).status is SearchStatus.PLAN


def test_who_stands_in_the_way_is_named() -> None:
    ran = waiter("explain", "--scenario", "blocked_aisle")
    assert ran.code == 0
    assert "n5 can be reached only through n4, where w1 stands" in ran.out
    assert "if w1 stood at n7 instead of n4: a plan of 7 steps" in ran.out


def test_json() -> None:
    document = waiter("explain", "--scenario", "too_big", "--json").json()
    assert document["status"] == "no_plan"
    assert {"message", "file", "line", "column"} == set(document["causes"][0])
    assert any(change["horizon"] == 7 for change in document["changes"])


def test_plain_words_are_used_for_a_foil() -> None:
    for ran in (
        waiter("explain", "--help"),
        waiter("explain", "--scenario", "b1", "--why-not", "go_to(n0)"),
    ):
        assert ran.code == 0
        assert "foil" not in ran.out
    assert "what another action would cost" in " ".join(waiter("explain", "--help").out.split())


def test_a_plan_needs_no_explanation() -> None:
    ran = waiter("explain", "--scenario", "b1")
    assert ran.code == 0
    assert "There is a plan of 7 steps" in ran.out


@pytest.mark.parametrize(
    ("name", "foil", "price"),
    [
        ("b1", "seat(agent,c1,table1)", 0),
        ("b1", "seat(agent,c1,table2)", 0),
        ("b1", "go_to(agent,n0)", 2),
        ("b2", "go_to(n4)", 2),
        ("b2", "seat(agent,c4,table2)", 0),
    ],
)
def test_a_foil_has_its_price(name: str, foil: str, price: int) -> None:
    problem = scenario(name)
    action = read_foil(foil, problem, find_domain("restaurant"))
    found = explain_foil(
        problem, action, NativeTranslator(), find_domain("restaurant"), SearchOptions()
    )
    assert found.price == price
    assert found.forced.plan is not None
    assert action.text in [done.text for done in found.forced.plan.actions]


@pytest.mark.parametrize(
    ("name", "foil", "words"),
    [
        ("b1", "go_to(agent,n7)", "w1 stands on n7"),
        ("b2", "seat(agent,c2,table1)", "table1"),
        ("b3", "give_bill(agent,table2)", "bill"),
    ],
)
def test_an_impossible_foil_is_told_by_its_conflict(name: str, foil: str, words: str) -> None:
    ran = waiter("explain", "--scenario", name, "--why-not", foil)
    assert ran.code == 0
    assert ran.out.startswith("No plan that reaches the goals has")
    assert words in ran.out.split(": ", 1)[1]


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("sit(agent,c1,table1)", "known are"),
        ("seat(agent,c1,tabel1)", "did you mean table1?"),
        ("seat(agent,c1)", "write seat(agent,CUSTOMER,TABLE)"),
        ("seat", "write it as"),
        ("bring_chairs(agent,table1,two)", "whole number"),
    ],
)
def test_a_foil_that_is_no_action_is_refused(text: str, hint: str) -> None:
    with pytest.raises(InputError) as caught:
        read_foil(text, scenario("b1"), find_domain("restaurant"))
    assert hint in (caught.value.faults[0].hint or "")


@pytest.mark.parametrize(
    ("posed", "foil", "reason"),
    [
        (((1, 3), ()), "seat(agent,c2,table1)", "table1 is for 2, the party of c2 has 3"),
        (
            ((1,), ("table1",)),
            "seat(agent,c1,table2)",
            "after it nobody can sit at table1, so its bill can never be given",
        ),
        ("lunch", "seat(agent,c9,table4)", "table4 is for 4, the party of c9 has 5"),
        ("lunch", "take_up(agent,plate,table5)", "no plate for table5 is ready"),
        ("lunch", "bring(agent,plate,table5)", "no plate for table5 is ready"),
        ("lunch", "seat(agent,c4,table4)", "the party of c4 sits at table3 already"),
        ("lunch", "pick(agent,c4)", "the party of c4 sits at table3 already"),
        (
            "b2",
            "seat(agent,c2,table1)",
            "table1 is not free: the party of c1 sits there",
        ),
    ],
)
def test_where_the_robot_happens_to_be_is_no_reason(
    posed: str | tuple[tuple[int, ...], tuple[str, ...]], foil: str, reason: str
) -> None:
    if isinstance(posed, str):
        problem = scenario(posed)
    else:
        problem = read_problem("report", None, *posed)[0]
    plan = find_bounds(problem).plan
    assert plan is not None
    assert (
        find_conflict(problem, read_foil(foil, problem, find_domain("restaurant")), plan) == reason
    )


@pytest.mark.parametrize("seed", range(0, 40, 2))
def test_reasons_against_any_action_are_about_the_action(seed: int) -> None:
    problem = small_problem(seed)
    plan = find_bounds(problem).plan
    if plan is None:
        return
    names = {
        "NODE": [node.name for node in problem.layout.nodes],
        "TABLE": [table.name for table in problem.layout.tables],
        "CUSTOMER": [party[0] for party in problem.state.parties()],
        "OBJECT": list(problem.layout.objects),
    }
    for name, kinds in (("go_to", ("NODE",)), ("pick", ("CUSTOMER",)), ("give_bill", ("TABLE",)),
                        ("seat", ("CUSTOMER", "TABLE")), ("bring", ("OBJECT", "TABLE"))):  # fmt: skip
        for arguments in product(*(names[kind] for kind in kinds)):
            said = find_conflict(problem, Action(0, name, ("agent", *arguments)), plan)
            assert "the agent is at" not in said and "no neighbour" not in said, said
            assert name == "bring" or "does not follow" not in said, said


def test_a_waiter_in_the_way_is_told_with_his_timetable(tmp_path: Path) -> None:
    layout = tmp_path / "line.yaml"
    layout.write_text(
        "nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [6, 0]}\nedges: [[a, b], [b, c], [c, d]]\n"
        "entrance: a\nagent: a\ntables: {t: {capacity: 1, nodes: [d], at: [6, 2]}}\n"
        "waiters: {w: d}\ntimetable: {w: {1: b, 2: c}}\n"
    )
    ran = waiter("explain", "--layout", layout, "--enter", "1")
    said = "w stands at d, then at b from step 1 on, at c from step 2 on"
    assert f"  {layout}:6:11: {said}\n" in ran.out


@pytest.fixture
def ballet(tmp_path: Path) -> str:
    """The restaurant where the robot walks otherwise, and may turn on the spot."""
    text = find_domain("restaurant").template.text.replace("go_to", "walk_to")
    path = tmp_path / "ballet.sparc"
    text = text.replace("#basic_action = ", "#basic_action = {pirouette} + ")
    path.write_text(text.replace("\nrules\n", "\nrules\npossible(pirouette, 0).\n"))
    return str(path)


@pytest.mark.parametrize(
    ("foil", "said"),
    [
        ("walk_to(agent, n6).", "walk_to(agent,n6) is part of a minimal plan of 4 steps."),
        ("walk_to(agent,n4)", "walk_to(agent,n4) costs 2 more: 6 steps instead of 4."),
        ("pirouette", "pirouette costs 1 more: 5 steps instead of 4."),
    ],
)
def test_a_foil_of_ones_own_domain_has_its_price(foil: str, said: str, ballet: str) -> None:
    ran = waiter("explain", "--scenario", "b2", "--domain", ballet, "--why-not", foil)
    assert (ran.code, ran.out.splitlines()[0]) == (0, said)


@pytest.mark.parametrize(
    ("foil", "hint"),
    [
        ("walk_to(agent,n33)", "did you mean walk_to(agent,n3)?"),
        ("xyz", "its actions are pirouette, walk_to, pick, seat, give_bill"),
        ("walk_to(", "did you mean walk_to"),
        ("walk_to(agent,N)", "did you mean walk_to"),
        ("pick(agent,c2),0) % ", "did you mean pick(agent,c2)?"),
        ("7", "its actions are pirouette, walk_to"),
    ],
)
def test_what_is_no_action_of_ones_own_domain_is_refused(foil: str, hint: str, ballet: str) -> None:
    ran = waiter("explain", "--scenario", "b2", "--domain", ballet, "--why-not", foil)
    assert ran.code == 2
    assert f"is no action of {ballet}\n  hint: {hint}" in ran.err


@pytest.mark.parametrize("seed", range(4))
def test_the_reason_of_a_generated_impossibility_is_true(seed: int) -> None:
    """Removing what is blamed makes the problem solvable."""
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.files.scenario_reader import read_scenario
    from waiter_cli.problems.pose import pose_problem

    kinds = ("too_big", "blocked_aisle", "bill_nobody", "too_many_parties")
    layout_text, scenario_text = generate_instance(seed, "S", unsolvable=kinds[seed])
    layout = read_layout(layout_text, "layout.yaml")
    problem = pose_problem(layout, read_scenario(scenario_text, "scenario.yaml", layout))
    found = explain(problem, NativeTranslator(), find_domain("restaurant"), SearchOptions())
    assert found.result.status is SearchStatus.NO_PLAN
    assert found.reasons
    assert found.causes
    for helped in found.helped:
        assert search(helped.change.problem).status is SearchStatus.PLAN


def test_why_not_sooner_is_told_by_what_each_wish_costs(tmp_path: Path) -> None:
    scenario = tmp_path / "two.yaml"
    scenario.write_text(
        "layout: report\nstate:\n  seated: {table2: [a]}\n  wants_bill: [table2]\n"
        "observe: [{enter: [b]}]\ngoals: [{seated: [b]}, {paid: table2}]\n"
    )
    whole = json.loads(waiter("plan", "-s", str(scenario), "--json").out)["horizon"]
    ran = waiter("explain", "-s", str(scenario), "--json")
    told = json.loads(ran.out)["not_sooner"]
    for goal, other in (("seated: [b]", "paid: table2"), ("paid: table2", "seated: [b]")):
        alone = tmp_path / "one.yaml"
        alone.write_text(scenario.read_text().split("goals:")[0] + f"goals: [{{{other}}}]\n")
        due = json.loads(waiter("plan", "-s", str(alone), "--json").out)["horizon"]
        assert due in [wish["without"] for wish in told] and due <= whole, goal
    said = waiter("explain", "-s", str(scenario)).out
    assert f"None is done in {whole - 1}: " in said and "paid: table2 costs " in said


def test_what_bounds_settle_is_not_searched_for(monkeypatch: pytest.MonkeyPatch) -> None:
    searched: list[Problem] = []
    search = strategies.find_minimal_plan

    def noted(problem: Problem, *args: Any, **options: Any) -> Any:
        searched.append(problem)
        return search(problem, *args, **options)

    monkeypatch.setattr(strategies, "find_minimal_plan", noted)
    explanation = explained("too_big")
    assert len(explanation.helped) == 3 and explanation.causes
    assert searched and all(find_bounds(problem).plan is None for problem in searched)


PAIR = """\
nodes: [a, b, c, d]
edges: [[a, b], [b, c], [c, d]]
entrance: a
agents: {r1: b, r2: d}
tables: {t1: {capacity: 2, nodes: [c]}}
"""


def test_of_several_robots_one_may_be_in_the_way_of_another(tmp_path: Path) -> None:
    layout = tmp_path / "pair.yaml"
    layout.write_text(PAIR)
    document = waiter("explain", "-l", str(layout), "--goal", "at: {r1: d}", "--json").json()
    assert document["status"] == "no_plan"
    (conflict,) = document["conflicts"]
    assert [cause["line"] for cause in conflict] == [4, None]
    assert conflict[0]["message"] == "r2 stands at d and may be in the way"
    solved = waiter("explain", "-l", str(layout), "--enter", "2")
    assert solved.code == 0 and "There is a plan of" in solved.out


KEPT = "layout: report\nstate: {agent: n6, fluents: [isdirty(table1)]}\ngoals: [{at: n3}]\n"


@pytest.mark.wide
def test_what_can_never_be_done_is_told_with_the_rule_that_asks_for_it(tmp_path: Path) -> None:
    """Nothing makes the other table dirty; the dirty one can be wiped, at a price."""
    (tmp_path / "s.yaml").write_text(KEPT)
    options = ("explain", "--scenario", str(tmp_path / "s.yaml"), "--domain", "housekeeping")
    never = waiter(*options, "--why-not", "clean(agent,table2)")
    assert never.code == 0 and "nothing that can come about from here lets it happen" in never.out
    assert "domains/housekeeping/domain.sparc:" in never.out and "possible(clean(" in never.out
    costs = waiter(*options, "--why-not", "clean(agent,table1)")
    assert costs.code == 0 and "clean(agent,table1) costs 1 more" in costs.out


TRIED = {
    "if isdirty(table1) did not hold": "fluents: [isdirty(table1)]",
    "without the fact holds(isdirty(table1),0)": "facts: ['holds(isdirty(table1),0)']",
    "if spilled(table1) had not been": "observe: [{obs: spilled(table1)}]",
}


@pytest.mark.wide
@pytest.mark.parametrize("expected", mostly_wide(TRIED, *list(TRIED)[-1:]))
def test_fluents_facts_and_what_was_seen_are_tried_as_changes(
    expected: str, tmp_path: Path
) -> None:
    """Where nothing cleans, a party is seated only where its table was not dirty from the start."""
    rules = find_domain("housekeeping").template.text
    lines = [line for line in rules.split("\n") if not line.startswith("possible(clean")]
    (tmp_path / "never.sparc").write_text("\n".join(lines))
    given = TRIED[expected]
    inner = f", {given}" if given.startswith("fluents") else ""
    more = "" if inner else given + "\n"
    (tmp_path / "s.yaml").write_text(
        f"layout: report\nstate: {{agent: n5, waiting: [[ada]], seated: {{table2: [eve]}}{inner}}}\n"
        f"{more}goals: [{{seated: [ada]}}]\n"
    )
    ran = waiter(
        "explain", "--scenario", str(tmp_path / "s.yaml"),
        "--domain", str(tmp_path / "never.sparc"),
    )  # fmt: skip
    assert ran.code == 0 and expected in ran.out, ran.out + ran.err
    assert "isdirty(table2)" not in ran.out
    line = 1 + lines.index(":- occurs(seat(agent, _, T), I), holds(isdirty(T), I).")
    blamed = f"{tmp_path}/never.sparc:{line}:1: the rule :- occurs(seat(agent, _, T), I)"
    assert blamed in " ".join(ran.out.split()) and "(A dirty table takes no one)" in ran.out


def test_rules_of_the_restaurant_itself_are_not_to_blame(tmp_path: Path) -> None:
    document = waiter("explain", "-s", "blocked_aisle", "--json").json()
    assert not [each for each in document["causes"] if each["message"].startswith("the rule")]


AISLE = """
name: aisle
nodes: [west, middle, east, bay]
edges: [[west, middle], [middle, east], [middle, bay]]
entrance: west
tables: {t1: {capacity: 2, nodes: [east]}, t2: {capacity: 4, nodes: [bay]}}
agents: {r1: west, r2: east}
"""


@pytest.mark.parametrize(
    ("foil", "told"),
    [
        ("go_to(r2,bay)", "costs nothing: a minimal plan of 4 steps has it"),
        ("go_to(r1,bay)", "costs nothing: a minimal plan of 4 steps has it"),
        ("give_bill(r1,t1)", "t1 wants no bill"),
        ("bring_chairs(r2,t1,2)", "t1 has 2 chairs, and room for 2"),
        ("go_to(r3,bay)", "unknown robot r3"),
        ("go_to(bay)", "write go_to(ROBOT,NODE)"),
    ],
)
def test_a_foil_of_one_of_several_robots(tmp_path: Path, foil: str, told: str) -> None:
    layout = tmp_path / "aisle.yaml"
    layout.write_text(AISLE)
    goals = ("--goal", "at: {r1: east}", "--goal", "at: {r2: west}")
    ran = waiter("explain", "--layout", str(layout), *goals, "--why-not", foil)
    assert told in ran.out + ran.err
    assert ran.code == (2 if "unknown" in told or "write" in told else 0)
    assert ("minimal plan" in told) == ("step  r1" in ran.out)


def test_a_plan_of_several_robots_that_nobody_sees_is_not_chosen_among_its_like() -> None:
    layout = read_layout(AISLE, "aisle.yaml")
    problem = pose_problem(layout, read_scenario("goals: [{at: {r2: west}}]", "s.yaml", layout))
    translator, domain = NativeTranslator(), find_domain("restaurant")
    foil = Action(0, "go_to", ("r1", "bay"))
    found = explain_foil(problem, foil, translator, domain, SearchOptions())
    assert (found.best.ties, found.forced.ties) == (None, "proved")
    assert explain(problem, translator, domain, SearchOptions()).result.ties is None


@pytest.mark.parametrize(
    ("enter", "foil", "told"),
    [
        (("2", "3"), "seat(r1,c1,t2)", "after it a party of 3 (c3"),
        (("3",), "seat(r1,c1,t1)", "t1 is for 2, the party of c1 has 3"),
        (("2",), "take_order(r2,t1)", "t1 is not ready to order"),
        (("2",), "send_order(r2,t1)", "r2 has no order of t1"),
        (("2",), "bring(r2,jug,t1)", "no jug for t1 is ready"),
        (("2",), "refill(r2,jug,t1)", "the jug of t1 is not empty"),
    ],
)
def test_what_no_plan_of_several_robots_has(
    tmp_path: Path, enter: tuple[str, ...], foil: str, told: str
) -> None:
    layout = tmp_path / "aisle.yaml"
    layout.write_text(AISLE.replace("agents", "bar: [west]\nagents"))
    guests = [word for size in enter for word in ("--enter", size)]
    ran = waiter("explain", "--layout", str(layout), *guests, "--why-not", foil, "--json")
    assert ran.code == 0 and told in ran.json()["conflict"]
