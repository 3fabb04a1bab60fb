"""The jar as a translator: what is missing or refused, in words with a mend."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from sparc.errors import MissingToolError, RefusedProgramError, SolverError
from sparc.solving import jar_translator as running
from sparc.solving.jar_translator import TranslationTimeout
from sparc.source import Source
from waiter_cli.errors import InputError, MissingError
from waiter_cli.translators.jar import JarBackend, jar_errors, jar_translator, java_mend


@pytest.mark.parametrize(
    ("platform", "command"),
    [("darwin", "brew install openjdk"), ("win32", "winget install"), ("linux", "apt-get install")],
)
def test_java_is_installed_by_the_command_of_the_system(
    platform: str, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", platform)
    assert command in java_mend()


class Broken:
    """A translator that fails."""

    def __init__(self, error: Exception) -> None:
        self.error = error

    def translate(self, source: Source, *, time_limit: float | None = None) -> object:
        raise self.error


def failing(error: Exception) -> Exception:
    with pytest.raises(Exception) as caught:
        JarBackend(Broken(error)).translate(Source("x", ""))  # type: ignore[arg-type]
    return caught.value


def test_a_tool_that_is_missing_is_missing_with_its_mend() -> None:
    java = failing(MissingToolError("java", "Java was not found", "get it"))
    jar = failing(MissingToolError("jar", "no jar", "get it"))
    assert isinstance(java, MissingError) and java.mend == java_mend()
    assert isinstance(jar, MissingError) and "waiter sparc fetch-jar" in jar.mend


def test_what_clingo_refuses_is_told_as_its_refusal() -> None:
    error = failing(RefusedProgramError("line 3:\n  unsafe variable"))
    assert isinstance(error, InputError)
    (fault,) = error.faults
    assert fault.message == (
        "clingo refused what sparc.jar made of the program: line 3: unsafe variable"
    )


def test_a_program_that_is_refused_is_a_fault_of_the_program() -> None:
    error = failing(SolverError("the jar\n  gave up", None))
    assert isinstance(error, InputError)
    (fault,) = error.faults
    assert fault.message == "the jar gave up" and fault.hint == "try --translator native"


def test_a_limit_of_time_stays_one() -> None:
    error = TranslationTimeout("too long", None)
    assert failing(error) is error


def test_nothing_is_caught_where_nothing_fails() -> None:
    with jar_errors():
        pass
    with pytest.raises(ValueError), jar_errors():
        raise ValueError("no matter of the jar")


def test_a_jar_without_java_is_missing_java(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    jar = tmp_path / "sparc.jar"
    jar.write_bytes(b"PK\x03\x04")
    monkeypatch.setattr(running, "find_java", lambda: None)
    with pytest.raises(MissingError, match="Java was not found"):
        jar_translator(jar)


def test_a_jar_that_is_not_there_is_missing(tmp_path: Path) -> None:
    with pytest.raises((MissingError, InputError)):
        jar_translator(tmp_path / "nothing.jar")
