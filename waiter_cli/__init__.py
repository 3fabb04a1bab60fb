"""`waiter`: plans for a robot waiter, from a restaurant in YAML to a proof that none is shorter.

The front door.  Each stage is one call from values to a value, and is loaded when it is first used:

>>> import waiter_cli
>>> layout = waiter_cli.read_layout("report")
>>> problem = waiter_cli.pose_problem(layout, enter=[1])
>>> answer = waiter_cli.plan(problem)
>>> answer.plan.horizon, answer.result.minimal
(7, True)
>>> waiter_cli.validate(answer).valid
True

`search_plan` is the whole pipeline from names of files.  Values are frozen.  Steps count from 0, times
are in seconds, lengths in metres.  What is wrong with an input raises `InputError` (`LayoutError` for
layouts and scenarios, `ReplayError` for plan files), whose ``faults`` have the place, the message and the
mend of each; what is not installed raises `MissingError`.  That no plan exists is no error but an answer.
"""

from __future__ import annotations

__version__ = "0.1.0"

TYPE_CHECKING = False  # as in `typing`, which takes longer to load than all of this
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any

    from waiter_cli.answersets.enumerate import AnswerListing
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.errors import Fault, InputError, LayoutError, MissingError, ReplayError, Where
    from waiter_cli.explanation.explain import Explanation, Foil
    from waiter_cli.files.plan_reader import PlanDocument
    from waiter_cli.model.guest_model import GuestModel
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.plan import Action, Plan
    from waiter_cli.model.problem import Problem
    from waiter_cli.model.scenario import Scenario, TimedEvent
    from waiter_cli.model.state import Goal, Observation, State
    from waiter_cli.planning.answer import PlanAnswer
    from waiter_cli.planning.search_results import (
        NoPlanError,
        SearchOptions,
        SearchResult,
        SearchStage,
        SearchStatus,
    )
    from waiter_cli.rules.validator import Verdict
    from waiter_cli.simulation.outcome import RunOutcome
    from waiter_cli.translators.base import Translator

__all__ = [
    "Action",
    "AnswerListing",
    "Domain",
    "Explanation",
    "Fault",
    "Foil",
    "Goal",
    "InputError",
    "Layout",
    "LayoutError",
    "MissingError",
    "NoPlanError",
    "Observation",
    "Plan",
    "PlanAnswer",
    "PlanDocument",
    "Problem",
    "ReplayError",
    "RunOutcome",
    "Scenario",
    "SearchResult",
    "SearchStatus",
    "State",
    "TimedEvent",
    "Verdict",
    "Where",
    "answer_sets",
    "explain",
    "find_domain",
    "find_translator",
    "plan",
    "pose_problem",
    "read_layout",
    "read_plan",
    "read_scenario",
    "search_plan",
    "simulate",
    "validate",
    "why_not",
]

_HOMES = {
    "Action": "model.plan",
    "AnswerListing": "answersets.enumerate",
    "Domain": "encoding.domains",
    "Explanation": "explanation.explain",
    "Fault": "errors",
    "Foil": "explanation.explain",
    "Goal": "model.state",
    "InputError": "errors",
    "Layout": "model.layout",
    "LayoutError": "errors",
    "MissingError": "errors",
    "NoPlanError": "planning.search_results",
    "Observation": "model.state",
    "Plan": "model.plan",
    "PlanAnswer": "planning.answer",
    "PlanDocument": "files.plan_reader",
    "Problem": "model.problem",
    "ReplayError": "errors",
    "RunOutcome": "simulation.outcome",
    "Scenario": "model.scenario",
    "SearchResult": "planning.search_results",
    "SearchStatus": "planning.search_results",
    "State": "model.state",
    "TimedEvent": "model.scenario",
    "Verdict": "rules.validator",
    "Where": "errors",
}


# ------------------------------------------------------------------ files → values


