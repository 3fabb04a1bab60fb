"""Starts a live loop: files and options → an `Executive` that is ready. Entry points `begin` and `open_journal`.

A journal is complete in itself: its first line holds the text of the layout, and what was believed
and wanted at the start; its records hold what came after.  So the same command goes on where it
ended, and a replay needs nothing but the journal.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from waiter_cli.domain_execution.domain_rules import begun, require_words
from waiter_cli.errors import Fault, InputError, LayoutError, Where
from waiter_cli.execution.decision import Diagnoser, Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.execution.joint_requirements import require_joint_run
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.documents import goals_document, order_document
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.state_reader import state_of_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.scenario import Scenario
from waiter_cli.model.state import Fact, Goal, State
from waiter_cli.problems.pose import pose_problem
from waiter_cli.serve.journal import Journal, Recorded
from waiter_cli.serve.memory import memorize, read_decision, restore, snapshot
from waiter_cli.serve.protocol import BadLine, answer, read_event
from waiter_cli.serve.session import apply_event
from waiter_cli.yaml_reading.yaml_tree import one_line

__all__ = [
    "Damaged",
    "begin",
    "executive_of",
    "layout_of",
    "open_journal",
    "replay_record",
    "resume",
    "revive",
]


UNREADABLE = (
    KeyError,
    IndexError,
    TypeError,
    ValueError,
    AttributeError,
    OverflowError,
    RecursionError,
    BadLine,
    Refused,
    InputError,
)
"""What may come of reading values that are not what they should be."""


class Damaged(Exception):
    """A journal whose records do not fit each other."""


def executive_of(
    layout: Layout,
    thinker: OnlinePlanner,
    explain: Diagnoser | None,
    *,
    state: State,
    goals: tuple[Goal, ...] = (),
    before: tuple[tuple[Goal, Goal], ...] = (),
    prefer: tuple[str, ...] = (),
    instant_kitchen: bool = False,
    facts: tuple[Fact, ...] = (),
) -> Executive:
    """Returns an executive that has not decided anything yet."""
    require_joint_run(layout, thinker.domain)
    kind = FleetExecutive if layout.agents else Executive
    return kind(
        layout,
        thinker.plan,
        state=state,
        goals=goals,
        before=before,
        prefer=prefer,
        instant_kitchen=instant_kitchen,
        impossible=thinker.impossible,
        least=thinker.least,
        explain=None if layout.agents else explain,
        rules=thinker.rules,
        plan=False,
        facts=facts,
    )


def begin(
    layout: Layout, scenario: Scenario | None, thinker: OnlinePlanner, explain: Diagnoser | None
) -> Executive:
    """Returns an executive in the situation of a scenario, not yet decided.

    Raises `LayoutError` where the goals name nobody who is inside, and `Refused` where what the
    scenario observes contradicts its state and nothing explains it.
    """
    if scenario is None:
        return executive_of(layout, thinker, explain, state=state_of_layout(layout)[0])
    goals, before = _whole(layout, scenario)
    posed = pose_problem(layout, replace(scenario, goals=(), before=()))
    if thinker.domain.built_in:
        _require_house_words(scenario, (*goals, *(goal for pair in before for goal in pair)))
    else:
        now = tuple(goal for goal in goals if goal.kind != "serve")
        require_words(replace(posed, goals=now, before=before), thinker.domain)
    still = replace(posed, observations=(), state=scenario.state)
    situation = begun(still, thinker.rules)
    executive = executive_of(
        layout,
        thinker,
        explain,
        state=situation.state,
        goals=goals,
        before=before,
        prefer=scenario.prefer,
        instant_kitchen=scenario.instant_kitchen,
        facts=situation.facts,
    )
    if scenario.observe:
        executive.observe(scenario.observe, plan=False)
    return executive


def _require_house_words(scenario: Scenario, goals: Iterable[Goal]) -> None:
    """Raises `InputError` where a scenario speaks in a domain's own words, and the rules are the house's."""
    first = next((goal for goal in goals if goal.fluent is not None), None)
    seen = next((each for each in scenario.observe if each.kind == "obs"), None)
    if first is None and seen is None and not (scenario.state.fluents or scenario.facts):
        return
    told = [each.where for each in (*scenario.facts[:1], seen, first) if each is not None]
    where = next((place for place in reversed(told) if place is not None), Where(scenario.name))
    said = "the rules of the restaurant know no words of a domain's own"
    raise InputError([Fault(where, said, "waiter serve and waiter simulate take --domain")])


def _whole(
    layout: Layout, scenario: Scenario
) -> tuple[tuple[Goal, ...], tuple[tuple[Goal, Goal], ...]]:
    """Returns the scenario's goals and their order with whole parties.

    Guests to be served may come later.
    """
    inside = {name for party in scenario.state.parties() for name in party}
    inside |= {
        name
        for observation in scenario.observe
        if observation.kind == "enter"
        for name in observation.arguments
    }

    def later(goal: Goal) -> bool:
        return goal.kind == "serve" and goal.party[0] not in inside

    now = replace(
        scenario,
        goals=tuple(goal for goal in scenario.goals or () if not later(goal)),
        before=tuple(pair for pair in scenario.before if not any(map(later, pair))),
    )
    pose_problem(layout, now)  # with all faults at once

    def whole(goal: Goal) -> Goal:
        if later(goal):
            return goal
        return pose_problem(layout, replace(now, goals=(goal,), before=())).goals[0]

    return (
        tuple(dict.fromkeys(map(whole, scenario.goals or ()))),
        tuple(
            pair if any(map(later, pair)) else (whole(pair[0]), whole(pair[1]))
            for pair in scenario.before
        ),
    )


# -- journals -------------------------------------------------------------------------------


def header_of(executive: Executive, layout_text: str, origin: str) -> dict[str, Any]:
    """Returns the first line of a journal that begins (again) with what an executive knows."""
    layout = executive.layout
    return {
        "layout": {"name": layout.name, "file": layout.file, "text": layout_text},
        "origin": origin,
        "start": snapshot(executive),
    }


def origin_of(executive: Executive, layout_text: str) -> str:
    """Returns a digest of the layout and of the situation that a command began with."""
    agenda = executive.agenda
    goals = goals_document(agenda.goals)
    before = order_document(agenda.before)
    told = (layout_text, memorize(executive.state), goals, before)
    kitchen = (agenda.instant_kitchen, executive.prefer)
    return hashlib.sha256(repr((told, kitchen)).encode()).hexdigest()


def open_journal(
    path: str,
    executive: Executive,
    layout_text: str,
    warn: Callable[[str], None],
    compact: bool = False,
) -> tuple[Journal, bool]:
    """Returns the journal for a run that begins as ``executive`` did, and whether it
    goes on from there.

    A journal that holds something gives the executive its memory; with ``compact`` its past is then
    replaced by what is known now.  Raises `InputError` where it was
    begun with another layout or scenario, and as `Journal.open` does; `JournalFull`.
    """
    journal, found = Journal.open(path, warn)
    try:
        origin = origin_of(executive, layout_text)
        if found is None:
            executive.decide()
            journal.begin(header_of(executive, layout_text, origin))
            return journal, False
        if found.header.get("origin") != origin:
            message = "the journal was begun with another layout or scenario"
            hint = "give those, or name another file"
            raise InputError([Fault(Where(path), message, hint)])
        resume(executive, found, path)
        undecided = executive.planned is None
        if undecided:  # the last search was superseded and its successor never came
            executive.decide()
        if undecided or journal.due:  # so an old journal without snapshots gets one
            record = {"resume": answer(executive.decision), "state": memorize(executive.state)}
            journal.append(record, snapshot(executive) if journal.due else None)
        if compact:
            journal.compact(header_of(executive, layout_text, origin))
    except BaseException:
        journal.close()
        raise
    return journal, True


def layout_of(header: dict[str, Any], path: str) -> Layout:
    """Returns the restaurant of a journal."""
    try:
        layout = header["layout"]
        return read_layout(str(layout["text"]), str(layout["file"]) or path)
    except (KeyError, TypeError):
        raise _damaged(path, 1, "there is no layout in it") from None
    except LayoutError as error:
        fault = error.faults[0].message
        raise _damaged(path, 1, f"its layout cannot be read ({fault})") from None


def resume(executive: Executive, found: Recorded, path: str) -> None:
    """Lives through a journal again, without planning; raises `InputError` where it is damaged.

    What came before the last snapshot is not lived through.
    """
    if found.base is None:
        revive(executive, found.header, path)
    else:
        line = found.count - len(found.records)
        revive(executive, found.base, path, line)
        if memorize(executive.state) != found.base.get("state"):
            raise _damaged(path, line, "the state in its snapshot is another one")
    for number, record in enumerate(found.records, found.count - len(found.records) + 1):
        try:
            replay_record(executive, record)
        except Damaged as error:
            raise _damaged(path, number, str(error)) from None


def revive(executive: Executive, told: dict[str, Any], path: str, line: int = 0) -> None:
    """Restores the memory of a journal's beginning, or of the snapshot in its given line.

    Raises `InputError` where there is none that fits the restaurant.
    """
    key, what = ("snapshot", "its snapshot") if line else ("start", "its beginning")
    try:
        restore(told[key], executive)
    except UNREADABLE as error:
        raise _damaged(path, line or 1, f"{what} cannot be read ({_told(error)})") from None


def replay_record(executive: Executive, record: dict[str, Any]) -> None:
    """Believes one record, and takes over its decision; raises `Damaged`.

    The state that comes of it is compared with the one that the record holds.
    """
    try:
        answered = record.get("resume")
        if answered is None:
            answered = record["answer"]
            apply_event(executive, read_event(record["event"], executive.layout, executive.state))
        if memorize(executive.state) != record["state"]:
            raise Damaged("the state after it is another one")
        if "superseded_by" not in answered:
            executive.adopt(read_decision(answered, executive.layout, executive.state))
    except (BadLine, Refused) as error:
        raise Damaged(f"what it says cannot be: {error}") from None
    except UNREADABLE as error:
        raise Damaged(f"it cannot be read ({_told(error)})") from None


def _told(error: BaseException) -> str:
    return f"no {error}" if isinstance(error, KeyError) else one_line(str(error), 200)


def _damaged(path: str, line: int, message: str) -> InputError:
    hint = "restore the file from a copy, or name another one"
    return InputError([Fault(Where(path, line, 1), f"the journal is damaged: {message}", hint)])
