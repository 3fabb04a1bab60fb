"""`waiter doctor`: what is installed, what is missing, and the line that gets it.

`examine` makes the report as values, `doctor` prints it.  Nothing is changed and the network is
not used.
"""

from __future__ import annotations

import platform
import sys

from sparc.lazy_dataclass import dataclass
from waiter_cli.commands.options import JsonOption, SparcJarOption
from waiter_cli.optional_packages import (
    EXTRAS,
    PYBULLET_BEFORE,
    extra_line,
    has_pybullet_wheels,
    pip_line,
)

__all__ = ["Finding", "doctor", "examine"]

OLDEST_PYTHON = (3, 10)


@dataclass(frozen=True)
class Finding:
    """One thing that `waiter` uses.

    ``status`` is ``ok``, ``missing``, ``unusable`` (there, but it does not work) or
    ``unavailable`` (it cannot be had on this machine).  ``mend`` is the line that gets it.
    """

    name: str
    status: str
    needed_for: str
    core: bool = False
    version: str | None = None
    path: str | None = None
    sha256: str | None = None
    mend: str | None = None


def doctor(as_json: JsonOption = False, sparc_jar: SparcJarOption = None) -> None:
    """Say what is installed, what is missing, and how to get it.

    \b
    Examples:
      waiter doctor
      waiter doctor --json
    """
    import typer

    from waiter_cli.console.output import print_text
    from waiter_cli.errors import Exit

    findings = examine(sparc_jar)
    ok = all(finding.status == "ok" for finding in findings if finding.core)
    if as_json:
        print_text(_as_json(findings, ok))
    else:
        _print(findings, ok)
    if not ok:
        raise typer.Exit(Exit.MISSING)


# ------------------------------------------------------------------ examination


def examine(sparc_jar: str | None = None) -> list[Finding]:
    """Returns everything that `waiter` uses, in the order in which a newcomer meets it."""
    return [
        _python(),
        _module("clingo", "clingo", "solving", "clingo"),
        _module("typer", "typer", "the command line", "typer"),
        _module("rich", "rich", "the progress of a download", "rich"),
        _module("PyYAML", "yaml", "layouts and scenarios", "pyyaml"),
        _module("HiGHS", "highspy", "proofs for large evenings", "highspy", core=False),
        _java(),
        _jar(sparc_jar),
        _pybullet(),
        _module("numpy", "numpy", "pictures", "numpy", extra_line("record"), core=False),
        _module(
            "imageio-ffmpeg",
            "imageio_ffmpeg",
            "simulate --record",
            "imageio-ffmpeg",
            extra_line("record"),
            core=False,
        ),
        _module(
            "Pillow",
            "PIL",
            "pictures and films",
            "pillow",
            extra_line("record"),
            core=False,
        ),
        _module("pygls", "pygls", "sparc lsp", "pygls", extra_line("lsp"), core=False),
        _module(
            "matplotlib",
            "matplotlib",
            "study report",
            "matplotlib",
            extra_line("study"),
            core=False,
        ),
        _module(
            "pyarrow",
            "pyarrow",
            "study run --parquet",
            "pyarrow",
            extra_line("study"),
            core=False,
        ),
        _module(
            "distributed",
            "distributed",
            "study run --scheduler",
            "distributed",
            extra_line("cluster"),
            core=False,
        ),
        *(
            _module(name, name, "studio", name, extra_line("studio"), core=False)
            for name in EXTRAS["studio"]
        ),
    ]


def _python() -> Finding:
    old = sys.version_info[:2] < OLDEST_PYTHON
    wanted = ".".join(map(str, OLDEST_PYTHON))
    return Finding(
        "Python",
        "unusable" if old else "ok",
        "everything",
        core=True,
        version=platform.python_version(),
        path=sys.executable or None,
        mend=f"install Python {wanted} or newer" if old else None,
    )


