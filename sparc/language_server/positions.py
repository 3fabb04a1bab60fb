"""Places as editors count them: offsets in a text ↔ lines and columns, from 0.

Entry point `Positions`.  Columns count UTF-16 code units, unless the editor asked for those of UTF-8 or
UTF-32.  Follows the Language Server Protocol 3.17, Position.

>>> Positions("p(a).\\nq(b).").of(6)
(1, 0)
"""

from __future__ import annotations

import re
from bisect import bisect_right

__all__ = ["Positions"]

_LINE_END = re.compile(r"\r\n?|\n")
_UNIT = {"utf-8": 1, "utf-16": 2, "utf-32": 4}  # bytes


class Positions:
    """The lines of one text; ``encoding`` is that of which columns count the units."""

    def __init__(self, text: str, encoding: str = "utf-16") -> None:
        self.text = text
        self.unit = _UNIT[encoding]
        self.encoding = encoding if self.unit == 1 else f"{encoding}-le"
        self.starts = [0, *(end.end() for end in _LINE_END.finditer(text))]

    def of(self, offset: int) -> tuple[int, int]:
        """Returns the line and the column of an offset.

        Offsets beyond the text count as its end.
        """
        offset = min(max(offset, 0), len(self.text))
        line = bisect_right(self.starts, offset) - 1
        return line, self._units(self.text[self.starts[line] : offset])

    def offset(self, line: int, column: int) -> int:
        """Returns the offset of a line and a column.

        A column beyond its line counts as its end.
        """
        if line < 0:
            return 0
        if line >= len(self.starts):
            return len(self.text)
        start = self.starts[line]
        end = self.starts[line + 1] if line + 1 < len(self.starts) else len(self.text)
        content = self.text[start:end].rstrip("\r\n")
        end = start + len(content)
        if content.isascii():
            return start + min(max(column, 0), len(content))
        for index, sign in enumerate(content):
            if column <= 0:
                return start + index
            column -= self._units(sign)
        return end

    def _units(self, text: str) -> int:
        """Returns the number of code units of a text."""
        if text.isascii():
            return len(text)
        return len(text.encode(self.encoding, "surrogatepass")) // self.unit
