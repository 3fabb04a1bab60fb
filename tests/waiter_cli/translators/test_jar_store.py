"""Which jar is used, and how one is fetched: everything against a server on the loopback."""

from __future__ import annotations

import hashlib
import http.server
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from waiter_cli.errors import InputError, MissingError
from waiter_cli.translators.jar import jar_translator
from waiter_cli.translators.jar_store import (
    RELEASES,
    JarRelease,
    cache_dir,
    fetch,
    find_jar,
    release_of,
    store_path,
)

BODY = bytes(range(256)) * 400
RELEASE = JarRelease("9.9", hashlib.sha256(BODY).hexdigest(), len(BODY), "0" * 40)


class Server(http.server.ThreadingHTTPServer):
    """Answers by path: /good, /other, /cut, /late, /slow, /unsized; a proxy answers any host."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.asked: list[str] = []
        self.halt = threading.Event()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server_port}"


class Handler(http.server.BaseHTTPRequestHandler):
    server: Server

    def log_message(self, *args: object) -> None:
        pass

    def do_GET(self) -> None:
        self.server.asked.append(self.path)
        name = self.path.rpartition("/")[2]
        if name == "none":
            self.send_error(404)
            return
        self.send_response(200)
        if name != "unsized":
            self.send_header("Content-Length", str(len(BODY)))
        self.end_headers()
        if name == "cut":
            self.wfile.write(BODY[: len(BODY) // 2])
        elif name == "other":
            self.wfile.write(BODY[::-1])
        elif name == "late":
            self.wfile.write(BODY[:1000])
            self.wfile.flush()
            self.server.halt.wait(5)
        elif name == "slow":
            for at in range(0, len(BODY), 20_000):
                self.wfile.write(BODY[at : at + 20_000])
                self.wfile.flush()
                time.sleep(0.02)
        else:
            self.wfile.write(BODY)


@contextmanager
def serving() -> Iterator[Server]:
    server = Server()
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
    thread.start()
    try:
        yield server
    finally:
        server.halt.set()
        server.shutdown()
        server.server_close()
        thread.join()


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    for name in ("http_proxy", "https_proxy", "all_proxy", "HTTP_PROXY", "HTTPS_PROXY"):
        monkeypatch.delenv(name, raising=False)
    with serving() as one:
        yield one


def left_over(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


# ------------------------------------------------------------------ download


@pytest.mark.parametrize("path", ["good", "slow", "unsized"])
def test_what_arrives_whole_is_installed(server: Server, tmp_path: Path, path: str) -> None:
    target = tmp_path / "data" / "sparc.jar"
    seen: list[tuple[int, int | None]] = []
    fetch(RELEASE, target, url=f"{server.url}/{path}", progress=lambda *pair: seen.append(pair))
    assert target.read_bytes() == BODY
    assert left_over(tmp_path) == ["sparc.jar"]
    assert seen[0][0] == 0 and seen[-1][0] == len(BODY)
    assert seen[-1][1] == (None if path == "unsized" else len(BODY))


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("other", "nothing was installed"),
        ("cut", f"broke off after {len(BODY) // 2} of {len(BODY)} bytes"),
        ("none", "answered 404"),
        ("late", "sent nothing for 0.2 seconds"),
    ],
)
def test_a_failure_leaves_what_was_there(
    server: Server, tmp_path: Path, path: str, message: str
) -> None:
    target = tmp_path / "sparc.jar"
    target.write_bytes(b"older")
    with pytest.raises(MissingError, match=message):
        fetch(RELEASE, target, url=f"{server.url}/{path}", timeout=0.2)
    assert target.read_bytes() == b"older"
    assert left_over(tmp_path) == ["sparc.jar"]


def test_nobody_listens(tmp_path: Path, server: Server) -> None:
    url = server.url
    server.halt.set()
    server.shutdown()
    server.server_close()
    with pytest.raises(MissingError, match="cannot reach"):
        fetch(RELEASE, tmp_path / "sparc.jar", url=f"{url}/good")
    assert left_over(tmp_path) == []


def test_ctrl_c_leaves_nothing(server: Server, tmp_path: Path) -> None:
    def interrupt(done: int, total: int | None) -> None:
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fetch(RELEASE, tmp_path / "sparc.jar", url=f"{server.url}/good", progress=interrupt)
    assert left_over(tmp_path) == []


def test_the_proxy_of_the_environment_is_used(
    server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("http_proxy", server.url)
    monkeypatch.setenv("no_proxy", "")
    fetch(RELEASE, tmp_path / "sparc.jar", url="http://jar.invalid/good")
    assert server.asked == ["http://jar.invalid/good"]
    assert (tmp_path / "sparc.jar").read_bytes() == BODY


def test_a_folder_that_cannot_be(tmp_path: Path, server: Server) -> None:
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(MissingError, match="cannot write to"):
        fetch(RELEASE, tmp_path / "file" / "sparc.jar", url=f"{server.url}/good")
    assert server.asked == []


def test_only_downloads(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="not an http"):
        fetch(RELEASE, tmp_path / "sparc.jar", url="ftp://127.0.0.1/sparc.jar")


# ------------------------------------------------------------------ discovery


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path / "local"))
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    return tmp_path


def test_option_before_variable_before_store(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(MissingError, match="waiter sparc fetch-jar"):
        find_jar()
    store_path().parent.mkdir(parents=True)
    for path in (store_path(), home / "variable.jar", home / "option.jar"):
        path.write_bytes(b"jar")
    assert find_jar().path == store_path()
    monkeypatch.setenv("WAITER_SPARC_JAR", str(home / "variable.jar"))
    assert (find_jar().path, find_jar().named_by) == (home / "variable.jar", "WAITER_SPARC_JAR")
    assert find_jar(home / "option.jar").path == home / "option.jar"


def test_a_jar_that_was_named_is_not_replaced_by_another(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store_path().parent.mkdir(parents=True)
    store_path().write_bytes(b"jar")
    with pytest.raises(MissingError, match=r"--sparc-jar: there is no file"):
        find_jar(home / "gone.jar")
    monkeypatch.setenv("WAITER_SPARC_JAR", str(home / "gone.jar"))
    with pytest.raises(MissingError, match=r"WAITER_SPARC_JAR: there is no file"):
        find_jar()


def test_places_are_inside_the_users_folders(home: Path) -> None:
    assert home in store_path().parents
    assert home in cache_dir().parents


def test_without_java(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (home / "some.jar").write_bytes(b"jar")
    monkeypatch.setenv("PATH", str(home))
    monkeypatch.delenv("JAVA_HOME", raising=False)
    with pytest.raises(MissingError, match="Java was not found"):
        jar_translator(home / "some.jar")


def test_releases_are_told_apart_by_hash() -> None:
    for version, release in RELEASES.items():
        found = release_of(release.sha256)
        assert found is not None and found.version == version
        assert release.url.endswith(f"{release.commit}/sparc.jar")
    assert release_of("0" * 64) is None
