"""Template, `Problem`, horizon → `sparc.Source`: a SPARC program about one restaurant.

Entry point `fill_template`.  A template is a SPARC program with comment lines as marks::

    %{ nodes          up to the next line "%}": replaced by the slot of that name
    %? bar            up to its line "%.": kept only where the problem has that part; may nest

Every line of the result knows the line of the template or of the user's YAML that it came from.
Slots are functions of the problem, by name, in `SLOTS`; a template uses those it needs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from difflib import get_close_matches
from functools import cache

from sparc.source import Origin, Source
from sparc.values import dataclass
from waiter_cli.exits import Fault, InputError
from waiter_cli.plan import Plan
from waiter_cli.problem import Problem
from waiter_cli.situation import Goal, Party, Where

__all__ = ["PARTS", "SLOTS", "Line", "fill_template", "parts_of", "read_template"]

REFILLABLES = ("jug", "basket")


@dataclass(frozen=True, slots=True)
class Line:
    """One line of SPARC made for a problem, and where in the user's files it comes from."""

    text: str
    where: Where | None = None


@dataclass(frozen=True, slots=True)
class _Slot:
    name: str
    line: int
    default: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True)
class _Part:
    name: str
    line: int
    pieces: tuple[_Piece, ...]


# A template is a sequence of plain lines (number, text), slots and parts.
_Piece = tuple[int, str] | _Slot | _Part


@cache
def read_template(source: Source) -> tuple[_Piece, ...]:
    """The pieces of a template; raises `InputError` at a mark that is unknown or never closed."""
    faults: list[Fault] = []
    stack: list[tuple[str, int, list[_Piece]]] = [("", 0, [])]
    slot: tuple[str, int, list[tuple[int, str]]] | None = None

    def fault(number: int, message: str, hint: str) -> None:
        faults.append(Fault(Where(source.name, number, 1), message, hint))

    for number, text in enumerate(source.text.split("\n"), source.first_line):
        mark = text.strip() if text.lstrip().startswith("%") else ""
        if slot is not None:
            if mark == "%}":
                stack[-1][2].append(_Slot(slot[0], slot[1], tuple(slot[2])))
                slot = None
            elif mark.startswith(("%{", "%?")) or mark == "%.":
                fault(number, f"slot {slot[0]} is still open here", 'close it with a line "%}"')
                slot = None
            else:
                slot[2].append((number, text))
        elif mark.startswith("%{"):
            name = mark[2:].strip()
            if name not in SLOTS:
                fault(number, f"unknown slot {name}", _nearest(name, SLOTS))
            slot = (name, number, [])
        elif mark.startswith("%?"):
            name = mark[2:].strip()
            if name not in PARTS:
                fault(number, f"unknown part {name}", _nearest(name, PARTS))
            stack.append((name, number, []))
        elif mark == "%.":
            if len(stack) == 1:
                fault(
                    number,
                    "a part ends that never began",
                    'remove this line, or write "%? PART" above',
                )
                continue
            name, start, pieces = stack.pop()
            stack[-1][2].append(_Part(name, start, tuple(pieces)))
        elif mark == "%}":
            fault(
                number, "a slot ends that never began", 'remove this line, or write "%{ SLOT" above'
            )
        else:
            stack[-1][2].append((number, text))
    if slot is not None:
        fault(slot[1], f"slot {slot[0]} is never closed", 'add a line "%}" after it')
    for name, start, _ in stack[1:]:
        fault(start, f"part {name} is never closed", 'add a line "%." after it')
    if faults:
        raise InputError(faults)
    return tuple(stack[0][2])


def _nearest(name: str, known: Iterable[str]) -> str:
    names = sorted(known)
    close = get_close_matches(name, names, 1)
    return f"did you mean {close[0]}?" if close else f"known are {', '.join(names)}"


