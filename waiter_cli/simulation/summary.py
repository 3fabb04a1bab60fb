"""Summarizes a run in words and JSON. Entry points `document`, `lines`, `unserved`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.console.styling import styled
from waiter_cli.files.documents import goals_document, state_document
from waiter_cli.model.state import Party, Robot, State
from waiter_cli.model.wording import counted, people

if TYPE_CHECKING:
    from waiter_cli.simulation.outcome import CheckFailure, RunOutcome
    from waiter_cli.simulation.run_request import RunRequest

__all__ = ["Call", "document", "lines", "unserved"]

MOST_CALLS = 6
"""So many of those who are unserved are told of one by one."""
_WAITS = (
    ("seat", "for a table"), ("order", "to order"), ("plate", "for the plate"), ("bill", "for the bill")
)  # fmt: skip
_WORD = {
    "done": ("done", "bold green"),
    "failed": ("failed", "bold red"),
    "gave_up": ("gave up", "bold yellow"),
}


def document(cue: RunRequest, outcome: RunOutcome, shown: Sequence[str]) -> dict[str, Any]:
    """Returns the document of ``simulate --json``; ``shown`` are the recordings that were made.

    ``recordings`` lists them all, ``recording`` is the first.
    """
    problem = cue.problem
    values: dict[str, Any] = {
        "status": outcome.status,
        "layout": problem.layout.name,
        "scenario": cue.scenario,
        "backend": outcome.backend,
        "seconds": outcome.seconds,
        "steps": outcome.steps,
        "actions": outcome.actions,
        "failed_actions": outcome.failed_actions,
        "replans": outcome.replans,
        "events": outcome.events,
        "min_clearance": outcome.min_clearance,
        "nearest": outcome.nearest,
        "failed_checks": [
            {"check": f.check, "reason": f.reason, "time": f.time, "step": f.step}
            for f in outcome.failures
        ],
        "goals": goals_document(problem.goals),
        "unserved": [call.as_dict() for call in unserved(outcome.final_state)],
        "final_state": state_document(outcome.final_state, problem.layout),
    }
    if outcome.robots is not None:
        values["robots"] = outcome.robots
    if outcome.figures is not None:
        values["figures"] = outcome.figures
    if outcome.why:
        values["why"] = outcome.why
    if outcome.limit:
        values["limit"] = outcome.limit
    if outcome.pending:
        values["pending"] = list(outcome.pending)
    if shown:
        values["recording"] = shown[0]
        values["recordings"] = list(shown)
    return values


def lines(cue: RunRequest, outcome: RunOutcome, shown: Sequence[str], stream: Any) -> list[str]:
    """Returns the summary for a person."""
    word, style = _WORD[outcome.status]
    name = cue.scenario or cue.problem.layout.name
    sentences = [
        f"{styled(word, style, stream)}: {name}, {counted(outcome.actions, 'action')} in "
        f"{outcome.seconds:.1f} simulated seconds"
    ]
    if outcome.why and not any(f.reason in outcome.why for f in outcome.failures):
        sentences.append(f"  {outcome.why.removeprefix('gave up: ')}")
    sentences += _failures(outcome)
    facts = []
    if outcome.failed_actions:
        facts.append(f"{counted(outcome.failed_actions, 'action')} failed")
    if outcome.replans:
        facts.append(f"planned anew {_times(outcome.replans)}")
    if outcome.min_clearance is not None:
        who = "a robot" if outcome.robots else "the robot"
        facts.append(_nearness(who, outcome.min_clearance, outcome.nearest))
    facts.append(
        f"{outcome.events} events, all checks passed"
        if not outcome.failures
        else f"{outcome.events} events"
    )
    sentences.append("  " + "; ".join(facts))
    sentences += _robots(outcome)
    calls = [call.text for call in unserved(outcome.final_state)]
    if calls:
        more = f"; and {len(calls) - MOST_CALLS} more" if len(calls) > MOST_CALLS else ""
        sentences.append(f"  unserved: {'; '.join(calls[:MOST_CALLS])}{more}")
    if outcome.figures is not None:
        sentences += _evening(outcome.figures)
    sentences += [f"  recorded: {each}" for each in shown]
    return sentences


def _failures(outcome: RunOutcome) -> list[str]:
    """Returns the checks that failed, in time.

    One that failed again for the same reason is told once.
    """
    same: dict[tuple[str, str], list[CheckFailure]] = {}
    for failure in outcome.failures:
        same.setdefault((failure.check, failure.reason), []).append(failure)
    sentences = []
    for (check, reason), failures in same.items():
        first, again = failures[0], len(failures) - 1
        more = f" (and {counted(again, 'more time')})" if again else ""
        sentences.append(
            f"  check failed: {check} at {first.time:.1f} s, step {first.step}{more}: {reason}"
        )
    return sentences


def _robots(outcome: RunOutcome) -> list[str]:
    """Returns what each of several robots did."""
    sentences = []
    for name, did in (outcome.robots or {}).items():
        failed = f", {did['failed_actions']} failed" if did["failed_actions"] else ""
        done = counted(int(did["actions"]), "action")
        sentences.append(
            f"  {name}: {done}{failed}, {did['metres']:.1f} m, idle {did['idle']:.0%} of the time"
        )
    return sentences


def _evening(figures: dict[str, float | None]) -> list[str]:
    """Returns in words who came, who was lost, and how long they waited for what."""
    number = {name: value or 0 for name, value in figures.items()}
    lost = ""
    if number["lost"]:
        why = [
            f"{number[key]} {words}"
            for key, words in (
                ("lost_unseated", "without a table"), ("lost_unserved", "without a plate")
            )
            if number[key]
        ]  # fmt: skip
        lost = f", {number['lost']} lost ({', '.join(why)})"
    sentences = [
        f"  {_parties_in(int(number['parties']))} "
        f"({counted(int(number['guests']), 'guest')}): {number['served']} served{lost}"
    ]
    waits = [
        f"{words} {number[f'wait_{what}_mean'] / 60:.1f} ({number[f'wait_{what}_p95'] / 60:.1f})"
        for what, words in _WAITS
        if figures[f"wait_{what}_mean"] is not None
    ]
    if waits:
        sentences.append(f"  minutes waited, mean (95 %): {', '.join(waits)}")
    sentences.append(
        f"  tables taken {number['table_use']:.0%} of the time; the robot drove "
        f"{number['metres']:.0f} m and was idle {number['idle']:.0%}; "
        f"{counted(int(number['late']), 'late decision')}"
    )
    return sentences


def _parties_in(number: int) -> str:
    return "1 party" if number == 1 else f"{number} parties"


def _nearness(who: str, gap: float, nearest: str | None) -> str:
    """Returns how close a robot's hull came to anything; below nothing it touched it."""
    if gap < 0:
        return f"{who} touched {nearest}"
    return f"{who} came within {gap:.2f} m of {nearest}, and no closer to anything"