def read_layout(name: str) -> Layout:
    """Returns the layout of a YAML file, or of a built-in name such as ``report``.

    Raises `LayoutError` with every fault of the file, each with its line and column, and where
    there is no such file or name.

    >>> import waiter_cli
    >>> layout = waiter_cli.read_layout("report")
    >>> len(layout.nodes), [table.capacity for table in layout.tables]
    (8, [2, 4])
    """
    from waiter_cli.files.layout_reader import read_layout_file
    from waiter_cli.model.layout import show_layouts_by

    show_layouts_by(_drawn)
    return read_layout_file(name, "layout", several=True)


def read_scenario(name: str, layout: Layout | None = None) -> tuple[Layout, Scenario]:
    """Returns the scenario of a YAML file or a built-in name such as ``b1``, and its layout.

    A ``layout`` that is given wins over the one that the scenario names.  Raises `LayoutError` with
    every fault of both files.

    >>> import waiter_cli
    >>> layout, scenario = waiter_cli.read_scenario("b1")
    >>> layout.name, scenario.name
    ('report', 'b1')
    """
    from waiter_cli.files.scenario_reader import read_scenario_file
    from waiter_cli.model.layout import show_layouts_by

    show_layouts_by(_drawn)
    return read_scenario_file(name, layout, several=True)


def read_plan(path: str) -> PlanDocument:
    """Returns the plan in a file that ``waiter plan --json`` wrote, and what it remembers.

    Raises `InputError` where the file cannot be read, `ReplayError` with every fault in it.
    """
    from waiter_cli.files.plan_reader import read_plan_file

    return read_plan_file(path)


def pose_problem(
    layout: Layout,
    scenario: Scenario | None = None,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
    seen: Sequence[str] = (),
) -> Problem:
    """Returns the problem of a restaurant in a situation.

    ``enter`` are the sizes of parties that come in, ``bills`` the tables that wave for their bill,
    ``goals`` goals in YAML such as ``at: n6``, ``seen`` observations in YAML; all come on top of what the scenario has.  Without
    any goals everybody is to be served.  Raises `LayoutError` with every fault.  Observations that
    contradict what is known are no fault: they stand in ``contradictions``.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), enter=[2])
    >>> [goal.as_dict() for goal in problem.goals]
    [{'seated': ['c1', 'c2']}]
    """
    from waiter_cli.problems.pose import pose_problem as run

    return run(layout, scenario, enter, bills, goals, seen)


def find_domain(name: str | None = None) -> Domain:
    """Returns the rules to plan by: ``restaurant`` (None), ``report``, or a SPARC template at a path.

    Raises `InputError` where there is none, or where its program cannot say what a plan is.
    """
    from waiter_cli.encoding.domains import find_domain as find
    from waiter_cli.encoding.domains import require_plans
    from waiter_cli.file_access.locate import BuiltIn

    return require_plans(find(BuiltIn("restaurant") if name is None else name))


def find_translator(name: str = "native", jar: str | None = None) -> Translator:
    """Returns what translates SPARC: our own code (``native``), or upstream's ``jar`` at that path.

    Raises `MissingError` where Java or the jar is missing, `InputError` for any other name.
    """
    if name == "native":
        from waiter_cli.translators.native import NativeTranslator

        return NativeTranslator()
    if name != "jar":
        raise _no_such("translator", name, ("native", "jar"))
    from waiter_cli.translators.jar import jar_translator

    return jar_translator(jar)


# ------------------------------------------------------------------ problem → answer


def search_plan(
    layout: str | None = None,
    scenario: str | None = None,
    *,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
) -> PlanAnswer:
    """Returns the answer to a problem in files: reads, poses and plans.

    ``layout`` and ``scenario`` are paths or built-in names; one of them may be left out, the layout
    where the scenario names one.  The rest is as in `pose_problem` and `plan`, and so is what is raised.

    >>> import waiter_cli
    >>> waiter_cli.search_plan(scenario="b1").plan.horizon
    7
    """
    from waiter_cli.problems.from_options import read_problem

    problem, _ = read_problem(layout, scenario, enter, bills, goals)
    return plan(
        problem,
        domain=domain,
        translator=translator,
        strategy=strategy,
        max_steps=max_steps,
        time_limit=time_limit,
    )


