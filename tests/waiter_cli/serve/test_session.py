"""``waiter serve``: its protocol, whole lunches, searches that give way, sockets, the example."""

from __future__ import annotations

import json
import os
import random
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import waiter
from tests.support.lunch import Lunch
from tests.support.sampling import mostly_slow
from tests.support.serving import ROOT, Client, Live, Pipe, listening
from waiter_cli.errors import InputError
from waiter_cli.execution.agenda import PlannerAnswer
from waiter_cli.files.layout_reader import read_layout, read_layout_file
from waiter_cli.files.scenario_reader import read_scenario, read_scenario_file
from waiter_cli.layout_tools.generate import generate_layout
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.serve.addresses import parse_address
from waiter_cli.serve.inbox import Inbox, ReceivedLine
from waiter_cli.serve.latency import Latencies
from waiter_cli.serve.protocol import MAX_LINE
from waiter_cli.serve.session import serve_lines

SCENES = [
    ({"enter": ["c1"]}, 7),
    ({"enter": ["c2", "c3", "c4", "c5"]}, 4),
    ({"bill": "table1"}, 1),
    ({"bill": "table2"}, 1),
]


@pytest.fixture(scope="module")
def report() -> Layout:
    return read_layout_file("report")


@pytest.fixture
def live(report: Layout) -> Live:
    return Live(report)


# -- over a pipe ------------------------------------------------------------------------------


def test_the_scenes_of_the_report_over_a_pipe() -> None:
    loop = Pipe("--layout", "report", "--record-timing")
    assert loop.hello == {"hello": "waiter.serve/1", "layout": "report"}
    count = step = 0
    for seen, steps in SCENES:
        answer = loop.tell({"observe": seen})
        count += 1
        assert (answer["line"], answer["horizon"], answer["minimal"]) == (count, steps, True)
        assert [action["step"] for action in answer["plan"]] == list(range(step, step + steps))
        for left in reversed(range(steps)):
            answer = loop.tell({"done": step})
            count, step = count + 1, step + 1
            assert (answer["line"], answer["horizon"]) == (count, left)
    assert loop.tell({"ask": "state"})["state"] == {
        "agent": "n6",
        "waiters": {"w1": "n7"},
        "seated": {"table1": ["c1"], "table2": ["c2", "c3", "c4", "c5"]},
        "paid": ["table1", "table2"],
    }
    code, err = loop.end()
    assert code == 0
    assert "p50" in err and "p95" in err and "p99" in err and "(4 observations)" in err


def test_all_lines_at_once_are_answered_in_their_order() -> None:
    lines = [{"observe": {"enter": ["c1"]}}, *({"done": step} for step in range(7))]
    lines += [{"observe": {"bill": "tabel1"}}, {"ask": "state", "id": "last"}]
    text = "\n".join(map(json.dumps, lines))  # and no end of the last line
    ran = subprocess.run(
        [sys.executable, "-m", "waiter_cli", "serve", "--layout", "report"],
        input=text.encode(),
        capture_output=True,
        cwd=ROOT,
        timeout=60,
    )
    assert ran.returncode == 0, ran.stderr
    _, *answers = map(json.loads, ran.stdout.splitlines())
    assert [answer["line"] for answer in answers] == list(range(1, 11))
    assert [answer.get("horizon") for answer in answers[:8]] == [7, 6, 5, 4, 3, 2, 1, 0]
    assert answers[8]["error"] == {
        "message": "unknown table tabel1",
        "hint": "did you mean table1?",
    }
    assert answers[9]["id"] == "last" and answers[9]["state"]["seated"] == {"table1": ["c1"]}


