"""The journal: durable, locked, mended where it was torn, replayed byte for byte."""

from __future__ import annotations

import json
import os
import random
import resource
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import Ran, waiter
from tests.support.lunch import Lunch
from tests.support.sampling import mostly_slow
from tests.support.serving import ROOT, Pipe, thinker
from waiter_cli.diagnosis.diagnose import explain
from waiter_cli.errors import InputError
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.file_access.locate import read_text
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.model.problem import Problem
from waiter_cli.model.state import State
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.journal import Journal, JournalFull, read_journal
from waiter_cli.serve.memory import memorize, remember
from waiter_cli.serve.session import Session
from waiter_cli.serve.startup import begin, open_journal
from waiter_cli.serve.supersede import Superseded

LINES: list[dict[str, Any]] = [
    {"observe": {"enter": ["c1", "c2"]}},
    {"started": 0},
    {"done": 0},
    {"failed": 1, "reason": "slipped"},
    {"observe": {"at": {"w1": "n4"}}, "id": "seen"},
    {"observe": {"at": {"w1": "n7"}}},
    {"goal": {"serve": "c2"}},
    {"observe": {"bill": "table1"}},
    {"drop": {"serve": "c1"}},
]


def serve(path: Path, *lines: Any, more: tuple[str, ...] = ()) -> tuple[list[Any], Ran]:
    """The answers of a run that carries on a journal, and the run."""
    text = "\n".join(line if isinstance(line, str) else json.dumps(line) for line in lines)
    ran = waiter(
        "serve",
        "--layout",
        "report",
        "--journal",
        str(path),
        "--time-limit",
        "30",
        *more,
        stdin=text,
    )
    return [json.loads(line) for line in ran.out.splitlines()[1:]], ran


def warn(text: str) -> None:
    raise AssertionError(text)


# -- carrying on ------------------------------------------------------------------------------


@pytest.mark.parametrize("cut", mostly_slow(range(len(LINES) + 1), 3, 7))
def test_a_run_goes_on_where_it_ended(cut: int, tmp_path: Path) -> None:
    expected, _ = serve(tmp_path / "whole", *LINES, {"ask": "state"}, {"ask": "plan"})
    path = tmp_path / "cut"
    first, _ = serve(path, *LINES[:cut])
    second, ran = serve(path, *LINES[cut:], {"ask": "state"}, {"ask": "plan"})
    assert ran.code == 0
    for answer, other in zip([*first, *second], expected, strict=True):
        for key in ("revision", "horizon", "minimal", "plan", "state", "step", "pending"):
            assert answer.get(key) == other.get(key), (answer, other)


def test_what_went_on_before_is_told(tmp_path: Path) -> None:
    _, first = serve(tmp_path / "j", {"observe": {"enter": ["c1"]}}, {"done": 0})
    assert "going on" not in first.err
    _, second = serve(tmp_path / "j")
    assert "going on at step 1, revision 1" in second.err


def test_errors_and_questions_are_not_recorded(tmp_path: Path) -> None:
    serve(tmp_path / "j", {"ask": "state"}, "nonsense", {"done": 3}, {"observe": {"bill": "x"}})
    found = read_journal(str(tmp_path / "j"))
    assert found is not None and found.records == ()


def test_another_layout_or_scenario_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path, {"observe": {"enter": ["c1"]}})
    for arguments in (("--layout", "bistro"), ("--scenario", "b2")):
        ran = waiter("serve", *arguments, "--journal", str(path))
        assert ran.code == 2 and "begun with another layout or scenario" in ran.err


def test_states_are_remembered_exactly() -> None:
    state = State(
        "n1",
        (("w1", "n7"),),
        (("table1", ("c1", "c2")),),
        (("c3",), ("c4", "c5")),
        ("c6",),
        frozenset({"table2"}),
        ordered=frozenset({"table1"}),
        ready=frozenset({("table1", "plate")}),  # an old plate and a new order at once
        carrying=("table2", "jug"),
        empty=frozenset({("table2", "jug")}),
        chairs=(("table1", 2), ("table2", 4)),
    )
    told = json.loads(json.dumps(memorize(state)))
    assert told == memorize(state)
    assert remember(told) == state


