"""One program with every construct, through every stage; `pytest --update-golden` writes anew."""

from __future__ import annotations

from pathlib import Path

import pytest

import sparc
from sparc.source import Source
from sparc.syntax.printer import print_program
from tests.support.answer_corpus import answer_sets

GOLDEN = Path(__file__).parent.parent / "golden"


def stages(name: str) -> dict[str, str]:
    """The text of each stage by the ending of its file."""
    source = Source(f"{name}.sparc", (GOLDEN / f"{name}.sparc").read_text(encoding="utf-8"))
    program = sparc.parse(source)
    tree = [*program.directives, *program.sorts, *program.predicates, *program.statements]
    return {
        "ast": "\n".join(map(repr, [*tree, *(program.display or ())])) + "\n",
        "lp": sparc.to_asp(program).annotated() + "\n",
        "answers": "\n".join(answer_sets(source)) + "\n",
    }


@pytest.mark.parametrize("name", ["kitchen_sink"])
def test_stages(name: str, request: pytest.FixtureRequest) -> None:
    for ending, found in stages(name).items():
        path = GOLDEN / f"{name}.{ending}"
        if request.config.getoption("--update-golden"):
            path.write_text(found, encoding="utf-8")
        assert found == path.read_text(encoding="utf-8"), f"{path.name}: --update-golden, and read"


def test_printing_the_kitchen_sink_keeps_it() -> None:
    source = Source("x", (GOLDEN / "kitchen_sink.sparc").read_text(encoding="utf-8"))
    program = sparc.parse(source)
    assert sparc.parse(print_program(program)) == program
