"""Template text → its statements with the sentences above them. Entry points `read_blocks`, `shown_lines`.

A domain is written to be read: a comment above each statement, or above a few that belong
together, says in a sentence what they mean.  A *block* is such a comment with the lines under it,
up to the next comment or empty line.  A line ``% ---- title`` begins a section, as do the words
``sorts``, ``predicates``, ``rules`` and ``display``.  A block inside ``%? part`` belongs to it.

>>> text = "rules\\n% ---- walking\\n\\n% It walks.\\nat(N) :- go(N).\\n"
>>> [(block.section, block.sentence, block.lines) for block in read_blocks(text)]
[('walking', 'It walks.', ((5, 'at(N) :- go(N).'),))]
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sparc.lazy_dataclass import dataclass
from waiter_cli.encoding.marks import MarkKind, mark_of

__all__ = ["CommentBlock", "page", "read_blocks", "sentence_at", "shown_lines"]

_WORDS = ("sorts", "predicates", "rules", "display")
_INDENT = 6
_NARROW = 24  # columns that a comment beside a line has at least


@dataclass(frozen=True)
class CommentBlock:
    """Lines that one sentence explains, as pairs (line number, text); ``parts`` outermost first.

    ``line`` is the first line of the sentence, or of the text where there is none.
    """

    section: str
    parts: tuple[str, ...]
    sentence: str
    line: int
    lines: tuple[tuple[int, str], ...]

    def mentions(self, text: str) -> bool:
        """Returns whether a text occurs in the section's title, the sentence or the lines.

        Case aside.
        """
        wanted = text.casefold()
        words = (self.section, self.sentence, *self.parts, *(line for _, line in self.lines))
        return any(wanted in word.casefold() for word in words)


def read_blocks(text: str) -> tuple[CommentBlock, ...]:
    """Returns the blocks of a template, in their order."""
    section = "about"
    parts: list[str] = []
    words: list[str] = []
    lines: list[tuple[int, str]] = []
    start = 0
    blocks: list[CommentBlock] = []

    def close() -> None:
        if words or lines:
            sentence = " ".join(" ".join(words).split())
            blocks.append(CommentBlock(section, tuple(parts), sentence, start, tuple(lines)))
        words.clear()
        lines.clear()

    for number, line in enumerate(text.split("\n"), 1):
        bare = line.strip()
        mark = mark_of(line)
        if mark is not None and mark.kind in (MarkKind.SLOT, MarkKind.SLOT_END):
            continue
        if mark is not None:
            close()
            if mark.kind is MarkKind.PART:
                parts.append(mark.name)
            else:
                del parts[-1:]
        elif bare.startswith("%"):
            said = bare.lstrip("%").strip()
            if lines or said.startswith("--"):
                close()
            if said.startswith("--"):
                section = said.strip("- ")
            elif said:
                start = start if words else number
                words.append(said)
            elif words:
                words.append("\n")
        elif not bare:
            close()
        elif bare in _WORDS:
            close()
            section = bare
        else:
            start = start if words or lines else number
            lines.append((number, line.rstrip()))
    close()
    return tuple(block for block in blocks if block.lines)


def sentence_at(blocks: Sequence[CommentBlock], line: int) -> str:
    """Returns the sentence that explains a line; empty where there is none."""
    for block in blocks:
        if any(number == line for number, _ in block.lines):
            return block.sentence
    return ""


def shown_lines(blocks: Sequence[CommentBlock], width: int = 79) -> Iterator[tuple[str, str]]:
    """Yields pairs (style, line): sections, sentences and numbered statements, no
    line wider than ``width``.

    The style is ``section``, ``sentence``, ``text`` or empty.
    """
    from textwrap import wrap

    section = None
    for block in blocks:
        if block.section != section:
            if section is not None:
                yield "", ""
            section = block.section
            yield "section", section
        yield "", ""
        only = f" [only with: {', '.join(block.parts)}]" if block.parts else ""
        said = f"{block.sentence}{only}".strip()
        for line in wrap(said, width - _INDENT) if said else ():
            yield "sentence", " " * _INDENT + line
        for number, pieces in _fitted(block.lines, width - _INDENT):
            for index, piece in enumerate(pieces):
                label = str(number) if index == 0 else ""
                yield "text", f"{label:>{_INDENT - 2}}  {piece}"


def page(blocks: Sequence[CommentBlock]) -> str:
    """Returns the blocks as Markdown: a heading for each section, each sentence
    above its statements.
    """
    lines: list[str] = []
    section = None
    for block in blocks:
        if block.section != section:
            section = block.section
            lines += [f"## {section[:1].upper()}{section[1:]}", ""]
        only = f"*(Only with {', '.join(block.parts)}.)*" if block.parts else ""
        said = " ".join(filter(None, (block.sentence, only)))
        lines += [said, ""] if said else []
        lines += ["```", *(text for _, text in block.lines), "```", ""]
    return "\n".join(lines).rstrip() + "\n"


def _fitted(lines: Sequence[tuple[int, str]], width: int) -> Iterator[tuple[int, list[str]]]:
    """Yields each line cut to ``width``, the comments at the ends of the lines in a
    column of their own.
    """
    from textwrap import wrap

    split = [(number, *_code_and_comment(text)) for number, text in lines]
    column = 2 + max((len(code) for _, code, comment in split if comment), default=0)
    column = min(column, width - _NARROW)
    for number, code, comment in split:
        pieces = _folded(code, width)
        if comment:
            said = wrap(comment, width - column - 2) or [""]
            beside = len(pieces[-1]) + 2 <= column
            first = f"{pieces.pop():<{column}}" if beside else " " * column
            pieces += [f"{first}% {said[0]}", *(f"{'':{column}}% {more}" for more in said[1:])]
        yield number, pieces


def _code_and_comment(text: str) -> tuple[str, str]:
    code, _, comment = text.partition("%")
    return code.rstrip(), comment.strip()


def _folded(text: str, width: int) -> list[str]:
    """Returns a line of a program cut where there is a space, outside of parentheses if possible."""
    pieces: list[str] = []
    margin = " " * (len(text) - len(text.lstrip()))
    while len(text) > width:
        spaces = [i for i in range(len(text) - len(text.lstrip()), width) if text[i] == " "]
        outside = [i for i in spaces if _depth(text[:i]) <= 0]
        if not spaces:
            break
        cut = max(outside or spaces)
        pieces.append(text[:cut].rstrip())
        text = f"{margin}    {text[cut:].lstrip()}"
    return [*pieces, text]


def _depth(text: str) -> int:
    return sum(text.count(sign) for sign in "({") - sum(text.count(sign) for sign in ")}")
