"""`waiter sparc check` at the command line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.family import FAMILY
from tests.support.jar import needs_jar
from waiter_cli.file_access.locate import data_folder


def test_check_counts_what_it_read(family: str) -> None:
    ran = waiter("sparc", "check", family)
    assert (ran.code, ran.err) == (0, "")
    assert ran.out == f"{family}: no fault in 2 sorts, 3 predicates, 6 rules.\n"


def test_check_reports_every_fault_in_place(tmp_path: Path) -> None:
    path = tmp_path / "bad.sparc"
    path.write_text(FAMILY + "old(zoe).\nyoung(ann).\n")
    ran = waiter("sparc", "check", str(path))
    assert (ran.code, ran.out) == (2, "")
    assert f"{path}:16:" in ran.err and f"{path}:17:1" in ran.err
    document = waiter("sparc", "check", str(path), "--json").json()
    assert document["status"] == "error"
    assert [error["line"] for error in document["errors"]] == [16, 17]


def test_warnings_are_no_faults(tmp_path: Path) -> None:
    path = tmp_path / "odd.sparc"
    path.write_text(FAMILY + "old(X) :- born(X, Y), Y > 3.\n")
    assert waiter("sparc", "check", str(path)).err == ""
    ran = waiter("sparc", "check", str(path), "--warnings")
    assert ran.code == 0
    assert f"{path}:16:1: warning:" in ran.err
    document = waiter("sparc", "check", str(path), "--warnings", "--json").json()
    assert (document["status"], document["warnings"][0]["line"]) == ("ok", 16)


@pytest.mark.parametrize(
    "name", ["report/domain", "restaurant/domain", "restaurant/fleet", "restaurant/diagnosis"]
)
def test_a_built_in_domain_is_a_program_without_warnings(name: str) -> None:
    path = os.path.join(data_folder("domains"), f"{name}.sparc")
    ran = waiter("sparc", "check", path, "--warnings")
    assert (ran.code, ran.err) == (0, "")
    assert waiter("answersets", path, "--json").json()["satisfiable"]


@needs_jar
def test_check_with_the_jar(tmp_path: Path, family: str) -> None:
    assert waiter("sparc", "check", family, "--translator", "jar").code == 0
    path = tmp_path / "bad.sparc"
    path.write_text(FAMILY + "old(zoe).\n")
    ran = waiter("sparc", "check", str(path), "--translator", "jar")
    assert ran.code == 2
    assert f"{path}:16:1: error:" in ran.err
