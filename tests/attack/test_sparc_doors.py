"""Programs in odd encodings, and of odd shapes, through every door: one verdict, and no fault of ours."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from sparc.__main__ import main
from tests.support.cli import waiter

GOOD = "sorts\n#s = {a,b}.\npredicates\np(#s). q(#s).\nrules\np(a).\nq(X) :- p(X).\n"
ONE = "sorts #s = {{a}}. predicates p(#s). rules p({0}). "
FINE, WRONG, LARGE = 0, 2, 4

PROGRAMS: dict[str, tuple[int, bytes]] = {
    "BOM": (FINE, b"\xef\xbb\xbf" + GOOD.encode()),
    "Latin-1 in a comment": (FINE, f"% caf\xe9\n{GOOD}".encode("latin-1")),
    "Latin-1 in a name": (WRONG, GOOD.replace("{a", "{\xe9,a").encode("latin-1")),
    "CRLF": (FINE, GOOD.replace("\n", "\r\n").encode()),
    "NUL": (WRONG, GOOD.replace("p(a)", "p(\0a)").encode()),
    "UTF-16": (WRONG, GOOD.encode("utf-16")),
    "UTF-16, no mark": (WRONG, GOOD.encode("utf-16-le")),
    "UTF-32": (WRONG, GOOD.encode("utf-32")),
    "empty": (WRONG, b""),
    "half a character": (FINE, GOOD.encode() + b"% \xe2\x82"),
    "a surrogate": (FINE, GOOD.encode() + b"% \xed\xa0\x80\n"),
    "form feed": (WRONG, GOOD.replace("rules\n", "rules\f\n").encode()),
    "hard space": (WRONG, GOOD.replace(") :-", ")\u00a0:-").encode()),
    "escape": (WRONG, GOOD.replace("p(a)", "p(\x1b[31ma)").encode()),
    "deep brackets": (LARGE, ONE.format("(" * 9_000 + "a" + ")" * 9_000).encode()),
    "deep records": (LARGE, ONE.format("f(" * 9_000 + "a" + ")" * 9_000).encode()),
    "a long sum": (LARGE, ONE.format("1+" * 9_000 + "1").encode()),
    "a script": (WRONG, b"#script(python)\nimport os\n#end.\n" + GOOD.encode()),
    "many slips": (WRONG, GOOD.encode() + b"p(a) <- q(a).\n" * 300),
    "many rules in a line": (FINE, ONE.format("a").encode() + b"p(a). " * 1_000),
}


def codes(data: bytes, folder: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """The exit code at each door; what it says has no traceback, and nothing that a terminal obeys."""
    path = folder / "p.sparc"
    path.write_bytes(data)
    found = {}
    for door, command in {
        "answersets": ("answersets", path),
        "json": ("answersets", path, "--json"),
        "stdin": ("answersets", "-"),
        "check": ("sparc", "check", path),
        "explain": ("sparc", "explain", path),
        "why": ("sparc", "why", path, "p(a)"),
        "query": ("sparc", "query", path, "-q", "p(a)"),
        "format": ("sparc", "format", path),
    }.items():
        ran = waiter(*map(str, command), stdin=io.BytesIO(data))
        assert "Traceback" not in ran.err + ran.out and "\x1b" not in ran.err + ran.out, door
        assert ran.code == 0 or door == "json" or ran.err, door
        found[door] = ran.code
        if door == "json":
            assert ran.json()
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))
    found["python -m sparc"] = main([str(path)])
    found["python -m sparc -"] = main(["-"])
    return found


@pytest.mark.parametrize("name", PROGRAMS)
def test_every_door_has_the_same_verdict(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, data = PROGRAMS[name]
    found = codes(data, tmp_path, monkeypatch)
    assert found == dict.fromkeys(found, code)
