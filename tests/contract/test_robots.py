"""Every command with several robots: what it answers, or in which one line it says that it takes one.

Whether the answers are right is checked where each command has its own tests; `studio` is in
`commands/test_studio` and `studio/live`, `--watch` in `commands/test_watching`.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import Ran, waiter
from tests.support.helps import command_tree

AISLE = """\
name: aisle
nodes: {a: [0, 0], b: [1.2, 0], c: [2.4, 0], bay: [2.4, 1.2], d: [3.6, 0], e: [4.8, 0]}
edges: [[a, b], [b, c], [c, d], [d, e], [c, bay]]
entrance: a
tables: {table1: {capacity: 2, nodes: [e], at: [5.9, 0]}}
agents: {r1: a, r2: e}
"""
NO_BAY = AISLE.replace(" bay: [2.4, 1.2],", "").replace(", [c, bay]", "").replace("aisle", "narrow")
TIMED = AISLE + "waiters: {w1: bay}\ntimetable: {w1: {3: bay}}\n"
WORDS = "layout: aisle.yaml\ngoals: [{holds: 'currentlocation(r1,c)'}]\n"
SEEN = "layout: aisle.yaml\nobserve: [{obs: spilled(c)}]\n"
FACTS = "layout: aisle.yaml\nfacts: [wet(c)]\ngoals: [{at: c}]\n"
GO = "goals: [{at: {r1: c}}]\n"
SWAP = "name: swap\nlayout: aisle.yaml\ngoals: [{at: {r1: e}}, {at: {r2: a}}]\n"
STUDY = """\
name: one-or-two
layouts: [aisle.yaml]
vary: {agents: [1, 2]}
evenings: {scenario: rush.yaml, seeds: 1..1}
"""
RUSH = """\
minutes: 2
guests: {arrivals: {at: [[0, 2]]}, sizes: {2: 1}, eat: 1, bill_after: 0.5}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("NO_COLOR", "1")
    texts = {
        "aisle": AISLE, "narrow": NO_BAY, "timed": TIMED, "swap": SWAP, "study": STUDY,
        "rush": RUSH, "go": GO, "words": WORDS, "seen": SEEN, "facts": FACTS,
        "evenings/swap": SWAP.replace("layout: aisle.yaml\n", ""),
    }  # fmt: skip
    (tmp_path / "evenings").mkdir()
    for name, text in texts.items():
        Path(f"{name}.yaml").write_text(text, encoding="utf-8")
    return tmp_path


# What the user types, the exit code, and a part of what is said.
ANSWERS: dict[str, tuple[int, str]] = {
    "plan -s swap.yaml": (0, "Minimal: a lower bound proves that 5 are too few"),
    "plan -s swap.yaml --json": (0, '"agents": ["r1", "r2"]'),
    "plan -s swap.yaml --show sparc": (0, "#agent = {r1, r2}."),
    "plan -s swap.yaml -l narrow.yaml": (3, "r1 and r2 cannot pass each other between a and e"),
    "plan -s swap.yaml --search linear --max-steps 4": (4, "it has at least 5 steps"),
    "plan -s go.yaml -l timed.yaml": (0, "2 steps"),
    "plan -s words.yaml": (0, "2 steps"),
    "plan -s facts.yaml": (2, "facts.yaml:2:9: error: unknown predicate wet/1"),
    "answersets -s swap.yaml": (0, "occurs(go_to(r"),
    "answersets -s swap.yaml --json -n 0 --grep bay": (0, "holds(currentlocation(r2,bay)"),
    "answersets -s swap.yaml --grep bay --steps 2..3": (0, "step 2"),
    "answersets -s swap.yaml -l narrow.yaml": (3, "cannot pass each other"),
    "answersets -s swap.yaml --why occurs(go_to(r1,d),0)": (0, "is not in the answer set"),
    "explain -s swap.yaml": (0, "None is done in 5"),
    "explain -s swap.yaml -l narrow.yaml": (0, "swap.yaml:3:"),
    "explain -s swap.yaml --why-not go_to(r1,b)": (0, "6 steps"),
    "explain -s swap.yaml --why-not go_to(r1,b) --json": (0, '"foil": "go_to(r1,b)"'),
    "explain -s swap.yaml --why-not seat(r1,c1,table1)": (2, "there is no customer"),
    "explain -s swap.yaml --why-not hello": (2, "write it as seat(r1,c2,table1)"),
    "validate plan.json": (0, "valid: 6 steps"),
    "validate plan.json --json": (0, '"status": "valid"'),
    "validate plan.json -s swap.yaml": (0, "valid: 6 steps"),
    "validate clash.json": (3, "r1 and r2 would both stand on c at step 3"),
    "simulate -s swap.yaml": (0, " r1: "),
    "simulate --plan plan.json --json": (0, '"r2": {"actions": '),
    "simulate -s swap.yaml -l narrow.yaml": (4, "cannot pass each other"),
    "simulate -s swap.yaml --inject out:r2@1+5 --events -": (0, '"kind":"back"'),
    "simulate -s swap.yaml --inject out:r9@1": (2, "known: r1, r2"),
    "serve -s swap.yaml --time-limit 60": (0, '"next": {"r'),
    "compare aisle.yaml narrow.yaml --scenarios evenings": (0, "cannot pass each other"),
    "compare aisle.yaml --agents 1..2 --scenario evenings/swap.yaml": (2, "r2"),
    "layout check aisle.yaml": (0, "is a bottleneck"),
    "layout check aisle.yaml --json": (0, '"kind": "bottleneck"'),
    "layout draw aisle.yaml": (0, "r2 e"),
    "layout draw --plan plan.json": (0, "0-5 r"),
    "layout draw --plan plan.json --json": (0, "r1: walk a"),
    "layout new --scenario -l aisle.yaml --parties 1 --seed 5": (0, "layout: aisle.yaml"),
    "layout schema": (0, '"agents"'),
    "layout convert program.sp": (0, "agents: {r1: a, r2: e}"),
    "study run study.yaml -o rush.db --workers 1": (0, ""),
}  # fmt: skip
ONE_ROBOT: dict[str, str] = {
    "plan -s swap.yaml --domain report": "aisle.yaml:6:9: error: several robots: this domain is for one robot",
    "plan -s swap.yaml --certificate made.json": "--certificate: error: it is about a plan of one robot",
    "answersets -s swap.yaml --domain report": "this domain is for one robot",
    "explain -s swap.yaml --domain report": "this domain is for one robot",
    "simulate -s swap.yaml --domain report -o made.html": "aisle.yaml:6:9: error: several robots: this domain",
    "simulate -l timed.yaml --enter 2 -o made.html": "timed.yaml:8:12: error: colleagues who come by a timetable",
    "simulate -s words.yaml -o made.html": "words.yaml:2:17: error: several robots act by the restaurant's own",
    "simulate -s seen.yaml -o made.html": "seen.yaml:2:17: error: several robots act by the restaurant's own",
    "simulate -s facts.yaml -o made.html": "facts.yaml:2:9: error: several robots act by the restaurant's own",
    "serve -s words.yaml --journal made.journal": "words.yaml:2:17: error: the rules of the restaurant know",
    "serve -s swap.yaml --domain report --journal made.journal": "this domain is for one robot",
    "serve -l timed.yaml --journal made.journal": "timed.yaml:8:12: error: colleagues",
    "studio -s swap.yaml --domain report --no-open": "this domain is for one robot",
    "studio -l timed.yaml --no-open": "timed.yaml:8:12: error: colleagues",
    "layout improve aisle.yaml -s swap.yaml -o made.yaml": "aisle.yaml:6:9: error: several robots: layout improve",
    "layout new --scenario -l aisle.yaml --unsolvable too_big -o made.yaml": "several robots: --unsolvable takes",
    "compare report --agents 1..2 --scenario b1 --domain report": "several robots: this domain",
}  # fmt: skip
ELSEWHERE = {"studio"}
NO_LAYOUT = {
    "domain new", "domain show", "domain test", "study report", "study show", "list", "doctor",
    "tour", "sparc check", "sparc translate", "sparc query", "sparc why", "sparc explain",
    "sparc format", "sparc lsp", "sparc fetch-jar",
}  # fmt: skip


