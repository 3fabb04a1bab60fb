"""A study's file (YAML) → `Study`. Entry points `read_study`, `read_study_file`.

Layouts and the scenario are read too, each layout with the scenario, so that what is wrong is told
before anything is played.  Every fault is noted with its place.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

from sparc.numerals import decimal, whole
from waiter_cli.errors import Fault, InputError, LayoutError, Where
from waiter_cli.file_access.kinds import told_as_it_is
from waiter_cli.file_access.locate import read_text
from waiter_cli.files.layout_reader import layout_in, read_layout
from waiter_cli.files.layout_writer import write_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.layout_tools.generate_floor import least_nodes
from waiter_cli.model.layout import Layout
from waiter_cli.model.source_file import File
from waiter_cli.study.fleet_size import with_fleet_size
from waiter_cli.study.studies import Study, StudyLayout
from waiter_cli.yaml_reading.node_reader import NodeReader, is_identifier
from waiter_cli.yaml_reading.yaml_tree import Listing, Mapping, Node, Scalar, compose

__all__ = ["MOST_RUNS", "SPEED", "read_seeds", "read_study", "read_study_file"]

KEYS = ("name", "layouts", "vary", "evenings")
EVENING = "evenings: {scenario: friday.yaml, seeds: 1..50}"
GENERATE = ("tables", "nodes", "bar", "waiters", "name", "seeds")
VARY = ("agents", "speed")
EVENINGS = ("scenario", "seeds")
MOST_RUNS = 1_000_000
MOST_SEED = 2**31 - 1
MOST_ROBOTS = 20
SPEED = 0.8
Value = TypeVar("Value", int, float)


def read_study_file(name: str) -> Study:
    """Returns the study in a file, ``-`` for standard input; raises as `read_study`."""
    file = read_text(name, "study", where=Where("STUDY"))
    folder = os.path.dirname(file.path) if file.path is not None else None
    with told_as_it_is(file.text, file.shown, "a study"):
        return read_study(file.text, file.shown, folder)


def read_study(text: str, name: str, folder: str | None = None) -> Study:
    """Returns the study that a YAML text describes; relative paths begin in ``folder``.

    Raises `LayoutError` with every fault, each with its line and column.
    """
    return _StudyReader(compose(text, name), folder).read()


def read_seeds(reader: NodeReader, node: Node, what: str) -> tuple[int, ...]:
    """Returns whole numbers: ``1..50``, one number, or a list of these; a fault is noted for others."""
    return _several(reader, node, what, _ints(0, MOST_SEED), "write 1..50, or [1, 2, 3]")


class _StudyReader:
    def __init__(self, document: Any, folder: str | None) -> None:
        self.reader = NodeReader(document)
        self.document = document
        self.folder = folder

    def read(self) -> Study:
        reader, name = self.reader, self.document.name
        root: Node = self.document.root or Mapping((), Where(name, 1, 1))
        if self.document.root is None:
            hint = "a study has layouts and evenings"
            reader.fault(root.where, "the file is empty", hint)
        keys = self._keys(root, "a study", KEYS, f"write layouts: [bistro], and {EVENING}")
        title = reader.text(keys["name"], "the study's name") if "name" in keys else _stem(name)
        agents, speeds = self._vary(keys.get("vary"))
        for key, example in (
            ("layouts", "add layouts: [bistro]"),
            ("evenings", f"add {EVENING}"),
        ):
            if self.document.root is not None and reader.lacks(root, key, KEYS):
                reader.fault(root.where, f"a study without {key}", example)
        layouts = self._layouts(keys["layouts"]) if "layouts" in keys else []
        fleets = list(self._fleets(layouts, agents, keys.get("vary")))
        self._differ(fleets)
        scenario, text = "", ""
        seeds: tuple[int, ...] = ()
        if "evenings" in keys:
            scenario, text, seeds = self._evenings(keys["evenings"], fleets)
        size = len(fleets) * len(speeds) * len(seeds)
        if size > MOST_RUNS:
            told = f"the study has {size} runs, at most {MOST_RUNS} are read"
            reader.fault(root.where, told, "leave out layouts or seeds")
        reader.finish()
        varied = [
            *(["layout"] if len(layouts) > 1 else []),
            *(["agents"] if len(agents) > 1 else []),
            *(["speed"] if len(speeds) > 1 else []),
        ]
        found = tuple(layout for _, layout, _ in fleets)
        return Study(title or "", name, found, speeds, scenario, text, seeds, tuple(varied))

    def _keys(self, node: Node, what: str, keys: Sequence[str], form: str) -> dict[str, Node]:
        """Returns the values of a mapping by key; what is no mapping is told how to be one."""
        if isinstance(node, Listing) or (isinstance(node, Scalar) and not node.is_nothing):
            self.reader.wrong(node, what, "a mapping (key: value)", form)
            return {}
        return self.reader.mapping(node, what, keys) or {}

    # ------------------------------------------------------------ layouts

    def _layouts(self, node: Node) -> list[tuple[Where, StudyLayout, Layout]]:
        """Returns the layouts, each with its place in the study and as it was read."""
        layouts: list[tuple[Where, StudyLayout, Layout]] = []
        items = self.reader.items(node, "layouts", "write layouts: [bistro, mine.yaml]") or ()
        if not items and isinstance(node, Listing):
            self.reader.fault(node.where, "layouts is empty", "write layouts: [bistro]")
        for item in items:
            if isinstance(item, Mapping):
                layouts += self._generated(item)
            elif isinstance(item, Scalar) and item.text == "-":
                self.reader.fault(item.where, "a layout must be a file or a built-in")
            else:
                name = self.reader.text(item, "a layout")
                read = None if name is None else self._layout(name, item.where)
                if read is not None:
                    layouts.append((item.where, *read))
        taken: dict[str, Where] = {}
        for where, layout, _ in layouts:
            first = taken.setdefault(layout.label, where)
            if first is not where:
                told = f"layout {layout.label} is listed twice"
                self.reader.fault(where, told, f"it is given already at line {first.line}")
        return layouts

    def _layout(self, name: str, where: Where) -> tuple[StudyLayout, Layout] | None:
        try:
            file = read_text(name, "layout", self.folder, where)
            layout = layout_in(file, where, several=True)
        except LayoutError as error:
            self.reader.faults += error.faults
            return None
        return StudyLayout(name, file.text, file.shown), layout

    def _generated(self, node: Mapping) -> Iterator[tuple[Where, StudyLayout, Layout]]:
        """Yields the layouts of ``{generate: {tables: 12, seeds: 1..20}}``."""
        reader = self.reader
        outer = reader.mapping(node, "a layout", ("generate",)) or {}
        if "generate" not in outer:
            if not node.entries:
                reader.fault(node.where, "a layout of nothing", "write a name, or {generate: …}")
            return
        keys = reader.mapping(outer["generate"], "generate", GENERATE)
        if keys is None:
            return
        before = len(reader.faults)
        tables = reader.integer(keys["tables"], "tables", 1, 1000) if "tables" in keys else 6
        nodes = reader.integer(keys["nodes"], "nodes", 2, 3000) if "nodes" in keys else None
        waiters = reader.integer(keys["waiters"], "waiters", 0, 100) if "waiters" in keys else 0
        bar = reader.boolean(keys["bar"], "bar") if "bar" in keys else False
        name = reader.text(keys["name"], "name") if "name" in keys else "generated"
        if name is not None and not is_identifier(name):
            reader.fault(
                keys["name"].where, f"{name} is no name for a layout", "write one such as cafe_a"
            )
        seeds: tuple[int, ...] = (1,)
        if "seeds" in keys:
            seeds = read_seeds(reader, keys["seeds"], "seeds of generate")
        if len(reader.faults) > before or tables is None:
            return
        if nodes is None:
            nodes = max(least_nodes(tables) + 1, round(2.4 * tables))
        for seed in seeds:
            label = f"{name}_{seed}"
            try:
                text = generate_layout(
                    seed, nodes, tables, name=label, bar=bool(bar), waiters=waiters or 0
                )
            except InputError as error:
                told = (Fault(node.where, each.message, each.hint) for each in error.faults)
                reader.faults += told
                return
            yield node.where, StudyLayout(label, text, label), read_layout(text, f"{label}.yaml")

    # ------------------------------------------------------------ what varies

    def _vary(self, node: Node | None) -> tuple[tuple[int, ...], tuple[float, ...]]:
        """Returns the numbers of robots, none where they do not vary, and the speeds."""
        reader = self.reader
        keys = {}
        if node is not None:
            keys = self._keys(node, "vary", VARY, "write vary: {agents: [1, 2], speed: [0.6, 0.8]}")
        agents: tuple[int, ...] = ()
        speeds: tuple[float, ...] = (SPEED,)
        if "agents" in keys:
            read = _ints(1, MOST_ROBOTS, "write [1, 2]")
            agents = _several(reader, keys["agents"], "agents", read, "write [1, 2]")
        if "speed" in keys:
            speeds = _several(reader, keys["speed"], "speed", _speed, "write [0.6, 0.8]")
        return agents, speeds

    def _fleets(
        self,
        layouts: list[tuple[Where, StudyLayout, Layout]],
        agents: tuple[int, ...],
        vary: Node | None,
    ) -> Iterator[tuple[Where, StudyLayout, Layout]]:
        """Yields the layouts with each number of robots."""
        for where, layout, read in layouts:
            for number in agents:
                try:
                    made = with_fleet_size(read, number)
                except InputError as error:
                    place = vary.where if vary is not None else where
                    told = (f"{layout.label}: {fault.message}" for fault in error.faults)
                    for message in told:
                        self.reader.fault(place, message, error.faults[0].hint)
                    continue
                text = layout.text if made is read else write_layout(made)
                yield where, StudyLayout(layout.label, text, layout.file, number), made
            if not agents:
                yield where, layout, read

    def _differ(self, fleets: list[tuple[Where, StudyLayout, Layout]]) -> None:
        """Notes layouts that are the same under two names: their evenings would be, too."""
        taken: dict[tuple[str, int | None], StudyLayout] = {}
        told: set[str] = set()
        for where, layout, _ in fleets:
            first = taken.setdefault((layout.text, layout.agents), layout)
            if first.label != layout.label and layout.label not in told:
                told.add(layout.label)
                self.reader.fault(
                    where, f"layout {layout.label} is the same as {first.label}",
                    "leave one out, or change it",
                )  # fmt: skip

    # ------------------------------------------------------------ evenings

    def _evenings(
        self, node: Node, layouts: list[tuple[Where, StudyLayout, Layout]]
    ) -> tuple[str, str, tuple[int, ...]]:
        """Returns the scenario's name and text, and the seeds."""
        reader = self.reader
        keys = self._keys(node, "evenings", EVENINGS, f"write {EVENING}")
        seeds: tuple[int, ...] = ()
        if "seeds" in keys:
            seeds = read_seeds(reader, keys["seeds"], "seeds")
        elif reader.lacks(node, "seeds", EVENINGS):
            reader.fault(node.where, "evenings without seeds", "add seeds: 1..50")
        if "scenario" not in keys:
            if reader.lacks(node, "scenario", EVENINGS):
                reader.fault(node.where, "evenings of no scenario", "add scenario: friday.yaml")
            return "", "", seeds
        where = keys["scenario"].where
        name = reader.text(keys["scenario"], "scenario")
        if name is None or name == "-":
            if name == "-":
                reader.fault(where, "a scenario must be a file or a built-in")
            return "", "", seeds
        try:
            file = read_text(name, "scenario", self.folder, where)
        except LayoutError as error:
            reader.faults += error.faults
            return "", "", seeds
        self._fits(file, layouts, where)
        return file.shown, file.text, seeds

    def _fits(
        self, file: File, layouts: list[tuple[Where, StudyLayout, Layout]], where: Where
    ) -> None:
        """Notes what is wrong with a scenario, and where it does not fit a layout."""
        known: set[Fault] = set()
        for _, _, read in layouts:
            try:
                with told_as_it_is(file.text, file.shown, "a scenario", where):
                    scenario = read_scenario(file.text, file.shown, read)
            except LayoutError as error:
                fresh = [fault for fault in error.faults if fault not in known]
                known.update(fresh)
                self.reader.faults += fresh
                continue
            if scenario.guests is None:
                hint = "give a scenario with guests, whose evenings differ"
                told = f"{file.shown} has no guests who come by chance"
                self.reader.fault(where, told, hint)
                return


