"""What hover and completion say, also of a text with faults."""

from __future__ import annotations

import pytest

from sparc.language_server.document import Document
from sparc.language_server.editor_answers import complete, hover

TEXT = """\
#const n = 3.
sorts
#room = {hall, bar}.
#thing = {cup, jug}.
#act = move(#thing, #room) + rest(#thing).
predicates
at(#thing, #room).
does(#act).
free(#room).
rules
free(R) :- #room(R), not at(cup, R).
free(Q) :- at(cup, bar), #room(Q).
does(move(T, W)) :- at(T, bar), W != bar.
"""
FAULTS = {
    "none": "",
    "in a rule": "free(R) :- at(R.\n",
    "two": "free(R) :- at(R.\n\nfree(( .\n",
    "in a type": "free(cup).\n",
    "at the end": ":- not",
}


@pytest.mark.parametrize("fault", FAULTS.values(), ids=FAULTS)
@pytest.mark.parametrize(
    ("place", "behind", "told"),
    [
        ("(R) :-", 1, "R : #room"),
        ("(Q) :-", 1, "Q : #room"),
        ("W !=", 0, "W : #room"),
        ("T, W", 0, "T : #thing"),
        ("#room(R)", 1, "#room = {hall, bar}"),
        ("at(cup, R)", 0, "at(#thing, #room)."),
        ("n = 3", 0, "#const n = 3."),
        ("jug", 0, "jug in #thing"),
    ],
)
def test_hover(fault: str, place: str, behind: int, told: str) -> None:
    document = Document("x.sparc", TEXT + fault)
    assert bool(fault) == any(each.severity == "error" for each in document.findings)
    assert told in (hover(document, TEXT.index(place) + behind) or "")


@pytest.mark.parametrize(
    ("line", "proposed"),
    [
        ("free(", {"hall", "bar"}),
        ("at(cup, ", {"hall", "bar"}),
        ("does(move(", {"cup", "jug"}),
        ("does(move(cup, ", {"hall", "bar"}),
        ("free(R) :- at(", {"cup", "jug"}),
        ("free(R) :- at(cup, R), #room(", {"hall", "bar"}),
    ],
)
def test_an_argument_is_completed_in_a_file_that_was_opened_so(
    line: str, proposed: set[str]
) -> None:
    document = Document("x.sparc", TEXT + line)
    found = complete(document, len(TEXT + line))
    assert {each.text for each in found if each.kind == "value"} == proposed


def test_what_a_fault_takes_away_is_remembered() -> None:
    before = Document("x.sparc", TEXT)
    broken = TEXT.replace("at(#thing, #room).", "at(#thing, #room")
    after = Document("x.sparc", broken, before)
    assert hover(after, broken.index("at(cup")) == "```sparc\nat(#thing, #room).\n```"
    gone = TEXT.replace("at(#thing, #room).\n", "").split("rules")[0] + "rules\n"
    assert "at" not in Document("x.sparc", gone, after).declared.predicates
