"""The documents of the tools, as shapes: ``domain``, ``layout``, ``compare``, ``sparc`` and ``doctor``."""

from __future__ import annotations

from tests.support.documents import FAULT, LIMIT
from tests.support.shapes import ANY, Either, optional

__all__ = [
    "CHECKED", "COMPARED", "COMPARED_AGENTS", "CONSISTENT", "CONVERTED", "DOCTOR", "DRAWN", "FIGURES", "FORMATTED", "HOLDS",
    "HOLDS_NOT", "IMPROVED", "IMPROVED_BY_EVENINGS", "INCONSISTENT", "INSTALLED", "LISTED", "MADE", "NO_SET",
    "PLAYED", "QUERIES", "SEVERAL_HOLD", "STUDIED", "STUDY", "STUDY_REPORT",
    "BEGUN", "QUERY", "SCHEMA", "SHOWN", "SPARC", "TESTED", "TOTALS",
    "TRANSLATED",
]  # fmt: skip

_CASE = {
    "name": str,
    "file": str,
    "line": int,
    "passed": bool,
    "failures": [
        {"message": str, "instead": optional(str), "file": str, "line": int, "column": int}
    ],
}
BEGUN = {"status": {"made"}, "domain": str, "file": optional(str), "text": str}
TESTED = {
    "status": {"passed", "failed"},
    "domain": str,
    "passed": int,
    "failed": int,
    "cases": [_CASE],
    "seconds": float,
    "coverage?": [
        {
            "file": str,
            "line": int,
            "column": int,
            "statement": str,
            "sentence": str,
            "fired": bool,
        }
    ],
}
SHOWN = {
    "domain": str,
    "blocks": [
        {
            "section": str,
            "parts": [str],
            "sentence": str,
            "line": int,
            "lines": [{"line": int, "text": str}],
        }
    ],
}
CHECKED = {
    "status": {"ok", "advice"},
    "layout": str,
    "file": str,
    "nodes": int,
    "edges": int,
    "tables": int,
    "seats": int,
    "advice": [{**FAULT, "kind": str}],
}
DRAWN = {
    "status": "drawn",
    "layout": str,
    "files": [str],
    "text": optional(str),
    "note": optional(str),
}
MADE = {"status": "made", "seed": int, "file": optional(str), "text": str}
CONVERTED = {
    "status": "converted",
    "layout": str,
    "file": optional(str),
    "text": str,
    "remarks": [FAULT],
}
FIGURES = Either(
    (
        {
            "status": {"plan", "undecided"},
            "limit?": LIMIT,
            "steps": int,
            "minimal": bool,
            "metres": float,
            "seconds": optional(float),
            "waiting": {
                "mean_steps": float,
                "longest_steps": int,
                "mean_seconds": optional(float),
                "longest_seconds": optional(float),
            },
        },
        {
            "status": {"no_plan", "contradiction", "undecided", "no_fit"},
            "limit?": LIMIT,
            "message": str,
        },
    )
)
TOTALS = {
    "scenarios": int,
    "steps": int,
    "metres": float,
    "seconds": optional(float),
    "waiting": float,
    "waiting_unit": {"seconds", "steps"},
}
_SAVED = {"steps": int, "metres": float, "waiting": float}
COMPARED = {
    "status": "compared",
    "layouts": [{"name": str, "file": str}],
    "scenarios": [{"scenario": str, "file": str, "results": [FIGURES]}],
    "totals": [TOTALS],
    "difference": _SAVED,
}
COMPARED_AGENTS = {
    "status": "compared",
    "layouts": [{"name": str, "file": str}],
    "agents": [int],
    "scenarios": [{"scenario": str, "file": str, "results": [FIGURES]}],
}
_NAMED = {"scenario": str, "file": str}
IMPROVED = {
    "status": {"improved", "no_improvement"},
    "layout": str,
    "before": TOTALS,
    "scenarios": [Either(tuple({**_NAMED, **each} for each in FIGURES.shapes))],
    "improvements": [{"kind": str, "change": str, "after": TOTALS, "saved": _SAVED, "solved": int}],
    "tried": int,
    "candidates": int,
    "stopped": optional({"time", "tries"}),
}
_VERDICT = {"more", "less", "same", "unsupported", "too_few"}
_OF_EVENINGS = {
    "mean": optional(float),
    "low": optional(float),
    "high": optional(float),
    "verdict": _VERDICT,
    "sentence": optional(str),
}
IMPROVED_BY_EVENINGS = {
    "status": {"improved", "no_improvement", "undecided"},
    "layout": str,
    "study": str,
    "for": str,
    "better": {"more", "less"},
    "before": optional(float),
    "best": optional({"kind": str, "change": str, **_OF_EVENINGS}),
    "beside": [{"figure": str, **_OF_EVENINGS}],
    "screened": [{"kind": str, "change": str, "mean": float, "evenings": int}],
    "choosing": int,
    "judging": int,
    "looks": int,
    "tried": int,
    "candidates": int,
    "runs": int,
    "failed": int,
    "stopped": optional({"time"}),
    "sentences": [str],
}
STUDIED = {
    "status": "complete",
    "study": str,
    "store": str,
    "runs": int,
    "done": int,
    "failed": int,
    "limit": int,
    "played": int,
    "seconds": float,
}
STUDY = {
    "status": {"complete", "incomplete"},
    "study": str,
    "file": str,
    "store": str,
    "version": str,
    "varied": [{"layout", "agents", "speed"}],
    "runs": int,
    "done": int,
    "failed": int,
    "limit": int,
    "left": int,
    "combinations": [
        {
            "layout": str,
            "agents": optional(int),
            "speed": float,
            "done": int,
            "failed": int,
            "limit": int,
            "means": {ANY: optional(float)},
        }
    ],
    "reasons": [{"status": {"failed", "limit"}, "reason": str, "runs": int, "first": int}],
}
PLAYED = {"status": {"layout", "scenario"}, "run": int, "name": str, "text": str}
STUDY_REPORT = {
    "status": "reported",
    **{key: STUDY[key] for key in ("study", "file", "store", "version", "varied", "runs")},
    **{key: STUDY[key] for key in ("done", "failed", "limit", "left", "combinations")},
    "evenings": int,
    "sentences": [str],
    "comparisons": [
        {
            "vary": {"agents", "speed", "layout"},
            "first": Either((str, float)),
            "other": Either((str, float)),
            "evenings": int,
            "left_out": int,
            "differences": [
                {
                    "figure": str,
                    "mean": optional(float),
                    "low": optional(float),
                    "high": optional(float),
                    "verdict": {"more", "less", "same", "unsupported", "too_few"},
                    "sentence": optional(str),
                }
            ],
        }
    ],
    "best": [{"layout": str, "lost": float, "wait_seat_mean": optional(float)}],
    "worst": [
        {
            "run": int,
            "layout": str,
            "agents": optional(int),
            "speed": float,
            "seed": int,
            "lost": int,
            "wait_seat_p95": optional(float),
            "replay": str,
        }
    ],
    "report": optional(str),
}
SCHEMA = {"$schema": str, "title": str, ANY: object}
SPARC = {
    "status": "ok",
    "sorts": int,
    "predicates": int,
    "rules": int,
    "warnings": [FAULT],
}
TRANSLATED = {"status": "ok", "file": optional(str), "text": str}
QUERY = {
    "query": str,
    "answer": {"yes", "no", "unknown", "inconsistent", "undecided"},
    "limit?": "time",
    "bindings": [{ANY: Either((str, int))}],
}
QUERIES = {"answers": [QUERY]}
FORMATTED = {
    "status": "formatted",
    "in_place": bool,
    "files": [{"file": str, "changed": bool}],
}
INSTALLED = {
    "status": "installed",
    "version": str,
    "path": str,
    "sha256": str,
    "fetched": bool,
}
_STATEMENT = {"file": str, "line": int, "column": int, "text": str}
INCONSISTENT = {
    "status": "inconsistent",
    "complete": bool,
    "limit?": LIMIT,
    "causes": [[{**_STATEMENT, "sentence": optional(str), "instances": [str]}]],
    "mends": [{"without": [_STATEMENT]}],
    "contraries?": [[[str]]],
}
CONSISTENT = {"status": "consistent", "complete": True, "causes": [], "mends": []}
_RULE = {"rule": {**_STATEMENT, "sentence": optional(str)}, "instance": str}
_PREMISE = {
    "literal": str,
    "rule?": object,
    "instance?": str,
    "note?": str,
    "aggregates?": [{"aggregate": str, "elements": [str]}],
    "because_not?": [object],
    "premises": [object],
}
HOLDS = {
    "literal": str,
    "holds": True,
    "set": int,
    "because": {**_PREMISE, **_RULE, "premises": [_PREMISE]},
}
HOLDS_NOT = {
    "literal": str,
    "holds": False,
    "set": int,
    "because_not": [{**_RULE, "failed": str, "note?": str, "then?": object}],
    "note?": str,
}
NO_SET = {"literal": str, "holds": None, "set": int}
SEVERAL_HOLD = {"literals": [HOLDS]}
_ONE = {"name": str, "about": str, "file": str}
LISTED = {
    "layouts": [
        {
            **_ONE,
            "nodes": int,
            "edges": int,
            "tables": int,
            "seats": int,
            "waiters": int,
            "bar": bool,
        }
    ],
    "scenarios": [{**_ONE, "layout": str, "guests": int, "goals": int, "events": int}],
    "domains": [{**_ONE, "sorts": int, "predicates": int, "rules": int}],
}
DOCTOR = {
    "ok": bool,
    "waiter": str,
    "platform": str,
    "components": [
        {
            "name": str,
            "status": {"ok", "missing", "unusable", "unavailable"},
            "needed_for": str,
            "core": bool,
            "version": optional(str),
            "path": optional(str),
            "sha256": optional(str),
            "mend": optional(str),
        }
    ],
}