# ---------------------------------------------------------------- small lists


def _several(
    reader: NodeReader,
    node: Node,
    what: str,
    read: Callable[[NodeReader, Scalar, str], tuple[Value, ...] | None],
    form: str,
) -> tuple[Value, ...]:
    """Returns the values of a scalar or a list of them, each once, in the order given."""
    items: tuple[Node, ...] = (node,)
    if isinstance(node, Listing):
        items = node.items
        if not items:
            reader.fault(node.where, f"{what} is empty", form)
    values: dict[Value, None] = {}
    for item in items:
        if not isinstance(item, Scalar):
            reader.wrong(item, what, "a number or a list of numbers", form)
            continue
        for value in read(reader, item, what) or ():
            if value in values:
                reader.fault(item.where, f"{what}: {value} is given twice", "leave one out")
            values[value] = None
    return tuple(values)


def _ints(
    least: int, most: int, form: str = "write 1..50"
) -> Callable[[NodeReader, Scalar, str], tuple[int, ...] | None]:
    """Returns a reader of one whole number or a range ``1..50``."""

    def read(reader: NodeReader, node: Scalar, what: str) -> tuple[int, ...] | None:
        low, dots, high = node.text.partition("..")
        first, last = whole(low.strip()), whole(high.strip()) if dots else whole(low.strip())
        if node.plain and first is not None and last is not None:
            if not least <= first <= most or not least <= last <= most:
                expected = f"whole numbers from {least} to {most}"
                reader.wrong(node, what, expected, "choose another")
                return None
            if last < first:
                told = f"{what} ends before it begins"
                reader.fault(node.where, told, f"write {last}..{first}")
                return None
            if last - first >= MOST_RUNS:
                told = f"{what} has {last - first + 1} numbers, at most {MOST_RUNS} are read"
                reader.fault(node.where, told, "leave some out")
                return None
            return tuple(range(first, last + 1))
        reader.wrong(node, what, "a whole number or a range", form)
        return None

    return read


def _speed(reader: NodeReader, node: Scalar, what: str) -> tuple[float, ...] | None:
    value = decimal(node.text) if node.plain else None
    if value is not None and 0.05 <= value <= 5.0:
        return (value,)
    reader.wrong(node, what, "0.05 to 5 metres a second", "write [0.6, 0.8]")
    return None


def _stem(file: str) -> str:
    return os.path.basename(file).rsplit(".", 1)[0] or "study"
