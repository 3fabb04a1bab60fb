"""What docs/sparc-dialect.md shows is what happens."""

from __future__ import annotations

import re

import sparc
from tests.support.answer_corpus import answer_sets
from tests.support.paths import ROOT

PAGE = ROOT / "docs" / "sparc-dialect.md"


def test_the_program_on_the_page() -> None:
    program = PAGE.read_text(encoding="utf-8").split("```")[1]
    assert answer_sets(program) == (
        "{occurs(put(b1,b0),0), occurs(put(b2,b1),1)}",
        "{occurs(put(b1,b0),1), occurs(put(b2,b1),0)}",
    )


def test_the_translations_on_the_page() -> None:
    rows = re.findall(r"^\| `([^`]+\.)` \| `([^`]+\.)` \|$", PAGE.read_text("utf-8"), re.MULTILINE)
    assert len(rows) == 3
    declarations = "sorts #n = 0..5. predicates p(#n). q(#n). y(#n). rules\n"
    for rule, translation in rows:
        assert sparc.to_asp(declarations + rule).text.split("\n")[0] == translation
