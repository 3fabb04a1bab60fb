"""Edits of a layout's text: what they are about changes, and nothing else of the text."""

from __future__ import annotations

import json
import random
import re

import pytest
import yaml

from tests.support.paths import ROOT
from tests.support.sampling import mostly_slow
from waiter_cli.editing.edits import edited_text
from waiter_cli.editing.sketch import sketch
from waiter_cli.editing.spans import pieces_of
from waiter_cli.editing.splices import applied, new_item, without_item
from waiter_cli.errors import InputError
from waiter_cli.files.layout_reader import read_layout

SHIPPED = sorted((ROOT / "layouts").glob("*.yaml"))
STYLES = ("as it is", "crlf", "json", "block", "letters")


def in_style(text: str, style: str) -> str:
    if style == "crlf":
        return text.replace("\n", "\r\n")
    if style == "json":
        return json.dumps(yaml.safe_load(text))
    if style == "block":
        return yaml.safe_dump(yaml.safe_load(text), default_flow_style=False, sort_keys=False)
    if style == "letters":  # places count characters, not bytes
        return "# Café 🍽 „Zur Linde“\n" + re.sub(r"(?m)^(\s+\w+: .*)$", r"\1  # ✓ 椅子", text)
    return text


GIVEN = [(path, style) for path in SHIPPED for style in STYLES]
SOME = [given for k, given in enumerate(GIVEN) if given[0].stem == "report" or k % 7 == 0]
"""Every style, and every layout in some style."""


@pytest.fixture(
    params=mostly_slow(GIVEN, *SOME), ids=[f"{path.stem}-{style}" for path, style in GIVEN]
)
def text(request: pytest.FixtureRequest) -> str:
    path, style = request.param
    return in_style(path.read_text(encoding="utf-8"), style)


def do(text: str, **edit: object) -> str:
    return edited_text(text, [edit])[0]


def changed_parts(before: str, after: str) -> tuple[str, str]:
    """What is between the longest beginning and the longest end that both have."""
    start = next((i for i, (a, b) in enumerate(zip(before, after)) if a != b), None)
    if start is None:
        start = min(len(before), len(after))
    tail = 0
    while tail < min(len(before), len(after)) - start and before[-1 - tail] == after[-1 - tail]:
        tail += 1
    return before[start : len(before) - tail], after[start : len(after) - tail]


def test_a_table_that_moves_changes_one_number(text: str) -> None:
    layout = read_layout(text, "x")
    for table in layout.tables:
        assert table.at is not None
        if "at" not in yaml.safe_load(text)["tables"][table.name]:
            continue
        new = do(text, do="move", what=[f"table {table.name}"], by=[0.35, 0])
        gone, come = changed_parts(text, new)
        assert re.fullmatch(r"[-\d.]*", gone) and re.fullmatch(r"[-\d.]+", come)
        at = read_layout(new, "x").table(table.name).at
        assert at == (pytest.approx(table.at[0] + 0.35), table.at[1])


def test_a_name_comes_back(text: str) -> None:
    for what in [
        name for name in sketch(text).start if name.split()[0] in ("node", "table", "waiter")
    ]:
        kind, old = what.split()
        new = do(text, do="rename", what=what, name="elsewhere")
        assert not re.search(rf"\b{old}\b", re.sub(r"#.*", "", new))
        read_layout(new, "x")
        assert do(new, do="rename", what=f"{kind} elsewhere", name=old) == text


def test_what_is_added_can_be_deleted_again(text: str) -> None:
    layout = read_layout(text, "x")
    node = layout.nodes[-1].name
    new, added = edited_text(text, [{"do": "add_node", "at": [1.5, 2], "joined": node}])
    assert read_layout(new, "x").node(added.removeprefix("node ")).at == (1.5, 2)
    assert do(new, do="delete", what=[added]) == text
    new, added = edited_text(text, [{"do": "add_table", "at": [1.5, 2]}])
    assert read_layout(new, "x").table(added.removeprefix("table ")).at == (1.5, 2)
    assert do(new, do="delete", what=[added]) == text
    new, added = edited_text(text, [{"do": "add_wall", "from": [0, 0], "to": [1, 0.25]}])
    assert read_layout(new, "x").walls[-1] == ((0, 0), (1, 0.25))
    if layout.walls:
        assert do(new, do="delete", what=[added]) == text