# -- replaying --------------------------------------------------------------------------------


def test_a_replay_prints_every_answer_byte_for_byte(tmp_path: Path) -> None:
    path = tmp_path / "j"
    _, ran = serve(path, *LINES)
    told = []
    for line in ran.out.splitlines()[1:]:
        head, _, tail = line.rpartition(', "latency_ms": ')
        assert tail.endswith("}")
        told.append(head + "}")
    replayed = waiter("serve", "--replay", str(path))
    assert replayed.code == 0, replayed.err
    assert replayed.out.splitlines() == told


def test_a_replay_notices_another_state_and_another_plan(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path, *LINES[:3])
    text = path.read_text()
    lines = text.splitlines(keepends=True)
    path.write_text("".join(lines[:1] + [lines[1].replace('"c2"]]', '"c9"]]')] + lines[2:]))
    ran = waiter("serve", "--replay", str(path))
    assert ran.code == 3 and "the state after it is another one" in ran.err
    path.write_text(text.replace('"args": ["agent", "n3"]', '"args": ["agent", "n6"]'))
    ran = waiter("serve", "--replay", str(path))
    assert ran.code == 3 and "the plan is not possible" in ran.err


def test_superseded_and_late_decisions_are_replayed_too(tmp_path: Path) -> None:
    path = str(tmp_path / "j")
    layout = read_layout_file("report")
    text = read_text("report", "layout").text

    def planner(problem: Problem) -> PlannerAnswer:
        if len(problem.goals) == 1:
            raise Superseded(2)
        return PlannerAnswer("undecided", None, limit="time")

    def run(*lines: dict[str, Any]) -> list[dict[str, Any]]:
        executive = begin(layout, None, thinker(), explain)
        journal, _ = open_journal(path, executive, text, warn)
        if lines:
            executive._planner = planner
        session = Session(executive, thinker(), journal)
        answers = [
            json.loads(session.handle(ReceivedLine(number, json.dumps(line).encode(), 0.0)))
            for number, line in enumerate(lines or [{"ask": "plan"}], 1)
        ]
        journal.close()
        return answers

    first = run({"observe": {"enter": ["c1"]}}, {"observe": {"enter": ["c2"]}})
    assert first[0]["superseded_by"] == 2 and first[1]["limit"] == "time"
    run({"observe": {"leave": ["c2"]}})  # superseded by a line that never came
    (resumed,) = run()
    assert resumed["horizon"] == 7, "decided at the new start"
    again = waiter("serve", "--layout", "report", "--journal", path, stdin='{"done": 0}')
    assert json.loads(again.out.splitlines()[1])["horizon"] == 6
    replayed = waiter("serve", "--replay", path)
    assert replayed.code == 0, replayed.err
    told = [json.loads(line) for line in replayed.out.splitlines()]
    assert [each.get("superseded_by") for each in told] == [2, None, 2, None]
    assert [each.get("limit") for each in told] == [None, "time", None, None]


# -- damage -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kept", [1, 10, 200, -1, -2])
def test_a_torn_last_line_is_dropped_with_a_warning(tmp_path: Path, kept: int) -> None:
    path = tmp_path / "j"
    serve(path, *LINES[:2])
    whole = path.read_bytes()
    serve(path, LINES[2])
    last = path.read_bytes()[len(whole) :]
    path.write_bytes(whole + last[:kept])
    (state,), ran = serve(path, {"ask": "state"})
    assert ran.code == 0 and "was not finished" in ran.err
    assert state["step"] == 0, "the step that was torn off was never answered"
    assert path.read_bytes() == whole


