"""Imports around a frame: counted within one, none outside."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from sparc.import_depth import imports_around


def test_nothing_is_imported_here() -> None:
    assert imports_around(sys._getframe()) == 0
    assert imports_around(None) == 0


def test_within_an_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "outer_of_two.py").write_text("import inner_of_two\nfound = inner_of_two.found\n")
    (tmp_path / "inner_of_two.py").write_text(
        "import sys\nfrom sparc.import_depth import imports_around\n"
        "found = imports_around(sys._getframe())\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    import inner_of_two  # type: ignore[import-not-found]
    import outer_of_two  # type: ignore[import-not-found]

    assert inner_of_two.found > 0 and outer_of_two.found == inner_of_two.found
