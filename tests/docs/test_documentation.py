"""The documentation runs: every command of README.md and docs/ is executed, in order, in a folder.

A block of YAML or SPARC whose first line is a comment with a file name is written to that file. A
block of ``sh`` is run line by line; the ``text`` block that follows it is what its last line
prints, ``…`` standing for anything. Blocks of ``python`` are the cells of one notebook; the ``text``
block that follows one is what it prints and the value of its last expression. Lines that need a network, a terminal or an installation are
named in `ELSEWHERE` and tested on their own. The tutorial finds an empty folder, as its reader does.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.paths import ROOT
from tests.support.sampling import mostly_wide
from waiter_cli.errors import MissingError
from waiter_cli.translators.jar import jar_translator

PAGES = sorted(
    [ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "domains").rglob("*.md")]
)
BLOCK = re.compile(r"^```(\w+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"\A(?:#|%|//) ([\w./-]+\.(?:yaml|sparc|jsonl|json|py))\n")
ELSEWHERE = (
    "--study quick.yaml --for",  # many evenings, played by the tests of that command
    "python3 -m venv",
    "waiter sparc fetch-jar",
    "--gui",
    "--watch",
    "--install-completion",
)
LONG = {
    ROOT / "docs" / "study.md",
    ROOT / "docs" / "simulate.md",
    ROOT / "docs" / "tutorial.md",
    ROOT / "docs" / "teaching.md",
    ROOT / "docs" / "files.md",
    ROOT / "domains" / "restaurant" / "cases" / "README.md",
}
"""Pages that play whole evenings, which tests of those commands do as well."""
PLAIN = re.compile(r"(waiter [^|&;<>$*~`()]*?)(?: > ([\w.-]+))?")
"""A command line that needs no shell, what it quotes apart, and the file that it prints to."""
UNHURRIED = re.compile(r"waiter serve(?!.*--time-limit)")
"""The loop, which answers with what it has after a second; a busy machine takes longer."""
# Commands that are meant to end otherwise than with 0: what is impossible, what is wrong.
CODES = {0, 3}


def blocks(page: Path) -> list[tuple[str, str]]:
    return BLOCK.findall(page.read_text(encoding="utf-8"))


def cells_of(page: Path) -> list[str]:
    """The cells of a page's notebook: blocks of Python that are no files."""
    return [
        text for language, text in blocks(page) if language == "python" and not FILE.match(text)
    ]


def command(line: str) -> str:
    """A line of the page, with this interpreter and its `waiter`."""
    python = shlex.quote(sys.executable)
    line = re.sub(r"(^|[|(&] *)waiter ", rf"\1{python} -m waiter_cli ", line)
    return re.sub(r"(^|[|(&] *)python ", rf"\1{python} ", line)


