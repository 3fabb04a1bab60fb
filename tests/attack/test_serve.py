"""The live loop under attack: floods, hang-ups, browsers, and lines that cost too much."""

from __future__ import annotations

import json
import os
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support.cli import Ran, waiter
from tests.support.lunch import Lunch
from tests.support.sampling import mostly_slow
from tests.support.serving import Listening, Live, Pipe
from waiter_cli.files.layout_reader import read_layout_file
from waiter_cli.model.layout import Layout
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.sockets import _Hall

pytestmark = pytest.mark.attack

ASK = b'{"ask": "state"}\n'


@pytest.fixture(params=["port", "path"])
def address(request: Any, tmp_path: Path) -> str:
    """Where to listen: a port, or a path."""
    return "127.0.0.1:0" if request.param == "port" else str(tmp_path / "s")


# -- whoever connects ---------------------------------------------------------------------------


@pytest.mark.parametrize("times", mostly_slow([300, 1000], 300))
def test_who_hangs_up_without_a_line_is_removed(address: str, times: int) -> None:
    with Listening(address) as loop:
        listener = loop.client()
        for _ in range(times):
            loop.client().close()
        client = loop.client()
        client.send(ASK)
        assert client.read()["line"] == 1
        assert "state" in listener.read(), "nobody had to make room"
    assert loop.code == 143


@pytest.mark.wide
def test_who_is_silent_or_half_closed_makes_room(address: str) -> None:
    with Listening(address) as loop:
        writer = loop.client()
        writer.send(ASK)
        assert writer.read()["line"] == 1
        silent = [loop.client() for _ in range(300)]
        for each in silent[200:]:
            each.socket.shutdown(socket.SHUT_WR)
        late = loop.client()
        late.send(ASK)
        assert "somebody else is writing" in late.read()["error"]["message"]
        writer.send(ASK)
        assert writer.read()["line"] == 2, "the writer stays"
        assert "silent longest" in silent[0].read()["error"]["message"]
        assert silent[0].read() is None


@pytest.mark.parametrize(
    "data",
    [
        *(
            f"{method} / HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()
            for method in ("GET", "POST", "PUT", "HEAD", "OPTIONS", "PATCH", "DELETE", "CONNECT")
        ),
        b"PROPFIND /x HTTP/1.1\r\n",
        b"M-SEARCH * HTTP/1.1\r\n",
        b"get / http/1.0\r\n",
        b"\r\n\r\nBREW /pot HTCPCP/1.0\r\n",
        b"GET /\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",  # the beginning of TLS
        b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
        b"SSH-2.0-client\r\n",
        b"Host: localhost\r\n",
        b'"\n',
        b"[\n",
        b"\x00",
    ],
)
def test_no_event_gets_in_from_a_web_page(data: bytes, loop: Listening) -> None:
    event = b'{"observe": {"enter": ["c1"]}}\n' * 3
    for pieces in ([data + event], [data[:1], data[1:], event]):
        page = loop.client()
        for piece in pieces:
            try:
                page.send(piece)
            except OSError:
                break
        refusal = page.read()
        assert "no web server" in refusal["error"]["message"]
        assert page.read() is None
    assert "waiting" not in state_of(loop)


@pytest.fixture(scope="module")
def loop(tmp_path_factory: Any) -> Any:
    """One loop for many strangers."""
    with Listening("127.0.0.1:0") as running:
        yield running


@pytest.mark.parametrize(
    "line", [b"GET / HTTP/1.1", b"Origin: https://example.org", b"  host : x", b"a b HTTP/1.1"]
)
def test_http_behind_a_line_of_ours_ends_the_connection(line: bytes, loop: Listening) -> None:
    page = loop.client()
    page.send(b"\n" + ASK + line + b'\r\n\r\n{"observe": {"enter": ["c1"]}}\n')
    answers = iter(page.read, None)
    assert any("no web server" in each.get("error", {}).get("message", "") for each in answers)
    assert "waiting" not in state_of(loop)


def state_of(loop: Listening) -> Any:
    """What the loop believes; answers to others are told, too, and others may still be writing."""
    client = loop.client()
    while True:
        client.send(ASK)
        answer = client.read()
        if "state" in answer:
            client.close()
            return answer["state"]


# -- floods -------------------------------------------------------------------------------------


