"""One text that is being edited: its faults, its names, and what was declared before."""

from __future__ import annotations

from sparc.language_server.document import Document
from sparc.language_server.symbols import Occurrence

TEXT = """\
sorts
#s = {a, b}.
predicates
p(#s).
q(#s). % What is wanted.
rules
% It follows
% from the other.
p(X) :- q(X).
p(Y) :- q(Y).
q(X) :- p(X).
"""


def at(document: Document, text: str, number: int = 0) -> Occurrence:
    """The name at the beginning of a text, of those places where it stands."""
    offset = -1
    for _ in range(number + 1):
        offset = document.text.index(text, offset + 1)
    found = document.at(offset)
    assert found is not None
    return found


def test_a_program_in_order_has_no_faults() -> None:
    document = Document("p.sparc", TEXT)
    assert not [each for each in document.findings if each.severity == "error"]
    assert set(document.declared.predicates) >= {"p", "q"} and "s" in document.declared.sorts


def test_a_fault_has_its_stretch() -> None:
    document = Document("p.sparc", TEXT.replace("q(Y).", "r(Y)."))
    fault = next(each for each in document.findings if each.severity == "error")
    assert document.text[fault.start : fault.end].startswith("r")


def test_while_there_are_faults_what_was_declared_before_is_known() -> None:
    before = Document("p.sparc", TEXT)
    broken = Document("p.sparc", TEXT.replace("p(#s).\n", "p(#s\n"), before)
    assert "p" in broken.declared.predicates
    assert "p" not in Document("p.sparc", TEXT.replace("p(#s).\n", "\n")).declared.predicates


def test_a_name_is_found_at_its_letters_and_behind_them() -> None:
    document = Document("p.sparc", TEXT)
    start = TEXT.index("q(#s)")
    assert document.at(start) == document.at(start + 1)
    assert document.at(TEXT.index("{")) is None


def test_a_predicate_is_the_same_everywhere_and_a_variable_in_its_statement() -> None:
    document = Document("p.sparc", TEXT)
    assert len(document.same(at(document, "p(#s)"))) == 4
    assert len(document.same(at(document, "X)"))) == 2
    declaration = document.definition(at(document, "q(Y)"))
    assert declaration is not None and declaration.start == TEXT.index("q(#s)")
    variable = document.definition(at(document, "X)", 1))
    assert variable is not None and variable.start == TEXT.index("X)")


def test_a_name_that_is_there_already_would_be_joined() -> None:
    document = Document("p.sparc", TEXT)
    assert document.has(at(document, "p(#s)"), "q") and not document.has(at(document, "p(#s)"), "r")
    assert not document.has(at(document, "X)"), "Y"), "it is of another statement"


def test_the_sentence_of_a_place_is_above_it_or_behind_it() -> None:
    document = Document("p.sparc", TEXT)
    assert document.sentence(TEXT.index("p(X)")) == "It follows from the other."
    assert document.sentence(TEXT.index("q(#s)")) == "What is wanted."
    assert document.sentence(TEXT.index("sorts")) is None


def test_line_ends_leave_every_offset() -> None:
    document = Document("p.sparc", TEXT.replace("\n", "\r\n"))
    assert len(document.text) == len(TEXT) + TEXT.count("\n")
    assert not [each for each in document.findings if each.severity == "error"]
