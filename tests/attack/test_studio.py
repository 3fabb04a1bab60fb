"""The studio under attack: other pages, other names, other paths, floods, a second tab."""

from __future__ import annotations

import json
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast
from urllib.parse import unquote

import pytest

from tests.support.browsing import (
    Lines,
    RunningStudio,
    browser,
    cookie_of,
    expect,
    get,
    needs_browser,
    needs_studio,
    opened_page,
    running_studio,
)
from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide

pytestmark = [pytest.mark.attack, needs_studio]


@pytest.fixture(scope="module")
def studio() -> Iterator[RunningStudio]:
    with running_studio() as found:
        yield found


@pytest.fixture(scope="module")
def cookie(studio: RunningStudio) -> str:
    return cookie_of(studio)


# -- where it listens ---------------------------------------------------------------------------


def test_only_this_machine_is_listened_to(studio: RunningStudio) -> None:
    with socket.socket() as other, pytest.raises(OSError):
        other.settimeout(1)
        other.connect(("127.0.0.2", studio.port))


def test_another_host_cannot_be_asked_for() -> None:
    for words in (["--host", "0.0.0.0"], ["--port", "0.0.0.0:80"], ["--listen", "0.0.0.0:80"]):
        assert waiter("studio", "--no-open", *words).code == 2


# -- other names and other pages ----------------------------------------------------------------


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1", "127.0.0.1:1", "[::1]:{port}", ""]
)
@pytest.mark.parametrize("path", ["/", "/healthz", "/page/main.js", "/start.js"])
def test_rebinding(studio: RunningStudio, cookie: str, host: str, path: str) -> None:
    """A name that was made to lead here is no name of ours, whatever cookie comes with it."""
    status, _, body = get(studio, path, cookie=cookie, Host=host.format(port=studio.port))
    assert status in (400, 421) and b"script" not in body


def test_a_second_host_header(studio: RunningStudio) -> None:
    with socket.create_connection(("127.0.0.1", studio.port), 5) as raw:
        raw.sendall(
            f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{studio.port}\r\nHost: evil\r\n\r\n".encode()
        )
        assert raw.recv(100).split()[1] in (b"400", b"421")


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1", None])
def test_a_post_of_another_page(studio: RunningStudio, cookie: str, origin: str | None) -> None:
    connection = HTTPConnection("127.0.0.1", studio.port, timeout=5)
    headers = {"Cookie": cookie, "Content-Type": "application/json"}
    headers |= {} if origin is None else {"Origin": origin}
    for path in ("/do/room", "/token"):
        connection.request("POST", path, json.dumps({"token": studio.token}), headers)
        answer = connection.getresponse()
        answer.read()
        assert answer.status == 403
        assert answer.getheader("set-cookie") is None
        assert answer.getheader("access-control-allow-origin") is None


@pytest.mark.parametrize(
    "kind", ["application/x-www-form-urlencoded", "text/plain", "multipart/form-data; boundary=x"]
)
def test_a_form_is_no_json(studio: RunningStudio, cookie: str, kind: str) -> None:
    """What a form of another page can send without asking first is refused."""
    assert get(studio, "/do/room", {}, cookie, **{"Content-Type": kind})[0] == 415


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1", None])
def test_a_socket_of_another_page(studio: RunningStudio, cookie: str, origin: str | None) -> None:
    from websockets.exceptions import InvalidStatus

    with pytest.raises(InvalidStatus) as refused, Lines(studio, cookie=cookie, origin=origin):
        pass
    assert refused.value.response.status_code == 403


def test_a_socket_without_the_cookie(studio: RunningStudio) -> None:
    from websockets.exceptions import InvalidStatus

    with pytest.raises(InvalidStatus), Lines(studio, cookie="studio=x"):
        pass


def test_a_token_is_not_guessed(studio: RunningStudio) -> None:
    for token in ("", "x", studio.token[:-1], studio.token + "x", None, 5, ["x"], "ä" * 9):
        assert get(studio, "/token", {"token": token})[0] == 403
    assert get(studio, "/page/main.js", cookie=f"studio{studio.port}=guessed")[0] == 401


def test_a_token_is_traded_once(studio: RunningStudio, cookie: str) -> None:
    """Whoever finds the address later, in a history or a list of processes, gets nothing for it."""
    for known in ("", cookie):
        status, headers, body = get(studio, "/token", {"token": studio.token}, known)
        assert status == 403 and "set-cookie" not in headers
        told = json.loads(body)["error"]
        assert "opened before" in told["message"] and "start it again" in told["hint"]
    assert get(studio, "/page/main.js", cookie=cookie)[0] == 200


