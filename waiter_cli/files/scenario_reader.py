"""The keys of a scenario file. Entry points `read_scenario`, `read_scenario_file`.

Source: contract, "Scenario (YAML)".  Every fault is noted with its place; a `Scenario` is made
only when nothing was wrong.
"""

from __future__ import annotations

import os

from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.file_access.kinds import told_as_it_is
from waiter_cli.file_access.locate import read_text
from waiter_cli.files.goal_reader import (
    OBSERVATIONS,
    read_before,
    read_goals,
    read_observation,
    read_observations,
)
from waiter_cli.files.guests_reader import read_guests
from waiter_cli.files.layout_reader import layout_in
from waiter_cli.files.names import Names
from waiter_cli.files.own_terms import read_facts
from waiter_cli.files.state_reader import read_state
from waiter_cli.model.layout import Layout
from waiter_cli.model.scenario import Scenario, TimedEvent
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Document, Listing, Mapping, Node, Scalar, compose

__all__ = ["KEYS", "PREFERENCES", "read_scenario", "read_document", "read_scenario_file"]

KEYS = (
    "name",
    "layout",
    "state",
    "observe",
    "goals",
    "before",
    "prefer",
    "events",
    "instant_kitchen",
    "guests",
    "minutes",
    "facts",
)
PREFERENCES = ("shortest_walk", "smallest_table", "longest_waiting", "earliest")


def read_scenario(text: str, name: str, layout: Layout) -> Scenario:
    """Returns the scenario that a YAML text describes, read against a layout.

    Its own ``layout`` key is kept and not followed.  Raises `LayoutError` with every fault that
    was found, each with its line and column.
    """
    return read_document(compose(text, name), layout)


def read_scenario_file(
    name: str, layout: Layout | None = None, *, several: bool = False
) -> tuple[Layout, Scenario]:
    """Returns the scenario of a file, a built-in name such as ``b1`` or standard
    input (``-``), and its layout.

    A layout that is given wins over the one that the scenario names (a path from the scenario's
    own file, or a built-in).  Raises `LayoutError` as `read_scenario` and `read_layout` do, and
    where there is no such file or no layout at all; unless ``several`` is true, for several robots.
    """
    file = read_text(name, "scenario")
    with told_as_it_is(file.text, file.shown, "a scenario"):
        document = compose(file.text, file.shown)
    if layout is None:
        wanted = _layout_named(document)
        folder = os.path.dirname(file.path) if file.path is not None else None
        found = read_text(wanted.text, "layout", folder, wanted.where)
        layout = layout_in(found, wanted.where, several=several)
    with told_as_it_is(file.text, file.shown, "a scenario"):
        return layout, read_document(document, layout)


def _layout_named(document: Document) -> Scalar:
    """Returns the value of the key ``layout``; `LayoutError` where there is none to follow."""
    top = Where(document.name, 1, 1)
    root = document.root
    entries = root.entries if isinstance(root, Mapping) else ()
    node = next((value for key, value in entries if key.text == "layout"), None)
    if node is None or (isinstance(node, Scalar) and node.is_nothing):
        where = root.where if root is not None else top
        hint = "add layout: NAME, or give --layout"
        if {"nodes", "edges"} <= {key.text for key, _ in entries}:
            hint = "this is a layout: give it with --layout"
        fault = Fault(where, "the scenario names no layout", hint)
        raise LayoutError([*document.faults, fault])
    if not isinstance(node, Scalar) or node.text == "-":
        message = "layout must be a name or the path of a file"
        fault = Fault(node.where, message, None, document.excerpt(node.where))
        raise LayoutError([*document.faults, fault])
    return node


def read_document(document: Document, layout: Layout) -> Scenario:
    """Returns the scenario of a tree, which may stand inside another file."""
    reader = NodeReader(document)
    root: Node = Mapping((), Where(document.name, 1, 1)) if document.root is None else document.root
    if document.root is None:
        hint = "a scenario has state, observe or goals"
        reader.fault(root.where, "the file is empty", hint)
    keys = reader.mapping(root, "a scenario", KEYS) or {}
    names = Names(layout)
    observe = keys.get("observe")
    state, places = read_state(reader, keys.get("state"), names, _employees_seen(observe))
    observations = read_observations(reader, observe, names) if observe else ()
    events = _events(reader, keys.get("events"), names)
    goals = before = None
    if "goals" in keys and not _left_out(keys["goals"]):
        goals = read_goals(reader, keys["goals"], names)
    if "before" in keys:
        before = read_before(reader, keys["before"], names)
    preferences = keys.get("prefer")
    prefer = (
        reader.known_names(preferences, "prefer", "preference", PREFERENCES) if preferences else ()
    )
    instant = False
    if "instant_kitchen" in keys:
        instant = reader.boolean(keys["instant_kitchen"], "instant_kitchen") or False
    facts = read_facts(reader, keys["facts"]) if "facts" in keys else ()
    guests = read_guests(reader, keys.get("guests"), keys.get("minutes"))
    name = layout_name = None
    if "name" in keys:
        name = reader.text(keys["name"], "the scenario's name")
    if "layout" in keys and not _left_out(keys["layout"]):
        layout_name = reader.text(keys["layout"], "layout")
    reader.finish()
    return Scenario(
        name=name or _stem(document.name),
        state=state,
        observe=observations,
        goals=goals,
        before=before or (),
        prefer=tuple(word for word, _ in prefer),
        events=events,
        instant_kitchen=instant,
        guests=guests,
        facts=facts,
        layout=layout_name,
        file=document.name,
        state_where=tuple(places.items()),
    )


def _events(reader: NodeReader, node: Node | None, names: Names) -> tuple[TimedEvent, ...]:
    """Returns the later events by time; equal times keep the order of the file."""
    events: list[TimedEvent] = []
    for item in reader.items(node, "events") or () if node else ():
        what = "an event"
        entries = reader.entries(item, what)
        if entries is None:
            continue
        at = next((value for key, value in entries if key.text == "time"), None)
        time = None
        if at is None:
            reader.fault(item.where, "an event without a time", "add time: SECONDS")
        else:
            time = reader.number(at, "time of an event", 0)
        rest = tuple((key, value) for key, value in entries if key.text != "time")
        if not rest:
            example = f"add one of {', '.join(OBSERVATIONS)}"
            reader.fault(item.where, "an event at which nothing happens", example)
            continue
        seen = read_observation(reader, Mapping(rest, item.where), names)
        if time is not None:
            events.append(TimedEvent(time, tuple(seen), item.where))
    return tuple(sorted(events, key=lambda event: event.time))


def _employees_seen(node: Node | None) -> frozenset[str]:
    """Returns everybody whose place an observation gives, as far as one can tell before reading it."""
    items = node.items if isinstance(node, Listing) else (node,)
    entries = [entry for item in items if isinstance(item, Mapping) for entry in item.entries]
    seen = [value for key, value in entries if key.text == "at" and isinstance(value, Mapping)]
    return frozenset(key.text for value in seen for key, _ in value.entries)


def _left_out(node: Node) -> bool:
    return isinstance(node, Scalar) and node.is_nothing


def _stem(file: str) -> str:
    return os.path.basename(file).rsplit(".", 1)[0] or "scenario"
