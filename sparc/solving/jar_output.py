"""Reads the output of sparc.jar: its translation as an `AspProgram`, its messages as errors.

The jar spells out every sort as facts, renames a sort that has a predicate's name, and closes the
text with one helper rule for each thing it displays (``p_(X1):-p(X1).``) and a comment that lists
the helpers.  Here the helpers become ``#show`` directives, so that both translators show alike.
Its messages come in four spellings of a place and count a tab as up to eight columns; here they
point at the character meant.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from sparc.errors import (
    MissingToolError,
    PredicateError,
    RuleError,
    SolverError,
    SortError,
    SourceError,
    SparcSyntaxError,
)
from sparc.source import Source, Span
from sparc.translation.asp_program import AspProgram

__all__ = ["asp_program", "is_complete", "run_failure", "source_error"]

_COMMENT = re.compile(r"%[^\n]*")
_STATEMENT_END = re.compile(r"\.\.|\.(?:\s*\[[^\]]*\])?")
_HELPER = re.compile(
    r"-?[a-z]\w*(?:\(.*\))?:-(?P<literal>-?(?P<name>[a-z]\w*)(?:\((?P<args>.*)\))?)\."
)
_FRESH_ARGUMENTS = re.compile(r"X\d+(?:,X\d+)*")
_ANONYMOUS = re.compile(r"(?<!\w)_(?!\w)")


def is_complete(text: str) -> bool:
    """Returns whether the jar wrote ``text`` to its end: the last line lists the helpers."""
    return text.rstrip("\n").rpartition("\n")[2].startswith("%")


# ------------------------------------------------------------------ translation


def asp_program(text: str, source: Source) -> AspProgram:
    """Returns the program the jar's translation ``text`` of ``source`` stands for.

    Raises `SolverError` when the text is not what the jar writes, `RuleError` for a weak
    constraint, which the jar hands on in a form that clingo does not read.
    """
    lines = text.rstrip("\n").split("\n")
    helpers = lines[-1][1:].split()
    end = len(lines) - 1 - len(helpers)
    if not lines[-1].startswith("%") or end < 0:
        raise SolverError("the output of sparc.jar is cut short")
    show = ["#show."]
    sorts = _displayed_sorts(source.text)
    predicates = _declared_predicates(source.text)
    for name, line in zip(helpers, lines[end:-1], strict=True):
        match = _HELPER.fullmatch(line)
        if match is None or not line.startswith(name):
            raise SolverError(f"the output of sparc.jar has an unknown helper rule: {line}")
        show.append(_show(match, predicates, sorts))
    start = 1 if lines[0] == "" else 0
    rules = lines[start:end]
    spans = _line_spans(rules, source)
    preferences = False
    for line, span in zip(rules, spans, strict=True):
        if line.startswith(":~"):
            if not line.startswith(":~appl("):
                raise RuleError(
                    "sparc.jar cannot translate weak constraints for clingo",
                    span,
                    "use the native translator (--translator native)",
                )
            preferences = True
        elif line.startswith(("#minimize", "#maximize")):
            preferences = True
    return AspProgram(
        "\n".join([*rules, ""]),
        "\n".join([*show, ""]),
        (*spans, None),
        preferences,
        has_display=_display(_without_comments(source.text)) >= 0,
    )


def _show(match: re.Match[str], predicates: frozenset[str], sorts: Iterator[str]) -> str:
    """Returns the ``#show`` directive for one helper rule."""
    literal, name, arguments = match["literal"], match["name"], match["args"]
    if name not in predicates:  # a sort atom; its name may have grown underscores
        sort = next(sorts, name.rstrip("_"))
        count = iter(range(len(literal)))
        literal = _ANONYMOUS.sub(lambda _: f"_A{next(count)}", literal)
        return f"#show {sort_shown(sort)}{literal[len(name) :]} : {literal}."
    if arguments is None or _FRESH_ARGUMENTS.fullmatch(arguments):
        arity = 0 if arguments is None else arguments.count(",") + 1
        sign = "-" if literal.startswith("-") else ""
        return f"#show {sign}{name}/{arity}."
    count = iter(range(len(literal)))
    literal = _ANONYMOUS.sub(lambda _: f"_A{next(count)}", literal)
    return f"#show {literal} : {literal}."


