"""`waiter answersets`: what is listed, in which order, in which form, with which exit code."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from sparc.answer_sets import AnswerSet, GroundLiteral
from sparc.errors import SolverError
from tests.support.cli import waiter
from tests.support.jar import needs_jar
from tests.support.paths import ROOT
from waiter_cli.answersets import enumerate as answers_module
from waiter_cli.answersets import writers as answer_writers
from waiter_cli.answersets.timeline import Timeline

LAMPS = """sorts
#lamp = {left, right}.
#step = 0..2.
#fluent = lit(#lamp).
#action = switch(#lamp).
predicates
holds(#fluent, #step).
occurs(#action, #step).
broken(#lamp).
rules
-broken(left). -broken(right).
-holds(lit(L), 0).
1{occurs(switch(L), I)}1 :- I < 2, #step(I).
holds(lit(L), I+1) :- occurs(switch(L), I), -holds(lit(L), I).
-holds(lit(L), I+1) :- occurs(switch(L), I), holds(lit(L), I).
holds(lit(L), I+1) :- holds(lit(L), I), not occurs(switch(L), I), #step(I).
-holds(lit(L), I+1) :- -holds(lit(L), I), not occurs(switch(L), I), #step(I).
:- not holds(lit(left), 2).
"""
LEFT_LAST = [
    "-broken(left)",
    "-broken(right)",
    "occurs(switch(right),0)",
    "-holds(lit(left),0)",
    "-holds(lit(right),0)",
    "occurs(switch(left),1)",
    "-holds(lit(left),1)",
    "holds(lit(right),1)",
    "holds(lit(left),2)",
    "holds(lit(right),2)",
]
CHOICE = "sorts\n#n = 1..{n}.\npredicates\np(#n).\nrules\np(X) | -p(X).\n"
PIGEONS = (
    "sorts\n#p = 1..13.\n#h = 1..12.\npredicates\nin(#p,#h).\nrules\n"
    "1{in(P,H):#h(H)}1 :- #p(P).\n:- in(P,H), in(Q,H), P != Q.\n"
)


@pytest.fixture
def lamps(tmp_path: Path) -> str:
    path = tmp_path / "lamps.sparc"
    path.write_text(LAMPS)
    return str(path)


def program(tmp_path: Path, text: str) -> str:
    path = tmp_path / "program.sparc"
    path.write_text(text)
    return str(path)


# ------------------------------------------------------------------ JSON


def test_json_is_that_of_the_contract(lamps: str) -> None:
    ran = waiter("answersets", lamps, "--json", "-n", "0")
    document = ran.json()
    assert (ran.code, ran.err) == (0, "")
    assert set(document) == {"satisfiable", "complete", "answer_sets"}
    assert (document["satisfiable"], document["complete"]) == (True, True)
    assert {"literals": LEFT_LAST, "cost": []} in document["answer_sets"]
    assert len(document["answer_sets"]) == 2


def test_one_answer_set_unless_told(lamps: str) -> None:
    document = waiter("answersets", lamps, "--json").json()
    assert (len(document["answer_sets"]), document["complete"]) == (1, False)
    document = waiter("answersets", lamps, "--json", "-n", "2").json()
    assert (len(document["answer_sets"]), document["complete"]) == (2, True)


def test_filters_apply_and_what_becomes_equal_merges(lamps: str) -> None:
    arguments = ("answersets", lamps, "--json", "-n", "0")
    shown = waiter(*arguments, "--steps", "2").json()
    assert [each["literals"] for each in shown["answer_sets"]] == [
        ["holds(lit(left),2)", "holds(lit(right),2)"]
    ]
    assert shown["complete"]
    shown = waiter(*arguments, "--only", "broken").json()
    assert [each["literals"] for each in shown["answer_sets"]] == [LEFT_LAST[:2]]
    shown = waiter(*arguments, "--only", "occurs", "--grep", "LEFT", "-i", "--steps", "..0").json()
    assert sorted(each["literals"] for each in shown["answer_sets"]) == [
        [],
        ["occurs(switch(left),0)"],
    ]
    shown = waiter(*arguments, "--grep", "i", "--grep", "o", "--invert").json()
    assert [each["literals"] for each in shown["answer_sets"]] == [[]]


def test_inconsistent_programs(tmp_path: Path) -> None:
    name = program(tmp_path, "sorts\n#s={a}.\npredicates\np(#s).\nrules\np(a). -p(a).\n")
    ran = waiter("answersets", name, "--json")
    assert ran.code == 3
    assert ran.json() == {"satisfiable": False, "complete": True, "answer_sets": []}
    ran = waiter("answersets", name)
    assert (ran.code, ran.out) == (3, "")
    assert "inconsistent" in ran.err


def test_faults_of_the_program(tmp_path: Path) -> None:
    name = program(tmp_path, "sorts\n#s={a}.\npredicates\np(#s).\nrules\np(b).\nq(a).\n")
    ran = waiter("answersets", name)
    assert (ran.code, ran.out) == (2, "")
    assert f"{name}:6:" in ran.err and f"{name}:7:1" in ran.err
    assert waiter("answersets", str(tmp_path / "gone.sparc")).code == 2
    assert waiter("answersets", str(tmp_path)).code == 2


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["PROGRAM", "--layout", "report"],
        ["PROGRAM", "--horizon", "3"],
        ["PROGRAM", "--grep", "("],
        ["PROGRAM", "--steps", "5..2"],
        ["PROGRAM", "--only", "hold"],
        ["PROGRAM", "--projection", "occur"],
        ["PROGRAM", "--count", "--diff"],
        ["PROGRAM", "-n", "-1"],
        ["PROGRAM", "--time-sort", "#stop"],
        ["PROGRAM", "--time-sort", ""],
        ["PROGRAM", "--flat", "--steps", "2"],
        ["PROGRAM", "--flat", "--time-sort", "step"],
    ],
    ids=" ".join,
)
def test_wrong_usage(lamps: str, arguments: list[str]) -> None:
    ran = waiter("answersets", *(lamps if each == "PROGRAM" else each for each in arguments))
    assert (ran.code, ran.out) == (2, "")
    assert ran.err
    assert "Traceback" not in ran.err


def test_a_name_that_is_nearly_right(lamps: str) -> None:
    assert "did you mean holds?" in waiter("answersets", lamps, "--only", "hold").err


def test_cr_rules_and_equal_sets(tmp_path: Path) -> None:
    text = "sorts\n#s={a,b}.\npredicates\np(#s).\nz().\nrules\nz :+ p(X).\nz :+ .\n"
    name = program(tmp_path, text + "p(a) | p(b).\n:- not z.\n")
    found = waiter("answersets", name, "--json", "-n", "0").json()
    assert [each["literals"] for each in found["answer_sets"]] == [["p(a)", "z"], ["p(b)", "z"]]
    assert all(each["cost"] for each in found["answer_sets"])


def test_display_hides_and_merges(tmp_path: Path) -> None:
    text = "sorts\n#s={a,b}.\npredicates\np(#s).\nq(#s).\nrules\np(X) | -p(X). q(X) | -q(X).\n"
    name = program(tmp_path, f"{text}display\np(a). #s(b).\n")
    found = waiter("answersets", name, "--json", "-n", "0").json()
    assert [each["literals"] for each in found["answer_sets"]] == [["#s(b)"], ["#s(b)", "p(a)"]]
    name = program(tmp_path, f"{text}display\np.\n")
    found = waiter("answersets", name, "--json", "-n", "3").json()
    assert (len(found["answer_sets"]), found["complete"]) == (3, False)


# ------------------------------------------------------------------ text


def test_text_has_a_heading_for_each_step(lamps: str) -> None:
    ran = waiter("answersets", lamps, "--grep", "lit.right", "--negative", "--steps", "1..")
    assert ran.code == 0
    first = ran.out.split("\n\n")[0]
    assert first.startswith("Answer set 1\n  step 1\n    ")
    assert "  step 2\n" in first
    assert "broken" not in first and "left" not in first


@pytest.mark.parametrize(
    ("sort", "headed"),
    [
        ("{a, b}", False),
        ("{f(a), b}", True),
        ("[a..b]", False),
        ("pair(#s)", False),
        ("#s", False),
        ("#s + {b}", False),
        ("0..1", True),
        ("{a, 1}", True),
        ("#s + #time", True),
        ("#time", True),
        ("#nat", True),
        ("{n}", True),
    ],
)
def test_a_program_without_steps_has_no_headings(sort: str, headed: bool, tmp_path: Path) -> None:
    text = f"#const n = 2.\nsorts\n#s = {{a}}.\n#time = 0..1.\n#t = {sort}.\n"
    text += "predicates\nq(#s).\np(#s, #t).\nrules\nq(a).\n"
    ran = waiter("answersets", program(tmp_path, text))
    indent = "  without a step\n    " if headed else "  "
    assert ran.out == f"Answer set 1\n{indent}q(a)\n\n1 answer set; there are no more.\n"


@pytest.mark.parametrize(
    ("arguments", "hinted"),
    [
        (["--grep", "LIT"], True),
        (["--grep", "LIT", "--json"], True),
        (["--grep", "LIT", "--count"], True),
        (["--grep", "LIT", "-i"], False),
        (["--grep", "LIT", "--grep", "occurs"], False),
        (["--grep", "LIT", "--only", "occurs"], False),
        (["--grep", "lamp"], False),
        (["--grep", "[a-z]", "--invert"], False),
        (["--steps", "7"], False),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_a_pattern_in_the_wrong_case_is_told(
    lamps: str, arguments: list[str], hinted: bool
) -> None:
    ran = waiter("answersets", lamps, *arguments)
    assert ran.code == 0
    told = "waiter: no literal matches; some would with -i, which takes a for A.\n"
    assert ran.err == (told if hinted else "")


def test_negative_literals_are_hidden_unless_asked_for(lamps: str) -> None:
    assert "-holds" not in waiter("answersets", lamps).out
    assert "-holds" in waiter("answersets", lamps, "--negative").out


def test_a_line_says_whether_there_are_more(lamps: str) -> None:
    more = "there are more (-n 0 shows all)."
    hidden = " Negative literals are left out (--negative).\n"
    assert waiter("answersets", lamps).out.endswith(more + hidden)
    assert waiter("answersets", lamps, "--negative").out.endswith(more + "\n")
    assert waiter("answersets", lamps, "--grep", "occurs").out.endswith(more + "\n")
    assert waiter("answersets", lamps, "-n", "2").out.endswith("there are no more." + hidden)


def test_highlight_on_a_terminal_only(lamps: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "\x1b" not in waiter("answersets", lamps, "--grep", "left").out
    monkeypatch.setattr("waiter_cli.console.styling._wants_colour", lambda stream: True)
    assert "\x1b[1;31mleft\x1b[0m" in waiter("answersets", lamps, "--grep", "left").out


def test_nothing_matches(lamps: str) -> None:
    assert "(no literal matches)" in waiter("answersets", lamps, "--grep", "zebra").out


def test_standard_input() -> None:
    assert waiter("answersets", "-", "--count", stdin=LAMPS).out == "2 answer sets\n"
    ran = waiter("answersets", "-", "--json", "--jsonl", stdin="")
    assert (ran.code, ran.json()["status"]) == (2, "error")


# ------------------------------------------------------------------ count, diff, projection, lines


def test_count(lamps: str) -> None:
    assert waiter("answersets", lamps, "--count").out == "2 answer sets\n"
    document = waiter("answersets", lamps, "--count", "--json").json()
    assert document == {"satisfiable": True, "complete": True, "count": 2}
    assert waiter("answersets", lamps, "--count", "--only", "broken").out == "1 answer set\n"


def test_diff_shows_what_tells_them_apart(lamps: str) -> None:
    document = waiter("answersets", lamps, "--diff", "--json", "--only", "occurs,broken").json()
    assert document["common"] == LEFT_LAST[:2]
    assert sorted(each["literals"] for each in document["answer_sets"]) == [
        ["occurs(switch(left),0)", "occurs(switch(right),1)"],
        ["occurs(switch(right),0)", "occurs(switch(left),1)"],
    ]
    out = waiter("answersets", lamps, "--diff", "--only", "occurs,broken").out
    assert out.startswith("2 literals in all of them")
    assert "broken" not in out


def test_projection_tells_apart_by_some_predicates_only(tmp_path: Path) -> None:
    text = "sorts\n#s={a,b}.\npredicates\np(#s).\nq(#s).\nrules\np(X) | -p(X). q(X) | -q(X).\n"
    name = program(tmp_path, text)
    assert waiter("answersets", name, "--count").out == "16 answer sets\n"
    assert waiter("answersets", name, "--count", "--projection", "q").out == "4 answer sets\n"
    found = waiter("answersets", name, "-n", "0", "--projection", "q", "--json").json()
    assert all(len(each["literals"]) == 4 for each in found["answer_sets"])


HIDING = "sorts\n#n=1..3.\npredicates\nseen(#n).\npick(#n).\nrules\nseen(X).\n1{pick(X):#n(X)}1.\n"


@pytest.mark.parametrize("display", ["seen.", "", "seen(1).", "seen. pick(2).", "#n."])
@pytest.mark.parametrize("more", ["", "#maximize{1 : seen(1)}.\n", ":~ pick(X). [1:1]\n"])
def test_projection_on_what_the_display_hides(display: str, more: str, tmp_path: Path) -> None:
    name = program(tmp_path, f"{HIDING}{more}display\n{display}\n")
    assert waiter("answersets", name, "--count", "--projection", "pick").out == "3 answer sets\n"
    assert waiter("answersets", name, "--count", "--projection", "seen").out == "1 answer set\n"
    found = waiter("answersets", name, "-n", "2", "--projection", "pick", "--json").json()
    assert len(found["answer_sets"]) == 2
    assert not found["complete"]


def test_a_projection_goes_with_filters_of_what_is_shown(tmp_path: Path) -> None:
    name = program(tmp_path, HIDING + "display\nseen.\n")
    given = ("--projection", "pick", "--grep", "2", "-n", "0", "--json")
    found = waiter("answersets", name, *given).json()
    assert [each["literals"] for each in found["answer_sets"]] == [["seen(2)"]] * 3


def test_what_is_asked_for_and_hidden_is_told(tmp_path: Path) -> None:
    name = program(tmp_path, HIDING + "display\nseen.\n#n.\n")
    ran = waiter("answersets", name, "--only", "pick,seen,#n", "--json")
    assert ran.err == "waiter: the display section of this program hides pick.\n"
    assert waiter("answersets", name, "--only", "seen").err == ""


AGES = (
    "sorts\n#person = {anna, ben}.\n#years = 0..120.\npredicates\nage(#person, #years).\n"
    "rules\nage(anna, 33). age(ben, 12).\n"
)


def test_an_age_is_no_step(tmp_path: Path) -> None:
    name = program(tmp_path, AGES)
    flat = "Answer set 1\n  age(anna,33)\n  age(ben,12)\n\n1 answer set; there are no more.\n"
    assert waiter("answersets", name).out == flat
    assert waiter("answersets", name, "--flat").out == flat
    assert waiter("answersets", name, "--steps", "..20").err.startswith(
        "waiter: no literal of this program has a step"
    )


@pytest.mark.parametrize("sort", ["#years", "years"])
def test_the_sort_of_time_can_be_named(sort: str, tmp_path: Path) -> None:
    name = program(tmp_path, AGES)
    out = waiter("answersets", name, "--time-sort", sort).out
    assert "  step 12\n    age(ben,12)\n  step 33\n    age(anna,33)\n" in out
    found = waiter("answersets", name, "--time-sort", sort, "--json").json()
    assert found["answer_sets"][0]["literals"] == ["age(ben,12)", "age(anna,33)"]
    found = waiter("answersets", name, "--time-sort", sort, "--steps", "..20", "--json").json()
    assert found["answer_sets"][0]["literals"] == ["age(ben,12)"]


def test_a_sort_of_time_that_is_nearly_right(tmp_path: Path) -> None:
    ran = waiter("answersets", program(tmp_path, AGES), "--time-sort", "#year")
    assert "the program has no sort #year" in ran.err
    assert "did you mean #years?" in ran.err


COUNTING = "#const n = 2. sorts #s = 1..n. predicates p(#s).\nrules p(X). p(q).\n"


@pytest.mark.parametrize("translator", ["native", pytest.param("jar", marks=pytest.mark.jar)])
def test_a_constant_is_set(translator: str, tmp_path: Path) -> None:
    name = program(tmp_path, COUNTING.replace("p(q).", ""))
    given = ("--json", "--translator", translator)
    found = waiter("answersets", name, "-c", "n=3", *given).json()
    assert found["answer_sets"][0]["literals"] == ["p(1)", "p(2)", "p(3)"]
    assert waiter("sparc", "query", name, "-q", "p(X)", "-c", "n=1").out == "X = 1\n"
    assert "__s(1..4)" in waiter("sparc", "translate", name, "-c", "n=4").out


def test_the_places_of_a_program_with_a_constant_set_are_its_own(tmp_path: Path) -> None:
    name = program(tmp_path, COUNTING)
    for arguments in (), ("-c", "n=300"):
        assert (
            f"{name}:2:13: error: q is not in sort #s"
            in waiter("sparc", "check", name, *arguments).err
        )
    ran = waiter("sparc", "check", name, "-c", "n=3000")
    assert "-c n=3000:1:3: error: the number 3000 is above #maxint" in ran.err


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("m=3", "the program has no constant m"),
        ("nn=3", "did you mean n?"),
        ("n", "not the value of a constant"),
        ("n=", "not the value of a constant"),
        ("n=x", "not the value of a constant"),
        ("n=-1", "not the value of a constant"),
        ("n=2147483648", "not the value of a constant"),
        ("N=1", "not the value of a constant"),
    ],
)
def test_a_constant_that_cannot_be_set(setting: str, said: str, tmp_path: Path) -> None:
    ran = waiter("answersets", program(tmp_path, COUNTING), "-c", setting)
    assert ran.code == 2
    assert said in ran.err


def test_a_constant_is_given_once_and_to_a_program(tmp_path: Path) -> None:
    ran = waiter("answersets", program(tmp_path, COUNTING), "-c", "n=1", "-c", "n=2")
    assert (ran.code, "given twice" in ran.err) == (2, True)
    assert waiter("answersets", "--layout", "report", "-c", "n=1").code == 2


def test_lines_of_json(lamps: str) -> None:
    lines = waiter("answersets", lamps, "--jsonl", "-n", "0").out.splitlines()
    assert [set(json.loads(line)) for line in lines] == [
        {"literals", "cost"},
        {"literals", "cost"},
        {"satisfiable", "complete"},
    ]


def test_a_scenario_in_the_place_of_a_program_is_understood() -> None:
    ran = waiter("answersets", "b1")
    assert ran.code == 2 and "--scenario b1" in ran.err
    assert "--layout report" in waiter("answersets", "report").err
    assert "--" not in waiter("answersets", "nothing.sparc").err


# ------------------------------------------------------------------ long listings


@pytest.fixture
def hold_little(monkeypatch: pytest.MonkeyPatch) -> None:
    """A document is long already beyond 30 literals."""
    monkeypatch.setattr(answer_writers, "HELD", 30)
    monkeypatch.setattr(answer_writers, "COMPARED", 60)


@pytest.mark.parametrize("number", ["2", "3", "4", "20", "0"])
def test_a_long_document_says_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: str
) -> None:
    arguments = ("answersets", program(tmp_path, CHOICE.replace("{n}", "9")), "--json", "-n")
    whole = waiter(*arguments, number)
    monkeypatch.setattr(answer_writers, "HELD", 30)
    ran = waiter(*arguments, number)
    assert (ran.code, ran.err) == (0, "")
    found, expected = ran.json(), whole.json()
    assert sorted(found) == sorted(expected)
    listed = [tuple(each["literals"]) for each in found.pop("answer_sets")]
    assert len(listed) == len(set(listed)) == (int(number) or 512)
    assert set(listed) == {tuple(each["literals"]) for each in expected.pop("answer_sets")}
    assert found == expected


def test_a_long_document_holds_little(hold_little: None, tmp_path: Path) -> None:
    writer = answer_writers.JsonWriter(lines=False)
    most = 0

    def write(answer_set: AnswerSet) -> None:
        nonlocal most
        answer_writers.JsonWriter.write(writer, answer_set)
        most = max(most, len(writer.found))

    writer.timeline = Timeline({})
    for number in range(1000):
        write(AnswerSet(frozenset({GroundLiteral("p", (number,), False)}), ()))
    assert 1 <= most <= 30 and not writer.found


def test_a_long_document_ends_at_the_time_limit(hold_little: None, tmp_path: Path) -> None:
    name = program(tmp_path, CHOICE.replace("{n}", "40"))
    ran = waiter("answersets", name, "--json", "-n", "0", "--time-limit", "0.3")
    found = ran.json()
    assert (ran.code, ran.err) == (4, "waiter: the time limit was reached.\n")
    assert len(found.pop("answer_sets")) > 1
    assert found == {"satisfiable": True, "complete": False, "limit": "time"}


@pytest.mark.parametrize(
    ("error", "ended"),
    [
        (SolverError("no"), (1, "error: no\n")),
        (KeyboardInterrupt(), (130, "waiter: interrupted\n")),
    ],
)
def test_a_long_document_is_ended_whatever_comes(
    hold_little: None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    error: BaseException,
    ended: tuple[int, str],
) -> None:
    search = answers_module.AnswerListing._search

    def fails(self: answers_module.AnswerListing) -> Iterator[AnswerSet]:
        yield from search(self)
        raise error

    monkeypatch.setattr(answers_module.AnswerListing, "_search", fails)
    name = program(tmp_path, CHOICE.replace("{n}", "5"))
    ran = waiter("answersets", name, "--json", "-n", "0")
    found = ran.json()
    assert len(found.pop("answer_sets")) == 32
    assert found == {"satisfiable": True, "complete": False}
    assert (ran.code, ran.err) == ended


def test_what_is_compared_is_bounded(hold_little: None, tmp_path: Path) -> None:
    name = program(tmp_path, CHOICE.replace("{n}", "40"))
    ran = waiter("answersets", name, "--diff", "--json", "-n", "0")
    found = ran.json()
    assert (ran.code, found["complete"], found["limit"]) == (4, False, "memory")
    assert len(found["answer_sets"]) == 2
    assert "memory" in ran.err


# ------------------------------------------------------------------ limits


def test_time_limit_while_solving(tmp_path: Path) -> None:
    name = program(tmp_path, PIGEONS)
    ran = waiter("answersets", name, "--json", "--time-limit", "0.3")
    assert ran.code == 4
    assert ran.json() == {
        "satisfiable": None,
        "complete": False,
        "answer_sets": [],
        "limit": "time",
    }
    assert "time limit" in ran.err


def test_time_limit_while_listing(tmp_path: Path) -> None:
    name = program(tmp_path, CHOICE.replace("{n}", "40"))
    ran = waiter("answersets", name, "--count", "--time-limit", "0.3")
    assert ran.code == 4
    assert ran.out.startswith("at least ")


def test_what_was_asked_for_is_enough(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether there is one more is not looked for without end."""
    monkeypatch.setattr(answers_module, "MORE_SECONDS", 0.2)
    text = (
        PIGEONS.replace("rules\n", "easy().\nrules\neasy | -easy.\n")
        .replace("1{", "1{", 1)
        .replace(":- #p(P)", ":- #p(P), -easy")
    )
    ran = waiter("answersets", program(tmp_path, text), "--time-limit", "5")
    assert ran.code == 0
    assert "easy" in ran.out
    assert ran.out.endswith("whether there are more is not settled.\n")


def test_head_ends_quietly_and_the_first_comes_at_once(tmp_path: Path) -> None:
    name = program(tmp_path, CHOICE.replace("{n}", "40"))
    process = subprocess.Popen(
        [sys.executable, "-m", "waiter_cli", "answersets", name, "-n", "0"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert process.stdout is not None and process.stderr is not None
    assert process.stdout.readline() == b"Answer set 1\n"
    process.stdout.close()
    assert process.wait(10) == 0
    assert process.stderr.read() == b""
    process.stderr.close()


# ------------------------------------------------------------------ restaurants


def test_a_restaurant_at_its_least_horizon() -> None:
    ran = waiter("answersets", "--scenario", "b2", "--only", "occurs", "--json", "-n", "0")
    assert ran.code == 0
    for each in ran.json()["answer_sets"]:
        assert [literal.rpartition(",")[2] for literal in each["literals"]] == [
            "0)",
            "1)",
            "2)",
            "3)",
        ]


def test_a_restaurant_at_a_horizon() -> None:
    ran = waiter("answersets", "--scenario", "b1", "--horizon", "3")
    assert (ran.code, ran.out) == (3, "")
    assert "no plan of at most 3 steps" in ran.err
    found = waiter("answersets", "--scenario", "b1", "--horizon", "8", "--count", "--json").json()
    assert found["complete"] and found["count"] > 1


def test_a_restaurant_without_a_plan() -> None:
    ran = waiter("answersets", "--layout", "walled_off", "--enter", "1", "--json")
    assert ran.code == 3
    document = ran.json()
    assert (document["satisfiable"], document["answer_sets"]) == (False, [])
    assert document["reasons"]


# ------------------------------------------------------------------ the jar


@needs_jar
@pytest.mark.parametrize(
    "extra", [["-n", "0"], ["-n", "0", "--only", "occurs"], ["--count"], ["--diff"]], ids=" ".join
)
def test_the_jar_gives_the_same(lamps: str, extra: list[str]) -> None:
    native, jar = (
        waiter("answersets", lamps, "--json", "--translator", name, *extra)
        for name in ("native", "jar")
    )
    assert (native.code, jar.code) == (0, 0)
    assert native.json() == jar.json()


def test_without_a_jar(lamps: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    monkeypatch.delenv("WAITER_SPARC_JAR", raising=False)
    ran = waiter("answersets", lamps, "--translator", "jar")
    assert (ran.code, ran.out) == (5, "")
    assert "waiter sparc fetch-jar" in ran.err


@needs_jar
def test_what_clingo_refuses_of_the_jar_names_the_way_out(tmp_path: Path) -> None:
    name = program(
        tmp_path,
        "sorts\n#s={a,b}.\npredicates\np(#s).\nq().\nrules\np(a) | p(b).\n"
        "q :+ #count{1 : p(X)} > 0.\n:- not q.\n",
    )
    assert waiter("answersets", name).code == 0
    ran = waiter("answersets", name, "--translator", "jar")
    assert (ran.code, ran.out) == (2, "")
    assert "unsafe" in ran.err and "--translator native" in ran.err


def test_set_needs_why() -> None:
    ran = waiter("answersets", "-", "--set", "2", stdin="predicates p(). rules p. ")
    assert ran.code == 2 and "--set chooses the answer set that --why is about" in ran.err


def test_why_asks_about_the_set_that_is_chosen() -> None:
    program = "predicates p(). rules {p}. "
    holds = {
        waiter("answersets", "-", "--why", "p", "--set", k, "--json", stdin=program).json()["holds"]
        for k in ("1", "2")
    }
    assert holds == {True, False}
