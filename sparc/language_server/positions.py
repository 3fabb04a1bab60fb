"""Places as editors count them: offsets in a text ↔ lines and UTF-16 columns, from 0.

Entry point `Positions`.  Follows the Language Server Protocol 3.17, Position.

>>> Positions("p(a).\\nq(b).").of(6)
(1, 0)
"""

from __future__ import annotations

from bisect import bisect_right

__all__ = ["Positions"]


class Positions:
    """The lines of one text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.starts = [0]
        at = text.find("\n")
        while at >= 0:
            self.starts.append(at + 1)
            at = text.find("\n", at + 1)

    def of(self, offset: int) -> tuple[int, int]:
        """Returns the line and the UTF-16 column of an offset.

        Offsets beyond the text count as its end.
        """
        offset = min(max(offset, 0), len(self.text))
        line = bisect_right(self.starts, offset) - 1
        return line, _units(self.text[self.starts[line] : offset])

    def offset(self, line: int, column: int) -> int:
        """Returns the offset of a line and a UTF-16 column.

        A column beyond its line counts as its end.
        """
        if line < 0:
            return 0
        if line >= len(self.starts):
            return len(self.text)
        start = self.starts[line]
        end = self.starts[line + 1] - 1 if line + 1 < len(self.starts) else len(self.text)
        content = self.text[start:end]
        if content.isascii():
            return start + min(max(column, 0), len(content))
        for index, sign in enumerate(content):
            if column <= 0:
                return start + index
            column -= _units(sign)
        return end


def _units(text: str) -> int:
    """Returns the number of UTF-16 code units of a text."""
    return len(text) if text.isascii() else len(text.encode("utf-16-le", "surrogatepass")) // 2
