"""Sets constants from outside, as by ``-c n=7``: a `Source`, settings → the source with their values.

A directive ``#const n = …`` gives way to the setting; without one the constant is new, as for
clingo.  All places stay as they are in the file.

>>> set_constants(Source("p", "#const n = 2. sorts #s = 1..n. "), ["n=7"]).text
'#const n = 7.\\n              sorts #s = 1..n. '
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from sparc.errors import SourceError
from sparc.source import Origin, Source
from sparc.syntax.cursor import MAX_NUMBER
from sparc.syntax.lexer import scan

__all__ = ["set_constants"]

_SETTING = re.compile(r"\s*([a-z][A-Za-z0-9_]*)\s*=\s*(0|[1-9][0-9]*)\s*")


def set_constants(source: Source, settings: Sequence[str]) -> Source:
    """``source`` with the constants that ``settings`` (each ``name=number``) give.

    Raises `SourceError` for a setting that is none, that gives a constant twice, or whose constant
    the program does not have.
    """
    if not settings:
        return source
    values: dict[str, str] = {}
    for setting in settings:
        match = _SETTING.fullmatch(setting)
        if match is None or len(match[2]) > 10 or int(match[2]) > MAX_NUMBER:
            raise SourceError(
                f"-c {setting}: not the value of a constant",
                hint=f"write -c n=7: a name, and a number from 0 to {MAX_NUMBER}",
            )
        if match[1] in values:
            raise SourceError(f"-c {setting}: the constant {match[1]} is given twice")
        values[match[1]] = match[2]
    text = source.text
    lexemes = scan(source)
    for name, value in values.items():
        if name not in lexemes.texts:
            raise _unknown(name, value, lexemes.texts)
        start, end = _directive(name, lexemes.texts, lexemes.starts)
        text = text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]
    lines = [f"#const {name} = {value}." for name, value in values.items()]
    origins: tuple[Origin | None, ...] = tuple(
        Origin(f"-c {name}={value}", 1, len(name) + 2, f"{name}={value}")
        for name, value in values.items()
    )
    first = source.first_line - len(lines)
    origins += source.origins
    return Source(source.name, "\n".join([*lines, text]), first, origins)


def _directive(name: str, texts: Sequence[str], starts: Sequence[int]) -> tuple[int, int]:
    """Returns the start and the end of a constant's directive; twice the same place without one."""
    for at, text in enumerate(texts):
        if text == "#const" and tuple(texts[at + 1 : at + 3]) == (name, "="):
            if texts[at + 4] == ".":
                return starts[at], starts[at + 4] + 1
    return 0, 0


def _unknown(name: str, value: str, texts: Sequence[str]) -> SourceError:
    """Returns the error that nothing in the program has the name of the constant."""
    from sparc.spelling import nearest

    constants = [texts[at + 1] for at, text in enumerate(texts) if text == "#const"]
    near = nearest(name, constants)
    hint = f"its constants are {', '.join(constants)}" if constants else "it has no constants"
    return SourceError(
        f"-c {name}={value}: the program has no constant {name}",
        hint=f"did you mean {near}?" if near else hint,
    )
