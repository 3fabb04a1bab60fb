"""Cuts SPARC text into words and signs: Source → Lexemes, or Source → tuple of Token.

Entry points: :func:`scan` for the parser (parallel lists, no places computed) and
:func:`tokenize` for people and tools.  White space and comments (``%`` to the end of the line)
part the tokens and are dropped.

>>> [token.kind for token in tokenize(Source("x", "p(X) :- not q(X, 7). % note"))][:6]
['identifier', '(', 'variable', ')', ':-', 'not']

Follows the SPARC manual, Syntax: identifiers, variables, numbers, section words.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import accumulate, chain
from typing import NamedTuple

from sparc.errors import LimitError, SourceError, SparcSyntaxError
from sparc.source import Source, Span

__all__ = [
    "MAX_CHARACTERS",
    "SECTION_WORDS",
    "Lexemes",
    "Token",
    "lexical_error",
    "scan",
    "tokenize",
]

MAX_CHARACTERS = 8_000_000
"""A longer program is refused: its tree would take a gigabyte."""

_STRETCH = 100_000  # characters that are cut in one call, and those up to the next place to part
_PART = re.compile(r"[\n(),]")  # a line end, and signs that are in no longer token

SECTION_WORDS = ("sorts", "predicates", "rules", "display")
"""Words that open a section where white space, a comment or the end of the text follows."""

# One match is the white space and comments before a token, and the token.  Whatever is no white
# space is some token, if only a single strange character, so a match never has to be taken back
# and the time stays linear.
_TOKEN = re.compile(
    r"([ \t\r\n]*(?:%[^\r\n]*[ \t\r\n]*)*)"
    r"(\w+|[(),]|#\w+|\.\.|:[-+~]|[<>!=]=|[^ \t\r\n]|\Z)",
    re.ASCII,
)
_SPACE = " \t\r\n%"
_SIGNS = (
    ".", "..", ",", ";", ":", ":-", ":+", ":~", "|", "@", "#", "(", ")", "{", "}", "[", "]",
    "=", "==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/",
)  # fmt: skip
_FIXED = {
    "": "end",
    "_": "variable",
    "not": "not",
    "and": "and",
    "or": "or",
    "#and": "bad",
    "#or": "bad",
    **{sign: sign for sign in _SIGNS},
}


class Token(NamedTuple):
    """A word or sign of the text.

    ``kind`` is ``identifier``, ``variable``, ``number``, ``sort name`` (``#`` included: also
    ``#const``, ``#count`` and the like), ``section``, ``end``, or the word or sign itself
    (``not``, ``:-``, ``(`` …).
    """

    kind: str
    text: str
    span: Span


class Lexemes(NamedTuple):
    """The tokens of a source as parallel lists; the last ones are of kind ``end``.

    A stretch that is no token of the language has the kind ``bad``; :func:`lexical_error`
    says what is wrong with it.
    """

    kinds: list[str]
    texts: list[str]
    starts: list[int]


class _Kinds(dict[str, str]):
    """The kind of each token text, worked out the first time the text is met."""

    def __missing__(self, text: str) -> str:
        kind = self[text] = _kind(text)
        return kind


def _kind(text: str) -> str:
    """Returns the kind of a token that is no sign and no reserved word."""
    first = text[0]
    if "a" <= first <= "z":
        return "identifier"
    if "A" <= first <= "Z":
        return "variable"
    if "0" <= first <= "9":
        return "number" if text == "0" or (first != "0" and text.isdigit()) else "bad"
    if first == "#" and "a" <= text[1:2] <= "z":
        return "sort name"
    return "bad"


def scan(source: Source) -> Lexemes:
    """Returns the tokens of ``source`` with four ``end`` tokens behind them, for looking ahead.

    Raises :class:`LimitError` when the text has more than ``MAX_CHARACTERS`` characters.
    """
    text = source.text
    if len(text) > MAX_CHARACTERS:
        raise LimitError(
            f"the program has {len(text):,} characters, more than {MAX_CHARACTERS:,}",
            Span(source, 0, 0),
            "split it, or leave out what is not needed",
        )
    kinds: list[str] = []
    texts: list[str] = []
    starts: list[int] = []
    known = _Kinds(_FIXED)
    for at, end in _stretches(text):
        pieces = _TOKEN.findall(text, at, end)
        # Offsets: of the space, its token, the next space …; every second one begins a token.
        offsets = list(accumulate(map(len, chain.from_iterable(pieces)), initial=at))
        found = [piece[1] for piece in pieces]
        size = found.index("")  # the end of the stretch, which may be met twice
        kinds += map(known.__getitem__, found[:size])
        texts += found[:size]
        starts += offsets[1 : 2 * size : 2]
    kinds += ("end",) * 4
    texts += ("",) * 4
    starts += (len(text),) * 4
    for word in SECTION_WORDS:
        at = -1
        for _ in range(texts.count(word)):
            at = texts.index(word, at + 1)
            end = starts[at] + len(word)
            if end == len(text) or text[end] in _SPACE:
                kinds[at] = "section"
    return Lexemes(kinds, texts, starts)


def _stretches(text: str) -> Iterator[tuple[int, int]]:
    """Yields where stretches begin and end, none of them inside a token or a comment.

    Cutting one into tokens is a single call, during which no limit is looked at.
    """
    at = 0
    while at < len(text):
        end = _end(text, at)
        yield at, end
        at = end


def _end(text: str, start: int) -> int:
    """Returns where a stretch ends: behind a line, or behind a comma or bracket outside a comment."""
    found = _PART.search(text, start + _STRETCH)
    if found is None:
        return len(text)
    line = text.rfind("\n", start, found.start()) + 1 or start
    if text.find("%", line, found.start()) >= 0:
        return text.find("\n", found.start()) + 1 or len(text)
    return found.end()


def tokenize(source: Source) -> tuple[Token, ...]:
    """Returns the tokens of ``source`` in order, without the end.

    Raises :class:`SparcSyntaxError` for the first stretch that is no token.
    """
    tokens = []
    for kind, text, start in zip(*scan(source)):
        if kind == "end":
            break
        if kind == "bad":
            raise lexical_error(source, start, text)
        tokens.append(Token(kind, text, Span(source, start, start + len(text))))
    return tuple(tokens)


_STRANGE = {
    '"': ("there are no strings in SPARC", "write an identifier, such as main_hall"),
    "'": ("there are no quotes in SPARC", "write an identifier, such as main_hall"),
    "\\": ("there is no modulo operator", "X \\ Y is X - X/Y*Y"),
    "~": ('"~" stands only in ":~"', 'a literal is negated by "not", or by "-"'),
    "!": ('"!" stands only in "!="', 'a literal is negated by "not", or by "-"'),
    "$": ('"$" is no character of SPARC', None),
    "&": ('"&" is no character of SPARC', "write a comma between literals"),
    "?": ('"?" is no character of SPARC', None),
    "^": ("there is no power operator", "write the product out: X*X"),
    "\ufeff": (
        "a byte-order mark stands here",
        "save the file as UTF-8 without a byte-order mark (BOM)",
    ),
    "\f": ("a form feed stands here", "only space, tab and line ends part words: delete it"),
    "\v": ("a vertical tab stands here", "only space, tab and line ends part words: delete it"),
    "\xa0": ("a no-break space stands here", "write an ordinary space"),
    "\ufffd": (
        "a byte that is no UTF-8 stands here",
        "save the file as UTF-8; letters beyond a-z, A-Z stand only in comments",
    ),
    "\x00": ("a NUL character stands here", "is this a text file, saved as UTF-8?"),
}  # fmt: skip


# Signs of other languages, the longer ones first, and what to write for them.
_FOREIGN_SIGNS = {
    "\\+": 'write "not"',
    "\\=": 'write "!="',
    "=\\=": 'write "!="',
    "&&": "write a comma between literals",
    "\u2227": "write a comma between literals",
    "\u2228": 'write "|" in a head',
    "\u00ac": 'write "not", or "-" for strong negation',
    "\u2260": 'write "!="',
    "\u2264": 'write "<="',
    "\u2265": 'write ">="',
    "\u2190": 'write ":-"',
    "\u2026": 'write ".."',
    "\u00d7": 'write "*"',
    "\u00b7": 'write "*"',
    "\u00f7": 'write "/"',
    "\u2208": "a sort is tested by its sort atom: #s(X)",
    "\u2200": "derive the exception by a rule, and write not exception",
    "\u2203": "a variable of the body is enough: there is such an element",
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212", 'this is another dash: write "-"'),
    **dict.fromkeys("\u2018\u2019\u201a\u201c\u201d\u201e\xab\xbb", "write an identifier, without quotes"),
    **dict.fromkeys("\u200b\u200c\u200d\u2060\xad", "it cannot be seen: delete it"),
    **dict.fromkeys("\u2002\u2003\u2007\u2009\u202f\u3000", "write an ordinary space"),
}  # fmt: skip


def _foreign_sign(source: Source, start: int) -> tuple[str, str, int] | None:
    """Returns the message, the mend and the length of a sign of another language, if
    one stands here.
    """
    for sign, mend in _FOREIGN_SIGNS.items():
        if source.text.startswith(sign, start):
            shown = f'"{sign}"' if sign.isprintable() else f"U+{ord(sign):04X}"
            code = f" (U+{ord(sign):04X})" if sign.isprintable() and not sign.isascii() else ""
            return f"{shown}{code} has no meaning in SPARC", mend, len(sign)
    return None


def lexical_error(source: Source, start: int, text: str) -> SourceError:
    """Returns the error of the stretch ``text`` at ``start``, which is no token."""
    span = Span(source, start, start + len(text))
    if text in ("#or", "#and"):
        word = text[1:]
        return SparcSyntaxError(
            f'"{word}" is a reserved word and cannot name a sort', span, f"write #{word}_ instead"
        )
    first = text[0]
    sign = _foreign_sign(source, start)
    if sign is not None:
        return SparcSyntaxError(sign[0], Span(source, start, start + sign[2]), sign[1])
    if first == "#":
        found = "a capital letter" if text[1:2].isalpha() else f'"{text[1]}"'
        return SparcSyntaxError(
            f'a sort name begins with a lower-case letter, found {found} in "{text}"',
            span,
            f"write #{text[1].lower()}{text[2:]}" if text[1:2].isalpha() else None,
        )
    if first == "_":
        return SparcSyntaxError(
            f'a name begins with a letter, found "{text}"',
            span,
            'identifiers begin with a lower-case letter, variables with a capital; "_" stands alone',
        )
    if first.isdigit() and first.isascii():
        if text.isdigit():
            plain = text.lstrip("0") or "0"
            return SparcSyntaxError(
                f'a number has no leading zero, found "{text}"', span, f"write {plain}"
            )
        return SparcSyntaxError(
            f'"{text}" is neither a number nor a name',
            span,
            "a name begins with a letter; if these are two words, part them",
        )
    if first in _STRANGE:
        message, hint = _STRANGE[first]
    elif first.isascii():
        message, hint = f'the character "{first}" has no meaning in SPARC', None
        if not first.isprintable():
            message = f"the control character U+{ord(first):04X} stands here"
            hint = "only space, tab and line ends part words: delete it"
    else:
        shown = f'"{first}" ' if first.isprintable() else ""
        message = f"the character {shown}(U+{ord(first):04X}) is no ASCII character"
        hint = "letters beyond a-z, A-Z stand only in comments"
    return SparcSyntaxError(message, span, hint)
