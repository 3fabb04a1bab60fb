"""Lays SPARC text out in one style: Source → str, with :func:`format_program`.

The layout follows the lines that the author chose: statements may share a line, a long one may
be broken anywhere.  What is settled is the rest: spaces between tokens, indentation, blank lines,
the column of comments.  Comments stay, the tree stays the same, and formatting twice changes
nothing more.

>>> from sparc.source import Source
>>> print(format_program(Source("x", "predicates p(). rules   p:-not p.% odd")), end="")
predicates
p().
<BLANKLINE>
rules
p :- not p.  % odd
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sparc.source import Source
from sparc.syntax.lexer import SECTION_WORDS, Token, tokenize

__all__ = ["format_program"]

WIDTH = 100
"""A line that is longer is broken where a comma of its body allows it, in columns."""

INDENT = 4
COMMENT_COLUMN = 60
"""Code that is longer keeps its comment two columns behind it, whatever stands around it."""

_OPEN, _CLOSE = "([{", ")]}"
_RELATIONS = ("=", "==", "!=", "<", "<=", ">", ">=")
_SPACED = (*_RELATIONS, ":-", ":+", ":~", "|", "or", "and", "not")
_OPERATORS = "+-*/"


class _Gap(NamedTuple):
    """The gap between two tokens: a comment behind the first, then lines of their own."""

    trailing: str | None
    lines: tuple[str, ...]  # comments, and "" for a blank line
    breaks: bool


class _Line(NamedTuple):
    """One line of the result; ``comment`` stands behind ``code``, or alone where that is empty."""

    code: str
    comment: str | None = None


def format_program(source: Source) -> str:
    """Returns the text of ``source`` in the one style; it ends with a line end.

    Raises :class:`SourceError` or :class:`SourceErrors` for text that is no program, as `parse`
    does, so that nothing is changed before its faults are mended.
    """
    from sparc.syntax.parser import parse

    tree = parse(source)
    text = _laid_out(source)
    if parse(Source(source.name, text)) != tree:
        raise AssertionError("formatting changed the program")
    return text


def _laid_out(source: Source) -> str:
    tokens = tokenize(source)
    lines = _Writer(source, tokens).lines()
    code = [line.code for line in lines]
    columns = _columns(lines)
    out = []
    for line, text, column in zip(lines, code, columns):
        if line.comment is None:
            out.append(text)
        elif text:
            out.append(text.ljust(column) + line.comment)
        else:
            out.append(line.comment)
    return "\n".join(out).rstrip("\n") + "\n" if any(out) else ""


def _columns(lines: list[_Line]) -> list[int]:
    """Returns the column of each line's comment: the same for neighbours whose code
    is short enough.
    """
    columns = [len(line.code) + 2 for line in lines]
    start = 0
    while start < len(lines):
        end = start
        while end < len(lines) and lines[end].code and lines[end].comment is not None:
            end += 1
        short = [i for i in range(start, end) if len(lines[i].code) <= COMMENT_COLUMN]
        widest = max((columns[i] for i in short), default=0)
        for i in short:
            columns[i] = widest
        start = max(end, start + 1)
    return columns


def _gap(text: str) -> _Gap:
    """Returns the parts of the white space and comments between two tokens."""
    first, *rest = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    trailing = first.strip() or None
    lines: list[str] = []
    for line in rest[:-1]:
        said = line.strip()
        if said or (lines[-1:] != [""]):
            lines.append(said)
    last = rest[-1].strip() if rest else ""
    if last:  # a comment that the end of the text ends
        lines.append(last)
    return _Gap(trailing, tuple(lines), bool(rest))


class _Writer:
    """Writes the tokens of one source, line by line."""

    def __init__(self, source: Source, tokens: tuple[Token, ...]) -> None:
        self.tokens = tokens
        ends = [0, *(token.span.end for token in tokens)]
        starts = [*(token.span.start for token in tokens), len(source.text)]
        self.gaps = [_gap(source.text[end:start]) for end, start in zip(ends, starts)]
        self.out: list[_Line] = []
        self.section = ""
        self.depth = 0

    def lines(self) -> list[_Line]:
        """Returns all lines, the blank ones too."""
        first = self.gaps[0]
        if first.trailing:
            self.out.append(_Line("", first.trailing))
        self._own_lines(first, "")
        for begin, end in self._statements():
            self._statement(begin, end)
        return self.out

    def _statements(self) -> Iterator[tuple[int, int]]:
        """Yields the ranges of tokens that are a section word or a statement."""
        begin = depth = 0
        kinds = [token.kind for token in self.tokens]
        for i, kind in enumerate(kinds):
            depth += (kind in _OPEN) - (kind in _CLOSE)
            last = i + 1 == len(kinds)
            if kind == "section" and i == begin:
                yield begin, i + 1
                begin = i + 1
            elif kind == "." and depth == 0 and not (not last and kinds[i + 1] == "["):
                yield begin, i + 1
                begin = i + 1
            elif kind == "]" and depth == 0 and (last or kinds[i + 1] != "."):
                if any(k == "." for k in kinds[begin:i]):  # the weight of a weak constraint
                    yield begin, i + 1
                    begin = i + 1
        if begin < len(kinds):
            yield begin, len(kinds)

    def _statement(self, begin: int, end: int) -> None:
        """Adds the lines of a statement, and the comment that stands behind it."""
        token = self.tokens[begin]
        if token.kind == "section":
            self._blank_line_before_section()
            self.section = token.text
        share = begin > 0 and not self._breaks(begin) and token.kind != "section"
        if share and self.tokens[begin - 1].kind == "section":
            share = False
        line = ""
        if share:
            line = self.out.pop().code + " "
        indent = self._indent(begin, end)
        for i in range(begin, end):
            text = self.tokens[i].text
            if i > begin:
                gap = self.gaps[i]
                if gap.breaks and not self._glued(i - 1):
                    self._emit(line, gap.trailing)
                    self._own_lines(gap, " " * INDENT, inside=True)
                    line = " " * (indent if text in _OPERATORS else INDENT)
                elif self._space(i, begin):
                    line += " "
            line += text
        self._emit(line, self.gaps[end].trailing)
        self._own_lines(self.gaps[end], "", after=token.kind == "section")

    def _breaks(self, i: int) -> bool:
        gap = self.gaps[i]
        return gap.breaks or gap.trailing is not None

    def _indent(self, begin: int, end: int) -> int:
        """Returns the column of an operator that begins a line: below the equals sign of its sort."""
        if self.section == "sorts" and end - begin > 2 and self.tokens[begin].kind == "sort name":
            return len(self.tokens[begin].text) + 1
        return INDENT

    def _blank_line_before_section(self) -> None:
        """Puts one blank line above a section and the comments that stand directly above it."""
        at = len(self.out)
        while at > 0 and not self.out[at - 1].code and self.out[at - 1].comment is not None:
            at -= 1
        if at > 0 and self.out[at - 1] != _Line(""):
            self.out.insert(at, _Line(""))

    def _own_lines(
        self, gap: _Gap, indent: str, *, inside: bool = False, after: bool = False
    ) -> None:
        """The comments and blank lines between two lines of code."""
        for said in gap.lines:
            if said:
                self.out.append(_Line("", indent + said))
            elif not inside and self.out and not after:
                if self.out[-1] != _Line(""):
                    self.out.append(_Line(""))
            after = False

    def _emit(self, code: str, comment: str | None) -> None:
        *first, last = _broken(code)
        self.out.extend(map(_Line, first))
        self.out.append(_Line(last, comment))

    def _glued(self, i: int) -> bool:
        """Returns whether the token must touch the next one: an identifier that
        would open a section.
        """
        token = self.tokens[i]
        return token.text in SECTION_WORDS and token.kind != "section"

    def _space(self, i: int, begin: int) -> bool:
        """Returns whether a space stands between a token and the one before it, in one line."""
        before, token = self.tokens[i - 1], self.tokens[i]
        a, b = before.kind, token.kind
        if self._glued(i - 1) or a in _OPEN or b in (*_CLOSE, ",", ";", ".", "..", "@"):
            return False
        if a == "#" or a in ("..", "@"):
            return False
        if a in (",", ";"):
            return True
        if ":" in (a, b) and self._in_weight(i, begin):
            return False
        if b == ":":
            return not self._label(i, begin)
        if a == ":" or a in _SPACED or b in _SPACED:
            return True
        if b in _OPERATORS or a in _OPERATORS:
            return self._around_operator(i)
        if b == "(":
            return False
        if b == "[":
            return a == "."
        if b == "{":
            return a != "sort name"
        return True

    def _around_operator(self, i: int) -> bool:
        """Returns whether a space stands beside an operator: in sorts, and before a sign."""
        before, token = self.tokens[i - 1], self.tokens[i]
        if self.section == "sorts":
            return True
        if token.kind in _OPERATORS and before.kind == "}":
            return True
        ends_a_term = ("identifier", "variable", "number", ")", *_OPERATORS)
        return token.kind == "-" and before.kind not in ends_a_term

    def _in_weight(self, i: int, begin: int) -> bool:
        """Returns whether the token stands in the brackets of a weak constraint."""
        kinds = [token.kind for token in self.tokens[begin:i]]
        return self.section == "rules" and kinds.count("[") > kinds.count("]")

    def _label(self, i: int, begin: int) -> bool:
        """Returns whether the colon at ``i`` ends the label of a rule."""
        depth = 0
        for token in self.tokens[begin:i]:
            depth += (token.kind in _OPEN) - (token.kind in _CLOSE)
        return depth == 0 and self.section == "rules" and self.tokens[begin].kind == "identifier"


def _broken(code: str) -> list[str]:
    """Returns a line, or the lines into which one that is too long is broken: at
    commas of the body.
    """
    lines = []
    indent = len(code) - len(code.lstrip())
    while len(code) > WIDTH:
        cut = _cut(code)
        if cut is None:
            break
        lines.append(code[:cut])
        code = " " * max(INDENT, indent) + code[cut:].lstrip()
    return [*lines, code]


def _cut(code: str) -> int | None:
    """Returns the last place at which a line of ``WIDTH`` can end: behind a comma or
    ``:-`` at depth 0.
    """
    depth = 0
    best = None
    for i, sign in enumerate(code[:WIDTH]):
        depth += (sign in _OPEN) - (sign in _CLOSE)
        if depth == 0 and i > INDENT and (sign in ",;" or code[i - 1 : i + 1] == ":-"):
            if code[i + 1 : i + 2] == " ":
                best = i + 1
    return best