def test_the_cookie_outlives_the_browser_and_is_given_to_nobody_else(
    studio: RunningStudio, cookie: str
) -> None:
    again = get(studio, "/", cookie=cookie)[1]["set-cookie"]
    assert again.startswith(cookie) and "Max-Age=86400" in again and "HttpOnly" in again
    for stranger in ("", f"studio{studio.port}=x", "studio1=" + cookie.partition("=")[2]):
        assert "set-cookie" not in get(studio, "/", cookie=stranger)[1]


# -- paths and bodies ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "path",
    [
        "/page/../server.py", "/page/..%2fserver.py", "/page/%2e%2e/server.py", "/page//etc/passwd",
        "/page/..\\server.py", "/keep/../../README.md", "/keep/%2fetc%2fpasswd", "/start.js/../x",
        "/page/main.js%00.html", "/static/x", "/.git/config",
    ],
)  # fmt: skip
def test_no_path_leads_to_a_file(studio: RunningStudio, cookie: str, path: str) -> None:
    status, _, body = get(studio, path, cookie=cookie)
    assert status == 404 and b"import" not in body and b"root:" not in body


OUTSIDE = ("../server.py", "..%2fserver.py", "/etc/passwd", "a/../main.js")


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_file_is_looked_up_and_never_opened(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """This alone would do: whatever name a route lets through is none of the page's files."""
    from waiter_cli.studio import server
    from waiter_cli.studio.page_files import page_files

    def opens(*_: object, **__: object) -> bytes:
        raise AssertionError("a file was opened")

    assert "main.js" in page_files()
    for reads in ("open", "read_bytes", "read_text"):
        monkeypatch.setattr(Path, reads, opens)
    monkeypatch.setattr("builtins.open", opens)
    assert server._file(name).status_code == 404


@pytest.mark.parametrize("folder", ["page", "keep", "do"])
@pytest.mark.parametrize("name", OUTSIDE)
def test_no_route_takes_a_name_with_a_folder(folder: str, name: str) -> None:
    """This alone would do, too: what a route hands on has no folder in it."""

    from starlette.routing import Match

    from waiter_cli.studio.gate import Keys
    from waiter_cli.studio.server import make_app

    nothing = cast(Any, SimpleNamespace(serve=None))
    app = cast(Any, make_app(nothing, 1, Keys(1), nothing)._app)
    scope = {"type": "http", "method": "GET", "path": f"/{folder}/{unquote(name)}"}
    assert all(route.matches(scope)[0] is Match.NONE for route in app.routes)
    scope["path"] = f"/{folder}/main.js"
    assert any(route.matches(scope)[0] is not Match.NONE for route in app.routes)


def test_a_body_that_is_too_long(studio: RunningStudio, cookie: str) -> None:
    assert get(studio, "/do/room", {"x": "a" * (1 << 20)}, cookie)[0] == 413
    with socket.create_connection(("127.0.0.1", studio.port), 5) as raw:
        host = f"127.0.0.1:{studio.port}"
        raw.sendall(
            f"POST /do/room HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nCookie: {cookie}\r\n"
            "Content-Type: application/json\r\nContent-Length: 100000000\r\n\r\n".encode()
        )
        try:
            for _ in range(40):
                raw.sendall(b"a" * (1 << 16))
        except OSError:
            pass
        assert raw.recv(100).split()[1] == b"413"


@pytest.mark.parametrize("body", [b"", b"[]", b"{", b"\xff", b'"x"', b"[" * 20_000])
def test_a_body_that_is_no_object(studio: RunningStudio, cookie: str, body: bytes) -> None:
    connection = HTTPConnection("127.0.0.1", studio.port, timeout=5)
    origin = f"http://127.0.0.1:{studio.port}"
    headers = {"Cookie": cookie, "Content-Type": "application/json", "Origin": origin}
    connection.request("POST", "/do/past", body, headers)
    answer = connection.getresponse()
    assert answer.status == 400 and "error" in json.loads(answer.read())


# -- lines --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "line",
    [
        "", "x", "[]", '{"play": 1}', '{"speed": 1e999}', '{"speed": true}', '{"speed": 0}',
        '{"step": -1}', '{"step": 99999999999999999999}', '{"guests": 51}', '{"guests": "4"}',
        '{"seat": {"party": "c1"}}', '{"seat": {"party": [], "table": {}}}',
        '{"play": true, "speed": 2}', '{"done": 0}', '{"started": 0}', '{"failed": 99999}',
        '{"observe": {"enter": ["<b>"]}}', '{"block": ["n1", "__proto__"]}', b"\xff\xfe", b"GET / HTTP/1.1",
        '{"observe": {"at": {"w1": "n1"}}}', '{"observe": {"free": "table9"}}', "[" * 5000,
    ],
)  # fmt: skip
def test_a_line_that_cannot_be_changes_nothing(
    studio: RunningStudio, cookie: str, line: str | bytes
) -> None:
    with Lines(studio, cookie=cookie) as lines:
        before = lines.tell({"ask": "state"})
        told = lines.tell(line)
        assert told["error"]["message"], told
        after = lines.tell({"ask": "state"})
    assert after["state"] == before["state"]