def _module(
    name: str,
    module: str,
    needed_for: str,
    package: str,
    mend: str | None = None,
    core: bool = True,
) -> Finding:
    """Returns an importable module; core ones are imported, to be sure that they work."""
    from importlib import import_module, metadata, util

    mend = mend or pip_line(package)
    try:
        version: str | None = metadata.version(package)
    except metadata.PackageNotFoundError:
        version = None
    try:
        spec = util.find_spec(module)
        if spec is None:
            return Finding(name, "missing", needed_for, core, mend=mend)
        if core:
            version = version or getattr(import_module(module), "__version__", None)
            import_module(module)
    except (ImportError, ValueError, OSError) as error:
        return Finding(name, "unusable", f"{needed_for} ({error})", core, version, mend=mend)
    return Finding(name, "ok", needed_for, core, version)


def _pybullet() -> Finding:
    finding = _module(
        "pybullet", "pybullet", "simulate in 3-D", "pybullet", extra_line("sim"), core=False
    )
    if finding.status == "ok" or has_pybullet_wheels():
        return finding
    newest = ".".join(map(str, (PYBULLET_BEFORE[0], PYBULLET_BEFORE[1] - 1)))
    oldest = ".".join(map(str, OLDEST_PYTHON))
    return Finding(
        "pybullet",
        "unavailable",
        "simulate in 3-D",
        mend=f"ready-made only for Linux x86_64 with Python {oldest} to {newest}; "
        f"this is {platform.system()} {platform.machine()} with Python {platform.python_version()}",
    )


def _java() -> Finding:
    from sparc.solving.jar_translator import find_java, java_version
    from waiter_cli.translators.jar import java_mend

    needed_for = "--translator jar"
    java = find_java()
    if java is None:
        return Finding("Java", "missing", needed_for, mend=java_mend())
    version = java_version(java)
    if version is None:
        return Finding("Java", "unusable", needed_for, path=java, mend=java_mend())
    return Finding("Java", "ok", needed_for, version=version, path=java)


def _jar(option: str | None) -> Finding:
    from waiter_cli.errors import MissingError
    from waiter_cli.translators.jar_store import (
        FETCH,
        HomelessError,
        NoSuchJarError,
        find_jar,
        release_of,
    )

    needed_for = "--translator jar"
    try:
        jar = find_jar(option)
        sha256 = jar.sha256()
    except MissingError as error:
        mend = FETCH
        if isinstance(error, NoSuchJarError):
            mend = f"{FETCH}, or correct the path: {error.message}"
        elif isinstance(error, HomelessError):
            mend = error.mend
        return Finding("sparc.jar", "missing", needed_for, mend=mend)
    release = release_of(sha256)
    return Finding(
        "sparc.jar",
        "ok" if release else "unusable",
        needed_for if release else f"{needed_for} (no version that is known here)",
        version=f"V{release.version}" if release else None,
        path=str(jar.path),
        sha256=sha256,
        mend=None if release else FETCH,
    )


# ------------------------------------------------------------------ output


def _as_json(findings: list[Finding], ok: bool) -> str:
    import json
    from dataclasses import asdict

    from waiter_cli import __version__

    report = {
        "ok": ok,
        "waiter": __version__,
        "platform": platform.platform(),
        "components": [asdict(finding) for finding in findings],
    }
    return json.dumps(report, indent=2)


def _print(findings: list[Finding], ok: bool) -> None:
    """Prints the findings for a person."""
    from waiter_cli import __version__
    from waiter_cli.console.output import print_text, say

    signs = {"ok": "ok", "missing": "missing", "unusable": "broken", "unavailable": "not here"}
    width = max(len(finding.name) for finding in findings)
    say(f"waiter {__version__} on {platform.platform()}\n")
    for finding in findings:
        head = (
            f"{finding.name:<{width}}  {signs[finding.status]:<8}  {finding.version or '-':<12}  "
        )
        say(f"{head}for {finding.needed_for}", hang=len(head))
        indent = " " * (width + 2)
        if finding.path:
            say(f"{indent}{finding.path}")
        if finding.sha256:
            say(f"{indent}sha256 {finding.sha256}", hang=0)
        if finding.mend:
            say(f"{indent}-> {finding.mend}", hang=len("-> "))
    missing = [finding for finding in findings if finding.status != "ok"]
    print_text("")
    if not ok:
        say("A core part is missing: `waiter` cannot work.")
    elif missing:
        say(f"Planning works. Not here: {', '.join(finding.name for finding in missing)}.")
    else:
        say("Everything is here.")
