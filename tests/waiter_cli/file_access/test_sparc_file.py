"""A program file that is something else altogether."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.cli import waiter

OTHERS = {
    "a layout": "nodes: {a: [0, 0]}\nedges: []\nentrance: a\nagent: a\n",
    "a scenario": "layout: report\nstate: {}\n",
    "a plan": json.dumps({"status": "plan", "horizon": 0, "actions": []}),
    "a file of cases": "cases: []\n",
}


@pytest.mark.parametrize("kind", OTHERS)
@pytest.mark.parametrize(
    "command",
    [
        ["answersets"],
        ["sparc", "check"],
        ["sparc", "explain"],
        ["sparc", "format"],
        ["plan", "--layout", "report", "--domain"],
    ],
)
def test_another_kind_of_file_is_named(kind: str, command: list[str], tmp_path: Path) -> None:
    file = tmp_path / "given"
    file.write_text(OTHERS[kind])
    ran = waiter(*command, str(file))
    assert ran.code == 2
    said = " ".join(ran.err.split())
    assert f"this is {kind}, not a SPARC program" in said and "hint:" in said


def test_a_program_with_a_slip_is_a_program(tmp_path: Path) -> None:
    file = tmp_path / "p.sparc"
    file.write_text("sorts:\n#s = {a}.\npredicates:\np(#s).\nrules:\np(a).\n")
    assert "not a SPARC program" not in waiter("sparc", "check", str(file)).err
