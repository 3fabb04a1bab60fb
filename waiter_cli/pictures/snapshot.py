"""Takes what a picture shows at one moment: `Run` → `Snapshot`. Entry point `take`."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.plan import Action
from waiter_cli.model.state import Party, State
from waiter_cli.model.wording import describe
from waiter_cli.room.motion import Pose

if TYPE_CHECKING:
    from waiter_cli.simulation.run import Run

__all__ = ["Bubble", "Figurine", "Row", "Snapshot", "meaning", "take"]


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


class Row(NamedTuple):
    """A line of the plan: ``state`` is done, failed, now or next."""

    text: str
    state: str


@dataclass(frozen=True)
class Snapshot:
    """A moment; ``chairs`` how many stand at each table, ``served`` where plates are."""

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


@lru_cache(maxsize=4096)
def meaning(text: str, node: str, party: Party = ()) -> str:
    """Returns the meaning of an action, in the words of ``waiter plan``.

    The robot is at ``node``; ``party`` is that of the guest whom the action names.

    >>> meaning("go_to(agent,n2)", "n1"), meaning("seat(agent,c2,table1)", "n6", ("c2", "c3"))
    ('walk from n1 to n2', 'seat the party of c2 (2) at table1')
    """
    name, _, rest = text.partition("(")
    action = Action(0, name, tuple(rest.removesuffix(")").split(",")))
    return describe(action, State(agent=node, waiting=(party,) if party else ()))


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
    return Snapshot(
        run.shown.title, run.clock.time, run.body.pose, world.load[1] if world.load else None,
        tuple(people), tuple((n, p.chairs) for n, p in world.tables.items()),
        tuple(n for n, p in world.tables.items() if p.served and p.party), tuple(_bubbles(run)),
        run.shown.banner, tuple(rows), current,
    )  # fmt: skip


def _rows(run: Run) -> list[Row]:
    """Returns what was done and what is still to be done, each where it is or was to be done."""
    now = run.ongoing.action.step if run.ongoing.action is not None else -1
    lines = [(deed.text, deed.state) for deed in run.shown.deeds]
    lines += [(a.text, "next") for a in run.mind.decision.plan if a.step != now]
    node, rows = run.problem.state.agent, []
    for text, state in lines:
        names = text.partition("(")[2].removesuffix(")").split(",")
        led = text.startswith(("pick(", "seat("))
        rows.append(Row(meaning(text, node, _party(run, names[1]) if led else ()), state))
        if text.startswith("go_to(") and state != "failed":
            node = names[1]
    return rows


def _party(run: Run, guest: str) -> Party:
    """Returns the party of a guest who is inside, or was."""
    inside = run.world.party_of(guest) or run.problem.state.party_of(guest)
    came = (seen for event in run.timed for seen in event.observations if seen.kind == "enter")
    return inside or next((seen.arguments for seen in came if guest in seen.arguments), (guest,))


def _bubbles(run: Run) -> list[Bubble]:
    world, crowd, room = run.world, run.crowd, run.room
    found = []
    for name, place in world.tables.items():
        table = room.tables[name]
        wishes = ["the bill, please!"] if place.wants_bill and place.party else []
        wishes += ["we'd like to order"] if place.hungry else []
        wishes += [
            f"our {item} is empty"
            for t, item in sorted(world.hollow)
            if t == name and place.party and world.load != (t, item)
        ]
        if wishes:
            found.append(Bubble(name, table.x, table.y, 1.35, " · ".join(wishes)))
    for party in world.queue:
        person = crowd.people.get(party[0])
        if person is not None and person.mode != "walk":
            text = "a table, please" if len(party) == 1 else f"a table for {len(party)}, please"
            found.append(Bubble(party[0], person.x, person.y, 1.8, text))
    if run.shown.saying:
        found.append(Bubble("robot", run.body.pose[0], run.body.pose[1], 1.35, run.shown.saying))
    return found
