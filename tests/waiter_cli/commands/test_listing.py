"""``waiter list``: what comes with it, a line each."""

from __future__ import annotations

import pytest

from tests.support.cli import waiter
from waiter_cli.file_access.locate import built_in


@pytest.fixture(scope="module")
def lines() -> list[str]:
    ran = waiter("list")
    assert (ran.code, ran.err) == (0, "")
    return ran.out.splitlines()


def test_everything_has_one_line_that_fits_a_terminal(lines: list[str]) -> None:
    assert max(map(len, lines)) <= 80
    for kind in ("layout", "scenario", "domain"):
        start = lines.index(f"{kind}s")
        names = [line.split()[0] for line in lines[start + 1 : start + 1 + len(built_in(kind))]]
        assert tuple(names) == built_in(kind)


def test_a_sentence_and_the_key_figures(lines: list[str]) -> None:
    line = next(line for line in lines if line.startswith("report "))
    words = "The restaurant of the report.", "8 nodes, 2 tables, 6 seats"
    assert line.split("  ")[0] == "report" and all(word in line for word in words)
    line = next(line for line in lines if line.startswith("b2 "))
    assert "Scene 2: a party of four comes in." in line and "report, 5 guests, 1 goal" in line


def test_the_document() -> None:
    found = waiter("list", "--json").json()
    assert [one["name"] for one in found["layouts"]] == [*built_in("layout")]
    assert all(one["about"].endswith(".") for kind in found.values() for one in kind)
    bistro = found["layouts"][0]
    assert (bistro["tables"], bistro["seats"], bistro["bar"]) == (8, 28, True)
    lunch = next(one for one in found["scenarios"] if one["name"] == "lunch")
    assert (lunch["layout"], lunch["guests"], lunch["events"]) == ("bistro", 14, 0)
    rules = {one["name"]: one["rules"] for one in found["domains"]}
    assert rules["restaurant"] > rules["report"] > 50
