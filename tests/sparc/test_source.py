"""Places: from offsets in a text to lines and columns of the files a person edits."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from sparc.source import Location, Origin, Source, Span


def test_lines_and_columns_count_from_one() -> None:
    source = Source("x", "ab\n\tc\n\nd")
    assert [str(source.location(offset)) for offset in range(8)] == [
        "x:1:1",
        "x:1:2",
        "x:1:3",
        "x:2:1",
        "x:2:2",
        "x:2:3",
        "x:3:1",
        "x:4:1",
    ]
    assert str(source.location(8)) == "x:4:2"


def test_the_end_of_the_text_has_a_place() -> None:
    assert Source("x", "").location(0) == Location("x", 1, 1)
    assert Source("x", "a\n").location(2) == Location("x", 2, 1)


def test_lines_of_text() -> None:
    source = Source("x", "ab\r\ncd\n\nlast")
    assert [source.line_text(at) for at in (0, 3, 4, 7, 8, 12)] == [
        "ab",
        "ab",
        "cd",
        "",
        "last",
        "last",
    ]


def test_first_line() -> None:
    source = Source("x", "a\nb", first_line=41)
    assert source.location(2) == Location("x", 42, 1)


def test_lines_from_other_files() -> None:
    origins = (
        None,
        Origin("layout.yaml", 7, 5, "    n1: [0, 1]"),
        Origin("domain.sparc", 30, verbatim=True),
    )
    source = Source("made", "own\nnode(n1).\n  p(X).\nrest", origins=origins)
    assert source.location(1) == Location("made", 1, 2)
    assert source.location(9) == Location("layout.yaml", 7, 5)
    assert source.location(16) == Location("domain.sparc", 30, 3)
    assert source.location(20) == Location("domain.sparc", 30, 7)
    assert source.location(23) == Location("made", 4, 2)
    assert source.origin(9) is origins[1]
    assert source.origin(23) is None


def test_spans() -> None:
    source = Source("x", "p(X) :- q.")
    head, body = Span(source, 0, 4), Span(source, 8, 9)
    assert head.text == "p(X)"
    assert head.to(body).text == "p(X) :- q"
    assert body.location == Location("x", 1, 9)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.text(alphabet="ab\n\r\t", max_size=30), st.data())
def test_places_agree_with_counting(text: str, data: st.DataObject) -> None:
    offset = data.draw(st.integers(0, len(text)))
    before = text[:offset]
    expected = (before.count("\n") + 1, offset - (before.rfind("\n") + 1) + 1)
    location = Source("x", text).location(offset)
    assert (location.line, location.column) == expected
    assert Source("x", text).line_text(offset) == text.split("\n")[expected[0] - 1].rstrip("\r")
