"""What a search does on its way: how often it translates, where ties end, what its stages say."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from sparc.solving import clingo_solver as native
from sparc.source import Source
from sparc.translation.asp_program import AspProgram
from tests.support.planning import length, scenario, search
from waiter_cli import bounds
from waiter_cli.encoding.domains import find_domain
from waiter_cli.encoding.template import fill_template
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.flow_bounds import is_available
from waiter_cli.layout_tools.generate import generate_layout, generate_scenario
from waiter_cli.model.plan import Action, Plan
from waiter_cli.planning import prober as probing
from waiter_cli.planning import strategies as search_module
from waiter_cli.planning.prober import LimitReached, Prober
from waiter_cli.planning.search_results import (
    InvalidPlanError,
    SearchOptions,
    SearchResult,
    SearchStatus,
)
from waiter_cli.planning.strategies import find_minimal_plan
from waiter_cli.problems.from_options import read_problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.translators.native import NativeTranslator

STRATEGIES = ["binary", "linear", "gallop", "minimize"]
LINE = """
name: line
nodes: {a: [0, 0], b: [2, 0], c: [4, 0], d: [6, 0]}
edges: [[a, b], [b, c], [c, d]]
entrance: d
agent: a
tables: {t: {capacity: 1, nodes: [d]}}
"""


@dataclass
class Costly:
    """Our translator, as one that is called seldom."""

    name: str = "native"
    costly: bool = True
    horizons: list[int] = field(default_factory=list)

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        found = re.search(r"#step\s*=\s*0\.\.(\d+)", source.text)
        assert found, source.text[:500]
        self.horizons.append(int(found[1]))
        return NativeTranslator().translate(source, time_limit=time_limit)


def wrong_hint(monkeypatch: pytest.MonkeyPatch, lower: int, steps: int) -> None:
    """The bounds come with a plan of so many steps that the program refuses."""
    problem = read_problem("report", None, goals=("at: n0",))[0]
    real = bounds.find_bounds(problem)
    idle = Plan(tuple(Action(step, "give_bill", ("agent", "table1")) for step in range(1)), steps)
    wrong = type(real)(lower, idle, real.cap, ())
    monkeypatch.setattr(bounds, "find_bounds", lambda problem, **_: wrong)


# -- where there is just enough room ----------------------------------------------------------


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_a_plan_as_long_as_the_longest_there_can_be(
    strategy: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search_module, "crude_cap", lambda problem: 3)
    problem = pose_problem(read_layout(LINE, "line"), None, goals=["at: d"])
    assert length(search(problem, strategy, use_bounds=False)) == 3


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_a_step_too_few_is_undecided(strategy: str) -> None:
    problem = pose_problem(read_layout(LINE, "line"), None, goals=["at: d"])
    result = search(problem, strategy, use_bounds=False, max_steps=2)
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "max_steps")


# -- translators that are costly --------------------------------------------------------------


@pytest.mark.parametrize(
    ("strategy", "use_bounds", "most", "expected"),
    [
        ("linear", True, None, [7]),
        ("linear", False, None, [27]),
        ("linear", False, 9, [9]),
        ("gallop", False, None, [27]),
        ("gallop", False, 12, [12]),
        ("binary", True, None, [7]),
    ],
)
def test_a_costly_translator_is_asked_once(
    strategy: str, use_bounds: bool, most: int | None, expected: list[int]
) -> None:
    """For a horizon that suffices: the plan of the bounds, the cap, or the most that is allowed."""
    problem = scenario("b1")
    cap = search_module.crude_cap(problem)
    assert cap is not None
    translator = Costly()
    result = search(problem, strategy, translator=translator, use_bounds=use_bounds, max_steps=most)
    assert length(result) == 7
    assert translator.horizons == [cap if each == 27 else each for each in expected]


def test_one_that_is_not_is_asked_for_each_horizon() -> None:
    translator = Costly(costly=False)
    assert length(search(scenario("b2"), "linear", translator=translator)) == 4
    assert translator.horizons == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(
    ("strategy", "expected"), [("linear", [0, 1, 2, 3, 4]), ("binary", [1, 2, 3, 4, 5])]
)
def test_rules_of_ones_own_are_grounded_for_horizons_that_grow(
    strategy: str, expected: list[int]
) -> None:
    """Whatever the translator costs.  An open horizon takes two texts: of a horizon, and of one more."""
    domain = replace(find_domain("restaurant"), built_in=False)
    translator = Costly()
    found = search_module.find_minimal_plan(
        scenario("b2"), translator, domain, SearchOptions(strategy=strategy, max_steps=6)
    )
    assert length(found) == 4
    assert sorted(set(translator.horizons)) == expected


def test_rules_of_ones_own_have_a_most_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(search_module, "OWN_DOMAIN_MAX_STEPS", 3)
    domain = replace(find_domain("restaurant"), built_in=False)
    found = search_module.find_minimal_plan(
        scenario("b2"), NativeTranslator(), domain, SearchOptions()
    )
    assert (found.status, found.limit, found.max_steps) == (
        SearchStatus.UNDECIDED,
        "max_steps",
        3,
    )


# -- hints ------------------------------------------------------------------------------------


def test_an_offer_that_is_refused_leaves_the_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = read_problem("report", None, goals=("at: n0",))[0]
    wrong_hint(monkeypatch, 5, 5)
    result = search(problem)
    assert length(result) == 5
    assert (result.proof, result.bounds) == ("bound", (5, 5))
    assert [(probe.horizon, probe.result) for probe in result.probes] == [(5, "sat")]


def test_a_longer_hint_that_is_refused_only_says_where_to_look(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = read_problem("report", None, goals=("at: n0",))[0]
    wrong_hint(monkeypatch, 1, 8)
    result = search(problem)
    assert length(result) == 5
    assert result.proof == "unsat"
    assert result.probes[0].horizon == 8


def test_a_hint_as_long_as_allowed_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = read_problem("report", None, goals=("at: n0",))[0]
    asked: list[Plan | None] = []
    probe = Prober.probe

    def noted(self: Prober, horizon: int, fixed: Plan | None = None) -> bool:
        asked.append(fixed)
        return probe(self, horizon, fixed)

    monkeypatch.setattr(Prober, "probe", noted)
    wrong_hint(monkeypatch, 1, 5)
    assert length(search(problem, max_steps=5)) == 5
    assert asked[0] is not None and asked[0].horizon == 5
    asked.clear()
    wrong_hint(monkeypatch, 1, 6)
    assert length(search(problem, max_steps=5)) == 5
    assert asked and not any(asked)


# -- ties -------------------------------------------------------------------------------------


def stages(result: Any, name: str) -> list[str]:
    return [stage.outcome for stage in result.stages if stage.name == name]


def test_what_ties_cost_is_told() -> None:
    (told,) = stages(search(scenario("b1")), "optimize")
    assert re.fullmatch(r"horizon 7, cost (\d+ )*\d+, proved the best", told)


def test_the_search_for_a_better_choice_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """After so many conflicts: the choice found by then is as short as any."""
    monkeypatch.setattr(search_module, "TIE_CONFLICTS", 1)
    result = search(read_problem("bistro", "lunch")[0])
    assert result.status is SearchStatus.PLAN and result.minimal
    (told,) = stages(result, "optimize")
    assert told.endswith(", as far as was looked")


@pytest.mark.parametrize("error", [LimitReached("time"), MemoryError()])
def test_ties_that_a_limit_leaves_open(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    def fails(*_: object) -> bool:
        raise error

    monkeypatch.setattr(Prober, "improve", fails)
    result = search(scenario("b1"))
    assert length(result) == 7 and result.limit is None
    assert stages(result, "ties") == ["left open at the limit"]


def test_nothing_to_settle_is_not_settled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Prober, "improve", None)
    here = read_problem("report", None, goals=("at: n1",))[0]
    assert length(search(replace(here, prefer=("shortest_walk",)))) == 0


# -- one optimization -------------------------------------------------------------------------


def test_an_optimization_proves_by_solving() -> None:
    result = search(scenario("b2"), "minimize", use_bounds=False)
    assert (result.proof, result.bounds) == ("unsat", (4, 4))
    (probe,) = [probe for probe in result.probes if probe.horizon == 3]
    assert probe.seconds == 0.0, "one search found both"
    assert all(round(probe.seconds, 6) == probe.seconds for probe in result.probes)
    assert stages(result, "optimize")[0].startswith("horizon 4, cost ")


def test_an_optimization_that_is_cut_short_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Prober, "improve", lambda *_: False)
    result = search(scenario("b2"), "minimize", use_bounds=False)
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "time")
    assert result.plan is not None and not result.minimal


# -- terms ------------------------------------------------------------------------------------


def test_actions_as_the_solver_has_them() -> None:
    import clingo

    action = Action(3, "bring_chairs", ("agent", "table1", "5"))
    wanted = clingo.parse_term("occurs(bring_chairs(agent,table1,5),3)")
    assert probing._occurs(action) == wanted  # the number is one, it does not only look like one


def test_what_happens_after_the_goals_hold_is_no_part_of_a_plan() -> None:
    import clingo

    texts = ["goal(2)", "goal(3)", *(f"occurs(go_to(agent,n{n}),{n})" for n in range(4))]
    symbols = [clingo.parse_term(text) for text in texts]
    plan = probing._read_plan(symbols, 4)
    assert plan.horizon == 2 and [action.step for action in plan.actions] == [0, 1]
    assert probing._read_plan(symbols[2:], 4).horizon == 4


# -- bounds -----------------------------------------------------------------------------------


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """With what the module of bounds was asked."""
    calls: list[dict[str, Any]] = []
    find = bounds.find_bounds

    def noted(problem: Any, **options: Any) -> Any:
        assert problem is not None
        calls.append(options)
        return find(problem, **options)

    monkeypatch.setattr(bounds, "find_bounds", noted)
    return calls


def with_bounds(monkeypatch: pytest.MonkeyPatch, **changed: Any) -> None:
    """The bounds say something else."""
    find = bounds.find_bounds
    monkeypatch.setattr(
        bounds, "find_bounds", lambda *given, **more: replace(find(*given, **more), **changed)
    )


def test_bounds_are_asked_within_the_time_there_is(asked: list[dict[str, Any]]) -> None:
    assert length(search(scenario("b1"), time_limit=60)) == 7
    (options,) = asked
    assert options["deadline"] is not None and "effort" not in options


@pytest.mark.parametrize("small", [False, True])
@pytest.mark.parametrize(("long", "times"), [(7, 2), (8, 1)])
def test_effort_is_spent_on_long_plans_whose_bounds_do_not_meet(
    long: int, times: int, small: bool, asked: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search_module, "LONG", long)
    if not small:
        monkeypatch.setattr(search_module, "SMALL", 0)
    with_bounds(monkeypatch, lower=6)
    assert length(search(scenario("b1"), time_limit=60)) == 7
    assert len(asked) == times
    effort = search_module.FIRST_EFFORT if is_available() and not small else 10
    assert [options.get("effort") for options in asked[1:]] == [effort] * (times - 1)
    assert all(options["deadline"] is not None for options in asked)


@pytest.mark.skipif(not is_available(), reason="what is large is left to HiGHS")
def test_no_more_effort_where_the_problem_is_large(
    asked: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search_module, "LONG", 7)
    monkeypatch.setattr(search_module, "LARGE", 0)
    with_bounds(monkeypatch, lower=6)
    assert length(search(scenario("b1"), time_limit=60)) == 7
    assert len(asked) == 1


@pytest.mark.wide
@pytest.mark.parametrize(("seed", "length_known"), [(0, 38), (5, 36)])
def test_evenings_of_some_forty_steps_are_proved_by_bounds(seed: int, length_known: int) -> None:
    """What takes bounds a few tenths of a second takes clingo more than five to refute."""
    layout = read_layout(generate_layout(seed, 20, 8, bar=True), "layout.yaml")
    evening = generate_scenario(seed, layout, 2, 1, orders=2, refills=2)
    result = search(pose_problem(layout, read_scenario(evening, "evening.yaml", layout)))
    assert (result.bounds, result.proof) == ((length_known, length_known), "bound")


def test_no_effort_where_the_bounds_meet(
    asked: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search_module, "LONG", 1)
    assert length(search(scenario("b1"))) == 7
    assert len(asked) == 1


@pytest.mark.parametrize(
    ("crude", "fine", "used"), [(20, 9, 9), (9, 20, 9), (None, 9, 9), (9, None, 9)]
)
def test_the_smaller_cap_counts(
    crude: int | None, fine: int | None, used: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(search_module, "crude_cap", lambda problem: crude)
    with_bounds(monkeypatch, cap=fine, plan=None, lower=0)
    searching = search_module._Search(
        scenario("b1"), NativeTranslator(), find_domain("restaurant"), SearchOptions()
    )
    searching.bounds()
    assert (searching.cap, searching.enough) == (used, used)
    assert stages(searching, "bounds") == ["at least 0 steps, no plan known"]


def test_a_plan_of_the_bounds_suffices_unless_something_else_is_asked() -> None:
    for required, enough in ((None, 7), (Action(0, "go_to", ("agent", "n0")), None)):
        searching = search_module._Search(
            scenario("b1"), NativeTranslator(), find_domain("restaurant"), SearchOptions(), required
        )
        found = searching.bounds()
        assert found is not None
        assert searching.enough is not None and searching.enough == (enough or searching.cap)
        assert stages(searching, "bounds") == ["at least 7 steps, a plan of 7"]


# -- one probe --------------------------------------------------------------------------------


def test_a_probe_is_one_model_within_the_time_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    from sparc.solving.clingo_solver import Grounding

    asked: list[dict[str, Any]] = []
    models = Grounding.models

    def noted(self: Grounding, **options: Any) -> Any:
        asked.append(options)
        return models(self, **options)

    monkeypatch.setattr(Grounding, "models", noted)
    searching = search_module._Search(
        scenario("b2"),
        NativeTranslator(),
        find_domain("restaurant"),
        SearchOptions(time_limit=60),
    )
    searching.ground(4)
    assert searching.probe(4) and searching.best is not None
    (options,) = asked
    assert (options["limit"], options["optimize"]) == (1, False)
    assert options["deadline"] == searching.deadline
    assert [str(symbol) for symbol, _ in options["assumptions"]] == ["__deadline(4)"]
    first = searching.best
    searching.probe(4)
    assert searching.best is first, "a plan as long is no better"
    searching.probe(4, Plan((Action(0, "go_to", ("agent", "n5")),), 4))
    fixed = [(str(symbol), true) for symbol, true in asked[-1]["assumptions"]]
    assert fixed[:2] == [("__deadline(4)", True), ("occurs(go_to(agent,n5),0)", True)]
    idle = [text for text, true in fixed[2:] if not true]
    assert len(idle) == len(fixed) - 2 > 0, "and nothing else is done"
    assert not any(text.endswith(",0)") for text in idle)


# -- how long a plan can have to be -----------------------------------------------------------


@pytest.mark.parametrize(
    ("state", "deeds"),
    [
        ({}, 0),
        ({"waiting": (("a",), ("b", "c"))}, 4),  # picked and seated, each
        ({"with_agent": ("a",)}, 1),
        ({"wants_bill": frozenset({"t"})}, 1),
        ({"ready_to_order": frozenset({"t"})}, 4),  # taken, sent, taken up, brought
        ({"ordered": frozenset({"t"})}, 3),
        ({"sent": frozenset({"t"})}, 2),
        ({"ready": frozenset({("t", "jug")})}, 2),
        ({"empty": frozenset({("t", "jug")})}, 3),
        ({"carrying": ("t", "jug")}, 1),
    ],
    ids=str,
)
def test_the_crudest_cap_has_each_deed_once_and_a_walk_before_each(
    state: dict[str, Any], deeds: int
) -> None:
    problem = pose_problem(read_layout(LINE, "line"), None, goals=["at: d"])
    chairs, end, walk = 1, 2, 1 + len(problem.layout.nodes)
    posed = replace(problem, state=replace(problem.state, **state))
    assert search_module.crude_cap(posed) == (chairs + deeds + end) * walk
    pair = (problem.goals[0], problem.goals[0])
    ordered = replace(posed, before=(pair, pair, pair))
    assert search_module.crude_cap(ordered) == (chairs + deeds + 3 + end) * walk
    layout = replace(problem.layout, timetable=(("w", 9, "a"), ("w", 4, "b")))
    later = replace(posed, layout=layout)
    assert search_module.crude_cap(later) == 9 + (chairs + deeds + end) * walk


# -- what a result says -----------------------------------------------------------------------


def test_memory_that_runs_out_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object, **__: object) -> bool:
        raise MemoryError

    monkeypatch.setattr(Prober, "probe", fails)
    result = search(scenario("b1"), "gallop")
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "memory")
    assert (result.minimal, result.proof, result.strategy) == (False, None, "gallop")


def test_seconds_are_counted_from_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter(range(1000, 10_000))
    monkeypatch.setattr(search_module.time, "monotonic", lambda: float(next(clock)))
    result = search(scenario("b4"))
    assert 0 < result.seconds < next(clock) - 1000


def by_own_rules() -> SearchResult:
    domain = replace(find_domain("restaurant"), built_in=False)
    return find_minimal_plan(scenario("b4"), NativeTranslator(), domain, SearchOptions())


def test_rules_of_ones_own_are_asked_again_with_the_plan_as_facts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    said: list[str] = []
    ground = Prober.ground

    def listens(self: Prober, horizon: int, extra: str | None = None, **more: Any) -> None:
        said.append(extra or "")
        ground(self, horizon, extra, **more)

    monkeypatch.setattr(Prober, "ground", listens)
    found = by_own_rules()
    assert found.plan is not None
    (action,) = found.plan.actions
    assert said[-1].split() == [f"occurs({action.text},0)."]


def test_rules_that_refuse_their_own_plan_are_a_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    ground = Prober.ground

    def refuses(self: Prober, horizon: int, extra: str | None = None, **more: Any) -> None:
        ground(self, horizon, extra and f"{extra}:- occurs(A,0).", **more)

    monkeypatch.setattr(Prober, "ground", refuses)
    with pytest.raises(InvalidPlanError, match=r"refuses its own plan: occurs\(give_bill"):
        by_own_rules()


def test_a_plan_that_cannot_be_asked_about_in_time_is_no_defect(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ground = Prober.ground

    def late(self: Prober, horizon: int, extra: str | None = None, **more: Any) -> None:
        ground(self, horizon, extra, **more)
        self.deadline = time.monotonic() if extra else self.deadline

    monkeypatch.setattr(Prober, "ground", late)
    found = by_own_rules()
    assert found.status is SearchStatus.UNDECIDED and found.limit == "time"
    assert found.plan is not None


def test_costs_by_priority_are_told_apart() -> None:
    problem = replace(scenario("b1"), prefer=("shortest_walk", "smallest_table"))
    (told,) = stages(search(problem), "optimize")
    assert re.fullmatch(r"horizon 7, cost -?\d+ -?\d+, proved the best", told)


def test_the_stages_of_a_search_in_their_order() -> None:
    result = search(scenario("b4"), "linear")
    found = [(stage.name, stage.outcome) for stage in result.stages]
    names = [name for name, _ in found]
    program = fill_template(find_domain("restaurant").template, scenario("b4"), 1)
    asp = NativeTranslator().translate(program)
    assert names == ["bounds", *["template", "translate", "ground", "solve"] * 2]
    assert found[5:9] == [
        ("template", f"{len(program.text.splitlines())} lines of SPARC"),
        ("translate", f"{len(asp.text.splitlines())} lines of ASP"),
        ("ground", "horizon 1"),
        ("solve", "horizon 1: sat"),
    ]
    assert [(probe.horizon, probe.result) for probe in result.probes] == [(0, "unsat"), (1, "sat")]
    assert all(0 < probe.seconds < 60 for probe in result.probes)


@dataclass
class Hurried:
    """A translator that is told how long it may take, and takes longer."""

    name: str = "native"
    costly: bool = False
    told: list[float | None] = field(default_factory=list)

    def translate(self, source: Source, *, time_limit: float | None = None) -> AspProgram:
        self.told.append(time_limit)
        raise TimeoutError


@pytest.mark.parametrize("given", [None, 30.0])
def test_a_translator_has_the_time_that_is_left(given: float | None) -> None:
    hurried = Hurried()
    result = search(scenario("b1"), "gallop", translator=hurried, time_limit=given)
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "time")
    (told,) = hurried.told
    assert told is None if given is None else told is not None and 20 < told <= 30


def test_a_search_that_the_time_limit_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native.Grounding, "models", lambda self, **_: iter(()))
    unknown = native.Outcome(native.Satisfiability.UNKNOWN, 0, 0.0, False)
    monkeypatch.setattr(native.Grounding, "outcome", property(lambda self: unknown))
    result = search(scenario("b1"), "gallop")
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "time")


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_the_step_that_is_not_allowed_may_be_the_one_that_suffices(
    strategy: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where everything shorter than the cap is refuted, a plan as long as the cap may exist."""
    monkeypatch.setattr(search_module, "crude_cap", lambda problem: 3)
    problem = pose_problem(read_layout(LINE, "line"), None, goals=["at: d"])
    result = search(problem, strategy, use_bounds=False, max_steps=2)
    assert (result.status, result.limit) == (SearchStatus.UNDECIDED, "max_steps")


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_what_holds_already_takes_no_step(strategy: str) -> None:
    problem = pose_problem(read_layout(LINE, "line"), None, goals=["at: a"])
    result = search(problem, strategy, use_bounds=False)
    assert length(result) == 0 and result.bounds == (0, 0)
    assert all(0 <= stage.seconds < 60 for stage in result.stages)


def test_an_optimization_translates_once_more_only_for_another_horizon() -> None:
    translator = Costly(costly=False)
    assert length(search(scenario("b2"), "minimize", translator=translator)) == 4
    assert len(set(translator.horizons)) == len(translator.horizons)
