"""Changes from one moment to the next, as pages draw them: `Snapshot` → JSON. Class `MomentDiffer`.

A *moment* maps keys to values: ``robot`` is ``[x, y, yaw, load]`` (of several, each is ``robot NAME``
and ``[x, y, yaw, load, number]``), ``@NAME`` a person ``[x, y, yaw,
role, number, posture, hand]``, ``!SPEAKER`` a bubble ``[x, y, text]`` (centimetres and degrees);
``banner``, ``chairs`` (table → how many) and ``served`` (tables) are as in `Snapshot`, ``rows`` and
``current`` its plan.  ``page/moments.js`` puts moments together again.
"""

from __future__ import annotations

from typing import Any

from waiter_cli.pictures.snapshot import Snapshot

__all__ = ["Change", "MomentDiffer", "moment_document"]

Change = list[Any]
"""``[seconds, what changed, keys that are gone]``."""


class MomentDiffer:
    """Remembers the last moment, and tells what is different in the next one."""

    def __init__(self) -> None:
        self.moment: dict[str, Any] = {}

    def change(self, snapshot: Snapshot, rows: list[list[str]] | None = None) -> Change | None:
        """Returns the change that leads to a snapshot, None where nothing is different.

        ``rows`` take the place of the snapshot's own.
        """
        now = moment_document(snapshot)
        if rows is not None:
            waiting = (i for i, row in enumerate(rows) if row[1] in ("now", "next"))
            now["rows"], now["current"] = rows, next(waiting, 0)
        changed = {key: value for key, value in now.items() if self.moment.get(key) != value}
        gone = [key for key in self.moment if key not in now]
        first = not self.moment
        self.moment = now
        if not (changed or gone or first):
            return None
        return [round(snapshot.time, 3), changed, gone]


def moment_document(moment: Snapshot) -> dict[str, Any]:
    """Returns a whole moment."""
    now: dict[str, Any] = {}
    for each in moment.robots:
        more = [each.number] if moment.crew else []
        now[each.key] = [*_pose(each.pose), each.load or "", *more]
    for p in moment.people:
        at = _pose((p.x, p.y, p.yaw))
        now["@" + p.name] = [*at, p.role, p.number, p.posture, int(p.hand)]
    for bubble in moment.bubbles:
        where = [round(bubble.x * 100), round(bubble.y * 100)]
        now["!" + bubble.speaker] = [*where, bubble.text]
    now["banner"] = moment.banner
    now["chairs"] = dict(moment.chairs)
    now["served"] = list(moment.served)
    now["rows"] = [[row.text, row.state] for row in moment.rows]
    now["current"] = moment.current
    return now


def _pose(pose: tuple[float, float, float]) -> list[int]:
    """Centimetres and degrees."""
    return [round(pose[0] * 100), round(pose[1] * 100), round(pose[2] * 57.29578)]
