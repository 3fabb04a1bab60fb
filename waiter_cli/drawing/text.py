"""`Subject` → a floor plan in characters, for a terminal. Entry point `draw_text`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from waiter_cli.drawing.characters import BOXES, Characters
from waiter_cli.drawing.short_names import told
from waiter_cli.drawing.text_cells import Sheet
from waiter_cli.drawing.text_tables import draw_tables

if TYPE_CHECKING:
    from waiter_cli.drawing.subject import Subject

__all__ = ["draw_text"]


def draw_text(
    subject: Subject,
    width: int = 80,
    characters: Characters = BOXES,
    style: Callable[[str, str], str] = lambda text, style: text,
) -> str:
    """Returns the floor plan in lines of at most ``width`` columns, and below it the plan in words.

    ``style`` makes a piece of text appear in a style (``red``, ``bold``, …) on a terminal.
    """
    sheet = _drawn(Sheet(subject, max(width, 24), characters))
    lines = [style(subject.layout.name, "bold") + f": {subject.headline}", ""]
    lines += sheet.lines(style)
    lines += ["", *_folded(sheet.legend(), width)]
    lines += _folded([told(sheet.short)], width, "") if sheet.short else []
    if subject.listing:
        lines.append("")
        wide = max(len(steps) for steps, _ in subject.listing)
        for steps, text in subject.listing:
            said = text.replace("→ ", f"{characters.arrow}\xa0")  # kept together where it is folded
            first, *rest = (
                line.replace("\xa0", " ") for line in _folded([said], width - wide - 4, "")
            )
            lines.append(f"  {style(steps.rjust(wide), 'red')}  {first}")
            lines += [" " * (wide + 4) + line for line in rest]
    return "\n".join(lines)


def _drawn(sheet: Sheet) -> Sheet:
    """Returns the sheet with everything on it: the floor, the furniture, then people and names."""
    sheet.draw_floor()
    draw_tables(sheet)
    sheet.draw_people()
    return sheet


def _folded(words: Sequence[str], width: int, between: str = "   ") -> list[str]:
    """Words in lines of at most ``width`` columns; a single text is folded at its spaces."""
    if len(words) == 1 and not between:
        import textwrap

        return textwrap.wrap(words[0], max(width, 20)) or [""]
    lines: list[str] = []
    for word in words:
        if lines and len(lines[-1]) + len(between) + len(word) <= width:
            lines[-1] += between + word
        else:
            lines.append(word)
    return lines
