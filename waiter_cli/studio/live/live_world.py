"""The evening behind the page: a simulated world that lives in real time. Class `LiveWorld`.

One thread plays a `Run` of the simulation and keeps pace with the clock on the wall.  At each tick, and
while it is paused, it takes the lines that people send, in order, and has `LiveLines` answer them; what
the page is told is `LiveTeller`'s.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from sparc.garbage import collect_often, give_back
from waiter_cli.domain_execution.domain_rules import require_events
from waiter_cli.execution.decision import Refused
from waiter_cli.model.problem import Problem
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.protocol import error_document, to_json
from waiter_cli.serve.session import Session
from waiter_cli.simulation.clearance import Geometric
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.outcome import TICKS, Rules, RunEnded
from waiter_cli.simulation.run import Run
from waiter_cli.studio.live.live_commands import BadCommand
from waiter_cli.studio.live.live_controller import JointLiveController, LiveController
from waiter_cli.studio.live.live_lines import LiveLines, agree, joint_of
from waiter_cli.studio.live.live_record import LiveRecord
from waiter_cli.studio.live.live_teller import LiveTeller
from waiter_cli.studio.live.pace import Pace
from waiter_cli.studio.opened import Opened

__all__ = ["Ask", "LiveWorld"]

DRAWN = 0.4
"""Seconds in which a page that has just come is drawn."""
TIDY = 20.0
"""Seconds on the wall after which what large searches took is given back."""
MOST_TRIPS = 5


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
    """A run that is played until it is stopped; what its `teller` tells is told in its thread."""

    def __init__(
        self, opened: Opened, session: Session, *, seed: int = 0, speed: float = 1.0,
        resumed: bool = False,
    ) -> None:  # fmt: skip
        self.session = session
        self.opened = opened
        self.seed = seed
        self.fault: Exception | None = None
        self.broken: Callable[[], None] = lambda: None  # called once, with `fault` set
        self.pace = Pace(speed)
        self.record = LiveRecord(session)
        self.teller = LiveTeller(opened, session, self.pace)
        self.reel = self.teller.reel
        self._warm = False
        self._warm_at: float | None = None  # when the page will have been drawn
        self._asks: queue.SimpleQueue[Ask | Callable[[], None] | None] = queue.SimpleQueue()
        self._stopping = False
        self._tidied = time.perf_counter()
        self._trips = 0
        several = bool(opened.layout.agents)
        controller = JointLiveController if several else LiveController
        self._controller = controller(session, self._reported, self._note_deed)
        self.run = self.teller.run = self._make_run(opened, seed, resumed)
        self._lines = LiveLines(
            session, self.run, self._controller, self.pace, self.teller, self._note_deed
        )
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
            opened.room, problem, self._controller, Geometric(), EventLog(self.teller.event),
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
        self.teller.note_saved(text)

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
            self.take_up()
            while True:
                self.turn()
        except _Closing:
            pass
        except Exception as error:
            if not self._stopping:
                self._break(error)

    def take_up(self) -> None:
        """Ends what a run that was closed was at; everybody stands where that leaves them."""
        self._controller.end_all("the studio was closed")
        agree(self.run, self.session)
        self.run.put_robots(self.session.executive.state)
        for name in self.session.executive.decision.out:
            joint_of(self.run).stand_still(name)

    def turn(self) -> None:
        """Takes what people say, and plays on: a tick, or an action of a single robot."""
        try:
            self._attend()
            if not self.run.act():
                self.run.body.hold(1 / TICKS)
        except RunEnded as ended:
            self._trip(ended)
        except Refused as refused:
            self._trip(RunEnded("failed", refused.message))

    def _break(self, error: Exception) -> None:
        """Ends the studio after a fault of ours, which is told as any other."""
        self.fault = error
        self.teller.tell(
            {"error": {"message": "an internal fault ended the evening", "hint": str(error)}}
        )
        self.broken()

    def _attend(self) -> None:
        """Takes what people say, shows what has changed, and keeps pace."""
        if self.pace.until is not None and self._controller.step >= self.pace.until:
            self.pace.play(False)
            self.teller.stale = True
        self._take()
        now = time.perf_counter()
        if self.teller.is_due(now):
            self.teller.show(now)
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
                self.teller.show(time.perf_counter())
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
        self._warm_up()
        try:
            line = ReceivedLine(ask.number, ask.data, ask.received)
            answer, changed = self._lines.answer(line)
        except BadCommand as fault:
            document = {"line": ask.number, **fault.id} | error_document(fault.message, fault.hint)
            ask.answer(to_json(document), False)
            return
        ask.answer(answer, changed)
        self.teller.show(time.perf_counter())

    def _warm_up(self) -> None:
        """Loads what a search needs, before the first one, but not before the page has come.

        From then on garbage is collected as it comes.
        """
        if not self._warm:
            self._warm, self._warm_at = True, None
            executive = self.session.executive
            self.opened.planner.warm_up(executive.layout, executive.state)
            collect_often()

    def _note_deed(self, deed: dict[str, Any]) -> None:
        self.record.note(self.run.clock.time, deed)

    # ------------------------------------------------------------ what the robot reports

    def _reported(self, kind: str, step: int, robot: str) -> None:
        """Keeps the list of the plan in step with what a robot does."""
        if kind == "started":
            self._trips = 0
            self.teller.plan.started(step, robot)
        elif kind in ("done", "failed"):
            self.teller.plan.ended(kind, step, robot)
        elif kind == "observe":  # by itself, as the scenario or chance has it
            self.teller.forget_stories()
        self.teller.stale = True
        if kind == "done":
            self._lines.drop_what_is_seated()
        self.teller.note_change()

    # ------------------------------------------------------------ when things go wrong

    def _trip(self, ended: RunEnded) -> None:
        """Says why the robot could not go on, makes world and belief one again, and goes on."""
        self._trips += 1
        self.teller.say(ended.why, bad=True)
        run = self.run
        run.break_off()
        self._controller.abandon(ended.why)
        agree(run, self.session)
        run.put_robots(self.session.executive.state)
        if self._trips >= MOST_TRIPS:
            self.pace.play(False)
            self.teller.say("paused: the robot cannot go on", bad=True)

    # ------------------------------------------------------------ what the page is told

    def whole(self) -> list[dict[str, Any]]:
        """Returns what somebody is told who has just come."""
        if not self._warm:
            self._warm_at = time.perf_counter() + DRAWN
        return self.teller.whole()


def _kind_of_run(opened: Opened, rules: Rulebook) -> Callable[..., Run]:
    """Returns what makes the run: that of several robots, or of one by these rules."""
    if opened.layout.agents:
        from waiter_cli.simulation.fleet.fleet_run import FleetRun

        return FleetRun
    domain = None if rules is HOUSE else opened.planner.domain
    return partial(Run, book=rules, domain=domain)
