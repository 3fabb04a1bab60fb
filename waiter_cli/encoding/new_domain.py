"""Begins a domain of one's own: the text of another one → text with an action of its own. Entry point `begin_domain`.

The new one runs as it stands.  What was added is marked with its name, to be changed: a fluent, an
action with its rules and its looks, and names for everything that is observed.
"""

from __future__ import annotations

import re

from sparc.source import Source
from waiter_cli.encoding.template import slot_names
from waiter_cli.errors import Fault, InputError, Where

__all__ = ["begin_domain"]

_OBSERVABLES = (
    ("ready_to_order(#table)", "a table shows that it is ready to order"),
    ("has_left(#table)", "the party at a table leaves"),
    ("seen_free(#table)", "a table was seen to be free"),
    ("seen_at(#employee, #node)", "somebody was seen at a node"),
)
_RULES = """
% ---------------------------------------------------------------- greet: {name}

% The robot can greet the party at a table that it is near, once.
possible({agent}greet(ROBOT, T), I) :- {more}near({agent}T, I), -holds(isfree(T), I),
    not holds(isgreeted(T), I).

% The table is then greeted.
holds(isgreeted(T), I+1) :- occurs(greet(DOER, T), I).
"""
_LOOKS = (
    "% Nothing needs to happen once the goals hold, and how the new action looks:",
    "%@ monotone",
    '%@ greet(ROBOT,T): "greet {T}" at T for 2 s as "greeting {T}"',
    "",
)
_PLACES = ("#basic_fluent", "#observable", "#basic_action")


def begin_domain(source: Source, name: str) -> str:
    """Returns the text of a domain called ``name`` that begins where another one is.

    Raises `InputError` where that has not the sorts to add to.
    """
    lines = source.text.rstrip("\n").split("\n")
    have = {sort for sort in _PLACES if _definition(lines, sort) is not None}
    ends = [k for k, line in enumerate(lines) if line.strip() == "display"]
    if have != set(_PLACES) or not ends or "goals" not in slot_names(source):
        missing = ", ".join(sort for sort in _PLACES if sort not in have) or "a section display"
        message = f"there is nothing to begin from: it lacks {missing}"
        hint = "begin from restaurant, or copy it with waiter domain show --source"
        raise InputError([Fault(Where(source.name, 1, 1), message, hint)])
    several = "agents" in slot_names(source) and "robot(#employee)" in source.text
    bare = re.sub(r"%[^\n]*", "", source.text)
    for element, sentence in _OBSERVABLES:
        if not re.search(rf"(?<!\w){element.split('(')[0]}\s*\(", bare):
            _add(lines, "#observable", element, f"{name}: {sentence}")
    _add(lines, "#basic_fluent", "isgreeted(#table)", f"{name}: the party at a table was greeted")
    _add(lines, "#basic_action", "greet(#agent, #table)", f"{name}: greet the party at a table")
    end = next(k for k, line in enumerate(lines) if line.strip() == "display")
    rules = _RULES.format(
        name=name,
        agent="R, " if several else "",
        more="robot(R), " if several else "",
    )
    rules = rules.replace("ROBOT", "R" if several else "agent")
    rules = rules.replace("DOER", "_" if several else "agent")
    lines[end:end] = rules.strip("\n").split("\n") + [""]
    start = next(k for k, line in enumerate(lines) if line.strip() == "sorts")
    lines[start:start] = [line.replace("ROBOT", "R" if several else "agent") for line in _LOOKS]
    head = f"% {name}: rules of one's own, begun from {source.name}. What is new is marked {name}."
    return "\n".join([head, "%", *lines]) + "\n"


def _definition(lines: list[str], sort: str) -> tuple[int, int] | None:
    """Returns the first and the last line of a sort's definition, None where there is none."""
    starts = (k for k, line in enumerate(lines) if re.match(rf"{sort}\s*=", line))
    first = next(starts, None)
    if first is None:
        return None
    last = first
    while not _code(lines[last]).endswith("."):
        last += 1
        if last == len(lines):
            return None
    return first, last


def _code(line: str) -> str:
    return line.partition("%")[0].rstrip()


def _add(lines: list[str], sort: str, element: str, sentence: str) -> None:
    """Adds an element to the end of a sort's definition, with the sentence that explains it."""
    found = _definition(lines, sort)
    assert found is not None
    first, last = found
    code = _code(lines[last])
    comment = lines[last][lines[last].index("%") :] if "%" in lines[last] else ""
    lines[last] = f"{code[:-1]:<{52}}{comment}".rstrip()
    margin = " " * (lines[first].index("=") if "=" in lines[first] else 2)
    lines.insert(last + 1, f"{margin + '+ ' + element + '.':<52}% {sentence}")
