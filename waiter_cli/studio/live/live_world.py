"""The evening behind the page: a simulated world that lives in real time. Class `LiveWorld`.

One thread plays a `Run` of the simulation and keeps pace with the clock on the wall.  At each tick, and
while it is paused, it takes the lines that people send, in order: those of ``waiter serve`` go to the
`Session` as they are, and what they tell happens in the world too; `COMMANDS` are the studio's own.  What is
said goes to ``tell``: answers, ``{"view": …}`` (plan, proof, what waits), ``{"world": change}`` at most
`FRAMES` times a second, ``{"event": …}``.
"""

from __future__ import annotations

import json
import queue
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from sparc.garbage import collect_often, give_back
from waiter_cli.domain_execution.domain_rules import require_events
from waiter_cli.domain_execution.vocabulary import vocabulary_of
from waiter_cli.execution.decision import Refused
from waiter_cli.files.documents import observation_document
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Observation
from waiter_cli.pictures.event_text import event_by_whom
from waiter_cli.pictures.moments import MomentDiffer
from waiter_cli.pictures.snapshot import take
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.protocol import BadLine, LiveEvent, error_document, read_line, to_json
from waiter_cli.serve.session import Session
from waiter_cli.simulation.clearance import Geometric
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.outcome import TICKS, Rules, RunEnded
from waiter_cli.simulation.run import Run
from waiter_cli.studio.live.film_reel import FilmReel
from waiter_cli.studio.live.live_commands import COMMANDS, BadCommand, read_command
from waiter_cli.studio.live.live_controller import JointLiveController, LiveController
from waiter_cli.studio.live.live_view import own_words, stories, view_of
from waiter_cli.studio.live.pace import Pace
from waiter_cli.studio.live.plan_list import PlanList
from waiter_cli.studio.opened import Opened

if TYPE_CHECKING:
    from waiter_cli.simulation.fleet.fleet_happenings import FleetHappenings

__all__ = ["Ask", "LiveWorld"]

FRAMES = 20
"""So many times a second the page is told who is where."""
QUIET = 0.25
"""Seconds after which the page is told the time although nothing has moved."""
ROBOTS_OWN = ("started", "done", "failed")
DRAWN = 0.4
"""Seconds in which a page that has just come is drawn."""
TIDY = 20.0
"""Seconds on the wall after which what large searches took is given back."""
MOST_EVENTS = 300
MOST_TRIPS = 5
MOST_DEEDS = 20_000


class _Closing(Exception):
    """The studio is to end."""


class Ask:
    """A line of a person: who sent it, its number, its bytes; ``answer`` is called with the answer."""

    def __init__(
        self, who: int, number: int, data: bytes, answer: Callable[[str, bool], None]
    ) -> None:
        self.who, self.number, self.data, self.answer = who, number, data, answer
        self.received = time.perf_counter()


