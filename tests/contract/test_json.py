"""``--json``: one document and nothing else on stdout, of exactly the shape that was promised.

Every command that takes ``--json`` is in `CASES`, with each outcome it can have; the faults, which
all commands share, are in `test_contract_exits`.
"""

from __future__ import annotations

import json
from pathlib import Path
from shutil import copyfile
from typing import Any

import pytest

from tests.support import documents as shape
from tests.support import tool_documents as tools
from tests.support.cli import waiter
from tests.support.helps import command_tree
from tests.support.shapes import differences
from tests.support.studies import QUICK
from waiter_cli.encoding.domains import find_domain

FILES = {
    "two.sparc": "sorts\n#s = {a, b}.\npredicates\np(#s).\nrules\np(a) | p(b).\n",
    "none.sparc": "sorts\n#s = {a}.\npredicates\np(#s).\nrules\np(a).\n-p(X) :- p(X).\n",
    "quick.yaml": QUICK,
    "study.yaml": "name: quick\nlayouts: [report]\nevenings: {scenario: quick.yaml, seeds: 1..2}\n",
    "guests.yaml": "layout: report\nguests: {arrivals: {at: [[0, 1], [1, 4]]}, eat: 1, patience: 2}\n",
    "entered.yaml": "layout: report\nstate: {waiting: [[c1]]}\nobserve: [{enter: [c1]}]\n",
    "surprise.yaml": "layout: report\nobserve: [{at: {w1: n4}}]\ngoals: [{at: n3}]\n",
    "evening.yaml": (
        "layout: bistro\nstate: {seated: {table1: [a], table2: [b, c]}, ready_to_order: [table1]}\n"
        "observe: [{enter: [d, e]}, {bill: table2}]\n"
        "before: [[{paid: table2}, {seated: d}]]\ninstant_kitchen: true\n"
    ),
    "wrong.json": json.dumps(
        {
            "layout": "report",
            "initial_state": {"agent": "n1"},
            "goals": [{"at": "n3"}],
            "actions": [{"step": 0, "text": "go_to(agent,n3)"}],
        }
    ),
    "round.yaml": (
        "name: round\nnodes: {a: [0, 0], b: [2, 0], c: [2, 2], d: [0, 2]}\nentrance: a\nagent: a\n"
        "edges: [[a, b], [b, c], [c, d], [d, a]]\n"
        "tables: {t: {capacity: 2, nodes: [c], at: [3.5, 2]}}\n"
    ),
    "small/domain.sparc": find_domain("restaurant").template.text,
    "small/cases/one.yaml": (
        "layout: {nodes: [n1, n2], edges: [[n1, n2]], entrance: n1, agent: n1, customers: 1, "
        "tables: {table1: {capacity: 2, nodes: [n2]}}}\n"
        "cases:\n  - name: a step leads nowhere\n    given: {state: {agent: n1}}\n"
        "    when: [go_to(agent, n2)]\n    then: ['holds(currentlocation(agent, n1), 1)']\n"
    ),
}

B1 = ("--scenario", "b1")
B1_FOIL = ("explain", *B1, "--why-not")
MADE = {"plan.json": ("plan", *B1, "--json"), "room.sparc": ("plan", *B1, "--show", "sparc")}
"""What is read by a case, and the command that writes it."""

