"""Plays decisions in a simulated restaurant, checks each, and reports what happened.

Entry point `Run`, which puts the parts together and repeats: decide, act, observe.  Decisions come from
a `Controller`, effects from a `World` of its own, motion from scripts, clearances from a `Backend`.
Time passes in ticks and never looks at a clock, so equal inputs give equal events.

Checks, by name: ``preconditions``, ``effects``, ``edge``, ``arrival``, ``clearance``, ``chairs``,
``shared_node``, ``final_state``, ``goals``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from waiter_cli.encoding.domains import Domain
from waiter_cli.evenings.injections import Injection
from waiter_cli.execution.protocols import Controller
from waiter_cli.files.documents import goals_document
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import Goal, State
from waiter_cli.room.motion import Pose
from waiter_cli.room.room import Room
from waiter_cli.rules.rulebook import HOUSE, Rulebook
from waiter_cli.simulation.acting import Actor
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import (
    Body,
    Odometer,
    OngoingAction,
    Shown,
    SimulatedClock,
    pose_at,
)
from waiter_cli.simulation.clearance import REACH, Backend, ClearanceMonitor
from waiter_cli.simulation.crowd import Crowd
from waiter_cli.simulation.deliberation import Deliberation
from waiter_cli.simulation.driver import Driver
from waiter_cli.simulation.event_log import EventLog, Reporter
from waiter_cli.simulation.happenings import Happenings
from waiter_cli.simulation.outcome import (
    TICKS,
    Rules,
    RunEnded,
    RunOutcome,
    differences,
    pending_document,
    told,
)
from waiter_cli.simulation.world import Violation, World

__all__ = ["MAX_STEPS", "Run", "ShownRobot", "let_people_in"]

MAX_STEPS = 20_000


class ShownRobot(NamedTuple):
    """A robot as pictures show it: what it carries, and what it says."""

    name: str
    pose: Pose
    load: tuple[str, str] | None
    saying: str


class Run:
    """One run, from `play`.  ``watch`` is called with it after every tick, to draw what is there.

    ``book`` and ``domain`` are those of a domain of one's own.  ``predicted`` is the final state of a plan made before, compared where nothing came between.
    Pictures read ``room``, ``problem``, ``timed``, ``mind``, ``world``, ``crowd``, ``clock``,
    ``body``, ``ongoing`` and ``shown``; whoever plays it by turns uses ``act``, ``happenings``, ``blocks``, and
    ``heed``, ``break_off`` and ``put_robots`` where something comes between.
    """

    def __init__(
        self,
        room: Room,
        problem: Problem,
        mind: Controller,
        backend: Backend,
        log: EventLog,
        rules: Rules | None = None,
        timed: Sequence[TimedEvent] = (),
        injections: Sequence[Injection] = (),
        watch: Callable[[Any], None] | None = None,
        predicted: State | None = None,
        title: str = "",
        guests: GuestModel | None = None,
        book: Rulebook = HOUSE,
        domain: Domain | None = None,
    ) -> None:
        self.domain = domain
        rules = rules or Rules()
        self.room, self.problem, self.mind, self.timed = room, problem, mind, timed
        self._rules, self._predicted, self._watched = rules, predicted, watch is not None
        self._backend, self._log = backend.name, log
        self.clock, self.ongoing, self.shown = SimulatedClock(), OngoingAction(), Shown(title)
        clock, ongoing, shown = self.clock, self.ongoing, self.shown
        self.world = world = _world(problem, book)
        self.crowd = crowd = Crowd(room)
        pose = pose_at(room, problem.state.agent)
        self.body = body = Body(pose, clock, backend.steer, ongoing, shown)
        self._reporter = reporter = Reporter(
            log, clock, body, world, mind, ongoing, shown, room.origin
        )  # fmt: skip
        self.blocks = blocks = Blocks(room, crowd, clock, body, reporter)
        self._deliberation = Deliberation(mind, problem.layout, world, ongoing, reporter)
        self.happenings = Happenings(
            problem, timed, injections, room, clock=clock, body=body, world=world, crowd=crowd,
            blocks=blocks, deliberation=self._deliberation, ongoing=ongoing, reporter=reporter,
            guests=guests, seed=rules.seed,
        )  # fmt: skip
        driver = Driver(
            room, rules, clock=clock, body=body, world=world, blocks=blocks,
            deliberation=self._deliberation, ongoing=ongoing, reporter=reporter, shown=shown,
        )  # fmt: skip
        slip = sum(i.amount or 0.0 for i in injections if i.kind == "slip")
        self._actor = Actor(
            room, rules, slip, body=body, world=world, crowd=crowd, driver=driver,
            deliberation=self._deliberation, ongoing=ongoing, reporter=reporter, shown=shown,
            domain=domain,
        )  # fmt: skip
        self._clearance = ClearanceMonitor(room, world, crowd, body, backend, reporter)
        clock.passing = [
            lambda: crowd.tick(1 / TICKS, body.pose, body.moved),
            lambda: blocks.update(lambda: self._deliberation.reopen(blocks.standing())),
            self._clearance.check,
        ]
        self._odometer = Odometer(body, clock, ongoing)
        if guests is not None:
            clock.passing.append(self._odometer.tick)
        if watch is not None:
            clock.passing.append(lambda: watch(self))
        clock.due = [self.happenings.happen]
        let_people_in(problem, room, crowd, body.pose)

    def play(self) -> RunOutcome:
        """Plays until the goals are reached, or nothing more can be done."""
        self._begin()
        try:
            self._loop()
            status, why, limit = "done", None, None
            self.body.hold(0.5)
            self._judge()
        except RunEnded as stop:
            status, why, limit = stop.status, stop.why, stop.limit
            self.shown.banner = self.shown.banner or stop.why
            self.body.hold(1.0, due=False)
        failures = tuple(self._reporter.failures)
        if failures:
            status, why, limit = "failed", why or failures[0].reason, None
        pending = tuple(pending_document(wish) for wish in self.mind.decision.pending)
        extra: dict[str, Any] = {"why": why} if why else {}
        if pending:
            extra["pending"] = list(pending)
        least = self._clearance.least if self._clearance.least < REACH else None
        self._reporter.say(
            "end", status=status, **extra, failed_checks=len(failures),
            min_clearance=None if least is None else round(least, 2),
        )  # fmt: skip
        return RunOutcome(
            status, why, round(self.clock.time, 3), self.mind.step, self._actor.done,
            self._actor.failed, self._deliberation.replans, self._log.count,
            None if least is None else round(least, 3), self._clearance.nearest,
            failures, self.world.state(), pending, self._backend, limit, self._figures(),
        )  # fmt: skip

    def _figures(self) -> dict[str, float | None] | None:
        """Returns what the evening was like, where guests came by chance."""
        evening = self.happenings.evening
        if evening is None:
            return None
        from waiter_cli.evenings.measures import figures_of

        return figures_of(
            evening.stays, self.clock.time, len(self.world.tables), metres=self._odometer.metres,
            idle=self._odometer.idle, late=self._deliberation.late,
        )  # fmt: skip

    def _begin(self) -> None:
        self._reporter.say(
            "start",
            layout=self.problem.layout.name,
            backend=self._backend,
            drive=self._rules.drive,
            seed=self._rules.seed,
            speed=self._rules.speed,
            goals=goals_document(self.problem.goals),
            plan=[action.text for action in self.mind.decision.plan],
        )
        for observation in self.problem.observations:
            self._reporter.say("observed", at_start=True, **told(observation))
        if (wrong := self.world.disorder()) is not None:
            self._reporter.fail(wrong)

    def _loop(self) -> None:
        while True:
            self.happenings.happen()
            if self.mind.step > MAX_STEPS:
                raise RunEnded("gave_up", f"gave up after {MAX_STEPS} steps")
            if not self.act() and not self.happenings.wait(skip=not self._watched):
                self._conclude()
                return

    def act(self) -> bool:
        """Plays the next step of the plan; returns False where nothing is to be done."""
        decision = self.mind.decision
        if decision.plan:
            self._actor.step(decision.plan[0])
        elif decision.horizon > 0:
            self._actor.idle()
        else:
            return False
        return True

    @property
    def at_rest(self) -> bool:
        """Returns whether no robot does anything."""
        return self.ongoing.action is None

    def heed(self) -> None:
        """Has what cannot end well by the newest decision be given up."""
        if self.ongoing.action is not None and self.mind.decision.abandoned is not None:
            self.ongoing.abandoned = True

    def break_off(self) -> None:
        """Has nobody do anything any more."""
        self.ongoing.action, self.ongoing.abandoned = None, False
        self.shown.saying = self.shown.banner = ""

    def put_robots(self, state: State) -> None:
        """Puts the robots on the nodes where a state has them."""
        self.body.put(self.room.nodes[state.agent])

    def acting(self) -> tuple[Action, ...]:
        """Returns the actions that are being done now."""
        return () if self.ongoing.action is None else (self.ongoing.action,)

    def acting_of(self, robot: str) -> Action | None:
        """Returns the action that a robot is at, None where it is at none."""
        return self.ongoing.action

    def let_fail(self, robot: str, why: str) -> None:
        """Has what a robot is at come to nothing; it drives back to its node first, and reports it there."""
        self.ongoing.let_fail(why)

    def shown_robots(self) -> tuple[ShownRobot, ...]:
        """Returns the robots as pictures show them."""
        return (ShownRobot("agent", self.body.pose, self.world.load, self.shown.saying),)

    def _conclude(self) -> None:
        """Raises `RunEnded` where the run gives up."""
        decision = self.mind.decision
        if decision.status == "undecided":
            if self._unmet():
                most = self._rules.max_steps
                steps = "--max-steps" if most is None else f"--max-steps {most}"
                limit = {"time": "the time limit", "max_steps": steps}
                within = limit.get(decision.limit or "", "the memory there is")
                why = f"gave up: no plan was found within {within}"
                raise RunEnded("gave_up", why, decision.limit)
            return  # a plan that is not known to be minimal has served, too
        if decision.status == "no_plan" or decision.pending:
            reasons = [r.message for r in decision.reasons]
            reasons += [r.message for wish in decision.pending for r in wish.reasons]
            why = "; ".join(dict.fromkeys(reasons)) or "no plan exists"
            raise RunEnded("gave_up", f"gave up: {why}")

    @property
    def _disturbed(self) -> bool:
        """Returns whether anything has come between that a plan made before knows nothing of."""
        return self.happenings.disturbed or self._actor.failed > 0

    def _judge(self) -> None:
        """Checks at the end that the goals hold, and that the world is as a plan made before has it."""
        words = "is still wanted" if self.problem.everybody else "does not hold"
        for goal in self._unmet():
            wrong = f"the goal {goal.as_dict()} {words} at the end"
            self._reporter.fail(Violation("goals", wrong))
        if self._predicted is not None and not self._disturbed:
            different = differences(self.world.state(), self._predicted)
            if different:
                wrong = f"the plan's final state is another: {different}"
                self._reporter.fail(Violation("final_state", wrong))

    def _unmet(self) -> list[Goal]:
        """Returns the goals that do not hold now.

        Those of a party that left unexpectedly do not count.
        """
        met, party_of = self.world.met, self.world.party_of
        if self.problem.everybody:
            from waiter_cli.problems.everybody import serve_everybody

            kitchen = self.problem.instant_kitchen
            wanted = serve_everybody(self.world.state(), self.problem.layout, kitchen, {})
            return [goal for goal in wanted if not met(goal)]
        closed = self.mind.decision.closed
        return [
            goal
            for goal in self.problem.goals
            if goal not in closed
            and not (goal.party and party_of(goal.party[0]) is None and self._disturbed)
            and not met(goal)
        ]


def _world(problem: Problem, book: Rulebook) -> World:
    """Returns the world of a run: the house's own, or that of a domain of one's own."""
    if book is HOUSE:
        return World(problem.layout, problem.state, problem.instant_kitchen)
    from waiter_cli.simulation.domain_world import DomainWorld

    kitchen = problem.instant_kitchen
    return DomainWorld(problem.layout, problem.state, book, kitchen, problem.facts)


def let_people_in(problem: Problem, room: Room, crowd: Crowd, pose: Pose) -> None:
    """Puts everybody who is there at the start where the state has them, the robot in a pose."""
    state = problem.state
    for who, node in state.waiters:
        crowd.add(who, "waiter", room.nodes[node])
    for table, party in state.seated:
        crowd.sit(party, room.chairs[table], at_once=True)
    fresh = {
        observation.arguments for observation in problem.observations if observation.kind == "enter"
    }
    for party in state.waiting:
        crowd.wait(party, come_in=party in fresh)
    for name in state.with_agent:
        crowd.add(name, "guest", pose[:2])
    if state.with_agent:
        crowd.follow(state.with_agent, pose)
