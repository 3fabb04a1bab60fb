"""Many runs at once, runs that are killed and runs that are interrupted: files are whole, nobody is left."""

from __future__ import annotations

import json
import os
import random
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.support.jar import JAR, JAR_MARKS
from tests.support.processes import Running, at_once, waiter_process
from tests.support.sampling import mostly_wide

pytestmark = pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks into /proc")

JAR_HERE = pytest.param("jar", marks=JAR_MARKS)


# -- many at once -----------------------------------------------------------------------------

SHARED: dict[str, tuple[tuple[str, ...], Callable[[str], object]]] = {
    "shared.json": (("layout", "schema", "-o"), json.loads),
    "shared.jsonl": (
        ("simulate", "--scenario", "b4", "--backend", "geometric", "--events"),
        lambda text: [json.loads(line) for line in text.splitlines()][-1]["type"] == "end" or 1 / 0,
    ),
    "shared.svg": (
        ("layout", "draw", "bistro", "-o"),
        lambda text: text.endswith("</svg>\n") or 1 / 0,
    ),
}
"""What each of many writes, and how to tell that it is whole."""


def whole(path: Path) -> bool:
    """Whether a shared file is whole, or not there yet."""
    try:
        SHARED[path.name][1](path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return True
    except (ValueError, ZeroDivisionError, IndexError):
        return False
    return True


def together(folder: Path, runs: int, alive: int) -> None:
    """Plans in one folder while its files are written over and over, and read all the time."""
    commands: list[tuple[object, ...]] = [("plan", "--scenario", "b1", "--json")]
    commands += [(*command, name) for name, (command, _) in SHARED.items()]
    torn: list[str] = []
    done = threading.Event()

    def watch() -> None:
        while not done.wait(0.002):
            torn.extend(name for name in SHARED if not whole(folder / name))

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        jobs = [commands[number % len(commands)] for number in range(runs)]
        found = at_once(lambda job: waiter_process(*job, cwd=folder), jobs, alive)
    finally:
        done.set()
        watcher.join()
    assert [ran.code for ran in found] == [0] * runs, [ran.err for ran in found if ran.code]
    plans = [ran.json() for ran in found[:: len(commands)]]
    assert {plan["horizon"] for plan in plans} == {7}
    assert not torn
    assert sorted(os.listdir(folder)) == sorted(SHARED)


def test_many_at_once_in_one_folder(tmp_path: Path) -> None:
    together(tmp_path, 8, 4)


@pytest.mark.slow
def test_a_hundred_at_once_in_one_folder(tmp_path: Path) -> None:
    together(tmp_path, 100, 8)


@pytest.mark.parametrize("jar", [pytest.param(JAR, marks=JAR_MARKS, id="jar")])
@pytest.mark.slow
def test_translations_are_shared_by_those_who_run_at_once(jar: Path, tmp_path: Path) -> None:
    (tmp_path / "tmp").mkdir()
    places = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "TMPDIR": str(tmp_path / "tmp")}

    def run(name: str) -> Any:
        command = ("plan", "--scenario", name, "--json", "--translator", "jar", "--sparc-jar", jar)
        return waiter_process(*command, **places)

    found = at_once(run, ["b1", "b1", "b4", "b1", "b4", "b1"], 3)
    assert [ran.err for ran in found] == [""] * 6
    assert [ran.json()["horizon"] for ran in found] == [7, 7, 1, 7, 1, 7]
    kept = [path.suffix for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    assert set(kept) == {".lp"} and len(kept) <= 3
    assert os.listdir(tmp_path / "tmp") == []


# -- killed -----------------------------------------------------------------------------------

PROGRAM = "sorts #n = 1..{}. predicates p(#n). rules p(X) | -p(X) :- #n(X)."
WRITERS: dict[str, tuple[object, ...]] = {
    "translate": ("sparc", "translate", "p.sparc", "-o", "out.lp"),
    "improve": (
        "layout",
        "improve",
        "report",
        "--scenario",
        "b1",
        "--tries",
        "2",
        "-o",
        "out.yaml",
    ),
    "page": ("simulate", "--scenario", "b4", "--record", "out.html"),
    "film": (
        *("simulate", "--scenario", "b4", "--backend", "geometric", "--view", "2d"),
        *("--size", "320x240", "--record", "out.mp4"),
    ),
    "jar": ("sparc", "translate", "--translator", "jar", "p.sparc", "-o", "out.lp"),
}


def work_in(folder: Path) -> tuple[Path, dict[str, str]]:
    """A folder to work in, and variables that name others for what is temporary or kept."""
    work = folder / "work"
    for each in (work, folder / "tmp"):
        each.mkdir(parents=True)
    (work / "p.sparc").write_text(PROGRAM.format(4))
    variables = {"TMPDIR": str(folder / "tmp"), "XDG_CACHE_HOME": str(folder / "cache")}
    return work, {**variables, **({"WAITER_SPARC_JAR": str(JAR)} if JAR else {})}


def killed(name: str, above: Path, times: int, seed: int) -> None:
    """Kills a command at random moments: what it writes is there whole, or what was there is."""
    if name == "film":
        pytest.importorskip("imageio_ffmpeg")
        pytest.importorskip("PIL")
    command = WRITERS[name]
    out = str(command[-1])
    work, variables = work_in(above / "whole")
    start = time.monotonic()
    assert waiter_process(*command, cwd=work, **variables).code == 0
    seconds = time.monotonic() - start
    expected = (work / out).read_bytes()
    rng = random.Random(seed)

    def trial(job: tuple[int, float]) -> None:
        work, variables = work_in(above / str(job[0]))
        (work / out).write_text("before")
        with Running(*command, cwd=work, **variables) as running:
            running.after(job[1], signal.SIGKILL)
            running.end()
        assert (work / out).read_bytes() in (b"before", expected)
        hidden = set(os.listdir(work)) - {out, "p.sparc"}
        assert all(each.startswith(".waiter-") for each in hidden), hidden
        again = waiter_process(*command, cwd=work, **variables)
        assert again.code == 0 and (work / out).read_bytes() == expected
        assert set(os.listdir(work)) - {out, "p.sparc"} == hidden

    at_once(trial, list(enumerate(rng.uniform(0, seconds) for _ in range(times))))


@pytest.mark.parametrize("name", mostly_wide(["translate", "page"], "translate"))
def test_a_killed_command_leaves_the_old_file_or_the_new(name: str, tmp_path: Path) -> None:
    """What a killed one leaves is hidden, and does the next one no harm; the journal has its own."""
    killed(name, tmp_path, 2, seed=1)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["translate", "improve", "page", "film", JAR_HERE])