def _times(number: int) -> str:
    return {1: "once", 2: "twice"}.get(number, f"{number} times")


@dataclass(frozen=True)
class Call:
    """Something that is still to be done for somebody.

    ``kind`` is ``waiting following bill to_order order kitchen ready carried`` or ``empty``; it is
    about a party or a table, and about ``item`` there.
    """

    kind: str
    text: str
    party: Party = ()
    table: str | None = None
    item: str | None = None

    def as_dict(self) -> dict[str, Any]:
        """Returns it as ``simulate --json`` lists it."""
        whose: dict[str, Any] = {"party": list(self.party)} if self.party else {"table": self.table}
        if self.item is not None:
            whose["object"] = self.item
        return {"kind": self.kind, **whose, "text": self.text}


def unserved(state: State) -> tuple[Call, ...]:
    """Returns whoever waits or calls in ``state``: parties by arrival, then tables by name."""
    return (*_parties(state), *_tables(state))


def _parties(state: State) -> Iterator[Call]:
    for party in state.waiting:
        yield Call("waiting", f"{people(party)} waits at the entrance", party)
    for robot in state.crew():
        if robot.leads:
            text = f"{people(robot.leads)} follows {_name(robot, state)} and has no table"
            yield Call("following", text, robot.leads)


def _name(robot: Robot, state: State) -> str:
    return robot.name if state.robots else "the robot"


def _tables(state: State) -> Iterator[Call]:
    for table in sorted(state.wants_bill):
        yield Call("bill", f"{table} wants its bill", table=table)
    for table in sorted(state.ready_to_order):
        yield Call("to_order", f"{table} is ready to order", table=table)
    for table in sorted(state.held_orders()):
        yield Call("order", f"the order of {table} is not sent", table=table)
    at_the_bar = {table for table, item in state.ready if item == "plate"}
    carried = state.carried()
    on_its_way = {table for table, item in carried if item == "plate"}
    for table in sorted(state.sent - state.served - at_the_bar - on_its_way):
        yield Call("kitchen", f"the kitchen has not made what {table} ordered", table=table)
    for table, item in sorted(state.ready - carried):
        yield Call("ready", f"the {item} for {table} is not brought", table=table, item=item)
    for robot in state.crew():
        if robot.carries is not None:
            table, item = robot.carries
            text = f"{_name(robot, state)} still has the {item} of {table}"
            yield Call("carried", text, table=table, item=item)
    for table, item in sorted(state.empty - carried):
        yield Call("empty", f"the {item} of {table} is empty", table=table, item=item)
