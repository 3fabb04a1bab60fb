"""The jar backend: what it makes of the jar's output and messages, and how it runs Java.

The half that needs Java plays with stand-ins for it; the tests marked ``jar`` run the real one.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from sparc.errors import (
    MissingToolError,
    PredicateError,
    RuleError,
    SolverError,
    SortError,
    SourceError,
    SparcSyntaxError,
)
from sparc.solving.jar_output import asp_program
from sparc.solving.jar_translator import (
    JarTranslator,
    TranslationTimeout,
    find_java,
)
from sparc.source import Source
from tests.support.jar import FAMILY, FAMILY_ASP, JAR, needs_jar

# ------------------------------------------------------------------ running Java


def stand_in(tmp_path: Path, script: str) -> JarTranslator:
    """A translator whose Java is a shell script; ``$OUT`` is the file it should write."""
    java = tmp_path / "java"
    java.write_text(f"#!/bin/sh\nfor OUT; do :; done\n{script}\n")
    java.chmod(0o755)
    jar = tmp_path / "sparc.jar"
    jar.write_bytes(b"jar")
    (tmp_path / "asp").write_text(FAMILY_ASP)
    return JarTranslator(jar, str(java), tmp_path / "cache")


WORKS = 'cat {asp} > "$OUT"; echo program translated >&2; exit 1'
FAMILY_SOURCE = Source("family.sparc", FAMILY)

posix = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a shell script")


@posix
def test_exit_codes_are_not_believed(tmp_path: Path) -> None:
    translator = stand_in(tmp_path, WORKS.format(asp=tmp_path / "asp"))
    assert translator.translate(FAMILY_SOURCE).text.startswith("knows(ann,bob).")
    silent = stand_in(tmp_path, "exit 0")
    with pytest.raises(SolverError, match="no message"):
        silent.translate(Source("x", "sorts\n"))


@posix
def test_a_translation_is_kept_by_content(tmp_path: Path) -> None:
    translator = stand_in(tmp_path, WORKS.format(asp=tmp_path / "asp"))
    first = translator.translate(FAMILY_SOURCE)
    again = translator.translate(Source("copy.sparc", FAMILY))
    assert (translator.java_runs, again.text) == (1, first.text)
    translator.translate(Source("family.sparc", FAMILY + "% more\n"))
    assert translator.java_runs == 2
    translator.jar_path.write_bytes(b"another jar")
    other = JarTranslator(translator.jar_path, translator.java, translator.cache_dir)
    other.translate(FAMILY_SOURCE)
    assert other.java_runs == 1


@posix
def test_a_torn_or_foreign_cache_entry_is_made_again(tmp_path: Path) -> None:
    translator = stand_in(tmp_path, WORKS.format(asp=tmp_path / "asp"))
    translator.translate(FAMILY_SOURCE)
    (entry,) = (tmp_path / "cache").iterdir()
    for damage in (b"", FAMILY_ASP[:50].encode(), b"\xff\xfe"):
        entry.write_bytes(damage)
        translator.translate(FAMILY_SOURCE)
    assert translator.java_runs == 4


@posix
def test_the_cache_stays_within_bounds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sparc.solving.jar_translator._CACHE_ENTRIES", 3)
    translator = stand_in(tmp_path, WORKS.format(asp=tmp_path / "asp"))
    for index in range(5):
        translator.translate(Source("x", FAMILY + f"% {index}\n"))
    assert len(list((tmp_path / "cache").iterdir())) == 3


@posix
def test_no_folder_for_the_cache_is_no_error(tmp_path: Path) -> None:
    translator = stand_in(tmp_path, WORKS.format(asp=tmp_path / "asp"))
    (tmp_path / "file").write_text("in the way")
    translator.cache_dir = tmp_path / "file" / "cache"
    translator.translate(FAMILY_SOURCE)
    translator.translate(FAMILY_SOURCE)
    assert translator.java_runs == 2


def is_running(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    status = Path(f"/proc/{pid}/stat")
    return not status.exists() or status.read_text().rpartition(")")[2].split()[0] != "Z"


@posix
def test_at_the_time_limit_all_children_end(tmp_path: Path) -> None:
    pids = tmp_path / "pids"
    translator = stand_in(tmp_path, f"sleep 60 & echo $! $$ > {pids}; wait")
    start = time.monotonic()
    with pytest.raises(TranslationTimeout, match=r"within 0\.3 seconds"):
        translator.translate(FAMILY_SOURCE, time_limit=0.3)
    assert time.monotonic() - start < 3
    deadline = time.monotonic() + 2
    while any(map(is_running, map(int, pids.read_text().split()))):
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert not (tmp_path / "cache").exists()


@posix
def test_it_gets_a_clingo_that_does_nothing_and_no_input(tmp_path: Path) -> None:
    asp = tmp_path / "asp"
    script = f'clingo < /dev/null || exit 9; read -r LINE && exit 9\ncat {asp} > "$OUT"'
    translator = stand_in(tmp_path, f"{script}; echo program translated >&2")
    translator.translate(FAMILY_SOURCE)
    assert translator.java_runs == 1


@posix
@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("Error: Unable to access jarfile x", "cannot read sparc.jar"),
        ("java.lang.UnsupportedClassVersionError: x", "too old"),
        ("Exception in thread main java.lang.OutOfMemoryError: heap", "out of memory"),
        ("Exception in thread main java.lang.StackOverflowError", "nested this deeply"),
        ("Exception in thread main java.lang.NullPointerException", "NullPointerException"),
    ],
)
def test_how_java_dies(tmp_path: Path, said: str, message: str) -> None:
    with pytest.raises(SolverError, match=message):
        stand_in(tmp_path, f"echo '{said}' >&2; exit 1").translate(FAMILY_SOURCE)


def test_missing_tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    jar = tmp_path / "sparc.jar"
    with pytest.raises(MissingToolError, match="cannot read"):
        JarTranslator(jar).translate(FAMILY_SOURCE)
    jar.write_bytes(b"jar")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("JAVA_HOME", raising=False)
    assert find_java() is None
    with pytest.raises(MissingToolError, match="java was not found"):
        JarTranslator(jar).translate(FAMILY_SOURCE)


# ------------------------------------------------------------------ the real jar


def real() -> JarTranslator:
    assert JAR is not None
    return JarTranslator(JAR)


@needs_jar
def test_the_real_jar_translates_with_a_line_map() -> None:
    program = real().translate(FAMILY_SOURCE)
    stand = asp_program(FAMILY_ASP, FAMILY_SOURCE)
    assert sorted(program.show.split("\n")) == sorted(stand.show.split("\n"))
    assert program.text.count("\n") == stand.text.count("\n")
    assert program.line_spans == stand.line_spans
    assert program.has_preferences


@needs_jar
def test_the_real_jar_never_solves() -> None:
    hard = "sorts\n#p = 1..14.\n#h = 1..13.\npredicates\nin(#p,#h).\nrules\n1{in(P,H)}1.\n"
    hard += ":- in(P,H), in(Q,H), P != Q.\n"
    start = time.monotonic()
    real().translate(Source("pigeons.sparc", hard), time_limit=20)
    assert time.monotonic() - start < 10


@needs_jar
@pytest.mark.parametrize(
    ("program", "kind", "place"),
    [
        ("sorts\n#s={a}.\npredicates\np(#s).\nrules\n\tp(b).\n", PredicateError, "6:2"),
        ("sorts\n#s={a}.\npredicates\np(#t).\nrules\n", SortError, "4:3"),
        ("sorts\n#s={a}.\npredicates\np(#s).\nrules\np(a) :- .\n", SparcSyntaxError, "6:9"),
        ("sorts\n#s={a\t?}.\npredicates\np(#s).\nrules\n", SparcSyntaxError, "2:7"),
        ("sorts\n#s={a}.\npredicates\np(#s).\nrules\np(X) :- X<Y.\n", RuleError, "6:1"),
        ("sorts\n#s={a}.\npredicates\np(#s).\nrules\np(a).\ndisplay\nz.\n", PredicateError, "8:1"),
    ],
)
def test_the_real_jars_errors(program: str, kind: type[SourceError], place: str) -> None:
    with pytest.raises(kind) as caught:
        real().translate(Source("mine.sparc", program))
    assert caught.value.span is not None
    assert str(caught.value.span.location) == f"mine.sparc:{place}"
    assert " at line" not in caught.value.message
