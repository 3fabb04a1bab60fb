"""``KIND:ARGS`` of ``--inject`` → `Injection`: what goes wrong, and when. Entry point `read_injection`."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from sparc.lazy_dataclass import dataclass
from sparc.numerals import decimal, whole
from waiter_cli.errors import Fault, InputError, Where
from waiter_cli.files.names import fresh_customers
from waiter_cli.model.layout import Layout
from waiter_cli.model.problem import Problem
from waiter_cli.model.scenario import TimedEvent
from waiter_cli.problems.guests import guests_to_come, names_in_use, unknown_guest
from waiter_cli.spelling import did_you_mean

__all__ = ["FORMS", "Injection", "read_injection", "read_injections"]

FORMS = {
    "block": "block:NODE-NODE@SECONDS[+SECONDS]",
    "leave": "leave:CUSTOMER@SECONDS",
    "enter": "enter:GUESTS@SECONDS",
    "bill": "bill:TABLE@SECONDS",
    "slip": "slip:PROBABILITY",
    "stall": "stall:[ROBOT:]SECONDS@SECONDS",
    "out": "out:ROBOT@SECONDS[+SECONDS]",
}
MAX_SECONDS = 86_400.0


@dataclass(frozen=True)
class Injection:
    """Something that goes wrong.

    ``subject`` is the edge, customer, number of guests, table or robot; ``amount`` how long a block,
    stall or absence lasts (None: for good) or the probability of a slip; ``time`` in simulated seconds.
    """

    kind: str
    text: str
    time: float = 0.0
    subject: tuple[str, ...] = ()
    amount: float | None = None


def read_injections(
    texts: Sequence[str], problem: Problem, timed: Sequence[TimedEvent] = ()
) -> tuple[Injection, ...]:
    """Returns every injection of a command line; raises `InputError` with every fault.

    Whoever leaves is inside, or comes in by an event or another injection.
    """
    injections: list[Injection] = []
    faults: list[Fault] = []
    for text in texts:
        try:
            injections.append(read_injection(text, problem.layout))
        except InputError as error:
            faults += error.faults
    slips = [each for each in injections if each.kind == "slip"]
    for again in slips[1:]:
        message = f"{slips[0].text} is the probability of every slip; this is a second one"
        faults.append(Fault(_place(again.text), message, "give one slip:P"))
    made_up = sum(int(each.subject[0]) for each in injections if each.kind == "enter")
    fresh = islice(fresh_customers(names_in_use(problem, timed)), made_up)
    known = (*guests_to_come(problem, timed), *fresh)
    for each in injections:
        if each.kind == "leave" and each.subject[0] not in known:
            name = each.subject[0]
            hint = unknown_guest(name, known, problem)
            faults.append(Fault(_place(each.text), f"unknown customer {name}", hint))
    if faults:
        raise InputError(faults)
    return tuple(injections)


def read_injection(text: str, layout: Layout) -> Injection:
    """Returns one injection.

    Raises `InputError` that says its form.  Who is inside is not asked here.
    """
    kind, colon, rest = text.partition(":")
    kind = kind.strip()
    if kind not in FORMS or not colon:
        raise _wrong(
            text, f"no such injection: {kind or 'nothing'}", "one of " + ", ".join(FORMS.values())
        )
    if kind == "slip":
        chance = _number(text, rest, kind)
        if not 0.0 <= chance <= 1.0:
            raise _wrong(text, f"a probability lies between 0 and 1, found {rest}", FORMS[kind])
        return Injection(kind, text, amount=chance)
    subject, at, when = rest.rpartition("@")
    if not at or not subject:
        raise _wrong(text, f"{text} does not say what or when", FORMS[kind])
    lasting = None
    if kind in ("block", "out") and "+" in when:
        when, _, span = when.partition("+")
        lasting = _number(text, span, kind)
    time = _number(text, when, kind)
    match kind:
        case "block":
            names = tuple(subject.split("-"))
            known = {frozenset(edge) for edge in layout.edges}
            if len(names) != 2 or frozenset(names) not in known:
                edges = ", ".join("-".join(edge) for edge in layout.edges[:8])
                more = ", …" if len(layout.edges) > 8 else ""
                raise _wrong(text, f"there is no edge {subject}", f"edges are {edges}{more}")
            return Injection(kind, text, time, names, lasting)
        case "enter":
            if not 1 <= (whole(subject) or 0) <= 1000:
                raise _wrong(
                    text, f"a party has from 1 to 1000 guests, found {subject}", FORMS[kind]
                )
        case "bill":
            tables = [table.name for table in layout.tables]
            if subject not in tables:
                hint = did_you_mean(subject, tables, "table") or FORMS[kind]
                raise _wrong(text, f"unknown table {subject}", hint)
        case "stall":
            who, colon, seconds = subject.rpartition(":")
            robot = (_robot(text, who, kind, layout),) if colon else ()
            return Injection(kind, text, time, robot, _number(text, seconds, kind))
        case "out":
            return Injection(kind, text, time, (_robot(text, subject, kind, layout),), lasting)
        case "leave":
            if not subject.isidentifier():
                raise _wrong(text, f"{subject} is no name of a customer", FORMS[kind])
    return Injection(kind, text, time, (subject,))


def _robot(text: str, name: str, kind: str, layout: Layout) -> str:
    """Returns the name of one of several robots; raises `InputError`."""
    names = [robot for robot, _ in layout.agents]
    if not names:
        raise _wrong(text, f"there is one robot, and no name for it; found {name}", FORMS[kind])
    if name not in names:
        hint = did_you_mean(name, names, "robot") or f"robots: {', '.join(names)}"
        raise _wrong(text, f"unknown robot {name}", hint)
    return name


def _number(text: str, digits: str, kind: str) -> float:
    value = decimal(digits)
    if value is None or not 0.0 <= value <= MAX_SECONDS:
        raise _wrong(text, f"{digits or 'nothing'} is no number that fits here", FORMS[kind])
    return value


def _wrong(text: str, message: str, hint: str) -> InputError:
    return InputError([Fault(_place(text), message, hint)])


def _place(text: str) -> Where:
    return Where(f"--inject {text}")