@pytest.mark.wide
@pytest.mark.parametrize(
    ("short", "long", "listens"),
    [
        (8_000, 10, False),
        (8_000, 10, True),
        pytest.param(100_000, 40, False, marks=pytest.mark.slow),
        pytest.param(100_000, 40, True, marks=pytest.mark.slow),
    ],
)
def test_a_flood_of_short_and_long_lines_stops_nothing(
    short: int, long: int, listens: bool
) -> None:
    """Neither the sockets' thread nor the loop waits for the other; the first SIGTERM ends it."""
    with Listening("127.0.0.1:0") as loop:
        client = loop.client()
        answers: list[Any] = []
        reader = threading.Thread(target=lambda: answers.extend(iter(client.read, None)))
        flood = b'{"observe": {"enter": ["c1"]}}\n' + b"{}\n" * short
        flood += (b"x" * (1 << 20) + b"\n") * long
        if listens:
            reader.start()
        try:
            client.send(flood)
            client.socket.shutdown(socket.SHUT_WR)
        except OSError:
            assert not listens, "dropped, though it listened"
        if listens:
            reader.join(120)
            assert [each["line"] for each in answers] == list(range(1, 2 + short + long))
            other = loop.client()
            other.send(ASK)
            assert other.read()["state"]["waiting"] == [["c1"]]
        assert loop.peak() < 120
        begun = time.monotonic()
    assert loop.code == 143 and time.monotonic() - begun < 5


def test_the_loop_never_waits_for_the_thread_of_the_sockets() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        hall = _Hall(server, "{}")  # nobody runs its thread

        def tell() -> None:
            for number in range(5_000):
                hall.tell(str(number))
            hall.stop()

        loop = threading.Thread(target=tell, daemon=True)
        loop.start()
        loop.join(20)
        assert not loop.is_alive()


@pytest.mark.wide
@pytest.mark.parametrize("megabytes", mostly_slow([1, 8], 1))
def test_empty_lines_are_counted_with_what_they_cost(megabytes: int) -> None:
    with Listening("127.0.0.1:0") as loop:
        client = loop.client()
        before = loop.peak()

        def send() -> None:
            with suppress(OSError):
                client.send(b"\n" * (megabytes << 20))

        threading.Thread(target=send, daemon=True).start()
        time.sleep(min(3.0, megabytes))
        assert loop.peak() - before < 40
        client.close()


@pytest.mark.wide
def test_empty_lines_over_a_pipe() -> None:
    loop = Pipe("--layout", "report")
    text = Path(f"/proc/{loop.process.pid}/status")

    def peak() -> int:
        return int(text.read_text().partition("VmHWM:")[2].split()[0]) // 1024

    before = peak()

    def send() -> None:
        with suppress(OSError):
            loop.send(b"\n" * (1 << 19))

    threading.Thread(target=send, daemon=True).start()
    for _ in range(1 << 15):
        answer = loop.read()
    assert answer["error"]["message"] == "the line is empty"
    assert peak() - before < 40
    loop.process.kill()
    loop.process.wait()


# -- lines --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def report() -> Layout:
    return read_layout_file("report")


@pytest.fixture
def live(report: Layout) -> Live:
    """A loop in this process."""
    return Live(report)


ENTER = '{"observe": {"enter": ["c1"]}}'
SERVE = '{"goal": {"serve": "c1"}}'


