"""Plays a plan by the rules of the restaurant, without any ASP: `Problem`, `Plan` → `Verdict`.

Entry point `run`.  What one step may do is said in `rules`, whose functions can be had from here
too; this module plays a plan through and judges it: every step possible, every goal reached, each
wish before the other.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.plan import Action, Plan
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, State
from waiter_cli.model.wording import goal_text
from waiter_cli.rules.actions import Illegal
from waiter_cli.rules.rulebook import HOUSE, Rulebook

__all__ = ["Misstep", "Verdict", "run"]


@dataclass(frozen=True)
class Misstep:
    """The step at which a plan goes wrong, the action (None: an idle step), and why."""

    step: int
    action: Action | None
    message: str


@dataclass(frozen=True)
class Verdict:
    """The verdict on a plan.

    ``states`` holds the states at steps 0, 1, … as far as the plan could be played; ``makespan``
    is the first step at which all goals held in the wanted order, None when there was none;
    ``misstep`` is the first action or idle step that was not possible; ``unmet`` says which wishes
    the last state leaves open; ``notes`` are remarks that do not make the plan invalid.
    """

    states: tuple[State, ...]
    makespan: int | None
    misstep: Misstep | None = None
    unmet: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def valid(self) -> bool:
        """Returns whether every step was possible and every wish is fulfilled at the end."""
        return self.misstep is None and not self.unmet

    @property
    def final_state(self) -> State:
        """Returns the last state that was reached."""
        return self.states[-1]

    @property
    def reasons(self) -> tuple[str, ...]:
        """Returns why the plan is invalid; empty when it is valid."""
        if self.misstep is not None:
            return (f"step {self.misstep.step}: {self.misstep.message}",)
        return self.unmet


def run(problem: Problem, plan: Plan, rules: Rulebook = HOUSE) -> Verdict:
    """Plays ``plan`` from the problem's state by ``rules`` and judges it; steps without an action are idle.

    The plan ends at its horizon.  Goals must hold there, and each pair of ``before`` must have
    come about in its order by then.
    """
    try:
        states = [rules.begin(problem)]
    except Illegal as fault:
        return Verdict((problem.state,), None, Misstep(0, None, fault.reason))
    misstep = _bad_order(plan, together=bool(problem.layout.agents))
    due: dict[int, list[Action]] = {}
    for action in plan.actions if misstep is None else ():
        due.setdefault(action.step, []).append(action)
    for step in range(plan.horizon if misstep is None else 0):
        actions = due.get(step, [])
        try:
            states.append(rules.after(problem, states[-1], actions, step))
        except Illegal as fault:
            misstep = Misstep(step, actions[0] if actions else None, fault.reason)
            break
    return _judge(problem, tuple(states), misstep, rules)


def _bad_order(plan: Plan, together: bool = False) -> Misstep | None:
    """Returns the first action whose step is negative, taken already, or past the end."""
    last = -1
    for action in plan.actions:
        if action.step < 0:
            return Misstep(action.step, action, f"{action.text}: steps count from 0")
        if action.step == last and not together:
            return Misstep(last, action, f"{action.text}: there is another action at this step")
        if action.step < last:
            return Misstep(action.step, action, f"{action.text}: it is listed after step {last}")
        if action.step >= plan.horizon:
            return Misstep(
                action.step, action, f"{action.text}: the plan ends at step {plan.horizon}"
            )
        last = action.step
    return None


def _judge(
    problem: Problem, states: tuple[State, ...], misstep: Misstep | None, rules: Rulebook
) -> Verdict:
    holds = rules.holds
    first: dict[Goal, int] = {}
    makespan = None
    for step, state in enumerate(states):
        for pair in problem.before:
            for goal in pair:
                if goal not in first and holds(goal, state, problem):
                    first[goal] = step
        met = all(holds(goal, state, problem) for goal in problem.goals)
        if makespan is None and met and not any(_late(first, *pair) for pair in problem.before):
            makespan = step
    unmet = [
        f"the goal {goal_text(goal)} does not hold at the end (step {len(states) - 1})"
        for goal in problem.goals
        if not holds(goal, states[-1], problem)
    ]
    unmet += [late for pair in problem.before if (late := _late(first, *pair))]
    notes = []
    if misstep is None and not unmet and makespan is not None and makespan < len(states) - 1:
        notes.append(f"not minimal: the goals hold already at step {makespan}")
    return Verdict(states, makespan, misstep, tuple(unmet), tuple(notes))


def _late(first: dict[Goal, int], early: Goal, late: Goal) -> str | None:
    """Returns why ``early`` has not held before ``late``, by the steps at which they first held."""
    for goal in (early, late):
        if goal not in first:
            return f"{goal_text(goal)} was wanted in a certain order and never held"
    if first[early] < first[late]:
        return None
    return (
        f"{goal_text(early)} (first at step {first[early]}) was wanted before "
        f"{goal_text(late)} (first at step {first[late]})"
    )
