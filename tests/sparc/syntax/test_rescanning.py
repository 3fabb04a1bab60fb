"""A changed text is cut into the tokens of the whole text, whatever was changed in it."""

from __future__ import annotations

import random

import pytest

from sparc.errors import LimitError
from sparc.source import Source
from sparc.syntax import rescanning
from sparc.syntax.lexer import scan
from sparc.syntax.rescanning import rescan

TEXT = "p(a).  % one\nq(b) :- p(X),\n    not r(X).\n\nr(c)."


def again(old: str, new: str) -> rescanning.Rescan:
    return rescan(Source("x", new), Source("x", old), scan(Source("x", old)))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (TEXT, TEXT),
        (TEXT, TEXT.replace("q(b)", "q(bb)")),
        (TEXT, TEXT.replace("\n\n", "\n")),
        (TEXT, TEXT.replace("\n", "")),
        (TEXT, TEXT + "\ns."),
        (TEXT, TEXT[:-1]),
        (TEXT, "% " + TEXT),
        (TEXT, ""),
        ("", TEXT),
        (TEXT, TEXT.replace("p(a).", "p(a). p(a).")),
        ("p.\np.\np.", "p.\np.\np.\np."),
        ("p.\n%", "p.\n% p.\n%"),
        ("ab", "a\nb"),
        ("a\nb", "ab"),
        (TEXT, TEXT.replace("not", "no\tt é \"")),
    ],
    ids=["nothing", "a name", "a blank line", "all on one line", "a line more", "the last dot",
         "a comment", "all gone", "all new", "twice the same", "one of many", "a comment more",
         "a line broken", "lines joined", "no tokens"],
)  # fmt: skip
def test_the_tokens_are_those_of_the_whole(old: str, new: str) -> None:
    before, found = scan(Source("x", old)), again(old, new)
    assert found.lexemes == scan(Source("x", new))
    for part, kept in zip(before, found.lexemes, strict=True):
        if isinstance(part[0] if part else "", str):  # kinds and texts, not places
            assert part[: found.front] == kept[: found.front]
            assert part[found.back :] == kept[found.back + found.moved :]


def test_the_lines_around_a_change_are_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []
    known = scan(Source("x", TEXT))
    monkeypatch.setattr(rescanning, "scan", lambda source: read.append(source.text) or scan(source))
    rescan(Source("x", TEXT.replace("X)", "Y)", 1)), Source("x", TEXT), known)
    assert read == ["q(b) :- p(Y),\n"]


def test_any_edit_of_many() -> None:
    random_ = random.Random(7)
    pieces = ["", "\n", "% x", "p(X).", " ", "#", "..", "é", "\r\n", '"']
    text = TEXT
    for _ in range(300):
        start = random_.randrange(len(text) + 1)
        end = min(len(text), start + random_.choice((0, 1, 1, 3, 9)))
        new = text[:start] + random_.choice(pieces) + text[end:]
        assert again(text, new).lexemes == scan(Source("x", new)), (text, new)
        text = new if 10 < len(new) < 200 else TEXT


def test_a_text_that_grew_too_large_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sparc.syntax.lexer.MAX_CHARACTERS", len(TEXT))
    monkeypatch.setattr(rescanning, "MAX_CHARACTERS", len(TEXT))
    with pytest.raises(LimitError):
        again(TEXT, TEXT + " ")
