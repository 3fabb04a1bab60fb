"""Lines of people: each is believed, happens in the world, and is answered. Entry points `LiveLines`, `agree`.

Those of ``waiter serve`` go to the `Session` as they are, and what they tell happens in the world too;
`COMMANDS` are the studio's own.
"""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from waiter_cli.execution.decision import Refused
from waiter_cli.files.documents import observation_document
from waiter_cli.model.plan import Action
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.protocol import BadLine, LiveEvent, read_line, to_json
from waiter_cli.serve.session import Session, apply_event
from waiter_cli.simulation.run import Run
from waiter_cli.studio.live.live_commands import COMMANDS, BadCommand, read_command
from waiter_cli.studio.live.live_controller import LiveController
from waiter_cli.studio.live.live_teller import LiveTeller
from waiter_cli.studio.live.pace import Pace

if TYPE_CHECKING:
    from waiter_cli.simulation.fleet.fleet_happenings import FleetHappenings

__all__ = ["LiveLines", "agree", "joint_of"]

ROBOTS_OWN = ("started", "done")
NOTHING_CHANGED = "nothing has changed"


def joint_of(run: Run) -> FleetHappenings:
    """Returns what happens to several robots."""
    from waiter_cli.simulation.fleet.fleet_happenings import FleetHappenings

    happenings = run.happenings
    assert isinstance(happenings, FleetHappenings)
    return happenings


def agree(run: Run, session: Session) -> None:
    """Has the world be as it is believed to be, where the two differ and nobody does anything."""
    state = session.executive.state
    if not run.at_rest or run.world.state() == state:
        return
    run.world.become(state)
    inside = {name for party in state.parties() for name in party}
    for person in list(run.crowd.people.values()):
        if person.role == "guest" and person.name not in inside and person.then != "gone":
            run.crowd.leave((person.name,))
    for table, party in state.seated:
        if any(run.crowd.people.get(name) is None for name in party):
            run.crowd.sit(party, run.room.chairs[table], at_once=True)
    for party in state.waiting:
        if any(run.crowd.people.get(name) is None for name in party):
            run.crowd.wait(party, come_in=True)