@pytest.mark.parametrize(
    ("line", "message", "hint"),
    [
        ({"observe": {"leave": ["c9"]}}, "c9 leaves, but is not inside", "inside: ada; "),
        ({"observe": {"leave": ["adda"]}}, "adda leaves, but is not", "did you mean ada?; what is"),
        (
            {"observe": {"leave": "table1"}},
            "table1 is a table",
            "what is free again: {free: table1}",
        ),
        ({"goal": {"seated": ["adda"]}}, "unknown customer adda", "did you mean ada?"),
        ({"goal": {"seated": "c9"}}, "unknown customer c9", "known: ada"),
        ({"goal": {"seated": "table9"}}, "unknown customer table9", "{party: c1, table: table2}"),
        ({"goal": {"seated": "table1"}}, "table1 is a table", "{party: c1, table: table1}"),
        ({"goal": {"paid": "table9"}}, "unknown table or customer table9", "did you mean table2?"),
        ({"goal": {"serve": "table1"}}, "table1 is a table", "name a customer of the party"),
    ],
    ids=str,
)
def test_a_name_that_is_no_guests_is_answered_with_what_may_be_meant(
    line: dict[str, Any], message: str, hint: str
) -> None:
    lines = [{"observe": {"enter": ["ada"]}}, line]
    ran = waiter("serve", "--layout", "report", stdin="\n".join(map(json.dumps, lines)))
    error = json.loads(ran.out.splitlines()[-1])["error"]
    assert message in error["message"] and hint in error["hint"]


def test_a_client_that_hangs_up_ends_the_loop_quietly() -> None:
    loop = Pipe("--layout", "report")
    assert loop.process.stdout is not None and loop.process.stderr is not None
    loop.process.stdout.close()
    loop.send({"ask": "state"})
    assert loop.process.wait(30) == 0
    assert b"Traceback" not in loop.process.stderr.read()


def test_it_can_be_terminated() -> None:
    loop = Pipe("--layout", "report")
    loop.process.send_signal(signal.SIGTERM)
    assert loop.process.wait(30) == 143


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ([], 2, "which restaurant?"),
        (["--layout", "reprot"], 2, "did you mean report?"),
        (["--layout", "-"], 2, "standard input is for observations"),
        (["--layout", "report", "--listen", "0.0.0.0:1"], 2, "is not this machine"),
        (["--replay", "nowhere.journal"], 2, "no such file"),
    ],
)
def test_wrong_calls(arguments: list[str], code: int, message: str) -> None:
    ran = waiter("serve", *arguments)
    assert (ran.code, ran.out) == (code, "")
    assert message in ran.err


def test_a_contradiction_at_the_start_is_told(tmp_path: Path) -> None:
    path = tmp_path / "s.yaml"
    path.write_text("state: {waiting: [[c1]]}\nobserve: [{enter: [c1]}]\n")
    ran = waiter("serve", "--layout", "report", "--scenario", str(path))
    assert ran.code == 3 and "inside already" in ran.err


@pytest.mark.parametrize(("name", "steps"), [("b1", 7), ("b2", 4), ("b3", 1), ("b4", 1)])
def test_a_run_starts_from_a_scenario(name: str, steps: int) -> None:
    layout, scenario = read_scenario_file(name)
    answer = Live(layout, scenario).tell({"ask": "plan"})
    assert (answer["horizon"], answer["minimal"], answer["revision"]) == (steps, True, 1)


