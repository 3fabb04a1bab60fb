"""The live loop under attack: floods, hang-ups, browsers, and lines that cost too much."""

from __future__ import annotations

import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.support.sampling import mostly_slow
from tests.support.serving import Listening, Pipe

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
        assert listener.read()["line"] == 1, "nobody had to make room"
    assert loop.code == 143


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
    client = loop.client()
    client.send(ASK)
    assert "waiting" not in client.read()["state"]
    client.close()


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
    client = loop.client()
    client.send(ASK)
    assert "waiting" not in client.read()["state"]
    client.close()


# -- floods -------------------------------------------------------------------------------------


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
