"""YAML → nodes: places, what is refused, and that nothing but `LayoutError` ever comes out."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.file_access import locate as resources
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.graph import layout_warnings
from waiter_cli.model.layout import Layout
from waiter_cli.problems.pose import pose_problem, problem_from_plan_document
from waiter_cli.yaml_reading.yaml_faults import MAX_DEPTH
from waiter_cli.yaml_reading.yaml_tree import (
    Document,
    Listing,
    Mapping,
    Node,
    Scalar,
    compose,
    node_from_value,
)

T = TypeVar("T")
LAYOUTS = Path(resources.data_folder("layouts"))


def plain(node: Node | None) -> object:
    """The node as lists, dicts and texts."""
    match node:
        case Mapping(entries=entries):
            return {key.text: plain(value) for key, value in entries}
        case Listing(items=items):
            return [plain(item) for item in items]
        case Scalar(text=text):
            return text
    return None


def faults_of(text: str) -> list[str]:
    """What is wrong with a text, whether reading stopped there or went on."""
    try:
        document = compose(text, "f")
    except LayoutError as error:
        return [str(fault) for fault in error.faults]
    return [str(fault) for fault in document.faults]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a: no", {"a": "no"}),
        ("on: off", {"on": "off"}),
        ("a: 12:30", {"a": "12:30"}),
        ("1e3: 0x10", {"1e3": "0x10"}),
        ("a: ~", {"a": "~"}),
        ("a:", {"a": ""}),
        ("- 2001-01-01", ["2001-01-01"]),
        ("{a: [b, {c: d}]}", {"a": ["b", {"c": "d"}]}),
        ('{"a":["b",1],"c\\/":"\\u00e9"}', {"a": ["b", "1"], "c/": "é"}),
        ("a: |\n  b\n  c\n", {"a": "b\nc\n"}),
        ("\ufeffa: b", {"a": "b"}),
        ("%YAML 1.1\n---\na: b\n...\n", {"a": "b"}),
        ("", None),
        ("# nothing\n", None),
        ("a: 'it''s'", {"a": "it's"}),
        ("? a\n: b", {"a": "b"}),
    ],
)
def test_scalars_stay_text(text: str, value: object) -> None:
    document = compose(text, "f")
    assert plain(document.root) == value
    assert document.faults == ()


def test_places_count_lines_and_columns_from_one() -> None:
    root = compose("a: b\n\nc:\n  - é: [x, y]\r\n  - z\n", "f").root
    assert isinstance(root, Mapping)
    items = root.entries[1][1]
    assert isinstance(items, Listing) and isinstance(items.items[0], Mapping)
    inner = items.items[0].entries[0][1]
    assert isinstance(inner, Listing)
    assert inner.items[1].where == Where("f", 4, 12)
    assert items.items[1].where == Where("f", 5, 5)
    assert str(root.entries[0][0].where) == "f:1:1"


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("a: &x b", "f:1:4: anchor &x is not read here; leave it out"),
        ("a: *x", "f:1:4: alias *x is not read here; write the value out"),
        ("a: !!python/object:os.system x", "tag tag:yaml.org,2002:python/object:os.system"),
        ("a: !x [b]", "f:1:4: tag !x is not read here"),
        ("a: 1\na: 2", "f:2:1: duplicate key a; it is given already at line 1"),
        ("{a: 1, a: 2}", "f:1:8: duplicate key a"),
        ("a: 1\n---\nb: 2", "f:2:1: a second document begins here; keep one in a file"),
        ("{a: b}: c", "f:1:1: a key must be a name"),
        ("? [a]\n: b", "f:1:3: a key must be a name"),
        ("a: [b, c", "f:1:4: the list that opens here is not closed; expected , or ]"),
        ("a: {b: c", "f:1:4: the mapping that opens here is not closed; expected , or }"),
        ("a: 'b", "f:1:4: the quote that opens here is never closed; close it"),
        ('a: "b', "f:1:4: the quote that opens here is never closed"),
        ("a:\n\t- b", "f:2:1: a tab where YAML wants spaces; indent with spaces"),
        ("a: b\n\tc: d", "f:2:1: a tab where YAML wants spaces"),
        ("a: b: c", "f:1:5: a colon that fits no key here"),
        ("a:\n  b: 1\n c: 2", "f:3:2: this line does not fit the lines above it"),
        ("- a\nb: c", "f:2:1: this line does not fit the list above it"),
        ("a: - b", "f:1:4: a list may not begin with - in the middle of a line"),
        ("a: @b", "f:1:4: a value cannot begin with @; put it in quotes"),
        ('a: "\\q"', "an unknown escape after \\"),
        ("a: ]", "f:1:4: a value was expected here"),
        ("a: \x07", "f:1:4: a control character that YAML does not allow"),
        ("a: b\0", "a control character that YAML does not allow"),
        ("a: \ud800", "characters that are no Unicode"),
        ("a: b\n...\nc: d", "f:3:1: text after the end of the document"),
        ("[" * 30_000, f"nested more than {MAX_DEPTH} deep"),
        ("- " * 30_000, f"nested more than {MAX_DEPTH} deep"),
        ("{a: " * 30_000, f"nested more than {MAX_DEPTH} deep"),
        ("[" * 1_100 + "]" * 1_100, f"f:1:41: nested more than {MAX_DEPTH} deep"),
        ("{b: " * 41, f"nested more than {MAX_DEPTH} deep"),
        ("x" * 1_025 + ": 1", "f:1:1: a name of 1025 characters, at most 1024 are read"),
        ("{a: 1, " + "x" * 5_000 + ": 1}", "f:1:8: a name of 5000 characters"),
        ('- {"' + "x" * 5_000 + '": 1}', "f:1:4: a name of 500"),
        ("? " + "x" * 5_000 + "\n: 1", "f:1:3: a name of 5000 characters"),
        ("a: {b: 1\nc: 2", "f:1:4: the mapping that opens here is not closed; expected , or }"),
        ("a: [b, c}", "f:1:4: the list that opens here is not closed; expected , or ]"),
        ("a: |\n  [[ '\nb: [", "f:3:4: the list that opens here is not closed"),
        ("a: it's [\nb: [", "f:2:4: the list that opens here is not closed"),
        ("a: b\nfoo\nc: d", "a key without a colon"),
        ("a" * (1 << 20) + "a", "the text has 1048577 characters"),
        ("[" + "a," * 250_000 + "]", "more than 200000 values"),
    ],
)
def test_what_is_refused(text: str, fault: str) -> None:
    (found,) = faults_of(text)
    assert fault in found


@pytest.mark.parametrize("name", ["x\\n y", "x" * 5000, "\\x07", "\\u2028"])
def test_messages_stay_on_one_line_of_bearable_length(name: str) -> None:
    for text in (f'{{"{name}": 1, "{name}": 2}}', f'nodes: {{"{name}": 1}}', f'agent: "{name}"'):
        with pytest.raises(LayoutError) as raised:
            read_layout(text, "f")
        for fault in raised.value.faults:
            assert str(fault).isprintable() and len(str(fault)) < 500


def test_an_alias_bomb_stays_small() -> None:
    lines = ["a0: &a0 [x, x]"] + [f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]" for i in range(1, 30)]
    assert len(faults_of("\n".join(lines))) == 30 + 58


@pytest.mark.parametrize(
    "text", ["a: [b, c", "a: 'b", "a: b: c", "a: @b", "- a\nb: c", "[" * 2_000, "a: - b"]
)
def test_no_word_of_the_parser_is_used(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only where the parser stopped counts: its words are those of another project."""
    (due,) = faults_of(text)

    def stranger(*_: object, **__: object) -> Iterator[object]:
        try:
            yield from parse(text, Loader=yaml.SafeLoader)
        except yaml.MarkedYAMLError as error:
            error.problem = error.context = "blah"
            raise

    parse = yaml.parse
    monkeypatch.setattr(yaml, "parse", stranger)
    (found,) = faults_of(text)
    assert found == due and "blah" not in found