# -- the protocol -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (b"", "is empty"),
        (b"   ", "is empty"),
        (b"hello", "no JSON"),
        (b"{", "no JSON"),
        (b"[1]", "must be a JSON object"),
        (b"null", "must be a JSON object"),
        (b"\xff\xfe{}", "not UTF-8"),
        (b"{}", "nothing is said"),
        (b'{"id": 1}', "nothing is said"),
        (b'{"observ": {}}', "unknown key observ"),
        (b'{"done": 0, "failed": 0}', "done and failed in one line"),
        (b'{"done": 0, "done": 0}', "given twice"),
        (b'{"done": true}', "takes the number of a step"),
        (b'{"done": -1}', "takes the number of a step"),
        (b'{"done": "0"}', "takes the number of a step"),
        (b'{"done": 0.5}', "takes the number of a step"),
        (b'{"done": 5}', "out of order"),
        (b'{"failed": 0, "reason": 3}', "reason must be a text"),
        (b'{"done": 0, "reason": "x"}', "unknown key reason"),
        (b'{"done": NaN}', "no number"),
        (b'{"done": 1' + b"0" * 6000 + b"}", "too long"),
        (b'{"ask": "weather"}', "unknown question"),
        (b'{"ask": ["state"]}', "unknown question"),
        (b'{"ask": "state", "id": []}', "id must be"),
        (b'{"observe": []}', "nothing is observed"),
        (b'{"observe": {}}', "nothing"),
        (b'{"observe": "bill"}', "must be a list"),
        (b'{"observe": {"bill": "tabel1"}}', "unknown table tabel1"),
        (b'{"observe": {"enter": []}}', "nobody"),
        (b'{"observe": {"enter": ["agent"]}}', "reserved"),
        (b'{"observe": {"enter": ["table1"]}}', "table1 is a table"),
        (b'{"observe": {"enter": ["\\ud800"]}}', "no name"),
        (b'{"observe": {"at": {"w9": "n3"}}}', "unknown waiter w9"),
        (b'{"observe": {"at": {"w1": "n99"}}}', "unknown node n99"),
        (b'{"observe": {"order": "table1"}}', "needs a bar"),
        (b'{"observe": {"leave": ["c9"]}}', "not inside"),
        (b'{"observe": [{"bill": "table1"}, {"bill": "tabel1"}]}', "unknown table"),
        (b'{"observe": ' + b"[" * 100_000 + b"}", "nested"),
        (b'{"observe": ' + b'{"a":' * 60 + b"1" + b"}" * 61, "nested"),
        (b'{"goal": {"paid": "tabel1"}}', "unknown"),
        (b'{"goal": {}}', "nothing"),
        (b'{"drop": {"at": "n1"}}', "no goal"),
        (b"x" * (MAX_LINE + 1), "longer than"),
    ],
    ids=range(43),
)
def test_a_bad_line_gets_an_error_and_changes_nothing(
    live: Live, line: bytes, message: str
) -> None:
    before = (live.session.executive.state, live.session.executive.decision)
    answer = live.tell(line)
    assert set(answer) <= {"line", "error", "id"}
    assert message in answer["error"]["message"]
    assert (live.session.executive.state, live.session.executive.decision) == before


def test_ten_megabytes_in_one_line_over_a_pipe() -> None:
    loop = Pipe("--layout", "report")
    answer = loop.tell(b'{"observe": "' + b"x" * 10_000_000 + b'"}')
    assert answer["line"] == 1 and "longer than" in answer["error"]["message"]
    assert loop.tell({"ask": "state"})["line"] == 2
    assert loop.end()[0] == 0


@pytest.mark.parametrize("id_", ["x", 7, 1.5, ""])
def test_an_id_comes_back(live: Live, id_: Any) -> None:
    assert live.tell({"ask": "plan", "id": id_})["id"] == id_
    assert live.tell({"observe": {"bill": "tabel1"}, "id": id_})["id"] == id_
    assert live.tell({"observe": {"bill": "table1"}, "id": id_})["id"] == id_


def test_the_example_of_the_contract(live: Live) -> None:
    one = live.seen({"enter": ["c1"]})
    assert (one["revision"], one["horizon"], one["minimal"]) == (1, 7, True)
    assert one["plan"][0] == {
        "step": 0,
        "name": "go_to",
        "args": ["agent", "n2"],
        "text": "go_to(agent,n2)",
    }
    two = live.tell({"done": 0})
    assert (two["revision"], two["horizon"], two["plan"][0]["step"]) == (1, 6, 1)
    three = live.tell({"failed": 1, "reason": "door shut"})
    assert (three["revision"], three["plan"][0]["step"]) == (2, 2)
    four = live.seen({"at": {"w1": "n3"}}, {"bill": "table1"})
    assert four["revision"] == 3 and four["diagnosis"][0]["events"][-1]["args"] == ["w1", "n3"]
    five = live.state()
    assert five["waiters"] == {"w1": "n3"} and five["wants_bill"] == ["table1"]


