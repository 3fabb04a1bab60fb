"""Takes what a picture shows at one moment: `Run` → `Snapshot`. Entry point `take`."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from sparc.lazy_dataclass import dataclass
from waiter_cli.domain_execution.states import parted
from waiter_cli.encoding.declarations import declared_words
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Party, Robot, State
from waiter_cli.model.wording import describe
from waiter_cli.room.motion import Pose

if TYPE_CHECKING:
    from waiter_cli.simulation.run import Run

__all__ = ["Bubble", "Figurine", "RobotFigure", "Row", "Snapshot", "meaning", "take"]


class Figurine(NamedTuple):
    """Somebody in the picture; ``stride`` is -1, 0 or 1 on foot."""

    name: str
    role: str
    number: int
    x: float
    y: float
    yaw: float
    posture: str
    hand: bool
    stride: int


class Bubble(NamedTuple):
    """A speech bubble whose tip points at a place; ``speaker`` is robot, a table or a guest."""

    speaker: str
    x: float
    y: float
    z: float
    text: str


class RobotFigure(NamedTuple):
    """One of several robots; its ``number`` gives it a colour.  A single one has no name."""

    name: str
    number: int
    pose: Pose
    load: str | None

    @property
    def key(self) -> str:
        """Returns what it is called among all that moves."""
        return f"robot {self.name}".rstrip()


class Row(NamedTuple):
    """A line of the plan: ``state`` is done, failed, now or next."""

    text: str
    state: str


@dataclass(frozen=True)
class Snapshot:
    """A moment; ``chairs`` how many stand at each table, ``served`` where plates are.

    Of several robots ``robot`` and ``load`` speak of the first, ``crew`` of all.
    """

    title: str
    time: float
    robot: Pose
    load: str | None
    people: tuple[Figurine, ...]
    chairs: tuple[tuple[str, int], ...]
    served: tuple[str, ...]
    bubbles: tuple[Bubble, ...]
    banner: str
    rows: tuple[Row, ...]
    current: int
    done: bool = False
    crew: tuple[RobotFigure, ...] = ()

    @property
    def robots(self) -> tuple[RobotFigure, ...]:
        """Returns all robots, named where there are several."""
        return self.crew or (RobotFigure("", 0, self.robot, self.load),)

    @property
    def named(self) -> tuple[tuple[str, str, int], ...]:
        """Returns whose names stand beside them: the name, the role, the number."""
        people = tuple((p.name, p.role, p.number) for p in self.people)
        return people + tuple((each.name, "robot", each.number) for each in self.crew)


@lru_cache(maxsize=4096)
def meaning(text: str, node: str, party: Party = ()) -> str:
    """Returns the meaning of an action, in the words of ``waiter plan``.

    The robot is at ``node``; ``party`` is that of the guest whom the action names.

    >>> meaning("go_to(agent,n2)", "n1"), meaning("seat(agent,c2,table1)", "n6", ("c2", "c3"))
    ('walk from n1 to n2', 'seat the party of c2 (2) at table1')
    """
    name, _, rest = text.partition("(")
    action = Action(0, name, tuple(rest.removesuffix(")").split(",")))
    who, waiting = action.arguments[0], (party,) if party else ()
    robots = () if who == "agent" else (Robot(who, node),)
    return describe(action, State(agent=node, waiting=waiting, robots=robots))


def take(run: Run) -> Snapshot:
    """Returns the snapshot of now."""
    world, crowd = run.world, run.crowd
    waving = {
        name for place in world.tables.values() if place.wants_bill for name in place.party[:1]
    }
    people = []
    for person in crowd.people.values():
        if person.mode == "walk" and person.walked < 0.0:  # still outside
            continue
        stride = 0
        moving = person.mode in ("walk", "follow")
        x, y = person.shown if moving else (person.x, person.y)
        if moving:
            stride = (0, 1, 0, -1)[int((x + y) / 0.22) % 4]
        hand = person.name in waving and person.mode == "sit"
        posture = "sit" if person.mode == "sit" else "stand"
        people.append(
            Figurine(
                person.name, person.role, person.number, x, y, person.yaw, posture, hand, stride
            )
        )
    rows = _rows(run)
    current = max(0, len(run.shown.deeds) - 1)
    robots = run.shown_robots()
    crew = tuple(
        RobotFigure(each.name, k, each.pose, each.load[1] if each.load else None)
        for k, each in enumerate(robots)
    )
    return Snapshot(
        run.shown.title, run.clock.time, crew[0].pose, crew[0].load,
        tuple(people), tuple((n, p.chairs) for n, p in world.tables.items()),
        tuple(n for n, p in world.tables.items() if p.served and p.party), tuple(_bubbles(run)),
        run.shown.banner, tuple(rows), current, crew=crew if len(crew) > 1 else (),
    )  # fmt: skip


def _rows(run: Run) -> list[Row]:
    """Returns what was done and what is still to be done, each where it is or was to be done."""
    now = {action.text for action in run.acting()}
    steps = {action.step for action in run.acting()}
    lines = [(deed.text, deed.state) for deed in run.shown.deeds]
    lines += [
        (a.text, "next") for a in run.mind.decision.plan if not (a.step in steps and a.text in now)
    ]
    nodes, rows = run.problem.state.stations(), []
    for text, state in lines:
        names = text.partition("(")[2].removesuffix(")").split(",")
        led = text.startswith(("pick(", "seat("))
        words = declared_words(run.domain, _action(text))
        if words is None:
            node = nodes.get(names[0], run.problem.state.agent)
            words = meaning(text, node, _party(run, names[1]) if led else ())
        rows.append(Row(words if len(nodes) == 1 else f"{names[0]}: {words}", state))
        if text.startswith("go_to(") and state != "failed":
            nodes[names[0]] = names[1]
    return rows


def _action(text: str) -> Action:
    """Returns the action of a text, such as ``clean(agent,table1)`` or ``wait``."""
    name, arguments = parted(text)
    return Action(0, name, arguments)


def _party(run: Run, guest: str) -> Party:
    """Returns the party of a guest who is inside, or was."""
    inside = run.world.party_of(guest) or run.problem.state.party_of(guest)
    came = (seen for event in run.timed for seen in event.observations if seen.kind == "enter")
    return inside or next((seen.arguments for seen in came if guest in seen.arguments), (guest,))


def _bubbles(run: Run) -> list[Bubble]:
    world, crowd, room = run.world, run.crowd, run.room
    bubbles = []
    robots = run.shown_robots()
    carried = [robot.load for robot in robots]
    for name, place in world.tables.items():
        table = room.tables[name]
        wishes = ["the bill, please!"] if place.wants_bill and place.party else []
        wishes += ["we'd like to order"] if place.hungry else []
        wishes += [
            f"our {item} is empty"
            for t, item in sorted(world.hollow)
            if t == name and place.party and (t, item) not in carried
        ]
        if wishes:
            bubbles.append(Bubble(name, table.x, table.y, 1.35, " · ".join(wishes)))
    for party in world.queue:
        person = crowd.people.get(party[0])
        if person is not None and person.mode != "walk":
            text = "a table, please" if len(party) == 1 else f"a table for {len(party)}, please"
            bubbles.append(Bubble(party[0], person.x, person.y, 1.8, text))
    for robot in robots:
        if robot.saying:
            speaker = "robot" if len(robots) == 1 else f"robot {robot.name}"
            bubbles.append(Bubble(speaker, robot.pose[0], robot.pose[1], 1.35, robot.saying))
    return bubbles
