"""``waiter sparc fetch-jar``: the original translator, asked for, downloaded and verified."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Annotated, Any, Optional

import typer

from waiter_cli.commands.options import JsonOption

if TYPE_CHECKING:
    from waiter_cli.translators.jar_store import JarRelease

__all__ = ["fetch_jar"]


def fetch_jar(
    version: Annotated[
        str, typer.Option("--version", metavar="VERSION", help="Which version: 2.57 or 2.56.")
    ] = "2.57",
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Do not ask.")] = False,
    url: Annotated[
        Optional[str], typer.Option("--url", metavar="URL", help="Download it from here instead.")
    ] = None,
    timeout: Annotated[
        float,
        typer.Option("--timeout", min=0.1, metavar="SECONDS", help="Longest wait for the network."),
    ] = 30.0,
    as_json: JsonOption = False,
) -> int:
    """Download the original sparc.jar, verify it, and install it for this user.

    \b
    Examples:
      waiter sparc fetch-jar
      waiter sparc fetch-jar --yes --version 2.56
    """
    from waiter_cli.console.output import print_text
    from waiter_cli.errors import Exit, InputError
    from waiter_cli.translators.jar_store import RELEASES, FoundJar, fetch, store_path

    release = RELEASES.get(version.lower().removeprefix("v"))
    if release is None:
        raise InputError(f"--version {version}: not known", f"known are {', '.join(RELEASES)}")
    target = store_path()
    if os.path.isfile(target) and FoundJar(target, "store").sha256() == release.sha256:
        if as_json:
            _print_installed(release, str(target), fetched=False)
        else:
            print_text(f"sparc.jar V{release.version} is installed already: {target}")
        return 0
    address = url or release.url
    if not yes and not _agreed(
        f"Download sparc.jar V{release.version} ({release.size // 1024} kB, BSD licence)\n"
        f"  from {address}\n  to   {target}?"
    ):
        print_text("waiter: nothing was downloaded.", sys.stderr)
        return Exit.INTERRUPTED
    with _Progress(f"sparc.jar V{release.version}") as progress:
        fetch(release, target, url=url, timeout=timeout, progress=progress.update)
    if as_json:
        _print_installed(release, str(target), fetched=True)
    else:
        print_text(f"sparc.jar V{release.version} is installed, its sha256 verified: {target}")
    return 0


def _print_installed(release: JarRelease, path: str, *, fetched: bool) -> None:
    from waiter_cli.console.output import print_json

    print_json(
        {
            "status": "installed",
            "version": release.version,
            "path": path,
            "sha256": release.sha256,
            "fetched": fetched,
        }
    )


def _agreed(question: str) -> bool:
    """Returns whether the person at the terminal says yes."""
    from waiter_cli.console.output import print_text
    from waiter_cli.errors import InputError

    if not sys.stdin.isatty():
        raise InputError("nobody can be asked here before the download", "give --yes")
    print_text(f"{question} [y/N] ", sys.stderr, end="")
    sys.stderr.flush()
    return sys.stdin.readline().strip().lower() in ("y", "yes")


class _Progress:
    """A bar on stderr once something arrives, where that is a terminal that can take it away again."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._bar: Any = None
        self._task: Any = None
        self._shown = False

    def __enter__(self) -> _Progress:
        self._shown = sys.stderr.isatty() and os.environ.get("TERM") not in ("dumb", "unknown")
        return self

    def update(self, done: int, total: int | None) -> None:
        """Shows ``done`` of ``total`` bytes."""
        if self._shown and self._bar is None and done:
            from rich.console import Console
            from rich.progress import BarColumn, DownloadColumn, Progress, TextColumn

            columns = (TextColumn("{task.description}"), BarColumn(), DownloadColumn())
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            self._bar.start()
            self._task = self._bar.add_task(self._label, completed=done, total=total)
        if self._bar is not None:
            self._bar.update(self._task, completed=done, total=total)

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.stop()
