"""Every slip of a text is found in one run, and none brings another fault with it."""

from __future__ import annotations

import random
from collections.abc import Sequence

import pytest

from sparc.errors import SourceError
from sparc.source import Source
from sparc.syntax.lexer import scan
from sparc.syntax.parser import parse
from tests.support import sparc_texts
from tests.support.paths import ROOT

PROGRAMS = [
    path.read_text(encoding="utf-8") for path in sorted((ROOT / "domains").rglob("*.sparc"))
]
HEAD = "sorts\n#p = {ann, ben}.\n#n = 1..9.\npredicates\nq(#p). r(#p). s(#n). e(#n,#n). z().\n"


def faults(text: str) -> list[SourceError]:
    return sparc_texts.faults(Source("x", text))


def places(text: str) -> list[str]:
    """The places of all faults, as ``LINE:COLUMN``."""
    return [str(fault.span.location)[2:] for fault in faults(text) if fault.span]


TWENTY = """\
#const n 3.                     % 10
sorts
#p = {ann ben}.                 % 11
#n = 1...9.                     % 9
predicates
q(#p)
r(#p). s(#n). e(#n, #n). z.     % 27
t(p).                           % 3
rules
q(ann) q(ben).                  % 8
r(X) :- q(X), .                 % 15
r(ann :- q(ann).                % 7
r(X) <- q(X).                   % 6
r(X) :– q(X).                   % 6
z() :- q(ann).                  % 3
q("ann. b").                    % 3
s(3.5).                         % 4
s(X) :- s(Y), X = Y mod 2.      % 21
{q(ann), q(ben)}.               % 8
z :- not not q(ann).            % 10
e(1..3, 2).                     % 7
s(X+n) :- s(X), X > -1.         % 21
q(ann),
r(ben) :- q(ben) & z.           % 18
display
q, r.                           % 2
z :- q(ann).                    % 1
"""


def test_twenty_slips_and_more() -> None:
    expected = []
    for number, line in enumerate(TWENTY.splitlines(), 1):
        if "% " in line:
            expected.append(f"{number}:{line.rpartition('% ')[2]}")
        elif line in ("q(#p)", "q(ann),"):  # a dot is missing, or is a comma
            expected.append(f"{number}:{len(line) if line[-1] == ',' else len(line) + 1}")
    assert len(expected) > 20
    assert places(TWENTY) == expected


@pytest.mark.parametrize(
    ("text", "place", "mend"),
    [
        (HEAD[6:] + "rules\nz.\n", "1:1", "the word sorts"),
        (HEAD.replace("predicates\n", "") + "rules\nz.\n", "4:1", '"predicates" before this'),
        (HEAD + "z.\nq(ann).\n", "6:1", '"rules" before this'),
        (HEAD + "z :- q(ann).\n", "6:1", '"rules" before this'),
        (HEAD + ":- q(ann).\n", "6:1", '"rules" before this'),
        (HEAD + "rule\nz.\nr(X) :- q(X).\n", "6:1", 'did you mean "rules"?'),
        (HEAD + "rules:\nz.\nr(X) :- q(X).\n", "6:1", "white space must follow"),
        (HEAD.replace("#p = ", "p = ") + "rules\nz.\n", "2:1", "write #p"),
    ],
)
def test_section_words(text: str, place: str, mend: str) -> None:
    (fault,) = faults(text)
    assert fault.span and str(fault.span.location) == f"x:{place}"
    assert mend in (fault.hint or "")


def test_a_text_without_any_section_has_one_fault() -> None:
    assert len(faults("nodes: {a: [0, 1]}\nedges:\n  - [a, b]\n")) == 1


def test_a_constant_that_cannot_be_read_is_known() -> None:
    text = "#const n 3.\nsorts\n#s = 1..n.\npredicates\np(#s).\nrules\np(X+n) :- p(X), X <= n.\n"
    assert places(text) == ["1:10"]


def test_reading_ends_with_a_hundred_faults() -> None:
    assert len(faults(f"{HEAD}rules\n" + "z z.\n" * 3000)) == 100


WORDS = [
    "a",
    "X",
    "7",
    "#s",
    "not",
    ".",
    ",",
    ";",
    ":",
    ":-",
    ":+",
    "|",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    "=",
    "<",
    "+",
    "-",
    '"',
    "&",
    "\\",
    "!",
    "<-",
    "=>",
    "é",
    "..",
]


def slip(random_: random.Random, text: str) -> tuple[str, int, int]:
    """The text with one token dropped, doubled, replaced, or another one put behind it.

    Also the places where the statement begins and where the one behind it ends.
    """
    tree = parse(Source("x", text))
    parts = (tree.directives, tree.sorts, tree.predicates, tree.statements, tree.display or ())
    spans = [node.span for part in parts for node in part]
    index = random_.randrange(len(spans))
    span = spans[index]
    following = spans[min(index + 1, len(spans) - 1)]
    tokens = [
        (word, start)
        for _, word, start in zip(*scan(Source("x", text)), strict=True)
        if span.start <= start < span.end
    ]
    word, start = random_.choice(tokens)
    other = random_.choice(WORDS)
    new = random_.choice(["", f"{word} {word}", f" {other} ", f"{word} {other} "])
    changed = text[:start] + new + text[start + len(word) :]
    return changed, span.start, following.end + len(new) - len(word)


def try_slips(seeds: Sequence[int]) -> None:
    several = 0
    for seed in seeds:
        random_ = random.Random(seed)
        text, first, last = slip(random_, random_.choice(PROGRAMS))
        found = faults(text)
        several += len(found) > 1
        for fault in found:
            assert fault.span and first <= fault.span.start <= last, (seed, fault.message)
    assert several <= max(1, len(seeds) // 200)  # "p . #s)." reads as two statements, both wrong


def test_a_slip_has_no_followers() -> None:
    try_slips(range(50))


@pytest.mark.slow
def test_many_slips_have_no_followers() -> None:
    try_slips([*range(300), *range(1000, 11_000)])
