"""Tokens, section words, and what is no token."""

from __future__ import annotations

import pytest

from sparc.errors import LimitError, SparcSyntaxError
from sparc.source import Source
from sparc.syntax import lexer
from sparc.syntax.lexer import MAX_CHARACTERS, scan, tokenize


def kinds(text: str) -> list[str]:
    return [token.kind for token in tokenize(Source("x", text))]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", []),
        (" \t\r\n", []),
        ("% all comment", []),
        ("aB_1 X _ _ 0 17", ["identifier", "variable", "variable", "variable", "number", "number"]),
        ("#s #count#nat", ["sort name", "sort name", "sort name"]),
        ("# s", ["#", "identifier"]),
        ("not nota not%x", ["not", "identifier", "not"]),
        ("or and orb", ["or", "and", "identifier"]),
        ("1..3.", ["number", "..", "number", "."]),
        ("p:-q:+r:~s:t", ["identifier", ":-", "identifier", ":+"]
            + ["identifier", ":~", "identifier", ":", "identifier"]),
        ("= == != < <= > >=", ["=", "==", "!=", "<", "<=", ">", ">="]),
        ("+-*/|@;,(){}[]", list("+-*/|@;,(){}[]")),
        ("X=<Y", ["variable", "=", "<", "variable"]),
        ("p%q\nr%s\rt", ["identifier", "identifier", "identifier"]),
    ],
)  # fmt: skip
def test_kinds(text: str, expected: list[str]) -> None:
    assert kinds(text) == expected


@pytest.mark.parametrize("word", ["sorts", "predicates", "rules", "display"])
def test_section_words(word: str) -> None:
    for behind in (" ", "\t", "\r", "\n", "% note", ""):
        assert kinds(word + behind) == ["section"]
    for behind in (".", ")", "}", ":-", "#a"):
        assert kinds(word + behind)[0] == "identifier"
    assert kinds(f"#{word} x{word} {word}x") == ["sort name", "identifier", "identifier"]
    both = kinds(f"{word} {word}(X) {word} {word}")
    assert both == ["section", "identifier", "(", "variable", ")", "section", "section"]


def test_spans_cover_the_text() -> None:
    text = "p(X) :- not q(X, 17). % größe\n\t#s(X).\r\n"
    tokens = tokenize(Source("x", text))
    assert [token.span.text for token in tokens] == [token.text for token in tokens]
    assert " ".join(token.text for token in tokens) == ("p ( X ) :- not q ( X , 17 ) . #s ( X ) .")
    places = [str(token.span.location) for token in tokens]
    assert places[:3] == ["x:1:1", "x:1:2", "x:1:3"]
    assert places[-5:] == ["x:2:2", "x:2:4", "x:2:5", "x:2:6", "x:2:7"]


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("\ufeffsorts", 1, "byte-order mark"),
        ("a \f b", 3, "form feed"),
        ("a \v b", 3, "vertical tab"),
        ("a\xa0b", 2, "no-break space"),
        ("a\x00", 2, "NUL"),
        ("a\x1b[0m", 2, "U+001B"),
        ("größe", 3, "(U+00F6) is no ASCII character"),
        ("a \U0001f642", 3, "U+1F642"),
        ("a \ud800", 3, "U+D800"),
        ("\u0661", 1, "U+0661"),
        ('"a"', 1, "no strings"),
        ("'a'", 1, "no quotes"),
        ("a\\b", 2, "no modulo"),
        ("a^b", 2, "no power"),
        ("~a", 1, '":~"'),
        ("!a", 1, '"!="'),
        ("a $", 3, '"$"'),
        ("`", 1, "has no meaning"),
        ("007", 1, "no leading zero"),
        ("2x", 1, "neither a number nor a name"),
        ("_x", 1, "begins with a letter"),
        ("__", 1, "begins with a letter"),
        ("#S", 1, "lower-case letter"),
        ("#1", 1, "lower-case letter"),
        ("#_", 1, "lower-case letter"),
        ("#or", 1, "reserved word"),
    ],
)
def test_what_is_no_token(text: str, column: int, message: str) -> None:
    with pytest.raises(SparcSyntaxError) as info:
        tokenize(Source("x", text))
    assert message in info.value.message
    assert info.value.span is not None
    assert info.value.span.location.column == column
    assert info.value.message.isprintable()


def test_any_character_may_stand_in_a_comment() -> None:
    assert kinds("a % größe \f \x00 \ufeff 🙂 \"'\\\nb") == ["identifier", "identifier"]


def test_the_size_is_limited() -> None:
    assert len(scan(Source("x", " " * MAX_CHARACTERS)).kinds) == 4
    with pytest.raises(LimitError, match="8,000,001 characters"):
        scan(Source("x", " " * (MAX_CHARACTERS + 1)))


@pytest.mark.parametrize(
    "text",
    [
        "p(a,#s,X1):-q(b,c),not r(_,17),X!=Y.",
        "p(a, % one, two (and more), three\n b),%,\n,c.",
        "p(a, b) % (,\r, q(c)\n, d",
        "".join(f"p(abc{n},X{n})..," for n in range(20)),
        "abcdefgh ijklmnop#sort",
    ],
)
def test_the_parts_that_are_cut_at_a_time_make_no_difference(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = scan(Source("x", text))
    for size in range(len(text)):
        monkeypatch.setattr(lexer, "_STRETCH", size)
        assert scan(Source("x", text)) == whole, size


def test_a_long_line_is_cut_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """A limit is looked at between two parts only."""
    monkeypatch.setattr(lexer, "_STRETCH", 100)
    text = "p(a,b)." * 1000
    assert max(end - start for start, end in lexer._stretches(text)) < 110
    assert len(list(lexer._stretches("% " + text))) == 1
