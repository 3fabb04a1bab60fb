"""docs/documents.md has the keys of every document, and no others.

The shapes are those that `tests.contract.test_json` holds against what the commands print.
"""

from __future__ import annotations

import re
from typing import Any

import pytest

from tests.support import documents as shape
from tests.support import tool_documents as tools
from tests.support.key_paths import key_paths
from tests.support.paths import ROOT

PAGE = (ROOT / "docs" / "documents.md").read_text(encoding="utf-8")

SECTIONS: dict[str, tuple[Any, ...]] = {
    "A reason": (shape.REASON,),
    "A fault": (shape.FAULT,),
    "An action": (shape.ACTION,),
    "A goal": (shape.GOAL,),
    "A state": (shape.STATE,),
    "A diagnosis": (shape.DIAGNOSIS,),
    "plan": (shape.PLAN, shape.NO_PLAN, shape.CONTRADICTION, shape.UNDECIDED),
    "explain": (shape.EXPLANATION,),
    "explain --why-not": (shape.FOIL,),
    "validate": (shape.VALIDATED,),
    "answersets": (shape.ANSWER_SETS, shape.COUNTED, shape.DIFFERENCES),
    "simulate": (shape.SIMULATED,),
    "serve": tuple(shape.SERVED.values()),
    "layout": (tools.CHECKED, tools.DRAWN, tools.MADE, tools.CONVERTED),
    "Figures": (tools.FIGURES,),
    "Totals": (tools.TOTALS,),
    "Their documents": (tools.COMPARED, tools.COMPARED_AGENTS, tools.IMPROVED),
    "improve --study": (tools.IMPROVED_BY_EVENINGS,),
    "domain": (tools.TESTED, tools.SHOWN),
    "study": (tools.STUDIED, tools.STUDY, tools.STUDY_REPORT, tools.PLAYED),
    "sparc": (
        tools.SPARC,
        tools.TRANSLATED,
        tools.QUERY,
        tools.QUERIES,
        tools.FORMATTED,
        tools.INSTALLED,
    ),
    "sparc explain": (tools.INCONSISTENT, tools.CONSISTENT),
    "sparc why": (tools.HOLDS, tools.HOLDS_NOT, tools.NO_SET, {"literals": [object]}),
    "list and doctor": (tools.LISTED, tools.DOCTOR),
    "Errors": (shape.ERROR,),
}
KNOWN = (
    shape.STATE,
    shape.ACTION,
    shape.FAULT,
    shape.REASON,
    shape.GOAL,
    shape.DIAGNOSIS,
    tools.FIGURES,
    tools.TOTALS,
    *tools.FIGURES.shapes,
)
RECURSIVE = "because.premises[]"  # "each of the same shape"


def sections() -> dict[str, str]:
    """The text below each heading that has a table."""
    parts = re.split(r"^##+ (.+)\n", PAGE, flags=re.MULTILINE)[1:]
    return {
        title: text
        for title, text in zip(parts[::2], parts[1::2], strict=True)
        if "\n| key |" in text
    }


def named(text: str) -> list[str]:
    """The keys in the first column of a section's tables."""
    cells = re.findall(r"^\| (`[^|]+) \|", text, flags=re.MULTILINE)
    return [key for cell in cells for key in re.findall(r"`([^`]+)`", cell)]


def test_every_section_is_of_some_document() -> None:
    assert list(sections()) == list(SECTIONS)


@pytest.mark.parametrize("title", SECTIONS)
def test_the_keys_of_a_section_are_those_of_its_documents(title: str) -> None:
    shapes = SECTIONS[title]
    others = [each for each in KNOWN if not any(each is own for own in shapes)]
    if title == "A fault":
        others = [shape.REASON]
    elif title in ("A reason", "A state", "A goal"):
        others = []
    elif title == "Figures":
        others = []
    keys = {key for each in shapes for key in key_paths(each, others)}
    keys = {key for key in keys if not key.startswith(f"{RECURSIVE}.")}
    page = named(sections()[title])
    assert sorted(page) == sorted(set(page)), "named twice"
    assert (keys - set(page), set(page) - keys) == (set(), set())
