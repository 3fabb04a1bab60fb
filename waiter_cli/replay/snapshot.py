"""What a picture shows at one moment: `Player` → `Snapshot`. Entry point `take`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from waiter_cli.replay.script import Pose

if TYPE_CHECKING:
    from waiter_cli.replay.play import Player

__all__ = ["Bubble", "Figurine", "Row", "Snapshot", "brief", "take"]


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


def brief(text: str) -> str:
    """An action as the side panel has it.

    >>> brief("go_to(agent,n2)"), brief("bring(agent,jug,table1)")
    ('go to n2', 'bring jug table1')
    """
    name, _, rest = text.partition("(")
    words = [word for word in rest.rstrip(")").split(",") if word != "agent"]
    if name == "bring_chairs":
        return f"{words[1]} chairs at {words[0]}"
    return " ".join([name.replace("_", " "), *words])


def take(player: Player) -> Snapshot:
    """What is there now."""
    world, crowd = player.world, player.crowd
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
    rows = [Row(brief(deed.text), deed.state) for deed in player.deeds]
    now = player._action.step if player._action is not None else -1
    rows += [Row(brief(a.text), "next") for a in player.mind.decision.plan if a.step != now]
    current = max(0, len(player.deeds) - 1)
    return Snapshot(
        player.title, player.time, player.pose, world.load[1] if world.load else None,
        tuple(people), tuple((n, p.chairs) for n, p in world.tables.items()),
        tuple(n for n, p in world.tables.items() if p.served and p.party), tuple(_bubbles(player)),
        player.banner, tuple(rows), current,
    )  # fmt: skip


def _bubbles(player: Player) -> list[Bubble]:
    world, crowd, room = player.world, player.crowd, player.room
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
    if player.saying:
        found.append(Bubble("robot", player.pose[0], player.pose[1], 1.35, player.saying))
    return found
