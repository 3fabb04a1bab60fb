"""``waiter serve``: the live loop, observations in as JSON lines, plans out as JSON lines."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Optional

import typer

from waiter_cli.command_line.command import grouped
from waiter_cli.commands.options import (
    DomainOption,
    LayoutOption,
    MaxStepsOption,
    MemoryLimitOption,
    PlanOptions,
    ScenarioOption,
    SearchOption,
    SparcJarOption,
    Strategy,
    TranslatorName,
    TranslatorOption,
    VerboseOption,
    named_file,
)

if TYPE_CHECKING:
    from waiter_cli.execution.online_planner import OnlinePlanner
    from waiter_cli.model.layout import Layout
    from waiter_cli.model.scenario import Scenario
    from waiter_cli.serve.session import Session

__all__ = ["serve"]

JournalOption = Annotated[
    Optional[str],
    typer.Option(
        "--journal",
        callback=named_file,
        metavar="FILE",
        help="Make every accepted line durable; go on from there.",
    ),
]
ListenOption = Annotated[
    Optional[str],
    typer.Option(
        "--listen",
        metavar="ADDRESS",
        help="Talk on 127.0.0.1:PORT or a UNIX socket instead of stdin and stdout.",
    ),
]
ReplayOption = Annotated[
    Optional[str],
    typer.Option(
        "--replay", metavar="JOURNAL", help="Print the answers of a journal again and check them."
    ),
]
CompactOption = Annotated[
    bool,
    typer.Option(
        "--compact", help="First put what is believed now in place of the journal's past."
    ),
]
FaultsOption = Annotated[
    bool, typer.Option("--json", help="What is wrong at the start is one JSON document, too.")
]
LimitOption = Annotated[
    Optional[float],
    typer.Option(
        "--time-limit",
        min=0.0,
        metavar="SECONDS",
        help="So long a search may take; then the best plan is given (0.4; jar: no limit).",
    ),
]
TimingOption = Annotated[
    bool,
    typer.Option("--record-timing", help="At the end print p50, p95 and p99 on stderr."),
]


@grouped(
    {
        "Options": ("layout", "scenario", "journal", "listen", "time_limit", "as_json"),
        "Journals": ("replay", "compact"),
        "Search": ("search", "max_steps", "memory_limit"),
        "Rules": ("domain", "translator", "sparc_jar"),
        "Looking closer": ("record_timing", "verbose"),
    }
)
def serve(
    layout: LayoutOption = None,
    scenario: ScenarioOption = None,
    journal: JournalOption = None,
    listen: ListenOption = None,
    as_json: FaultsOption = False,
    search: SearchOption = Strategy.binary,
    max_steps: MaxStepsOption = None,
    time_limit: LimitOption = None,
    memory_limit: MemoryLimitOption = None,
    record_timing: TimingOption = False,
    replay: ReplayOption = None,
    compact: CompactOption = False,
    domain: DomainOption = "restaurant",
    translator: TranslatorOption = TranslatorName.native,
    sparc_jar: SparcJarOption = None,
    verbose: VerboseOption = False,
) -> int:
    """Keep planning while things happen: one JSON object a line in, one answer a line out.

    \b
    Examples:
      echo '{"observe": {"enter": ["c1"]}}' | waiter serve --layout report
      waiter serve --layout report --journal lunch.journal --listen 127.0.0.1:7311
      waiter serve --replay lunch.journal
    """
    from sparc.limits import begin
    from waiter_cli.commands.search_report import print_stages
    from waiter_cli.diagnosis.diagnose import explain
    from waiter_cli.errors import Exit
    from waiter_cli.execution.online_planner import TIME_LIMIT, OnlinePlanner

    begin(None, memory_limit)
    if time_limit is None and translator is TranslatorName.native:
        time_limit = TIME_LIMIT
    options = PlanOptions(
        search, max_steps, time_limit, memory_limit, domain, translator, sparc_jar
    )
    thinker = OnlinePlanner(
        options.load_translator(),
        options.load_domain(),
        options.time_limit,
        options.search.value,
        options.max_steps,
        print_stages if verbose else None,
    )
    if replay is not None:
        from waiter_cli.serve.journal_replay import replay as run_replay

        return run_replay(replay, thinker, explain, print, _warn)
    where, found, text = _read(layout, scenario)
    from waiter_cli.execution.decision import Refused

    try:
        session = _session(where, found, text, thinker, journal, compact)
    except Refused as fault:
        if as_json:
            from waiter_cli.console.output import print_json
            from waiter_cli.files.documents import reason_document

            reasons = [reason_document(reason) for reason in fault.reasons]
            print_json({"status": "contradiction", "layout": where.name, "reasons": reasons})
        else:
            for reason in fault.reasons:
                _warn(f"{reason.where}: {reason.message}" if reason.where else reason.message)
        return Exit.PROVED
    try:
        _run(session, listen)
    finally:
        if session.journal is not None:
            session.journal.close()
        if record_timing:
            _warn(_timing(session))
    return 0


def _read(layout: str | None, scenario: str | None) -> tuple[Layout, Scenario | None, str]:
    """Returns the restaurant, the situation, and the text of the layout's file."""
    from waiter_cli.errors import InputError
    from waiter_cli.file_access.locate import read_text
    from waiter_cli.files.layout_reader import read_layout
    from waiter_cli.files.scenario_reader import read_scenario_file

    if "-" in (layout, scenario):
        raise InputError("standard input is for observations", "name a file")
    found = None
    if layout is None:
        if scenario is None:
            raise InputError("which restaurant?", "give --layout, or a --scenario that names one")
        named, found = read_scenario_file(scenario, several=True)
        layout = named.file
    file = read_text(layout, "layout")
    where = read_layout(file.text, file.shown)
    if scenario is not None and found is None:
        _, found = read_scenario_file(scenario, where, several=True)
    return where, found, file.text


