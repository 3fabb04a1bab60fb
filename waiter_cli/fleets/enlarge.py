"""A problem for one robot with more robots: `Problem` → `Problem`. Entry point `with_robots`."""

from __future__ import annotations

from dataclasses import replace

from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.graph import distances
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Robot, State

__all__ = ["with_robots"]


def with_robots(problem: Problem, count: int) -> Problem:
    """Returns the problem with ``count`` robots; with as many as it has it is the same.

    The first ones are those that were there, with all that they have.  Further ones start on the
    nodes nearest to the first on which nobody stands, now or by the timetable.  Raises `InputError`
    where there are too few such nodes, or where one that is left out has, or is wanted for, something.
    """
    crew = problem.state.crew()
    if count == len(crew):
        return problem
    robots = (
        crew[:count] if count < len(crew) else (*_named(problem, count), *_fresh(problem, count))
    )
    for robot in crew[count:]:
        _can_be_spared(problem, robot)

    def manned(one: State) -> State:
        return replace(
            one, agent="", with_agent=(), carrying=None, ordered=frozenset(), robots=robots
        )

    agents = tuple((robot.name, robot.at) for robot in robots)
    spared = {robot.name for robot in crew[count:]}
    seen = tuple(one for one in problem.observations if one.arguments[0] not in spared)
    return replace(
        problem,
        observations=seen,
        layout=replace(problem.layout, agents=agents, agent=agents[0][1]),
        state=manned(problem.state),
        before_observations=manned(problem.before_observations),
    )


def _named(problem: Problem, count: int) -> tuple[Robot, ...]:
    """Returns the robots that were there; a single one without a name gets one."""
    crew = problem.state.crew()
    if problem.layout.agents:
        return crew
    return (replace(crew[0], name=_names(problem, 1 + count)[0]),)


def _fresh(problem: Problem, count: int) -> tuple[Robot, ...]:
    """Returns the robots that are missing for ``count``, with places to start from."""
    layout, state = problem.layout, problem.state
    crew = _named(problem, count)
    here = {robot.at for robot in crew}
    taken = {node for _, node in state.waiters} | {node for _, _, node in layout.timetable} | here
    near = distances(layout.joined(), crew[0].at, {node for _, node in state.waiters})
    free = [node for node in near if node not in taken]
    if len(free) < count - len(crew):
        places = dict(layout.key_where)
        where = places.get("agents") or places.get("agent") or Where(layout.file or layout.name)
        message = f"there is no place for {count} robots: {len(free) + len(crew)} nodes are free"
        raise InputError([Fault(where, message, "compare fewer, or add nodes")])
    known = {robot.name for robot in crew}
    names = [name for name in _names(problem, count + len(crew)) if name not in known]
    return tuple(Robot(name, node) for name, node in zip(names, free[: count - len(crew)]))


def _can_be_spared(problem: Problem, robot: Robot) -> None:
    """Raises `InputError` where a robot that is to be left out is needed."""
    goals = (*problem.goals, *(goal for pair in problem.before for goal in pair))
    wanted = next((goal for goal in goals if goal.robot == robot.name), None)
    where = None if wanted is None else wanted.where
    if wanted is not None:
        why = f"{robot.name} is wanted at {wanted.node}"
    elif robot.leads or robot.carries or robot.orders:
        why = f"{robot.name} has something to do in the state"
        where = dict(problem.state_where).get("agents")
    else:
        return
    fault = Fault(
        where or Where(problem.scenario_file or "--agents"), why, "compare with more robots"
    )
    raise InputError([fault])


def _names(problem: Problem, count: int) -> list[str]:
    """Returns r1, r2, …, or robot1, robot2, … where something else is called so."""
    layout, state = problem.layout, problem.state
    taken = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    taken |= {who for who, _ in state.waiters} | {name for p in state.parties() for name in p}
    for prefix in ("r", "robot", "robot_"):
        names = [f"{prefix}{k + 1}" for k in range(count)]
        if not taken.intersection(names):
            return names
    raise InputError("no names are left for robots", "rename what is called r1 and robot1")