def test_the_questions(live: Live) -> None:
    live.seen({"enter": ["c1"]})
    why = live.tell({"ask": "why"})["why"]
    assert why["goals"] == [{"goal": {"seated": ["c1"]}, "reached_at": 7}]
    assert [step["step"] for step in why["steps"]] == list(range(7))
    assert why["everybody"] is True
    live.tell({"started": 0})
    why = live.tell({"ask": "why"})["why"]
    assert why["goals"][0]["reached_at"] == 7 and why["steps"][0]["step"] == 1
    plan = live.tell({"ask": "plan"})
    assert plan["horizon"] == 7 and "latency_ms" not in plan
    stats = live.tell({"ask": "stats"})["stats"]
    assert stats["lines"] == 6 and stats["errors"] == 0 and stats["latency"]["count"] == 1


def test_no_plan_is_told_with_its_reasons() -> None:
    live = Live(read_layout_file("walled_off"))
    answer = live.seen({"enter": ["c1"]})
    assert (answer["status"], answer["plan"], answer["horizon"]) == ("no_plan", [], 0)
    assert answer["reasons"][0]["message"]
    assert answer["pending"][0]["goal"] == {"seated": ["c1"]}


def test_a_whole_visit_from_door_to_door_by_one_goal() -> None:
    live = Live(read_layout_file("bistro"))
    answer = live.tell({"goal": {"serve": "c1"}})
    assert "not inside yet" in answer["pending"][0]["reasons"][0]["message"]
    live.work(live.seen({"enter": ["c1", "c2"]}))
    (table,) = live.state()["seated"]
    for seen in ({"order": table}, {"ready": {table: "plate"}}, {"bill": table}):
        answer = live.seen(seen)
        assert answer["plan"], seen
        live.work(answer)
    state = live.state()
    assert state["paid"] == [table] and state["served"] == [table]
    answer = live.seen({"leave": ["c2"]})
    assert answer["closed"] == [{"serve": "c1"}] and answer["plan"] == []
    assert "seated" not in live.state()


def test_a_party_too_many_waits_without_stopping_the_robot(live: Live) -> None:
    for name in ("c1", "c2", "c3"):
        answer = live.seen({"enter": [name]})
    assert [each["goal"] for each in answer["pending"]] == [{"seated": ["c3"]}]
    assert "status" not in answer and answer["horizon"] > 0
    answer = live.work(answer)
    assert len(live.state()["seated"]) == 2 and answer["pending"]
    answer = live.seen({"leave": ["c1"]})
    assert "pending" not in answer
    live.work(answer)
    assert ["c3"] in live.state()["seated"].values()


# -- whole lunches ----------------------------------------------------------------------------


def have_lunch(layout: Layout, events: int, seed: int, time_limit: float) -> Live:
    """A lunch whose every event is answered, with belief and truth compared after each."""
    live, lunch = Live(layout, time_limit=time_limit), Lunch(layout, seed)
    plan: list[dict[str, Any]] = []
    for number in range(events):
        line = lunch.next_line(plan)
        answer = live.tell(line)
        assert "error" not in answer, (seed, number, line, answer)
        plan = answer["plan"]
        assert live.state() == lunch.state(), (seed, number, line)
    return live


@pytest.mark.wide
@pytest.mark.parametrize("seed", mostly_slow([1, 2], 1))
def test_a_lunch_of_a_hundred_events(seed: int) -> None:
    live = have_lunch(read_layout_file("report_large"), 100, seed, 1.0)
    assert live.session.stats()["errors"] == 0 and live.session.executive.step > 20


