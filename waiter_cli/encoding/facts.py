"""A problem's state, observations and goals as lines of SPARC: `Problem` → `ProgramLine` …

Entry points `state_facts`, `guest_state`, `observation_facts`, `goal_facts`, `guest_goals`; the small
questions below them are `slots`' too.
"""

from __future__ import annotations

from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import REFILLABLES
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import Goal, Party

__all__ = [
    "ProgramLine", "all_goals", "bills_seen", "entered", "goal_facts", "guest_goals", "guest_state",
    "has_chairs", "objects_of", "observation_facts", "refillables_of", "state_facts", "where_of",
]  # fmt: skip


@dataclass(frozen=True)
class ProgramLine:
    """One line of SPARC made for a problem, and where in the user's files it comes from."""

    text: str
    where: Where | None = None


# ---------------------------------------------------------------- small questions


def objects_of(problem: Problem) -> tuple[str, ...]:
    return problem.layout.objects if problem.layout.bar is not None else ()


def refillables_of(problem: Problem) -> tuple[str, ...]:
    return tuple(item for item in objects_of(problem) if item in REFILLABLES)


def has_chairs(problem: Problem) -> bool:
    capacity = {table.name: table.capacity for table in problem.layout.tables}
    fewer = any(count < capacity[table] for table, count in problem.state.chairs)
    return fewer or any(goal.kind == "chairs" for goal in all_goals(problem))


def all_goals(problem: Problem) -> tuple[Goal, ...]:
    """Returns the goals, then those that only an order names; numbered from 1 in the program."""
    return problem.all_goals()


def entered(problem: Problem) -> list[tuple[Party, Where | None]]:
    """Returns the parties that came in just now and still wait."""
    waiting = set(problem.state.waiting)
    seen = [(o.arguments, o.where) for o in problem.observations if o.kind == "enter"]
    return [(party, where) for party, where in seen if party in waiting]


def bills_seen(problem: Problem) -> dict[str, Where | None]:
    return {
        o.arguments[0]: o.where
        for o in problem.observations
        if o.kind == "bill" and o.arguments[0] in problem.state.wants_bill
    }


def where_of(problem: Problem, key: str) -> Where | None:
    return next((where for name, where in problem.state_where if name == key), None)


# ---------------------------------------------------------------- the situation


def state_facts(problem: Problem, alone: bool = False) -> list[ProgramLine]:
    """Returns the state after the observations, less what the ``observations`` slot makes known.

    ``alone``: every guest for himself, in a domain without parties, orders and objects.
    """
    state = problem.state
    entered_now = {party for party, _ in entered(problem)}
    bills = bills_seen(problem)
    lines: list[ProgramLine] = []

    def holds(fluent: str, key: str) -> None:
        lines.append(ProgramLine(f"holds({fluent}, 0).", where_of(problem, key)))

    def who(party: Party) -> Party:
        return party if alone else party[:1]

    for robot in state.crew():
        holds(f"currentlocation({robot.name}, {robot.at})", "agents" if state.robots else "agent")
    for waiter, node in state.waiters:
        holds(f"currentlocation({waiter}, {node})", "waiters")
    for party in state.parties():
        if party in entered_now:
            continue
        if not alone:
            lines.append(ProgramLine(f"leader({party[0]}).", None))
        for member in party[1:]:
            holds(f"aretogether({party[0]}, {member})", "waiting")
    for table, party in state.seated:
        for member in who(party):
            holds(f"isattable({member}, {table})", "seated")
            if table in state.paid:
                holds(f"haspaid({member})", "paid")
    for party in state.waiting:
        if party not in entered_now:
            for member in who(party):
                holds(f"iswaiting({member})", "waiting")
    for robot in state.crew():
        for member in who(robot.leads):
            holds(f"iswith({robot.name}, {member})", "with_agent")
    for table in sorted(state.wants_bill - bills.keys()):
        holds(f"wantsbill({table})", "wants_bill")
    lines = lines if alone else lines + _service_facts(problem)
    for fluent in state.fluents:
        key = f"fluents.{fluent}"
        holds(fluent, key if where_of(problem, key) else "fluents")
    return lines + [ProgramLine(f"{fact.text}.", fact.where) for fact in problem.facts]


