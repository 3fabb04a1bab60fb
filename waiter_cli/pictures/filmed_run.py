"""Plays a run and shows it: `RunRequest`, planner → `RunOutcome` and recordings.

Entry points `build_checked_room`, `play_run`; `Showing` says what is to be seen of a run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from sparc.lazy_dataclass import dataclass
from waiter_cli.domain_execution.domain_rules import begun, require_events
from waiter_cli.errors import LayoutError
from waiter_cli.execution.joint_requirements import require_joint_run, require_joint_words
from waiter_cli.execution.plan_follower import PlanFollower, thinking
from waiter_cli.execution.protocols import Controller, PlannerProtocol, rules_of
from waiter_cli.model.problem import Problem
from waiter_cli.pictures.film import Watcher, open_film
from waiter_cli.pictures.output_files import opened
from waiter_cli.room.room import build_room, sweep
from waiter_cli.rules.rulebook import HOUSE
from waiter_cli.simulation.event_log import EventLog
from waiter_cli.simulation.open_backend import open_backend
from waiter_cli.simulation.run import Run

if TYPE_CHECKING:
    from waiter_cli.evenings.injections import Injection
    from waiter_cli.room.room import Room
    from waiter_cli.simulation.clearance import Backend
    from waiter_cli.simulation.outcome import Rules, RunOutcome
    from waiter_cli.simulation.run_request import RunRequest

__all__ = ["Showing", "build_checked_room", "play_run"]


@dataclass(frozen=True)
class Showing:
    """The outputs of a run: what is shown and recorded.

    ``recordings`` are files and folders, ``view`` is ``3d``, ``2d`` or None (3d where PyBullet is
    there), ``fps`` frames a second, ``size`` pixels as ``WxH``, ``quality`` full or draft.  With
    ``window`` it is shown on the screen.  ``events`` is a file for the events, ``-`` stdout;
    ``listener`` is told each of them, a line of JSON.
    """

    recordings: tuple[str, ...] = ()
    view: str | None = None
    fps: float = 12.0
    size: str = "1260x720"
    quality: str = "full"
    window: bool = False
    events: str | None = None
    listener: Callable[[str], object] | None = None


def build_checked_room(problem: Problem) -> Room:
    """Returns the room of a problem's layout; raises `LayoutError` where an edge runs through furniture."""
    room = build_room(problem.layout)
    faults = sweep(room, dict(problem.state.chairs))
    if faults:
        raise LayoutError(faults)
    return room


def play_run(
    request: RunRequest,
    room: Room,
    planner: PlannerProtocol,
    backend: str,
    rules: Rules,
    injections: Sequence[Injection],
    showing: Showing,
    remark: Callable[[str], None] | None = None,
) -> tuple[RunOutcome, tuple[str, ...]]:
    """Returns what became of a run, and the recordings that were made.

    ``backend`` is ``auto``, ``pybullet`` or ``geometric``; ``remark`` is told what is worth knowing.
    Raises `InputError` for what cannot be recorded, `MissingError` for what is not installed.
    """
    require_joint_run(request.problem.layout, getattr(planner, "domain", None))
    require_joint_words(request.problem)
    require_events(request.problem, request.events, rules_of(planner))
    with ExitStack() as stack:
        film = None
        if showing.recordings or showing.window:
            film = open_film(
                room, showing.recordings, showing.view, backend, showing.fps, showing.size,
                showing.quality, gui=showing.window,
            )  # fmt: skip
            stack.enter_context(film)
        names = [name for name, _ in request.problem.layout.agents]
        measuring = open_backend(backend, rules.drive, names)
        stack.callback(measuring.close)
        if remark is not None and backend == "auto" and measuring.name == "geometric":
            remark("PyBullet is not there; clearances are measured geometrically")
        return _play(request, room, planner, measuring, rules, injections, showing, film)


def _play(
    request: RunRequest, room: Room, planner: PlannerProtocol, measuring: Backend, rules: Rules,
    injections: Sequence[Injection], showing: Showing, film: Watcher | None,
) -> tuple[RunOutcome, tuple[str, ...]]:  # fmt: skip
    """Plays the run, and writes its event log where it belongs."""
    book = rules_of(planner)
    problem = begun(request.problem, book)
    if problem.layout.agents:
        return _play_together(
            problem, request, room, planner, measuring, rules, injections, showing, film
        )
    controller: Controller
    if request.plan is not None:
        controller = PlanFollower(problem, request.plan, planner)
    else:
        controller = thinking(problem, planner)
    with opened(showing.events) as write:
        say = _to_all(write, None if film is None else film.event, showing.listener)
        run = Run(
            room, problem, controller, measuring, EventLog(say), rules, request.events, injections,
            film.watch if film is not None else None, request.predicted,
            request.scenario or problem.layout.name, request.guests,
            book, None if book is HOUSE else getattr(planner, "domain", None),
        )  # fmt: skip
        outcome = run.play()
        return outcome, () if film is None else film.finish(run, outcome)


def _play_together(
    problem: Problem, request: RunRequest, room: Room, planner: PlannerProtocol, measuring: Backend,
    rules: Rules, injections: Sequence[Injection], showing: Showing, film: Watcher | None,
) -> tuple[RunOutcome, tuple[str, ...]]:  # fmt: skip
    """Plays like `_play`, with several robots."""
    from waiter_cli.execution.fleet_executive import thinking_together
    from waiter_cli.simulation.fleet.fleet_run import FleetRun

    mind = thinking_together(problem, planner, request.plan)
    with opened(showing.events) as write:
        say = _to_all(write, None if film is None else film.event, showing.listener)
        run = FleetRun(
            room, problem, mind, measuring, EventLog(say), rules, request.events, injections,
            film.watch if film is not None else None, request.predicted,
            request.scenario or problem.layout.name, request.guests,
        )  # fmt: skip
        outcome = run.play()
        return outcome, () if film is None else film.finish(run, outcome)


def _to_all(*listeners: Callable[[str], object] | None) -> Callable[[str], None]:
    """Returns what tells a line to every listener that there is."""
    there = [listener for listener in listeners if listener is not None]

    def say(line: str) -> None:
        for listener in there:
            listener(line)

    return say