class LiveLines:
    """Answers lines between two ticks of a run; ``note`` hears of each deed of a person."""

    def __init__(
        self, session: Session, run: Run, controller: LiveController, pace: Pace,
        teller: LiveTeller, note: Callable[[dict[str, Any]], None],
    ) -> None:  # fmt: skip
        self._session, self._run, self._controller = session, run, controller
        self._pace, self._teller, self._note = pace, teller, note
        self._told_seats: list[dict[str, Any]] = []

    def answer(self, line: ReceivedLine) -> tuple[str, bool]:
        """Returns the answer to a line, and whether anything was changed by it; raises `BadCommand`."""
        command = read_command(line.data)
        if command is not None:
            return self._obey(line, command)
        executive = self._session.executive
        try:
            event = read_line(line.data, executive.layout, executive.state)
        except BadLine:
            return self._session.handle(line), False
        if event.kind in ROBOTS_OWN:
            raise BadCommand("the robot itself reports its steps here", "play, or step", event.id)
        if event.kind == "failed":
            self._let_fail(event)
            return self._plan(line, event), True
        refusal = self._refusal(event)
        if refusal is not None:
            raise BadCommand(refusal, NOTHING_CHANGED, event.id)
        if event.kind == "back" and self._drives_back(event.back):
            return self._plan(line, event), True
        answer = self._session.handle(line)
        if event.kind == "ask" or "error" in json.loads(answer):
            return answer, False
        self._happen(event)
        return answer, True

    def _plan(self, line: ReceivedLine, event: LiveEvent) -> str:
        """Returns the answer to a line whose effect is still to come: the plan as it is."""
        told = {"ask": "plan", **({} if event.id is None else {"id": event.id})}
        return self._session.handle(replace(line, data=json.dumps(told).encode()))

    def _refusal(self, event: LiveEvent) -> str | None:
        """Returns why what is told cannot happen in the world, None where it can."""
        world = self._run.world.fork()
        for seen in event.seen:
            refusal = self._run.happenings.objection(seen) or world.suffer(seen)
            if refusal is not None:
                return refusal
        return None

    def _happen(self, event: LiveEvent) -> None:
        """Has the world do what was told and believed."""
        run, teller = self._run, self._teller
        teller.note_change()
        run.heed()
        if event.seen:
            self._note({"observe": [observation_document(one) for one in event.seen]})
        for name in event.out:
            self._note({"out": name})
            joint_of(run).stand_still(name)
        if event.kind != "observe":
            self._note({event.kind: event.source[event.kind]})
        if event.kind == "observe":
            run.happenings.suffer(event.seen)
            for seen in event.seen:  # who is seen elsewhere is there already
                if seen.kind == "at" and seen.arguments[0] in run.crowd.people:
                    run.crowd.put(seen.arguments[0], run.room.nodes[seen.arguments[1]])
            teller.explain(event.seen)
        elif event.kind == "block":
            run.blocks.add(event.edge, None)
            teller.say(f"the path {'-'.join(event.edge)} is blocked")
        elif event.kind == "clear":
            run.blocks.end(event.edge)
            teller.say(f"the path {'-'.join(event.edge)} is clear")
        elif event.kind == "back":
            joint_of(run).go_on(event.back)
        agree(run, self._session)

    def _drives_back(self, name: str) -> bool:
        """Returns whether a robot that was out, and goes on now, has to be at its node before."""
        joint = joint_of(self._run)
        if name not in self._session.executive.decision.out or joint.is_ready(name):
            return False
        joint.go_back(name)
        self._note({"back": name})
        return True

    # ------------------------------------------------------------ a step that fails

    def _let_fail(self, event: LiveEvent) -> None:
        """Has the step that a robot is at come to nothing; it reports that itself, once it is at its node."""
        several = bool(self._session.executive.layout.agents)
        robot, step = event.steps[0] if several else ("agent", event.step)
        action = self._run.acting_of(robot)
        if action is None:
            raise BadCommand(f"{robot} is at no step", NOTHING_CHANGED, event.id)
        if action.step != step:
            hint = f"it is at step {action.step}: {action.text}"
            raise BadCommand(f"{robot} is not at step {step}", hint, event.id)
        self._require_failure(event, action)
        self._run.let_fail(robot, event.reason or "it was told to fail")
        self._note({"failed": event.source["failed"]})

    def _require_failure(self, event: LiveEvent, action: Action) -> None:
        """Raises `BadCommand` where a step cannot fail by what is believed: others rely on it already."""
        try:
            apply_event(copy.copy(self._session.executive), event)
        except Refused as refused:
            raise BadCommand(refused.message, refused.hint, event.id) from None

    # ------------------------------------------------------------ commands of the studio's own

    def _obey(self, line: ReceivedLine, command: dict[str, Any]) -> tuple[str, bool]:
        """Obeys a command of the studio's own."""
        (kind,) = (key for key in command if key in COMMANDS)
        value, changed = command[kind], True
        id = {"id": command["id"]} if "id" in command else {}
        told: dict[str, Any] = {"line": line.number, **id}
        match kind:
            case "play":
                self._pace.play(value)
            case "step":
                self._pace.step_to(self._controller.step + value)
            case "speed":
                self._pace.at_speed(float(value))
            case "guests":
                party = self._run.happenings.fresh_party(value)
                told, changed = self._posed(line, {"observe": {"enter": list(party)}, **id})
            case "seat":
                told, changed = self._posed(line, {"goal": {"seated": value}, **id})
                if changed:
                    self._told_seats.append({"seated": value})
        self._teller.stale = True
        if kind in ("play", "step", "speed"):
            told |= {"playing": self._pace.playing, "speed": self._pace.speed}
        return to_json(told), changed

    def _posed(self, line: ReceivedLine, told: dict[str, Any]) -> tuple[dict[str, Any], bool]:
        """Returns the answer to another line in the place of one."""
        answer, changed = self.answer(replace(line, data=json.dumps(told).encode()))
        return json.loads(answer), changed

    def drop_what_is_seated(self) -> None:
        """Serves everybody again once a party sits where it was asked to."""
        executive = self._session.executive
        for told in list(self._told_seats):
            guest, table = told["seated"]["party"], told["seated"]["table"]
            party = executive.state.party_of(guest)
            if party is not None and executive.state.table_of(guest) != table:
                continue
            self._told_seats.remove(told)
            goals = [goal.as_dict() for goal in executive.goals]
            if party is not None and {"seated": {"party": party[0], "table": table}} in goals:
                self._controller.drop(told)