# What is run, its exit code, and the shape of what it prints.
CASES: list[tuple[str, int, Any]] = [
    ("plan --scenario b1", 0, shape.PLAN),
    ("plan --scenario lunch", 0, shape.PLAN),
    ("plan --scenario evening.yaml", 0, shape.PLAN),
    ("plan --scenario surprise.yaml", 0, {**shape.PLAN, "diagnosis": shape.DIAGNOSIS}),
    ("plan --scenario b1 --search linear -v", 0, shape.PLAN),
    ("plan --layout report --goal at:n1", 0, {**shape.PLAN, "horizon": 0}),
    ("plan --scenario blocked_aisle", 3, shape.NO_PLAN),
    ("plan --scenario entered.yaml", 3, shape.CONTRADICTION),
    ("plan --scenario b1 --max-steps 3", 4, shape.UNDECIDED),
    ("answersets two.sparc", 0, shape.ANSWER_SETS),
    ("answersets none.sparc", 3, shape.ANSWER_SETS),
    ("answersets two.sparc --count", 0, shape.COUNTED),
    ("answersets two.sparc --diff", 0, shape.DIFFERENCES),
    ("answersets --scenario b1", 0, shape.ANSWER_SETS),
    ("answersets --scenario too_big", 3, {**shape.ANSWER_SETS, "reasons": [shape.REASON]}),
    ("answersets --scenario entered.yaml", 3, {**shape.ANSWER_SETS, "reasons": [shape.REASON]}),
    ("answersets --scenario b1 --max-steps 3", 4, {**shape.ANSWER_SETS, "limit": "max_steps"}),
    ("explain --scenario b1", 0, shape.EXPLANATION),
    ("explain --scenario surprise.yaml", 0, shape.EXPLANATION),
    ("explain --scenario blocked_aisle", 0, shape.EXPLANATION),
    ("explain --scenario entered.yaml", 0, shape.EXPLANATION),
    ("explain --scenario b1 --max-steps 3", 4, {**shape.EXPLANATION, "limit": "max_steps"}),
    ("explain --scenario b1 --why-not go_to(n0)", 0, shape.FOIL),
    ("explain --scenario b1 --why-not go_to(n7)", 0, {**shape.FOIL, "conflict": str}),
    ("explain --scenario b1 --why-not go_to(n0) --max-steps 8", 4, {**shape.FOIL, "limit": str}),
    ("validate plan.json", 0, shape.VALIDATED),
    ("validate wrong.json", 3, shape.VALIDATED),
    ("validate plan.json --scenario entered.yaml", 3, shape.VALIDATED),
    ("simulate --scenario b1 --headless", 0, shape.SIMULATED),
    ("simulate --plan plan.json -v", 0, shape.SIMULATED),
    ("simulate --scenario guests.yaml --backend geometric", 0, shape.SIMULATED),
    ("simulate --scenario b1 --inject slip:1 --on-failure stop", 3, shape.SIMULATED),
    ("simulate --scenario entered.yaml", 3, shape.SIMULATED),
    ("simulate --scenario blocked_aisle", 4, shape.SIMULATED),
    ("simulate --scenario b1 --max-steps 3", 4, shape.SIMULATED),
    ("serve --scenario entered.yaml", 3, shape.REFUSED),
    ("domain test -k seat", 0, tools.TESTED),
    ("domain test -k seat --coverage", 0, tools.TESTED),
    ("domain test --domain small", 3, tools.TESTED),
    ("domain new mine", 0, tools.BEGUN),
    ("domain show", 0, tools.SHOWN),
    ("domain show --grep xyzzy", 0, {**tools.SHOWN, "blocks": []}),
    ("layout check report", 0, {**tools.CHECKED, "status": "advice"}),
    ("layout check round.yaml", 0, {**tools.CHECKED, "status": "ok", "advice": []}),
    ("layout draw report", 0, {**tools.DRAWN, "text": str}),
    ("layout draw --plan plan.json -o walk.svg --svg two.svg", 0, {**tools.DRAWN, "text": None}),
    ("layout new --seed 1", 0, {**tools.MADE, "file": None}),
    ("layout new --seed 1 -o new.yaml", 0, {**tools.MADE, "file": "new.yaml"}),
    ("layout new --scenario --layout bistro", 0, tools.MADE),
    ("layout convert room.sparc", 0, tools.CONVERTED),
    ("layout convert room.sparc -o room.yaml", 0, {**tools.CONVERTED, "file": "room.yaml"}),
    ("layout schema", 0, tools.SCHEMA),
    ("layout schema --scenario -o s.json", 0, tools.SCHEMA),
    ("layout improve report --scenario b1 --tries 2", 0, tools.IMPROVED),
    ("layout improve report --scenario b4 --scenario lunch --tries 1", 0, tools.IMPROVED),
    (
        "layout improve report --study quick.yaml --tries 1 --workers 1 --time-limit 0.3",
        0,
        tools.IMPROVED_BY_EVENINGS,
    ),
    ("compare report bistro --scenario b1 --scenario blocked_aisle", 0, tools.COMPARED),
    ("compare report --agents 1..2 --scenario b1", 0, tools.COMPARED_AGENTS),
    ("study run study.yaml -o s.db --workers 1", 0, tools.STUDIED),
    ("study show s.db", 0, tools.STUDY),
    ("study show s.db --layout-of 1", 0, tools.PLAYED),
    ("study show s.db --scenario-of 1", 0, tools.PLAYED),
    ("study report s.db", 0, {**tools.STUDY_REPORT, "report": None}),
    ("study report broken.db", 0, {**tools.STUDY_REPORT, "worst": []}),
    ("study show broken.db", 0, {**tools.STUDY, "done": 0, "limit": 2}),
    ("sparc check two.sparc --warnings", 0, tools.SPARC),
    ("sparc translate two.sparc", 0, {**tools.TRANSLATED, "file": None}),
    ("sparc translate two.sparc -o two.lp", 0, {**tools.TRANSLATED, "file": "two.lp"}),
    ("sparc query two.sparc -q p(X)", 0, tools.QUERY),
    ("sparc query two.sparc -q p(a) -q p(X)", 0, tools.QUERIES),
    ("sparc query none.sparc -q p(a)", 3, tools.QUERY),
    ("sparc explain none.sparc", 0, tools.INCONSISTENT),
    ("sparc explain none.sparc --all", 0, tools.INCONSISTENT),
    ("sparc explain two.sparc", 0, tools.CONSISTENT),
    ("sparc why two.sparc p(b)", 0, {**tools.HOLDS, "set": 1}),
    ("sparc why two.sparc p(a)", 0, {**tools.HOLDS_NOT, "set": 1}),
    ("sparc why two.sparc p(a) --set 2", 0, {**tools.HOLDS, "set": 2}),
    ("sparc why two.sparc -p(b)", 0, {**tools.HOLDS_NOT, "because_not": []}),
    ("sparc why two.sparc q(c)", 0, {**tools.HOLDS_NOT, "because_not": []}),
    ("sparc why two.sparc p(X)", 0, {**tools.HOLDS, "set": 1}),
    ("sparc why two.sparc p(X),p(Y)", 0, tools.SEVERAL_HOLD),
    ("sparc why two.sparc -p(X),p(X)", 0, {**tools.HOLDS_NOT, "because_not": []}),
    ("sparc why none.sparc p(a)", 3, tools.NO_SET),
    ("answersets two.sparc --why p(b)", 0, tools.HOLDS),
    ("answersets two.sparc --why p(X),p(Y)", 0, tools.SEVERAL_HOLD),
    ("answersets --scenario b1 --why occurs(go_to(agent,n2),0)", 0, tools.HOLDS),
    ("sparc format two.sparc", 0, tools.FORMATTED),
    ("sparc fetch-jar", 0, tools.INSTALLED),
    ("list", 0, tools.LISTED),
    ("doctor", 0, tools.DOCTOR),
]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what our own commands make for the cases, each made once."""
    folder = tmp_path_factory.mktemp("made")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for name in ("quick.yaml", "study.yaml"):
            Path(name).write_text(FILES[name])
        for name, arguments in MADE.items():
            Path(name).write_text(waiter(*arguments).out)
        for name, limit in {"s.db": "300", "broken.db": "0"}.items():
            study = ("study", "run", "study.yaml", "-o", name, "--workers", "1")
            assert waiter(*study, "--time-limit", limit).code == 0
    return folder


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files of the cases; what would be downloaded is there already."""
    from waiter_cli.translators import jar_store

    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setattr(jar_store, "fetch", lambda *_, **__: None)
    return tmp_path


