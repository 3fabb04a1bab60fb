"""The kind of a file that was given in place of another."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.paths import ROOT
from waiter_cli.errors import Fault, LayoutError, Where
from waiter_cli.file_access.kinds import kind_of, kind_of_bytes, told_as_it_is

SHIPPED = [
    ("a layout", (ROOT / "layouts").glob("*.yaml")),
    ("a scenario", (ROOT / "layouts" / "scenarios").glob("*.yaml")),
    ("a SPARC program", (ROOT / "domains").rglob("*.sparc")),
    ("a file of cases", (ROOT / "domains").rglob("cases/*.yaml")),
]


@pytest.mark.parametrize(
    ("kind", "files"),
    [(kind, sorted(files)) for kind, files in SHIPPED],
    ids=lambda each: str(each)[:12],
)
def test_files_that_are_shipped_are_known(kind: str, files: list[Path]) -> None:
    assert files
    found = {path: kind_of(path.read_text(encoding="utf-8")) for path in files}
    assert not {path: told for path, told in found.items() if told != kind}


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("", "an empty file"),
        ("\ufeff \n", "an empty file"),
        ("<svg xmlns=''></svg>", "an SVG picture"),
        ("<?xml version='1.0'?><svg/>", "an SVG picture"),
        ("<!DOCTYPE html><p>", "a page of HTML or XML"),
        ('{"actions": [], "horizon": 0}', "a plan"),
        ("horizon: 0\nactions: []\n", "a plan"),
        ("layouts: [report]\nevenings: 1..9\n", "a study"),
        ('{"x": 1}', "JSON of another kind"),
        ("x: 1\n", "YAML of another kind"),
        ("nodes: [a]\n", "YAML of another kind"),
        ("Dear waiter,\n", "a text of another kind"),
    ],
)
def test_a_text_is_told_by_its_beginning_and_its_keys(text: str, kind: str) -> None:
    assert kind_of(text) == kind


def test_where_keys_are_shared_the_likely_kind_is_taken() -> None:
    assert kind_of("layout: x\n", likely="a scenario") == "a scenario"


@pytest.mark.parametrize(
    ("data", "kind"),
    [(b"\x89PNG\r\n", "a PNG picture"), (b"%PDF-1.7", "a PDF document"), (b"\x01\x02", None)],
)
def test_a_file_that_is_no_text(data: bytes, kind: str | None) -> None:
    assert kind_of_bytes(data) == kind


def told(text: str, **more: Where) -> Callable[[], None]:
    def read() -> None:
        with told_as_it_is(text, "my.yaml", "a layout", **more):
            raise LayoutError([Fault(Where("my.yaml", 7, 1), "a key is missing")])

    return read


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        ("horizon: 0\nactions: []\n", {}, "my.yaml: this is a plan, not a layout"),
        ("x: 1\n", {}, "my.yaml:7:1: a key is missing"),
        ("nodes: []\nedges: []\n", {}, "my.yaml:7:1: a key is missing"),
        ("x: 1\n", {"named": Where("s.yaml", 2, 1)}, "s.yaml:2:1: my.yaml is YAML of another kind, not a layout"),
    ],
)  # fmt: skip
def test_faults_of_another_kind_of_file_are_one(
    text: str, more: dict[str, Where], message: str
) -> None:
    with pytest.raises(LayoutError) as raised:
        told(text, **more)()
    assert [str(fault) for fault in raised.value.faults] == [message]


def test_a_file_without_faults_is_let_be() -> None:
    with told_as_it_is("anything", "my.yaml", "a layout"):
        pass
