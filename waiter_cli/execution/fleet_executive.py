"""Lets several robots act on one plan, each at its own pace. Class `FleetExecutive`.

As `waiter_cli.execution.executive`, but that each robot begins and ends its actions by itself, in the order of
precedence of the joint plan (`waiter_cli.execution.precedence`); ``Decision.next`` says what each one may
begin now.  When something comes between, what runs is taken to end well, and the rest is planned anew from
there; whoever runs keeps the nodes that it leaves and enters until it is done, so nobody meets.

A robot that is out stands where it is, as a colleague would, and what it leads, carries or has noted
down must wait until it is back.

Steps count on: a new plan's are greater than all that were used before.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from waiter_cli.execution.agenda import (
    Pending,
    PlannerAnswer,
    Selection,
    Wanted,
    choose,
    still_pending,
)
from waiter_cli.execution.decision import Decision, Refused
from waiter_cli.execution.executive import Executive
from waiter_cli.execution.precedence import Precedence, order_of, robot_of
from waiter_cli.execution.protocols import PlannerProtocol
from waiter_cli.model.layout import Layout
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem, Reason
from waiter_cli.model.state import Goal, Observation, State
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.validator import run
from waiter_cli.spelling import did_you_mean

__all__ = ["FleetExecutive", "thinking_together"]


class FleetExecutive(Executive):
    """The believed state of one run with several robots, what is wanted in it, and the plan."""

    moving: tuple[Action, ...] = ()
    """The actions that were reported to have begun, and not yet to be over."""
    finished: tuple[Action, ...] = ()
    """Actions that are over, but have their effect together with others that are not."""
    out: tuple[str, ...] = ()
    """The robots that stand still until they are back."""
    halted: tuple[tuple[str, str], ...] = ()
    """Robots that went out on their way to a node, and that node: nobody comes there."""
    used: int = -1
    """The greatest number of a step that was done, that failed or that runs."""

    # ------------------------------------------------------------ events

    def observe(self, seen: Sequence[Observation], *, plan: bool = True) -> Decision:
        """Does the same as `Executive.observe`; a robot that is seen somewhere no longer walks."""
        for one in seen:
            if one.kind == "at" and (action := self._of(one.arguments[0], self.moving)) is not None:
                message = f"{one.arguments[0]} is at step {action.step}: {action.text}"
                raise Refused(message, "report it done or failed first")
        self._settle_over()
        moved = {o.arguments[0] for o in seen if o.kind == "at"}
        self.halted = tuple(each for each in self.halted if each[0] not in moved)
        return super().observe(seen, plan=plan)

    def started_by(self, robot: str, step: int, *, plan: bool = True) -> Decision:
        """Notes that the action of a robot at ``step`` is running."""
        action = self._must_be_next_of(robot, step)
        if action in self.moving:
            raise Refused(f"{robot}: step {step} is running already", "report it done or failed")
        self._must_be_ready(action)
        self.moving = (*self.moving, action)
        self.used = max(self.used, step)
        self._diagnosis = ()
        return self._on(plan)

    def done_by(self, steps: Mapping[str, int], *, plan: bool = True) -> Decision:
        """Believes that these robots have done their actions, with their effects."""
        actions = [self._must_be_next_of(robot, step) for robot, step in steps.items()]
        order = self._order()
        for action in sorted(actions, key=order.actions.index):
            self._done(action)
        self._diagnosis = ()
        return self._on(plan)

    def failed_by(self, robot: str, step: int, reason: str = "", *, plan: bool = True) -> Decision:
        """Believes that the action of a robot had no effect; its number is used up."""
        action = self._must_be_next_of(robot, step)
        if action in self.finished:
            raise Refused(f"{robot}: step {step} was done", "report what was observed since")
        self._drop(action)
        self.used = max(self.used, step)
        self.planned = None
        self._diagnosis = ()
        return self._decided(plan)

    def take_out(self, robot: str, *, plan: bool = True) -> Decision:
        """Believes that a robot stands where it is until it is back."""
        self._must_be_known(robot)
        if robot in self.out:
            raise Refused(f"{robot} is out already", f'tell {{"back": "{robot}"}} once it is not')
        action = self._of(robot, self.moving)
        if action is not None and not self._in_a_ring(action):
            if action.name == "go_to":
                self.halted = (*self.halted, (robot, action.arguments[1]))
            self._drop(action)
        self.out = (*self.out, robot)
        self.planned = None
        return self._decided(plan)

    def bring_back(self, robot: str, *, plan: bool = True) -> Decision:
        """Believes that a robot acts again; it is where it was, unless it was seen elsewhere."""
        self._must_be_known(robot)
        if robot not in self.out:
            raise Refused(f"{robot} is not out", "nothing has changed")
        self.out = tuple(name for name in self.out if name != robot)
        self.halted = tuple(each for each in self.halted if each[0] != robot)
        self.planned = None
        return self._decided(plan)

    def _done(self, action: Action) -> None:
        if action not in self.moving:
            self._must_be_ready(action)
            self.used = max(self.used, action.step)
            self.moving = (*self.moving, action)
        group = self._order().groups[action]
        together = (*self.finished, action)
        whole = set(group) <= set(together)
        if not whole and action.name == "go_to":
            self.finished = together
            return
        over = [each for each in group if each in together]
        after = self._after(self.state, over)
        if isinstance(after, Illegal):
            hint = "report it failed, or what was observed first"
            raise Refused(f"step {action.step} cannot be done: {after.reason}", hint)
        if not whole:
            self.finished = together
            return
        self._take_effect(over)
        if not self._track:
            self.planned = None  # what is wanted by now may be more

    def _drop(self, action: Action) -> None:
        """Forgets an action without effect; those that had theirs together with it, and are over, have it."""
        group = self._order().groups[action]
        over = tuple(each for each in group if each in self.finished)
        if self._take_effect(over) is not None:
            names = " and ".join(robot_of(each) for each in over)
            raise Refused(
                f"{robot_of(action)} cannot have stayed: {names} came to where it was",
                "report where each of them is with at",
            )
        self._forget(action)

    def _settle_over(self) -> None:
        """Has deeds that are over take effect before something else is seen; rings of walks still wait."""
        for action in self.finished:
            if action.name != "go_to" and action in self.finished:
                over = [each for each in self._order().groups[action] if each in self.finished]
                self._take_effect(over)

    def _take_effect(self, over: Sequence[Action]) -> str | None:
        """Believes the effects of actions that are over; returns why they cannot be, None where they are."""
        after = self._after(self.state, over)
        if isinstance(after, Illegal):
            return after.reason
        for each in over:
            self._forget(each)
        self.belief = replace(self.belief, state=after)
        self._notice()
        return None

    def _in_a_ring(self, action: Action) -> bool:
        """Returns whether others are over with what they did together: then it has left its node, too."""
        group = self._order().groups[action]
        return action.name == "go_to" and any(each in self.finished for each in group)

    def _ring_begins(self, action: Action) -> bool:
        """Returns whether others have not begun yet who are to set out together with it."""
        return any(each not in self.moving for each in self._order().groups[action])

    def _forget(self, action: Action) -> None:
        self.moving = tuple(each for each in self.moving if each != action)
        self.finished = tuple(each for each in self.finished if each != action)
        self._track = tuple(each for each in self._track if each != action)

    # ------------------------------------------------------------ who may do what

    def mates(self, action: Action) -> tuple[Action, ...]:
        """Returns the actions that have their effect together with one that may begin, itself among them."""
        return self._order().groups[action]

    def possible(self, action: Action) -> bool:
        """Returns whether an action alone could be done in what is believed."""
        return not isinstance(self._after(self.state, (action,)), Illegal)

    def _order(self) -> Precedence:
        return order_of(self._track, self.state, self.layout, self.moving)

    def _of(self, robot: str, actions: Sequence[Action]) -> Action | None:
        return next((each for each in actions if robot_of(each) == robot), None)

    def _must_be_known(self, robot: str) -> None:
        names = [each.name for each in self.state.robots]
        if robot not in names:
            raise Refused(f"unknown robot {robot}", did_you_mean(robot, names))

    def _must_be_next_of(self, robot: str, step: int) -> Action:
        self._must_be_known(robot)
        if robot in self.out:
            raise Refused(f"{robot} is out", f'tell {{"back": "{robot}"}} first')
        action = self._of(robot, self.moving) or self._of(robot, self._track)
        if action is None:
            raise Refused(f"{robot} has nothing to do at step {step}", "ask for the plan")
        if action.step != step:
            message = f"step {step} of {robot} is out of order"
            raise Refused(message, f"its next step is {action.step}: {action.text}")
        return action

    def _must_be_ready(self, action: Action) -> None:
        order = self._order()
        waits = order.waits[action]
        if waits:
            first = min(waits, key=order.actions.index)
            robot = robot_of(action)
            message = (
                f"{robot} cannot be at step {action.step} yet: it has to wait for {first.text}"
            )
            raise Refused(message, f"report step {first.step} of {robot_of(first)} first")

    def _after(self, state: State, actions: Sequence[Action]) -> State | Illegal:
        """Returns the state once some robots have done these, all at once; or why that cannot be."""
        if not actions:
            return state
        try:
            return self.belief.rules.after(self.belief.world(), state, tuple(actions), 0)
        except Illegal as fault:
            return fault

    # ------------------------------------------------------------ deciding

    def ahead(self) -> tuple[State, tuple[Action, ...]]:
        """Returns the state once all that runs is over, and what of it cannot end well any more."""
        state, lost = self.state, []
        order = order_of(self.moving, self.state, self.layout, self.moving)
        todo = list(order.actions)
        while todo:
            group = [each for each in order.groups[todo[0]] if each in todo]
            todo = [each for each in todo if each not in group]
            after = self._after(state, group)
            if isinstance(after, Illegal):
                lost += group
            else:
                state = after
        return state, tuple(lost)

    def decide(self) -> Decision:
        """Does the same as `Executive.decide`: what was planned is kept while nothing has changed."""
        base, lost = self.ahead()
        wanted = self._held_up(self._agenda.wanted(base, self.layout), base)
        self._agenda = self._agenda.aged(wanted)
        if self.planned is not None and all(self._ring_begins(action) for action in lost):
            return self._on(True)
        start = self.used + 1
        if not self._crew(base):
            return self._nobody(wanted, start)

        def pose(some: Wanted) -> Problem:
            return self._pose(some, start, base)

        rest = None if lost else self.remainder(start)
        choice = choose(wanted, pose, self._planner, self._impossible)
        plan = choice.answer.plan
        if rest is not None and choice.answer.status != "no_plan":
            no_longer = plan is None or rest.horizon <= plan.horizon
            if no_longer and self._leads_there(choice.problem, rest):
                return self._keep(choice, start, rest)
        return self._settle(choice, start, plan, lost[0] if lost else None)

    def _keep(self, choice: Selection, start: int, rest: Plan) -> Decision:
        """Goes on with what was planned, which is as short as anything else; its steps keep their numbers."""
        answer = choice.answer
        best = answer.plan is not None and answer.plan.horizon == rest.horizon
        self.planned = choice.problem
        known = PlannerAnswer(
            answer.status, rest, answer.minimal and best, answer.reasons, answer.limit
        )
        return self._told(Selection(choice.problem, known, choice.pending), self.decision.revision)

    def _settle(
        self, choice: Selection, start: int, found: Plan | None, abandoned: Action | None
    ) -> Decision:
        """Makes the choice the decision of this moment."""
        old, end = self._track, start
        new = () if found is None else found.actions
        if found is not None:
            end = start + found.horizon
        self._track = (*self.moving, *(replace(each, step=each.step + start) for each in new))
        same = [(each.name, each.arguments) for each in old] == [
            (each.name, each.arguments) for each in self._track
        ]
        self._end = self._announced_end = end
        self.planned = choice.problem
        return self._told(choice, self.decision.revision + (not same), abandoned)

    def _told(self, choice: Selection, revision: int, abandoned: Action | None = None) -> Decision:
        answer = choice.answer
        status, reasons = answer.status, answer.reasons
        if not (choice.problem.goals or choice.problem.before) and choice.pending:
            reasons = tuple(dict.fromkeys(r for p in choice.pending for r in p.reasons))
            status = "no_plan"
        self.decision = Decision(
            revision, minimal=answer.minimal and status == "plan", status=status, reasons=reasons,
            limit=answer.limit, pending=choice.pending, diagnosis=self._diagnosis,
            closed=self._closed, abandoned=abandoned,
        )  # fmt: skip
        self._closed = ()
        return self._on(True)

    def _nobody(self, wanted: Wanted, start: int) -> Decision:
        """Decides where every robot is out: everything must wait."""
        reason = Reason("every robot is out")
        pending = wanted.waiting + tuple(
            Pending(goal, (reason,)) for goal in (*wanted.must, *wanted.wishes)
        )
        problem = self._pose(Wanted(everybody=wanted.everybody), start, self.state)
        answer = PlannerAnswer("no_plan", reasons=(reason,))
        return self._settle(Selection(problem, answer, pending), start, None, None)

    def _on(self, plan: bool) -> Decision:
        """Returns the decision as it stands: what is left of the plan, and who may do what."""
        if not plan:
            return self.decision
        if self.planned is None:
            return self.decide()
        order = self._order()
        first = min((each.step for each in self._track), default=self.used + 1)
        last = max((each.step for each in self._track), default=first - 1)
        self.belief = replace(self.belief, step=first)
        self.decision = replace(
            self.decision,
            plan=tuple(sorted(self._track, key=lambda each: each.step)),
            horizon=max(0, last + 1 - first),
            next=tuple((robot_of(each), each) for each in order.ready(self.moving)),
            out=self.out,
            diagnosis=self._diagnosis,
        )
        return self.decision

    def remainder(self, start: int) -> Plan | None:
        """Returns what is left of the plan beside what runs, put back into steps from 0."""
        base, _ = self.ahead()
        rest = tuple(each for each in self._track if each not in self.moving)
        return order_of(rest, base, self.layout).levelled()

    def adopt(self, decision: Decision) -> None:
        """Does the same as `Executive.adopt`."""
        base, _ = self.ahead()
        wanted = self._held_up(self._agenda.wanted(base, self.layout), base)
        self._agenda = self._agenda.aged(wanted)
        kept, _ = still_pending(wanted, decision.pending)
        self.planned = self._pose(kept, self.used + 1, base)
        self._track = decision.plan
        self.decision = decision
        self._closed = ()
        self._on(True)

    def resume_fleet(
        self,
        moving: Sequence[Action],
        finished: Sequence[Action],
        out: Sequence[str],
        halted: Sequence[tuple[str, str]],
        used: int,
    ) -> None:
        """Takes over what the robots of another run are at; before `Executive.resume`."""
        self.moving, self.finished, self.out = tuple(moving), tuple(finished), tuple(out)
        self.halted, self.used = tuple(halted), used

    def _pose(self, wanted: Wanted, start: int, base: State) -> Problem:
        """Does the same as `Executive._pose`, for the robots that are not out."""
        problem = super()._pose(wanted, 0, base)
        layout, state = self._without_lost(problem.layout, base)
        return replace(problem, layout=layout, state=state, before_observations=state)

    def _crew(self, state: State) -> tuple[str, ...]:
        return tuple(robot.name for robot in state.robots if robot.name not in self.out)

    def _without_lost(self, layout: Layout, state: State) -> tuple[Layout, State]:
        """Returns restaurant and state in which robots that are out are colleagues who stand still."""
        if not self.out:
            return layout, state
        lost = tuple((robot.name, robot.at) for robot in state.robots if robot.name in self.out)
        waiters = tuple(sorted((*state.waiters, *lost)))
        crew = tuple(robot for robot in state.robots if robot.name not in self.out)
        shut = {node for _, node in self.halted}
        edges = tuple(edge for edge in layout.edges if not shut & set(edge))
        state = replace(state, waiters=waiters, robots=crew)
        layout = replace(
            layout, agents=tuple(pair for pair in layout.agents if pair[0] not in self.out),
            waiters=tuple(sorted((*layout.waiters, *lost))), edges=edges,
        )  # fmt: skip
        if len(edges) < len(self.layout.edges):
            layout = replace(layout, edge_where=())
        return layout, state

    def _held_up(self, wanted: Wanted, state: State) -> Wanted:
        """Returns the wishes, those that only a robot can fulfil which is out among the waiting ones."""
        if not self.out:
            return wanted
        waiting = list(wanted.waiting)

        def possible(goal: Goal, then: Goal | None = None) -> bool:
            if goal.robot in self.out and state.stations()[goal.robot] == goal.node:
                return False  # it is so, and stays so until the robot is back
            robot = self._held_by(goal, state)
            if robot is None:
                return True
            waiting.append(Pending(goal, (Reason(f"{robot} is out", goal.where),), then))
            return False

        must = tuple(goal for goal in wanted.must if possible(goal))
        wishes = tuple(goal for goal in wanted.wishes if possible(goal))
        before = tuple(
            pair
            for pair in wanted.before
            if possible(*pair)
            and self._held_by(pair[1], state) is None
            and pair[1].robot not in self.out
        )
        return replace(wanted, must=must, wishes=wishes, before=before, waiting=tuple(waiting))

    def _held_by(self, goal: Goal, state: State) -> str | None:
        """Returns the robot that is out without which a goal cannot be reached, as far as that is plain."""
        for robot in state.robots:
            if robot.name not in self.out:
                continue
            table = goal.table or (state.table_of(goal.party[0]) if goal.party else None)
            carried = robot.carries is not None and robot.carries[0] == table
            if goal.robot == robot.name and goal.node != robot.at:
                return robot.name
            if goal.party and goal.party[0] in robot.leads:
                return robot.name
            if goal.kind in ("sent", "served", "ordered", "serve") and table in robot.orders:
                return robot.name
            if carried and robot.carries is not None and goal.kind in ("served", "filled", "serve"):
                if goal.item in (None, robot.carries[1]):
                    return robot.name
        return None

    def outlook(self) -> tuple[Problem, Plan, int] | None:
        """Does the same as `Executive.outlook`; the steps count from those that nobody has begun yet."""
        rest = self.remainder(0)
        if self.planned is None or rest is None:
            return None
        base, _ = self.ahead()
        _, state = self._without_lost(self.planned.layout, base)
        problem = replace(self.planned, state=state, before_observations=state)
        return problem, rest, self.step

    def objection(self) -> str | None:
        """Returns why what is left of the plan is not possible, None where it is."""
        base, lost = self.ahead()
        if lost or not self._crew(base) or self.decision.status == "no_plan":
            return None
        rest = self.remainder(0)
        assert rest is not None
        verdict = run(self._pose(Wanted(), 0, base), rest, self.belief.rules)
        return None if verdict.misstep is None else "; ".join(verdict.reasons)


def thinking_together(
    problem: Problem, brain: PlannerProtocol, plan: Plan | None = None
) -> FleetExecutive:
    """Returns the executive for a problem of several robots; it has decided.

    Where a ``plan`` is given, that one is followed until something comes between.
    `waiter_cli.execution.joint_requirements` says for which problems there is one.
    """
    given = [] if plan is None else [PlannerAnswer("plan", plan, False)]

    def planner(posed: Problem) -> PlannerAnswer:
        return given.pop() if given else brain.plan(posed)

    executive = FleetExecutive.of_problem(problem, brain, planner)
    executive.decide()
    return executive