def test_a_stop_without_any_place_is_told_neutrally(monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: object, **__: object) -> Iterator[object]:
        raise yaml.YAMLError("exceeded its limit of 7")

    monkeypatch.setattr(yaml, "parse", stop)
    (found,) = faults_of("a: b")
    assert found.startswith("f:1:1: no YAML here")


def test_the_slow_parser_says_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = [
        "a: [b, c",
        "a: 'b",
        "a: b: c",
        "a: @b",
        "a:\n\t- b",
        "a: 1\na: 2",
        "a: {b: c",
        "a: \x07",
        "[" * 1_100 + "]" * 1_100,
        "{a: 1, " + "x" * 5_000 + ": 1}",
        "x" * 5_000 + ": 1",
    ]
    fast = [faults_of(text) for text in texts]
    monkeypatch.delattr(yaml, "CSafeLoader")
    slow = [faults_of(text) for text in texts]
    assert fast == slow
    report = (LAYOUTS / "report.yaml").read_text(encoding="utf-8")
    assert read_layout(report, "f").name == "report"


def test_a_value_from_the_command_line_has_the_place_of_its_option() -> None:
    where = Where("--goal")
    document = compose("paid: t1", "--goal", where)
    assert isinstance(document.root, Mapping)
    assert document.root.entries[0][1].where is where
    assert document.excerpt(where) == "paid: t1"


def test_values_of_json_become_nodes() -> None:
    where = Where("line", 3, 1)
    value = {"a": [1, 2.5, True, None, "x"], "b": {}}
    assert plain(node_from_value(value, where)) == {"a": ["1", "2.5", "true", "null", "x"], "b": {}}
    deep: object = []
    for _ in range(MAX_DEPTH + 2):
        deep = [deep]
    with pytest.raises(LayoutError, match="nested more than"):
        node_from_value(deep, where)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-99, 99) | st.text("abcé :#-\"'\\/\t\n", max_size=6),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text("ab: ", max_size=3), inner, max_size=4)
    ),
    max_leaves=12,
)