class LiveWorld:
    """A run that is played until it is stopped; ``tell`` is called from its thread."""

    def __init__(
        self, opened: Opened, session: Session, *, seed: int = 0, speed: float = 1.0,
        resumed: bool = False,
    ) -> None:  # fmt: skip
        self.session = session
        self.opened = opened
        self.seed = seed
        self.fault: Exception | None = None
        self.broken: Callable[[], None] = lambda: None  # called once, with `fault` set
        self._newer = False  # the layout's file holds another text by now
        self.pace = Pace(speed)
        self.reel = FilmReel()
        self.tell: Callable[[dict[str, Any]], None] = lambda told: None
        self.deeds: list[tuple[float, dict[str, Any]]] = []
        self.begin_state = session.executive.state
        self.begin_goals = session.executive.goals
        self._begin_time = 0.0
        self._warm = False
        self._warm_at: float | None = None  # when the page will have been drawn
        self._asks: queue.SimpleQueue[Ask | Callable[[], None] | None] = queue.SimpleQueue()
        self._stopping = False
        self._told = 0.0  # when the page was told last
        self._tidied = time.perf_counter()
        self._stale = True  # the view has changed since it was told
        self._plan = PlanList(session)
        self._events: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)  # as the page lists them
        self._told_seats: list[dict[str, Any]] = []
        self._trips = 0
        self._stories: dict[str, Any] | None = None
        self._differ = MomentDiffer()
        executive = session.executive
        domain = opened.planner.domain
        self._vocabulary = vocabulary_of(domain, opened.layout, executive.state)
        several = bool(opened.layout.agents)
        controller = JointLiveController if several else LiveController
        self._controller = controller(session, self._reported, self._note_deed)
        self.run = self._make_run(opened, seed, resumed)
        for name in session.executive.decision.out:
            self._joint.stand_still(name)
        self._thread = threading.Thread(target=self._live, name="evening", daemon=True)

    def _make_run(self, opened: Opened, seed: int, resumed: bool) -> Run:
        executive, scenario = self.session.executive, opened.scenario
        fresh = scenario if scenario is not None and not resumed else None
        seen = fresh.observe if fresh is not None else ()
        state = executive.state
        rules = executive.belief.rules
        problem = Problem(
            opened.layout, state, tuple(seen), state, executive.goals,
            prefer=executive.prefer, instant_kitchen=executive.agenda.instant_kitchen,
            everybody=not executive.goals,
        )  # fmt: skip
        events = fresh.events if fresh is not None else ()
        require_events(problem, events, rules)
        run = _kind_of_run(opened, rules)(
            opened.room, problem, self._controller, Geometric(), EventLog(self._event),
            Rules(seed=seed), events,
            title=opened.scenario_name or opened.layout.name,
            guests=fresh.guests if fresh is not None else None,
        )  # fmt: skip
        for edge in executive.shut:
            run.blocks.add(edge, None)
        run.clock.due.append(self._attend)
        return run

    # ------------------------------------------------------------ called by other threads

    def start(self) -> None:
        """Begins to live."""
        self._thread.start()

    def stop(self) -> None:
        """Ends the life, between two ticks; waits for that, though not for ever."""
        self._stopping = True
        self._asks.put(None)
        self._thread.join(0.6)

    def ask(self, ask: Ask) -> None:
        """Puts a line in the order in which they are answered."""
        self._asks.put(ask)

    def note_saved(self, text: str) -> None:
        """Tells the page whether the layout's file holds another text than that of this evening."""
        self._newer, self._stale = text != self.opened.text, True

    def call(self, function: Callable[[], Any]) -> Any:
        """Returns what a function returns that is called between two ticks; raises what it raises."""
        done = threading.Event()
        found: list[Any] = []

        def between() -> None:
            try:
                found.append((True, function()))
            except Exception as error:
                found.append((False, error))
            done.set()

        self._asks.put(between)
        if not done.wait(10):
            raise TimeoutError("the evening has ended")
        fine, value = found[0]
        if not fine:
            raise value
        return value

    # ------------------------------------------------------------ the thread

    def _live(self) -> None:
        """Plays until it is stopped."""
        try:
            self._controller.abandon("the studio was closed")  # what a run that was ended was at
            while True:
                try:
                    self._attend()
                    if not self.run.act():
                        self.run.body.hold(1 / TICKS)
                except RunEnded as ended:
                    self._trip(ended)
                except Refused as refused:
                    self._trip(RunEnded("failed", refused.message))
        except _Closing:
            pass
        except Exception as error:
            if not self._stopping:
                self._break(error)

    def _break(self, error: Exception) -> None:
        """Ends the studio after a fault of ours, which is told as any other."""
        self.fault = error
        self.tell({"error": {"message": "an internal fault ended the evening", "hint": str(error)}})
        self.broken()

    def _attend(self) -> None:
        """Takes what people say, shows what has changed, and keeps pace."""
        if self.pace.until is not None and self._controller.step >= self.pace.until:
            self.pace.play(False)
            self._stale = True
        self._take()
        now = time.perf_counter()
        if now - self._told >= 1 / FRAMES:
            self._show(now)
        if self._warm_at is not None and now >= self._warm_at:
            self._warm_up()
        if now - self._tidied >= TIDY:
            self._tidied = now
            give_back()
        while True:
            if self.pace.playing:
                ahead = self.pace.wait(self.run.clock.ticks)
                if ahead <= 0.003:
                    return
            else:
                self._show(time.perf_counter())
                ahead = None
            self._take(ahead)

    def _take(self, seconds: float | None = 0.0) -> None:
        """Obeys what is there, and what comes within some seconds (None: however long it takes)."""
        while True:
            if self._stopping:
                raise _Closing
            try:
                if seconds == 0.0:
                    ask = self._asks.get_nowait()
                else:
                    ask = self._asks.get(timeout=seconds)
            except queue.Empty:
                return
            seconds = 0.0
            if isinstance(ask, Ask):
                self._obey(ask)
            elif ask is not None:
                ask()

    # ------------------------------------------------------------ lines

    def _obey(self, ask: Ask) -> None:
        """Answers one line, and has the world do what it tells."""
        try:
            answer, changed = self._answered(ask)
        except BadCommand as fault:
            document = {"line": ask.number, **fault.id} | error_document(fault.message, fault.hint)
            ask.answer(to_json(document), False)
            return
        ask.answer(answer, changed)
        self._show(time.perf_counter())

    def _warm_up(self) -> None:
        """Loads what a search needs, before the first one, but not before the page has come.

        From then on garbage is collected as it comes.
        """
        if not self._warm:
            self._warm, self._warm_at = True, None
            executive = self.session.executive
            self.opened.planner.warm_up(executive.layout, executive.state)
            collect_often()

    def _answered(self, ask: Ask) -> tuple[str, bool]:
        """Returns the answer to a line, and whether anything was changed by it."""
        self._warm_up()
        command = read_command(ask.data)
        if command is not None:
            return self._commanded(ask, command)
        executive = self.session.executive
        line = ReceivedLine(ask.number, ask.data, ask.received)
        try:
            event = read_line(ask.data, executive.layout, executive.state)
        except BadLine:
            return self.session.handle(line), False
        if event.kind in ROBOTS_OWN:
            raise BadCommand("the robot itself reports its steps here", "play, or step", event.id)
        refusal = self._refusal(event)
        if refusal is not None:
            raise BadCommand(refusal, "nothing has changed", event.id)
        if event.kind == "back" and self._drives_back(event.back):
            told = {"ask": "plan", **({} if event.id is None else {"id": event.id})}
            return self.session.handle(replace(line, data=json.dumps(told).encode())), True
        answer = self.session.handle(line)
        if event.kind == "ask" or "error" in json.loads(answer):
            return answer, False
        self._happen(event)
        return answer, True

    def _refusal(self, event: LiveEvent) -> str | None:
        """Returns why what is told cannot happen in the world, None where it can."""
        world = self.run.world.fork()
        for seen in event.seen:
            refusal = self.run.happenings.objection(seen) or world.suffer(seen)
            if refusal is not None:
                return refusal
        return None

    def _happen(self, event: LiveEvent) -> None:
        """Has the world do what was told and believed."""
        run = self.run
        self._changed()
        run.heed()
        if event.seen:
            self._note_deed({"observe": [observation_document(one) for one in event.seen]})
        for name in event.out:
            self._note_deed({"out": name})
            self._joint.stand_still(name)
        if event.kind != "observe":
            self._note_deed({event.kind: event.source[event.kind]})
        if event.kind == "observe":
            run.happenings.suffer(event.seen)
            for seen in event.seen:  # who is seen elsewhere is there already
                if seen.kind == "at" and seen.arguments[0] in run.crowd.people:
                    run.crowd.put(seen.arguments[0], run.room.nodes[seen.arguments[1]])
            self._explain(event.seen)
        elif event.kind == "block":
            run.blocks.add(event.edge, None)
            self._say(f"the path {'-'.join(event.edge)} is blocked")
        elif event.kind == "clear":
            run.blocks.end(event.edge)
            self._say(f"the path {'-'.join(event.edge)} is clear")
        elif event.kind == "back":
            self._joint.go_on(event.back)
        self._agree()

    def _drives_back(self, name: str) -> bool:
        """Returns whether a robot that was out, and goes on now, has to be at its node before."""
        if name not in self.session.executive.decision.out or self._joint.is_ready(name):
            return False
        self._joint.go_back(name)
        self._note_deed({"back": name})
        return True

    @property
    def _joint(self) -> FleetHappenings:
        """Returns what happens to several robots."""
        from waiter_cli.simulation.fleet.fleet_happenings import FleetHappenings

        happenings = self.run.happenings
        assert isinstance(happenings, FleetHappenings)
        return happenings

    def _note_deed(self, deed: dict[str, Any]) -> None:
        """Keeps what happened, for a scenario of this evening, which begins anew once it is too long."""
        time = self.run.clock.time
        if len(self.deeds) >= MOST_DEEDS:
            executive = self.session.executive
            self.begin_state, self.begin_goals = executive.state, executive.goals
            self.deeds, self._begin_time = [], time
            return
        self.deeds.append((time - self._begin_time, deed))

    def _explain(self, seen: tuple[Observation, ...]) -> None:
        """Notes how what was seen can have come about, in words."""
        found = self.session.executive.decision.diagnosis
        if not found:
            return
        told = [" ".join(one.arguments) for one in seen if one.kind == "at"]
        self._stories = {"seen": told, "stories": stories([each.text for each in found])}
        for one in self._stories["stories"][:1]:
            self._say(f"that surprises the robot; the likeliest story: {one}")

    def _commanded(self, ask: Ask, command: dict[str, Any]) -> tuple[str, bool]:
        """Obeys a command of the studio's own."""
        (kind,) = (key for key in command if key in COMMANDS)
        value, changed = command[kind], True
        id = {"id": command["id"]} if "id" in command else {}
        told: dict[str, Any] = {"line": ask.number, **id}
        match kind:
            case "play":
                self.pace.play(value)
            case "step":
                self.pace.step_to(self._controller.step + value)
            case "speed":
                self.pace.at_speed(float(value))
            case "guests":
                party = self.run.happenings.fresh_party(value)
                line = {"observe": {"enter": list(party)}, **id}
                told, changed = self._answered_line(ask, line)
            case "seat":
                line = {"goal": {"seated": value}, **id}
                told, changed = self._answered_line(ask, line)
                if changed:
                    self._told_seats.append({"seated": value})
        self._stale = True
        if kind in ("play", "step", "speed"):
            told |= {"playing": self.pace.playing, "speed": self.pace.speed}
        return to_json(told), changed

    def _answered_line(self, ask: Ask, line: dict[str, Any]) -> tuple[dict[str, Any], bool]:
        posed = Ask(ask.who, ask.number, json.dumps(line).encode(), ask.answer)
        answer, changed = self._answered(posed)
        return json.loads(answer), changed

    # ------------------------------------------------------------ what the robot reports

    def _reported(self, kind: str, step: int, robot: str) -> None:
        """Keeps the list of the plan in step with what a robot does."""
        if kind == "started":
            self._trips = 0
            self._plan.started(step, robot)
        elif kind in ("done", "failed"):
            self._plan.ended(kind, step, robot)
        elif kind == "observe":  # by itself, as the scenario or chance has it
            self._stories = None
        self._stale = True
        if kind == "done":
            self._drop_what_is_seated()
        self._changed()

    def _drop_what_is_seated(self) -> None:
        """Once a party sits where it was asked to, everybody is served again."""
        executive = self.session.executive
        for told in list(self._told_seats):
            guest, table = told["seated"]["party"], told["seated"]["table"]
            party = executive.state.party_of(guest)
            if party is None or executive.state.table_of(guest) == table:
                self._told_seats.remove(told)
                open_goals = [goal.as_dict() for goal in executive.goals]
                if (
                    party is not None
                    and {"seated": {"party": party[0], "table": table}} in open_goals
                ):
                    self._controller.drop(told)

    def _changed(self) -> None:
        """Begins the list anew where the plan before was done and there is another."""
        self._stale = True
        self._plan.changed()

    def _event(self, line: str) -> None:
        event = json.loads(line)
        self.reel.event(event)
        said = event_by_whom(event)
        if said is not None:
            bad = event["type"] in ("collision", "action_failed", "precondition_failed", "blocked")
            self._list({"t": event["t"], "text": said, "bad": bad})

    def _say(self, text: str, bad: bool = False) -> None:
        self._list({"t": round(self.run.clock.time, 3), "text": text, "bad": bad})

    def _list(self, event: dict[str, Any]) -> None:
        self._events.append(event)
        self.tell({"event": event})

    # ------------------------------------------------------------ when things go wrong

    def _trip(self, ended: RunEnded) -> None:
        """Says why the robot could not go on, makes world and belief one again, and goes on."""
        self._trips += 1
        self._say(ended.why, bad=True)
        run = self.run
        run.break_off()
        self._controller.abandon(ended.why)
        self._agree()
        run.put_robots(self.session.executive.state)
        if self._trips >= MOST_TRIPS:
            self.pace.play(False)
            self._say("paused: the robot cannot go on", bad=True)

    def _agree(self) -> None:
        """Has the world be as it is believed to be, where the two differ and nobody does anything."""
        state, run = self.session.executive.state, self.run
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

    # ------------------------------------------------------------ what the page is told

    def _show(self, now: float) -> None:
        """Tells what has changed since the last time: who is where first, then what is said of it."""
        snapshot = take(self.run)
        change = self._differ.change(snapshot, rows=self._plan.rows())
        if change is not None:
            self.reel.add(change, self._differ.moment)
        if change is not None or now - self._told >= QUIET:
            self._told = now
            self.tell({"world": change or [round(self.run.clock.time, 3), {}, []]})
        if self._stale:
            self._stale = False
            self.tell({"view": self.view()})

    def view(self) -> dict[str, Any]:
        """Returns what the page lists beside the floor."""
        rows = self._plan.rows()
        current = next((i for i, row in enumerate(rows) if row[1] in ("now", "next")), None)
        found = view_of(self.session.executive, self.opened.planner)
        for robot in found["robots"]:
            robot["doing"] = self._plan.doing(robot["name"])
        return {
            **found,
            "own": own_words(self._vocabulary, self.session.executive.state),
            "rows": rows,
            "current": current,
            "playing": self.pace.playing,
            "speed": self.pace.speed,
            "time": round(self.run.clock.time, 3),
            "begin": round(self.reel.begin, 3),
            "surprise": self._stories,
            "newer": self._newer,
        }

    def whole(self) -> list[dict[str, Any]]:
        """Returns what somebody is told who has just come."""
        if not self._warm:
            self._warm_at = time.perf_counter() + DRAWN
        moment = self._differ.moment
        return [
            {"view": self.view()},
            *({"event": event} for event in self._events),
            {"world": [round(self.run.clock.time, 3), moment, []], "whole": True},
        ]


def _kind_of_run(opened: Opened, rules: Rulebook) -> Callable[..., Run]:
    """Returns what makes the run: that of several robots, or of one by these rules."""
    if opened.layout.agents:
        from waiter_cli.simulation.fleet.fleet_run import FleetRun

        return FleetRun
    domain = None if rules is HOUSE else opened.planner.domain
    return partial(Run, book=rules, domain=domain)