def fill_template(
    template: Source, problem: Problem, horizon: int, offer: Plan | None = None
) -> Source:
    """The SPARC program for a problem with steps 0..``horizon``.

    With an ``offer`` the program may choose that plan's actions only, where the template has the
    parts ``choice`` and ``offer``: whether it accepts the plan is then quickly told.

    Raises `InputError` when a mark of the template is wrong, or when the problem asks for
    something that a slot of this template has no words for.
    """
    have = parts_of(problem) | {"choice" if offer is None else "offer"}
    lines: list[str] = []
    origins: list[Origin | None] = []
    todo: list[_Piece] = list(reversed(read_template(template)))
    while todo:
        piece = todo.pop()
        if isinstance(piece, _Slot):
            made = SLOTS[piece.name](problem, horizon) if piece.name != "offer" else _offer(offer)
            for line in made:
                lines.append(line.text)
                origins.append(_origin(line, template, piece.line))
        elif isinstance(piece, _Part):
            if piece.name in have:
                todo.extend(reversed(piece.pieces))
        else:
            number, text = piece
            lines.append(text)
            origins.append(Origin(template.name, number, verbatim=True))
    return Source(template.name, "\n".join(lines), 1, tuple(origins))


def _origin(line: Line, template: Source, number: int) -> Origin:
    if line.where is not None and line.where.line:
        return Origin(line.where.name, line.where.line, line.where.column, line.text)
    return Origin(template.name, number, 1, line.text)


# ---------------------------------------------------------------- parts


PARTS: dict[str, Callable[[Problem], bool]] = {
    "bar": lambda problem: problem.layout.bar is not None,
    "objects": lambda problem: bool(_objects(problem)),
    "plates": lambda problem: "plate" in _objects(problem),
    "refillables": lambda problem: bool(_refillables(problem)),
    "instant_kitchen": lambda problem: problem.instant_kitchen and "plate" in _objects(problem),
    "chairs": lambda problem: _has_chairs(problem),
    "timetable": lambda problem: bool(problem.layout.timetable),
    "order": lambda problem: bool(problem.before),
    # One of these two is there: any possible action may be chosen, or those of a suggested plan.
    "choice": lambda problem: False,
    "offer": lambda problem: False,
}


def parts_of(problem: Problem) -> frozenset[str]:
    """The names of the optional parts that a problem has."""
    return frozenset(name for name, has in PARTS.items() if has(problem))


def _objects(problem: Problem) -> tuple[str, ...]:
    return problem.layout.objects if problem.layout.bar is not None else ()


def _refillables(problem: Problem) -> tuple[str, ...]:
    return tuple(item for item in _objects(problem) if item in REFILLABLES)


def _has_chairs(problem: Problem) -> bool:
    capacity = {table.name: table.capacity for table in problem.layout.tables}
    fewer = any(count < capacity[table] for table, count in problem.state.chairs)
    return fewer or any(goal.kind == "chairs" for goal in _all_goals(problem))


# ---------------------------------------------------------------- slots


def _all_goals(problem: Problem) -> tuple[Goal, ...]:
    """The goals, then those that only an order names; numbered from 1 in the program."""
    found = list(problem.goals)
    for pair in problem.before:
        found.extend(goal for goal in pair if goal not in found)
    return tuple(found)


def _braces(sort: str, names: Iterable[str]) -> list[Line]:
    return [Line(f"#{sort} = {{{', '.join(names)}}}.")]


def _customers(problem: Problem) -> list[str]:
    named = dict.fromkeys(name for party in problem.state.parties() for name in party)
    for party in problem.before_observations.parties():
        named.update(dict.fromkeys(party))
    for goal in _all_goals(problem):
        named.update(dict.fromkeys(goal.party))
    taken = {node.name for node in problem.layout.nodes} | {t.name for t in problem.layout.tables}
    number = 1
    while len(named) < max(1, problem.layout.customers):
        if (name := f"c{number}") not in taken:
            named[name] = None
        number += 1
    return list(named)


def _entered(problem: Problem) -> list[tuple[Party, Where | None]]:
    """The parties that came in just now and still wait."""
    waiting = set(problem.state.waiting)
    seen = [(o.arguments, o.where) for o in problem.observations if o.kind == "enter"]
    return [(party, where) for party, where in seen if party in waiting]


def _bills_seen(problem: Problem) -> dict[str, Where | None]:
    return {
        o.arguments[0]: o.where
        for o in problem.observations
        if o.kind == "bill" and o.arguments[0] in problem.state.wants_bill
    }