@pytest.mark.parametrize(
    ("line", "meant"),
    [
        ('{"enter": ["c1"]}', ENTER),
        ('{"Observe": {"enter": ["c1"]}}', ENTER),
        ('{"observ": {"enter": ["c1"]}}', ENTER),
        ("{'observe': {'enter': ['c1']}}", ENTER),
        ("{observe: {enter: [c1]}}", ENTER),
        ("('observe', {'enter': ('c1',)})", ENTER),
        ('["observe", {"enter": ["c1"]}]', ENTER),
        ('[{"observe": {"enter": ["c1"]}}]', ENTER),
        ('{"observe": {"observe": {"enter": ["c1"]}}}', ENTER),
        ('{"observe": ["enter", "c1"]}', '{"observe": {"enter": "c1"}}'),
        ('{"type": "enter", "party": ["c1"]}', ENTER),
        ('{"observe": {"enter": ["c1"]}', ENTER),
        ('{"observe": {"enter": ["c1"]},}', ENTER),
        ("enter c1", ENTER),
        ("c1 enters", ENTER),
        ('[{"enter": ["c1"]}, {"bill": "table1"}]',
         '{"observe": [{"enter": ["c1"]}, {"bill": "table1"}]}'),
        ('{"bill": "tabel1"}', '{"observe": {"bill": "tabel1"}}'),
        ('{"bill": "table1", "id": 7}', '{"observe": {"bill": "table1"}, "id": 7}'),
        ('{"serve": "c1"}', SERVE),
        ('{"paid": "table1"}', '{"goal": {"paid": "table1"}}'),
        ('{"at": "n4"}', '{"goal": {"at": "n4"}}'),
        ('{"at": {"w1": "n3"}}', '{"observe": {"at": {"w1": "n3"}}}'),
        ('{"goal": "serve c1"}', SERVE),
        ('{"goal": ["serve", "c1"]}', SERVE),
        ('{"goal": [{"serve": "c1"}]}', SERVE),
        ('{"goals": [{"serve": "c1"}]}', SERVE),
        ('{"done": "0"}', '{"done": 0}'),
        ('{"done": "zero"}', '{"done": 0}'),
        ('{"done": [0]}', '{"done": 0}'),
        ('{"done": 0.0}', '{"done": 0}'),
        ('{"done": {"step": 0}}', '{"done": 0}'),
        ("{'done': 0, 'x': None}", '{"done": 0}'),
        ('"{\\"done\\": 0}"', '{"done": 0}'),
        ('{"done": 0} {"done": 1}', '{"done": 0}'),
        ("done: 0", '{"done": 0}'),
        ("4", '{"done": 4}'),
        ("state", '{"ask": "state"}'),
        ('{"state": true}', '{"ask": "state"}'),
        ('{"ask": ["state"]}', '{"ask": "state"}'),
    ],
)  # fmt: skip
def test_the_hint_of_a_misshapen_line_is_the_right_line(live: Live, line: str, meant: str) -> None:
    answer = live.tell(line.encode())
    assert answer["error"]["hint"] == f"write {meant}"
    assert json.dumps(answer["error"]["meant"]) == meant
    assert live.session.executive.step == 0 and not live.session.executive.goals


HUGE = "9" * 10_000
DEEP = "[" * 50_000


@pytest.mark.parametrize(
    "value",
    ["1e400", "1E999", "-1e400", HUGE, "-" + HUGE, HUGE + ".5", "NaN", "Infinity", "-Infinity",
     '"\\ud800"', '"\\uDFFFx"', '{"a": 1, "a": 2}', DEEP, '{"a":' * 50_000, "0x10", "01", "1_0"],
    ids=range(17),
)  # fmt: skip
@pytest.mark.parametrize(
    "line",
    ['{"ask": "state", "id": %s}', '{"observe": {"enter": ["c1"]}, "id": %s}', '{"done": %s}',
     '{"failed": 0, "reason": %s}', '{"observe": {"enter": [%s]}}', '{"goal": {"chairs": %s}}',
     "%s"],
)  # fmt: skip
def test_an_answer_is_json_whatever_comes(live: Live, line: str, value: str) -> None:
    number = ReceivedLine(1, (line % value).encode(), time.perf_counter())
    text = live.session.handle(number)

    def never(name: str) -> None:
        raise AssertionError(name)

    answer = json.loads(text, parse_constant=never)
    assert set(answer) <= {"line", "id", "error"} and "\\ud" not in text.lower()
    assert len(text) < 1000


@pytest.mark.parametrize(
    "seen",
    [
        {"enter": [f"g{n}" for n in range(60_000)]},
        [{"enter": [f"g{n}"]} for n in range(5_000)],
        [{"bill": "table1"}] * 40_000,
    ],
    ids=["guests", "parties", "bills"],
)
def test_one_line_is_bounded(report: Layout, seen: Any) -> None:
    live = Live(report, time_limit=0.4)
    begun = time.perf_counter()
    assert "observed at once" in live.tell({"observe": seen})["error"]["message"]
    assert time.perf_counter() - begun < 4


