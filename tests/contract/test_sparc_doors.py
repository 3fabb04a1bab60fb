"""The same bytes are the same program, whichever way they come in."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = "sorts\n#place = {bar, hall}.\npredicates\nopen(#place).\nrules\nopen(bar).\n"
FAULTY = PROGRAM + "open(hall) <- open(bar).\n"

# What a file holds, and the place of its fault, None where it has none.
BYTES = {
    "plain": (PROGRAM.encode(), None),
    "a byte-order mark": (b"\xef\xbb\xbf" + PROGRAM.encode(), None),
    "two byte-order marks": (b"\xef\xbb\xbf" * 2 + PROGRAM.encode(), "1:1"),
    "Latin-1 in a comment": ("% plan du café\n".encode("latin-1") + PROGRAM.encode(), None),
    "Latin-1 in a name": (PROGRAM.replace("hall", "café").encode("latin-1"), "2:19"),
    "UTF-8 in a comment": ("% plan du café ☕\n".encode() + PROGRAM.encode(), None),
    "CRLF": (PROGRAM.replace("\n", "\r\n").encode(), None),
    "CRLF and a fault": (FAULTY.replace("\n", "\r\n").encode(), "7:12"),
    "a lone CR": (("% note\n" + PROGRAM).replace("\n", "\r").encode(), None),
    "a lone CR and a fault": (FAULTY.replace("\n", "\r").encode(), "7:12"),
    "NUL": (b"\x00" + PROGRAM.encode(), "1:1"),
    "NUL in a comment": (b"% a\x00b\n" + PROGRAM.encode(), None),
    "control characters in a comment": (b"% \x07\x0b\x0c\x1b[31m\x85\n" + PROGRAM.encode(), None),
    "UTF-16": (PROGRAM.encode("utf-16"), "1:1"),
    "UTF-16 without a mark": (PROGRAM.encode("utf-16-le"), "1:1"),
}  # fmt: skip
DOORS = {
    "answersets": ("waiter_cli", "answersets"),
    "check": ("waiter_cli", "sparc", "check"),
    "query": ("waiter_cli", "sparc", "query", "-q", "open(bar)"),
    "translate": ("waiter_cli", "sparc", "translate"),
    "sparc": ("sparc",),
}
JAR = [
    (*DOORS[door], "--translator", "jar") for door in ("answersets", "check", "query", "translate")
]


def run(door: tuple[str, ...], data: bytes, tmp_path: Path, piped: bool) -> tuple[int, str | None]:
    """The exit code of a command, and the place of the first fault it names."""
    path = tmp_path / "x.sparc"
    path.write_bytes(data)
    done = subprocess.run(
        [sys.executable, "-m", *door, "-" if piped else str(path)],
        input=data if piped else b"",
        capture_output=True,
        check=False,
    )
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    assert "Traceback" not in said, said
    place = re.search(r"(?:x\.sparc|<stdin>):(\d+:\d+): error", done.stderr.decode("utf-8"))
    return done.returncode, place[1] if place else None


@pytest.mark.parametrize("name", BYTES)
def test_every_reader_decodes_alike(name: str, tmp_path: Path) -> None:
    """All doors read with `sparc.reading.program`; one of them stands for the rest."""
    data, place = BYTES[name]
    assert run(DOORS["sparc"], data, tmp_path, piped=False) == (2 if place else 0, place)


@pytest.mark.slow
@pytest.mark.parametrize("piped", [False, True], ids=["file", "piped"])
@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("name", BYTES)
def test_every_door(name: str, door: str, piped: bool, tmp_path: Path) -> None:
    data, place = BYTES[name]
    assert run(DOORS[door], data, tmp_path, piped) == (2 if place else 0, place)


@pytest.mark.slow
@pytest.mark.jar
@pytest.mark.parametrize("door", JAR, ids=lambda door: door[-3] if "-q" not in door else "query")
@pytest.mark.parametrize("name", BYTES)
def test_the_jar_reads_alike(name: str, door: tuple[str, ...], tmp_path: Path) -> None:
    data, place = BYTES[name]
    code, _ = run(door, data, tmp_path, piped=False)
    assert code == (2 if place else 0)


@pytest.mark.parametrize(
    ("data", "answers"),
    [
        (b"open(bar)\r\nopen(hall)\r\n", 2),
        (b"open(bar)\ropen(hall)\r", 2),
        (b"\xef\xbb\xbfopen(bar)\n% caf\xe9\nopen(hall)", 2),
        (b"open(caf\xe9)\nopen(bar)\nopen(hall)\n", 2),
        (b"open(\x00)\nopen(bar)\n", 1),
    ],
)
def test_questions_at_the_prompt(data: bytes, answers: int, tmp_path: Path) -> None:
    path = tmp_path / "x.sparc"
    path.write_text(PROGRAM, encoding="utf-8")
    command = [sys.executable, "-m", "waiter_cli", "sparc", "query", str(path)]
    done = subprocess.run(command, input=data, capture_output=True, check=False)
    assert done.returncode == 0
    assert len(re.findall(rb"^(?:yes|no|unknown)\s*$", done.stdout, re.M)) == answers
    assert b"Traceback" not in done.stderr


def test_an_interrupted_import_is_an_interruption(monkeypatch: pytest.MonkeyPatch) -> None:
    import signal

    from sparc import __main__ as door

    def main() -> int:
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            raise KeyError(140332683271040) from None
        return 0

    monkeypatch.setattr(door, "main", main)
    before = signal.getsignal(signal.SIGINT)
    try:
        assert door.run() == door.INTERRUPTED
    finally:
        signal.signal(signal.SIGINT, before)