def comments(text: str) -> list[str]:
    return re.findall(r"#.*", text)


def test_any_edits_leave_a_layout_and_its_comments(text: str) -> None:
    """Random edits of every kind; none of them may spoil the text."""
    chance = random.Random(7)
    for _ in range(30):
        drawn, before = sketch(text), text
        edit = _some_edit(drawn, chance)
        try:
            text, _ = edited_text(text, [edit])
        except InputError:
            assert edit["do"] not in ("move", "rename", "turn"), edit
            continue
        read_layout(text, "x")
        if edit["do"] != "delete":
            assert comments(text) == comments(before), edit
        else:
            assert set(comments(text)) <= set(comments(before)), edit
        assert text.count("\r\n") in (0, text.count("\n")), edit


def _some_edit(drawn: object, chance: random.Random) -> dict[str, object]:
    names = list(drawn.start)  # type: ignore[attr-defined]
    nodes = list(drawn.nodes)  # type: ignore[attr-defined]
    what, node = chance.choice(names), chance.choice(nodes)
    movable = [name for name in names if name.split()[0] in ("node", "table", "wall")]
    tables = [name for name in names if name.startswith("table")]
    waiters = [name for name in names if name.startswith("waiter")] or ["waiter nobody"]
    at = [round(chance.uniform(-5, 5), 2), round(chance.uniform(-5, 5), 2)]
    edits: list[dict[str, object]] = [
        {
            "do": "move",
            "what": [chance.choice(movable)],
            "by": at,
            "drawn": dict.fromkeys(tables, at),
        },
        {"do": "delete", "what": [what]} if len(nodes) > 3 else {"do": "add_node", "at": at},
        {"do": "add_node", "at": at, "joined": node},
        {"do": "add_path", "ends": [node, chance.choice(nodes)]},
        {"do": "add_table", "at": at, "capacity": chance.randint(1, 8)},
        {"do": "add_wall", "from": at, "to": [at[0] + 1, at[1]]},
        {"do": "add_bar", "from": at, "to": [at[0] + 1, at[1] + 0.6]},
        {"do": "add_waiter", "node": node},
        {"do": "rename", "what": f"node {node}", "name": f"x{chance.randint(1, 10**6)}"},
        {"do": "turn", "what": chance.choice(tables)} if tables else {"do": "add_table", "at": at},
        {
            "do": "set",
            "what": chance.choice(tables or ["table none"]),
            "key": "capacity",
            "value": 3,
        },
        {
            "do": "set",
            "what": chance.choice(tables or ["table none"]),
            "key": "size",
            "value": [1, 2],
        },
        {
            "do": "timetable",
            "what": chance.choice(waiters),
            "step": chance.randint(1, 9),
            "node": None,
        },
    ]
    return chance.choice(edits)


def test_a_deleted_node_is_named_nowhere(text: str) -> None:
    for node in [node.name for node in read_layout(text, "x").nodes]:
        new = do(text, do="delete", what=[f"node {node}"])
        assert not re.search(rf"\b{node}\b", re.sub(r"#.*", "", new))
        read_layout(new, "x")


def test_an_empty_floor_becomes_a_restaurant() -> None:
    text = "name: new\n\nnodes: {}\n\nedges: []\n\ntables: {}\n"
    for k in range(3):
        joined = f"n{k}" if k else None
        text, _ = edited_text(text, [{"do": "add_node", "at": [k, 0], "joined": joined}])
    text, added = edited_text(text, [{"do": "add_table", "at": [2, 1.2], "capacity": 4}])
    layout = read_layout(text, "x")
    assert (layout.entrance, layout.agent, added) == ("n1", "n1", "table table1")
    assert layout.edges == (("n1", "n2"), ("n2", "n3")) and layout.tables[0].nodes == ("n3",)