def test_many_lines_are_bounded_too(report: Layout) -> None:
    live = Live(report, time_limit=0.4)
    for block in range(3):
        begun = time.perf_counter()
        answer = live.seen(*({"enter": [f"g{block}_{n}"]} for n in range(200)))
        assert time.perf_counter() - begun < 4
    assert "guests would be inside" in answer["error"]["message"]
    assert len(live.session.executive.state.waiting) == 400


# -- the journal --------------------------------------------------------------------------------


def steps(count: int, fresh: bool = True) -> list[dict[str, Any]]:
    """Lines that can all be believed: guests come and go, each with a name of his own."""
    found: list[dict[str, Any]] = []
    for number in range(count):
        who = f"g{number // 2}" if fresh else "g"
        found.append({"observe": {"leave" if number % 2 else "enter": [who]}})
    return found


def journal(path: Path, lines: list[dict[str, Any]], *more: str) -> tuple[list[Any], Ran]:
    """The answers of a run with a journal, and the run."""
    text = "\n".join(map(json.dumps, lines))
    ran = waiter("serve", "--layout", "report", "--journal", str(path), *more, stdin=text)
    return [json.loads(line) for line in ran.out.splitlines()[1:]], ran


QUESTIONS: list[dict[str, Any]] = [{"ask": ask} for ask in ("state", "plan", "why")]


@pytest.mark.wide
def test_a_start_from_a_snapshot_is_as_one_from_the_beginning(tmp_path: Path) -> None:
    path, plain = tmp_path / "j", tmp_path / "plain"
    lines = [{"observe": {"at": {"w1": "n4"}}}, *steps(255)]
    journal(path, lines)
    records = [json.loads(line) for line in path.read_text().splitlines()]
    assert [n for n, record in enumerate(records) if "snapshot" in record] == [100, 200]
    for record in records:
        record.pop("crc", None)
        record.pop("snapshot", None)
    plain.write_text("".join(json.dumps(record) + "\n" for record in records))
    from_snapshot, _ = journal(path, QUESTIONS)
    from_start, _ = journal(plain, QUESTIONS)
    assert from_snapshot == from_start
    assert "snapshot" in plain.read_text(), "the old journal has one now"
    again, ran = journal(plain, QUESTIONS)
    assert again == from_start and ran.code == 0
    assert waiter("serve", "--replay", str(path)).code == 0
    assert waiter("serve", "--replay", str(plain)).code == 0


@pytest.mark.wide
def test_damage_before_the_last_snapshot_is_found(tmp_path: Path) -> None:
    path = tmp_path / "j"
    journal(path, steps(130))
    whole = path.read_bytes().splitlines(keepends=True)
    for number, change, said in [
        (50, lambda line: line[:40] + b"!" + line[41:], ":50:1:"),
        (
            50,
            lambda line: line.replace(b"g24", b"g99"),
            ":1:1: error: a line from here to line 100",
        ),
        (50, lambda line: b"", ":50:1: error: record 49 is missing"),
        (101, lambda line: line.replace(b'"agent": "n', b'"agent": "x'), ":101:1:"),
        (101, lambda line: line.replace(b'"step"', b'"steq"'), ":101:1:"),
    ]:
        lines = [*whole]
        lines[number - 1] = change(lines[number - 1])
        path.write_bytes(b"".join(lines))
        _, ran = journal(path, [])
        assert ran.code == 2 and said in ran.err, (number, ran.err)
        assert path.read_bytes() == b"".join(lines)


@pytest.mark.parametrize("line", [1, 2, 3])
def test_a_finished_line_that_is_damaged_is_a_fault(tmp_path: Path, line: int) -> None:
    path = tmp_path / "j"
    journal(path, steps(2))
    whole = path.read_bytes().splitlines(keepends=True)[:line]
    for damaged in (
        b'{"journal": "waiter.journal/1"\n',
        b'{"journal": "waiter.journal/1", }\n',
        b"\0\n",
    ):
        path.write_bytes(b"".join([*whole[:-1], damaged]))
        before = path.read_bytes()
        for ran in (journal(path, [])[1], waiter("serve", "--replay", str(path))):
            assert ran.code == 2 and f"{path}:{line}:1:" in ran.err, ran.err
        assert path.read_bytes() == before


