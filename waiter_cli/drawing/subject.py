"""`Layout`, and a plan where there is one → `Subject`: what is to be seen in a drawing.

Entry point `make_subject`.  Nothing here knows about paper or terminals.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.encoding.declarations import declared_words, words_for
from waiter_cli.encoding.domains import Domain
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.model.layout import Layout
from waiter_cli.model.state import Robot, State
from waiter_cli.model.wording import counted
from waiter_cli.rules.rulebook import HOUSE, Rulebook

if TYPE_CHECKING:
    from waiter_cli.model.plan import Action, Plan
    from waiter_cli.model.problem import Problem
    from waiter_cli.room.room import Room

__all__ = ["DrawnAction", "Leg", "Subject", "make_subject"]


@dataclass(frozen=True)
class Leg:
    """A piece of the walk: at ``step`` from node ``start`` to node ``end``."""

    step: int
    start: str
    end: str
    robot: str = "agent"


@dataclass(frozen=True)
class DrawnAction:
    """A drawn action at ``step``, done on ``node``; ``text`` in two or three words."""

    step: int
    node: str
    text: str
    robot: str = "agent"


@dataclass(frozen=True)
class Subject:
    """A restaurant as it is to be drawn.

    ``state`` is what holds at the start of the walk, or by the layout alone.  ``listing`` says the
    plan in words: pairs of steps (``0-3``) and text (``walk n1 → n2``).  ``marked`` holds names of nodes, tables and
    staff to point out.  ``note`` is a remark about the plan or the places, empty where there is nothing to say.
    """

    layout: Layout
    room: Room
    state: State
    legs: tuple[Leg, ...] = ()
    deeds: tuple[DrawnAction, ...] = ()
    listing: tuple[tuple[str, str], ...] = ()
    marked: frozenset[str] = frozenset()
    note: str = ""

    @property
    def headline(self) -> str:
        """Returns the restaurant in numbers."""
        tables = self.layout.tables
        seats = sum(table.capacity for table in tables)
        parts = [counted(len(self.layout.nodes), "node"), counted(len(tables), "table")]
        return ", ".join([*parts, counted(seats, "seat")])


def make_subject(
    layout: Layout,
    state: State | None = None,
    played: tuple[Problem, Plan] | None = None,
    highlights: Sequence[str] = (),
    rules: Rulebook = HOUSE,
    domain: Domain | None = None,
) -> Subject:
    """Returns the subject of a drawing: a situation, or a plan, played by ``rules``, from where it starts.

    Actions have the words of ``domain``, or of the house.
    ``highlights`` are names of nodes, tables, waiters, ``agent`` or ``bar``; of ``edge`` ends when
    written ``n1-n2``.  A layout without coordinates gets some that fit its edges.  Raises
    `InputError` for a name that is not in the layout, and `LayoutError` where only some nodes have
    coordinates.
    """
    from waiter_cli.room.room import build_room

    marked = _marked(layout, highlights)
    layout, remark = _placed(layout)
    room = build_room(layout)
    layout = room.layout
    if played is None:
        return Subject(layout, room, state or _empty(layout), marked=marked, note=remark)
    problem, plan = played
    from waiter_cli.rules.validator import run

    verdict = run(problem, plan, rules)
    legs: list[Leg] = []
    deeds: list[DrawnAction] = []
    done = [a for a in plan.actions if a.step < len(verdict.states) - 1]
    for action in done:
        stations = verdict.states[action.step].stations()
        who = next((name for name in action.arguments if name in stations), next(iter(stations)))
        here = stations[who]
        if action.name == "go_to":
            legs.append(Leg(action.step, here, action.arguments[1], who))
        else:
            deeds.append(DrawnAction(action.step, here, _short(action, domain), who))
    if not verdict.valid:
        wrong = f"the plan is not valid: {'; '.join(verdict.reasons)}; drawn as far as it goes"
        remark = f"{remark}; {wrong}" if remark else wrong
    return Subject(
        layout,
        room,
        verdict.states[0],
        tuple(legs),
        tuple(deeds),
        tuple(
            _listing_together(done, verdict.states, domain)
            if layout.agents
            else _listing(done, verdict.states, domain)
        ),
        marked,
        remark,
    )


def _placed(layout: Layout) -> tuple[Layout, str]:
    """Returns the layout with places for its nodes where none has one, and the remark that says so."""
    if any(node.at is not None for node in layout.nodes):
        return layout, ""
    from waiter_cli.room.coordinates import place

    remark = "the nodes have no coordinates; they are drawn where they fit the edges"
    return place(layout), remark


def _empty(layout: Layout) -> State:
    chairs = tuple(sorted((table.name, table.chairs) for table in layout.tables))
    robots = tuple(Robot(name, at) for name, at in layout.agents)
    return State("" if robots else layout.agent, layout.waiters, chairs=chairs, robots=robots)


def _marked(layout: Layout, highlights: Sequence[str]) -> frozenset[str]:
    known = {node.name for node in layout.nodes} | {table.name for table in layout.tables}
    known |= {waiter for waiter, _ in layout.waiters} | {"entrance"}
    known |= {robot for robot, _ in layout.agents} or {"agent"}
    known |= {"bar"} if layout.bar else set()
    near = layout.joined()
    marked: set[str] = set()
    faults: list[Fault] = []
    for name in highlights:
        first, dash, second = name.partition("-")
        if name in known:
            marked.add(layout.entrance if name == "entrance" else name)
        elif dash and second in near.get(first, ()):
            marked |= {f"{first}-{second}", f"{second}-{first}"}
        else:
            from waiter_cli.spelling import did_you_mean

            message = f"nothing in {layout.name} is called {name}"
            hint = did_you_mean(name, sorted(known)) or "name a node, a table, a waiter or an edge"
            if dash:
                message = f"there is no edge {name} in {layout.name}"
                beside = ", ".join(f"{first}-{node}" for node in near.get(first, ()))
                hint = f"there are {beside}" if beside else "join two nodes: n1-n2"
            faults.append(Fault(Where("--highlight"), message, hint))
    if faults:
        raise InputError(faults)
    return frozenset(marked)


def _short(action: Action, domain: Domain | None) -> str:
    """Returns an action in two or three words: ``seat c2``, ``plate for table1``; or as it is declared."""
    declared = declared_words(domain, action)
    if declared is not None:
        return declared
    match action.name, action.arguments:
        case "give_bill", (_, table):
            return f"bill {table}"
        case "take_order", (_, table):
            return f"order {table}"
        case "send_order", (_, table):
            return f"send {table}"
        case "take_up", (_, item, table):
            return f"take {item} {table}"
        case "bring", (_, item, table):
            return f"bring {item} {table}"
        case "refill", (_, item, table):
            return f"fetch {item} {table}"
        case "bring_chairs", (_, table, number):
            return f"chairs {table}: {number}"
    return " ".join((action.name, *action.arguments[1:2]))


def _listing(
    actions: Sequence[Action], states: Sequence[State], domain: Domain | None
) -> list[tuple[str, str]]:
    """Returns the plan in words, walks of several steps on one line."""
    out: list[tuple[str, str]] = []
    walk: list[Action] = []

    def end_walk() -> None:
        if walk:
            start = states[walk[0].step].stations()[walk[0].arguments[0]]
            stations = [start, *(step.arguments[1] for step in walk)]
            steps = f"{walk[0].step}-{walk[-1].step}" if len(walk) > 1 else str(walk[0].step)
            out.append((steps, f"walk {' → '.join(stations)}"))
        walk.clear()

    for action in actions:
        if action.name == "go_to" and (not walk or walk[-1].step == action.step - 1):
            walk.append(action)
            continue
        end_walk()
        if action.name == "go_to":
            walk.append(action)
        else:
            out.append((str(action.step), words_for(domain, action, states[action.step])))
    end_walk()
    return out


def _listing_together(
    actions: Sequence[Action], states: Sequence[State], domain: Domain | None
) -> list[tuple[str, str]]:
    """Returns the plan of several robots in words: what each does, in the order in which it begins."""
    out: list[tuple[int, str, str]] = []
    for robot in states[0].stations():
        own = [action for action in actions if robot in action.arguments[:1]]
        for steps, text in _listing(own, states, domain):
            out.append((int(steps.partition("-")[0]), steps, f"{robot}: {text}"))
    return [(steps, text) for _, steps, text in sorted(out, key=lambda line: line[0])]
