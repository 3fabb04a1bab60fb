"""Streams that are closed, full or nobody's, and colour: results are whole or the fault is told."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.support.processes import at_once, started, surroundings, waiter_process
from tests.support.sampling import mostly_slow
from tests.support.terminal import Terminal

pytestmark = pytest.mark.skipif(os.name != "posix", reason="streams as POSIX has them")

SCENE = ("--scenario", "b4")
LONG: dict[str, tuple[str, ...]] = {
    "version": ("--version",),
    "plan": ("plan", *SCENE),
    "json": ("plan", *SCENE, "--json"),
    "explain": ("explain", *SCENE),
    "answersets": ("answersets", *SCENE, "--jsonl"),
    "events": ("simulate", *SCENE, "--events", "-"),
    "rules": ("domain", "show"),
    "schema": ("layout", "schema"),
    "compare": ("compare", "report", "report_large", *SCENE),
    "serve": ("serve", "--layout", "report"),
    "tour": ("tour", "--no-pause"),
}
"""Commands that have something to say on stdout, and succeed."""


def ended(process: subprocess.Popen[bytes]) -> tuple[int, str, str]:
    """The exit code of a process, and what it said on the streams that were kept."""
    out, err = process.communicate(timeout=120)
    return process.returncode, (out or b"").decode(), (err or b"").decode()


def with_shell(streams: str, *arguments: str) -> tuple[int, str, str]:
    """``waiter ARGUMENTS STREAMS`` as a shell opens and closes the streams."""
    line = [sys.executable, "-m", "waiter_cli", *arguments]
    process = subprocess.Popen(
        ["sh", "-c", f'exec "$0" "$@" {streams}', *line], env=surroundings(),
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip
    return ended(process)


def without_reader(*arguments: str) -> tuple[int, str, str]:
    """``waiter ARGUMENTS`` on a pipe whose other end is closed."""
    reader, writer = os.pipe()
    os.close(reader)
    process = started(*arguments, stdout=writer)
    os.close(writer)
    return ended(process)


@pytest.mark.parametrize("name", mostly_slow(LONG, "answersets"))
def test_results_that_nobody_gets(name: str) -> None:
    """A reader who goes has seen enough; a full disk or no stdout at all is a fault."""
    command = LONG[name]
    jobs: list[Any] = [
        lambda: without_reader(*command),
        lambda: with_shell(">/dev/full", *command),
        lambda: with_shell(">&-", *command),
    ]
    gone, full, closed = at_once(lambda job: job(), jobs)
    assert (gone[0], gone[2].count("waiter: cannot write")) == (0, 0)
    assert full[0] == 2
    assert full[2].endswith("waiter: cannot write the output: no space left on device\n")
    assert closed[0] == 2
    assert closed[2].endswith("waiter: cannot write the output: bad file descriptor\n")
    for _, _, err in (gone, full, closed):
        assert not any(word in err for word in ("Traceback", "internal fault", "Exception"))


def test_the_reader_goes_after_a_line() -> None:
    """More than a pipe holds: the command notices, and ends as one that was read to the end."""
    process = started("plan", "--scenario", "lunch", "--show", "tokens")
    assert process.stdout is not None and process.stderr is not None
    assert process.stdout.readline().strip()
    process.stdout.close()
    assert process.stderr.read() == b""
    assert process.wait(120) == 0


def test_a_fault_that_cannot_be_told_as_json_is_told_in_words() -> None:
    code, out, err = with_shell(">/dev/full", "plan", "--scenario", "nope", "--json")
    assert (code, out) == (2, "")
    assert err == "waiter: cannot write the output: no space left on device\n"
    assert without_reader("plan", "--scenario", "nope", "--json") == (2, "", "")


@pytest.mark.parametrize("streams", ["2>&-", "2>/dev/full", "<&-", "<&- 2>&-"])
def test_results_do_not_need_the_other_streams(streams: str) -> None:
    """stderr may be closed or full, and nothing of it comes up on stdout instead."""
    code, out, err = with_shell(streams, "plan", *SCENE, "--json", "-v")
    assert (code, json.loads(out)["horizon"]) == (0, 1)
    assert ("bounds" in err) == ("2>" not in streams)
    code, out, _ = with_shell(streams, "plan", "--scenario", "nope")
    assert (code, out) == (2, "")


def test_results_do_not_need_a_reader_of_stderr() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    process = started("plan", *SCENE, "--json", "-v", stderr=writer)
    os.close(writer)
    code, out, _ = ended(process)
    assert (code, json.loads(out)["horizon"]) == (0, 1)


def test_what_goes_to_a_file_needs_no_stdout(tmp_path: Path) -> None:
    drawing = tmp_path / "report.svg"
    code, _, err = with_shell(">&-", "layout", "draw", "report", "-o", str(drawing))
    assert (code, err) == (0, f"wrote {drawing}\n")
    assert drawing.read_text().startswith("<svg")


def test_an_input_that_is_closed_is_empty() -> None:
    for command in (("layout", "check", "-"), ("sparc", "check", "-"), ("validate", "-")):
        code, out, err = with_shell("<&-", *command)
        assert (code, out) == (2, "") and "<stdin>" in err and "Traceback" not in err
    code, out, err = with_shell("<&-", "serve", "--layout", "report")
    assert (code, len(out.splitlines()), err) == (0, 1, "")


WRITTEN = ["a.html", "a.png", "a.gif", "a.mp4", "frames/", "events"]


@pytest.mark.wide
@pytest.mark.parametrize("name", mostly_slow(WRITTEN, "a.html", "a.mp4", "events"))
def test_a_full_disk_is_told_and_leaves_nothing(name: str, tmp_path: Path) -> None:
    """A limit on the size of files stands for the disk."""
    pytest.importorskip("imageio_ffmpeg")
    pytest.importorskip("PIL")
    resource = pytest.importorskip("resource")
    option = "--events" if name == "events" else "--record"
    process = started(
        "simulate", *SCENE, "--backend", "geometric", "--view", "2d", option, name, cwd=tmp_path,
        environment=surroundings(PYTHONDONTWRITEBYTECODE="1"),  # no compiled module is cut short
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512)),
    )  # fmt: skip
    code, _, err = ended(process)
    assert code == 2 and "Traceback" not in err
    assert "waiter: cannot write: File too large" in err or "ffmpeg has given up" in err
    assert os.listdir(tmp_path) == []


# -- colour -----------------------------------------------------------------------------------

COLOURED = [
    ("plan", *SCENE),
    ("plan", "--scenario", "nope"),
    ("layout", "check", "report"),
    ("layout", "draw", "report"),
    ("answersets", *SCENE, "--grep", "agent"),
    ("domain", "show", "--grep", "bill"),
]


def on_a_terminal(*command: str, **variables: str) -> str:
    """All that a command shows on a terminal."""
    with Terminal(*command, **{"NO_COLOR": "", "TERM": "xterm-256color", **variables}) as terminal:
        terminal.end(120)
        return terminal.seen


@pytest.mark.parametrize(
    "command",
    mostly_slow(COLOURED, *COLOURED[:2]),
    ids=lambda command: " ".join(command[:2]),
)
def test_colour_is_for_terminals_that_want_it(command: tuple[str, ...]) -> None:
    seen = at_once(
        lambda variables: on_a_terminal(*command, **variables),
        [{}, {"NO_COLOR": "1"}, {"TERM": "dumb"}],
    )
    assert ["\x1b[" in each for each in seen] == [True, False, False]
    assert "\x1b" not in seen[1] + seen[2]
    ran = waiter_process(*command, TERM="xterm-256color", COLORTERM="truecolor", FORCE_COLOR="1")
    assert "\x1b" not in ran.out + ran.err


def test_progress_needs_no_colour(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg")
    pytest.importorskip("PIL")
    out = str(tmp_path / "a.mp4")
    small = ("--view", "2d", "--backend", "geometric", "--size", "160x160", "--fps", "2")
    seen = on_a_terminal("simulate", *SCENE, *small, "--record", out, TERM="dumb")
    assert "\rrecording " in seen and "\x1b" not in seen
    assert seen.split()[-2:] == ["recorded:", out]