def _session(
    layout: Layout,
    scenario: Scenario | None,
    text: str,
    thinker: OnlinePlanner,
    journal: str | None,
    compact: bool,
) -> Session:
    """Returns the run, at its start or where its journal ends; raises `Refused` at a contradiction."""
    from waiter_cli.diagnosis.diagnose import explain
    from waiter_cli.errors import Fault, InputError, Where
    from waiter_cli.serve.journal import JournalFull
    from waiter_cli.serve.session import Session
    from waiter_cli.serve.startup import begin, open_journal

    executive = begin(layout, scenario, thinker, explain)
    thinker.warm_up(executive.layout, executive.state)  # before anything is decided within a limit
    if journal is None:
        executive.decide()
        return Session(executive, thinker)
    try:
        opened, went_on = open_journal(journal, executive, text, _warn, compact)
    except JournalFull as fault:
        raise InputError([Fault(Where(journal), fault.why)]) from None
    if went_on:
        _warn(
            f"{journal}: going on at step {executive.step}, revision {executive.decision.revision}"
        )
    return Session(executive, thinker, opened)


def _run(session: Session, listen: str | None) -> None:
    """Answers lines from stdin, or from whoever connects, until there are none."""
    from sparc.garbage import collect_often
    from waiter_cli.serve.inbox import Inbox, read_into
    from waiter_cli.serve.protocol import hello, to_json
    from waiter_cli.serve.session import serve_lines

    executive = session.executive
    greeting = to_json(hello(executive.layout))
    collect_often()
    if listen is not None:
        from waiter_cli.serve.sockets import listen_on

        listen_on(listen, session, greeting, _warn)
        return
    import threading

    inbox = Inbox()
    _say(greeting)
    reader = threading.Thread(target=read_into, args=(inbox, sys.stdin.buffer), daemon=True)
    reader.start()
    serve_lines(session, inbox, _say)


def _say(text: str) -> None:
    from waiter_cli.console.output import print_text

    print_text(text)
    sys.stdout.flush()


def _warn(text: str) -> None:
    from waiter_cli.console.output import print_text

    print_text(f"waiter serve: {text}", sys.stderr)


def _timing(session: Session) -> str:
    found = session.latencies.summary()
    if not found["count"]:
        return "no observation was planned for"
    marks = ", ".join(f"{mark} {found[f'{mark}_ms']} ms" for mark in ("p50", "p95", "p99"))
    return f"from observation to plan: {marks} ({found['count']} observations)"