def plan(
    problem: Problem,
    *,
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
    listener: Callable[[SearchStage], None] | None = None,
) -> PlanAnswer:
    """Returns a minimal plan with its proof, or why there is none.

    ``strategy`` is ``binary``, ``linear``, ``gallop`` or ``minimize``; ``time_limit`` is in seconds,
    ``max_steps`` the most steps that a plan may have (None: no limit); ``listener`` is told of each
    stage of the search as it ends.  ``answer.plan`` has one action a step, ``answer.states`` one more
    state than steps, ``answer.result.status`` says how it ended, and ``answer.document()`` is what
    ``waiter plan --json`` prints.  The plan was executed by rules that share nothing with the search.

    Raises `InputError` for a wrong domain or option, `MissingError` where the jar is missing.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), goals=["at: n4"])
    >>> answer = waiter_cli.plan(problem, time_limit=20)
    >>> [action.text for action in answer.plan.actions]
    ['go_to(agent,n2)', 'go_to(agent,n3)', 'go_to(agent,n4)']
    """
    from waiter_cli.planning.planner import explained, find_plan

    rules, backend = _rules(domain), _backend(translator)
    options = _options(strategy, max_steps, time_limit, listener)
    return explained(find_plan(problem, backend, rules, options))


def explain(
    problem: Problem,
    *,
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
    listener: Callable[[SearchStage], None] | None = None,
) -> Explanation:
    """Returns why there is no plan and what would help, or of a plan why it is not shorter.

    ``time_limit`` (seconds) is for all searches together.  Takes and raises what `plan` does.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(*waiter_cli.read_scenario("blocked_aisle"))
    >>> found = waiter_cli.explain(problem)
    >>> found.result.status.value, [helped.horizon for helped in found.helped]
    ('no_plan', [7, 0])
    """
    from waiter_cli.explanation.explain import explain as run

    rules, backend = _rules(domain), _backend(translator)
    return run(problem, backend, rules, _options(strategy, max_steps, time_limit, listener))


def why_not(
    problem: Problem,
    action: str | Action,
    *,
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
    listener: Callable[[SearchStage], None] | None = None,
) -> Foil:
    """Returns what doing ``action`` at some step would cost, in steps, or why it never can be.

    Takes and raises what `plan` does, and `InputError` for text that is no action here.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(*waiter_cli.read_scenario("b1"))
    >>> waiter_cli.why_not(problem, "go_to(agent,n0)").price
    2
    """
    from waiter_cli.explanation.explain import explain_foil

    rules, backend = _rules(domain), _backend(translator)
    if isinstance(action, str):
        from waiter_cli.explanation.foil_reader import read_foil

        action = read_foil(action, problem, rules)
    options = _options(strategy, max_steps, time_limit, listener)
    return explain_foil(problem, action, backend, rules, options)


def answer_sets(
    problem: Problem,
    *,
    horizon: int | None = None,
    models: int = 1,
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
) -> AnswerListing:
    """Returns the answer sets of the problem's program, an iterable that finds them one by one.

    The program has the steps 0..``horizon``; None takes the least at which there is a plan.  At most
    ``models`` are found (0: all).  ``time_limit`` (seconds) is for the search and the answer sets
    together.  For a program in a file use `sparc.solve`.

    Raises what `plan` raises, `NoPlanError` where a horizon was to be found and there is none, and
    `InputError` for observations that contradict what is known.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), goals=["at: n4"])
    >>> (answer_set,) = waiter_cli.answer_sets(problem)
    >>> sorted(str(each) for each in answer_set.literals if each.name == "occurs")
    ['occurs(go_to(agent,n2),0)', 'occurs(go_to(agent,n3),1)', 'occurs(go_to(agent,n4),2)']
    """
    import time

    from waiter_cli.answersets.enumerate import AnswerListing, prepare
    from waiter_cli.answersets.timeline import Filter
    from waiter_cli.domain_execution.domain_rules import believed
    from waiter_cli.encoding.domains import domain_for
    from waiter_cli.encoding.template import fill_template
    from waiter_cli.planning.strategies import find_minimal_plan

    _require_count("horizon", horizon or 0)
    _require_count("models", models)
    rules, backend = _rules(domain), _backend(translator)
    options = _options(strategy, max_steps, time_limit, None)
    deadline = None if time_limit is None else time.monotonic() + time_limit
    _require_possible(problem)
    if horizon is None:
        horizon = find_minimal_plan(problem, backend, rules, options).least_horizon()
    source = fill_template(domain_for(problem, rules).template, believed(problem, rules), horizon)
    left = None if deadline is None else max(0.01, deadline - time.monotonic())
    program, timeline = prepare(source, backend, time_limit=left)
    return AnswerListing(program, timeline, Filter(), limit=models, deadline=deadline)


