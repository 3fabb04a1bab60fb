"""Whatever is typed, a text that was edited is told as the same text opened anew."""

from __future__ import annotations

import random
import re

import pytest

import sparc
from sparc.errors import SourceError, SourceErrors
from sparc.language_server.document import Document, Finding
from sparc.language_server.symbols import index
from sparc.source import Source
from sparc.syntax.lexer import scan
from tests.properties.test_parser_fuzz import CHARACTERS, GOOD, WORDS
from tests.support.paths import ROOT
from tests.support.random_programs import random_program
from tests.support.sampling import mostly_wide

NUMBERS = """#const n = 3.
#maxint = 300.
sorts
#s = 0..9. #t = 0..n. #cost = 0..40. #name = {a, b, c}.
predicates
p(#s). q(#t). cost(#name, #cost). whole(#cost). at(#name, #s).
rules
r1 : p(1) :+ not p(2).
r2 : p(2) :+ .
p(X*X) :- p(X).
p(X+Y*3) :- p(X), q(Y).
q(X-1) :- q(X), X < n.
whole(S) :- #sum{C,N : cost(N, C)} = S.
cost(N, X*Y) :- at(N, X), p(Y).
{at(N, X) : p(X)} 1 :- cost(N, C).
:- at(N, X), at(M, X), N != M.
:~ p(X). [X:1]
p(500) :- q(0).
display
p. cost(a, X).
"""
SORTS = """#const n = 3.
#const low = 1.
sorts
#s = low..n. #t = 0..9. #both = #s + #t. #name = {a, b, f(a), g(3)}. #rec = r(#s(X), #t(Y)) : X < Y.
#alias = #s. #joined = [x][1..n]. #far = {z1, z2}.
predicates
p(#s). q(#t). u(#both). named(#name). rec(#rec). al(#alias). j(#joined). away(#far).
rules
p(low). q(3). named(f(a)). j(x1). rec(r(1, 2)). p(1..n). away(z1).
q(X) :- p(X), q(X).
q(X+1) :- q(X), X < 7.
u(X*2) :- u(X), p(X).
p(X) :- al(X), X != 2.
rec(r(X, Y)) :- p(X), q(Y), X > Y.
rec(r(X, Y)) :- rec(r(X, Y)), X > low.
named(f(X)) :- named(X), X != b.
q(N) :- q(N), p(A), u(Other).
:- named(X), X = z1.
:- q(X), #s(X), not #t(X).
q(S) :- #count{J : j(J)} = S.
q(Low) :- q(9).
"""
SPOTS = re.compile(r"\b(?:\d+|low|n|[abfg]|z[12]|#[a-z]+)\b")
NEW = [
    "0",
    "1",
    "2",
    "3",
    "5",
    "9",
    "12",
    "501",
    "n",
    "low",
    "a",
    "b",
    "z1",
    "#s",
    "#t",
    "#far",
    "#nat",
]
LABELS = NUMBERS.replace("r2 :", "r1 :")  # the one's fault names the line of the other
STEPS = "".join(f"cost(N, X*Y/{i % 3 + 3}) :- at(N, X), p(Y).\n" for i in range(40))
SEARCHES = NUMBERS.replace(
    "p(500) :- q(0).\n", STEPS + STEPS.replace("/", "-")
)  # more than are tried
RULES = ["p(X) :- q(X), not p(3).\n", "bad(X, Y) :- p(X).\n", ":- p(X), X > 2001.\n", "q(1)"]


def texts() -> list[str]:
    """What is edited."""
    mistakes = sorted((ROOT / "tests" / "sparc" / "mistakes").glob("*.sparc"))
    read = [path.read_text(encoding="utf-8", errors="replace") for path in mistakes]
    return [
        NUMBERS,
        LABELS,
        SEARCHES,
        SORTS,
        *GOOD,
        *read,
        *(random_program(seed) for seed in range(20)),
    ]


def opened_anew(text: str) -> tuple[Finding, ...]:
    """What the whole program says, read by the functions that the commands use."""
    source = Source("x", text.replace("\r", " "))
    told: list[SourceError]
    try:
        typed = sparc.check(sparc.parse(source))
    except SourceErrors as errors:
        return findings("error", list(errors.errors))
    except SourceError as error:
        return findings("error", [error])
    try:
        told = list(sparc.find_warnings(typed))
    except SourceError:
        told = []
    return findings("warning", told)


def findings(severity: str, errors: list[SourceError]) -> tuple[Finding, ...]:
    found = []
    for each in errors:
        start, end = (each.span.start, each.span.end) if each.span is not None else (0, 1)
        found.append(
            Finding(severity, each.message, each.hint, start, max(end, start + 1), each.edit)
        )
    return tuple(found)


