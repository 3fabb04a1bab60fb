"""`waiter sparc translate` at the command line."""

from __future__ import annotations

import os
from pathlib import Path

from tests.support.cli import waiter
from tests.support.family import both


@both
def test_above_each_rule_stands_its_sparc(family: str, translator: str) -> None:
    lines = waiter("sparc", "translate", family, "--translator", translator).out.splitlines()
    at = lines.index(f"% {family}:10")
    assert lines[at : at + 3] == [f"% {family}:10", "%   parent(bob,", "%          eve)."]
    assert lines[at + 3] == "parent(bob,eve)."
    assert "%   old(X) | -old(X) :- parent(X, eve)." in lines
    assert "#show old/1." in lines


def test_a_file_is_written_whole_or_not_at_all(family: str, tmp_path: Path) -> None:
    target = tmp_path / "out" / "family.lp"
    ran = waiter("sparc", "translate", family, "-o", str(target))
    assert ran.code == 2
    assert str(target) in ran.err
    target.parent.mkdir()
    assert waiter("sparc", "translate", family, "-o", str(target)).out == ""
    first = target.read_text()
    assert first == waiter("sparc", "translate", family).out
    bad = tmp_path / "bad.sparc"
    bad.write_text("sorts\n")
    assert waiter("sparc", "translate", str(bad), "-o", str(target)).code == 2
    assert target.read_text() == first
    assert os.listdir(target.parent) == ["family.lp"]


def test_the_mode_of_a_file_is_kept(family: str, tmp_path: Path) -> None:
    target = tmp_path / "family.lp"
    target.write_text("old")
    target.chmod(0o640)
    waiter("sparc", "translate", family, "-o", str(target))
    assert target.stat().st_mode & 0o777 == 0o640
