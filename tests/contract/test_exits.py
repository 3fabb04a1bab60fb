"""Exit codes: every code of every command, in every way it can come about; and the faults behind them.

`ENDS` has a line for each way. What comes of limits (4) is in `test_contract_limits` too, signals
(130, 143) are in `test_endings` and `test_plan_command`, films without an encoder and windows
without a display (5) in `test_simulate_command`, a missing core part (5) in `test_doctor`, the
network (5) in `test_jar_store`.
"""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import Any

import pytest

from tests.support import documents as shape
from tests.support.cli import waiter
from tests.support.helps import command_tree
from tests.support.shapes import differences
from tests.support.studies import QUICK
from waiter_cli import app

LEAVES = [
    words for words, each in command_tree().items() if words and not hasattr(each, "commands")
]
JAR = "--translator jar --sparc-jar nowhere.jar"

FILES = {
    "two.sparc": "sorts\n#s = {a, b}.\npredicates\np(#s).\nrules\np(a) | p(b).\n",
    "none.sparc": "sorts\n#s = {a}.\npredicates\np(#s).\nrules\np(a).\n-p(X) :- p(X).\n",
    "bad.sparc": "sorts\n#s = {a}.\npredicates\np(#t).\nrules\nq(a).\n",
    "bad.yaml": "name: bad\nnodes: [a, b]\nedges: [[a, c]]\nentrance: d\ntables: {}\nagent: a\n",
    "evening.yaml": "layout: report\nobserve: [{enter: [c1]}, {bill: tabel1}]\ngoals: [{at: n77}]\n",
    "state.yaml": "layout: report\nstate: {agent: n7}\n",
    "entered.yaml": "layout: report\nstate: {waiting: [[c1]]}\nobserve: [{enter: [c1]}]\n",
    "quick.yaml": QUICK,
    "study.yaml": "name: quick\nlayouts: [report]\nevenings: {scenario: quick.yaml, seeds: 1..2}\n",
    "bad.json": '{"actions": [{"step": 0, "text": "fly(agent)"}], "initial_state": {}}',
    "no.json": '{"actions": ',
    "wrong.json": json.dumps(
        {
            "layout": "report",
            "initial_state": {"agent": "n1"},
            "goals": [{"at": "n3"}],
            "actions": [{"step": 0, "text": "go_to(agent,n3)"}],
        }
    ),
}  # fmt: skip