@pytest.mark.wide
def test_what_the_world_and_the_robot_know_is_not_talked_away() -> None:
    """Nobody reports the robot's steps for it, and who sits there sits there."""
    with running_studio("--speed", "60") as studio, Lines(studio) as lines:
        lines.tell({"guests": 1})
        lines.until(7)
        lines.until(0)
        assert "sits at table1" in lines.tell({"observe": {"free": "table1"}})["error"]["message"]
        lines.tell({"play": False})
        lines.tell({"observe": {"bill": "table1"}})
        step = lines.tell({"ask": "state"})["step"]
        told = lines.tell({"done": step})
        assert "the robot itself" in told["error"]["message"]
        assert lines.tell({"ask": "state"})["step"] == step


def test_a_frame_of_a_hundred_megabytes(studio: RunningStudio, cookie: str) -> None:
    from websockets.exceptions import ConnectionClosed

    before = peak(studio)
    with Lines(studio, cookie=cookie) as lines:
        with pytest.raises(ConnectionClosed):
            lines.socket.send("x" * 100_000_000)
            hear_to_the_end(lines)
    assert get(studio, "/healthz")[0] == 200
    assert peak(studio) - before < 20 << 20, "what was sent was kept"


MEBIBYTE = 1 << 20


@pytest.mark.parametrize("size", [MEBIBYTE + 1, 100_000_000, (1 << 63) - 1])
def test_the_head_of_a_long_frame_ends_the_connection(
    studio: RunningStudio, cookie: str, size: int
) -> None:
    """The limit is ours (that of the library's own is sixteen times as high), and nothing is read first."""
    with Lines(studio, cookie=cookie) as lines:
        lines.socket.socket.sendall(b"\x81\xff" + size.to_bytes(8, "big") + bytes(4))
        assert closing_code(lines) == 1009


def test_a_message_in_many_frames_is_as_long_as_all_of_them(
    studio: RunningStudio, cookie: str
) -> None:
    with Lines(studio, cookie=cookie) as lines:
        told = lines.tell(json.dumps({"ask": "state", "id": "x" * 1_000_000}))
        assert told["state"]
        part = b"\xff" + (1 << 16).to_bytes(8, "big") + bytes(4) + b"x" * (1 << 16)
        lines.socket.socket.sendall(b"\x01" + part + 16 * (b"\x00" + part))
        assert closing_code(lines) == 1009


def test_no_frame_is_unpacked(studio: RunningStudio, cookie: str) -> None:
    """A small frame that unpacks to a large one would pass the limit of its size."""
    with Lines(studio, cookie=cookie, compression="deflate") as lines:
        assert lines.socket.protocol.extensions == []