@pytest.mark.parametrize("name", mostly_slow(["report", "bistro"], "report"))
def test_a_lunch_elsewhere(name: str) -> None:
    have_lunch(read_layout_file(name), 60, 3, 0.1)


@pytest.mark.slow
@pytest.mark.parametrize("bar", [False, True], ids=["plain", "with a bar"])
def test_a_lunch_of_a_thousand_events_at_fifty_tables(bar: bool) -> None:
    text = generate_layout(5, 120, 50, bar=bar, waiters=3)
    have_lunch(read_layout(text, "fifty"), 1000, 5, 0.2)


# -- fuzz -------------------------------------------------------------------------------------


def odd_line(rng: random.Random) -> bytes:
    """A line that may be nearly right, or nothing at all like it."""
    words = ["c1", "c2", "table1", "n5", "w1", "agent", "", "no", 0, -1, 1e99, None, True, "é"]
    keys = ["observe", "done", "failed", "started", "goal", "drop", "ask", "id", "reason", "x"]
    kinds = ["enter", "leave", "bill", "at", "order", "ready", "empty", "free", "seated", "paid"]
    kinds += ["serve", "chairs", "party", "table", "w1", "table1", "state", "why"]

    def value(depth: int) -> Any:
        roll = rng.random()
        if depth > 3 or roll < 0.4:
            return rng.choice([*words, *kinds])
        if roll < 0.7:
            return {rng.choice(kinds): value(depth + 1) for _ in range(rng.randint(0, 2))}
        return [value(depth + 1) for _ in range(rng.randint(0, 3))]

    line = {rng.choice(keys): value(0) for _ in range(rng.randint(0, 3))}
    if rng.random() < 0.4:
        line = {"observe": {rng.choice(kinds): value(1)}}
    data = bytearray(json.dumps(line, ensure_ascii=rng.random() < 0.5).encode())
    for _ in range(rng.choice([0, 0, 0, 1, 3])):
        data.insert(rng.randrange(len(data) + 1), rng.randrange(256))
    return bytes(data).replace(b"\n", b" ")


def fuzz(lines: int, seed: int) -> None:
    """Lines of all sorts: each is answered, and what is an error changes nothing."""
    rng = random.Random(seed)
    live = Live(read_layout_file("bistro"), time_limit=0.05)
    for _ in range(lines):
        before = (live.session.executive.state, live.session.executive.decision)
        answer = live.tell(odd_line(rng))
        if "error" in answer:
            assert answer["error"]["message"]
            assert (live.session.executive.state, live.session.executive.decision) == before
        else:
            assert answer.keys() & {"plan", "state", "why", "stats"}
    answers = live.session.stats()
    assert answers["errors"] < answers["lines"], "some of it should be right"


def test_five_hundred_fuzzed_lines() -> None:
    fuzz(500, 1)


@pytest.mark.slow
def test_ten_thousand_fuzzed_lines() -> None:
    for seed in range(10):
        fuzz(1000, seed)


# -- searches that give way -------------------------------------------------------------------


