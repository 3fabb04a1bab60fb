"""``waiter sparc format`` from its front door."""

from __future__ import annotations

import json
import stat
from pathlib import Path

import pytest

from tests.support.cli import waiter

UGLY = "sorts #s={a}.\npredicates p(#s).\nrules\np( a ).% note\n"
NEAT = "sorts\n#s = {a}.\n\npredicates\np(#s).\n\nrules\np(a).  % note\n"


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "p.sparc"
    path.write_text(UGLY)
    return path


def test_the_text_goes_to_standard_output(program: Path) -> None:
    ran = waiter("sparc", "format", str(program))
    assert (ran.code, ran.out, ran.err) == (0, NEAT, "")
    assert program.read_text() == UGLY


def test_in_place(program: Path) -> None:
    ran = waiter("sparc", "format", "-i", str(program))
    assert (ran.code, ran.out) == (0, f"formatted {program}\n")
    assert program.read_text() == NEAT
    assert waiter("sparc", "format", "-i", str(program)).out == ""


@pytest.mark.parametrize(
    "before",
    [
        UGLY.replace("note", "café").encode("latin-1"),
        b"\xef\xbb\xbf" + UGLY.replace("note", "café").encode(),
        UGLY.replace("\n", "\r\n").encode(),
    ],
    ids=["latin-1", "byte-order mark", "CRLF"],
)
def test_bytes_of_comments_and_line_ends_stay(program: Path, before: bytes) -> None:
    program.write_bytes(before)
    assert waiter("sparc", "format", "-i", str(program)).code == 0
    after = program.read_bytes()
    assert after.split(b"%")[1].split() == before.split(b"%")[1].split()
    assert after.startswith(b"\xef\xbb\xbf") == before.startswith(b"\xef\xbb\xbf")
    assert after.count(b"\r") == (after.count(b"\n") if b"\r" in before else 0)


def test_a_file_with_a_fault_stays_as_it_is(program: Path, tmp_path: Path) -> None:
    program.write_text(UGLY + "p(a :- p(a).\n")
    ran = waiter("sparc", "format", "-i", str(program))
    assert ran.code == 2 and f"{program}:5:" in ran.err
    assert program.read_text() == UGLY + "p(a :- p(a).\n"


def test_a_read_only_file_stays_as_it_is(program: Path) -> None:
    program.chmod(stat.S_IRUSR)
    ran = waiter("sparc", "format", "-i", str(program))
    assert ran.code == 2 and "read-only" in ran.err
    assert program.read_text() == UGLY


def test_what_cannot_be_done_in_place_is_refused(program: Path) -> None:
    assert waiter("sparc", "format", str(program), str(program)).code == 2
    assert waiter("sparc", "format", "-i", "-").code == 2


def test_json(program: Path) -> None:
    ran = waiter("sparc", "format", "--json", "-i", str(program))
    done = {"file": str(program), "changed": True}
    assert json.loads(ran.out) == {"status": "formatted", "in_place": True, "files": [done]}


def test_usage_names_the_file_without_braces() -> None:
    usage = waiter("sparc", "format", "--help").out.splitlines()[0]
    assert usage == "Usage: waiter sparc format [OPTIONS] FILE..."