def run(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs a line in a shell; a plain `waiter` command in this process, which is quicker."""
    line = UNHURRIED.sub("waiter serve --time-limit 60", line)
    if plain := PLAIN.fullmatch(re.sub(r"'[^']*'", "''", line)):
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(folder)
            patch.setenv("COLUMNS", "80")
            patch.setenv("NO_COLOR", "1")
            words = shlex.split(line)[1:]
            ran = waiter(*(words if plain[2] is None else words[:-2]))
        if plain[2] is not None:
            (folder / plain[2]).write_text(ran.out, encoding="utf-8")
            return subprocess.CompletedProcess(line, ran.code, "", ran.err)
        return subprocess.CompletedProcess(line, ran.code, ran.out, ran.err)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80", "NO_COLOR": "1"}
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", command(line)],
        cwd=folder, env=environment, capture_output=True, text=True,
        stdin=subprocess.DEVNULL, timeout=120, check=False,
    )  # fmt: skip


def shown_by_cells(cells: list[str], folder: Path) -> list[str]:
    """What each cell of a notebook shows, all run in one process."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80", "NO_COLOR": "1"}
    done = subprocess.run(
        [sys.executable, "-c", NOTEBOOK, *cells],
        cwd=folder, env=environment, capture_output=True, text=True,
        stdin=subprocess.DEVNULL, timeout=120, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{done.stdout}{done.stderr}"
    return done.stdout.split(CELL)[1:]


CELL = "--- cell ---\n"
NOTEBOOK = f"""
import ast, sys
names = {{"__name__": "__main__"}}
for text in sys.argv[1:]:
    print({CELL!r}, end="")
    tree = ast.parse(text)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "<cell>", "exec"), names)
    value = None if last is None else eval(compile(ast.Expression(last.value), "<cell>", "eval"), names)
    if value is not None:
        print(repr(value))
"""


def matches(shown: str, out: str) -> bool:
    """Whether each shown line stands in the output, in order; ``…`` stands for anything.

    How many spaces part two words does not matter.
    """
    at = 0
    printed = [" ".join(line.split()) for line in out.splitlines()]
    for line in shown.splitlines():
        if line.strip() in ("", "…"):
            continue
        pattern = ".*".join(re.escape(part) for part in " ".join(line.split()).split("…"))
        while at < len(printed) and not re.fullmatch(pattern, printed[at]):
            at += 1
        if at == len(printed):
            return False
        at += 1
    return True


def have_jar() -> bool:
    try:
        jar_translator()
    except MissingError:
        return False
    return True


@pytest.mark.parametrize(
    "page",
    mostly_wide(PAGES, *(page for page in PAGES if page not in LONG)),
    ids=lambda page: page.relative_to(ROOT).as_posix(),
)
def test_the_page_runs(page: Path, tmp_path: Path) -> None:
    if page.name == "sparc-dialect.md":  # its programs are run by their own test
        return
    for name in ("domains", "layouts", "examples"):  # pages may name files of a checkout
        if page.name != "tutorial.md":
            (tmp_path / name).symlink_to(ROOT / name)
    out = None
    shown: list[str] = []  # by the cells that are still to come
    for language, text in blocks(page):
        file = FILE.match(text)
        if file:
            (tmp_path / file[1]).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / file[1]).write_text(text, encoding="utf-8")
        elif language == "sh":
            out = None
            for line in text.replace("\\\n", " ").splitlines():
                line = re.sub(r"\s+# .*$", "", line).strip()
                if not line or line.startswith("#") or any(word in line for word in ELSEWHERE):
                    continue
                if "jar" in line and not have_jar():
                    continue
                done = run(line, tmp_path)
                assert done.returncode in CODES, f"{line}\n{done.stdout}{done.stderr}"
                assert "Traceback" not in done.stderr, f"{line}\n{done.stderr}"
                out = done.stdout + done.stderr
        elif language == "python":
            out = (shown := shown or shown_by_cells(cells_of(page), tmp_path)).pop(0)
        elif language == "text" and out is not None:
            assert matches(text, out), f"{page.name} shows\n{text}\nand the command prints\n{out}"
            out = None


def test_readme_shows_what_its_first_line_prints(tmp_path: Path) -> None:
    shown = next(text for language, text in blocks(ROOT / "README.md") if language == "text")
    done = run("waiter plan --layout report --enter 1", tmp_path)
    assert matches(shown, done.stdout)


def test_every_command_is_in_the_readme() -> None:
    from waiter_cli.app import COMMANDS

    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert not [name for name in COMMANDS if f"waiter {name}" not in text]


def test_cells_share_their_names_and_show_their_value(tmp_path: Path) -> None:
    cells = ["x = 2", "print(x)\nx + 1", "print('more')", "x = None\nx"]
    assert shown_by_cells(cells, tmp_path) == ["", "2\n3\n", "more\n", ""]
    with pytest.raises(AssertionError, match="ZeroDivisionError"):
        shown_by_cells(["1 / 0"], tmp_path)


def test_a_page_that_is_wrong_would_be_seen() -> None:
    assert not matches("7 steps", "8 steps\n")
    assert matches("a … c", "x\na b c\n")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (page.parent / target).exists(), f"{page.name}: {target}"