def one_document(out: str) -> Any:
    """The document that is all of ``out``, a line end apart."""
    document, end = json.JSONDecoder(object_pairs_hook=_no_key_twice).raw_decode(out)
    assert out[end:] == "\n", out[end : end + 80]
    return document


def _no_key_twice(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    assert len(dict(pairs)) == len(pairs), pairs
    return dict(pairs)


@pytest.mark.parametrize(("line", "code", "expected"), CASES, ids=[line for line, _, _ in CASES])
def test_the_document(line: str, code: int, expected: Any, folder: Path, made: Path) -> None:
    for name in (*MADE, "s.db", "broken.db"):
        if name in line and f"-o {name}" not in line:
            copyfile(made / name, name)
    words = line.replace("at:n1", "at:_n1").split()
    arguments = [word.replace("at:_n1", "at: n1") for word in words]
    if arguments[:2] == ["sparc", "fetch-jar"]:
        arguments.append("--yes")
    ran = waiter(*arguments, "--json")
    assert ran.code == code, ran.err
    assert differences(one_document(ran.out), expected) == []
    assert "Traceback" not in ran.err


def test_every_command_is_among_the_cases() -> None:
    with_json = {
        words
        for words, command in command_tree().items()
        if any("--json" in parameter.opts for parameter in command.params)
    }
    with_json.discard("studio")  # its one line is read by its own tests; it runs until it is ended
    assert with_json == {
        name
        for name in command_tree()
        if name and any(f"{c[0]} ".startswith(f"{name} ") for c in CASES)
    } - {"domain", "layout", "sparc", "study"}
    leaves = {name for name, command in command_tree().items() if not hasattr(command, "commands")}
    assert leaves - with_json == {"studio", "tour", "sparc lsp"}, (
        "they speak to people, and to editors"
    )


def test_lines_are_documents_each(folder: Path) -> None:
    lines = waiter("answersets", "two.sparc", "-n", "0", "--jsonl").out.splitlines()
    *sets, summary = map(json.loads, lines)
    assert all(differences(one, shape.ANSWER_SET) == [] for one in sets) and len(sets) == 2
    assert summary == {"satisfiable": True, "complete": True}


LOOP: list[tuple[dict[str, Any], str]] = [
    ({"observe": {"enter": ["c1"]}}, "decision"),
    ({"done": 0}, "decision"),
    ({"failed": 1, "reason": "door shut"}, "decision"),
    ({"started": 2}, "decision"),
    ({"observe": [{"at": {"w1": "n4"}}, {"bill": "table1"}], "id": "x"}, "decision"),
    ({"goal": {"at": "n0"}}, "decision"),
    ({"drop": {"at": "n0"}}, "decision"),
    ({"observe": {"enter": ["a", "b", "c", "d", "e"]}}, "decision"),
    ({"ask": "plan", "id": 7}, "decision"),
    ({"ask": "state"}, "state"),
    ({"ask": "why"}, "why"),
    ({"ask": "stats"}, "stats"),
    ({"observe": {"bill": "tabel1"}}, "error"),
    ({"done": 99}, "error"),
    ({"bill": "table1"}, "error"),
    ({"ask": "me", "id": 8}, "error"),
]


def test_the_loop_answers_each_line_with_one() -> None:
    """In order, with the line's number and its id."""
    lines = "".join(f"{json.dumps(line)}\n" for line, _ in LOOP)
    ran = waiter("serve", "--layout", "report", "--time-limit", "30", stdin=lines)
    hello, *answers = map(json.loads, ran.out.splitlines())
    assert (ran.code, differences(hello, shape.SERVED["hello"])) == (0, [])
    for number, ((line, kind), answer) in enumerate(zip(LOOP, answers, strict=True), 1):
        assert answer["line"] == number and answer.get("id") == line.get("id")
        assert "superseded_by" in answer or differences(answer, shape.SERVED[kind]) == [], line


@pytest.mark.parametrize(
    ("document", "expected", "said"),
    [
        ({"a": 1}, {"a": int}, []),
        ({"a": True}, {"a": int}, ["$.a is True, no int"]),
        ({"a": 1, "b": 2}, {"a": int}, ["$ has a b"]),
        ({}, {"a": int, "b?": int}, ["$ has no a"]),
        ({"a": [{"b": None}]}, {"a": [{"b": str}]}, ["$.a[0].b is None, no str"]),
        ("x", {"y", "z"}, ["$ is 'x', none of ['y', 'z']"]),
        (1.5, float, []),
        ("1.5", float, ["$ is '1.5', no float"]),
        (None, shape.optional(str), []),
    ],
)
def test_a_wrong_document_would_be_seen(document: Any, expected: Any, said: list[str]) -> None:
    assert differences(document, expected) == said