# ------------------------------------------------------------------ plan → what becomes of it


def validate(
    plan: Plan | PlanAnswer | PlanDocument | str, problem: Problem | None = None
) -> Verdict:
    """Returns whether every step of a plan is possible and its goals are reached, by plain rules.

    ``plan`` may be a plan, the answer of `plan`, or a plan file (its path, or what `read_plan` returns).
    Without a ``problem`` an answer is held to its own, and a file to the situation and goals in it.

    Raises `InputError` for a bare plan without a problem and for what `read_plan` refuses.

    >>> import waiter_cli
    >>> answer = waiter_cli.search_plan(scenario="b1")
    >>> verdict = waiter_cli.validate(answer)
    >>> verdict.valid, len(verdict.states), verdict.makespan
    (True, 8, 7)
    """
    from waiter_cli.model.plan import Plan
    from waiter_cli.rules.validator import run

    if isinstance(plan, str):
        plan = read_plan(plan)
    if not isinstance(plan, Plan):
        from waiter_cli.planning.answer import PlanAnswer

        if not isinstance(plan, PlanAnswer):
            from waiter_cli.problems.plan_file import judge, problem_of

            return judge(
                plan, problem_of(plan) if problem is None else problem, own=problem is None
            )
        from waiter_cli.domain_execution.domain_rules import rules_for

        problem = plan.problem if problem is None else problem
        rules = rules_for(problem, plan.domain)
        if plan.plan is None:
            raise _refused("there is no plan to validate", "look at answer.result.status first")
        return run(problem, plan.plan, rules)
    if problem is None:
        raise _refused("a plan by itself has no situation and no goals", "give its problem, too")
    return run(problem, plan)


def simulate(
    problem: Problem,
    plan: Plan | None = None,
    *,
    record: str | Sequence[str] | None = None,
    seed: int = 0,
    events: Sequence[TimedEvent] = (),
    guests: GuestModel | None = None,
    inject: Sequence[str] = (),
    speed: float = 0.8,
    backend: str = "auto",
    drive: str = "kinematic",
    on_failure: str = "replan",
    domain: Domain | str | None = None,
    translator: Translator | str = "native",
    strategy: str = "binary",
    max_steps: int | None = None,
    time_limit: float | None = None,
    listener: Callable[[str], None] | None = None,
) -> RunOutcome:
    """Returns what became of a run in the simulated restaurant: plan, act, observe, plan again.

    ``plan`` is played where one is given, for as long as nothing comes between.  ``record`` names
    files to record to (``.mp4``, ``.gif``, ``.png``, ``.html``) or folders.  ``events`` happen at their
    times (`Scenario.events`), ``guests`` come by chance (`Scenario.guests`), ``inject`` are further ones such as ``enter:2@10``; ``seed`` is that of
    what happens by chance.  ``speed`` is in metres a second, ``time_limit`` in seconds for each search.
    ``backend`` is ``auto``, ``pybullet`` or ``geometric``, ``drive`` ``kinematic`` or ``physics``,
    ``on_failure`` ``stop``, ``wait`` or ``replan``.  ``listener`` is told each event, a line of JSON.
    Equal arguments give equal events.

    Raises `InputError` for observations that contradict what is known and for options that cannot
    be, `LayoutError` where an edge runs through furniture, `MissingError` for what is not installed.

    >>> import waiter_cli
    >>> problem = waiter_cli.pose_problem(waiter_cli.read_layout("report"), enter=[1])
    >>> outcome = waiter_cli.simulate(problem, backend="geometric")
    >>> outcome.status, outcome.steps, outcome.failures
    ('done', 7, ())
    """
    from waiter_cli.evenings.injections import read_injections
    from waiter_cli.execution.online_planner import OnlinePlanner
    from waiter_cli.pictures.filmed_run import Showing, build_checked_room, play_run
    from waiter_cli.problems.guests import require_guests
    from waiter_cli.simulation.outcome import Rules
    from waiter_cli.simulation.run_request import RunRequest

    recordings = (record,) if isinstance(record, str) else tuple(record or ())
    _require_count("seed", seed)
    _require_run(speed, backend, drive, on_failure)
    _require_possible(problem)
    require_guests(problem, events)
    if recordings:
        from waiter_cli.pictures.recorders import require_different

        require_different(recordings)
    room = build_checked_room(problem)
    options = _options(strategy, max_steps, time_limit, None)
    planner = OnlinePlanner(
        _backend(translator),
        _rules(domain),
        options.time_limit,
        options.strategy,
        options.max_steps,
        by_bounds=guests is not None,
    )
    request = RunRequest(problem, tuple(events), plan, guests=guests)
    rules = Rules(speed, seed, drive, on_failure, max_steps)
    injections = read_injections(inject, problem, events)
    showing = Showing(recordings, listener=listener)
    outcome, _ = play_run(request, room, planner, backend, rules, injections, showing)
    return outcome


