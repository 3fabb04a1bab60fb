"""One line in, one line out: `Session.handle`. Entry points `Session` and `serve_lines`.

A line that is understood and can be is believed, planned for, made durable and then answered; all
others are answered with an error and change nothing, since every line is tried on a copy first.
A search that takes long gives way to a newer observation (`Watch`).
"""

from __future__ import annotations

import copy
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from waiter_cli.errors import InputError
from waiter_cli.execution.decision import Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.fleet_executive import FleetExecutive
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.files.documents import explanation_document, reason_document, state_document
from waiter_cli.serve.inbox import Inbox, ReceivedLine
from waiter_cli.serve.journal import Journal, JournalFull
from waiter_cli.serve.latency import Latencies
from waiter_cli.serve.memory import memorize, snapshot
from waiter_cli.serve.protocol import (
    MOST_INSIDE,
    BadLine,
    LiveEvent,
    answer,
    error_document,
    pending_document,
    read_line,
    to_json,
)
from waiter_cli.serve.supersede import Superseded, Watch

__all__ = ["Session", "apply_event", "serve_lines"]

_PLANNED_FOR = ("observe", "goal", "drop", "block", "clear")
"""Lines whose search a newer one of them supersedes."""


def apply_event(executive: Executive, event: LiveEvent) -> None:
    """Believes an event, without planning; raises `Refused`, and then it may be half believed."""
    if isinstance(executive, FleetExecutive):
        return _apply_to_fleet(executive, event)
    _apply_to_one(executive, event)


def _apply_to_fleet(executive: FleetExecutive, event: LiveEvent) -> None:
    match event.kind:
        case "observe":
            if event.seen:
                executive.observe(event.seen, plan=False)
            for robot in event.out:
                executive.take_out(robot, plan=False)
        case "started":
            executive.started_by(*event.steps[0], plan=False)
        case "done":
            executive.done_by(dict(event.steps), plan=False)
        case "failed":
            executive.failed_by(*event.steps[0], event.reason, plan=False)
        case "back":
            executive.bring_back(event.back, plan=False)
        case _:
            _apply_to_one(executive, event)


def _apply_to_one(executive: Executive, event: LiveEvent) -> None:
    match event.kind:
        case "observe":
            executive.observe(event.seen, plan=False)
        case "started":
            executive.started(event.step, plan=False)
        case "done":
            executive.done(event.step, plan=False)
        case "failed":
            executive.failed(event.step, event.reason, plan=False)
        case "goal":
            for goal in event.goals:
                executive.add_goal(goal, plan=False)
        case "drop":
            for goal in event.goals:
                executive.drop_goal(goal, plan=False)
        case "block":
            executive.block(event.edge, plan=False)
        case "clear":
            executive.clear(event.edge, plan=False)


def _must_hold(executive: Executive, event: LiveEvent) -> None:
    """Raises `Refused` where an event would have more believed or wanted than can be planned for."""
    if event.kind == "goal" and len(executive.goals) > MOST_INSIDE:
        raise Refused(f"more than {MOST_INSIDE} goals are open", "drop some first")
    if any(seen.kind == "enter" for seen in event.seen):
        most = max(MOST_INSIDE, 2 * sum(table.capacity for table in executive.layout.tables))
        if sum(map(len, executive.state.parties())) > most:
            raise Refused(f"more than {most} guests would be inside", "tell who left first")