def typed(line: str) -> Ran:
    words = line.split()
    lines = '{"ask": "plan"}\n' if words[0] == "serve" else ""
    return waiter(*words, stdin=lines, terminal="--json" not in words and words[0] != "serve")


def made_before(line: str) -> None:
    """Writes the plans and the program that a line names."""
    if ".json" in line and "made" not in line:
        plan = waiter("plan", "-s", "swap.yaml", "--json").out
        Path("plan.json").write_text(plan, encoding="utf-8")
        document = json.loads(plan)
        document["actions"] = [a for a in document["actions"] if "bay" not in a["text"]]
        clash = json.dumps(document)
        Path("clash.json").write_text(clash, encoding="utf-8")
    if "program.sp" in line:
        Path("program.sp").write_text(waiter("plan", "-s", "swap.yaml", "--show", "sparc").out)


def test_every_command_that_reads_a_layout_is_here() -> None:
    leaves = {
        words for words, each in command_tree().items() if words and not hasattr(each, "commands")
    }
    tried = {words for words in leaves for line in ANSWERS if f"{line} ".startswith(f"{words} ")}
    assert tried | ELSEWHERE | NO_LAYOUT | {"layout improve"} == leaves


@pytest.mark.parametrize("line", ANSWERS)
def test_a_command_answers_for_several_robots(line: str, folder: Path) -> None:
    made_before(line)
    code, said = ANSWERS[line]
    ran = typed(line)
    assert ran.code == code and said in " ".join((ran.out + ran.err).split()), ran
    if not {"--json", "schema", "sparc", "-"} & set(line.split()) and not line.startswith("serve"):
        wide = [
            each for each in (ran.out + ran.err).split("\n") if len(each) > 80 and "\r" not in each
        ]
        assert not wide


@pytest.mark.parametrize("line", ONE_ROBOT)
def test_a_command_for_one_robot_says_so_before_it_does_anything(line: str, folder: Path) -> None:
    ran = typed(line)
    told = " ".join(ran.err.split())
    assert (ran.code, ran.out) == (2, "") and ONE_ROBOT[line] in told, ran
    assert "hint: " in told and not list(folder.glob("made*"))


def test_recordings_of_several_robots(folder: Path) -> None:
    for name, begins in (("swap.png", b"\x89PNG"), ("swap.html", b"<!"), ("swap.gif", b"GIF8")):
        ran = waiter(
            "simulate",
            "-s",
            "swap.yaml",
            "-o",
            name,
            "--view",
            "2d",
            "--fps",
            "1",
            "--size",
            "320x240",
        )
        assert ran.code == 0 and Path(name).read_bytes().startswith(begins), ran
