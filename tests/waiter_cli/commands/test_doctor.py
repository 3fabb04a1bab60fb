"""What `waiter doctor` finds, on this machine and on machines that lack something."""

from __future__ import annotations

import hashlib
import json
import sys
from importlib import util
from pathlib import Path

import pytest

from waiter_cli.app import run
from waiter_cli.commands import doctor as module
from waiter_cli.commands.doctor import Finding, examine


def by_name(findings: list[Finding]) -> dict[str, Finding]:
    return {finding.name: finding for finding in findings}


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    return tmp_path / "waiter" / "sparc.jar"


def lacking(monkeypatch: pytest.MonkeyPatch, *names: str) -> None:
    """Makes modules impossible to find."""
    real = util.find_spec

    def find_spec(name: str, package: str | None = None) -> object:
        return None if name in names else real(name, package)

    monkeypatch.setattr(util, "find_spec", find_spec)


def test_the_core_is_here_and_json_says_so(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["ok"] is True
    core = [each for each in report["components"] if each["core"]]
    assert [each["name"] for each in core] == ["Python", "clingo", "typer", "rich", "PyYAML"]
    assert all(each["status"] == "ok" and each["version"] for each in core)


def test_a_missing_core_part_is_exit_5(
    store: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lacking(monkeypatch, "clingo")
    assert run(["doctor"]) == 5
    out = capsys.readouterr().out
    assert "A core part is missing" in out
    assert "install clingo" in out


def test_without_a_jar(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor"]) == 0
    assert "-> waiter sparc fetch-jar" in capsys.readouterr().out
    found = by_name(examine(str(store)))["sparc.jar"]
    assert found.status == "missing" and str(store) in (found.mend or "")


def test_a_jar_is_known_by_its_hash(store: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store.parent.mkdir(parents=True)
    store.write_bytes(b"not a jar")
    sha256 = hashlib.sha256(b"not a jar").hexdigest()
    found = by_name(examine())["sparc.jar"]
    assert (found.status, found.version, found.sha256) == ("unusable", None, sha256)
    assert found.path == str(store)

    from waiter_cli.translators import jar_store

    release = jar_store.JarRelease("1.23", sha256, 9, "0" * 40)
    monkeypatch.setattr(jar_store, "RELEASES", {"1.23": release})
    assert by_name(examine())["sparc.jar"].version == "V1.23"


def test_without_java(store: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("JAVA_HOME", raising=False)
    found = by_name(examine())["Java"]
    assert found.status == "missing" and "install a Java runtime" in (found.mend or "")


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a shell script")
@pytest.mark.parametrize(
    ("script", "status", "version"),
    [
        ("""echo 'openjdk version "21.0.1" 2023-10-17' >&2""", "ok", "21.0.1"),
        ("echo 'Unable to locate a Java Runtime' >&2; exit 1", "unusable", None),
    ],
)
def test_java_is_asked(
    store: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    script: str,
    status: str,
    version: str | None,
) -> None:
    java = tmp_path / "java"
    java.write_text(f"#!/bin/sh\n{script}\n")
    java.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    found = by_name(examine())["Java"]
    assert (found.status, found.version, found.path) == (status, version, str(java))


@pytest.mark.parametrize(
    ("system", "machine", "python", "wheels"),
    [
        ("linux", "x86_64", (3, 11), True),
        ("linux", "x86_64", (3, 12), False),
        ("linux", "aarch64", (3, 11), False),
        ("darwin", "x86_64", (3, 11), False),
    ],
)
def test_pybullet_is_offered_where_it_can_be_had(
    store: Path,
    monkeypatch: pytest.MonkeyPatch,
    system: str,
    machine: str,
    python: tuple[int, int],
    wheels: bool,
) -> None:
    lacking(monkeypatch, "pybullet")
    monkeypatch.setattr(module.sys, "platform", system)
    monkeypatch.setattr(module.sys, "version_info", (*python, 0))
    monkeypatch.setattr(module.platform, "machine", lambda: machine)
    found = module._pybullet()
    assert found.status == ("missing" if wheels else "unavailable")
    assert ("install" in (found.mend or "")) == wheels
    assert ("Linux x86_64 with Python 3.10 to 3.11" in (found.mend or "")) != wheels
