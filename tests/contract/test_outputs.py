"""``-`` as the name of a file to write: what can be printed is, the rest says that it is no name."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.helps import command_tree

PRINTS = {
    "layout new --seed 1 --nodes 8 --tables 2 -o -": "name: generated",
    "layout schema -o -": '"$schema"',
    "layout convert -o - p.sparc": "nodes:",
    "domain new greeting -o -": "greeting",
    "sparc translate p.sparc -o -": "edge(n1,n2).",
}
REFUSES = {
    "plan --scenario b1 --certificate -": "--certificate",
    "simulate --scenario b1 --headless --record a.png --record -": "--record",
    "serve --layout report --journal -": "--journal",
    "studio --journal -": "--journal",
    "layout draw report --output -": "--output",
    "layout draw report --svg -": "--svg",
    "layout draw report --png -": "--png",
    "layout improve report --output -": "--output",
    "study run s.yaml --output -": "--output",
    "study run s.yaml --csv -": "--csv",
    "study run s.yaml --parquet -": "--parquet",
    "study report s.db --output -": "--output",
}
WRITES = ("Write ", "Make every", "Make all", "The store: made", "OUT.mp4")
PROGRAM = """\
sorts
#node = {n1, n2}.
predicates
edge(#node, #node).
rules
edge(n1, n2).
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "p.sparc").write_text(PROGRAM)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("line", PRINTS)
def test_what_prints_without_a_file_prints_for_a_dash(line: str, folder: Path) -> None:
    run = waiter(*line.split())
    assert run.code == 0, run.err
    assert PRINTS[line] in run.out
    assert [path.name for path in folder.iterdir()] == ["p.sparc"]


@pytest.mark.parametrize("line", REFUSES)
def test_what_is_always_a_file_needs_a_name(line: str, folder: Path) -> None:
    run = waiter(*line.split())
    assert run.code == 2
    assert run.err.startswith(f"{REFUSES[line]}: error: - is no name for a file\n")
    assert [path.name for path in folder.iterdir()] == ["p.sparc"]


def test_every_option_that_names_an_output_is_in_the_tables() -> None:
    tried = {(_command(line), "--output") for line in PRINTS}
    tried |= {(_command(line), option) for line, option in REFUSES.items()}
    outputs = {
        (name, max(parameter.opts, key=len))
        for name, command in command_tree().items()
        for parameter in command.params
        if str(parameter.metavar).startswith(("FILE", "OUT"))
        and (getattr(parameter, "help", None) or "").startswith(WRITES)
    }
    assert outputs - tried == {("simulate", "--events")}, "which has - for stdout by contract"


def _command(line: str) -> str:
    """The words of a line that name its command."""
    words = line.split()
    return max((name for n in (1, 2) if (name := " ".join(words[:n])) in command_tree()), key=len)