@pytest.mark.wide
@pytest.mark.parametrize("every", mostly_slow([3, 1], 3))
def test_a_damaged_first_line_is_a_clear_fault(every: int, tmp_path: Path) -> None:
    path = tmp_path / "j"
    journal(path, [{"observe": {"enter": ["c1"]}}])
    first, *rest = path.read_text().splitlines(keepends=True)
    header = json.loads(first)
    cases: list[dict[str, Any]] = [{**header, key: value} for key in ("layout", "start")
                                   for value in (None, 3, [], {}, "x")]  # fmt: skip
    for key in header["start"]:
        values = ("n99", -1, [["x"]], {"a": 1}, 1e300, None, [[{"serve": "c1"}]])
        cases += [{**header, "start": {**header["start"], key: value}} for value in values]
    cases += [
        {**header, "layout": {**header["layout"], "text": text}} for text in ("", "[", "name: x")
    ]
    for key, value in [("agent", "n99"), ("agent", 3), ("waiters", [["w1", "n99"]]), ("paid", ["t9"]),
                       ("seated", [["t9", ["c1"]]]), ("seated", [["table1", [3]]]), ("chairs", [["table1", "x"]]),
                       ("carrying", ["t9", "plate"]), ("waiting", [[7]]), ("waiting", ["ab"])]:  # fmt: skip
        state = {**header["start"]["state"], key: value}
        cases.append({**header, "start": {**header["start"], "state": state}})
    texts = [json.dumps(case) for case in cases]
    impossible = texts[-10:]
    texts += [
        first.strip().replace('"step": 0', f'"step": {value}') for value in ("1e999", "-1", "[")
    ]
    assert texts[-1] != first.strip()
    for case in texts[::every]:
        path.write_text(case + "\n" + "".join(rest))
        for ran in (waiter("serve", "--layout", "report", "--journal", str(path)),
                    waiter("serve", "--replay", str(path))):  # fmt: skip
            assert ran.code in ((2,) if case in impossible else (0, 2, 3)), (case, ran.err)
            assert "Traceback" not in ran.err and "internal" not in ran.err, (case, ran.err)


def test_compaction_overwrites_nothing_and_keeps_one_journal(tmp_path: Path) -> None:
    real, link = tmp_path / "real" / "j", tmp_path / "link"
    real.parent.mkdir()
    link.symlink_to(real)
    victim = tmp_path / "victim"
    victim.write_text("mine")
    for beside in (tmp_path / "link.new", real.with_name("j.new")):
        beside.symlink_to(victim)
    journal(link, steps(5))
    before, _ = journal(link, QUESTIONS)
    after, ran = journal(link, QUESTIONS, "--compact")
    assert ran.code == 0 and after == before
    assert victim.read_text() == "mine" and link.is_symlink() and not real.is_symlink()
    assert len(real.read_text().splitlines()) == 1
    assert sorted(os.listdir(real.parent)) == ["j", "j.new"]
    os.link(real, tmp_path / "second")
    _, ran = journal(link, [], "--compact")
    assert ran.code == 2 and "other names" in ran.err
    _, ran = journal(tmp_path / "second", [{"ask": "state"}])
    assert ran.code == 0, "it may still be written"


@pytest.mark.slow
def test_twenty_thousand_events_take_no_more_memory_than_a_few(tmp_path: Path) -> None:
    """Memory stays, no event waits long, and the restart is short."""
    path = tmp_path / "j"
    loop = Pipe("--layout", "report_large", "--journal", str(path))
    text = Path(f"/proc/{loop.process.pid}/status")
    lunch = Lunch(read_layout_file("report_large"), 1)
    plan: list[dict[str, Any]] = []
    took = []
    for _ in range(20_000):
        line = lunch.next_line(plan)
        begun = time.perf_counter()
        answer = loop.tell(line)
        took.append(time.perf_counter() - begun)
        assert "error" not in answer, (line, answer)
        plan = answer["plan"]
    state = loop.tell({"ask": "state"})["state"]
    peak = int(text.read_text().partition("VmHWM:")[2].split()[0]) // 1024
    loop.process.kill()
    loop.process.communicate()
    begun = time.perf_counter()
    again = Pipe("--layout", "report_large", "--journal", str(path))
    restart = time.perf_counter() - begun
    assert again.tell({"ask": "state"})["state"] == state
    assert again.end()[0] == 0
    print(f"peak {peak} MB, longest {max(took):.2f} s, restart {restart:.2f} s")
    assert peak <= 60 and max(took) < 1.5 and restart < 2
