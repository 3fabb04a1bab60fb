"""Plays one evening of a study: `StudyRun` → `RunResult`.

Entry point `play_evening`, called in a worker: a process of this machine, or of a cluster.  Whatever goes
wrong becomes a result; nothing is raised but what ends the worker.
"""

from __future__ import annotations

import json
import time
from functools import lru_cache
from typing import Any

from sparc.limits import OverLimit, begin, end, pending, starved
from waiter_cli import __version__
from waiter_cli.encoding.domains import Domain, find_domain, require_plans
from waiter_cli.errors import InputError, MissingError
from waiter_cli.execution.online_planner import OnlinePlanner
from waiter_cli.file_access.locate import BuiltIn
from waiter_cli.files.layout_reader import read_layout
from waiter_cli.files.scenario_reader import read_scenario
from waiter_cli.model.layout import Layout
from waiter_cli.model.scenario import Scenario
from waiter_cli.pictures.filmed_run import Showing, build_checked_room, play_run
from waiter_cli.problems.guests import require_guests
from waiter_cli.problems.pose import pose_problem
from waiter_cli.simulation.outcome import Rules, RunOutcome
from waiter_cli.simulation.run_request import RunRequest
from waiter_cli.study.studies import BACKEND, RunLimits, RunResult, StudyRun
from waiter_cli.translators.native import NativeTranslator

__all__ = ["evening_events", "play_evening"]


def play_evening(run: StudyRun, limits: RunLimits) -> RunResult:
    """Returns what came of an evening.

    In the main thread of its process the limits hold by themselves, for as long as Python is at work.
    """
    begun, started = time.process_time(), time.monotonic()

    def result(status: str, reason: str | None, figures: dict[str, Any] | None) -> RunResult:
        return RunResult(run.key, status, reason, figures, time.process_time() - begun)

    if run.version != __version__:
        told = f"the worker has waiter {__version__}, the study {run.version}"
        return result("failed", told, None)
    try:
        begin(limits.seconds, limits.memory)
        outcome = _play(run)
    except OverLimit as over:
        return result("limit", _words(over.limit, limits), None)
    except (InputError, MissingError) as error:
        return result("failed", " ".join(str(error).split()), None)
    except Exception as error:
        limit = "memory" if starved(error) else pending()
        if limit is not None:
            return result("limit", _words(limit, limits), None)
        told = f"internal fault: {type(error).__name__}: {' '.join(str(error).split())}"
        return result("failed", told, None)
    finally:
        end()
    if limits.seconds is not None and time.monotonic() - started > limits.seconds:
        return result("limit", _words("time", limits), None)
    if outcome.status == "done":
        return result("done", None, outcome.figures)
    if outcome.limit is not None:
        return result("limit", outcome.why or outcome.limit, outcome.figures)
    failures = "; ".join(f"{each.check}: {each.reason}" for each in outcome.failures[:3])
    return result("failed", outcome.why or failures or "it gave up", outcome.figures)


def evening_events(run: StudyRun) -> list[dict[str, Any]]:
    """Returns the events of an evening, as ``simulate --events`` writes them.

    Raises `InputError` for an evening that cannot be played.
    """
    lines: list[str] = []
    _play(run, Showing(listener=lines.append))
    return [json.loads(line) for line in lines]


def _words(limit: str, limits: RunLimits) -> str:
    if limit == "time":
        return f"not done in {limits.seconds:g} s"
    return "the memory was used up"


def _play(run: StudyRun, showing: Showing = Showing()) -> RunOutcome:
    layout = _layout(run.layout.text, run.layout.label)
    scenario = _scenario(run.scenario_text, run.scenario, layout)
    problem = pose_problem(layout, scenario)
    if problem.contradictions:
        raise InputError(problem.contradictions[0].message)
    require_guests(problem, scenario.events)
    # Without a limit of time for a search: the same evening on any machine.
    planner = OnlinePlanner(
        NativeTranslator(), _domain(), None, by_bounds=True, limited_as_a_whole=True
    )
    request = RunRequest(problem, scenario.events, guests=scenario.guests)
    rules = Rules(run.speed, run.seed)
    room = build_checked_room(problem)
    outcome, _ = play_run(request, room, planner, BACKEND, rules, (), showing)
    return outcome


@lru_cache(maxsize=1)
def _domain() -> Domain:
    return require_plans(find_domain(BuiltIn("restaurant")))


@lru_cache(maxsize=256)
def _layout(text: str, label: str) -> Layout:
    return read_layout(text, label)


@lru_cache(maxsize=256)
def _scenario(text: str, name: str, layout: Layout) -> Scenario:
    return read_scenario(text, name, layout)