class Session:
    """One run: the executive, where it is written down, and how long everything took."""

    def __init__(
        self, executive: Executive, thinker: OnlinePlanner, journal: Journal | None = None
    ) -> None:
        self.executive = executive
        self.thinker = thinker
        self.journal = journal
        self.latencies = Latencies()
        self.lines = 0
        self.errors = 0
        self.superseded = 0
        self._watch = Watch()

    def handle(self, line: ReceivedLine, inbox: Inbox | None = None) -> str:
        """Returns the answer to a line, without its end; ``inbox`` is where a newer one may lie."""
        self.lines += 1
        document: dict[str, Any] = {"line": line.number}
        try:
            event = read_line(line.data, self.executive.layout, self.executive.state)
            if event.id is not None:
                document["id"] = event.id
            if event.kind == "ask":
                return to_json(document | self._told(event.ask))
            document |= self._accept(event, document, inbox)
        except (BadLine, Refused) as fault:
            self.errors += 1
            if isinstance(fault, BadLine):
                if fault.id is not None:
                    document["id"] = fault.id
                return to_json(document | error_document(fault.message, fault.hint, fault.meant))
            return to_json(document | error_document(fault.message, fault.hint))
        except InputError as fault:  # this domain has no words for it
            self.errors += 1
            first = fault.faults[0]
            return to_json(document | error_document(first.message, first.hint))
        except JournalFull as fault:
            self.errors += 1
            hint = "the line changed nothing; make room and send it again"
            return to_json(document | error_document(str(fault), hint))
        if "superseded_by" in document:
            return to_json(document)
        taken = (time.perf_counter() - line.received) * 1000
        if event.kind in _PLANNED_FOR:
            self.latencies.add(taken)
        return to_json(document | {"latency_ms": round(taken, 1)})

    def _accept(
        self, event: LiveEvent, head: dict[str, Any], inbox: Inbox | None
    ) -> dict[str, Any]:
        """Believes an event and plans, writes both down, and says what is to be told."""
        trial = copy.copy(self.executive)
        apply_event(trial, event)
        _must_hold(trial, event)
        try:
            with self._superseding(trial, event, inbox), self.thinker.decision():
                answered = answer(trial.decide())
        except Superseded as newer:
            self.superseded += 1
            answered = {"superseded_by": newer.line}
        if self.journal is not None:
            record = {
                "event": event.source,
                "answer": head | answered,
                "state": memorize(trial.state),
            }
            whole = self.journal.due and "superseded_by" not in answered
            self.journal.append(record, snapshot(trial) if whole else None)
        self.executive = trial
        return answered

    @contextmanager
    def _superseding(
        self, trial: Executive, event: LiveEvent, inbox: Inbox | None
    ) -> Iterator[None]:
        """Lets newer lines end the search within; raises `Superseded` in it."""
        if inbox is None or event.kind not in _PLANNED_FOR:
            yield
            return
        believed = copy.copy(trial)

        def supersedes(line: ReceivedLine) -> bool:
            fork = copy.copy(believed)
            try:
                newer = read_line(line.data, fork.layout, fork.state)
                apply_event(fork, newer)
            except (BadLine, Refused):
                return False
            return newer.kind in _PLANNED_FOR

        with self._watch.over(inbox, supersedes):
            yield

    # -- questions --------------------------------------------------------------------------

    def _told(self, ask: str) -> dict[str, Any]:
        executive = self.executive
        match ask:
            case "state":
                return {
                    "state": state_document(executive.state, executive.layout),
                    "step": executive.step,
                }
            case "plan":
                return answer(executive.decision)
            case "why":
                return {"why": self._why()}
        return {"stats": self.stats()}

    def stats(self) -> dict[str, Any]:
        """Figures of the run so far."""
        return {
            "lines": self.lines,
            "errors": self.errors,
            "steps": self.executive.step,
            "revision": self.executive.decision.revision,
            "searches": self.thinker.searches,
            "deadlines": self.thinker.late,
            "superseded": self.superseded,
            "latency": self.latencies.summary(),
        }

    def _why(self) -> dict[str, Any]:
        """Returns the purpose of the plan, step by step, and what it leaves out."""
        from waiter_cli.encoding.declarations import words_for
        from waiter_cli.rules.validator import run

        executive, decision = self.executive, self.executive.decision
        document: dict[str, Any] = {
            "everybody": not executive.goals,
            "status": decision.status,
            "minimal": decision.minimal,
        }
        goals, steps = [], []
        found = executive.outlook()
        if found is not None:
            problem, left, start = found
            rules = executive.belief.rules
            states = run(problem, left, rules).states
            for goal in problem.goals:
                at = next((i for i, s in enumerate(states) if rules.holds(goal, s, problem)), None)
                goals.append(
                    {"goal": goal.as_dict(), "reached_at": None if at is None else start + at}
                )
            for action in left.actions:
                if action.step < len(states):
                    text = words_for(self.thinker.domain, action, states[action.step])
                    steps.append({"step": action.step + start, "text": text})
        document |= {"goals": goals, "steps": steps}
        document["reasons"] = [reason_document(reason) for reason in decision.reasons]
        document["pending"] = [pending_document(each) for each in decision.pending]
        document["diagnosis"] = [explanation_document(each) for each in executive.explained]
        return document


def serve_lines(session: Session, inbox: Inbox, tell: Callable[[str], None]) -> None:
    """Answers every line of the inbox, in order, until it is closed."""
    while (line := inbox.get()) is not None:
        tell(session.handle(line, inbox))