def _service_facts(problem: Problem) -> list[ProgramLine]:
    """Returns the facts of orders, objects and chairs."""
    state, bar = problem.state, problem.layout.bar
    lines: list[ProgramLine] = []

    def holds(fluent: str, key: str) -> None:
        lines.append(ProgramLine(f"holds({fluent}, 0).", where_of(problem, key)))

    if bar is not None:
        for table in sorted(state.ready_to_order):
            holds(f"readytoorder({table})", "ready_to_order")
        for robot in state.crew():
            for table in sorted(robot.orders):
                holds(f"hasorder({robot.name}, {table})", "ordered")
        for fluent, key in (("issent", "sent"), ("isserved", "served")):
            for table in sorted(getattr(state, key)):
                holds(f"{fluent}({table})", key)
        for table, item in sorted(state.ready):
            holds(f"isready({item}, {table})", "ready")
        filled = {robot.carries for robot in state.crew() if robot.at in bar.nodes}
        for table, item in sorted(state.empty - filled):  # what is carried to the bar is full
            holds(f"isempty({item}, {table})", "empty")
        for robot in state.crew():
            if robot.carries:
                table, item = robot.carries
                holds(f"iscarrying({robot.name}, {item}, {table})", "carrying")
    if has_chairs(problem):
        for table, count in state.chairs:
            holds(f"has_chairs({table}, {count})", "chairs")
    return lines


def guest_state(problem: Problem) -> list[ProgramLine]:
    """Returns the state with every guest alone, for a domain without parties.

    Raises `InputError` where the problem has what such a domain has no words for.
    """
    faults = []
    if problem.layout.timetable:
        where = next((w for key, w in problem.layout.key_where if key == "timetable"), None)
        faults.append(Fault(where, "this domain knows no timetable", "use --domain restaurant"))
    if has_chairs(problem):
        faults.append(
            Fault(
                where_of(problem, "chairs"),
                "this domain knows no chairs",
                "use --domain restaurant",
            )
        )
    if faults:
        raise InputError(faults)
    return state_facts(problem, alone=True)


def observation_facts(problem: Problem) -> list[ProgramLine]:
    lines = []
    for party, where in entered(problem):
        lines.append(ProgramLine(f"leader({party[0]}).", where))
        lines += [ProgramLine(f"obs(has_entered({member}), true, 0).", where) for member in party]
        lines += [
            ProgramLine(f"obs(group({party[0]}, {member}), true, 0).", where)
            for member in party[1:]
        ]
    for table, where in sorted(bills_seen(problem).items()):
        lines.append(ProgramLine(f"obs(bill_wave({table}), true, 0).", where))
    return lines


# ---------------------------------------------------------------- goals