def _numbers(problem: Problem) -> int:
    seats = [table.capacity for table in problem.layout.tables]
    sizes = [len(party) for party in problem.state.parties()]
    wanted = [goal.number for goal in _all_goals(problem) if goal.number is not None]
    return max([1, *seats, *sizes, *wanted, *(count for _, count in problem.state.chairs)])


def _where(problem: Problem, key: str) -> Where | None:
    return next((where for name, where in problem.state_where if name == key), None)


def _table_facts(problem: Problem) -> list[Line]:
    lines = []
    for table in problem.layout.tables:
        for node in dict.fromkeys(table.nodes):
            lines.append(Line(f"areassociated({node}, {table.name}).", table.where))
        lines.append(Line(f"hascapacity({table.name}, {table.capacity}).", table.where))
    return lines


def _edges(problem: Problem) -> list[Line]:
    wheres: tuple[Where | None, ...] = problem.layout.edge_where
    if len(wheres) != len(problem.layout.edges):
        wheres = (None,) * len(problem.layout.edges)
    return [
        Line(f"edge({a}, {b}).", where)
        for (a, b), where in zip(problem.layout.edges, wheres, strict=True)
    ]


def _state(problem: Problem) -> list[Line]:
    """The state after the observations, less what the ``observations`` slot makes known."""
    state = problem.state
    entered = {party for party, _ in _entered(problem)}
    bills = _bills_seen(problem)
    lines: list[Line] = []

    def holds(fluent: str, key: str) -> None:
        lines.append(Line(f"holds({fluent}, 0).", _where(problem, key)))

    holds(f"currentlocation(agent, {state.agent})", "agent")
    for waiter, node in state.waiters:
        holds(f"currentlocation({waiter}, {node})", "waiters")
    for party in state.parties():
        if party in entered:
            continue
        lines.append(Line(f"leader({party[0]}).", None))
        for member in party[1:]:
            holds(f"aretogether({party[0]}, {member})", "waiting")
    for table, party in state.seated:
        holds(f"isattable({party[0]}, {table})", "seated")
        if table in state.paid:
            holds(f"haspaid({party[0]})", "paid")
    for party in state.waiting:
        if party not in entered:
            holds(f"iswaiting({party[0]})", "waiting")
    if state.with_agent:
        holds(f"iswith(agent, {state.with_agent[0]})", "with_agent")
    for table in sorted(state.wants_bill - bills.keys()):
        holds(f"wantsbill({table})", "wants_bill")
    if problem.layout.bar is not None:
        for fluent, key in (("readytoorder({})", "ready_to_order"), ("hasorder(agent, {})", "ordered"),
                            ("issent({})", "sent"), ("isserved({})", "served")):  # fmt: skip
            for table in sorted(getattr(state, key)):
                holds(fluent.format(table), key)
        for table, item in sorted(state.ready):
            holds(f"isready({item}, {table})", "ready")
        filled = state.carrying if state.agent in problem.layout.bar.nodes else None
        for table, item in sorted(state.empty - {filled}):  # what is carried to the bar is full
            holds(f"isempty({item}, {table})", "empty")
        if state.carrying:
            holds(f"iscarrying(agent, {state.carrying[1]}, {state.carrying[0]})", "carrying")
    if _has_chairs(problem):
        for table, count in state.chairs:
            holds(f"has_chairs({table}, {count})", "chairs")
    return lines


def _guest_state(problem: Problem) -> list[Line]:
    """The state with every guest alone, for a domain without parties.

    Raises `InputError` where the problem has what such a domain has no words for.
    """
    faults = []
    if problem.layout.timetable:
        where = next((w for key, w in problem.layout.key_where if key == "timetable"), None)
        faults.append(Fault(where, "this domain knows no timetable", "use --domain restaurant"))
    if _has_chairs(problem):
        faults.append(
            Fault(
                _where(problem, "chairs"), "this domain knows no chairs", "use --domain restaurant"
            )
        )
    if faults:
        raise InputError(faults)
    state = problem.state
    entered = {party for party, _ in _entered(problem)}
    bills = _bills_seen(problem)
    lines: list[Line] = []

    def holds(fluent: str, key: str) -> None:
        lines.append(Line(f"holds({fluent}, 0).", _where(problem, key)))

    holds(f"currentlocation(agent, {state.agent})", "agent")
    for waiter, node in state.waiters:
        holds(f"currentlocation({waiter}, {node})", "waiters")
    for party in state.parties():
        if party not in entered:
            for member in party[1:]:
                holds(f"aretogether({party[0]}, {member})", "waiting")
    for table, party in state.seated:
        for member in party:
            holds(f"isattable({member}, {table})", "seated")
            if table in state.paid:
                holds(f"haspaid({member})", "paid")
    for party in state.waiting:
        if party not in entered:
            for member in party:
                holds(f"iswaiting({member})", "waiting")
    for member in state.with_agent:
        holds(f"iswith(agent, {member})", "with_agent")
    for table in sorted(state.wants_bill - bills.keys()):
        holds(f"wantsbill({table})", "wants_bill")
    return lines