def edited(text: str, draw: random.Random, others: list[str]) -> str:
    """The text after one more edit."""
    at = draw.randrange(len(text) + 1)
    lines = text.splitlines(keepends=True)
    match draw.randrange(9):
        case 0:
            return text[:at] + draw.choice(CHARACTERS) + text[at:]
        case 1:
            return text[:at] + text[at + draw.choice([1, 1, 2, 12]) :]
        case 2:
            return text[:at] + f" {draw.choice(WORDS)} " + text[at:]
        case 3 | 4 if lines:  # a line is taken out, and perhaps put elsewhere
            line = lines.pop(draw.randrange(len(lines)))
            if draw.random() < 0.6:
                lines.insert(draw.randrange(len(lines) + 1), line)
            return "".join(lines)
        case 5:
            rest = text.find("\n", at) + 1
            return text[:rest] + draw.choice(RULES) + text[rest:]
        case 6 if lines:  # a line twice
            line = draw.randrange(len(lines))
            return "".join([*lines[:line], lines[line], *lines[line:]])
        case 7:
            return draw.choice(others)  # as undone, or pasted whole
    if draw.random() < 0.7:
        return declared_anew(text, draw)
    name = draw.choice("pqXYnab")
    return text.replace(name, draw.choice("pqXYnab"), 1)


def declared_anew(text: str, draw: random.Random) -> str:
    """The text with another number, name or element in what stands before the rules."""
    spots = list(SPOTS.finditer(text[: text.find("rules\n") + 1]))
    if not spots:
        return text
    spot = draw.choice(spots)
    new = draw.choice(NEW)
    return text[: spot.start()] + new + text[spot.end() :]


def session(seed: int, text: str, edits: int) -> None:
    draw = random.Random(seed)
    document = Document("x", text)
    versions = [text]
    for number in range(edits):
        text = edited(text, draw, versions) if draw.random() < 0.8 else versions[-1]
        versions.append(text)
        document = Document("x", text, document)
        where = f"seed {seed}, edit {number}"
        assert document.findings == opened_anew(text), where
        assert document.lexemes == scan(document.source), where
        assert document.names == index(scan(document.source)), where
        anew = Document("x", text)
        if not any(each.severity == "error" for each in document.findings):
            predicates = list(map(str, anew.declared.predicates.values()))
            assert list(map(str, document.declared.predicates.values())) == predicates, where
            assert list(document.declared.sorts) == list(anew.declared.sorts), where


@pytest.mark.parametrize("edits", mostly_wide([5, 12], 5))
def test_what_is_typed_is_told_as_what_is_opened(edits: int) -> None:
    for seed, text in enumerate([*texts()[:4] * 2, *texts()[4::5]]):
        session(seed, text, edits)


@pytest.mark.wide
def test_what_is_declared_anew_is_told_as_what_is_opened() -> None:
    for seed, original in enumerate([NUMBERS, *[SORTS] * 12]):
        draw = random.Random(seed)
        text, document = original, Document("x", original)
        for number in range(25):
            text = declared_anew(text if draw.random() < 0.5 else original, draw)
            document = Document("x", text, document)
            assert document.findings == opened_anew(text), f"seed {seed}, edit {number}"


DEPENDING = """#const top = 7.
sorts
#few = {a}. #s = {a, b, f(a)}. #num = 0..9. #only = 0..3. #one = f(#few). #two = f(#few) + h(#few).
predicates
p(#s). q(#num). u(#one). v(#two).
rules
:- q(X), X > top.
:- q(X), #only(X).
u(f(X)) :- u(f(X)), v(f(X)).
u(f(Y)) :- u(f(Y)), v(f(Y)).
:- u(f(Other)).
:- p(X), X != zz.
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("top = 7", "top = 12"),
        ("#only = ", "#once = "),
        ("#one = f", "#one = h"),
        ("#num", "#more = {other}. #num"),
        ("#num", "#more = {zz}. #num"),
    ],
)  # fmt: skip
def test_a_statement_is_told_anew_where_a_sort_that_it_asks_is_another(old: str, new: str) -> None:
    after = DEPENDING.replace(old, new, 1)
    edited_text = Document("x", after, Document("x", DEPENDING))
    assert edited_text.findings == opened_anew(after) != opened_anew(DEPENDING)


def test_what_a_faulty_sort_excused_is_told_once_it_is_in_order() -> None:
    pairs = DEPENDING.replace("#num", "#pair = g(#few,#few). #more = #late. #late = {y}. #num", 1)
    before = pairs.replace("u(#one).", "u(#one). w(#pair).") + ":- w(g(zz, X)).\n"
    after = before.replace("#more = #late. #late = {y}.", "#late = {y}. #more = #late.")
    assert Document("x", after, Document("x", before)).findings == opened_anew(after)
    assert any("zz is no element" in each.message for each in opened_anew(after))


@pytest.mark.slow
def test_long_sessions_are_told_as_what_is_opened() -> None:
    for seed in range(4):
        for number, text in enumerate(texts()):
            session(seed * 1000 + number, text, 40)


def test_a_rule_typed_letter_by_letter() -> None:
    head, rule, rest = NUMBERS.partition("p(X+Y*3) :- p(X), q(Y).\n")
    document = Document("x", NUMBERS)
    for end in range(len(rule) + 1):
        text = head + rule[:end] + rest
        document = Document("x", text, document)
        assert document.findings == opened_anew(text)


def test_what_one_rule_leaves_to_try_is_tried_for_others() -> None:
    """All rules share what may be tried; those behind are looked through once others are gone."""
    before = Document("x", SEARCHES)
    text = SEARCHES.replace(STEPS[: len(STEPS) // 4], "", 1)
    after = Document("x", text, before)
    assert after.findings == opened_anew(text)
    assert len(after.findings) > len(before.findings)
    assert Document("x", SEARCHES, after).findings == before.findings