def sort_shown(name: str) -> str:
    """Returns the name under which elements of a displayed sort are shown, as in our
    own translation.
    """
    return f"__{name}"


def _without_comments(text: str) -> str:
    """``text`` with its comments blanked out, offsets unchanged."""
    return _COMMENT.sub(lambda match: " " * len(match[0]), text)


def _section(text: str, word: str, start: int = 0) -> int:
    """Returns the offset after the section word ``word``; -1 when there is none."""
    match = re.compile(rf"(?<![\w#]){word}(?=\s|$)").search(text, start)
    return match.end() if match else -1


def _declared_predicates(text: str) -> frozenset[str]:
    text = _without_comments(text)
    start = max(_section(text, "predicates"), 0)
    end = _section(text, "rules", start)
    return frozenset(
        re.findall(r"(?<![\w#])([a-z]\w*)\s*\(", text[start : end if end > 0 else None])
    )


def _display(text: str) -> int:
    """Returns the offset after the word ``display``; -1 without a display section."""
    return _section(text, "display", max(_section(text, "rules"), 0))


def _displayed_sorts(text: str) -> Iterator[str]:
    text = _without_comments(text)
    start = _display(text)
    return iter(re.findall(r"#\s*([a-z]\w*)", text[start:]) if start >= 0 else [])


def _line_spans(lines: list[str], source: Source) -> tuple[Span | None, ...]:
    """Returns for each line of the translation the statement it comes from; all None when in doubt.

    The jar writes constants first, then the rules in order (three lines for a cr-rule, one for
    anything else), then the sorts.
    """
    spans: list[Span | None] = [None] * len(lines)
    at = 0
    while at < len(lines) and lines[at].startswith("#const"):
        at += 1
    for span, is_cr_rule in _statements(source):
        size = 3 if is_cr_rule else 1
        if at + size > len(lines) or lines[at].startswith("appl(") != is_cr_rule:
            return (None,) * len(lines)
        spans[at : at + size] = [span] * size
        at += size
    return tuple(spans)


def _statements(source: Source) -> Iterator[tuple[Span, bool]]:
    """Yields each statement of the rules section, and whether it is a cr-rule."""
    text = _without_comments(source.text)
    at = _section(text, "rules")
    if at < 0:
        return
    display = _section(text, "display", at)
    stop = display - len("display") if display >= 0 else len(text)
    for match in _STATEMENT_END.finditer(text, at, stop):
        if match[0] == "..":
            continue
        body = text[at : match.end()]
        start = at + len(body) - len(body.lstrip())
        yield Span(source, start, match.end()), ":+" in body
        at = match.end()


# ------------------------------------------------------------------ messages

_PLACE = re.compile(
    r"(?:Line (?P<line1>\d+), column (?P<column1>\d+): )|"
    r",?(?:\s?occurring)?\s?\bat line (?P<line2>\d+),? column (?P<column2>\d+)\.?"
)
_TOKEN = re.compile(r"[#-]?[A-Za-z0-9_]+|:[-+~]|\.\.|[<>!=]=|\S")
_NOISE = re.compile(
    r"^(?:SPARC\b.*|program translated|Picked up .*|\s+at .*|WARNING: .*|Clingo not found.*)$"
)
_PREDICATE = re.compile(r"(?:the )?predicate |[Aa]rgument number |non-ground term ")
_SORT = re.compile(r"sort|range|identifier|Constant|Integer|record|constant")


