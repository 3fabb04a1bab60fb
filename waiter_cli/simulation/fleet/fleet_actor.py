"""Carries out the actions of several robots, tick by tick, and checks each. Class `FleetActor`."""

from __future__ import annotations

from collections.abc import Generator
from random import Random
from typing import Any

from waiter_cli.execution.precedence import robot_of
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Party
from waiter_cli.model.wording import describe
from waiter_cli.room.motion import gesture, way, write_script
from waiter_cli.room.room import Room
from waiter_cli.simulation.acting import MAX_FAILURES, NEAR_ENOUGH, details_of, wrong_seats
from waiter_cli.simulation.blocks import Blocks
from waiter_cli.simulation.body import AT_REST, Shown, SimulatedClock
from waiter_cli.simulation.driver import PATIENCE
from waiter_cli.simulation.fleet.fleet_bodies import FleetBody, Job, RobotBody
from waiter_cli.simulation.fleet.fleet_crowd import FleetCrowd
from waiter_cli.simulation.fleet.fleet_mind import FleetDeliberation, FleetReporter
from waiter_cli.simulation.fleet.fleet_world import FleetWorld
from waiter_cli.simulation.outcome import EVENT_OF, BlockedEdge, Rules, RunEnded, ShownAction, words
from waiter_cli.simulation.world import Violation

__all__ = ["FleetActor"]