def test_a_newer_observation_supersedes_a_search(
    report: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    live = Live(report)
    session = live.session
    searched: list[int] = []

    def slow(problem: Problem) -> PlannerAnswer:
        searched.append(len(problem.goals))
        if len(problem.goals) == 1:
            time.sleep(20)
        return PlannerAnswer("undecided", None, limit="time")

    monkeypatch.setattr(session.executive, "_planner", slow)
    inbox = Inbox()
    for number, line in enumerate(
        ['{"observe": {"enter": ["c1"]}}', '{"observe": {"enter": ["c2"]}}', '{"ask": "state"}'], 1
    ):
        inbox.put(ReceivedLine(number, line.encode(), time.perf_counter()))
    inbox.close()
    answers: list[str] = []
    start = time.monotonic()
    serve_lines(session, inbox, answers.append)
    assert time.monotonic() - start < 10
    first, second, third = map(json.loads, answers)
    assert first == {"line": 1, "superseded_by": 2}
    assert second["line"] == 2 and second["status"] == "undecided"
    assert third["state"]["waiting"] == [["c1"], ["c2"]], "what was seen is believed all the same"
    assert searched == [1, 2] and session.superseded == 1


@pytest.mark.wide
@pytest.mark.parametrize(
    "line", ['{"ask": "state"}', '{"observe": {"enter": ["c1"]}}', "nonsense", '{"done": 0}']
)
def test_other_lines_do_not_end_a_search(
    report: Layout, monkeypatch: pytest.MonkeyPatch, line: str
) -> None:
    session = Live(report).session

    def slow(problem: Problem) -> PlannerAnswer:
        time.sleep(0.4)
        return PlannerAnswer("undecided", None, limit="time")

    monkeypatch.setattr(session.executive, "_planner", slow)
    inbox = Inbox()
    inbox.put(ReceivedLine(1, b'{"observe": {"enter": ["c1"]}}', time.perf_counter()))
    inbox.put(ReceivedLine(2, line.encode(), time.perf_counter()))
    inbox.close()
    answers: list[str] = []
    serve_lines(session, inbox, answers.append)
    assert json.loads(answers[0])["status"] == "undecided"


def test_a_search_over_its_time_yields_a_valid_plan_marked_as_such() -> None:
    layout = read_layout(generate_layout(3, 50, 20, bar=True, waiters=2), "fifty")
    live = Live(layout, time_limit=0.05)
    tables = [table.name for table in layout.tables][:8]
    parties = [{"enter": [f"p{n}"]} for n in range(6)]
    answer = live.seen(*parties, *({"empty": {table: "jug"}} for table in tables))
    assert answer["plan"] and answer["minimal"] is False
    assert (answer["status"], answer["limit"]) == ("undecided", "time")
    live.work(answer)
    assert "empty" not in live.state() and len(live.state()["seated"]) == 6


# -- sockets ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "address",
    [
        "0.0.0.0:1",
        ":1",
        "10.0.0.1:80",
        "example.org:1",
        "127.0.0.1:x",
        "127.1:1",
        "",
        "7311",
        "127.0.0.1",
        "localhost",
    ],
)
def test_only_this_machine_may_connect(address: str) -> None:
    with pytest.raises(InputError):
        parse_address(address)


@pytest.mark.parametrize("kind", ["port", "path"])
def test_one_writes_and_many_listen(kind: str, tmp_path: Path) -> None:
    path = str(tmp_path / "loop.sock")
    process, place = listening("--listen", "127.0.0.1:0" if kind == "port" else path)
    try:
        target: Any = ("127.0.0.1", int(place.rpartition(":")[2])) if kind == "port" else place
        writer, listener = Client(target), Client(target)
        assert writer.hello == listener.hello == {"hello": "waiter.serve/1", "layout": "report"}
        writer.send(b'{"observe": {"enter": ["c1"]}}\n{"ask":')
        answer = writer.read()
        assert answer["horizon"] == 7 and listener.read() == answer
        listener.send(b'{"ask": "state"}\n')
        assert "somebody else is writing" in listener.read()["error"]["message"]
        writer.send(b' "state"}\n' + b"x" * (2 << 20) + b"\n")
        assert writer.read()["state"]["waiting"] == [["c1"]]
        assert "longer than" in writer.read()["error"]["message"]
        writer.socket.shutdown(socket.SHUT_WR)
        assert writer.read() is None, "it has said all and was told all"
        assert [listener.read()["line"] for _ in range(2)] == [2, 3]
        listener.send(b'{"ask": "state"}\n')
        assert listener.read()["line"] == 2, "now the other one may write"
    finally:
        process.terminate()
        assert process.wait(30) == 143
    assert not os.path.exists(path)