def _guest_goals(problem: Problem) -> list[Line]:
    """The goals for a domain without orders and objects; raises `InputError` for others."""
    known = ("seated", "paid", "at", "serve")
    faults = [
        Fault(goal.where, f"this domain knows no goal {goal.kind}", "use --domain restaurant")
        for goal in _all_goals(problem)
        if goal.kind not in known
    ]
    if faults:
        raise InputError(faults)
    return _goals(problem, frozenset())


def _observations(problem: Problem) -> list[Line]:
    lines = []
    for party, where in _entered(problem):
        lines.append(Line(f"leader({party[0]}).", where))
        lines += [Line(f"obs(has_entered({member}), true, 0).", where) for member in party]
        lines += [
            Line(f"obs(group({party[0]}, {member}), true, 0).", where) for member in party[1:]
        ]
    for table, where in sorted(_bills_seen(problem).items()):
        lines.append(Line(f"obs(bill_wave({table}), true, 0).", where))
    return lines


def _goal_conditions(goal: Goal, problem: Problem) -> list[str]:
    """Bodies, one of which holds at step I when the goal does."""
    leader, table, item = (goal.party[0] if goal.party else ""), goal.table, goal.item
    no_objects = not _objects(problem)
    not_on_the_way = f"not holds(isready({item or 'plate'}, {table}), I), not holds(iscarrying(agent, {item or 'plate'}, {table}), I)"
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
            return [f"holds(currentlocation(agent, {goal.node}), I)"]
        case "ordered":
            return [f"holds(hasorder(agent, {table}), I)", f"holds(issent({table}), I)"]
        case "sent":
            return [f"holds(issent({table}), I)"]
        case "served" if item is None and no_objects:
            return [f"holds(isserved({table}), I), not holds(hasorder(agent, {table}), I)"]
        case "served" if item is None:
            return [
                f"holds(isserved({table}), I), not holds(hasorder(agent, {table}), I), {not_on_the_way}"
            ]
        case "served" if item == "plate":
            return [f"holds(isserved({table}), I), {not_on_the_way}"]
        case "served":
            return [f"#step(I), not holds(isempty({item}, {table}), I), {not_on_the_way}"]
        case "filled":
            return [f"#step(I), not holds(isempty({item}, {table}), I), "
                    f"not holds(iscarrying(agent, {item}, {table}), I)"]  # fmt: skip
        case "chairs":
            return [f"holds(has_chairs({table}, X), I), X >= {goal.number}"]
    raise InputError([Fault(goal.where, f"a goal of kind {goal.kind} is not known", None)])


def _serve_condition(number: int, goal: Goal, parts: frozenset[str]) -> list[Line]:
    """``serve`` in a plan: the party sits, and nothing at its table is left to do for now."""
    leader = goal.party[0]
    open_wishes = ["holds(wantsbill(T), I)"]
    if "bar" in parts:
        open_wishes += ["holds(readytoorder(T), I)", "holds(hasorder(agent, T), I)"]
    if "objects" in parts:
        open_wishes += ["holds(isready(O, T), I)", "holds(iscarrying(agent, O, T), I)"]
    if "refillables" in parts:
        open_wishes += ["holds(isempty(R, T), I)"]
    seat = f"holds(isattable({leader}, T), I)"
    lines = [Line(f"open({number}, I) :- {seat}, {wish}.", goal.where) for wish in open_wishes]
    lines.append(Line(f"reached({number}, I) :- {seat}, not open({number}, I).", goal.where))
    return lines