def source_error(stderr: str, source: Source, file_name: str) -> SourceError | None:
    """Returns the error that the jar's stderr reports, placed in ``source``.

    None when it reports none.

    ``file_name`` is the base name under which the jar read the program.
    """
    lines = [line for line in stderr.splitlines() if line.strip() and not _NOISE.match(line)]
    for index, line in enumerate(lines):
        place = _PLACE.search(line)
        if place is None:
            continue
        offset = _offset(
            source,
            int(place["line1"] or place["line2"]),
            int(place["column1"] or place["column2"]),
        )
        token = _TOKEN.match(source.text, offset)
        span = Span(source, offset, token.end() if token else offset)
        if "Lexical error" in line:
            return SparcSyntaxError(f"unexpected {_found(source, offset)}", span)
        if "Encountered" in line:
            return SparcSyntaxError(
                f"unexpected {_found(source, offset)}", span, _expected(lines[index + 1 :])
            )
        message = line[: place.start()] + line[place.end() :]
        message = message.removeprefix(f"{file_name}: ").removeprefix("ERROR: ")
        message = re.sub(r"\s+", " ", message).strip().rstrip(".")
        kind: type[SourceError] = RuleError
        if _PREDICATE.match(message):
            kind = PredicateError
        elif not message.startswith("program rule") and _SORT.search(message):
            kind = SortError
        return kind(message, span)
    return None


def _offset(source: Source, line: int, column: int) -> int:
    """Returns the offset of a place as the jar counts it: a tab fills up to a multiple of eight."""
    starts = source.line_starts
    index = min(max(line, 1), len(starts)) - 1
    end = starts[index + 1] - 1 if index + 1 < len(starts) else len(source.text)
    reached = 0
    for offset in range(starts[index], end):
        reached += 8 - reached % 8 if source.text[offset] == "\t" else 1
        if reached >= column:
            # the place of a sort name is that of its #
            return offset - (source.text[:offset].endswith("#") and source.text[offset].isalnum())
    return end


def _found(source: Source, offset: int) -> str:
    """Returns the words for what stands at ``offset``."""
    rest = source.text[offset:]
    if not _without_comments(rest).strip():
        return "end of the program"
    token = _TOKEN.match(rest)
    return f'"{token[0]}"' if token else f"{rest[0]!r}"


def _expected(lines: list[str]) -> str | None:
    """Returns the hint made of the jar's list of tokens it would have taken; None when it is long."""
    words: list[str] = []
    for line in lines:
        word = line.strip().removesuffix("...").strip()
        if word.startswith("Was expecting"):
            word = word.removeprefix("Was expecting one of:").removeprefix("Was expecting:").strip()
        if word:
            words.append(word.replace("_", " ").lower().strip("<>"))
    return f"expected {' or '.join(words)}" if 0 < len(words) <= 4 else None


# ------------------------------------------------------------------ failures


def run_failure(stderr: str, status: int) -> SolverError:
    """Returns the error for a run that left neither a translation nor a message about the program."""
    if "Unable to access jarfile" in stderr or "Invalid or corrupt jarfile" in stderr:
        return MissingToolError("jar", "Java cannot read sparc.jar", "get the jar again")
    if "UnsupportedClassVersionError" in stderr:
        return MissingToolError(
            "java", "this Java is too old for sparc.jar", "install a newer Java runtime"
        )
    if "Unable to locate a Java Runtime" in stderr:
        return MissingToolError("java", "there is no Java runtime", "install a Java runtime")
    if "OutOfMemoryError" in stderr or "insufficient memory" in stderr:
        return SolverError("sparc.jar ran out of memory", hint="use the native translator")
    if "StackOverflowError" in stderr:
        return SolverError(
            "sparc.jar cannot handle a program nested this deeply", hint="use the native translator"
        )
    crash = next((line for line in stderr.splitlines() if line.startswith("Exception in")), None)
    if crash is None:
        said = [line for line in stderr.splitlines() if line.strip() and "SPARC  V" not in line]
        crash = said[-1].strip() if said else f"no message, exit status {status}"
    return SolverError(
        f"sparc.jar gave up on the program: {crash}", hint="try the native translator"
    )
