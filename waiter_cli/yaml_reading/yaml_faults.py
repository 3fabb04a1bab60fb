"""Explains the faults of a text that is no YAML, by the text itself.  Entry points
`forbidden` and `explain`.

The parser says only *where* it stopped; its words differ from version to version, and so do the
limits it has of its own.  What stands at that place is found here: a bracket or a quote that is
not closed, a name that is too long, a tab, a colon too many.
"""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["MAX_DEPTH", "MAX_KEY", "Trouble", "explain", "forbidden", "lines_of", "place_of"]

MAX_DEPTH = 40
MAX_KEY = 1024
"""YAML 1.1 and 1.2 (section 7.4.2): a key on one line has at most so many characters."""

_FORBIDDEN = re.compile(
    "[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"
)  # all but c-printable of YAML 1.2, section 5.1
_BAD_ESCAPE = re.compile(
    r"\\(?:[0abt\tnvfre \"/\\N_LP\n]|x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8})|(\\)"
)
_QUOTED = {"'": re.compile(r"'(?:[^']|'')*'"), '"': re.compile(r'"(?:[^"\\]|\\.)*"', re.S)}
_PLAIN = re.compile(r"(?:[^\s:#]|:(?=\S)|(?<=\S)#|[ \t]+(?=[^\s#]))+")
_PLAIN_IN_FLOW = re.compile(
    r"(?:[^\s:#,\[\]{}]|:(?=[^\s,\[\]{}])|(?<=\S)#|[ \t]+(?=[^\s#,\[\]{}]))+"
)
_INDENT = re.compile(r"[ \t]*")
_FIT = "this line does not fit the lines above it"
_FIT_HINT = "indent it like its neighbours, as key: value; a list of lists is [[a, b], [b, c]]"


class Trouble(NamedTuple):
    """A fault at a place of the text (an index), and the mend."""

    at: int
    message: str
    hint: str | None = None


class _Reading(NamedTuple):
    """The brackets and quotes that are open at the end of the text that was read."""

    brackets: tuple[int, ...]
    quote: int | None
    too_deep: int | None


def lines_of(text: str) -> tuple[str, ...]:
    """Returns the lines as YAML counts them (it knows more line ends than ``\\n``)."""
    return tuple(_one_line_end(text).split("\n"))


def _one_line_end(text: str) -> str:
    for end in ("\r\n", "\r", "\x85", "\u2028", "\u2029"):
        text = text.replace(end, "\n")
    return text


def place_of(text: str, index: int) -> tuple[int, int]:
    """Returns line and column of an index, both from 0."""
    before = lines_of(text[:index])
    return len(before) - 1, len(before[-1])


def forbidden(text: str) -> Trouble | None:
    """Returns the first character that no YAML file may hold."""
    match = _FORBIDDEN.search(text)
    if match is None:
        return None
    if "\ud800" <= match[0] <= "\udfff":
        return Trouble(match.start(), "the text holds characters that are no Unicode")
    return Trouble(match.start(), "a control character that YAML does not allow", "remove it")


def explain(text: str, line: int, column: int, key_line: int | None) -> tuple[int, int, Trouble]:
    """Returns line and column (from 0) of the fault at which a parser stopped, and the fault.

    ``key_line`` is the line on which the construct began that the parser could not finish, where
    it tells one.
    """
    text = _one_line_end(text)
    lines = text.split("\n")
    if line >= len(lines):  # the end of a text without a last line end
        line, column = len(lines) - 1, len(lines[-1])
    at = sum(len(one) + 1 for one in lines[:line]) + min(column, len(lines[line]))
    trouble = _judge(text, at, lines, line, key_line)
    return *place_of(text, trouble.at), trouble


def _judge(text: str, at: int, lines: list[str], line: int, key_line: int | None) -> Trouble:
    reading = _read(text, at)
    if reading.too_deep is not None:
        return Trouble(reading.too_deep, f"nested more than {MAX_DEPTH} deep")
    start = at - len(text[:at].rpartition("\n")[2])
    return (
        _long_key(text, at, start)
        or _quote(text, reading)
        or _character(text, at, start)
        or _bracket(text, at, reading)
        or _colon(text, at)
        or _place_in_line(text, at, start, lines, line)
        or _key(lines, line, key_line)
        or Trouble(
            at, "no YAML here", "check the colons, quotes and indentation, of the line before, too"
        )
    )


def _long_key(text: str, at: int, start: int) -> Trouble | None:
    """Returns a name before a colon that is longer than a key may be; the parser stops at its end."""
    begin = max(start, at - 4 * MAX_KEY) if at - start > 8 * MAX_KEY else start
    for found in re.finditer(r"\"(?:[^\"\\]|\\.)*\"|'(?:[^']|'')*'|[^\s,\[\]{}:]+", text[begin:at]):
        if len(found[0]) > MAX_KEY:
            message = f"a name of {len(found[0])} characters, at most {MAX_KEY} are read"
            return Trouble(begin + found.start(), message, "give it a shorter one")
    return None


def _quote(text: str, reading: _Reading) -> Trouble | None:
    if reading.quote is None:
        return None
    whole = _QUOTED[text[reading.quote]].match(text, reading.quote)
    if whole is None:
        return Trouble(reading.quote, "the quote that opens here is never closed", "close it")
    bad = next((found for found in _BAD_ESCAPE.finditer(whole[0]) if found[1]), None)
    if text[reading.quote] == '"' and bad is not None:
        where = reading.quote + bad.start()
        return Trouble(where, "an unknown escape after \\", "use '...' for text with \\")
    return None