def _goals(problem: Problem, parts: frozenset[str]) -> list[Line]:
    """The goals in a domain that has these optional parts."""
    lines: list[Line] = []
    numbers = {}
    for number, goal in enumerate(_all_goals(problem), 1):
        numbers[goal] = number
        if number <= len(problem.goals):
            lines.append(Line(f"required({number}).", goal.where))
        if goal.kind == "serve":
            lines += _serve_condition(number, goal, parts)
            continue
        for body in _goal_conditions(goal, problem):
            lines.append(Line(f"reached({number}, I) :- {body}.", goal.where))
    for first, second in problem.before:
        lines.append(Line(f"before({numbers[first]}, {numbers[second]}).", second.where))
    return lines


def _inertial(problem: Problem, pieces: str) -> list[str]:
    parts = parts_of(problem)
    chosen = ["#basic_" + pieces]
    for part, name in (("bar", "order"), ("objects", "object"), ("refillables", "refill"),
                       ("chairs", "chair")):  # fmt: skip
        if part in parts:
            chosen.append(f"#{name}_{pieces}")
    return chosen


def _timetable(problem: Problem) -> list[Line]:
    horizonless = problem.layout.timetable
    return [Line(f"willbe({w}, {node}, {step}).") for w, step, node in horizonless if step > 0]


def _entrance(problem: Problem) -> list[Line]:
    where = next((w for key, w in problem.layout.key_where if key == "entrance"), None)
    return [Line(f"entrance({problem.layout.entrance}).", where)]


def _bar(problem: Problem) -> list[Line]:
    bar = problem.layout.bar
    return [] if bar is None else [Line(f"bar({node}).", bar.where) for node in bar.nodes]


def _directives(problem: Problem, horizon: int) -> list[Line]:
    """SPARC refuses numbers above 2000 unless it is told a larger limit."""
    largest = max(horizon, _numbers(problem))
    return [Line(f"#maxint = {largest}.")] if largest > 2000 else []


def _offer(plan: Plan | None) -> list[Line]:
    actions = plan.actions if plan is not None else ()
    return [Line(f"offered({action.text}, {action.step}).") for action in actions]


Slot = Callable[[Problem, int], list[Line]]

SLOTS: dict[str, Slot] = {
    "directives": _directives,
    "offer": lambda problem, horizon: [],
    "steps": lambda problem, horizon: [Line(f"#step = 0..{horizon}.")],
    "numbers": lambda problem, _: [Line(f"#num = 0..{_numbers(problem)}.")],
    "goal_sort": lambda problem, _: [Line(f"#goal = 0..{len(_all_goals(problem))}.")],
    "nodes": lambda problem, _: _braces("node", (node.name for node in problem.layout.nodes)),
    "tables": lambda problem, _: _braces("table", (table.name for table in problem.layout.tables)),
    "customers": lambda problem, _: _braces("customer", _customers(problem)),
    "employees": lambda problem, _: _braces(
        "employee", ["agent", *(waiter for waiter, _ in problem.state.waiters)]
    ),
    "objects": lambda problem, _: _braces("object", _objects(problem)),
    "refillables": lambda problem, _: _braces("refillable", _refillables(problem)),
    "inertial_fluent": lambda problem, _: [
        Line(f"#inertial_fluent = {' + '.join(_inertial(problem, 'fluent'))}.")
    ],
    "action": lambda problem, _: [Line(f"#action = {' + '.join(_inertial(problem, 'action'))}.")],
    "edges": lambda problem, _: _edges(problem),
    "table_facts": lambda problem, _: _table_facts(problem),
    "entrance": lambda problem, _: _entrance(problem),
    "bar": lambda problem, _: _bar(problem),
    "timetable": lambda problem, horizon: [
        line
        for line, (_, step, _) in zip(
            _timetable(problem), [t for t in problem.layout.timetable if t[1] > 0], strict=True
        )
        if step <= horizon
    ],
    "state": lambda problem, _: _state(problem),
    "observations": lambda problem, _: _observations(problem),
    "goals": lambda problem, _: _goals(problem, parts_of(problem)),
    "guest_state": lambda problem, _: _guest_state(problem),
    "guest_goals": lambda problem, _: _guest_goals(problem),
}
