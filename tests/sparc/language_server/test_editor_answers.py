"""Changes that mend a fault, offered where it stands."""

from __future__ import annotations

import pytest

from sparc.language_server.document import Document
from sparc.language_server.editor_answers import fixes

HEAD = "sorts\n#s = 1..2.\npredicates\np(#s).\nq(#s).\nrules\n"


@pytest.mark.parametrize(
    ("rule", "mended"),
    [
        ("p(X) <- q(X).", "p(X) :- q(X)."),
        ("p(X) :\u2013 q(X).", "p(X) :- q(X)."),
        ("p(X) :\u2014 q(X).", "p(X) :- q(X)."),
        ("p(Y) :- q(Y), q(X), X is Y+1.", "p(Y) :- q(Y), q(X), X = Y+1."),
        ("p(X) :- q(X), X =< 1.", "p(X) :- q(X), X <= 1."),
        ("p(X) :- q(X), X <> 1.", "p(X) :- q(X), X != 1."),
        ("p(X) :- qq(X).", "p(X) :- q(X)."),
        ("p(1)", "p(1)."),
        ("p(1)\nq(2).", "p(1).\nq(2)."),
        ("q(2).\np(X) :- q(X)", "q(2).\np(X) :- q(X)."),
        ("p(1),\nq(2).", "p(1).\nq(2)."),
        ("p(1)\n-p(2).", "p(1).\n-p(2)."),
        ("P(1).", "p(1)."),
        ("-P(1).", "-p(1)."),
        ("{P(1)}.", "{p(1)}."),
        ("p(1) | Q(1).", "p(1) | q(1)."),
        (":- P(1), q(1).", ":- p(1), q(1)."),
        ("p(X) :- q(X), Q(X).", "p(X) :- q(X), q(X)."),
        ("p(X) :- q(X), not Q(X).", "p(X) :- q(X), not q(X)."),
        ("p(1) :- #count{X : p(X) > 2.", "p(1) :- #count{X : p(X)} > 2."),
        (":- #count{X : p(X), X > 1 = 2.", ":- #count{X : p(X), X > 1} = 2."),
        ("{p(X) : q(X) = 2.", "{p(X) : q(X)} = 2."),
        ("p(1) => q(2).", None),  # the conclusion has to come first
        ("p(1) -> q(2).", None),
    ],
)
def test_a_fault_and_its_mend(rule: str, mended: str | None) -> None:
    document = Document("x.sparc", HEAD + rule + "\n")
    found = [fix for finding in document.findings for fix in fixes(document, finding)]
    if mended is None:
        assert document.findings and not found
        return
    (fix,) = found
    text = document.text[: fix.start] + fix.new + document.text[fix.end :]
    assert text == HEAD + mended + "\n"
    assert not [f for f in Document("x.sparc", text).findings if f.severity == "error"]


SECTIONS = "sorts\n#s = 1..2.\npredicates\np(#s).\nrules\np(1).\ndisplay\np.\n"


@pytest.mark.parametrize("word", ["sorts", "predicates", "rules"])
@pytest.mark.parametrize("written", ["", "{}:", "{}.", "{}x"])
def test_a_section_word_and_its_mend(word: str, written: str) -> None:
    """It is forgotten, misspelt, or has a sign behind it."""
    line = written.format(word)
    broken = SECTIONS.replace(f"{word}\n", f"{line}\n" if line else "", 1)
    document = Document("x.sparc", broken)
    (finding,) = document.findings
    assert finding.mend is not None
    (fix,) = fixes(document, finding)
    assert broken[: fix.start] + fix.new + broken[fix.end :] == SECTIONS
