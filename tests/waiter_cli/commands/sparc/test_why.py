"""``waiter sparc why``, ``answersets --why`` and the word ``why`` at the prompt: words and codes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter

BIRDS = """sorts
#s = {sam, tweety}.
predicates
bird(#s). penguin(#s). flies(#s). h(). c().
rules
bird(tweety). bird(sam). penguin(sam).
% Birds fly.
flies(X) :- bird(X), not penguin(X).
-flies(X) :- penguin(X).
-h. -c :- -h.
"""


@pytest.fixture
def birds(tmp_path: Path) -> str:
    file = tmp_path / "birds.sparc"
    file.write_text(BIRDS)
    return str(file)


def said(*arguments: str, stdin: str = "") -> str:
    ran = waiter(*arguments, stdin=stdin)
    assert ran.code == 0, ran.err
    return " ".join(ran.out.split())


def test_what_is_there(birds: str) -> None:
    out = said("sparc", "why", birds, "flies(tweety)")
    assert out == (
        f"flies(tweety) is in the answer set, because: flies(tweety) {birds}:8: "
        "flies(X) :- bird(X), not penguin(X). Birds fly. as in: flies(tweety) :- bird(tweety), "
        f"not penguin(tweety) bird(tweety) {birds}:6: bird(tweety). "
        "not penguin(tweety) (no rule gives it)"
    )


def test_what_is_not_there(birds: str) -> None:
    out = said("sparc", "why", birds, "flies(sam)")
    assert "flies(sam) is not in the answer set." in out
    assert "fails: not penguin(sam) penguin(sam) is there" in out


@pytest.mark.parametrize("literal", ["-flies(sam)", "-flies( sam )", "-flies(sam)."])
@pytest.mark.parametrize("more", [[], ["--json"], ["--set", "1"]])
def test_a_negative_literal_is_no_option(literal: str, more: list[str], birds: str) -> None:
    ran = waiter("sparc", "why", birds, literal, *more)
    assert ran.code == 0 and "-flies(sam)" in ran.out, ran.err
    assert waiter("sparc", "why", *more, birds, literal).out == ran.out


def test_what_is_an_option_is_one(birds: str) -> None:
    assert "Usage:" in waiter("sparc", "why", birds, "-h").out
    assert said("sparc", "why", birds, "--", "-h").startswith("-h is in the answer set")
    assert said("sparc", "why", birds, "--", "-c").startswith("-c is in the answer set")


def test_a_set_that_is_not_there(birds: str) -> None:
    ran = waiter("sparc", "why", birds, "bird(sam)", "--set", "2")
    assert ran.code == 2 and "--set 2" in ran.err and "one answer set" in ran.err


def test_an_inconsistent_program(tmp_path: Path) -> None:
    ran = waiter("sparc", "why", "-", "h", stdin=BIRDS + "h.\n")
    assert ran.code == 3 and "waiter sparc explain" in ran.err


def test_time_that_is_up(birds: str) -> None:
    ran = waiter("sparc", "why", birds, "h", "--time-limit", "0", "--json")
    assert (ran.code, ran.json()["holds"]) == (4, None)


def test_of_a_restaurant() -> None:
    out = said(
        "answersets", "--layout", "report", "--enter", "1", "--why", "holds(isfree(table1),3)"
    )
    assert (
        "domain.sparc:" in out
        and "not -holds(isfree(table1),3) (none of these rules gives it)" in out
    )
    out = said("answersets", "--scenario", "b1", "--why", "occurs(go_to(agent,n1),1)")
    assert "not chosen" in out


@pytest.mark.parametrize("query", ["bird(X), -flies(X)", "-flies(X), bird(X).", "-h, -flies(X)"])
def test_several_literals_have_the_first_values_that_fit(query: str, birds: str) -> None:
    out = said("sparc", "why", birds, query)
    told = [each.strip().replace("X", "sam") for each in query.removesuffix(".").split(",")]
    places = [out.index(f"{each} is in the answer set, because:") for each in told]
    assert places == sorted(places)
    assert said("sparc", "query", birds, stdin=f"why {query}\n") == out
    assert said("answersets", birds, "--why", query) == out


@pytest.mark.parametrize(
    ("query", "fails"),
    [
        ("penguin(X), flies(X)", "flies(sam) is not in the answer set."),
        ("flies(X), flies(Y), h", "h is not in the answer set."),
        ("-bird(X)", "-bird(X) is not in the answer set."),
    ],
)
def test_where_no_values_fit_the_literal_that_fails_is_told(
    query: str, fails: str, birds: str
) -> None:
    out = said("sparc", "why", birds, query)
    assert out.startswith(fails) and out.count("the answer set.") == 1
    assert said("answersets", birds, "--why", query) == out


@pytest.mark.parametrize("query", ["bird(_)", "bird(X), not h", "nobody(X)", "bird(X, Y)"])
def test_what_is_no_query_has_its_place(query: str, birds: str) -> None:
    ran = waiter("sparc", "why", birds, query)
    assert ran.code == 2 and ran.err.startswith("query:1:") and not ran.out
    assert waiter("answersets", birds, "--why", query).err == ran.err


def test_at_the_prompt(birds: str) -> None:
    lines = "why\nflies(tweety)\nwhy\nhelp\nwhy flies(sam).\nwhy flies(\nbird(X), -flies(X)\nwhy\nwhy bird(X), h\nwhy h\nexit\n"
    ran = waiter("sparc", "query", birds, stdin=lines)
    out = " ".join(ran.out.split())
    assert ran.code == 0
    for words in (
        "ask about a literal first",
        "yes flies(tweety) is in the answer set, because:",
        "why p(a,X) why it is in the first answer set",
        "flies(sam) is not in the answer set.",
        "X = sam bird(sam) is in the answer set, because:",
        "-flies(sam) is in the answer set, because:",
        "h is not in the answer set. -h is in the answer set",
    ):
        assert words in out
    assert "query:1:7: error" in ran.err


def test_predicates_that_are_called_so() -> None:
    program = "sorts #s = {a}. predicates why(#s). help(). rules why(a). help.\n"
    from pathlib import Path
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        file = Path(folder, "p.sparc")
        file.write_text(program)
        ran = waiter("sparc", "query", str(file), stdin="why(a)\nwhy (a)\nhelp\nwhy why(a)\n")
    assert ran.out.split("\n")[:3] == ["yes", "yes", "yes"]
    assert ran.out.split("\n")[3] == "why(a) is in the answer set, because:"
