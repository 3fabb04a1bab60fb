"""Puts a problem together. Entry points `pose_problem`, `problem_from_plan_document`.

Scenario and command line become one list of observations and one of goals; the observations are
believed; parties in goals become whole parties; and where no goals are given, serving everybody
is spelled out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar

from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.files.goal_reader import (
    read_before,
    read_goal,
    read_goals,
    read_observation,
    unknown_customer,
)
from waiter_cli.files.names import Names, fresh_customers
from waiter_cli.files.own_terms import read_facts
from waiter_cli.files.state_reader import read_state, state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import Scenario
from waiter_cli.model.state import Goal, Observation, Party, State
from waiter_cli.problems.everybody import serve_everybody
from waiter_cli.rules.observations import observe, settle
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Document, Mapping, Node, Scalar, compose, one_line

__all__ = ["pose_problem", "problem_from_plan_document"]

MAX_PARTY = 1000
Value = TypeVar("Value")


def pose_problem(
    layout: Layout,
    scenario: Scenario | None = None,
    enter: Sequence[int | str] = (),
    bills: Sequence[str] = (),
    goals: Sequence[str] = (),
    seen: Sequence[str] = (),
) -> Problem:
    """Returns the problem of a scenario and what the command line adds to it.

    ``enter`` are sizes of parties (their customers get names), ``bills`` tables, ``goals`` goals in
    YAML, ``seen`` observations in YAML; they are observed and wanted besides what the scenario has.  Without any goals everybody
    is to be served.  Raises `LayoutError` with every fault; an observation that cannot be is no
    fault but one of the problem's ``contradictions``.
    """
    faults: list[Fault] = []
    names = Names(layout)
    if scenario is None:
        believed, base = state_of_layout(layout)
        scenario = Scenario("", believed, state_where=tuple(base.items()))
    _adopt(names, scenario)
    observations = [
        *scenario.observe,
        *_entering(enter, names, faults),
        *_bills(bills, names, faults),
        *_seen(seen, names, faults),
    ]
    added = _goals(goals, names, faults)
    all_goals = (*(scenario.goals or ()), *added)
    everybody = scenario.goals is None and not goals
    state, contradictions = observe(scenario.state, observations, layout)
    excused = {name for seen in observations if contradictions for name in seen.arguments}
    whole = _WholeParties(state, names.tables, excused, faults)
    posed = tuple(dict.fromkeys(whole.goal(goal) for goal in all_goals))
    before = tuple((whole.goal(first), whole.goal(then)) for first, then in scenario.before)
    if faults:
        raise LayoutError(faults)
    places = _places(scenario, observations)
    if everybody:
        posed = serve_everybody(state, layout, scenario.instant_kitchen, places)
    return Problem(
        layout=layout,
        before_observations=scenario.state,
        observations=tuple(observations),
        state=state,
        goals=posed,
        before=before,
        prefer=scenario.prefer,
        instant_kitchen=scenario.instant_kitchen,
        everybody=everybody,
        contradictions=contradictions,
        scenario_file=scenario.file,
        facts=scenario.facts,
        state_where=tuple(places.items()),
    )


def problem_from_plan_document(text: str, name: str, layout: Layout) -> Problem:
    """Returns the problem that a plan file was made for: ``initial_state``, ``goals`` and ``before``.

    Raises `LayoutError` with every fault, each with its line and column in the JSON text.
    """
    document = compose(text, name)
    reader = NodeReader(document)
    top = Where(name, 1, 1)
    root = document.root if document.root is not None else Mapping((), top)
    keys = reader.mapping(root, "a plan file") or {}
    names = Names(layout)
    hint = "a plan file is what waiter plan --json prints"
    for key in ("initial_state", "goals"):
        if key not in keys:
            reader.fault(root.where, f"the plan file has no {key}", hint)
    state, places = read_state(reader, keys.get("initial_state"), names)
    goals = read_goals(reader, keys["goals"], names) if "goals" in keys else ()
    before = read_before(reader, keys["before"], names) if "before" in keys else ()
    instant = False
    if "instant_kitchen" in keys:
        instant = reader.boolean(keys["instant_kitchen"], "instant_kitchen") or False
    facts = read_facts(reader, keys["facts"]) if "facts" in keys else ()
    reader.finish()
    faults: list[Fault] = []
    state = settle(state, layout)
    whole = _WholeParties(state, names.tables, set(), faults)
    posed = tuple(whole.goal(goal) for goal in goals)
    pairs = tuple((whole.goal(first), whole.goal(then)) for first, then in before)
    if faults:
        raise LayoutError([replace(f, excerpt=document.excerpt(f.where)) for f in faults])
    return Problem(
        layout=layout,
        before_observations=state,
        observations=(),
        state=state,
        goals=posed,
        before=pairs,
        instant_kitchen=instant,
        scenario_file=name,
        facts=facts,
        state_where=tuple(places.items()),
    )


# -- the command line -----------------------------------------------------------------------


def _adopt(names: Names, scenario: Scenario) -> None:
    """Notes the names that a scenario uses for its people."""
    names.adopt("waiter", (name for name, _ in scenario.state.waiters))
    for party in scenario.state.parties():
        names.adopt("customer", party)
    later = (seen for event in scenario.events for seen in event.observations)
    for seen in (*scenario.observe, *later):
        if seen.kind in ("enter", "leave"):
            names.adopt("customer", seen.arguments)


def _entering(
    sizes: Sequence[int | str], names: Names, faults: list[Fault]
) -> Iterator[Observation]:
    where = Where("--enter")
    fresh = fresh_customers(names.taken())
    for given in sizes:
        text = str(given).strip()
        number = int(text) if text.isascii() and text.isdigit() and len(text) < 9 else 0
        if not 1 <= number <= MAX_PARTY:
            message = (
                f"a party has from 1 to {MAX_PARTY} guests, found {one_line(text, 40) or 'nothing'}"
            )
            faults.append(Fault(where, message, "for example: --enter 4"))
            continue
        party = tuple(next(fresh) for _ in range(number))
        names.adopt("customer", party)
        yield Observation("enter", party, where)


def _bills(tables: Sequence[str], names: Names, faults: list[Fault]) -> Iterator[Observation]:
    where = Where("--bill")
    for text in tables:
        reader = NodeReader(Document(where.name, (text,), None, ()))
        table = reader.known(Scalar(text, True, where), "--bill", "table", names.tables)
        faults += reader.faults
        if table is not None:
            yield Observation("bill", (table,), where)


def _goals(texts: Sequence[str], names: Names, faults: list[Fault]) -> list[Goal]:
    empty = ("an empty goal", "for example: --goal 'seated: [c1]'")
    return list(_from_yaml("--goal", texts, faults, empty, partial(read_goal, names=names)))


def _seen(texts: Sequence[str], names: Names, faults: list[Fault]) -> list[Observation]:
    empty = ("an observation of nothing", "for example: --observe 'order: table1'")
    return list(
        _from_yaml("--observe", texts, faults, empty, partial(read_observation, names=names))
    )


def _from_yaml(
    option: str,
    texts: Sequence[str],
    faults: list[Fault],
    empty: tuple[str, str],
    read: Callable[[NodeReader, Node], list[Value]],
) -> Iterator[Value]:
    """Yields what ``read`` makes of the YAML texts of an option; faults are noted."""
    where = Where(option)
    for text in texts:
        try:
            document = compose(text, where.name, fixed=where)
        except LayoutError as error:
            faults += error.faults
            continue
        reader = NodeReader(document)
        if document.root is None:
            reader.fault(where, *empty)
        else:
            yield from read(reader, document.root)
        faults += reader.faults


# -- goals ----------------------------------------------------------------------------------


class _WholeParties:
    """Turns the customers that goals name into the parties they belong to."""

    def __init__(
        self, state: State, tables: frozenset[str], excused: set[str], faults: list[Fault]
    ) -> None:
        self.parties = {name: party for party in state.parties() for name in party}
        self.tables = tables
        self.excused = excused
        self.faults = faults

    def goal(self, goal: Goal) -> Goal:
        """Returns the goal with the whole party, first-listed member first; faults are noted."""
        if not goal.party:
            return goal
        unknown = [name for name in goal.party if name not in self.parties]
        if unknown:
            if not self.excused.issuperset(unknown):
                self._unknown(goal, unknown[0])
            return goal
        tables: dict[Party, str] = {}
        for name in goal.party:
            tables.setdefault(self.parties[name], name)
        if len(tables) > 1:
            one, two = list(tables.values())[:2]
            message = f"{one} and {two} belong to two parties"
            self.faults.append(Fault(goal.where, message, "give a goal for each party"))
        return replace(goal, party=next(iter(tables)))

    def _unknown(self, goal: Goal, name: str) -> None:
        message, hint = unknown_customer(goal, name, self.parties, self.tables)
        self.faults.append(Fault(goal.where, message, hint))


def _places(scenario: Scenario, observations: Sequence[Observation]) -> dict[str, Where]:
    """Returns the places in files that the state comes from, observations included."""
    places = dict(scenario.state_where)
    keys = {"bill": "wants_bill", "order": "ready_to_order", "ready": "ready", "empty": "empty"}
    for observation in observations:
        if observation.where is None:
            continue
        first = observation.arguments[0]
        if observation.kind in keys:
            places[".".join((keys[observation.kind], *observation.arguments))] = observation.where
            places.setdefault(keys[observation.kind], observation.where)
        elif observation.kind == "enter":
            places[f"party.{first}"] = observation.where
            places.setdefault("waiting", observation.where)
        elif observation.kind == "at":
            places["agent" if first == "agent" else f"waiters.{first}"] = observation.where
    return places