def test_web_pages_and_taken_addresses_are_turned_away(tmp_path: Path) -> None:
    path = str(tmp_path / "loop.sock")
    process, place = listening("--listen", path)
    try:
        page = Client(place)
        page.send(b'POST / HTTP/1.0\r\n\r\n{"observe": {"enter": ["c1"]}}\n')
        assert "no web server" in page.read()["error"]["message"]
        assert page.read() is None
        again = waiter("serve", "--layout", "report", "--listen", path)
        assert again.code == 2 and "somebody listens there already" in again.err
        client = Client(place)
        client.send(b'{"ask": "state"}\n')
        assert "waiting" not in client.read()["state"]
    finally:
        process.kill()
        process.wait(30)
    assert os.path.exists(path), "killed: the socket was left behind"
    process, _ = listening("--listen", path)
    process.terminate()
    assert process.wait(30) == 143


# -- the rest ---------------------------------------------------------------------------------


def test_percentiles() -> None:
    latencies = Latencies()
    assert latencies.summary() == {"count": 0}
    for value in range(1, 101):
        latencies.add(float(value))
    assert latencies.summary() == {
        "count": 100,
        "p50_ms": 50.0,
        "p95_ms": 95.0,
        "p99_ms": 99.0,
        "max_ms": 100.0,
    }


def test_searches_are_counted(report: Layout) -> None:
    scenario = read_scenario("observe: [{enter: [c1]}]", "s", report)
    live = Live(report, scenario)
    first = live.tell({"ask": "stats"})["stats"]
    assert (first["revision"], first["searches"], first["deadlines"]) == (1, 1, 0)
    live.tell({"done": 0})
    assert live.tell({"ask": "stats"})["stats"]["searches"] == 1
    live.seen({"enter": ["c2"]})
    assert live.tell({"ask": "stats"})["stats"]["searches"] == 2


# -- paths that are blocked -------------------------------------------------------------------


def test_a_blocked_path_is_planned_without(live: Live) -> None:
    assert live.seen({"enter": ["c1"]})["horizon"] == 7
    shut = live.tell({"block": ["n5", "n4"]})
    assert shut["status"] == "no_plan" and shut["plan"] == []
    assert "n4-n5 is blocked already" in live.tell({"block": ["n4", "n5"]})["error"]["message"]
    assert live.tell({"clear": ["n4", "n5"]})["horizon"] == 7
    assert "is not blocked" in live.tell({"clear": ["n4", "n5"]})["error"]["message"]
    assert live.tell({"block": ["n1", "n7"]})["error"] == {
        "message": "there is no path n1-n7",
        "hint": "paths there: n1-n2, n4-n7",
    }
    assert live.tell({"block": ["n4", "n55"]})["error"]["hint"] == "did you mean n5?"
    for wrong in ("n4", ["n4"], ["n4", 5], None):
        assert "two ends of a path" in live.tell({"block": wrong})["error"]["message"]


def test_a_blocked_path_outlives_the_process(tmp_path: Path) -> None:
    journal = tmp_path / "evening.journal"
    lines = [{"observe": {"enter": ["c1"]}}, {"block": ["n4", "n5"]}]
    text = "".join(json.dumps(line) + "\n" for line in lines)
    waiter("serve", "--layout", "report", "--journal", str(journal), stdin=text)
    again = '{"ask": "plan"}\n{"clear": ["n4", "n5"]}\n'
    for options in ((), ("--compact",)):
        done = waiter(
            "serve", "--layout", "report", "--journal", str(journal), *options, stdin=again
        )
        _, asked, cleared = map(json.loads, done.out.splitlines())
        assert asked["status"] == "no_plan" and cleared["horizon"] == 7
        waiter(
            "serve", "--layout", "report", "--journal", str(journal),
            stdin='{"block": ["n4", "n5"]}\n',
        )  # fmt: skip
