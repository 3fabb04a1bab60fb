"""A restaurant in files whose folder, names and texts are as odd as a system allows."""

from __future__ import annotations

import hashlib
from pathlib import Path

__all__ = ["FOLDER", "LAYOUT", "PROGRAM", "SCENARIO", "TITLE", "fingerprints", "write_odd_files"]

FOLDER = "a 'b\" $HOME & %03d é ;-d"
LAYOUT = "-l 'ä\" %d.yaml"
SCENARIO = "-s ü\n& Co.yaml"
PROGRAM = "-p ø\nx. %s.sparc"
TITLE = 'L\'été: "chez nous" #1 店'

_LAYOUT = """\
# für L'été
name: {name}
nodes: {{a: [0, 0], b: [2, 0], c: [4, 0], d: [4, 2], e: [2, 2], f: [0, 2]}}
edges: [[a, b], [b, c], [c, d], [d, e], [e, f]]
entrance: a
agent: a
tables: {{t1: {{capacity: 2, nodes: [f], at: [0, 3.2]}}}}
"""
_SCENARIO = """\
name: {name}
layout: {layout}
observe: [{{enter: [c1]}}]
"""
_PROGRAM = """\
% ø — 店
sorts
#node = {a, b}.
predicates
edge(#node, #node).
rules
edge(a, b). % là
"""


def _scalar(text: str) -> str:
    """A text as a double-quoted scalar of YAML."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def write_odd_files(above: Path) -> Path:
    """The folder with a layout, a scenario for it, and a program."""
    folder = above / FOLDER
    folder.mkdir()
    scenario = _SCENARIO.format(name=_scalar(TITLE), layout=_scalar(LAYOUT))
    texts = {LAYOUT: _LAYOUT.format(name=_scalar(TITLE)), SCENARIO: scenario, PROGRAM: _PROGRAM}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def fingerprints(*places: Path) -> dict[Path, str]:
    """The sha256 of every file at, or anywhere below, the places."""
    files = [path for place in places for path in (place, *place.rglob("*")) if path.is_file()]
    return {path: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
