"""Shows values of `sparc` in a notebook: HTML for answer sets and programs.

>>> from sparc.answer_sets import GroundLiteral
>>> print(answer_set_table([GroundLiteral("p", (1,)), GroundLiteral("p", (2,))], ()))
<table><tr><th>p</th><td><code>p(1)</code> <code>p(2)</code></td></tr></table>
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from itertools import groupby
from typing import Protocol

__all__ = ["answer_set_table", "program_text"]


class Named(Protocol):
    """A literal: it has the name of its predicate, and `str` writes it."""

    @property
    def name(self) -> str: ...


def answer_set_table(literals: Iterable[Named], cost: Sequence[int]) -> str:
    """Returns an HTML table: a row for each predicate, in the order given, and one for a cost."""
    rows = []
    for name, group in groupby(literals, key=lambda literal: literal.name):
        cells = " ".join(f"<code>{escape(str(literal))}</code>" for literal in group)
        rows.append(f"<tr><th>{escape(name)}</th><td>{cells}</td></tr>")
    if cost:
        rows.append(f"<tr><th>cost</th><td>{', '.join(map(str, cost))}</td></tr>")
    return f"<table>{''.join(rows)}</table>"


def program_text(text: str) -> str:
    """Returns a program as HTML, its lines as they were written.

    >>> program_text("p :- 1 < 2.")
    '<pre>p :- 1 &lt; 2.</pre>'
    """
    return f"<pre>{escape(text, quote=False)}</pre>"
