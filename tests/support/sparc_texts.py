"""Pieces of SPARC text read into trees: `rule` of one statement, `sort` of one definition."""

from __future__ import annotations

from sparc.errors import SourceError, SourceErrors
from sparc.source import Source
from sparc.syntax.parser import parse
from sparc.syntax.tree import Program, Rule, SortExpression, Statement

__all__ = ["faults", "marked", "program", "rule", "rules", "sort"]


def program(text: str) -> Program:
    """The tree of a whole program."""
    return parse(Source("test.sparc", text))


def rules(text: str, constants: str = "#const n = 3. ") -> tuple[Statement, ...]:
    """The statements of a text, which begins on line 2; ``n`` is a constant."""
    return program(f"{constants}predicates p(). rules\n{text}").statements


def rule(text: str) -> Rule:
    """The only statement of a text, a rule."""
    (statement,) = rules(text)
    assert isinstance(statement, Rule)
    return statement


def sort(text: str, constants: str = "#const n = 3. #const m = 4. ") -> SortExpression:
    """The expression that defines a sort; ``n`` and ``m`` are constants."""
    return program(f"{constants}sorts #s = {text}. predicates rules ").sorts[0].expression


def faults(source: Source) -> list[SourceError]:
    """The faults of syntax of a text."""
    try:
        parse(source)
    except SourceErrors as found:
        return list(found.errors)
    except SourceError as error:
        return [error]
    return []


def marked(text: str) -> tuple[str, str]:
    """The text that the only fault of a program marks, and its mend."""
    (fault,) = faults(Source("test.sparc", text))
    assert fault.span is not None
    return fault.span.text, fault.hint or ""
