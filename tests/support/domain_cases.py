"""Domains with their cases, as tests of them need them: in memory, or as files in a folder."""

from __future__ import annotations

import shutil
from functools import cache
from pathlib import Path

from sparc.source import Source
from waiter_cli.domain_tests.case_reader import read_case_folder, read_cases
from waiter_cli.domain_tests.cases import Case
from waiter_cli.domain_tests.verdicts import CaseVerdict, run_cases
from waiter_cli.file_access.locate import data_folder

__all__ = ["BUILT_IN", "copy_domain", "domain", "restaurant_verdicts"]

BUILT_IN = ("report", "restaurant")

LAYOUT = """\
layout:
  nodes: [n1, n2, n3]
  edges: [[n1, n2], [n2, n3]]
  entrance: n1
  tables: {table1: {capacity: 2, nodes: [n3]}}
  agent: n2
  customers: 2
cases:
"""


@cache
def domain(name: str) -> tuple[Source, tuple[Case, ...]]:
    """The template of a built-in domain and its cases."""
    folder = Path(data_folder("domains")) / name
    text = (folder / "domain.sparc").read_text(encoding="utf-8")
    return Source(f"domains/{name}/domain.sparc", text), read_case_folder(str(folder / "cases"))


def copy_domain(name: str, to: Path) -> Path:
    """The path of a template that was copied to a folder with its cases beside it."""
    shutil.copytree(Path(data_folder("domains")) / name, to / name)
    return to / name / "domain.sparc"


def restaurant_verdicts(cases: str) -> tuple[CaseVerdict, ...]:
    """The verdicts of the restaurant's domain on cases that a text lists, in a small layout."""
    return run_cases(domain("restaurant")[0], read_cases(LAYOUT + cases, "mine.yaml"))
