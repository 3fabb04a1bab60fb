"""The live loop as tests see it: in this process (`Live`), over a pipe (`Pipe`) or a socket (`Client`)."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from tests.support.paths import ROOT
from waiter_cli.diagnosis.diagnose import explain
from waiter_cli.encoding.domains import find_domain
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.model.layout import Layout
from waiter_cli.model.scenario import Scenario
from waiter_cli.serve.inbox import ReceivedLine
from waiter_cli.serve.session import Session
from waiter_cli.serve.startup import begin
from waiter_cli.translators.native import NativeTranslator

__all__ = ["Client", "Listening", "Live", "Pipe", "listening", "thinker"]


def thinker(time_limit: float | None = 30.0) -> OnlinePlanner:
    """The planner of the restaurant."""
    return OnlinePlanner(NativeTranslator(), find_domain("restaurant"), time_limit)


class Live:
    """A session in this process: one object in, one object out."""

    def __init__(
        self, layout: Layout, scenario: Scenario | None = None, time_limit: float | None = 30.0
    ) -> None:
        planner = thinker(time_limit)
        executive = begin(layout, scenario, planner, explain)
        executive.decide()
        self.session = Session(executive, planner)
        self.count = 0

    def tell(self, line: Any) -> dict[str, Any]:
        """The answer to an object, or to bytes as they are."""
        self.count += 1
        data = line if isinstance(line, bytes) else json.dumps(line).encode()
        answer = json.loads(
            self.session.handle(ReceivedLine(self.count, data, time.perf_counter()))
        )
        assert answer["line"] == self.count
        return answer  # type: ignore[no-any-return]

    def seen(self, *observations: Any) -> dict[str, Any]:
        """The answer to observations, all of one moment."""
        return self.tell({"observe": list(observations)})

    def state(self) -> Any:
        """What is believed."""
        return self.tell({"ask": "state"})["state"]

    def work(self, answer: dict[str, Any], most: int = 200) -> dict[str, Any]:
        """Does step after step of the plan until nothing is left of it."""
        while answer["horizon"]:
            most -= 1
            assert most, "the work does not end"
            (first, *_) = answer["plan"] or [{"step": self.session.executive.step}]
            answer = self.tell({"done": min(first["step"], self.session.executive.step)})
            assert "error" not in answer, answer
        return answer


class Pipe:
    """``waiter serve`` in a process of its own."""

    def __init__(self, *arguments: str, **more: Any) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "waiter_cli", "serve", *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=ROOT,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            **more,
        )
        self.hello = self.read()

    def read(self) -> Any:
        """The next line of its output; None at the end."""
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        return json.loads(line) if line else None

    def send(self, line: Any) -> None:
        """Sends an object, or bytes as they are."""
        assert self.process.stdin is not None
        data = line if isinstance(line, bytes) else json.dumps(line).encode()
        self.process.stdin.write(data + b"\n")
        self.process.stdin.flush()

    def tell(self, line: Any) -> Any:
        """Sends a line and reads its answer."""
        self.send(line)
        return self.read()

    def end(self) -> tuple[int, str]:
        """Closes its input; its exit code and what it said on stderr."""
        _, err = self.process.communicate(timeout=60)
        return self.process.returncode, err.decode()


class Client:
    """One connection to a loop."""

    def __init__(self, place: Any) -> None:
        family = socket.AF_UNIX if isinstance(place, str) else socket.AF_INET
        self.socket = socket.socket(family)
        self.socket.settimeout(30)
        self.socket.connect(place)
        self.file = self.socket.makefile("rb")
        self.hello = self.read()

    def read(self) -> Any:
        line = self.file.readline()
        return json.loads(line) if line else None

    def send(self, data: bytes) -> None:
        self.socket.sendall(data)

    def close(self) -> None:
        """Hangs up."""
        self.file.close()
        self.socket.close()


def listening(*arguments: str) -> tuple[subprocess.Popen[bytes], str]:
    """A loop on a socket, and where it listens."""
    process = subprocess.Popen(
        [sys.executable, "-m", "waiter_cli", "serve", "--layout", "report", *arguments],
        stdin=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert process.stderr is not None
    told = process.stderr.readline().decode()
    assert "listening on " in told
    return process, told.strip().rpartition(" ")[2]


class Listening:
    """``waiter serve --listen``, ended with the ``with`` block; ``code`` is its exit code then."""

    def __init__(self, address: str, *arguments: str) -> None:
        self.process, place = listening("--listen", address, *arguments)
        host, _, port = place.rpartition(":")
        self.target: Any = place if "/" in address else (host, int(port))
        self.code: int | None = None

    def client(self) -> Client:
        """A new connection that was greeted."""
        found = Client(self.target)
        assert found.hello, "not admitted"
        return found

    def peak(self) -> int:
        """The most memory that the process has had, in MB."""
        text = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(text.partition("VmHWM:")[2].split()[0]) // 1024

    def __enter__(self) -> Listening:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.terminate()
        try:
            self.code = self.process.wait(10)
        finally:
            self.process.kill()
            self.process.wait()
            if self.process.stderr is not None:
                self.process.stderr.close()