def _character(text: str, at: int, start: int) -> Trouble | None:
    """Returns the fault of the character at which the parser stopped, or of a tab before it."""
    here = text[at : at + 1]
    indent = _INDENT.match(text, start)
    tab = text.find("\t", start, max(indent.end() if indent else start, at + 1))
    if tab >= 0 and not text[start:tab].strip(" -?:"):
        return Trouble(tab, "a tab where YAML wants spaces", "indent with spaces")
    if here == "\t":
        return Trouble(at, "a tab where YAML wants spaces", "indent with spaces")
    if here and here in "@`%":
        return Trouble(at, f"a value cannot begin with {here}", "put it in quotes")
    if here == "!":
        return Trouble(at, "tags (!) are not read here", "leave it out or use quotes")
    if here and here in "&*":
        message = "anchors and aliases (& and *) are not read here"
        return Trouble(at, message, "write the value out")
    return None


def _colon(text: str, at: int) -> Trouble | None:
    if text[at : at + 1] == ":":
        hint = (
            "check its indentation and the colon of the line before; quote text that holds a colon"
        )
        return Trouble(at, "a colon that fits no key here", hint)
    return None


def _bracket(text: str, at: int, reading: _Reading) -> Trouble | None:
    here = text[at : at + 1]
    if reading.brackets:
        opened = reading.brackets[-1]
        what, end = ("list", "]") if text[opened] == "[" else ("mapping", "}")
        left = _read(text, len(text)).brackets
        if opened in left or (here and here in "]}" and here != end):
            message = f"the {what} that opens here is not closed"
            return Trouble(opened, message, f"expected , or {end}")
        if here == ":":
            return None
        line, column = place_of(text, opened)
        message = f"this does not fit the {what} that opens at {line + 1}:{column + 1}"
        return Trouble(at, message, f"expected , or {end}")
    if here and here in "]},":
        return Trouble(at, "a value was expected here")
    return None


def _place_in_line(text: str, at: int, start: int, lines: list[str], line: int) -> Trouble | None:
    before = text[start:at]
    if any(one.rstrip() == "..." for one in lines[:line]):
        hint = "check the indentation of this line"
        return Trouble(at, "text after the end of the document", hint)
    if before.strip():
        if re.match(r"-(?:\s|$)", text[at:]):
            message = "a list may not begin with - in the middle of a line"
            return Trouble(at, message, "begin it on a line of its own, or write [a, b]")
        return None
    if at >= len(text) or not text[at].strip():
        return None
    above = [one for one in lines[:line] if one.strip() and not one.lstrip().startswith("#")]
    same = [one for one in above if len(one) - len(one.lstrip()) == len(before)]
    if same and same[-1].lstrip().startswith("- ") and not text[at:].startswith("- "):
        hint = "begin it with - or indent it like its neighbours"
        return Trouble(at, "this line does not fit the list above it", hint)
    return None


def _key(lines: list[str], line: int, key_line: int | None) -> Trouble | None:
    """Returns a line of its own where a key was due: without a colon, or with an
    indentation of its own.
    """
    began = sum(len(one) + 1 for one in lines[:line])
    if key_line is not None and key_line < line:
        words = lines[key_line].strip()
        if words and not re.search(r":(\s|$)", words) and words[0] not in "-[{'\"":
            at = sum(len(one) + 1 for one in lines[:key_line])
            at += len(lines[key_line]) - len(lines[key_line].lstrip())
            return Trouble(at, "a key without a colon", "write it as key: value")
    if line and lines[line].strip():
        indent = len(lines[line]) - len(lines[line].lstrip())
        return Trouble(began + indent, _FIT, _FIT_HINT)
    return None


def _read(text: str, end: int) -> _Reading:
    """Returns the brackets and the quote that are open at an index, by the rules for
    where a token begins.

    Block scalars and comments hold no tokens; inside a plain scalar no quote and, outside of
    brackets, no bracket counts.
    """
    at, chain, brackets = 0, 0, list[int]()
    while at < end:
        here = text[at]
        if here == "\n":
            chain, at = 0, at + 1
        elif here in " \t":
            at += 1
        elif here == "#":
            at = _line_end(text, at)
        elif here in "\"'":
            whole = _QUOTED[here].match(text, at)
            if whole is None or whole.end() > end:
                return _Reading(tuple(brackets), at, None)
            at = whole.end()
        elif here in "[{":
            brackets.append(at)
            if len(brackets) + chain > MAX_DEPTH:
                return _Reading(tuple(brackets), None, at)
            at += 1
        elif here in "]}," and brackets:
            if here != ",":
                brackets.pop()
            at += 1
        elif here in "-?:" and (at + 1 >= len(text) or text[at + 1] in " \t\n,[]{}"):
            chain += not brackets
            if chain > MAX_DEPTH:
                return _Reading(tuple(brackets), None, at)
            at += 1
        elif here in "|>" and not brackets:
            at = _after_block(text, at)
        else:
            words = (_PLAIN_IN_FLOW if brackets else _PLAIN).match(text, at)
            at = words.end() if words and words.end() > at else at + 1
    return _Reading(tuple(brackets), None, None)


def _line_end(text: str, at: int) -> int:
    end = text.find("\n", at)
    return len(text) if end < 0 else end


def _after_block(text: str, at: int) -> int:
    """Skips a block scalar: lines that are empty, or indented more than the one it begins on."""
    start = text.rfind("\n", 0, at) + 1
    indent = len(text[start:at]) - len(text[start:at].lstrip(" "))
    at = _line_end(text, at)
    while at < len(text):
        end = _line_end(text, at + 1)
        line = text[at + 1 : end]
        if line.strip() and len(line) - len(line.lstrip(" ")) <= indent:
            break
        at = end
    return at