class FleetActor:
    """Has robots begin what they may begin, and carries it out.  ``slip`` is the probability of an action in vain."""

    def __init__(
        self,
        room: Room,
        rules: Rules,
        slip: float,
        *,
        clock: SimulatedClock,
        fleet: FleetBody,
        world: FleetWorld,
        crowd: FleetCrowd,
        blocks: Blocks,
        deliberation: FleetDeliberation,
        reporter: FleetReporter,
        shown: Shown,
    ) -> None:
        self._room, self._rules, self._slip = room, rules, slip
        self._clock, self._fleet, self._world, self._crowd = clock, fleet, world, crowd
        self._blocks, self._deliberation = blocks, deliberation
        self._reporter, self._shown = reporter, shown
        self._rng = Random(f"slip {rules.seed}")

    @property
    def done(self) -> int:
        """Returns how many actions were done."""
        return sum(robot.done for robot in self._fleet.robots.values())

    @property
    def failed(self) -> int:
        """Returns how many actions failed."""
        return sum(robot.failed for robot in self._fleet.robots.values())

    def dispatch(self) -> None:
        """Has every robot begin that may.

        Those who enter each other's nodes round a ring begin together, or not yet.
        """
        mind = self._deliberation.fleet_mind
        for _, action in mind.decision.next or ():
            together = mind.mates(action) if action.name == "go_to" else (action,)
            robots = [self._fleet.robots[robot_of(each)] for each in together]
            if any(robot.job or robot.out for robot in robots):
                continue
            for robot, each in zip(robots, together):
                self._begin(robot, each)

    def _begin(self, robot: RobotBody, action: Action) -> None:
        robot.ongoing.begin(action)
        robot.deed = ShownAction(action.step, action.text, "now")
        self._shown.deeds.append(robot.deed)
        self._reporter.say_of(robot, "action_start", action=action.text)
        self._deliberation.fleet_mind.started_by(robot.name, action.step)
        robot.job = self._carry_out(robot, action)

    def _carry_out(self, robot: RobotBody, action: Action) -> Job:
        """Does an action from its beginning to what comes of it."""
        wrong = self._world.breach(action)
        walks = action.name == "go_to"
        if wrong is not None and not (walks and wrong.check == "shared_node"):
            yield from self._refuse(robot, action, wrong)
            return
        if self._slip and self._rng.random() < self._slip:
            self._reporter.say_of(robot, "injected", kind="slip", action=action.text)
            yield from self._glide(robot, gesture(robot.pose, 1.0))
            yield from self._fail(robot, action, "slipped, without effect")
            return
        hands = self._world.hands[robot.name]
        hands.walks = walks
        home = hands.node
        why = yield from self._drive(robot, home, action) if walks else self._act(robot, action)
        if why is None:
            wrong = self._world.breach(action)
            why = wrong.reason if wrong is not None else None
        if why is None:
            why = self._succeed(robot, action)
        if why is None:
            return
        if walks:
            yield from self.back_to(robot, home)
        hands.walks = False
        yield from self._fail(robot, action, why)

    # ------------------------------------------------------------ motion

    def _glide(
        self, robot: RobotBody, move: Any, ahead: Any = None, heeds: bool = True
    ) -> Generator[None, None, str | BlockedEdge | None]:
        def held_up(pose: Any) -> str | None:
            return self._fleet.held_up(robot, pose)

        return (yield from robot.glide(move, held_up, ahead, heeds=heeds))

    def _drive(
        self, robot: RobotBody, here: str, action: Action
    ) -> Generator[None, None, str | BlockedEdge | None]:
        """Drives to a neighbour node; returns why it did not get there."""
        goal = action.arguments[1]

        def ahead() -> BlockedEdge | None:
            return self._blocks.ahead(here, goal, robot)

        block: str | BlockedEdge | None = self._blocks.on(here, goal)
        while block is None:
            for move in way(robot.pose, self._room.nodes[goal], self._rules.speed):
                block = yield from self._glide(robot, move, ahead if move.kind == "drive" else None)
                if block is not None:
                    break
            else:
                if self._rules.drive == "physics":
                    yield from robot.come_to_rest(self._room.nodes[goal])
                return None
            if isinstance(block, BlockedEdge) and self._rules.on_failure == "wait":
                block = yield from self._wait_for(robot, block)
        if isinstance(block, BlockedEdge):
            if self._rules.on_failure == "wait":
                why = yield from self._wait_for(robot, block)
                return why or (yield from self._drive(robot, here, action))
            answer = self._rules.on_failure
            self._meet(robot, block, answer)
        return block

    def _meet(self, robot: RobotBody, block: BlockedEdge, answer: str) -> None:
        block.told = True
        edge = "-".join(block.edge)
        self._reporter.say_of(robot, "blocked", edge=edge, by=block.name, answer=answer)

    def _wait_for(self, robot: RobotBody, block: BlockedEdge) -> Generator[None, None, str | None]:
        """Waits until an edge is clear; returns why no longer."""
        self._meet(robot, block, "wait")
        began = self._clock.time
        while block.standing:
            yield
            if robot.ongoing.abandoned:
                return "the plan has changed"
            if self._clock.time - began > PATIENCE:
                edge = "-".join(block.edge)
                raise RunEnded("gave_up", f"gave up: {edge} stayed blocked for {PATIENCE:.0f} s")
        return None

    def back_to(self, robot: RobotBody, node: str) -> Job:
        """Drives back to a node, whatever comes."""
        at = self._room.nodes[node]
        physics = self._rules.drive == "physics"
        while robot.away(at) > (AT_REST if physics else 1e-6):
            for move in way(robot.pose, at, self._rules.speed):
                if (yield from self._glide(robot, move, heeds=False)) is not None:
                    break
            if physics:
                yield from robot.come_to_rest(at)

    def _act(self, robot: RobotBody, action: Action) -> Generator[None, None, str | None]:
        """Plays a gesture; returns why it came to nothing."""
        for move in write_script(action, robot.pose, self._room, self._rules.speed):
            if move.kind == "gesture":
                robot.saying = words(action)
                if action.name == "seat":
                    self._crowd.who = self._world.who = robot.name
                    chairs = self._room.chairs[action.arguments[2]]
                    seconds = self._crowd.sit(self._world.led, chairs)
                    move = gesture(robot.pose, max(move.seconds, seconds + 0.4))
            ended = yield from self._glide(robot, move)
            if ended is not None:
                robot.saying = ""
                if action.name == "seat":  # whoever is still here follows on
                    self._follow(robot, self._world.hands[robot.name].led)
                return str(ended)
        robot.saying = ""
        return None

    def _follow(self, robot: RobotBody, party: Party) -> None:
        self._crowd.who = robot.name
        self._crowd.follow([name for name in party if name in self._crowd.people], robot.pose)

    # ------------------------------------------------------------ outcomes

    def _refuse(self, robot: RobotBody, action: Action, wrong: Violation) -> Job:
        """An action that cannot be done now fails at once: a fault, unless nobody believes that it can."""
        if self._deliberation.believes(action):
            self._reporter.say_of(
                robot, "precondition_failed", action=action.text, check=wrong.check,
                reason=wrong.reason,
            )  # fmt: skip
            self._reporter.fail(wrong)
        yield from self._fail(robot, action, wrong.reason)

    def _succeed(self, robot: RobotBody, action: Action) -> str | None:
        """The action has its effects; returns why they are not believed."""
        revision = self._deliberation.mind.decision.revision
        party = self._world.party_of(action.arguments[1]) or ()
        why = self._deliberation.done_by(robot.name, action.step)
        if why is not None:
            return why
        self._world.perform(action)
        details = self._arrive(robot, action, party)
        self._reporter.say_of(robot, EVENT_OF[action.name], **details)
        if (wrong := self._world.disorder()) is not None:
            self._reporter.fail(wrong)
        self._deliberation.compare()
        self._reporter.say_of(robot, "action_end", action=action.text)
        if robot.deed is not None:
            robot.deed.state = "done"
        robot.ongoing.action, robot.failed_in_a_row = None, 0
        robot.done += 1
        self._deliberation.tell(revision, "the plan goes on otherwise")
        return None

    def _arrive(self, robot: RobotBody, action: Action, party: Party) -> dict[str, Any]:
        """Moves people as the effects have them move; returns the details of the event."""
        match action.name, action.arguments:
            case "go_to", (_, node):
                error = robot.away(self._room.nodes[node])
                if error > NEAR_ENOUGH[self._rules.drive]:
                    beside = f"{robot.name} is {error:.3f} m beside {node} at arrival"
                    self._reporter.fail(Violation("arrival", beside))
                return {"node": node, "error_m": round(error, 3)}
            case "pick", _:
                self._follow(robot, party)
            case "seat", (_, _, table):
                wrong = wrong_seats(self._room, self._world, self._crowd, party, table)
                if wrong is not None:
                    self._reporter.fail(wrong)
        return details_of(action, party, self._room, self._world)

    def _fail(self, robot: RobotBody, action: Action, why: str | BlockedEdge) -> Job:
        """An action failed: the run stops, or the rest is planned anew."""
        shut = why if isinstance(why, BlockedEdge) else None
        reason = why if isinstance(why, str) else f"{'-'.join(why.edge)} is blocked"
        self.note_failure(robot, action, reason)
        if self._rules.on_failure == "stop":
            raise RunEnded("failed", f"{action.text} failed: {reason}")
        if robot.failed_in_a_row >= MAX_FAILURES:
            message = f"gave up after {MAX_FAILURES} failures of {robot.name} in a row: {reason}"
            raise RunEnded("gave_up", message)
        revision = self._deliberation.mind.decision.revision
        self._deliberation.failed_by(robot.name, action.step, reason, shut)
        self._deliberation.compare()
        self._deliberation.tell(revision, reason)
        yield from robot.rest(0.8)
        self._shown.banner = ""

    def note_failure(self, robot: RobotBody, action: Action, reason: str) -> None:
        """Says that an action of a robot failed, and counts it."""
        robot.failed += 1
        robot.failed_in_a_row += 1
        robot.saying = ""
        if robot.deed is not None:
            robot.deed.state = "failed"
        self._reporter.say_of(robot, "action_failed", action=action.text, reason=reason)
        robot.ongoing.action = None
        can = describe(action, self._deliberation.mind.state)
        self._shown.banner = f"{robot.name} could not {can}: {reason}"
