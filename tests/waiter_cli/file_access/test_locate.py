"""Files and built-in names: what is found first, what is said when nothing is."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.support.paths import ROOT
from waiter_cli.encoding.domains import find_domain
from waiter_cli.errors import LayoutError
from waiter_cli.file_access.locate import built_in, find, read_text
from waiter_cli.files.layout_reader import read_layout_file


@pytest.fixture
def empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_built_ins_are_found_from_any_folder(empty_folder: Path) -> None:
    assert read_layout_file("report").name == "report"
    assert set(built_in("layout")) >= {"report", "report_large", "bistro", "walled_off"}
    assert set(built_in("scenario")) >= {"b1", "b2", "b3", "b4", "lunch"}
    assert set(built_in("domain")) >= {"restaurant", "report"}


def test_a_file_of_that_name_comes_first(empty_folder: Path) -> None:
    (empty_folder / "report").write_text("hello")
    assert read_text("report", "layout").text == "hello"
    assert read_text("report", "layout").shown == "report"


def test_a_folder_of_that_name_does_not_count(empty_folder: Path) -> None:
    (empty_folder / "report").mkdir()
    assert read_layout_file("report").name == "report"


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("reprot", "--layout: there is no layout reprot; did you mean report?"),
        ("report.yaml", "no file has that name; did you mean the built-in report?"),
        ("mine", "did you mean mine.yaml?"),
        ("folder", "folder is a folder, not a layout file"),
        ("", "no layout is called ''"),
        ("a\0b", "no layout is called"),
        ("x/y/z", "give the path of a file, or a built-in: bistro, report"),
    ],
)
def test_what_is_not_found(empty_folder: Path, name: str, message: str) -> None:
    (empty_folder / "mine.yaml").write_text("")
    (empty_folder / "folder").mkdir()
    with pytest.raises(LayoutError) as raised:
        find(name, "layout")
    assert message in str(raised.value)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"nodes: [a]\n# caf\xe9\n", "odd.yaml:2:6: no UTF-8 text; save it as UTF-8"),
        ("nodes: [a]".encode("utf-16"), "odd.yaml:1:1: the file is in UTF-16"),
        (b"", "odd.yaml:1:1: the file is empty"),
        (b"# nothing yet\n", "odd.yaml:1:1: the file is empty"),
        (b"a" * ((1 << 22) + 1), "odd.yaml:1:1: larger than"),
        (b"a" * ((1 << 20) + 1), "odd.yaml:1:1: the text has 1048577 characters"),
    ],
)
def test_what_is_no_text_of_ours(empty_folder: Path, data: bytes, message: str) -> None:
    (empty_folder / "odd.yaml").write_bytes(data)
    with pytest.raises(LayoutError) as raised:
        read_layout_file("odd.yaml")
    assert message in str(raised.value)


def test_a_byte_order_mark_is_no_part_of_the_text(empty_folder: Path) -> None:
    text = (ROOT / "layouts" / "report.yaml").read_text(encoding="utf-8")
    (empty_folder / "bom.yaml").write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert replace(read_layout_file("bom.yaml"), file="") == replace(
        read_layout_file("report"), file=""
    )


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read(empty_folder: Path) -> None:
    (empty_folder / "locked.yaml").write_text("")
    (empty_folder / "locked.yaml").chmod(0)
    with pytest.raises(LayoutError, match="permission denied"):
        read_layout_file("locked.yaml")


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    text = (ROOT / "layouts" / "report.yaml").read_bytes()
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(text)))
    layout = read_layout_file("-")
    assert layout.file == "<stdin>"


def test_paths_are_shown_as_a_person_would_write_them(empty_folder: Path) -> None:
    (empty_folder / "rooms").mkdir()
    (empty_folder / "rooms" / "ein raum é.yaml").write_text("")
    inner = empty_folder / "rooms" / "ein raum é.yaml"
    assert read_text(str(inner), "layout").shown == os.path.join("rooms", "ein raum é.yaml")
    shipped = os.path.join("layouts", "scenarios", "b1.yaml")
    assert read_text("b1", "scenario").shown == shipped
    assert read_text(shipped, "scenario") == read_text("b1", "scenario")


def test_domains_are_found_by_name_and_by_path(empty_folder: Path) -> None:
    found = find_domain("restaurant")
    assert found.built_in and found.template.name.endswith("domain.sparc")
    (empty_folder / "own.sparc").write_text("#const n = 3. sorts #s = {a}.")
    found = find_domain("own.sparc")
    assert (found.template.name, found.built_in) == ("own.sparc", False)
    assert found.template.text == "#const n = 3. sorts #s = {a}."
    with pytest.raises(LayoutError, match="there is no domain restaurnt; did you mean restaurant?"):
        find_domain("restaurnt")


def test_an_installed_package_finds_its_own_copy(tmp_path: Path) -> None:
    """What a wheel lays down: the packages, and the data inside `waiter_cli/_data`."""
    site = tmp_path / "site"
    for package in ("sparc", "waiter_cli"):
        shutil.copytree(
            ROOT / package, site / package, ignore=shutil.ignore_patterns("__pycache__")
        )
    for folder in ("layouts", "domains"):
        shutil.copytree(ROOT / folder, site / "waiter_cli" / "_data" / folder)
    code = (
        "from waiter_cli.files.scenario_reader import read_scenario_file as r\n"
        "from waiter_cli.encoding.domains import find_domain\n"
        "print(r('b1')[0].file, find_domain('report').built_in)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == f"{Path('site/waiter_cli/_data/layouts/report.yaml')} True"