def test_no_text_at_all_becomes_one() -> None:
    text, _ = edited_text("", [{"do": "add_node", "at": [0, 0]}])
    assert yaml.safe_load(text)["nodes"] == {"n1": [0, 0]}


def test_a_path_leads_one_way_and_back() -> None:
    text = "edges:\n  - [a, b]  # stairs\nnodes: {a: [0, 0], b: [1, 0]}\n"
    new = do(text, do="one_way", what="path a b", **{"from": "b"})
    assert new == text.replace("[a, b]", "{from: b, to: a}")
    assert do(new, do="one_way", what="path b a", **{"from": None}) == text.replace(
        "[a, b]", "[b, a]"
    )


def test_a_timetable_grows_and_goes() -> None:
    text = "nodes: {a: [0, 0], b: [1, 0]}\nwaiters: {w: a}\n"
    new = do(text, do="timetable", what="waiter w", step=3, node="b")
    assert yaml.safe_load(new)["timetable"] == {"w": {3: "b"}}
    more = do(new, do="timetable", what="waiter w", step=5, node="a")
    assert yaml.safe_load(more)["timetable"] == {"w": {3: "b", 5: "a"}}
    assert do(more, do="timetable", what="waiter w", step=5, node=None) == new
    assert do(new, do="timetable", what="waiter w", step=3, node=None) == text


@pytest.mark.parametrize(
    ("text", "after"),
    [
        ("edges: []", "edges: [[a, b]]"),
        ("edges: [ ]  # none", "edges: [[a, b] ]  # none"),
        ("edges:  # none", "edges: [[a, b]]  # none"),
        ("edges: ~", "edges: [[a, b]]"),
        ("edges: [[c, d]]", "edges: [[c, d], [a, b]]"),
        ("edges: [\n  [c, d],  # one\n]", "edges: [\n  [c, d],\n  [a, b],  # one\n]"),
        ("edges:\n- [c, d]  # one\n# end", "edges:\n- [c, d]  # one\n- [a, b]\n# end"),
        ("edges:\n  - - c\n    - d\n", "edges:\n  - - c\n    - d\n  - [a, b]\n"),
    ],
)
def test_one_more_in_any_list(text: str, after: str) -> None:
    root = pieces_of(text)
    assert root is not None
    assert applied(text, [new_item(text, root["edges"], ["a", "b"], root.key("edges"))]) == after


@pytest.mark.parametrize(
    ("text", "index", "after"),
    [
        ("e: [a, b, c]", 0, "e: [b, c]"),
        ("e: [a, b, c]", 2, "e: [a, b]"),
        ("e: [a,]", 0, "e: []"),
        ("e: [\n  a,\n  b, # two\n]", 0, "e: [\n  b, # two\n]"),
        ("e:\n  - a # one\n  - b # two\n", 0, "e:\n  - b # two\n"),
        ("e:\n  - a\n  - b", 1, "e:\n  - a"),
        ("e:\n- - 1\n  - 2\n- b\n", 0, "e:\n- b\n"),
        ("e:\n  - a\nf: 1\n", 0, "e: []\nf: 1\n"),
    ],
)
def test_one_less_in_any_list(text: str, index: int, after: str) -> None:
    root = pieces_of(text)
    assert root is not None
    assert applied(text, [without_item(text, root["e"], index, root.key("e"))]) == after


