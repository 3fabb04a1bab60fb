"""``waiter study run``: plays what is not done of a study, and keeps what came of it."""

from __future__ import annotations

import os
import shlex
import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import JsonOption, MemoryLimitOption, WorkersOption, named_file

if TYPE_CHECKING:
    from waiter_cli.study.run_study import StudyCounts
    from waiter_cli.study.store import Store

__all__ = ["run"]


def run(
    study: Annotated[
        str, typer.Argument(metavar="STUDY.yaml", help="What to compare; - is stdin.")
    ],
    output: Annotated[
        Optional[str],
        typer.Option(
            "--output",
            "-o",
            callback=named_file,
            metavar="FILE",
            help="The store: made, or gone on with where it is there; STUDY.db unless told.",
        ),
    ] = None,
    workers: WorkersOption = None,
    scheduler: Annotated[
        Optional[str],
        typer.Option(
            "--scheduler",
            metavar="tcp://HOST:PORT",
            help="Play on the Dask cluster of that scheduler.",
        ),
    ] = None,
    csv: Annotated[
        Optional[str],
        typer.Option(
            "--csv", callback=named_file, metavar="FILE", help="Write the table as CSV, too."
        ),
    ] = None,
    parquet: Annotated[
        Optional[str],
        typer.Option(
            "--parquet",
            callback=named_file,
            metavar="FILE",
            help="Write the table as Parquet, too.",
        ),
    ] = None,
    retry: Annotated[
        bool, typer.Option("--retry", help="Play runs again that failed or reached a limit.")
    ] = False,
    time_limit: Annotated[
        float,
        typer.Option(
            "--time-limit", min=0.0, metavar="SECONDS", help="End a run after so many seconds."
        ),
    ] = 300.0,
    memory_limit: MemoryLimitOption = None,
    as_json: JsonOption = False,
) -> int:
    """Play all evenings of a study that are not in its store yet.

    It can be stopped at any moment, by whatever: the same command goes on with what is not done.
    A run that fails, hangs or takes too much memory is noted and does not stop the others.

    \b
    Examples:
      waiter study run friday-study.yaml -o friday.db
      waiter study run friday-study.yaml -o friday.db --workers 4 --csv friday.csv
    """
    from functools import partial

    from waiter_cli.file_access.atomic import require_apart
    from waiter_cli.study.export import require_parquet
    from waiter_cli.study.local_workers import memory_of_each, play_locally, workers_here
    from waiter_cli.study.store import Store
    from waiter_cli.study.studies import RunLimits
    from waiter_cli.study.study_file import read_study_file

    if parquet is not None:
        require_parquet()
    read = read_study_file(study)
    output = output or _beside(study)
    kept = [output, study, read.scenario, *(layout.file for layout in read.layouts)]
    require_apart({"--csv": csv, "--parquet": parquet}, kept)
    if scheduler is not None:
        from waiter_cli.study.cluster_workers import play_on_cluster, require_distributed

        require_distributed()
        _only_one(workers, scheduler)
    number = min(workers or workers_here(), read.size)
    limits = RunLimits(time_limit, memory_limit or memory_of_each(number))
    play: Any = partial(play_locally, workers=number, limits=limits)
    if scheduler is not None:
        limits = RunLimits(time_limit, memory_limit)
        play = partial(play_on_cluster, address=scheduler, limits=limits)
    on = ["waiter", "study", "run", study, "-o", output]
    on += [] if workers is None else ["--workers", str(workers)]
    on += [] if scheduler is None else ["--scheduler", scheduler]
    counts = _conducted(read, output, play, retry, shlex.join(on))
    with Store(output) as store:
        _export(store, csv, parquet)
    _report(read.name, output, counts, as_json)
    return 0


def _only_one(workers: int | None, scheduler: str) -> None:
    from waiter_cli.errors import InputError

    if workers is not None:
        message = f"--workers {workers} is for this machine, --scheduler {scheduler} for a cluster"
        raise InputError(message, "leave one of them out")


def _beside(study: str) -> str:
    """Returns the store of a study where none is named."""
    from waiter_cli.errors import InputError

    if study == "-":
        raise InputError("which store?", "give --output FILE")
    stem, ending = os.path.splitext(study)
    return f"{stem if ending in ('.yaml', '.yml') else study}.db"


def _conducted(study: Any, output: str, play: Any, retry: bool, on: str) -> StudyCounts:
    """Runs a study and shows how far it is; says how to go on where it is interrupted."""
    from waiter_cli.console.output import say
    from waiter_cli.console.progress import alive
    from waiter_cli.errors import MissingError
    from waiter_cli.study.run_study import StudyHalted, progress_line, run_study

    last: list[StudyCounts] = []
    try:
        with alive("playing") as note:

            def progress(counts: StudyCounts) -> None:
                last[:] = [counts]
                note(progress_line(counts))

            return run_study(study, output, play, retry=retry, progress=progress)
    except StudyHalted as halted:
        done = last[0].planned - last[0].left if last else 0
        message = f"{halted.why}; {done} of {study.size} runs are in {output}"
        raise MissingError(message, f"{halted.mend}, then: {on}") from halted
    except BaseException as ending:
        if last and not isinstance(ending, Exception):
            done = last[0].planned - last[0].left
            say(f"\n{done} of {last[0].planned} runs are in {output}; go on with", sys.stderr)
            say(f"  {on}", sys.stderr)
        raise


def _export(store: Store, csv: str | None, parquet: str | None) -> None:
    """Writes the tables that were asked for."""
    if csv is None and parquet is None:
        return
    from waiter_cli.console.output import print_text
    from waiter_cli.file_access.atomic import write_whole
    from waiter_cli.study.export import csv_text, parquet_bytes

    rows = store.rows()
    if csv is not None:
        write_whole(csv, csv_text(rows))
        print_text(f"wrote {csv}", sys.stderr)
    if parquet is not None:
        write_whole(parquet, parquet_bytes(rows))
        print_text(f"wrote {parquet}", sys.stderr)


def _report(name: str, output: str, counts: StudyCounts, as_json: bool) -> None:
    from waiter_cli.console.output import print_json, say

    if as_json:
        print_json(
            {
                "status": "complete",
                "study": name,
                "store": output,
                "runs": counts.planned,
                "done": counts.done,
                "failed": counts.failed,
                "limit": counts.limit,
                "played": counts.now,
                "seconds": round(counts.seconds, 3),
            }
        )
        return
    say(f"{name}: {counts.done} of {counts.planned} runs done, {counts.now} of them now.")
    if counts.failed or counts.limit:
        bad = [f"{counts.failed} failed"] if counts.failed else []
        bad += [f"{counts.limit} reached a limit"] if counts.limit else []
        say(f"{' and '.join(bad)}: waiter study show {shlex.quote(output)} says why.")
