"""The keys of a file of cases. Entry points `read_cases`, `read_case_folder`.

Every fault is noted with its place, and reading goes on.
"""

from __future__ import annotations

import os
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from waiter_cli.domain_tests.cases import Case, SparcText
from waiter_cli.errors import Fault, InputError, LayoutError, Where
from waiter_cli.file_access.locate import is_stream, read_text
from waiter_cli.files.layout_reader import layout_in
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.problems.pose import pose_problem
from waiter_cli.yaml_reading.node_reader import NodeReader
from waiter_cli.yaml_reading.yaml_tree import Document, Listing, Mapping, Node, Scalar, compose

if TYPE_CHECKING:
    from waiter_cli.model.scenario import Scenario

__all__ = ["read_case_folder", "read_cases"]

NOTHING: Final = "nothing"
MAX_STEPS = 50
_FILE_KEYS = ("layout", "cases")
_CASE_KEYS = (
    "name",
    "layout",
    "given",
    "when",
    "steps",
    "then",
    "never",
    "some",
    "exactly",
    "impossible",
)
_SCENARIO_KEYS = ("state", "observe", "goals", "before", "instant_kitchen")
_GIVEN_KEYS = (*_SCENARIO_KEYS, "facts", "offer")


def read_cases(text: str, name: str, folder: str | None = None) -> tuple[Case, ...]:
    """Returns the cases of one file; a layout's path starts from ``folder``.

    Raises `LayoutError` with every fault that was found.
    """
    document = compose(text, name)
    reader = NodeReader(document)
    root: Node = Mapping((), Where(name, 1, 1)) if document.root is None else document.root
    keys = reader.mapping(root, "a file of cases", _FILE_KEYS)
    if keys is None:
        reader.finish()
        raise AssertionError("a root that is no mapping is a fault")
    cases = _CasesReader(reader, document, folder).cases(root, keys)
    reader.finish()
    return cases


