"""Answer sets in the order of time: sorting, grouping by step, filtering, comparing.

Pure functions of values; entry points `Timeline` (which argument is the step, and the order) and
`Filter` (which literals are shown).

>>> from sparc.answer_sets import GroundLiteral, GroundTerm
>>> line = Timeline({"holds": ("fluent", "step"), "fact": ("fluent",)})
>>> lit = GroundTerm("lit")
>>> shown = line.sort({GroundLiteral("holds", (lit, 1)), GroundLiteral("holds", (lit, 0)),
...                    GroundLiteral("fact", (lit,))})
>>> [str(literal) for literal in shown]
['fact(lit)', 'holds(lit,0)', 'holds(lit,1)']
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from sparc.answer_sets import AnswerSet, Ground, GroundLiteral
from sparc.lazy_dataclass import dataclass
from waiter_cli.errors import InputError

__all__ = [
    "Filter", "Group", "Order", "Timeline", "differences", "read_patterns", "read_steps",
]  # fmt: skip

KINDS = ("obs", "occurs", "holds")
"""The predicates that tell the sort of steps, in the order in which a step lists them."""

TIME_SORTS = frozenset(("step", "time", "timestep", "moment", "t"))
"""The names by which a sort is known for time where nothing holds, occurs or is observed."""

_RANK = {name: rank for rank, name in enumerate(KINDS)}


@dataclass(frozen=True)
class Group:
    """The literals of one step, in order; ``step`` is None for those without one."""

    step: int | None
    literals: tuple[GroundLiteral, ...]


@dataclass(frozen=True)
class Order:
    """The options about time: the name of its sort (None: not given), or that there is none."""

    time_sort: str | None = None
    flat: bool = False


class Timeline:
    """The order of literals in a program with these ``signatures`` (predicate → names of sorts).

    A literal's step is its last argument where that has the sort of the last argument of
    ``holds``, ``occurs`` or ``obs``; in a program without these, where its sort is called as
    `TIME_SORTS` are.  ``order`` may name the sort instead, or do without time.  ``aliases`` maps a sort that is another by definition to it; ``numbers`` are the sorts that may have numbers
    (None: any may).  ``has_steps`` is whether any literal can have a step.
    """

    def __init__(
        self,
        signatures: Mapping[str, Sequence[str]],
        aliases: Mapping[str, str] | None = None,
        numbers: frozenset[str] | None = None,
        order: Order | None = None,
    ) -> None:
        aliases = aliases or {}
        self.arities = {name: len(sorts) for name, sorts in signatures.items()}

        def names(sort: str) -> list[str]:
            """Returns the sort and what it is another name of, the sort itself last."""
            found = [sort]
            while (sort := aliases.get(sort, sort)) not in found:
                found.append(sort)
            return found

        lasts = {name: names(sorts[-1]) for name, sorts in signatures.items() if sorts}
        kinds = [name for name in KINDS if name in signatures]
        order = order or Order()
        if order.flat:
            timed: Iterable[str] = ()
        elif order.time_sort is not None:
            timed = (name for name, last in lasts.items() if last[-1] == names(order.time_sort)[-1])
        elif kinds:
            step_sorts = {lasts[name][-1] for name in kinds if name in lasts}
            timed = (name for name, last in lasts.items() if last[-1] in step_sorts)
        else:
            timed = (name for name, last in lasts.items() if not TIME_SORTS.isdisjoint(last))
        self._timed = frozenset(timed)
        self.has_steps = any(
            numbers is None or not numbers.isdisjoint(signatures[name][-1:]) for name in self._timed
        )

    def step(self, literal: GroundLiteral) -> int | None:
        """Returns the step the literal is about."""
        if literal.name not in self._timed or not literal.arguments:
            return None
        last = literal.arguments[-1]
        return last if isinstance(last, int) else None

    def key(self, literal: GroundLiteral) -> tuple[Any, ...]:
        """Returns a sort key: step, kind, name, arguments, positive before negative."""
        step = self.step(literal)
        return (
            step is not None,
            step or 0,
            _RANK.get(literal.name, len(KINDS)),
            literal.name,
            tuple(map(_term_key, literal.arguments)),
            literal.negated,
        )

    def sort(self, literals: Iterable[GroundLiteral]) -> tuple[GroundLiteral, ...]:
        """Returns the literals in the order of time."""
        return tuple(sorted(literals, key=self.key))

    def groups(self, literals: Iterable[GroundLiteral]) -> Iterator[Group]:
        """Yields the literals step by step, those without a step first; no group is empty."""
        group: list[GroundLiteral] = []
        current: int | None = None
        for literal in self.sort(literals):
            step = self.step(literal)
            if group and step != current:
                yield Group(current, tuple(group))
                group = []
            current = step
            group.append(literal)
        if group:
            yield Group(current, tuple(group))


def _term_key(term: Ground) -> tuple[Any, ...]:
    """Returns a sort key: numbers as numbers, before names.

    Names by character, ``f`` before ``f(a)``.
    """
    if isinstance(term, int):
        return (0, term)
    return (1, term.name, tuple(map(_term_key, term.arguments)))


# ------------------------------------------------------------------ filters


@dataclass(frozen=True)
class Filter:
    """A filter of literals; each condition that is given must hold.

    ``patterns``: one of them matches somewhere in the literal's text (with ``invert``: none
    does).  ``steps``: the step lies within both ends, None being open; a literal without a step
    goes.  ``only``: names of predicates.  ``negative`` False drops literals like ``-p(a)``.
    """

    patterns: tuple[re.Pattern[str], ...] = ()
    invert: bool = False
    steps: tuple[int | None, int | None] | None = None
    only: frozenset[str] | None = None
    negative: bool = True

    def __bool__(self) -> bool:
        """Returns whether any literal could be dropped."""
        return bool(
            self.patterns or self.steps is not None or self.only is not None or not self.negative
        )

    def keeps(self, literal: GroundLiteral, step: int | None) -> bool:
        """Returns whether the literal, which is about ``step``, stays."""
        if literal.negated and not self.negative:
            return False
        if self.only is not None and literal.name not in self.only:
            return False
        if self.steps is not None:
            low, high = self.steps
            if step is None or (low is not None and step < low):
                return False
            if high is not None and step > high:
                return False
        if self.patterns:
            text = str(literal)
            return any(pattern.search(text) for pattern in self.patterns) != self.invert
        return True

    def ignoring_case(self) -> Filter:
        """Returns the same filter, by which an ``a`` of a pattern stands for ``A`` too."""
        loose = (re.compile(each.pattern, each.flags | re.IGNORECASE) for each in self.patterns)
        return replace(self, patterns=tuple(loose))

    def matches(self, text: str) -> list[tuple[int, int]]:
        """Returns the stretches of ``text`` that made it stay, sorted and not overlapping."""
        if self.invert:
            return []
        spans = sorted(
            match.span()
            for pattern in self.patterns
            for match in pattern.finditer(text)
            if match.end() > match.start()
        )
        joined: list[tuple[int, int]] = []
        for start, end in spans:
            if joined and start <= joined[-1][1]:
                joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
            else:
                joined.append((start, end))
        return joined


def read_patterns(
    texts: Sequence[str], *, ignore_case: bool = False
) -> tuple[re.Pattern[str], ...]:
    """Returns the regular expressions of ``--grep``; raises `InputError` for one that is none."""
    patterns = []
    for text in texts:
        try:
            patterns.append(re.compile(text, re.IGNORECASE if ignore_case else 0))
        except (re.error, RecursionError, OverflowError) as error:
            raise InputError(
                f"--grep {text!r} is no regular expression: {error}",
                "put a backslash before ( ) [ ] { } . * + ? | to mean the character itself",
            ) from error
    return tuple(patterns)


_STEPS = re.compile(r"(?P<low>[0-9]{1,9})?(?P<to>\.\.)?(?P<high>[0-9]{1,9})?")


def read_steps(text: str) -> tuple[int | None, int | None]:
    """Returns the ends of ``A..B``, ``A..``, ``..B`` or ``A``, both included, None where open.

    Raises `InputError` for anything else.
    """
    match = _STEPS.fullmatch(text.strip())
    if match is None or not (match["low"] or match["high"]):
        raise InputError(f"--steps {text}: not a range of steps", "write 2..5, 2.., ..5 or 2")
    low = None if match["low"] is None else int(match["low"])
    high = None if match["high"] is None else int(match["high"])
    if match["to"] is None:
        high = low
    if low is not None and high is not None and low > high:
        raise InputError(f"--steps {text}: the first step is after the last", "write 2..5")
    return low, high


# ------------------------------------------------------------------ several answer sets


def differences(
    answer_sets: Sequence[AnswerSet],
) -> tuple[frozenset[GroundLiteral], tuple[frozenset[GroundLiteral], ...]]:
    """Returns the literals that all the answer sets share, and those that each has beyond them."""
    if not answer_sets:
        return frozenset(), ()
    common = frozenset.intersection(*(each.literals for each in answer_sets))
    return common, tuple(each.literals - common for each in answer_sets)
