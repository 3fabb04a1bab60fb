"""Faults as text a person can act on: SourceError → message, excerpt, caret and mend.

Entry points: :func:`render` for one fault, :func:`render_all` for several, :func:`as_dict` for
programs.

>>> from sparc.errors import SortError
>>> source = Source("town.sparc", "predicates\\nedge(#node, #nodee).\\n")
>>> print(render(SortError("unknown sort #nodee", Span(source, 23, 29), "did you mean #node?")))
town.sparc:2:13: error: unknown sort #nodee
    2 | edge(#node, #nodee).
      |             ^^^^^^
  hint: did you mean #node?
"""

from __future__ import annotations

from collections.abc import Iterable

from sparc.errors import SourceError, SparcWarning
from sparc.escaping import escaped, on_one_line
from sparc.source import Source, Span

__all__ = ["as_dict", "parts", "render", "render_all"]

_GUTTER = 5
_WIDEST = 160


def render(error: SourceError, widest: int = _WIDEST) -> str:
    """Returns the fault as lines of text, without a line end at the end.

    The first line is ``FILE:LINE:COLUMN: error: MESSAGE`` (``warning`` for a
    :class:`SparcWarning`); lines and columns count from 1, a tab being one column.  The excerpt
    is the line of the file a person edits, cut to ``widest`` about the place; it is left out where
    that line is not known.
    """
    head, excerpt, hint = parts(error, widest)
    return "\n".join([head, *excerpt, *([] if hint is None else [f"  hint: {hint}"])])


def parts(error: SourceError, widest: int = _WIDEST) -> tuple[str, list[str], str | None]:
    """Returns the parts of `render`: the first line, the two lines of the excerpt or
    none, and the mend.
    """
    severity = "warning" if isinstance(error, SparcWarning) else "error"
    hint = escaped(error.hint) if error.hint else None
    message = escaped(f"{severity}: {error.message}")
    if error.span is None:
        return message, [], hint
    location = error.span.location
    head = f"{on_one_line(str(location))}: {message}"
    excerpt = _excerpt(error.span, widest)
    if excerpt is None:
        return head, [], hint
    text, before, width = excerpt
    lines = [
        f"{location.line:>{_GUTTER}} | {text}".rstrip(),
        f"{'':>{_GUTTER}} | {' ' * before}{'^' * width}",
    ]
    return head, lines, hint


def render_all(errors: Iterable[SourceError], widest: int = _WIDEST) -> str:
    """Returns several faults, one below the other, in the order given."""
    return "\n".join(render(error, widest) for error in errors)


def as_dict(error: SourceError) -> dict[str, str | int | None]:
    """Returns the fault as a JSON object.

    ``file``, ``line`` and ``column`` are None without a place.
    """
    location = error.span.location if error.span is not None else None
    return {
        "message": error.message,
        "file": location.name if location else None,
        "line": location.line if location else None,
        "column": location.column if location else None,
        "hint": error.hint,
    }


def _excerpt(span: Span, widest: int) -> tuple[str, int, int] | None:
    """Returns the line to show, the cells before the carets, and the number of carets.

    None: no line.
    """
    source = span.source
    origin = source.origin(span.start)
    if origin is None or origin.verbatim:
        text = source.line_text(span.start)
        start = _column(source, span.start)
        end = start + max(span.end - span.start, 1)
    elif origin.text:
        text = origin.text.rstrip("\r\n")
        start = max(origin.column - 1, 0)
        end = start + 1
    else:
        return None
    end = max(min(end, len(text)), start + 1)
    if len(text) > widest:
        text, start, end = _window(text, start, end, widest)
    before = _cells(text[:start])
    return _shown(text), before, max(_cells(text[:end]) - before, 1)


def _column(source: Source, offset: int) -> int:
    """Returns the number of characters before ``offset`` in its line."""
    return offset - source.line_starts[source.line_index(offset)]


def _window(text: str, start: int, end: int, widest: int) -> tuple[str, int, int]:
    """Returns a stretch of a long line around the place ``start``, and where the place is in it."""
    first = max(0, min(start - widest // 2, len(text) - widest))
    last = min(len(text), first + widest)
    head = "…" if first else ""
    tail = "…" if last < len(text) else ""
    shift = first - len(head)
    return head + text[first:last] + tail, start - shift, min(end, last) - shift


def _shown(text: str) -> str:
    """Returns the text with tabs spread out and what a terminal would obey as codes."""
    return escaped(text.expandtabs(8))


def _cells(text: str) -> int:
    """Returns the number of terminal cells that the text takes at the start of a line."""
    spread = _shown(text)
    if spread.isascii():
        return len(spread)
    import unicodedata  # only for lines with letters beyond ASCII

    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in spread)
    return len(spread) + wide - sum(unicodedata.combining(c) > 0 for c in spread)