def test_a_torn_first_line_is_a_journal_that_never_began(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path)
    path.write_bytes(path.read_bytes()[:50])
    _, ran = serve(path, LINES[0])
    assert ran.code == 0
    found = read_journal(str(path))
    assert found is not None and len(found.records) == 1


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda text: text.replace('{"seq": 1', '{"sq": 1'), "record 1 is missing"),
        (lambda text: "".join(text.splitlines(True)[:1] + text.splitlines(True)[2:]), "missing"),
        (lambda text: text.replace('{"seq": 1', "{seq: 1"), "this line is damaged"),
        (lambda text: text.replace("waiter.journal/1", "waiter.journal/9"), "waiter.journal/1 is"),
        (lambda text: "shopping: milk\n", "this is no journal"),
        (lambda text: '{"a": 1}\n', "this is no journal"),
        (lambda text: text.replace('"enter": ["c1"', '"enter": ["agent"'), "is damaged"),
        (lambda text: text.replace('"start": {', '"start": 0, "x": {'), "cannot be read"),
    ],
)
def test_other_damage_is_an_error_with_its_place(tmp_path: Path, damage: Any, message: str) -> None:
    path = tmp_path / "j"
    serve(path, *LINES[:3])
    path.write_text(damage(path.read_text()))
    before = path.read_bytes()
    ran = waiter("serve", "--layout", "report", "--journal", str(path))
    assert ran.code == 2 and message in ran.err and str(path) in ran.err
    assert "Traceback" not in ran.err
    assert path.read_bytes() == before, "nothing is written over"


def test_a_second_writer_is_kept_out(tmp_path: Path) -> None:
    path = tmp_path / "j"
    loop = Pipe("--layout", "report", "--journal", str(path))
    assert loop.tell(LINES[0])["horizon"] == 7
    ran = waiter("serve", "--layout", "report", "--journal", str(path))
    assert ran.code == 2 and "somebody else writes this journal" in ran.err
    assert waiter("serve", "--replay", str(path)).code == 0, "reading is free"
    assert loop.end()[0] == 0
    assert serve(path)[1].code == 0


def test_files_that_cannot_be_written(tmp_path: Path) -> None:
    for path in ("/dev/full", str(tmp_path), str(tmp_path / "no" / "j")):
        ran = waiter("serve", "--layout", "report", "--journal", path)
        assert ran.code == 2 and path in ran.err and "Traceback" not in ran.err


def test_a_journal_that_is_read_only(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path, LINES[0])
    path.chmod(0o444)
    before = path.read_bytes()
    ran = waiter("serve", "--layout", "report", "--journal", str(path))
    assert ran.code == 2 and str(path) in ran.err
    assert "permission denied" in ran.err or "is read-only" in ran.err
    assert path.read_bytes() == before
    assert waiter("serve", "--replay", str(path)).code == 0


def test_a_full_disk_changes_nothing_and_is_told(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path)
    room = path.stat().st_size + 2500

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))

    loop = Pipe("--layout", "report", "--journal", str(path), preexec_fn=limit)
    for number in range(20):
        before = loop.tell({"ask": "state"})["state"]
        answer = loop.tell({"observe": {"enter": [f"c{number}"]}})
        if "error" in answer:
            break
    assert number > 0
    assert "cannot be written" in answer["error"]["message"] and "plan" not in answer
    assert loop.tell({"ask": "state"})["state"] == before
    assert loop.end()[0] == 0
    (answer,), ran = serve(path, {"ask": "state"})
    assert ran.code == 0 and "not finished" not in ran.err and answer["state"] == before