def _goal_conditions(goal: Goal, problem: Problem) -> list[str]:
    """Returns bodies of which one holds at step I when the goal does."""
    leader, table, item = (goal.party[0] if goal.party else ""), goal.table, goal.item
    no_objects, several = not objects_of(problem), bool(problem.layout.agents)
    not_carried = f"not {_carried(problem, item or 'plate', table or '')}"
    not_on_the_way = f"not holds(isready({item or 'plate'}, {table}), I), {not_carried}"
    in_hand = f"inhand({table}, I)" if several else f"holds(hasorder(agent, {table}), I)"
    match goal.kind:
        case "seated":
            return [f"holds(isattable({leader}, {table or 'T'}), I)"]
        case "paid" if table is not None:
            return [
                f"holds(isattable(P, {table}), I), holds(haspaid(P), I), not holds(wantsbill({table}), I)"
            ]
        case "paid":
            return [
                f"holds(isattable({leader}, T), I), holds(haspaid({leader}), I), not holds(wantsbill(T), I)"
            ]
        case "at":
            if several and goal.robot is None:
                return [f"stands({goal.node}, I)"]
            return [f"holds(currentlocation({goal.robot or 'agent'}, {goal.node}), I)"]
        case "ordered":
            return [in_hand, f"holds(issent({table}), I)"]
        case "sent":
            return [f"holds(issent({table}), I)"]
        case "served" if item is None and no_objects:
            return [f"holds(isserved({table}), I), not {in_hand}"]
        case "served" if item is None:
            return [f"holds(isserved({table}), I), not {in_hand}, {not_on_the_way}"]
        case "served" if item == "plate":
            return [f"holds(isserved({table}), I), {not_on_the_way}"]
        case "served":
            return [f"#step(I), not holds(isempty({item}, {table}), I), {not_on_the_way}"]
        case "filled":
            return [f"#step(I), not holds(isempty({item}, {table}), I), {not_carried}"]
        case "chairs":
            return [f"holds(has_chairs({table}, X), I), X >= {goal.number}"]
        case "holds":
            return [f"holds({goal.fluent}, I)"]
        case "holds_not":
            return [f"#step(I), not holds({goal.fluent}, I)"]
    raise InputError([Fault(goal.where, f"a goal of kind {goal.kind} is not known", None)])


def _carried(problem: Problem, item: str, table: str) -> str:
    """Returns the condition that the robot, or one of several, carries something for a table."""
    if problem.layout.agents:
        return f"carried({item}, {table}, I)"
    return f"holds(iscarrying(agent, {item}, {table}), I)"


def _serve_condition(
    problem: Problem, number: int, goal: Goal, parts: frozenset[str]
) -> list[ProgramLine]:
    """``serve`` in a plan: the party sits, and nothing at its table is left to do for now."""
    leader = goal.party[0]
    open_wishes = ["holds(wantsbill(T), I)"]
    if "bar" in parts:
        several = bool(problem.layout.agents)
        in_hand = "inhand(T, I)" if several else "holds(hasorder(agent, T), I)"
        open_wishes += ["holds(readytoorder(T), I)", in_hand]
    if "objects" in parts:
        open_wishes += ["holds(isready(O, T), I)", _carried(problem, "O", "T")]
    if "refillables" in parts:
        open_wishes += ["holds(isempty(R, T), I)"]
    seat = f"holds(isattable({leader}, T), I)"
    lines = [
        ProgramLine(f"open({number}, I) :- {seat}, {wish}.", goal.where) for wish in open_wishes
    ]
    lines.append(ProgramLine(f"reached({number}, I) :- {seat}, not open({number}, I).", goal.where))
    return lines


def goal_facts(problem: Problem, parts: frozenset[str]) -> list[ProgramLine]:
    """Returns the goals in a domain that has these optional parts."""
    lines: list[ProgramLine] = []
    numbers = {}
    for number, goal in enumerate(all_goals(problem), 1):
        numbers[goal] = number
        if number <= len(problem.goals):
            lines.append(ProgramLine(f"required({number}).", goal.where))
        if goal.kind == "serve":
            lines += _serve_condition(problem, number, goal, parts)
            continue
        for body in _goal_conditions(goal, problem):
            lines.append(ProgramLine(f"reached({number}, I) :- {body}.", goal.where))
    for first, second in problem.before:
        lines.append(ProgramLine(f"before({numbers[first]}, {numbers[second]}).", second.where))
    return lines


def guest_goals(problem: Problem) -> list[ProgramLine]:
    """Returns the goals for a domain without orders and objects; raises `InputError` for others."""
    known = ("seated", "paid", "at", "serve", "holds", "holds_not")
    faults = [
        Fault(goal.where, f"this domain knows no goal {goal.kind}", "use --domain restaurant")
        for goal in all_goals(problem)
        if goal.kind not in known
    ]
    if faults:
        raise InputError(faults)
    return goal_facts(problem, frozenset())
