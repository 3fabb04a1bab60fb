"""Guesses what a faulty line means: a line → the line for a hint. Entry point `meant`.

People leave the wrapping out, write Python or YAML instead of JSON, put numbers in quotes, or words
only.  Each of these is read generously here, never to be believed: what comes of it is shown, and
only where the protocol understands it.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

from waiter_cli.files.goal_reader import GOALS, OBSERVATIONS
from waiter_cli.serve.line_kinds import ASKS, EVENTS

__all__ = ["meant"]

_MOST = 2000  # bytes of a line that are looked at
_SHOWN = 160
_STEPS = ("done", "failed", "started")
_NAMED = ("type", "kind", "event", "cmd", "command", "op", "method", "action")
_OTHER_WORDS = {
    "observation": "observe", "observations": "observe", "seen": "observe", "observed": "observe",
    "goals": "goal", "want": "goal", "finished": "done", "complete": "done", "completed": "done",
    "start": "started", "fail": "failed", "error": "failed", "query": "ask", "question": "ask",
    "get": "ask", "remove": "drop",
}  # fmt: skip
_NUMBERS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")


def meant(found: object, understood: Callable[[dict[str, Any]], bool]) -> dict[str, Any] | None:
    """Returns the line that is meant by a value, or by a text that is no JSON.

    None where nobody can tell.

    ``understood`` says whether the protocol reads a line; only such ones are given, and short ones.
    Where nothing but the wrapping is missing, it is shown although a name in it is unknown, too.
    """
    try:
        given = json.dumps(found)
        for line in _lines(found, 3):
            text = json.dumps(line)
            if len(text) <= _SHOWN and text != given and understood(line):
                return line
        if isinstance(found, dict) and len(given) < _SHOWN - 20:
            for kind, known in (("observe", OBSERVATIONS), ("goal", GOALS)):
                if set() < set(found) <= set(known):
                    return {kind: found}
    except (RecursionError, ValueError, OverflowError, TypeError):
        return None
    return None


def _lines(found: object, depth: int) -> Iterator[dict[str, Any]]:
    """Yields the lines that may be meant, the likeliest first."""
    if depth == 0:
        return
    match found:
        case dict():
            yield from _of_object(found, depth)
        case list() | tuple():
            yield from _of_list(list(found), depth)
        case bool() | None:
            return
        case int():
            yield {"done": found}
        case float() if found.is_integer():
            yield {"done": int(found)}
        case str() if len(found) <= _MOST:
            for value in _values(found):
                if isinstance(value, (dict, list, tuple, int)):
                    yield from ([value] if isinstance(value, dict) else [])
                    yield from _lines(value, depth - 1)
            yield from _of_words(found)


def _of_object(found: dict[Any, Any], depth: int) -> Iterator[dict[str, Any]]:
    given = {"id": found["id"]} if isinstance(found.get("id"), (str, int)) else {}
    named = {_kind(key): value for key, value in found.items() if key not in ("id", "reason")}
    observations = {key: value for key, value in named.items() if key in OBSERVATIONS}
    goals = {key: value for key, value in named.items() if key in GOALS}
    for kind in (*EVENTS, *_OTHER_WORDS):
        if kind in named:
            for value in _contents(kind, named[kind]):
                more = {"reason": found["reason"]} if kind == "failed" and "reason" in found else {}
                yield {kind: value, **more, **given}
    if observations:
        yield {"observe": observations, **given}
        yield {"observe": {key: _plain(value) for key, value in observations.items()}, **given}
    if goals:
        yield {"goal": goals, **given}
    for ask in ASKS:
        if ask in named:
            yield {"ask": ask, **given}
    for key in _NAMED:
        if isinstance(kind_ := named.get(key), str):
            rest = {other: value for other, value in named.items() if other != key}
            word = _kind(kind_)
            if word in OBSERVATIONS and rest:
                for value in rest.values():
                    yield {"observe": {word: value}, **given}
            elif word in ASKS:
                yield {"ask": word, **given}
            for value in (*rest.values(), rest):
                for content in _contents(word, value):
                    yield {word: content, **given}
    if "step" in named and not observations and not goals:
        for content in _contents("done", named["step"]):
            yield {"done": content, **given}
    for value in named.values():
        if isinstance(value, dict):
            yield from _lines(value, depth - 1)


def _contents(kind: str, value: object) -> Iterator[Any]:
    """Yields the possible meanings of the value of a key."""
    yield value
    if kind in _STEPS:
        number = _number(value)
        if number is not None:
            yield number
        return
    if isinstance(value, str):
        yield from _values(value)
        for line in _of_words(value):
            yield from line.values()
    if isinstance(value, (list, tuple)):
        if len(value) == 1:
            yield from _contents(kind, value[0])
        if len(value) == 2 and isinstance(value[0], str):
            yield {value[0]: value[1]}
        if len(value) > 2 and isinstance(value[0], str):
            yield {value[0]: list(value[1:])}
        if value and isinstance(value[0], dict):
            yield value[0]
    if isinstance(value, dict):
        if len(value) == 1:
            ((key, inner),) = value.items()
            if key in (kind, "observe", "goal"):
                yield inner
            if kind == "ask":
                yield key
        yield {_kind(key): _plain(inner) for key, inner in value.items()}


def _number(value: object) -> int | None:
    """Returns the number of a step that a value may stand for."""
    match value:
        case bool() | None:
            return None
        case int():
            return abs(value)
        case float() if value.is_integer():
            return int(abs(value))
        case str():
            word = value.strip().lower()
            if word in _NUMBERS:
                return _NUMBERS.index(word)
            digits = re.search(r"\d{1,9}", word)
            return int(digits[0]) if digits else None
        case list() | tuple() if value:
            return _number(value[0])
        case dict():
            return _number(value.get("step", value.get("done")))
    return None


def _of_list(found: list[Any], depth: int) -> Iterator[dict[str, Any]]:
    if not found:
        return
    head, *rest = found
    if all(isinstance(each, dict) and set(each) <= set(OBSERVATIONS) for each in found):
        yield {"observe": found}
    if isinstance(head, str) and rest:
        word = _kind(head)
        yield from _of_object({word: rest[0] if len(rest) == 1 else rest}, depth - 1)
        yield from _of_object({word: rest}, depth - 1)
    if isinstance(head, dict):
        yield head
    yield from _lines(head, depth - 1)


def _of_words(text: str) -> Iterator[dict[str, Any]]:
    """Lines for a few words: ``done 4``, ``enter c1 c2``, ``state``."""
    words = re.findall(r"[A-Za-z_][\w-]*|\d+", text)[:20]
    if not words:
        return
    first, *rest = (words[0].lower(), *words[1:])
    first = _kind(first)
    if first == "observe" and rest:
        first, *rest = rest
    if first in ("goal", "drop") and rest:
        for line in _of_words(" ".join(rest)):
            yield {first: next(iter(line.values()))}
        goal, *names = rest
        if names:
            yield {first: {goal: names[0] if len(names) == 1 else names}}
        return
    if first == "ask" and rest:
        first, *rest = rest
    if first in ASKS:
        yield {"ask": first}
    elif first in _STEPS and (number := _number(" ".join(rest))) is not None:
        yield {first: number}
    elif first in OBSERVATIONS and rest:
        if first == "at" and len(rest) > 1:
            yield {"observe": {"at": {rest[0]: rest[1]}}}
        yield {"observe": {first: rest if first in ("enter", "leave") else rest[0]}}
    elif first in GOALS and rest:
        yield {"goal": {first: rest[0] if len(rest) == 1 else {rest[0]: rest[1]}}}
    elif len(rest) and rest[0].lower().startswith(("enter", "leave")):
        yield {"observe": {rest[0].lower()[:5]: [words[0]]}}


def _values(text: str) -> Iterator[object]:
    """Yields the values of a text in JSON that was not finished or goes on, in Python, in YAML."""
    text = text.strip().rstrip(";,").strip()
    if not text or len(text) > _MOST:
        return
    start = text.find("{")
    decoder = json.JSONDecoder()
    for attempt in (text, text[start:] if start > 0 else "", text + _closers(text)):
        try:
            yield decoder.raw_decode(attempt)[0]
        except (ValueError, RecursionError):
            continue
    with suppress(ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        yield ast.literal_eval(text)
    if re.search(r"[&*!]", text):  # anchors and tags have no place here
        return
    import yaml

    for attempt in (re.sub(r"(\w)([\"']?)\s*(=>|=|:)\s*", r"\1\2: ", text), text + _closers(text)):
        try:
            yield yaml.load(attempt, yaml.SafeLoader)
        except (yaml.YAMLError, ValueError, RecursionError, TypeError, AttributeError):
            continue


def _closers(text: str) -> str:
    """Returns the brackets that are missing at the end of a text."""
    stack: list[str] = []
    quoted = False
    for char in re.sub(r"\\.", "", text):
        if char == '"':
            quoted = not quoted
        elif not quoted and char in "{[":
            stack.append("}" if char == "{" else "]")
        elif not quoted and char in "}]" and stack:
            stack.pop()
    return ('"' if quoted else "") + "".join(reversed(stack))


def _kind(key: object) -> str:
    """Returns a key in the words of the protocol."""
    word = str(key).strip().strip("\"'").lower()
    if word in (*EVENTS, *OBSERVATIONS, *GOALS, *ASKS, *_NAMED):
        return word
    if word in _OTHER_WORDS:
        return _OTHER_WORDS[word]
    from sparc.spelling import nearest

    return nearest(word[:30], [*EVENTS, *OBSERVATIONS, *GOALS], 0.75) or word


def _plain(value: object) -> object:
    """Returns a list of one as what is in it."""
    return value[0] if isinstance(value, (list, tuple)) and len(value) == 1 else value