@pytest.mark.parametrize(
    "edit",
    [
        {"do": "explode"},
        {"do": "move", "what": ["table nowhere"], "by": [1, 0]},
        {"do": "move", "what": ["robot agent"], "by": [1, 0]},
        {"do": "move", "what": ["node n1"], "by": ["a", 0]},
        {"do": "move", "what": ["node n1"], "by": [float("inf"), 0]},
        {"do": "move"},
        {"do": "rename", "what": "node n1", "name": "n2"},
        {"do": "rename", "what": "node n1", "name": "a: b"},
        {"do": "rename", "what": "wall 1", "name": "b"},
        {"do": "add_path", "ends": ["n1", "n2"]},
        {"do": "add_waiter", "node": "n7"},
        {"do": "delete", "what": ["robot agent"]},
        {"do": "rename", "what": "robot agent", "name": "r1"},
        {"do": "add_robot", "node": "n7"},
        {"do": "add_robot", "node": "n1"},
        {"do": "add_robot", "node": "n99"},
        {"do": "add_robot", "node": "n2", "name": "table1"},
        {"do": "set", "what": "table table1", "key": "owner", "value": 1},
        {"do": "add_node", "at": [0, 0], "name": "a, b"},
        {"do": "add_table", "at": [0, 0], "nodes": ["n1]"]},
        {"do": "set", "what": "table table1", "key": "nodes", "value": ["n99"]},
        {"do": "set", "what": "table table1", "key": "capacity", "value": float("inf")},
        {"do": "timetable", "what": "waiter w1", "step": 2, "node": "a: {b"},
        {"do": "move", "what": ["bar"], "by": [1, 0], "drawn": [1]},
        "no edit",
    ],
)
def test_what_cannot_be_is_refused(edit: object) -> None:
    text = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    with pytest.raises(InputError):
        edited_text(text, [edit])  # type: ignore[list-item]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("agent: n1   # the first\n", "agents: {r1: n1, r2: n2}   # the first\n"),
        ('"agent": "n1"\r\n', '"agents": {r1: n1, r2: n2}\r\n'),
        ("agents: {a: n1} # two\n", "agents: {a: n1, r1: n2} # two\n"),
        ("agents:\n  a: n1\n  b: n3\n", "agents:\n  a: n1\n  b: n3\n  r1: n2\n"),
        ("", "agents:\n  r1: n2\n"),
    ],
)
def test_one_robot_becomes_several_and_nothing_else_changes(before: str, after: str) -> None:
    head = "# floor\nnodes: {n1: [0, 0], n2: [1,  0], n3: [2, 0]}\nedges: []\ntables: {}\n"
    text, added = edited_text(head + before, [{"do": "add_robot", "node": "n2"}])
    assert text == head + after
    assert added in ("robot r1", "robot r2") and added in sketch(text).start


def test_robots_are_added_renamed_moved_and_deleted(text: str) -> None:
    """In every style the text stays one that is read, and only its robots change."""
    drawn = sketch(text)
    taken = {*drawn.staff.values(), *drawn.robots.values()}
    first, second, third = [node for node in drawn.nodes if node not in taken][:3]
    several, added = edited_text(text, [{"do": "add_robot", "node": first}])
    assert added in sketch(several).start
    old, young = sketch(several).robots
    assert sketch(several).robots == {old: drawn.robots["agent"], young: first}
    edits = [
        {"do": "add_robot", "node": second, "name": "carla"},
        {"do": "rename", "what": f"robot {young}", "name": "bert"},
        {"do": "stand", "what": "robot bert", "node": third},
        {"do": "delete", "what": [f"robot {old}"]},
    ]
    after, _ = edited_text(several, edits)
    assert sketch(after).robots == {"bert": third, "carla": second}
    assert dict(read_layout(after, "layout.yaml").agents) == {"bert": third, "carla": second}
    with pytest.raises(InputError):
        edited_text(after, [{"do": "delete", "what": ["robot bert", "robot carla"]}])
    given, told = yaml.safe_load(text), yaml.safe_load(after)
    assert told.pop("agents") and given.pop("agent") and told == given
