"""Why a literal is in an answer set or not: as lines for people, and as a document."""

from __future__ import annotations

import sparc
from sparc.explaining.why import why_query
from waiter_cli.answersets.why_document import why_document

BIRDS = """\
sorts
#animal = {tweety, sam}.
predicates
bird(#animal). penguin(#animal). flies(#animal).
rules
% Sam is a penguin.
penguin(sam).
bird(tweety).
bird(X) :- penguin(X).
flies(X) :- bird(X), not penguin(X).
"""
TYPED = sparc.check(sparc.parse(BIRDS))


def test_what_supports_a_literal_stands_below_it_indented() -> None:
    lines = list(why_query(TYPED, "bird(sam)")[0].lines())
    assert lines[0] == "bird(sam) is in the answer set, because:"
    texts = [line.strip() for line in lines]
    assert texts.index("bird(sam)") < texts.index("penguin(sam)")
    indents = {line.strip(): len(line) - len(line.lstrip()) for line in lines}
    assert indents["bird(sam)"] < indents["penguin(sam)"]


def test_what_is_missing_is_told_with_each_rule_that_fails() -> None:
    lines = list(why_query(TYPED, "flies(sam)")[0].lines())
    assert lines[0] == "flies(sam) is not in the answer set."
    text = "\n".join(lines)
    assert "flies(X) :- bird(X), not penguin(X)." in text
    assert "fails: not penguin(sam)" in text
    assert "penguin(sam) is there:" in text


def test_the_document_says_the_same() -> None:
    there = why_document(why_query(TYPED, "bird(sam)"))
    assert (there["literal"], there["holds"], there["set"]) == ("bird(sam)", True, 1)
    assert there["because"]["premises"][0]["literal"] == "penguin(sam)"
    assert there["because"]["rule"]["line"] == 9
    missing = why_document(why_query(TYPED, "flies(sam)"))
    assert missing["holds"] is False
    (failed,) = missing["because_not"]
    assert failed["failed"] == "not penguin(sam)"
    assert failed["then"]["literal"] == "penguin(sam)" and failed["then"]["holds"]


def test_the_sentence_above_a_rule_is_said() -> None:
    (leaf,) = why_document(why_query(TYPED, "penguin(sam)"))["because"]["premises"] or [
        why_document(why_query(TYPED, "penguin(sam)"))["because"]
    ]
    assert leaf["rule"]["sentence"] == "Sam is a penguin."


def test_an_answer_set_that_is_not_there() -> None:
    document = why_document(why_query(TYPED, "bird(sam)", number=2))
    assert document["holds"] is None and "because" not in document


def test_several_literals_are_a_list_of_such_documents() -> None:
    (there, fitting) = why_document(why_query(TYPED, "penguin(X), bird(X)"))["literals"]
    assert there == why_document(why_query(TYPED, "penguin(sam)"))
    assert fitting == why_document(why_query(TYPED, "bird(sam)"))