@settings(max_examples=150, deadline=None)
@given(JSON, st.sampled_from([None, 2]))
def test_json_is_read_as_yaml(value: object, indent: int | None) -> None:
    document = compose(json.dumps(value, indent=indent, ensure_ascii=False), "f")
    where = Where("f")
    assert plain(document.root) == plain(node_from_value(value, where))
    assert document.faults == ()


@settings(max_examples=150, deadline=None)
@given(JSON)
def test_what_pyyaml_writes_is_read(value: object) -> None:
    text = yaml.safe_dump({"k": value}, allow_unicode=True)
    document = compose(text.replace("&id001 ", "").replace("*id001", "[]"), "f")
    assert isinstance(document, Document)
    assert all("duplicate" not in str(fault) for fault in document.faults)


# -- nothing but LayoutError ----------------------------------------------------------------

LAYOUT = (LAYOUTS / "report.yaml").read_text(encoding="utf-8")
LUNCH = (LAYOUTS / "scenarios" / "lunch.yaml").read_text(encoding="utf-8")
BISTRO = read_layout((LAYOUTS / "bistro.yaml").read_text(encoding="utf-8"), "bistro.yaml")
PIECES = st.sampled_from(
    [
        *(
            "[",
            "]",
            "{",
            "}",
            ":",
            ",",
            "- ",
            "\n",
            "  ",
            "\t",
            "#",
            "'",
            '"',
            "&a ",
            "*a",
            "!x ",
            "|\n",
        ),
        *(
            "? ",
            "~",
            "null",
            ".inf",
            "-1",
            "1e9",
            "n5",
            "table1",
            "c1",
            "agent",
            "é",
            "\0",
            "\u2028",
        ),
        *(
            "a: b\n",
            "[]",
            "{}",
            "---\n",
            "...\n",
            "<<: ",
            "\ufeff",
            "\r",
            "no",
            "0x1F",
            "12:30",
            "99",
        ),
    ]
)
EDITS = st.lists(
    st.tuples(st.floats(0, 1, exclude_max=True), st.integers(0, 12), PIECES | st.text(max_size=3)),
    min_size=1,
    max_size=6,
)


def mutated(text: str, edits: list[tuple[float, int, str]]) -> str:
    """The text with pieces of it replaced."""
    for share, length, piece in edits:
        at = int(share * len(text))
        text = text[:at] + piece + text[at + length :]
    return text


def outcome(read: Callable[[], T]) -> T | tuple[Fault, ...]:
    """What was read, or the faults; any other exception is a defect and comes through."""
    try:
        return read()
    except LayoutError as error:
        return error.faults


def check_faults(faults: tuple[Fault, ...]) -> None:
    """Every fault has a place in the file and says what is wrong on one line."""
    assert faults
    for fault in faults[:200]:
        assert fault.message and "\n" not in str(fault)
        assert fault.where is not None


@settings(max_examples=250, deadline=None)
@given(EDITS)
def test_a_mutated_layout_is_read_or_refused(edits: list[tuple[float, int, str]]) -> None:
    found = outcome(lambda: read_layout(mutated(LAYOUT, edits), "f"))
    if isinstance(found, tuple):
        check_faults(found)
    else:
        check_sound(found)


def check_sound(layout: Layout) -> None:
    """Every name of a layout that was read refers to something."""
    nodes = {node.name for node in layout.nodes}
    places = [layout.entrance, layout.agent, *(node for _, node in layout.waiters)]
    places += [node for table in layout.tables for node in table.nodes]
    places += [node for edge in layout.edges for node in edge]
    places += [node for _, _, node in layout.timetable]
    assert nodes.issuperset(places)
    assert len({layout.agent, *(node for _, node in layout.waiters)}) == len(layout.waiters) + 1
    assert all(0 <= table.chairs <= table.capacity for table in layout.tables)
    layout_warnings(layout)


@settings(max_examples=250, deadline=None)
@given(EDITS)
def test_a_mutated_scenario_is_read_or_refused(edits: list[tuple[float, int, str]]) -> None:
    text = mutated(LUNCH, edits)
    found = outcome(lambda: pose_problem(BISTRO, read_scenario(text, "f", BISTRO)))
    if isinstance(found, tuple):
        check_faults(found)
    else:
        assert found.layout is BISTRO


@settings(max_examples=150, deadline=None)
@given(st.lists(PIECES | st.text(max_size=4), max_size=30).map("".join))
def test_a_soup_of_tokens_is_read_or_refused(text: str) -> None:
    read: list[Callable[[], object]] = [
        lambda: read_layout(text, "f"),
        lambda: read_scenario(text, "f", BISTRO),
        lambda: problem_from_plan_document(text, "f", BISTRO),
        lambda: pose_problem(BISTRO, None, enter=[text], bills=[text], goals=[text]),
    ]
    for found in map(outcome, read):
        if isinstance(found, tuple):
            check_faults(found)
