"""`waiter studio` up to the moment at which its page is served."""

from __future__ import annotations

import json
import socket
import subprocess
import sys

import pytest

from tests.support.browsing import needs_studio, running_studio
from tests.support.cli import waiter
from tests.support.paths import ROOT


@needs_studio
def test_the_address_is_the_first_line() -> None:
    with running_studio("--layout", "bistro") as studio:
        assert studio.url.startswith("http://127.0.0.1:")
        assert len(studio.token) > 30


@needs_studio
def test_the_address_as_json() -> None:
    command = [sys.executable, "-m", "waiter_cli", "studio", "--no-open", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stdout is not None
        told = json.loads(process.stdout.readline())
        process.terminate()
    assert told["studio"] == "waiter.studio/1" and told["url"].startswith("http://127.0.0.1:")


@needs_studio
def test_a_port_that_is_taken() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        done = waiter("studio", "--no-open", "--port", str(taken.getsockname()[1]))
    assert done.code == 2 and "--port: error: cannot listen there" in done.err


@needs_studio
def test_a_layout_without_places() -> None:
    done = waiter("studio", "--no-open", "--layout", "tests/golden/no_such.yaml")
    assert done.code == 2


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import importlib.util

    real = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *rest: None if name == "uvicorn" else real(name)
    )
    done = waiter("studio", "--no-open")
    assert done.code == 5 and "the studio needs uvicorn" in done.err and "pip install" in done.err
