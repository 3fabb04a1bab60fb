"""docs/architecture.md: its table of floors is the one that the tests hold."""

from __future__ import annotations

import re
from importlib import import_module

from tests.support.paths import ROOT
from tests.test_architecture import FLOORS


def test_the_table_of_floors_is_the_one_that_is_held() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\d+) \| `(\w+)` \| \S", page, re.MULTILINE)
    held = [(str(floor), name) for floor, names in enumerate(FLOORS) for name in names]
    assert rows == held


def test_what_the_page_names_exists() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    names = set(re.findall(r"`((?:waiter_cli|sparc)(?:\.\w+)+)`", page))
    assert len(names) > 20
    for name in names:
        module, _, attribute = name.rpartition(".")
        try:
            import_module(name)
        except ModuleNotFoundError:
            assert hasattr(import_module(module), attribute), name


def test_the_files_that_the_page_names_exist() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    paths = set(re.findall(r"`([\w/]+\.(?:py|js|md|sparc|txt))`", page))
    assert len(paths) > 20
    roots = (
        ROOT,
        ROOT / "waiter_cli",
        ROOT / "sparc",
        ROOT / "sparc" / "syntax",
        ROOT / "sparc" / "translation",
        ROOT / "waiter_cli" / "studio" / "page",
        ROOT / "waiter_cli" / "pictures" / "page",
    )
    missing = {path for path in paths if not any((root / path).exists() for root in roots)}
    assert missing == {"studio/page/NAME.js"}, "which stands for a room to be written"
