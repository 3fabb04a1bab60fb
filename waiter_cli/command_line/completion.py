"""Completes words in a shell, and prints the scripts for it: ``waiter --show-completion``.

Commands, options and choices are offered by Typer. The functions here add names: of built-in
layouts, scenarios and domains, and of files beside them. Where none of these fits, nothing is
offered, and the shell offers its own files.
"""

from __future__ import annotations

import os
from collections.abc import Callable

__all__ = ["SHELLS", "completion", "names_of"]

SHELLS = ("bash", "zsh", "fish", "powershell", "pwsh")
_ENDS = {"layout": (".yaml", ".yml"), "scenario": (".yaml", ".yml"), "domain": (".sparc",)}


def names_of(kind: str) -> Callable[[str], list[str]]:
    """Returns the function that completes the name of a layout, scenario or domain.

    >>> names_of("layout")("repo")
    ['report', 'report_large']
    """

    def complete(incomplete: str) -> list[str]:
        from waiter_cli.file_access.locate import built_in

        names = [name for name in built_in(kind) if name.startswith(incomplete)]
        return names and sorted({*names, *_files(incomplete, _ENDS[kind])})

    return complete


def _files(incomplete: str, ends: tuple[str, ...]) -> list[str]:
    """Files and folders here whose names begin so."""
    try:
        entries = [e for e in os.scandir() if e.name.startswith(incomplete)]
    except OSError:
        return []
    return [
        entry.name + ("/" if entry.is_dir() else "")
        for entry in entries
        if not entry.name.startswith(".") and (entry.is_dir() or entry.name.endswith(ends))
    ]


def completion(option: str, shell: str | None) -> int:
    """Shows the script for ``shell`` (the one that runs `waiter`), or installs it for this user.

    Raises `InputError` for a shell that has none.
    """
    from typer.completion import get_completion_script, install  # type: ignore[attr-defined]

    from waiter_cli.console.output import print_document, print_text
    from waiter_cli.errors import InputError

    name = shell or _shell()
    if name not in SHELLS:
        what = f"no completion for {name}" if name else "which shell?"
        raise InputError(what, f"name one of {', '.join(SHELLS)}: waiter {option} bash")
    if option == "--show-completion":
        variable = "_WAITER_COMPLETE"
        print_document(
            get_completion_script(prog_name="waiter", complete_var=variable, shell=name) + "\n"
        )
    else:
        _, path = install(shell=name, prog_name="waiter")
        print_text(f"completion for {name} is installed in {path}; new terminals have it")
    return 0


def _shell() -> str | None:
    """Returns the name of the shell that runs `waiter`, as far as can be told."""
    from shellingham import ShellDetectionFailure, detect_shell  # type: ignore[import-untyped]

    try:
        return str(detect_shell()[0])
    except ShellDetectionFailure:
        return os.path.basename(os.environ.get("SHELL", "")) or None
