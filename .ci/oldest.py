"""Prints the lowest version of each dependency that `pyproject.toml` admits, as pip takes it.

The arguments are extras.  A dependency without a lower bound, or behind a marker that does not hold
here, is left out.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:
    sys.exit("the oldest versions are tried with Python 3.11 or later")


def oldest(requirement: str) -> str | None:
    """``name>=1,<2`` → ``name==1``; what is pinned stays pinned."""
    name, _, marker = requirement.partition(";")
    if marker.strip():
        return None
    found = re.match(r"([\w.-]+)\s*(?:>=|==)\s*([\w.]+)", name.strip())
    return f"{found[1]}=={found[2]}" if found else None


project = tomllib.loads(Path("pyproject.toml").read_text("utf-8"))["project"]
wanted = list(project["dependencies"])
for extra in sys.argv[1:]:
    wanted += project["optional-dependencies"][extra]
print(*filter(None, map(oldest, wanted)))
