"""What Tab offers in bash, zsh and fish; and the manual page, which is made of the same texts."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.helps import command_tree
from tests.support.paths import ROOT
from waiter_cli.app import COMMANDS
from waiter_cli.file_access.locate import built_in

TREE = command_tree()
SHELLS = ("bash", "zsh", "fish")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


def offered(line: str, shell: str, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the shell would offer after ``line`` and Tab; empty where it offers files of its own."""
    words = line.split(" ")
    monkeypatch.setenv("_WAITER_COMPLETE", f"complete_{shell}")
    monkeypatch.setenv("COMP_WORDS", "\n".join(words))
    monkeypatch.setenv("COMP_CWORD", str(len(words) - 1))
    monkeypatch.setenv("_TYPER_COMPLETE_ARGS", line)
    monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "get-args")
    monkeypatch.setenv("COLUMNS", "40")
    ran = waiter()
    assert ran.code == 0 and not ran.err
    if shell == "zsh":
        return [] if ran.out.strip() == "_files" else re.findall(r'^[^"]*"([^"]+)"', ran.out, re.M)
    return [text.partition("\t")[0] for text in ran.out.splitlines() if text]


def options_of(words: str) -> set[str]:
    parameters = TREE[words].params
    long = {o for p in parameters for o in (*p.opts, *p.secondary_opts) if o.startswith("--")}
    return long | {"--help"}


CASES: list[tuple[str, set[str]]] = [
    ("waiter ", set(COMMANDS)),
    ("waiter pl", {"plan"}),
    ("waiter layout ", {"check", "draw", "new", "schema", "convert", "improve"}),
    (
        "waiter sparc ",
        {"check", "translate", "query", "explain", "why", "format", "lsp", "fetch-jar"},
    ),
    ("waiter domain s", {"show"}),
    ("waiter --v", {"--version"}),
    ("waiter plan --", options_of("plan")),
    ("waiter layout new --", options_of("layout new")),
    ("waiter plan --sc", {"--scenario"}),
    ("waiter plan --search ", {"binary", "linear", "gallop", "minimize"}),
    ("waiter sparc check x.sparc --translator j", {"jar"}),
    ("waiter layout improve report --only ", {"edges", "tables"}),
    ("waiter plan --layout ", {*built_in("layout")}),
    ("waiter plan -l bi", {"bistro"}),
    ("waiter serve --scenario b", {"b1", "b2", "b3", "b4", "blocked_aisle"}),
    ("waiter domain test --domain re", {"restaurant", "report"}),
    ("waiter layout check bis", {"bistro"}),
    ("waiter layout draw w", {"walled_off"}),
    ("waiter layout improve bis", {"bistro"}),
    ("waiter compare b", {"bistro"}),
    ("waiter compare bistro walled", {"walled_off"}),
    ("waiter compare bistro report --scenario lu", {"lunch"}),
    # Files: the shell knows them best.
    ("waiter answersets ", set()),
    ("waiter plan --layout ./", set()),
    ("waiter plan --layout nothing_like_it", set()),
    ("waiter validate ", set()),
]


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize(("line", "expected"), CASES, ids=[line for line, _ in CASES])
def test_what_is_offered(
    line: str, expected: set[str], shell: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = offered(line, shell, monkeypatch)
    assert set(found) == expected and len(found) == len(expected)


def test_files_are_offered_beside_the_names(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("bis.yaml", "bis.txt", "own.yaml", ".hidden.yaml"):
        (folder / name).touch()
    (folder / "bis_rooms").mkdir()
    line = "waiter plan --layout bis"
    assert offered(line, "bash", monkeypatch) == ["bis.yaml", "bis_rooms/", "bistro"]
    found = set(offered("waiter plan --layout ", "bash", monkeypatch))
    assert found == {*built_in("layout"), "bis.yaml", "own.yaml", "bis_rooms/"}
    assert offered("waiter plan --layout o", "bash", monkeypatch) == [], "the shell offers own.yaml"


def in_a_shell(command: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """What a shell does with a script, where ``waiter`` is on the path."""
    launcher = folder / "waiter"
    launcher.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m waiter_cli "$@"\n')
    launcher.chmod(0o755)
    return subprocess.run(
        command,
        capture_output=True,
        text=True,
        env={"PATH": f"{folder}:/usr/bin:/bin", "PYTHONPATH": str(ROOT), "HOME": str(folder)},
        timeout=60,
        check=False,
    )


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_in_a_real_bash(folder: Path) -> None:
    script = (
        'eval "$(waiter --show-completion bash)"\n'
        "complete -p waiter\n"
        "COMP_WORDS=(waiter layout draw --scenario b) COMP_CWORD=4\n"
        '_waiter_completion waiter; printf "%s\\n" "${COMPREPLY[@]}"\n'
    )
    done = in_a_shell(["bash", "--norc", "-c", script], folder)
    how, *names = done.stdout.split("\n")
    assert "_waiter_completion" in how, done.stderr
    assert names[:-1] == ["b1", "b2", "b3", "b4", "blocked_aisle"]


@pytest.mark.skipif(shutil.which("fish") is None, reason="needs fish")
def test_in_a_real_fish(folder: Path) -> None:
    script = 'waiter --show-completion fish | source; complete -C "waiter layout draw --scenario b"'
    done = in_a_shell(["fish", "--no-config", "-c", script], folder)
    assert done.stdout.split() == ["b1", "b2", "b3", "b4", "blocked_aisle"], done.stderr


@pytest.mark.parametrize("shell", SHELLS)
def test_the_script_of_each_shell(shell: str) -> None:
    ran = waiter("--show-completion", shell)
    assert ran.code == 0
    assert f"_WAITER_COMPLETE=complete_{shell}" in ran.out and "waiter" in ran.out


def test_it_is_installed_for_the_shell_that_was_named(folder: Path) -> None:
    ran = waiter("--install-completion", "bash")
    assert (ran.code, ran.err) == (0, "")
    script = folder / ".bash_completions" / "waiter.sh"
    assert str(script) in ran.out
    assert "complete_bash" in script.read_text()
    assert str(script) in (folder / ".bashrc").read_text()


@pytest.mark.parametrize("option", ["--show-completion", "--install-completion"])
def test_a_shell_without_completion_is_wrong_input(option: str, folder: Path) -> None:
    ran = waiter(option, "tcsh")
    assert (ran.code, ran.out) == (2, "")
    assert "no completion for tcsh" in ran.err and "bash, zsh, fish" in ran.err
    assert list(folder.iterdir()) == []


# -- the manual page --------------------------------------------------------------------------


def test_the_manual_names_every_command_and_option() -> None:
    page = waiter("--man").out
    for words, command in TREE.items():
        section = page if not words else page.split(f'.SS "waiter {words}', 1)[1].split(".SS ")[0]
        for parameter in command.params:
            if parameter.param_type_name == "option":
                assert parameter.opts[0].replace("-", "\\-") in section, (words, parameter.opts)
    for code in (0, 1, 2, 3, 4, 5):
        assert re.search(rf"^\.B {code}$", page, re.M)
    assert "WAITER_SPARC_JAR" in page and "WAITER_TRANSLATOR" in page


@pytest.mark.skipif(shutil.which("groff") is None, reason="needs groff")
def test_the_manual_is_well_formed() -> None:
    done = subprocess.run(
        ["groff", "-man", "-Tascii", "-ww"],
        input=waiter("--man").out,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    shown = re.sub(".\x08", "", done.stdout)
    assert "EXIT STATUS" in shown and "waiter layout improve" in shown
