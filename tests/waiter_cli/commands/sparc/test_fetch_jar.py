"""`waiter sparc fetch-jar` at the command line."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.terminal import Terminal
from waiter_cli.commands.sparc import fetch_jar as sparc_fetching
from waiter_cli.translators import jar_store


@pytest.fixture
def published(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The address of a file that stands for the jar; its hash is that of version 2.57."""
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "data"))
    body = b"the jar" * 1000
    (tmp_path / "published.jar").write_bytes(body)
    release = jar_store.JarRelease("2.57", hashlib.sha256(body).hexdigest(), len(body), "0" * 40)
    monkeypatch.setattr(jar_store, "RELEASES", {"2.57": release})
    return (tmp_path / "published.jar").as_uri()


def test_fetch_installs_for_this_user(published: str) -> None:
    ran = waiter("sparc", "fetch-jar", "--yes", "--url", published)
    assert (ran.code, ran.err) == (0, "")
    assert str(jar_store.store_path()) in ran.out
    assert jar_store.find_jar().sha256() == jar_store.RELEASES["2.57"].sha256
    again = waiter("sparc", "fetch-jar", "--url", "http://127.0.0.1:9/never-asked")
    assert (again.code, "installed already" in again.out) == (0, True)


def test_progress_is_for_terminals_that_can_take_it_away_again(published: str) -> None:
    """Here the file is not the jar; whatever came before, the last lines say so."""
    arguments = ("sparc", "fetch-jar", "--yes", "--url", published)
    assert "bytes" not in waiter("sparc", "fetch-jar", "--yes", "--url", published + "x").err
    for term, bar in (("dumb", False), ("xterm", True)):
        with Terminal(*arguments, TERM=term) as terminal:
            assert terminal.end() == 5
            assert ("7.0/7.0 kB" in terminal.seen) == bar, term
            assert "0/?" not in terminal.seen
            assert terminal.seen.count("is not sparc.jar V2.57") == 1


def test_fetch_asks_first(published: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ran = waiter("sparc", "fetch-jar", "--url", published)
    assert (ran.code, ran.out) == (2, "")
    assert "--yes" in ran.err

    class Terminal:
        isatty = staticmethod(lambda: True)

    asked = Terminal()
    monkeypatch.setattr(sparc_fetching.sys, "stdin", asked)
    for answer, installed in (("\n", False), ("n\n", False), ("Y\n", True)):
        asked.readline = lambda answer=answer: answer  # type: ignore[attr-defined]
        assert sparc_fetching._agreed("Download?") is installed


def test_declined_is_not_done(published: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sparc_fetching, "_agreed", lambda question: False)
    ran = waiter("sparc", "fetch-jar", "--url", published)
    assert ran.code != 0
    assert "nothing was downloaded" in ran.err
    assert not jar_store.store_path().exists()


def test_what_is_not_the_jar_is_not_installed(published: str, tmp_path: Path) -> None:
    (tmp_path / "published.jar").write_bytes(b"something else")
    ran = waiter("sparc", "fetch-jar", "--yes", "--url", published)
    assert (ran.code, ran.out) == (5, "")
    assert "nothing was installed" in ran.err
    assert not list(jar_store.store_path().parent.iterdir())


def test_versions_that_are_known(published: str) -> None:
    ran = waiter("sparc", "fetch-jar", "--yes", "--version", "3.0", "--url", published)
    assert ran.code == 2
    assert "known are 2.57" in ran.err
