"""Describes the findings of a study in sentences. Entry points `comparison_sentences`, `level_sentences`, `value_of`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from sparc.lazy_dataclass import dataclass
from waiter_cli.model.wording import counted, in_words
from waiter_cli.study.comparisons import ENOUGH, Comparison, Difference, Interval, level_of
from waiter_cli.study.store import Row

__all__ = [
    "TOLD",
    "WORDS",
    "amount_of",
    "comparison_sentences",
    "difference_sentence",
    "level_sentences",
    "subject",
    "value_of",
]


@dataclass(frozen=True)
class Wording:
    """The words for a figure: ``{}`` stands for a number with its unit.

    ``more`` and ``less`` say a difference, ``either`` what is not known, ``what`` the figure itself;
    ``bare`` are the words for a difference without its subject.
    """

    what: str
    more: str
    less: str
    either: str
    bare: tuple[str, str]
    unit: str = ""


WAITS = {
    "seat": "for a table",
    "order": "to order",
    "plate": "for the plate",
    "bill": "for the bill",
}


def _wait(whose: str) -> Wording:
    return Wording(
        whose,
        f"{whose} is {{}} longer",
        f"{whose} is {{}} shorter",
        f"whether {whose} is longer or shorter",
        ("longer", "shorter"),
        "time",
    )


WORDS = {
    "lost": Wording(
        "parties that are lost",
        "{} parties more are lost an evening",
        "{} parties fewer are lost an evening",
        "whether more or fewer parties are lost",
        ("more", "fewer"),
    ),
    "lost_unseated": Wording(
        "parties that leave unseated",
        "{} parties more leave unseated an evening",
        "{} parties fewer leave unseated an evening",
        "whether more or fewer parties leave unseated",
        ("more", "fewer"),
    ),
    "lost_unserved": Wording(
        "parties that leave unserved",
        "{} parties more leave unserved an evening",
        "{} parties fewer leave unserved an evening",
        "whether more or fewer parties leave unserved",
        ("more", "fewer"),
    ),
    "served": Wording(
        "parties that are served",
        "{} parties more are served an evening",
        "{} parties fewer are served an evening",
        "whether more or fewer parties are served",
        ("more", "fewer"),
    ),
    **{
        f"wait_{what}_{measure}": _wait(f"the {word} wait {name}")
        for what, name in WAITS.items()
        for measure, word in (("mean", "mean"), ("p50", "median"), ("p95", "95 %"))
    },
    "table_use": Wording(
        "the share of the time for which tables are taken",
        "tables are taken for {} more of the time",
        "tables are taken for {} less of the time",
        "whether tables are taken for more or less of the time",
        ("more", "less"),
        "share",
    ),
    "idle": Wording(
        "the share of the time for which a robot is idle",
        "a robot is idle for {} more of the time",
        "a robot is idle for {} less of the time",
        "whether a robot is idle for more or less of the time",
        ("more", "less"),
        "share",
    ),
    "metres": Wording(
        "metres driven",
        "{} more are driven an evening",
        "{} less are driven an evening",
        "whether more or less is driven",
        ("more", "less"),
        "metres",
    ),
    "late": Wording(
        "late decisions",
        "{} decisions more are late an evening",
        "{} decisions fewer are late an evening",
        "whether more or fewer decisions are late",
        ("more", "fewer"),
    ),
}
TOLD = {
    name: WORDS[name]
    for name in (
        "lost_unseated", "lost_unserved", "served", "wait_seat_mean", "wait_seat_p95",
        "wait_order_mean", "wait_plate_mean", "wait_bill_mean", "table_use", "idle", "metres",
    )
}  # fmt: skip
"""The figures that are told in words unless one is asked for, in the order in which they are."""


def subject(comparison: Comparison) -> str:
    """Returns how a sentence on a comparison begins."""
    first, other = comparison.first, comparison.other
    if comparison.vary == "agents":
        if (first, other) == (1, 2):
            return "With a second robot"
        one = "one" if first == 1 else value_of("agents", first)
        return f"With {value_of('agents', other)} instead of {one}"
    if comparison.vary == "change":
        return "Then"
    if comparison.vary == "speed":
        return f"At {value_of('speed', other)} instead of {value_of('speed', first)}"
    return f"In {other} instead of {first}"


def _begin(comparison: Comparison) -> str:
    """Returns the subject, with a comma where the words after it could run into it."""
    return subject(comparison) + ("" if comparison.vary in ("agents", "change") else ",")


def _pause(comparison: Comparison) -> str:
    """Returns the subject as it stands before a main clause of its own."""
    return subject(comparison) + ("" if comparison.vary == "change" else ",")


def amount_of(figure: str, value: float) -> str:
    """Returns a value of a figure with its unit."""
    ((size, unit),) = _amounts(WORDS[figure].unit, value)
    return size + unit


def value_of(vary: str, value: Any) -> str:
    """Returns a value of what varies, in words."""
    if vary == "agents":
        return "1 robot" if value == 1 else f"{value} robots"
    return f"{value:g} m/s" if vary == "speed" else str(value)


def comparison_sentences(comparison: Comparison) -> Iterator[str]:
    """Yields sentences on a comparison: what the data support first, then what they do not."""
    told = [each for each in comparison.differences if each.figure in TOLD and each.found]
    order = list(TOLD)
    told.sort(key=lambda each: order.index(each.figure))
    if comparison.evenings < ENOUGH:
        many = (
            "no evening has" if not comparison.evenings else counted(comparison.evenings, "evening")
        )
        verb = "" if not comparison.evenings else " have" if comparison.evenings > 1 else " has"
        begin = subject(comparison)
        what = f"{many}{verb} a run of either that is done"
        yield f"{begin}: {what}; an interval takes {ENOUGH}."
        return
    for each in told:
        if each.verdict in ("more", "less"):
            yield difference_sentence(comparison, each)
    unknown = [each for each in told if each.verdict == "unsupported"]
    if len(unknown) == 1:
        yield difference_sentence(comparison, unknown[0])
    elif unknown:
        several = "; ".join(f"{TOLD[each.figure].what} ({_range(each)})" for each in unknown)
        yield f"{_pause(comparison)} the data do not say which way these go: {several}."
    same = [TOLD[each.figure].what for each in told if each.verdict == "same"]
    if same:
        yield f"{_begin(comparison)} no evening differs in {in_words(same, 'or')}."
    if comparison.left_out:
        many = counted(comparison.left_out, "evening")
        verb = "is" if comparison.left_out == 1 else "are"
        yield f"{many} {verb} left out of this: a run of the pair is not done."


def difference_sentence(comparison: Comparison, difference: Difference) -> str:
    """Returns one sentence on one figure; empty where there is nothing to say of it."""
    wording, found = WORDS.get(difference.figure), difference.found
    if wording is None or found is None:
        return ""
    if difference.verdict in ("more", "less"):
        ends = sorted((abs(found.low or 0.0), abs(found.high or 0.0)))
        size, low, high = _amounts(wording.unit, abs(found.mean), *ends)
        words = wording.more if difference.verdict == "more" else wording.less
        around = "as much each evening" if found.low == found.high else f"{low[0]} to {high[0]}"
        return f"{_begin(comparison)} {words.format(size[0] + size[1])} ({around})."
    if difference.verdict == "unsupported":
        return f"{_pause(comparison)} the data do not say {_unsupported(difference)}."
    if difference.verdict == "same":
        return f"{_begin(comparison)} no evening differs in {wording.what}."
    return ""


def _unsupported(difference: Difference) -> str:
    """Returns what is not known of a figure, with the interval."""
    return f"{WORDS[difference.figure].either} ({_range(difference)})"


def _range(difference: Difference) -> str:
    """Returns an interval that holds 0, in words."""
    wording, found = WORDS[difference.figure], difference.found
    assert found is not None and found.low is not None and found.high is not None
    more, less = wording.bare
    low, high = _amounts(wording.unit, abs(found.low), abs(found.high))
    return f"{low[0]}{low[1]} {less} to {high[0]}{high[1]} {more}"


def level_sentences(rows: Sequence[Row]) -> Iterator[str]:
    """Yields what an evening is like in one combination."""
    parties = level_of(rows, "parties")
    if parties is None:
        return
    lost, served = level_of(rows, "lost_unseated"), level_of(rows, "served")
    if lost is not None and served is not None:
        parts = [
            f"{size} {what}{around}"
            for what, found in (("are served", served), ("leave unseated", lost))
            for size, around in (_with_range(found, ""),)
        ]
        yield f"Of {parties.mean:.1f} parties an evening {' and '.join(parts)}."
    for figure, what in (
        ("wait_seat_mean", "A party waits {} for its table"),
        ("wait_plate_mean", "It waits {} for its plate"),
    ):
        found = level_of(rows, figure)
        if found is not None:
            size, around = _with_range(found, "time")
            yield f"{what.format(size)}{around}."


def _with_range(found: Interval, unit: str) -> tuple[str, str]:
    """Returns a mean with its unit, and its interval in parentheses where there is one."""
    if found.low is None or found.high is None or found.low == found.high:
        ((size, word),) = _amounts(unit, found.mean)
        return size + word, ""
    mean, low, high = _amounts(unit, found.mean, found.low, found.high)
    return mean[0] + mean[1], f" ({low[0]} to {high[0]})"


def _amounts(unit: str, *values: float) -> list[tuple[str, str]]:
    """Returns numbers as text, all with the same digits, each with its unit.

    What is not nothing does not read so.

    >>> _amounts("", 0.31, 0.04), _amounts("time", 150.0)
    ([('0.31', ''), ('0.04', '')], [('2.5', ' minutes')])
    """
    most = max(abs(value) for value in values)
    if unit == "time" and most >= 90.0:
        return _texts([value / 60 for value in values], 1, " minutes")
    if unit == "time":
        return _texts(values, 1 if most < 10 else 0, " seconds")
    if unit == "share":
        shares = [100 * value for value in values]
        return _texts(shares, 0 if most >= 0.1 else 1, " percentage points")
    if unit == "metres":
        return _texts(values, 0 if most >= 10 else 1, " metres")
    return _texts(values, 1 if most >= 0.1 or most == 0.0 else 2, "")


def _texts(values: Sequence[float], digits: int, unit: str) -> list[tuple[str, str]]:
    while digits < 3 and any(value and not float(f"{value:.{digits}f}") for value in values):
        digits += 1
    return [(f"{value:.{digits}f}", unit) for value in values]
