"""``waiter simulate``: plans played in a simulated restaurant, checked, and recorded."""

from __future__ import annotations

import sys
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.command_line.command import grouped
from waiter_cli.command_line.folding import folded
from waiter_cli.commands.options import (
    JsonOption,
    PlanOptions,
    Situation,
    VerboseOption,
    named_file,
    print_warnings,
)

if TYPE_CHECKING:
    from waiter_cli.pictures.filmed_run import Showing
    from waiter_cli.simulation.outcome import Rules, RunOutcome
    from waiter_cli.simulation.run_request import RunRequest

__all__ = ["simulate"]


class BackendName(str, Enum):
    """The backends that measure clearances."""

    auto = "auto"
    pybullet = "pybullet"
    geometric = "geometric"


class DriveName(str, Enum):
    """The ways in which the robot moves."""

    kinematic = "kinematic"
    physics = "physics"


class FailurePolicy(str, Enum):
    """The reactions to an action that fails or a way that is blocked."""

    stop = "stop"
    wait = "wait"
    replan = "replan"


class ViewName(str, Enum):
    """The views that a film has."""

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
        help="block:EDGE@T[+D], leave:CUSTOMER@T, enter:N@T, bill:TABLE@T, slip:P, stall:[ROBOT:]D@T "
        "or out:ROBOT@T[+D].",
    ),
]
RecordOption = Annotated[
    Optional[list[str]],
    typer.Option(
        "--record",
        "-o",
        callback=named_file,
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
        "What else happens": ("bill", "goal", "observe", "inject", "seed"),
        "Robot and room": ("headless", "backend", "drive", "speed", "on_failure"),
        "Recording": ("view", "fps", "size", "quality", "events"),
        "Search": ("search", "max_steps", "time_limit", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("verbose",),
    }
)
@folded
def simulate(
    context: typer.Context,
    situation: Situation,
    options: PlanOptions,
    plan_file: PlanFileOption = None,
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
    from waiter_cli.simulation.run_request import read_run_request

    begin(options.time_limit, options.memory_limit)
    _require_possible(events, quality, as_json)
    looks = {"--view": view, "--fps": fps, "--size": size, "--quality": quality}
    given = {name: str(value) for name, value in looks.items() if value is not None}
    recordings = _recordings(record, given, events)
    cue = read_run_request(
        situation.layout, situation.scenario, plan_file, situation.enter or (), situation.bill or (),
        situation.goal or (), situation.observe or (),
    )  # fmt: skip
    if cue.warnings:
        print_warnings(cue.problem.layout)
    for change in cue.changed:
        _remark(change)
    if cue.problem.contradictions:
        return _contradiction(cue, as_json)
    from waiter_cli.pictures.filmed_run import Showing
    from waiter_cli.simulation.outcome import Rules

    rules = Rules(speed, seed, drive.value, on_failure.value, options.max_steps)
    showing = Showing(
        recordings, None if view is None else view.value, fps or 12.0, size or "1260x720",
        quality or "full", headless is False, events,
    )  # fmt: skip
    chosen = _is_chosen(context, "domain")
    outcome, shown = _play(cue, options, chosen, backend, rules, inject, showing, verbose)
    return _report(cue, outcome, shown, as_json, sys.stderr if events == "-" else sys.stdout)


def _require_possible(events: str | None, quality: str | None, as_json: bool) -> None:
    """Raises `InputError` for options that cannot be, or not together."""
    from waiter_cli.errors import InputError

    if events == "-" and as_json:
        raise InputError(
            "--events - and --json would both write to stdout", "name a file for events"
        )
    if quality not in (None, "full", "draft"):
        raise InputError(f"no such quality: {quality}", "full or draft")


def _is_chosen(context: typer.Context, option: str) -> bool:
    """Returns whether an option was typed, or set by the environment."""
    source = context.get_parameter_source(option)
    return source is None or source.name != "DEFAULT"


def _play(
    cue: RunRequest, options: PlanOptions, chosen: bool, backend: BackendName, rules: Rules,
    inject: list[str] | None, showing: Showing, verbose: bool,
) -> tuple[RunOutcome, tuple[str, ...]]:  # fmt: skip
    """Plays a plan by the domain that was ``chosen``, or else by the one it was made with."""
    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.evenings.injections import read_injections
    from waiter_cli.execution.online_planner import OnlinePlanner
    from waiter_cli.pictures.filmed_run import build_checked_room, play_run
    from waiter_cli.problems.from_options import domain_of

    room = build_checked_room(cue.problem)
    translator = options.load_translator()
    remembered = not chosen and cue.made is not None and cue.made.domain is not None
    planner = OnlinePlanner(
        translator,
        domain_of(cue.made) if remembered and cue.made is not None else options.load_domain(),
        options.time_limit,
        options.search.value,
        options.max_steps,
        print_stages if verbose else None,
        by_bounds=cue.guests is not None or bool(cue.problem.layout.agents),
        limited_as_a_whole=True,
    )
    injections = read_injections(inject or (), cue.problem, cue.events)
    return play_run(cue, room, planner, backend.value, rules, injections, showing, _remark)


def _recordings(
    record: list[str] | None, looks: dict[str, str], events: str | None
) -> tuple[str, ...]:
    """Returns the recordings that are asked for; says on stderr what is odd about them."""
    recordings = tuple(record or ())
    if recordings or looks:
        from waiter_cli.console.output import say
        from waiter_cli.pictures.recorders import remarks, require_different

        require_different(recordings, events)
        for remark in remarks(recordings, looks):
            say(f"waiter: {remark}", sys.stderr)
    return recordings


def _remark(message: str) -> None:
    """Says on stderr what is worth knowing of a run."""
    from waiter_cli.console.output import say

    say(f"waiter: {message}", sys.stderr)


def _contradiction(cue: RunRequest, as_json: bool) -> int:
    """Reports that the observations contradict what is known, so that nothing is played."""
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
) -> int:
    """Prints what became of the run and returns the exit code."""
    from waiter_cli.console.output import print_json, say
    from waiter_cli.errors import Exit
    from waiter_cli.simulation.summary import document, lines

    if as_json:
        print_json(document(cue, outcome, shown))
    else:
        for line in lines(cue, outcome, shown, stream):
            say(line, stream)
    return {"done": Exit.OK, "failed": Exit.PROVED, "gave_up": Exit.UNDECIDED}[outcome.status]
