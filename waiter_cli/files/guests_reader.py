"""The key ``guests`` of a scenario, guests who come by chance → `GuestModel`. Entry point `read_guests`."""

from __future__ import annotations

from typing import Any

from sparc.numerals import decimal
from waiter_cli.model.guest_model import GuestModel, Span
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Listing, Mapping, Node, Scalar

__all__ = ["GUEST_KEYS", "MOST_MINUTES", "read_guests"]

GUEST_KEYS = (
    "arrivals", "sizes", "order_after", "cook", "eat", "refills", "bill_after", "patience",
    "patience_served",
)  # fmt: skip
MOST_MINUTES = 1440.0
MOST_PER_HOUR = 1000.0
MOST_HEADS = 100
_SPANS = ("order_after", "cook", "eat", "bill_after")


def read_guests(reader: NodeReader, node: Node | None, minutes: Node | None) -> GuestModel | None:
    """Returns the guests of a scenario; None without the key, or where something was wrong.

    ``minutes`` is the length of the evening, which guests need unless the times at which they come
    are given.  Every fault is noted with its place.
    """
    if node is None or (isinstance(node, Scalar) and node.is_nothing):
        if minutes is not None:
            reader.fault(minutes.where, "minutes without guests", "add guests: {arrivals: …}")
        return None
    before = len(reader.faults)
    keys = reader.mapping(node, "guests", GUEST_KEYS)
    if keys is None:
        return None
    values: dict[str, Any] = {}
    length = _amount(reader, minutes, "minutes", MOST_MINUTES) if minutes is not None else None
    if "arrivals" in keys:
        values.update(_arrivals(reader, keys["arrivals"]))
    elif reader.lacks(node, "arrivals", GUEST_KEYS):
        hint = "add arrivals: {per_hour: 20}, or arrivals: {at: [[0, 2], [7.5, 4]]}"
        reader.fault(node.where, "guests without arrivals", hint)
    if "sizes" in keys:
        values["sizes"] = _sizes(reader, keys["sizes"])
    for name in _SPANS:
        if name in keys:
            values[name] = _span(reader, keys[name], name)
    if "refills" in keys:
        values["refills"] = _amount(reader, keys["refills"], "refills", MOST_PER_HOUR)
    for name in ("patience", "patience_served"):
        if name in keys:
            values[name] = _amount(reader, keys[name], name, MOST_MINUTES)
    if length is None and minutes is None:
        if "per_hour" in values:
            hint = "add minutes: 180 to the scenario, beside guests"
            reader.fault(node.where, "guests come by the hour, and nothing says for how long", hint)
        length = max((at for at, _ in values.get("at", ())), default=0.0)
    if len(reader.faults) > before or length is None:
        return None
    return GuestModel(minutes=length, **values)


def _arrivals(reader: NodeReader, node: Node) -> dict[str, Any]:
    """Returns ``per_hour`` or ``at``, one of the two."""
    keys = reader.mapping(node, "arrivals", ("per_hour", "at")) or {}
    if len(keys) != 1:
        if isinstance(node, (Mapping, Scalar)):
            hint = "write {per_hour: 20}, or {at: [[0, 2], [7.5, 4]]}"
            reader.fault(node.where, "arrivals has per_hour or at, one of the two", hint)
        return {}
    if "per_hour" in keys:
        rate = _amount(reader, keys["per_hour"], "per_hour", MOST_PER_HOUR)
        return {} if rate is None else {"per_hour": rate}
    times: list[tuple[float, int]] = []
    for item in reader.items(keys["at"], "at", "write [[0, 2], [7.5, 4]]") or ():
        pair = item.items if isinstance(item, Listing) else ()
        if len(pair) != 2:
            reader.wrong(item, "an arrival", "a pair of a minute and heads", "such as [7.5, 4]")
            continue
        minute = _amount(reader, pair[0], "the minute of an arrival", MOST_MINUTES)
        heads = reader.integer(pair[1], "heads of an arrival", 1, MOST_HEADS)
        if minute is not None and heads is not None:
            times.append((minute, heads))
    return {"at": tuple(sorted(times, key=lambda pair: pair[0]))}


def _sizes(reader: NodeReader, node: Node) -> tuple[tuple[int, float], ...]:
    """Returns the shares by heads, scaled to sum to 1."""
    shares: dict[int, float] = {}
    before = len(reader.faults)
    for key, value in reader.entries(node, "sizes") or ():
        heads = reader.integer(key, "heads of a party", 1, MOST_HEADS)
        share = _amount(reader, value, "the share of a size", 1e6)
        if heads is not None and share is not None:
            shares[heads] = share
    total = sum(shares.values())
    if total <= 0.0:
        if len(reader.faults) == before:
            hint = "write {1: 0.2, 2: 0.5, 4: 0.3}"
            reader.fault(node.where, "sizes gives no party a share", hint)
        return ()
    return tuple((heads, share / total) for heads, share in sorted(shares.items()) if share > 0)


def _span(reader: NodeReader, node: Node, what: str) -> Span | None:
    """Returns minutes as ``[least, most]``, ``{mean: 4, sd: 1}`` or one number."""
    if isinstance(node, Listing):
        if len(node.items) != 2:
            reader.wrong(node, what, "minutes [least, most]", "such as [2, 6]")
            return None
        low = _amount(reader, node.items[0], f"least of {what}", MOST_MINUTES)
        high = _amount(reader, node.items[1], f"most of {what}", MOST_MINUTES)
        if low is None or high is None:
            return None
        if high < low:
            hint = f"write [{high:g}, {low:g}]"
            reader.fault(node.where, f"{what} ends before it begins", hint)
            return None
        return Span("uniform", low, high)
    if isinstance(node, Mapping):
        keys = reader.mapping(node, what, ("mean", "sd")) or {}
        if "mean" not in keys:
            reader.fault(node.where, f"{what} has no mean", "write {mean: 4, sd: 1}")
            return None
        mean = _amount(reader, keys["mean"], f"mean of {what}", MOST_MINUTES)
        sd = 0.0
        if "sd" in keys:
            sd = _amount(reader, keys["sd"], f"sd of {what}", MOST_MINUTES) or 0.0
        return None if mean is None else Span("normal", mean, sd)
    if isinstance(node, Scalar) and decimal(node.text) is not None:
        minutes = _amount(reader, node, what, MOST_MINUTES)
        return None if minutes is None else Span("uniform", minutes, minutes)
    form = "write [2, 6] (uniform), or {mean: 4, sd: 1} (normal)"
    reader.wrong(node, what, "minutes [least, most]", form)
    return None


def _amount(reader: NodeReader, node: Node, what: str, most: float) -> float | None:
    """Returns a number from 0 to ``most``."""
    expected = f"a number from 0 to {most:g}"
    if isinstance(node, Scalar) and node.plain:
        value = decimal(node.text)
        if value is not None and 0.0 <= value <= most:
            return value
    reader.wrong(node, what, expected, "write digits alone, such as 4 or 7.5")
    return None