def test_commands_that_are_killed_forty_times(name: str, tmp_path: Path) -> None:
    killed(name, tmp_path, 40, seed=2)


# -- interrupted ------------------------------------------------------------------------------

GUESTS = [word for number in "44221" for word in ("--enter", number)]
LENGTHY: dict[str, tuple[object, ...]] = {
    "plan": (
        *("plan", "--layout", "report_large", *GUESTS),
        *("--domain", "report", "--search", "linear", "--json"),
    ),
    "answersets": ("answersets", "many.sparc", "-n", "0", "--json"),
    "film": (
        *("simulate", "--scenario", "lunch", "--backend", "geometric", "--view", "2d"),
        *("--fps", "60", "--record", "out.mp4"),
    ),
    "page": (
        "simulate",
        "--scenario",
        "lunch",
        "--speed",
        "0.05",
        "--fps",
        "60",
        "--record",
        "out.html",
    ),
    "jar": ("plan", "--scenario", "b1", "--translator", "jar", "--sparc-jar", "p.sparc"),
}
"""Commands that take longer than the tests let them; Java is a script that takes a minute."""
JAVA = "#!/bin/sh\nsleep 60 &\nwait\n"
CODES = {signal.SIGINT: (130, "interrupted"), signal.SIGTERM: (143, "terminated")}


def interrupted(name: str, above: Path, times: int, seed: int) -> None:
    """Sends a signal, or several of them, at random moments of a command's first second.

    Children are gone soon after the command is.
    """
    if name == "film":
        pytest.importorskip("imageio_ffmpeg")
        pytest.importorskip("PIL")
    command = LENGTHY[name]
    rng = random.Random(seed)

    def trial(job: tuple[int, signal.Signals, int, float]) -> None:
        number, sent, times, moment = job
        work, variables = work_in(above / str(number))
        (work / "many.sparc").write_text(PROGRAM.format(26))
        for out in ("out.mp4", "out.html"):
            (work / out).write_text("before")
        (work / "java").write_text(JAVA)
        (work / "java").chmod(0o755)
        variables["PATH"] = os.pathsep.join((str(work), os.environ["PATH"]))
        there = sorted(os.listdir(work))
        with Running(*command, cwd=work, **variables) as running:
            running.after(moment, *[sent] * times)
            ran = running.end(patience=20)
        code, word = CODES[sent]
        assert (ran.code, ran.out) == (code, ""), ran
        assert ran.err in ("", f"waiter: {word}\n")
        assert sorted(os.listdir(work)) == there
        assert {(work / out).read_text() for out in ("out.mp4", "out.html")} == {"before"}
        assert os.listdir(above / str(number) / "tmp") == []

    sent = [each for each in CODES for _ in range(times // 2)]
    rng.shuffle(sent)
    moments = [(number + rng.random()) / times for number in range(times)]
    at_once(trial, [(n, sent[n], 40 if n % 2 else 1, moments[n]) for n in range(times)])


@pytest.mark.parametrize("name", mostly_wide(["plan", "jar"], "plan"))
def test_an_interrupted_command_says_one_line_and_leaves_nothing(name: str, tmp_path: Path) -> None:
    interrupted(name, tmp_path, 2, seed=1)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["plan", "answersets", "film", "page", "jar"])
def test_commands_that_are_interrupted_forty_times(name: str, tmp_path: Path) -> None:
    interrupted(name, tmp_path, 40, seed=2)


SIGNAL_IN_AN_IMPORT = """\
import builtins, signal
from waiter_cli import app
real = builtins.__import__
def disturbed(name, *rest, **more):
    if name == "yaml":
        try:
            signal.raise_signal(signal.SIGTERM)
        except BaseException as error:
            raise ImportError(f"{name} cannot be had") from error
    return real(name, *rest, **more)
builtins.__import__ = disturbed
app.main()
"""


def test_an_end_of_input_that_no_question_met_is_a_fault() -> None:
    """As of a compiled module that is cut short; not to be taken for Ctrl-D."""
    begin = SIGNAL_IN_AN_IMPORT.replace("signal.raise_signal(signal.SIGTERM)", "raise EOFError")
    begin = begin.replace('raise ImportError(f"{name} cannot be had") from error', "raise")
    ran = waiter_process("plan", "--scenario", "b1", begin=begin)
    assert ran.code == 1 and "internal fault" in ran.err and "EOFError" in ran.err


def test_a_signal_is_a_signal_whatever_becomes_of_it() -> None:
    """Code in C, such as numpy's, makes an error of its own of a signal while it is imported."""
    ran = waiter_process("plan", "--scenario", "b1", begin=SIGNAL_IN_AN_IMPORT)
    assert (ran.code, ran.out, ran.err) == (143, "", "waiter: terminated\n")
