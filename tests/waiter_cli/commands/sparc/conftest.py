"""The family in a file of its own for each test."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.family import FAMILY


@pytest.fixture
def family(tmp_path: Path) -> str:
    path = tmp_path / "family.sparc"
    path.write_text(FAMILY)
    return str(path)