def test_what_could_not_be_written_leaves_no_trace(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = str(tmp_path / "j")
    journal, _ = Journal.open(path, warn)
    journal.begin({})
    journal.append({"a": 1})
    real = os.pwrite

    def half(descriptor: int, data: bytes, at: int) -> int:
        real(descriptor, data[: len(data) // 2], at)
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "pwrite", half)
    for write in (lambda: journal.append({"b": 2}), lambda: journal.compact({})):
        with pytest.raises(JournalFull, match="no space left on device"):
            write()
    monkeypatch.undo()
    journal.append({"c": 3})
    journal.close()
    found = read_journal(path)
    assert found is not None and [r.get("c") for r in found.records] == [None, 3]
    assert os.listdir(tmp_path) == ["j"]


# -- compaction -------------------------------------------------------------------------------


def test_compaction_keeps_what_is_known_and_drops_the_past(tmp_path: Path) -> None:
    path = tmp_path / "j"
    serve(path, *LINES[:6], {"goal": {"serve": "c1"}}, {"observe": {"bill": "table1"}})
    questions = ({"ask": "state"}, {"ask": "plan"})
    before, _ = serve(path, *questions)
    size = path.stat().st_size
    after, _ = serve(path, *questions, more=("--compact",))
    assert after == before and path.stat().st_size < size
    again, _ = serve(path, *questions, {"observe": {"leave": ["c1"]}})
    assert again[:2] == before and again[2]["closed"] == [{"serve": "c1"}]
    assert waiter("serve", "--replay", str(path)).code == 0
    with pytest.raises(InputError, match="somebody else"):
        first, _ = Journal.open(str(path), warn)
        Journal.open(str(path), warn)
    first.close()


# -- kill -9 ----------------------------------------------------------------------------------


def die_and_go_on(tmp_path: Path, deaths: int, seed: int) -> None:
    """A lunch whose loop is killed at random moments: nothing that was answered is lost."""
    rng = random.Random(seed)
    layout = read_layout_file("report_large")
    path = tmp_path / f"lunch{seed}"
    lunch = Lunch(layout, seed)
    plan: list[dict[str, Any]] = []
    often = "from waiter_cli import app; from waiter_cli.serve import journal"
    often += "; journal.SNAPSHOT_EVERY = 5; app.main()"
    command = [sys.executable, "-c", often, "serve", "--layout", "report_large"]
    command += ["--journal", str(path)]
    unanswered: dict[str, Any] | None = None
    for _ in range(deaths):
        loop = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=ROOT,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )
        assert loop.stdin is not None and loop.stdout is not None
        loop.stdout.readline()

        def tell(line: dict[str, Any], loop: Any = loop) -> dict[str, Any]:
            loop.stdin.write(json.dumps(line).encode() + b"\n")
            loop.stdin.flush()
            return json.loads(loop.stdout.readline())  # type: ignore[no-any-return]

        state = tell({"ask": "state"})["state"]
        if unanswered is not None and state != lunch.state():
            answer = tell(unanswered)  # it was not recorded, so it may be told again
            assert "error" not in answer, answer
            state = tell({"ask": "state"})["state"]
        assert state == lunch.state()
        plan = tell({"ask": "plan"})["plan"]
        for _ in range(rng.randint(0, 4)):
            answer = tell(lunch.next_line(plan))
            assert "error" not in answer, answer
            plan = answer["plan"]
        unanswered = lunch.next_line(plan)
        loop.stdin.write(json.dumps(unanswered).encode() + b"\n")
        loop.stdin.flush()
        time.sleep(rng.random() * 0.03)
        loop.kill()
        loop.wait()
        loop.stdin.close()
        loop.stdout.close()
    assert waiter("serve", "--replay", str(path)).code == 0
    if deaths >= 20:
        assert '"snapshot": {' in path.read_text()


def test_nothing_is_lost_when_it_is_killed(tmp_path: Path) -> None:
    die_and_go_on(tmp_path, 6, 1)


@pytest.mark.slow
@pytest.mark.attack
def test_nothing_is_lost_when_it_is_killed_240_times(tmp_path: Path) -> None:
    for seed in range(12):
        die_and_go_on(tmp_path, 20, seed)