def hear_to_the_end(lines: Lines, seconds: float = 5.0) -> None:
    """Reads what the studio says until it ends the connection; fails where it does not."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        lines.said()
    pytest.fail("the connection is still there")


def closing_code(lines: Lines) -> int | None:
    """The code with which the studio ends the connection."""
    from websockets.exceptions import ConnectionClosed

    with pytest.raises(ConnectionClosed) as closed:
        hear_to_the_end(lines)
    return None if closed.value.rcvd is None else closed.value.rcvd.code


def peak(studio: RunningStudio) -> int:
    """The most bytes that the studio has had in memory."""
    text = Path(f"/proc/{studio.process.pid}/status").read_text()
    return int(text.partition("VmHWM:")[2].split()[0]) << 10


def memory(studio: RunningStudio) -> int:
    """The bytes that the studio has in memory."""
    pages = Path(f"/proc/{studio.process.pid}/statm").read_text().split()[1]
    return int(pages) * 4096


def test_who_only_asks_is_not_told_to_others(studio: RunningStudio, cookie: str) -> None:
    with Lines(studio, cookie=cookie) as lines, Lines(studio, cookie=cookie) as other:
        other.tell({"ask": "state"})
        assert lines.tell({"speed": 2, "id": 7})["id"] == 7
        assert lines.tell({"guests": 1, "id": "x"})["id"] == "x"
        told = [each["from"] for each in [lines.said() for _ in range(5)] if "from" in each]
        assert told == []
        others = []
        while len(others) < 2:
            told_now = other.said()
            others += [told_now["line"]] if "from" in told_now else []
        assert others == [1, 2]


@pytest.mark.wide
def test_two_hundred_sockets(cookie: str, studio: RunningStudio) -> None:
    from websockets.exceptions import InvalidStatus

    held: list[Lines] = []
    refused = 0
    try:
        for _ in range(200):
            try:
                held.append(Lines(studio, cookie=cookie))
            except InvalidStatus:
                refused += 1
        assert len(held) == 32 and refused == 168
        assert "agent" in held[0].tell({"ask": "state"})["state"]
    finally:
        for lines in held:
            lines.__exit__()
    time.sleep(0.2)
    with Lines(studio, cookie=cookie) as lines:
        assert "state" in lines.tell({"ask": "state"})


def test_sockets_that_come_all_at_once(cookie: str, studio: RunningStudio) -> None:
    from concurrent.futures import ThreadPoolExecutor

    from websockets.exceptions import InvalidStatus

    def open_one(_: int) -> Lines | None:
        try:
            return Lines(studio, cookie=cookie)
        except InvalidStatus:
            return None

    with ThreadPoolExecutor(16) as pool:
        opened = list(pool.map(open_one, range(64)))
    held = [lines for lines in opened if lines is not None]
    try:
        assert len(held) <= 32
    finally:
        for lines in held:
            lines.__exit__()


def test_a_client_that_does_not_read_holds_nobody_up(studio: RunningStudio, cookie: str) -> None:
    line = json.dumps({"ask": "plan", "id": "x" * 200}).encode()
    with deaf_client(studio) as deaf, Lines(studio, cookie=cookie) as lines:
        for _ in range(300):
            deaf.sendall(masked(line))
        began = time.monotonic()
        lines.tell({"ask": "state"})
        assert time.monotonic() - began < 5


@pytest.mark.wide
def test_a_client_that_asks_and_never_reads_is_dropped() -> None:
    """What waits for it is kept in memory and takes a place, so there is an end to that."""
    line = json.dumps({"ask": "state", "id": "x" * 60_000}).encode()
    with running_studio() as studio, Lines(studio) as lines, deaf_client(studio) as deaf:
        before = memory(studio)
        deaf.settimeout(1)
        with pytest.raises(OSError):  # nothing more is taken from it
            for _ in range(1500):
                deaf.sendall(masked(line))
        assert memory(studio) - before < 40 << 20
        assert lines.tell({"ask": "state"})["state"]


@contextmanager
def deaf_client(studio: RunningStudio) -> Iterator[socket.socket]:
    """A WebSocket by hand that nobody reads from."""
    host = f"127.0.0.1:{studio.port}"
    with socket.create_connection(("127.0.0.1", studio.port), 5) as raw:
        raw.sendall(
            f"GET /live HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n"
            f"Cookie: {cookie_of(studio)}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
        )
        assert raw.recv(12).endswith(b"101")
        yield raw


def masked(data: bytes) -> bytes:
    """A text frame of a client, 126 bytes or more; the mask is zero."""
    assert 126 <= len(data) < 1 << 16
    return b"\x81\xfe" + len(data).to_bytes(2, "big") + bytes(4) + data


# -- markup and tabs ----------------------------------------------------------------------------


@needs_browser
@pytest.mark.browser
@pytest.mark.slow
def test_markup_in_what_a_person_says_is_text(tmp_path: Path) -> None:
    """A scenario's title, a reason, a message: nothing becomes an element."""
    evil = "<img src=x onerror=document.title='owned'>"
    scenario = tmp_path / "evil.yaml"
    scenario.write_text("name: evil\nlayout: report\nobserve: [{enter: [c1]}]\n")
    with running_studio("--scenario", str(scenario)) as studio, browser() as found:
        page = opened_page(found, studio)
        page.evaluate(
            """async text => {
              const { make } = await import('/page/build.js');
              document.querySelector('[aria-label=events]').append(make('p', {}, text));
            }""",
            evil,
        )
        with Lines(
            studio, cookie="; ".join(f"{c['name']}={c['value']}" for c in page.context.cookies())
        ) as lines:
            assert "error" in lines.tell({"observe": {"bill": evil}})
            assert "error" in lines.tell({"guests": evil})
        page.wait_for_timeout(300)
        assert page.locator("img").count() == 0
        assert "owned" not in page.title()
        inline = page.evaluate(
            """() => { const s = document.createElement('script'); s.textContent = "document.title='owned'";
               document.body.append(s); return document.title; }"""
        )
        assert "owned" not in inline  # the policy lets no inline script run


