"""The stages of a program as text."""

from __future__ import annotations

import pytest

from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from sparc.stages import STAGES, show_stage

TEXT = "sorts\n#s = {b, a}.\n#n = 1..2000.\npredicates\np(#s).\nrules\np(X):-#s(X).\n"
SOURCE = Source("p.sparc", TEXT)


def test_tokens_have_their_places_and_kinds() -> None:
    first, second, *rest = show_stage("tokens", SOURCE).split("\n")
    assert first.split("\t")[0] == "p.sparc:1:1" and first.endswith("\tsorts")
    assert second.split("\t")[2] == "#s" and len(rest) > 20


def test_the_tree_is_a_statement_a_line() -> None:
    lines = show_stage("ast", SOURCE).split("\n")
    assert len(lines) == 4 and lines[-1].startswith("Rule(")


def test_canonical_text_stays_as_it_is() -> None:
    text = show_stage("sparc", SOURCE)
    assert "p(X) :- #s(X)." in text and not text.endswith("\n")
    assert show_stage("sparc", Source("again", text)) == text


def test_sorts_have_their_elements_or_their_size() -> None:
    shown = show_stage("sorts", SOURCE).split("\n")
    assert "#s = {b, a}" in shown and "#n: 2000 elements at most" in shown


def test_the_translation_is_marked_with_its_places() -> None:
    assert "% p.sparc:7" in show_stage("asp", SOURCE)


@pytest.mark.parametrize(
    ("stage", "text"),
    [("ast", "sorts\n#s = "), ("sorts", "sorts\n#s = {a}.\npredicates\np(#t).\nrules\n")],
)
def test_a_program_that_does_not_get_so_far_is_faulty(stage: str, text: str) -> None:
    with pytest.raises((SourceError, SourceErrors)):
        show_stage(stage, Source("p", text))
    assert stage in STAGES and show_stage("tokens", Source("p", "sorts"))
