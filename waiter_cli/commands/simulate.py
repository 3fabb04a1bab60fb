"""``waiter simulate``: plans played in a simulated restaurant, checked, and recorded."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.command import grouped
from waiter_cli.commands.options import (
    BillOption,
    DomainOption,
    EnterOption,
    GoalOption,
    JsonOption,
    LayoutOption,
    MaxStepsOption,
    MemoryLimitOption,
    ScenarioOption,
    SearchOption,
    SparcJarOption,
    Strategy,
    TimeLimitOption,
    TranslatorName,
    TranslatorOption,
    VerboseOption,
    load_domain,
    load_translator,
)

if TYPE_CHECKING:
    from waiter_cli.encoding.domains import Domain
    from waiter_cli.execution.protocols import Controller, PlannerProtocol
    from waiter_cli.room.room import Room
    from waiter_cli.simulation.cue import RunRequest
    from waiter_cli.simulation.outcome import RunOutcome
    from waiter_cli.simulation.player import Player

__all__ = ["simulate"]


class BackendName(str, Enum):
    """What measures clearances."""

    auto = "auto"
    pybullet = "pybullet"
    geometric = "geometric"


class DriveName(str, Enum):
    """How the robot moves."""

    kinematic = "kinematic"
    physics = "physics"


class FailurePolicy(str, Enum):
    """What to do when an action fails or the way is blocked."""

    stop = "stop"
    wait = "wait"
    replan = "replan"


class ViewName(str, Enum):
    """What a film shows."""

    three = "3d"
    two = "2d"


PlanFileOption = Annotated[
    Optional[str],
    typer.Option("--plan", "-p", metavar="P.json", help="Play this plan (waiter plan --json)."),
]
InjectOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--inject",
        metavar="KIND:ARGS",
        help="block:EDGE@T[+D], leave:CUSTOMER@T, enter:N@T, bill:TABLE@T, slip:P or stall:D@T.",
    ),
]
RecordOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--record",
        "-o",
        metavar="OUT",
        help="OUT.mp4, .gif, .png, .html or FOLDER/; may be given again.",
    ),
]
EventsOption = Annotated[
    Optional[str],
    typer.Option("--events", metavar="FILE", help="Write the events as JSON lines; - is stdout."),
]


@grouped(
    {
        "Options": ("layout", "scenario", "plan_file", "enter", "record", "as_json"),
        "What else happens": ("bill", "goal", "inject", "seed"),
        "Robot and room": ("headless", "backend", "drive", "speed", "on_failure"),
        "Recording": ("view", "fps", "size", "quality", "events"),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("verbose",),
    }
)
def simulate(
    context: typer.Context,
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    plan_file: PlanFileOption = None,
    enter: EnterOption = None,
    bill: BillOption = None,
    goal: GoalOption = None,
    headless: Annotated[
        Optional[bool],
        typer.Option("--headless/--gui", help="Without a window (the default), or in PyBullet's."),
    ] = None,
    backend: Annotated[
        BackendName, typer.Option("--backend", help="What measures clearances.")
    ] = BackendName.auto,
    drive: Annotated[
        DriveName, typer.Option("--drive", help="Exact motion, or wheels on a floor.")
    ] = DriveName.kinematic,
    speed: Annotated[
        float, typer.Option("--speed", min=0.05, max=5.0, metavar="M/S", help="Of the robot.")
    ] = 0.8,
    seed: Annotated[
        int, typer.Option("--seed", min=0, metavar="N", help="Of what happens by chance.")
    ] = 0,
    inject: InjectOption = None,
    on_failure: Annotated[
        FailurePolicy,
        typer.Option("--on-failure", help="When an action fails or a way is blocked."),
    ] = FailurePolicy.replan,
    record: RecordOption = None,
    view: Annotated[
        Optional[ViewName], typer.Option("--view", help="3d where PyBullet is there, else 2d.")
    ] = None,
    fps: Annotated[
        Optional[float],
        typer.Option(
            "--fps", min=1.0, max=60.0, metavar="N", help="Frames a second; 12 unless told."
        ),
    ] = None,
    size: Annotated[
        Optional[str],
        typer.Option("--size", metavar="WxH", help="Of a frame; 1260x720 unless told."),
    ] = None,
    quality: Annotated[
        Optional[str],
        typer.Option(
            "--quality", metavar="full|draft", help="Smooth edges (unless told), or speed."
        ),
    ] = None,
    events: EventsOption = None,
    as_json: JsonOption = False,
    search: SearchOption = Strategy.binary,
    max_steps: MaxStepsOption = None,
    time_limit: TimeLimitOption = None,
    memory_limit: MemoryLimitOption = None,
    domain: DomainOption = "restaurant",
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    verbose: VerboseOption = False,
) -> int:
    """Plan, act, observe and plan again in a simulated restaurant; every action is checked.

    Exit code 0: the goals are reached and no check failed; 3: a check or an action failed;
    4: it gave up.

    \b
    Examples:
      waiter simulate --scenario b1
      waiter simulate --layout report --enter 2 --record film.mp4
      waiter simulate --scenario lunch --inject block:south2-south3@2+8 --events -
    """
    from sparc.limits import begin
    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.simulation.cue import read_cue

    begin(None, memory_limit)
    if events == "-" and as_json:
        raise InputError(
            "--events - and --json would both write to stdout", "name a file for events"
        )
    if quality not in (None, "full", "draft"):
        raise InputError(f"no such quality: {quality}", "full or draft")
    looks = {"--view": view, "--fps": fps, "--size": size, "--quality": quality}
    given = {name: str(value) for name, value in looks.items() if value is not None}
    recordings = _recordings(record, given, events)
    cue = read_cue(layout, scenario, plan_file, enter or (), bill or (), goal or ())
    if cue.warnings:
        from waiter_cli.console.output import print_faults
        from waiter_cli.layout_tools.advice_text import told_warnings

        print_faults(told_warnings(cue.problem.layout), "warning")
    for change in cue.changed:
        from waiter_cli.console.output import say

        say(f"waiter: {change}", sys.stderr)
    if cue.problem.contradictions:
        return _contradiction(cue, as_json)
    room = _room(cue)
    from waiter_cli.execution.online_planner import OnlinePlanner

    brain = OnlinePlanner(
        load_translator(translator, sparc_jar),
        _domain(context, domain, cue),
        time_limit,
        search.value,
        max_steps,
        print_stages if verbose else None,
    )
    injections = _injections(inject, cue)
    from contextlib import ExitStack

    from waiter_cli.simulation.open_backend import open_backend
    from waiter_cli.simulation.outcome import Rules

    rules = Rules(speed, seed, drive.value, on_failure.value, max_steps)
    with ExitStack() as opened:
        film = None
        if recordings or headless is False:
            gui = headless is False
            look = (fps or 12.0, size or "1260x720", quality or "full")
            film = _film(room, recordings, view, backend, *look, gui=gui)
            opened.enter_context(film)
        measuring = open_backend(backend.value, drive.value)
        opened.callback(measuring.close)
        if backend is BackendName.auto and measuring.name == "geometric":
            from waiter_cli.console.output import say

            note = "PyBullet is not there; clearances are measured geometrically"
            say(f"waiter: {note}", sys.stderr)
        outcome, shown = _play(cue, room, brain, measuring, rules, injections, events, film)
    _report(cue, outcome, shown, as_json, sys.stderr if events == "-" else sys.stdout)
    return {"done": Exit.OK, "failed": Exit.PROVED, "gave_up": Exit.UNDECIDED}[outcome.status]


def _domain(context: typer.Context, name: str, cue: RunRequest) -> Domain:
    """The domain that was asked for, else the one that the plan was made with."""
    from waiter_cli.problems.from_options import domain_of

    source = context.get_parameter_source("domain")
    if cue.made is None or cue.made.domain is None or source is None or source.name != "DEFAULT":
        return load_domain(name)
    return domain_of(cue.made)


def _recordings(
    record: list[str] | None, looks: dict[str, str], events: str | None
) -> tuple[str, ...]:
    """What is to be recorded; what is odd about it is said on stderr."""
    recordings = tuple(record or ())
    if recordings or looks:
        from waiter_cli.console.output import say
        from waiter_cli.pictures.recorders import remarks, require_different

        require_different(recordings, events)
        for remark in remarks(recordings, looks):
            say(f"waiter: {remark}", sys.stderr)
    return recordings


def _room(cue: RunRequest) -> Room:
    """The room of the layout; raises `LayoutError` where an edge runs through furniture."""
    from waiter_cli.errors import LayoutError
    from waiter_cli.room.room import build_room, sweep

    room = build_room(cue.problem.layout)
    faults = sweep(room, dict(cue.problem.state.chairs))
    if faults:
        raise LayoutError(faults)
    return room


def _injections(inject: list[str] | None, cue: RunRequest) -> Any:
    from waiter_cli.simulation.injections import read_injections

    return read_injections(inject or (), cue.problem, cue.events)


def _film(
    room: Room, record: Sequence[str], view: ViewName | None, backend: BackendName,
    fps: float, size: str, quality: str, *, gui: bool,
) -> Any:  # fmt: skip
    """What watches the player: a recorder, a window."""
    from waiter_cli.pictures.film import open_film

    wanted = view.value if view is not None else None
    return open_film(room, record, wanted, backend.value, fps, size, quality, gui=gui)


def _play(
    cue: RunRequest, room: Room, brain: PlannerProtocol, measuring: Any, rules: Any, injections: Any,
    events: str | None, film: Any,
) -> tuple[RunOutcome, tuple[str, ...]]:  # fmt: skip
    """Plays, with the event log going where it should."""
    from waiter_cli.pictures.output_files import opened
    from waiter_cli.simulation.event_log import EventLog
    from waiter_cli.simulation.plan_follower import PlanFollower, thinking
    from waiter_cli.simulation.player import Player

    mind: Controller
    if cue.plan is not None:
        mind = PlanFollower(cue.problem, cue.plan, brain)
    else:
        mind = thinking(cue.problem, brain)
    with opened(events) as write:
        lines = [write] if write is not None else []
        if film is not None:
            lines.append(film.event)

        def say(line: str) -> None:
            for each in lines:
                each(line)

        player: Player = Player(
            room, cue.problem, mind, measuring, EventLog(say), rules, cue.events, injections,
            film.watch if film is not None else None, cue.predicted,
            cue.scenario or cue.problem.layout.name,
        )  # fmt: skip
        outcome = player.run()
        return outcome, () if film is None else film.finish(player, outcome)


def _contradiction(cue: RunRequest, as_json: bool) -> int:
    """What was observed cannot be: nothing is played."""
    from waiter_cli.console.output import print_faults, print_json, say
    from waiter_cli.errors import Exit, Fault

    reasons = cue.problem.contradictions
    if as_json:
        from waiter_cli.files.documents import message_document

        told = [message_document(reason.message, reason.where) for reason in reasons]
        print_json({"status": "contradiction", "layout": cue.problem.layout.name, "reasons": told})
    else:
        say("What was observed contradicts what is known.")
        print_faults(Fault(r.where, r.message) for r in reasons)
    return Exit.PROVED


def _report(
    cue: RunRequest, outcome: RunOutcome, shown: tuple[str, ...], as_json: bool, stream: Any
) -> None:
    from waiter_cli.console.output import print_json, say
    from waiter_cli.simulation.summary import document, lines

    if as_json:
        print_json(document(cue, outcome, shown))
        return
    for line in lines(cue, outcome, shown, stream):
        say(line, stream)
