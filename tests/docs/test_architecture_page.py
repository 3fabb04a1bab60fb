"""docs/architecture.md: its table of floors is the one that the tests hold."""

from __future__ import annotations

import re

from tests.support.paths import ROOT
from tests.test_architecture import FLOORS


def test_the_table_of_floors_is_the_one_that_is_held() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\d+) \| `(\w+)` \| \S", page, re.MULTILINE)
    held = [(str(floor), name) for floor, names in enumerate(FLOORS) for name in names]
    assert rows == held
