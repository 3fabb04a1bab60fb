"""``waiter domain test`` and ``show`` from the front door: green, red, wrong input, listings."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.cli import waiter
from tests.support.domain_cases import BUILT_IN, copy_domain
from waiter_cli.file_access.locate import data_folder


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_case_of_a_built_in_domain_passes(name: str) -> None:
    document = waiter("domain", "test", "--domain", name, "--json").json()
    assert document["status"] == "passed", [
        (case["name"], case["failures"]) for case in document["cases"] if not case["passed"]
    ]
    assert document["failed"] == 0 and document["passed"] == len(document["cases"]) > 25


def test_green_says_so_and_lists_the_files() -> None:
    ran = waiter("domain", "test", "-k", "seat")
    assert ran.code == 0 and ran.err == ""
    assert "cases/seat.yaml" in ran.out and "cases passed" in ran.out
    assert "cases/give_bill.yaml" not in ran.out, "-k leaves other files out"


def test_red_when_a_rule_is_deleted(tmp_path: Path) -> None:
    """The message has the case, the place, the literal and what holds instead."""
    template = copy_domain("restaurant", tmp_path)
    text = template.read_text(encoding="utf-8")
    rule = "holds(currentlocation(agent, N), I+1) :- occurs(go_to(agent, N), I).\n"
    assert text.count(rule) == 1
    template.write_text(text.replace(rule, ""), encoding="utf-8")
    ran = waiter("domain", "test", "--domain", str(template), "-k", "walking takes")
    assert ran.code == 3 and ran.err == ""
    head, literal, instead, *_ = [
        line.strip() for line in ran.out.split("FAILED ")[1].split("\n") if line
    ]
    case = template.parent / "cases" / "go_to.yaml"
    line = next(
        n
        for n, t in enumerate(case.read_text(encoding="utf-8").split("\n"), 1)
        if "walking takes" in t
    )
    assert head == (f"{case}:{line}:5: walking takes the robot to the neighbouring node")
    assert literal.endswith("holds(currentlocation(agent, n3), 1) does not hold")
    assert instead.startswith(("instead: ", "there is no holds("))
    assert "0 of 1 cases passed" in ran.out


def test_a_folder_stands_for_its_template(tmp_path: Path) -> None:
    template = copy_domain("report", tmp_path)
    assert waiter("domain", "test", "--domain", str(template.parent)).code == 0


def test_coverage_lists_what_never_fired() -> None:
    ran = waiter("domain", "test", "-k", "give_bill.yaml: nothing", "--coverage")
    assert ran.code == 2, "no case has that name"
    ran = waiter("domain", "test", "-k", "a free table is given no bill", "--coverage")
    assert ran.code == 0
    assert "never fired" in ran.out
    assert "A party that was seated sits at the table" in ran.out, "the sentence"
    assert "holds(isattable(P, T), I+1) :- occurs(seat(agent, P, T), I)." in ran.out, "the rule"
    assert max(map(len, ran.out.split("never fired\n\n")[-1].split("\n"))) < 80


def test_coverage_in_json_says_of_each_statement_whether_it_fired() -> None:
    document = waiter("domain", "test", "-k", "walking takes", "--coverage", "--json").json()
    by_text = {one["statement"]: one for one in document["coverage"]}
    edge = by_text["edge(M, N) :- edge(N, M)."]
    assert edge["fired"] and edge["sentence"] == "A path leads both ways."
    assert not by_text[":- not success."]["fired"]
    template = (
        (Path(data_folder("domains")) / "restaurant" / "domain.sparc")
        .read_text(encoding="utf-8")
        .split("\n")
    )
    for one in document["coverage"]:
        line = template[one["line"] - 1][one["column"] - 1 :]
        assert one["statement"].split("(")[0] in line


def test_no_case_of_that_name() -> None:
    ran = waiter("domain", "test", "-k", "xyzzy")
    assert ran.code == 2 and "no case has 'xyzzy' in its name" in ran.err


@pytest.mark.parametrize(
    ("domain", "said"),
    [("nowhere", "there is no domain nowhere"), ("restaurnat", "did you mean restaurant?")],
)
def test_no_such_domain(domain: str, said: str) -> None:
    for command in ("test", "show"):
        ran = waiter("domain", command, "--domain", domain)
        assert ran.code == 2 and said in ran.err


def test_a_domain_without_cases(tmp_path: Path) -> None:
    template = copy_domain("report", tmp_path)
    (template.parent / "cases" / "basic.yaml").unlink()
    ran = waiter("domain", "test", "--domain", str(template))
    assert ran.code == 2 and "there are no cases" in ran.err


def test_a_domain_that_is_written_wrongly(tmp_path: Path) -> None:
    template = copy_domain("report", tmp_path)
    text = template.read_text(encoding="utf-8")
    template.write_text(text.replace("success :- goal(_).", "success :- gaol(_)."), "utf-8")
    number = text.split("\n").index("success :- goal(_).") + 1
    ran = waiter("domain", "test", "--domain", str(template))
    assert ran.code == 2
    assert f"domain.sparc:{number}:12" in ran.err and "gaol" in ran.err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", ":1:1: error: the file is empty"),
        ("\n% later\n", ":1:1: error: the file has comments only"),
        ("% greet\n\n  p(a) :- q(a).\ndisplay p.\n", ":3:3: error: expected the section word"),
        ("% sorts predicates rules\nrule(a).\n", ":2:1: error: expected the section word"),
    ],
    ids=["empty", "comments", "rules alone", "sections in a comment"],
)
def test_what_is_no_whole_domain_says_where_to_start_from(
    tmp_path: Path, text: str, said: str
) -> None:
    own = tmp_path / "own.sparc"
    own.write_text(text, "utf-8")
    for command in ("domain test", "domain show", "plan --scenario b4", "serve --layout report"):
        ran = waiter(*command.split(), "--domain", str(own))
        assert ran.code == 2 and f"{own}{said}" in ran.err, command
        assert "waiter domain show --source" in ran.err, command


def test_a_folder_without_a_domain(tmp_path: Path) -> None:
    for command in ("domain show", "plan --scenario b4"):
        ran = waiter(*command.split(), "--domain", str(tmp_path))
        assert ran.code == 2 and "the folder of a domain holds domain.sparc" in ran.err


# ------------------------------------------------------------ show


@pytest.mark.parametrize("name", BUILT_IN)
def test_the_source_is_printed_as_it_is_and_works_as_ones_own(name: str, tmp_path: Path) -> None:
    shipped = Path(data_folder("domains")) / name / "domain.sparc"
    ran = waiter("domain", "show", "--domain", name, "--source")
    assert (ran.code, ran.err) == (0, "")
    assert ran.out.encode() == shipped.read_bytes()
    document = waiter("domain", "show", "--domain", name, "--source", "--json").json()
    assert document["source"] == ran.out
    own = tmp_path / "own.sparc"
    own.write_text(ran.out, "utf-8")
    plan = waiter("plan", "--scenario", "b4", "--domain", str(own), "--json").json()
    assert plan["horizon"] == waiter("plan", "--scenario", "b4", "--json").json()["horizon"]
    piped = waiter("plan", "--scenario", "b4", "--domain", "-", "--json", stdin=ran.out).json()
    assert piped["actions"] == plan["actions"]


@pytest.mark.parametrize("other", ["--markdown", "--grep=seat"])
def test_the_source_is_printed_whole_or_not_at_all(other: str) -> None:
    ran = waiter("domain", "show", "--source", other)
    assert ran.code == 2 and ran.out == ""
    assert f"--source and {other.split('=')[0]} exclude each other" in ran.err


@pytest.mark.parametrize("name", BUILT_IN)
def test_show_fits_a_terminal_and_leaves_nothing_out(name: str) -> None:
    ran = waiter("domain", "show", "--domain", name)
    assert ran.code == 0
    assert max(map(len, ran.out.split("\n"))) < 80
    folder = Path(data_folder("domains")) / name / "domain.sparc"
    lines = folder.read_text(encoding="utf-8").split("\n")
    shown = {int(line[:4]) for line in ran.out.split("\n") if line[:4].strip().isdigit()}
    words = ("sorts", "predicates", "rules", "display")
    wanted = {
        number
        for number, line in enumerate(lines, 1)
        if line.strip() and not line.lstrip().startswith("%") and line.strip() not in words
    }
    assert shown == wanted


def test_show_finds_words_and_rules() -> None:
    ran = waiter("domain", "show", "--grep", "NOTHING EMPTY")
    assert ran.code == 0
    assert "Nothing empty is brought. [only with: objects, refillables]" in ran.out
    assert ":- occurs(bring(agent, O, T), I), carriesempty(O, T, I)." in ran.out
    assert "give_bill" not in ran.out
    assert waiter("domain", "show", "--grep", "xyzzy").out == ""


def test_show_in_json() -> None:
    document = waiter("domain", "show", "--grep", "closed", "--json").json()
    assert document["blocks"] == []
    (block,) = waiter("domain", "show", "--grep", "leads both ways", "--json").json()["blocks"]
    assert block["section"] == "the restaurant" and block["parts"] == []
    assert block["sentence"] == "A path leads both ways."
    assert block["lines"] == [{"line": block["line"] + 1, "text": "edge(M, N) :- edge(N, M)."}]


def test_show_as_a_page() -> None:
    page = waiter("domain", "show", "--markdown").out
    assert page.startswith("## ") and page.count("\n## ") > 5
    assert "Nothing empty is brought." in page