# ------------------------------------------------------------------ what the calls share


def _drawn(layout: Layout) -> str | None:
    """Returns the SVG of a layout for a notebook; None where its places cannot be drawn."""
    from waiter_cli.drawing.picture import draw_svg
    from waiter_cli.drawing.subject import make_subject
    from waiter_cli.errors import InputError

    try:
        return draw_svg(make_subject(layout))
    except InputError:
        return None


def _rules(domain: Domain | str | None) -> Domain:
    return find_domain(domain) if domain is None or isinstance(domain, str) else domain


def _backend(translator: Translator | str) -> Translator:
    return find_translator(translator) if isinstance(translator, str) else translator


def _options(
    strategy: str,
    max_steps: int | None,
    time_limit: float | None,
    listener: Callable[[SearchStage], None] | None,
) -> SearchOptions:
    """Returns the options of a search; raises `InputError` for values that cannot be."""
    from waiter_cli.planning.search_results import SearchOptions
    from waiter_cli.planning.strategies import STRATEGIES

    if strategy not in STRATEGIES:
        raise _no_such("strategy", strategy, STRATEGIES)
    _require_count("max_steps", max_steps or 0)
    if time_limit is not None and not time_limit >= 0:
        raise _refused(f"time_limit is {time_limit}", "give seconds, or None for no limit")
    return SearchOptions(strategy, max_steps, time_limit, listener=listener)


def _require_count(what: str, number: int) -> None:
    if number < 0:
        raise _refused(f"{what} is {number}", "give 0 or more")


def _require_run(speed: float, backend: str, drive: str, on_failure: str) -> None:
    """Raises `InputError` for options of a run that cannot be."""
    if not 0.05 <= speed <= 5.0:
        raise _refused(f"speed is {speed}", "give 0.05 to 5 metres a second")
    for what, name, names in (
        ("backend", backend, ("auto", "pybullet", "geometric")),
        ("drive", drive, ("kinematic", "physics")),
        ("on_failure", on_failure, ("stop", "wait", "replan")),
    ):
        if name not in names:
            raise _no_such(what, name, names)


def _require_possible(problem: Problem) -> None:
    """Raises `InputError` where what was observed contradicts what is known."""
    from waiter_cli.errors import Fault, InputError

    if problem.contradictions:
        raise InputError([Fault(reason.where, reason.message) for reason in problem.contradictions])


def _refused(message: str, hint: str) -> InputError:
    from waiter_cli.errors import InputError

    return InputError(message, hint)


def _no_such(what: str, name: str, names: Sequence[str]) -> InputError:
    return _refused(f"no such {what}: {name}", f"give {', '.join(names[:-1])} or {names[-1]}")


def __getattr__(name: str) -> Any:
    """The classes of the front door, loaded when asked for."""
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{home}"), name)
