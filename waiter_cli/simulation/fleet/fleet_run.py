"""Plays the decisions for several robots in a simulated restaurant, and checks each. Entry point `FleetRun`.

As `waiter_cli.simulation.run`; but whatever may be begun by the order of precedence of the plan is begun, and all
robots move in the same tick.  Robots keep apart by that order; beyond it, one that would drive into another one
waits, and their distances are measured.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from waiter_cli.evenings.injections import Injection
from waiter_cli.execution.protocols import JointController
from waiter_cli.model.guest_model import GuestModel
from waiter_cli.model.plan import Action
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.model.state import State
from waiter_cli.room.room import Room
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import OngoingAction, Shown, SimulatedClock, pose_at
from waiter_cli.simulation.clearance import Backend
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.fleet.fleet_actor import FleetActor
from waiter_cli.simulation.fleet.fleet_bodies import FleetBody, RobotBody
from waiter_cli.simulation.fleet.fleet_crowd import FleetCrowd
from waiter_cli.simulation.fleet.fleet_happenings import FleetClearance, FleetHappenings
from waiter_cli.simulation.fleet.fleet_mind import FleetDeliberation, FleetReporter
from waiter_cli.simulation.fleet.fleet_world import FleetWorld
from waiter_cli.simulation.outcome import TICKS, Rules, RunEnded, RunOutcome
from waiter_cli.simulation.run import MAX_STEPS, Run, ShownRobot, let_people_in

__all__ = ["FleetRun"]


class FleetRun(Run):
    """One run of several robots, from `play`; as `Run`, by the rules of the house."""

    def __init__(
        self,
        room: Room,
        problem: Problem,
        mind: JointController,
        backend: Backend,
        log: EventLog,
        rules: Rules | None = None,
        timed: Sequence[TimedEvent] = (),
        injections: Sequence[Injection] = (),
        watch: Callable[[Any], None] | None = None,
        predicted: State | None = None,
        title: str = "",
        guests: GuestModel | None = None,
    ) -> None:
        rules = rules or Rules()
        self.room, self.problem, self.mind, self.timed = room, problem, mind, timed
        self._rules, self._predicted, self._watched = rules, predicted, watch is not None
        self._backend, self._log = backend.name, log
        self.clock, self.ongoing, self.shown = SimulatedClock(), OngoingAction(), Shown(title)
        self.domain = None  # the rules of the house alone
        clock, shown = self.clock, self.shown
        self.world = world = FleetWorld(problem.layout, problem.state, problem.instant_kitchen)
        self.robots = {
            each.name: RobotBody(
                each.name, pose_at(room, each.at), clock, backend.steering(each.name)
            )
            for each in problem.state.robots
        }
        self.crowd = crowd = FleetCrowd(room, self.robots)
        self.body = fleet = FleetBody(self.robots, clock, shown)
        self._reporter = reporter = FleetReporter(
            log, clock, fleet, world, mind, shown, room.origin
        )
        self.blocks = blocks = Blocks(room, crowd, clock, fleet, reporter)
        self._deliberation = self._minds = minds = FleetDeliberation(
            mind, problem, world, fleet, reporter
        )
        slip = sum(i.amount or 0.0 for i in injections if i.kind == "slip")
        self._actor = actor = FleetActor(  # type: ignore[assignment]
            room, rules, slip, clock=clock, fleet=fleet, world=world, crowd=crowd, blocks=blocks,
            deliberation=minds, reporter=reporter, shown=shown,
        )  # fmt: skip
        self._fleet, self._fleet_actor = fleet, actor
        self.happenings = happenings = FleetHappenings(
            problem, timed, injections, room, clock=clock, fleet=fleet, actor=actor, world=world,
            crowd=crowd, blocks=blocks, deliberation=minds, ongoing=self.ongoing,
            reporter=reporter, guests=guests, seed=rules.seed,
        )  # fmt: skip
        self._clearance = FleetClearance(room, world, crowd, fleet, backend, reporter)
        clock.passing = [
            lambda: crowd.tick_among(
                1 / TICKS, {name: (one.pose, one.moved) for name, one in self.robots.items()}
            ),
            lambda: blocks.update(lambda: minds.reopen(blocks.standing())),
            self._clearance.check,
        ]
        if watch is not None:
            clock.passing.append(lambda: watch(self))
        clock.due = [happenings.happen]
        let_people_in(problem, room, crowd, fleet.pose)
        for each in problem.state.robots:
            self._let_escort_in(each.name, each.leads)

    def _let_escort_in(self, robot: str, party: tuple[str, ...]) -> None:
        assert isinstance(self.crowd, FleetCrowd)
        for name in party:
            self.crowd.add(name, "guest", self.robots[robot].pose[:2])
        if party:
            self.crowd.who = robot
            self.crowd.follow(party, self.robots[robot].pose)

    def play(self) -> RunOutcome:
        """Does the same as `Run.play`."""
        outcome = super().play()
        ticks = self.clock.ticks
        return replace(
            outcome,
            robots={
                name: {
                    "actions": robot.done,
                    "failed_actions": robot.failed,
                    "metres": round(robot.metres, 3),
                    "idle": round(1.0 - robot.busy / ticks if ticks else 1.0, 3),
                }
                for name, robot in self.robots.items()
            },
        )

    def _figures(self) -> dict[str, float | None] | None:
        evening = self.happenings.evening
        if evening is None:
            return None
        from waiter_cli.evenings.measures import figures_of

        robots = self.robots.values()
        busy = sum(robot.busy for robot in robots) / len(robots)
        return figures_of(
            evening.stays, self.clock.time, len(self.world.tables),
            metres=sum(robot.metres for robot in robots),
            idle=1.0 - busy / self.clock.ticks if self.clock.ticks else 1.0,
            late=self._deliberation.late,
        )  # fmt: skip

    def _loop(self) -> None:
        try:
            while True:
                self.happenings.happen()
                if self.mind.step > MAX_STEPS:
                    raise RunEnded("gave_up", f"gave up after {MAX_STEPS} steps")
                if not self.act() and not self.happenings.wait(skip=not self._watched):
                    self._conclude()
                    return
        except RunEnded:
            for robot in self.robots.values():
                robot.job = None
            raise

    def act(self) -> bool:
        """Lets robots begin what they may, and time pass for a tick; False where nothing is to be done."""
        self._fleet_actor.dispatch()
        if not any(robot.job is not None and not robot.out for robot in self.robots.values()):
            return False
        self._fleet.tick()
        return True

    @property
    def at_rest(self) -> bool:
        """Does the same as `Run.at_rest`."""
        return all(robot.action is None for robot in self.robots.values())

    def heed(self) -> None:
        """Does the same as `Run.heed`."""
        self._minds.give_up()

    def break_off(self) -> None:
        """Does the same as `Run.break_off`; whoever is out goes on with the job that is kept for it."""
        assert isinstance(self.world, FleetWorld)
        for name, robot in self.robots.items():
            if not robot.out:
                robot.job = None
                robot.ongoing.action, robot.ongoing.abandoned = None, False
                robot.saying, self.world.hands[name].walks = "", False
        self.shown.banner = ""

    def put_robots(self, state: State) -> None:
        """Does the same as `Run.put_robots`; whoever is out stays where it stands."""
        for name, node in state.stations().items():
            if not self.robots[name].out:
                self.robots[name].put(self.room.nodes[node])

    def acting(self) -> tuple[Action, ...]:
        """Does the same as `Run.acting`."""
        return tuple(each.action for each in self.robots.values() if each.action is not None)

    def acting_of(self, robot: str) -> Action | None:
        """As `Run.acting_of`."""
        return self.robots[robot].action

    def let_fail(self, robot: str, why: str) -> None:
        """As `Run.let_fail`."""
        self.robots[robot].ongoing.let_fail(why)

    def shown_robots(self) -> tuple[ShownRobot, ...]:
        """Does the same as `Run.shown_robots`."""
        assert isinstance(self.world, FleetWorld)
        hands = self.world.hands
        return tuple(
            ShownRobot(name, robot.pose, hands[name].load, robot.saying)
            for name, robot in self.robots.items()
        )