ENDS: dict[int, list[str]] = {
    0: [
        "plan --scenario b1",
        "plan --layout report --goal at:_n1",
        "answersets two.sparc",
        "answersets --scenario b1 --horizon 9 --count",
        "explain --scenario b1",
        "explain --scenario too_big",
        "explain --scenario entered.yaml",
        "explain --scenario b1 --why-not go_to(n7)",
        "serve --layout report",
        "simulate --scenario b1",
        "validate plan.json",
        "domain test -k seat",
        "domain show",
        "domain new mine",
        "layout check report",
        "layout draw report",
        "layout new",
        "layout schema",
        "layout convert room.sparc",
        "layout improve report --scenario b4 --tries 1",
        "compare report report_large --scenario b1",
        "compare report report_large --scenario blocked_aisle --scenario b4",
        "sparc check none.sparc",
        "sparc translate two.sparc",
        "sparc format two.sparc",
        "sparc query two.sparc -q p(a)",
        "sparc explain two.sparc",
        "sparc explain none.sparc --all",
        "sparc why two.sparc p(a)",
        "sparc why two.sparc -p(a)",
        "sparc why two.sparc p(X)",
        "sparc why two.sparc -p(X),p(X)",
        "answersets two.sparc --why p(b)",
        "answersets two.sparc --why p(X),p(Y)",
        "study run study.yaml -o s.db --workers 1",
        "doctor --sparc-jar nowhere.jar",
        "list",
        "tour --no-pause",
    ],
    2: [
        "plan",
        "plan --layout nowhere",
        "plan --layout bad.yaml",
        "plan --layout report --scenario nowhere",
        "plan --scenario evening.yaml",
        "plan --scenario state.yaml",
        "plan --layout report --enter many",
        "plan --layout report --bill tabel1",
        "plan --layout report --goal at:_nowhere",
        "plan --scenario b1 --domain nowhere",
        "plan --scenario b1 --domain bad.sparc",
        "plan --scenario b1 --search sideways",
        "plan --scenario b1 --max-steps -1",
        "plan --scenario b1 --translator java",
        "plan --layout - --scenario -",
        "answersets",
        "answersets two.sparc --layout report",
        "answersets bad.sparc",
        "answersets nowhere.sparc",
        "answersets two.sparc --grep (",
        "answersets two.sparc --steps 3-4",
        "answersets two.sparc --only q",
        "explain",
        "explain --scenario b1 --why-not fly(agent)",
        "serve",
        "serve --layout bad.yaml",
        "serve --layout report --journal .",
        "serve --layout report --listen 0.0.0.0:1",
        "serve --replay nowhere.journal",
        "simulate",
        "simulate --plan no.json",
        "simulate --scenario b1 --inject fly",
        "simulate --scenario b1 --record film.avi",
        "validate",
        "validate nowhere.json",
        "validate no.json",
        "validate bad.json --layout report",
        "validate wrong.json --layout bad.yaml",
        "domain test --domain nowhere",
        "domain test -k nothing_of_that_name",
        "domain show --domain nowhere",
        "domain new Mine",
        "domain new mine --from nowhere",
        "domain new mine --from report",
        "layout check bad.yaml",
        "layout check nowhere",
        "layout draw",
        "layout draw bad.yaml",
        "layout draw report -o report.doc",
        "layout draw report --highlight nobody",
        "layout new --tables 0",
        "layout new --parties 3",
        "layout new -o two.sparc",
        "layout schema -o nowhere/schema.json",
        "layout convert two.sparc",
        "layout convert nowhere.sparc",
        "layout improve report",
        "compare report",
        "compare report bistro",
        "compare report bad.yaml --scenario b1",
        "compare report bistro --scenario lunch --scenarios nowhere",
        "study run bad.yaml -o s.db",
        "study show nowhere.db",
        "study report nowhere.db",
        "studio --no-open --layout nowhere",
        "sparc check bad.sparc",
        "sparc translate bad.sparc",
        "sparc format nowhere.sparc",
        "sparc translate two.sparc -o nowhere/two.lp",
        "sparc query bad.sparc -q p(a)",
        "sparc explain bad.sparc",
        "sparc why bad.sparc p(a)",
        "sparc why two.sparc q(X)",
        "sparc why two.sparc p(X),_",
        "sparc why two.sparc p(X),p(Y) --set 3",
        "sparc why two.sparc p(",
        "sparc why two.sparc p(a) --set 3",
        "answersets two.sparc --why p(a) --count",
        "sparc query two.sparc -q q(a)",
        "sparc fetch-jar --version 1",
        "sparc fetch-jar",
        "doctor now",
        "list layouts",
        "tour now",
        "sparc lsp now",
    ],
    3: [
        "plan --scenario too_big",
        "plan --scenario entered.yaml",
        "answersets none.sparc",
        "answersets --scenario too_big",
        "answersets --scenario b1 --horizon 6",
        "answersets --scenario entered.yaml",
        "serve --scenario entered.yaml",
        "simulate --plan wrong.json --on-failure stop",
        "simulate --scenario b1 --inject slip:1 --on-failure stop",
        "simulate --scenario entered.yaml",
        "validate wrong.json",
        "validate plan.json --scenario b2",
        "validate plan.json --scenario entered.yaml",
        "sparc query none.sparc -q p(a)",
        "sparc why none.sparc p(a)",
    ],
    4: [
        "plan --scenario b1 --max-steps 3",
        "answersets --scenario b1 --max-steps 3",
        "explain --scenario b1 --max-steps 3",
        "simulate --scenario too_big",
        "simulate --scenario b1 --max-steps 3",
    ],
    5: [
        f"plan --scenario b1 {JAR}",
        f"answersets two.sparc {JAR}",
        f"explain --scenario b1 {JAR}",
        f"serve --layout report {JAR}",
        f"simulate --scenario b1 {JAR}",
        f"sparc check two.sparc {JAR}",
        f"sparc translate two.sparc {JAR}",
        f"sparc query two.sparc -q p(a) {JAR}",
    ],
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files of the lines, and no jar anywhere."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def arguments_of(line: str) -> list[str]:
    """The words of a line; the files that other commands make for it are there afterwards."""
    if "plan.json" in line:
        Path("plan.json").write_text(waiter("plan", "--scenario", "b1", "--json").out)
    if "room.sparc" in line:
        Path("room.sparc").write_text(waiter("plan", "--scenario", "b1", "--show", "sparc").out)
    return [word.replace(":_", ": ") for word in line.split()]


@pytest.mark.parametrize(
    ("line", "code"), [(line, code) for code, lines in ENDS.items() for line in lines]
)
def test_the_end(line: str, code: int, folder: Path) -> None:
    before = {path: path.read_bytes() for path in folder.iterdir()}
    arguments = arguments_of(line)
    ran = waiter(*arguments)
    assert ran.code == code, ran.err
    assert "Traceback" not in ran.err
    if code in (2, 5):
        assert ran.err.strip(), "a fault is told on stderr"
        assert not ran.out or line == "layout convert two.sparc"
        as_json = waiter(*arguments, "--json")
        assert as_json.code == code
        assert differences(json.loads(as_json.out), shape.ERROR) == []
        assert as_json.json()["errors"]
    assert {path: path.read_bytes() for path in before} == before


@pytest.mark.parametrize("number", ["2147483648", "99999999999999999999"])
def test_a_number_beyond_32_bits_is_a_fault_of_the_program(tmp_path: Path, number: str) -> None:
    program = tmp_path / "n.sparc"
    program.write_text(
        f"#const n = {number}.\nsorts\n#s = {{a}}.\npredicates\np(#s).\nrules\np(a).\n"
    )
    ran = waiter("sparc", "check", str(program))
    assert ran.code == 2 and f"{program}:1:12: error: " in ran.err


def test_every_command_ends_in_all_its_ways() -> None:
    """By command, what the contract promises; the codes that are tested elsewhere left out."""
    found = {
        code: {
            words for words in LEAVES if any(f"{line} ".startswith(f"{words} ") for line in lines)
        }
        for code, lines in ENDS.items()
    }
    elsewhere = {"sparc fetch-jar", "sparc lsp", "studio"}  # by an editor, by a browser
    assert found[0] == set(LEAVES) - elsewhere - {"study show", "study report"}  # by test_json
    assert found[2] == set(LEAVES)
    assert found[3] == {
        "plan",
        "answersets",
        "serve",
        "simulate",
        "validate",
        "sparc query",
        "sparc why",
    }
    assert found[4] == {"plan", "answersets", "explain", "simulate"}
    planning = {"plan", "answersets", "explain", "serve", "simulate"}
    assert found[5] == planning | {"sparc check", "sparc translate", "sparc query"}


@pytest.mark.parametrize(
    ("line", "faults"),
    [
        ("layout check bad.yaml", ["bad.yaml:3:13: error: ", "bad.yaml:4:11: error: "]),
        ("sparc check bad.sparc", ["bad.sparc:4:3: error: ", "bad.sparc:6:1: error: "]),
        (
            "plan --scenario evening.yaml",
            ["evening.yaml:2:33: error: ", "evening.yaml:3:14: error: "],
        ),
    ],
)
def test_each_fault_has_a_message_a_place_and_a_mend(
    line: str, faults: list[str], folder: Path
) -> None:
    ran = waiter(*line.split())
    told = [text for text in ran.err.splitlines() if ": error: " in text]
    assert len(told) == len(faults)
    for text, start in zip(told, faults, strict=True):
        assert text.startswith(start), text
    assert ran.err.count("hint: ") == len(faults)
    errors = waiter(*line.split(), "--json").json()["errors"]
    for error, start in zip(errors, faults, strict=True):
        assert start.startswith(f"{error['file']}:{error['line']}:{error['column']}: ")
        assert error["message"] and error["hint"]


def broken(command: Any) -> Any:
    """The same command with a defect: the same options, and an exception."""

    @functools.wraps(command)
    def fail(**_: Any) -> int:
        raise RuntimeError("no such\nluck")

    return fail


@pytest.mark.parametrize("words", LEAVES)
def test_a_defect_of_ours_is_told_in_one_line(
    words: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    name, *inner = words.split()
    module = __import__(app.COMMANDS[name], fromlist=["app"])
    monkeypatch.setattr(app, "_made", {})  # the commands of before are whole
    if inner:
        for command in module.app.registered_commands:
            if (command.name or command.callback.__name__) == inner[0]:
                monkeypatch.setattr(command, "callback", broken(command.callback))
    else:
        monkeypatch.setattr(module, name, broken(getattr(module, name)))
    required = [p for p in command_tree()[words].params if p.required]
    needed = ["x"] * len(required)
    ran = waiter(*words.split(), *needed)
    said = "internal fault: RuntimeError: no such luck"
    assert (ran.code, ran.out) == (1, "")
    assert ran.err == f"waiter: {said}; run again with --debug for the traceback\n"
    if words not in ("tour", "sparc lsp"):
        (error,) = waiter(*words.split(), *needed, "--json").json()["errors"]
        assert (error["message"], error["hint"]) == (
            said,
            "run again with --debug for the traceback",
        )
    assert app.run([*words.split(), *needed], debug=True) == 1
    assert "Traceback (most recent call last)" in capsys.readouterr().err