@needs_browser
@pytest.mark.browser
@pytest.mark.wide
def test_the_cookie_is_out_of_the_page_s_reach_and_the_token_gone() -> None:
    with running_studio() as studio, browser() as found:
        page = opened_page(found, studio)
        assert page.evaluate("document.cookie") == ""
        assert page.evaluate("location.hash") == ""
        stranger = found.new_context().new_page()
        stranger.goto(studio.url.partition("#")[0])
        expect(stranger.get_by_role("alert")).to_contain_text("that waiter studio printed")
        assert stranger.locator("svg").count() == 0


@needs_browser
@pytest.mark.browser
@pytest.mark.slow
def test_the_printed_address_opens_again_where_it_was_opened_and_nowhere_else(
    tmp_path: Path,
) -> None:
    """A reload, another tab and the next start of the browser have the cookie still."""
    with running_studio() as studio, browser() as found:
        page = opened_page(found, studio)
        page.reload()
        page.wait_for_selector('body[data-ready="true"]')
        second = page.context.new_page()
        second.goto(studio.url)
        second.wait_for_selector('body[data-ready="true"]')
        assert "#" not in second.url
        kept = tmp_path / "browser.json"
        page.context.storage_state(path=kept)
        assert all(each["expires"] > time.time() for each in page.context.cookies())
        page.context.close()
        later = found.new_context(storage_state=kept).new_page()
        later.goto(studio.url)
        later.wait_for_selector('body[data-ready="true"]')
        stranger = found.new_context().new_page()
        stranger.goto(studio.url)
        told = stranger.get_by_role("alert")
        expect(told).to_contain_text("another browser")
        expect(told).to_contain_text("start it again")
        assert stranger.locator("svg").count() == 0


@needs_browser
@pytest.mark.browser
@pytest.mark.slow
def test_two_tabs_see_one_evening_and_the_last_writer_is_told() -> None:
    from playwright.sync_api import expect

    with running_studio() as studio, browser() as found:
        first = opened_page(found, studio)
        second = first.context.new_page()
        second.goto(studio.url)
        second.wait_for_selector('body[data-ready="true"]')
        first.get_by_role("button", name="Pause").click()
        first.get_by_role("button", name="New guests").click()
        for page in (first, second):
            page.get_by_label("party c1", exact=True).wait_for()
            expect(page.get_by_role("status", name="proof")).to_have_text(re.compile("^7 steps"))
        told = "Another page has changed the evening."
        expect(second.get_by_role("status", name="message")).to_have_text(told)
        expect(first.get_by_role("status", name="message")).to_have_text("")
        second.get_by_label("table table1", exact=True).click()
        second.get_by_role("menuitem", name="wants the bill").click()
        expect(first.get_by_role("status", name="message")).to_have_text(told)


# -- the end ------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", mostly_wide([signal.SIGINT, signal.SIGTERM], signal.SIGINT))
def test_it_ends_within_a_second_and_nothing_is_lost(tmp_path: Path, number: int) -> None:
    journal = str(tmp_path / "evening.journal")
    options = ("--layout", "report", "--journal", journal, "--speed", "60")
    with running_studio(*options) as studio, Lines(studio) as lines:
        lines.tell({"guests": 2})
        while not 1 <= lines.view.get("horizon", 0) <= 5:
            lines.said()
        lines.tell({"speed": 0.5})  # so that it plays still when it is ended
        lines.tell({"observe": {"bill": "table2"}})
        studio.process.send_signal(number)
        began = time.monotonic()
        assert studio.process.wait(10) == 128 + number
        assert time.monotonic() - began < 1.5  # of a machine that has others to serve
    done = waiter("serve", "--replay", journal)
    assert done.code == 0, done.err
    with running_studio(*options[:-1], "0.5") as studio, Lines(studio) as lines:
        state = lines.tell({"ask": "state"})
        assert "table2" in state["state"]["wants_bill"] and state["step"] >= 3
        lines.tell({"speed": 60})
        lines.until(0)


def test_a_journal_that_somebody_else_writes(tmp_path: Path) -> None:
    journal = str(tmp_path / "evening.journal")
    with running_studio("--journal", journal):
        command = [sys.executable, "-m", "waiter_cli", "studio", "--no-open", "--journal", journal]
        done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, timeout=30)
        assert done.returncode == 2 and "error" in done.stderr


def test_a_disk_that_is_full_is_told(tmp_path: Path) -> None:
    """Where a line cannot be made durable it is refused, and the evening lives on."""
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    done = waiter("studio", "--no-open", "--journal", "/dev/full")
    assert done.code == 2 and "error" in done.err