class _CasesReader:
    """Reads the cases of one file; each layout is read once."""

    def __init__(self, reader: NodeReader, document: Document, folder: str | None) -> None:
        self.reader = reader
        self.document = document
        self.folder = folder
        self.layouts: dict[int, Layout | None] = {}

    def cases(self, root: Node, keys: dict[str, Node]) -> tuple[Case, ...]:
        listed = self.reader.items(keys["cases"], "cases") if "cases" in keys else None
        if listed == () or self.reader.lacks(root, "cases", _FILE_KEYS):
            self.reader.fault(root.where, "no cases in this file", "add cases: [{name: …}]")
        names: dict[str, Where] = {}
        cases = []
        for node in listed or ():
            case = self.case(node, keys.get("layout"))
            if case is None:
                continue
            first = names.setdefault(case.name, case.where)
            if first != case.where:
                self.reader.fault(
                    case.where, f"two cases are called {case.name}", f"the first is at {first}"
                )
            cases.append(case)
        return tuple(cases)

    def case(self, node: Node, shared_layout: Node | None) -> Case | None:
        """Returns one case, None where something was wrong with it."""
        reader = self.reader
        before = len(reader.faults)
        keys = reader.mapping(node, "a case", _CASE_KEYS)
        if keys is None:
            return None
        name = reader.text(keys["name"], "the case's name") if "name" in keys else None
        if reader.lacks(node, "name", _CASE_KEYS):
            hint = "add name: what the case shows, in a few words"
            reader.fault(node.where, "a case without a name", hint)
        when = None
        if "when" in keys:
            when = self.steps(keys["when"], "when")
        steps = 1
        if "steps" in keys:
            steps = reader.integer(keys["steps"], "steps", 1, MAX_STEPS) or 1
            if when is not None:
                hint = "leave it out"
                reader.fault(keys["steps"].where, "when tells how many steps there are", hint)
        expected = {
            key: self.pieces(keys[key], key) if key in keys else ()
            for key in ("then", "never", "some")
        }
        exactly = None
        if "exactly" in keys:
            exactly = reader.integer(keys["exactly"], "exactly, the number of answer sets,", 1, 999)
        impossible = (
            "impossible" in keys and reader.boolean(keys["impossible"], "impossible") is True
        )
        claims = any(expected.values()) or "exactly" in keys
        if impossible and claims:
            hint = "without answer sets nothing else can be said: leave one out"
            reader.fault(keys["impossible"].where, "impossible, and yet something follows", hint)
        if not impossible and not claims and len(reader.faults) == before:
            hint = "add then:, never:, some:, exactly: or impossible: true"
            reader.fault(node.where, "a case that expects nothing", hint)
        posed = self.given(node, keys, shared_layout)
        if posed is None or len(reader.faults) > before or name is None:
            return None
        problem, facts, offer, has_goals = posed
        if impossible and when is None and not facts:
            hint = "add when: or facts: what it is that cannot be"
            reader.fault(node.where, "nothing is said to be impossible", hint)
            return None
        return Case(
            name,
            node.where,
            problem,
            has_goals,
            facts,
            offer,
            when,
            steps,
            exactly=exactly,
            impossible=impossible,
            **expected,
        )

    def given(
        self, case: Node, keys: dict[str, Node], shared_layout: Node | None
    ) -> tuple[Problem, tuple[SparcText, ...], tuple[SparcText, ...] | None, bool] | None:
        """Returns the problem of a case, its facts, the plan on offer, and whether it names goals."""
        from waiter_cli.files.scenario_reader import read_document

        reader = self.reader
        layout = self.layout(keys.get("layout", shared_layout), case)
        given = keys.get("given")
        known = (reader.mapping(given, "given", _GIVEN_KEYS) if given else None) or {}
        facts = self.pieces(known["facts"], "facts") if "facts" in known else ()
        offer = self.steps(known["offer"], "offer") if "offer" in known else None
        if layout is None:
            return None
        entries = given.entries if isinstance(given, Mapping) else ()
        kept = tuple((key, value) for key, value in entries if key.text in _SCENARIO_KEYS)
        inner = self.part(Mapping(kept, given.where if given else case.where))
        try:
            scenario: Scenario = read_document(inner, layout)
            problem = pose_problem(layout, scenario)
        except LayoutError as error:
            reader.faults.extend(error.faults)
            return None
        for reason in problem.contradictions:
            hint = "say under facts what a scenario refuses"
            reader.fault(reason.where or case.where, reason.message, hint)
        has_goals = scenario.goals is not None or bool(scenario.before)
        if scenario.goals is None:
            problem = replace(problem, goals=(), everybody=False)
        return problem, facts, offer, has_goals

    def part(self, node: Node) -> Document:
        """Returns a part of this file as a document of its own; its faults are the file's."""
        return Document(self.document.name, self.document.lines, node, ())

    def layout(self, node: Node | None, case: Node) -> Layout | None:
        """Returns the layout that a node stands for, None after noting what is wrong."""
        from waiter_cli.files.layout_reader import read_document

        if node is None:
            hint = "add layout: NAME, or nodes and tables, to the file or to the case"
            self.reader.fault(case.where, "a case without a layout", hint)
            return None
        if id(node) in self.layouts:
            return self.layouts[id(node)]
        layout = None
        try:
            if isinstance(node, Scalar):
                if self.reader.text(node, "layout") is not None:
                    file = read_text(node.text, "layout", self.folder, node.where)
                    layout = layout_in(file, node.where)
            else:
                layout = read_document(self.part(node))
        except LayoutError as error:
            self.reader.faults.extend(error.faults)
        self.layouts[id(node)] = layout
        return layout

    def steps(self, node: Node, what: str) -> tuple[SparcText, ...]:
        """Returns the actions at step 0, 1, …; the text is empty where nothing occurs."""
        steps = self.pieces(node, what)
        if len(steps) > MAX_STEPS:
            self.reader.fault(node.where, f"{what} has more than {MAX_STEPS} steps")
        return tuple(replace(said, text="") if said.text == NOTHING else said for said in steps)

    def pieces(self, node: Node, what: str) -> tuple[SparcText, ...]:
        """Returns the texts of a list.

        In ``[p(a, b), q]`` YAML sees three items; what parentheses hold together is put together
        again.
        """
        if isinstance(node, Scalar) and not node.is_nothing:
            node = Listing((node,), node.where)
        texts: list[SparcText] = []
        waiting: list[Scalar] = []
        for item in self.reader.items(node, what) or ():
            if not isinstance(item, Scalar) or not item.text.strip():
                self.reader.wrong(item, f"an item of {what}", "a text in SPARC")
                continue
            waiting.append(item)
            if item.plain and sum(_depth(part.text) for part in waiting) > 0:
                continue
            texts.append(self.joined(waiting))
            waiting = []
        if waiting:
            texts.append(self.joined(waiting))
        return tuple(texts)

    def joined(self, items: list[Scalar]) -> SparcText:
        """Items that are one piece, as the file writes them where they stand on one line."""
        first, last = items[0], items[-1]
        where = first.where
        line = self.document.excerpt(where)
        text = ", ".join(item.text for item in items)
        if len(items) > 1 and line is not None and where.line == last.where.line:
            text = line[where.column - 1 : last.where.column - 1 + len(last.text)]
        if not first.plain:
            where = replace(where, column=where.column + 1)
        return SparcText(text, where, line)


def _depth(text: str) -> int:
    return text.count("(") - text.count(")")


def read_case_folder(folder: str) -> tuple[Case, ...]:
    """Returns the cases of every YAML file in a folder, files by name, cases in their order.

    Raises `LayoutError` with every fault of every file, and where there is no such file.
    """
    try:
        names = sorted(n for n in os.listdir(folder) if n.endswith((".yaml", ".yml")))
        names = [n for n in names if not is_stream(os.path.join(folder, n))]
    except OSError:
        names = []
    if not names:
        hint = "write some: NAME.yaml in a folder cases/ beside the domain"
        raise LayoutError([Fault(Where(folder), "there are no cases", hint)])
    cases: list[Case] = []
    faults: list[Fault] = []
    for name in names:
        file = read_text(os.path.join(folder, name), "case file")
        try:
            cases.extend(read_cases(file.text, file.shown, folder))
        except InputError as error:
            faults.extend(error.faults)
    if faults:
        raise LayoutError(faults)
    return tuple(cases)
